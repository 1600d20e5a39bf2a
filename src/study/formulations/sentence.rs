//! What to pick, in sentences made of the figures.

use super::measure::TARGETS_RAD;
use super::report::{FormulationReport, ratio_cell};
use super::row::Row;
use crate::rigid::Method;
use crate::study::rounded;

/// Methods that take any force; the others take free bodies, or forces as kicks between free motions.
const FOR_ANY_FORCE: [Method; 5] = [Method::Rk4, Method::Tsit5, Method::Dop853, Method::Rkmk4, Method::CommutatorFree];

fn takes_any_force(row: &Row) -> bool {
    FOR_ANY_FORCE.iter().any(|method| method.name() == row.setting.method)
}

fn makes_steps(row: &Row) -> bool {
    row.setting.steps.is_some() || row.setting.tolerance.is_some()
}

/// `rotor dop853 by tolerance (1e-9), 0.31`
fn named(row: &Row) -> String {
    let ratio = row.ratio().map_or(String::new(), |ratio| format!(", {}", ratio_cell(ratio)));
    format!("`{}` ({}{ratio})", row.setting.way(), row.setting.step())
}

/// The verdict.
pub(super) fn verdict(report: &FormulationReport) -> String {
    let sentences = [forms(report), free(report), any_force(report)];
    sentences.into_iter().flatten().collect::<Vec<_>>().join(" ")
}

/// Rotor and motor beside the quaternion, and the matrix's drift.
fn forms(report: &FormulationReport) -> Option<String> {
    let over = |form: &str| report.over_quaternion.iter().find(|it| it.form == form).map(|it| it.ratio);
    let (rotor, motor, matrix) = (over("rotor")?, over("motor")?, over("matrix")?);
    let pick =
        if rotor.low <= 1.0 { "Pick the rotor form" } else { "Pick the quaternion form where only steps of RK4 count" };
    let standard = |form: &str| report.standard("rk4", form).and_then(Row::figures);
    let (drifted, kept) = (standard("matrix")?, standard("rotor")?);
    Some(format!(
        "{pick}: a step of RK4 in rotors takes {} of the time in quaternions, in motors {}, in matrices {}; the matrix is \
         then {:.0e} from a rotation, the rotor {:.0e}.",
        rounded(rotor.value),
        rounded(motor.value),
        rounded(matrix.value),
        drifted.norm_drift,
        kept.norm_drift
    ))
}

/// Where nothing turns the body.
fn free(report: &FormulationReport) -> Option<String> {
    let flight = report.rows.iter().find(|row| row.setting.method == Method::FreeFlight.name())?;
    let last = TARGETS_RAD[TARGETS_RAD.len() - 1];
    let stepping = report.cheapest(last, makes_steps);
    let stepping = stepping.map_or(format!("no method with steps comes within {last:.0e} rad"), |row| {
        format!("with steps, the cheapest within {last:.0e} rad is {}", named(row))
    });
    Some(format!(
        "Where nothing turns a body, fly it: {} ends {:.0e} rad off; {stepping}.",
        named(flight),
        flight.figures()?.error_rad
    ))
}

/// Under any force.
fn any_force(report: &FormulationReport) -> Option<String> {
    let picks: Vec<String> = TARGETS_RAD
        .into_iter()
        .filter_map(|target| Some(format!("{target:.0e} rad {}", named(report.cheapest(target, takes_any_force)?))))
        .collect();
    let beside = |method: Method| {
        let ratio = |target| report.cheapest(target, |row| row.setting.method == method.name())?.ratio();
        TARGETS_RAD.into_iter().rev().find_map(ratio)
    };
    let group = [Method::Rkmk4, Method::CommutatorFree].into_iter().filter_map(beside).map(|ratio| ratio.value);
    let best = TARGETS_RAD.map(|target| report.cheapest(target, takes_any_force).map(|row| row.setting.method));
    let won = best.iter().flatten().any(|method| ["rkmk4", "commutator_free"].contains(method));
    let group = match (won, group.reduce(f64::min)) {
        (false, Some(_)) => {
            " Exponentials win nowhere here: they keep versors on the group, which renormalising does for less."
        }
        _ => "",
    };
    (!picks.is_empty())
        .then(|| format!("Where forces may be any, the cheapest within {}.{group}", picks.join(", within ")))
}

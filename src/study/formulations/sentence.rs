//! What to pick, in sentences made of the figures.

use super::measure::TARGETS_RAD;
use super::report::{FormulationReport, ratio_cell};
use super::row::Row;
use crate::rigid::{Form, Method};
use crate::study::rounded;
use crate::study::timing::Ratio;

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

/// RK4 of a formulation over RK4 in quaternions.
fn over(report: &FormulationReport, form: Form) -> Option<Ratio> {
    report.over_quaternion.iter().find(|it| it.form == form.name()).map(|it| it.ratio)
}

/// A step of RK4 that is longer by less than this is not worth giving up what only rotors have: exact free motion, splittings,
/// exponentials.
const WORTH: f64 = 1.1;

/// The rotor, unless a step in quaternions is measurably and worthwhile shorter.
fn picked(report: &FormulationReport) -> Form {
    if over(report, Form::Rotor).is_some_and(|ratio| ratio.low <= WORTH) { Form::Rotor } else { Form::Quaternion }
}

/// Rotor and motor beside the quaternion, and the matrix's drift.
fn forms(report: &FormulationReport) -> Option<String> {
    let [matrix, rotor, motor] = [Form::Matrix, Form::Rotor, Form::Motor].map(|form| over(report, form));
    let standard = |form: Form| report.standard("rk4", form.name()).and_then(Row::figures);
    let (drifted, kept) = (standard(Form::Matrix)?, standard(Form::Rotor)?);
    Some(format!(
        "Pick the {} form: a step of RK4 in rotors takes {} of the time in quaternions, in motors {}, in matrices {}; after \
         100 s the matrix is {:.0e} from a rotation, the rotor {:.0e}.",
        picked(report).name(),
        rounded(rotor?.value),
        rounded(motor?.value),
        rounded(matrix?.value),
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

/// Under any force, in the form that is picked.
fn any_force(report: &FormulationReport) -> Option<String> {
    let form = picked(report);
    let among = |row: &Row| takes_any_force(row) && row.setting.form == form.name();
    let best = TARGETS_RAD.map(|target| (target, report.cheapest(target, among)));
    let picks: Vec<String> =
        best.iter().filter_map(|(target, row)| Some(format!("{target:.0e} rad {}", named((*row)?)))).collect();
    let on_group = |row: &Row| [Method::Rkmk4, Method::CommutatorFree].iter().any(|it| it.name() == row.setting.method);
    let group = match best.iter().any(|(_, row)| row.is_some_and(on_group)) {
        true => "",
        false => " Exponentials win nowhere here: renormalising keeps versors on the group for less.",
    };
    (!picks.is_empty())
        .then(|| format!("Where forces may be any, the cheapest within {}.{group}", picks.join(", within ")))
}

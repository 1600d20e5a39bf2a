//! The tables: Markdown, one line a way.

use crate::cases::{Case, distance};
use crate::kepler::{Orbit, Solved, Solver, fewest_evaluations};
use crate::measure::{Rounds, Spread, Watched, Way, time_call, time_run, watch};
use crate::pendulum;
use std::io::{Result, Write};

/// Ways on one case. The first is the base of the ratios.
pub fn mechanics(out: &mut impl Write, case: &Case, ways: &[Way], rounds: usize) -> Result<()> {
    let watched: Vec<Watched> = ways.iter().map(|way| watch(case, way)).collect();
    let times = Rounds::take(ways.len(), rounds, |way| time_run(case, &ways[way]) / case.duration_s());
    for (i, (way, watched)) in ways.iter().zip(&watched).enumerate() {
        let outcome = match &watched.failure {
            Some(failure) => failure.clone(),
            None => {
                let (time, ratio) = (times.time(i), times.ratio(i, 0));
                let step_ms = time.median * case.dt_s * 1e3;
                format!("{step_ms:.4} | {} | {}", spread(time, 1e3, 3), spread(ratio, 1.0, 2))
            }
        };
        writeln!(
            out,
            "| {} | {} | {} | {:.1e} | {:.1e} | {:.1e} | {outcome} |",
            case.name,
            way.name,
            pendulum_error(case, watched),
            watched.stretch,
            watched.violation,
            watched.energy_drift
        )?;
    }
    Ok(())
}

pub fn mechanics_head(out: &mut impl Write) -> Result<()> {
    writeln!(
        out,
        "\n| case | way | error at the end (m) | stretch | violation | energy drift | CPU ms per step | CPU ms per simulated s | over the first |"
    )?;
    writeln!(out, "|---|---|---:|---:|---:|---:|---:|---:|---:|")?;
    Ok(())
}

/// The cost of a particle and frame.
pub fn scaling(out: &mut impl Write, cases: &[Case], ways: &[Way], rounds: usize) -> Result<()> {
    writeln!(out, "\n| particles | way | violation | CPU ms per frame | CPU ns per particle and frame |")?;
    writeln!(out, "|---:|---|---:|---:|---:|")?;
    for case in cases {
        let particles = case.position_m.len();
        let times = Rounds::take(ways.len(), rounds, |way| time_run(case, &ways[way]) / case.steps as f64);
        for (i, way) in ways.iter().enumerate() {
            let (frame, violation) = (times.time(i), watch(case, way).violation);
            let each = spread(frame, 1e9 / particles as f64, 1);
            writeln!(out, "| {particles} | {} | {violation:.1e} | {} | {each} |", way.name, spread(frame, 1e3, 3))?;
        }
    }
    Ok(())
}

fn pendulum_error(case: &Case, watched: &Watched) -> String {
    if case.name != "double pendulum" {
        return "-".into();
    }
    match pendulum::end_m(case) {
        Ok(end) => format!("{:.1e}", distance(end, watched.last_m)),
        Err(error) => error,
    }
}

/// Errors, evaluations and times of solvers on a long eccentric orbit. The first solver is the base of the ratios.
pub fn kepler(out: &mut impl Write, orbit: Orbit, solvers: &[Solver], tolerances: &[f64], rounds: usize) -> Result<()> {
    writeln!(
        out,
        "\n| tolerance | solver | error at the end | evaluations | CPU ms | ns per evaluation | ms over the first |"
    )?;
    writeln!(out, "|---:|---|---:|---:|---:|---:|---:|")?;
    for &tolerance in tolerances {
        let times = Rounds::take(solvers.len(), rounds, |i| time_call(|| drop((solvers[i].solve)(orbit, tolerance))));
        for (i, solver) in solvers.iter().enumerate() {
            let line = match (solver.solve)(orbit, tolerance) {
                Ok(Solved { end, evaluations }) => format!(
                    "{:.1e} | {evaluations} | {} | {} | {}",
                    orbit.error(&end),
                    spread(times.time(i), 1e3, 2),
                    spread(times.time(i), 1e9 / evaluations as f64, 1),
                    spread(times.ratio(i, 0), 1.0, 2)
                ),
                Err(error) => error,
            };
            writeln!(out, "| {tolerance:.0e} | {} | {line} |", solver.name)?;
        }
    }
    Ok(())
}

/// The evaluations that reach an error at the end.
pub fn work_precision(out: &mut impl Write, orbit: Orbit, solvers: &[Solver], errors: &[f64]) -> Result<()> {
    let heads: String = errors.iter().map(|error| format!(" {error:.0e} |")).collect();
    writeln!(out, "\n| evaluations to reach |{heads}\n|---|{}", "---:|".repeat(errors.len()))?;
    for solver in solvers {
        let cells: String = errors
            .iter()
            .map(|&error| fewest_evaluations(solver, orbit, error))
            .map(|found| found.map_or(" - |".into(), |(count, tolerance)| format!(" {count} (at {tolerance:.0e}) |")))
            .collect();
        writeln!(out, "| {} |{cells}", solver.name)?;
    }
    Ok(())
}

/// `median [low, high]`, the ends of the middle half.
pub fn spread(value: Spread, unit: f64, digits: usize) -> String {
    let Spread { low, median, high } = value;
    format!("{:.digits$} [{:.digits$}, {:.digits$}]", median * unit, low * unit, high * unit)
}

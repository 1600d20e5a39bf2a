//! Integrators, stabilisations and solvers of constraint forces on problems with known answers: the comparison of the
//! report's appendix B, with today's methods beside its own.
//!
//! Every [`Method`](crate::particle::Method) runs every [`Case`] with a ladder of steps or tolerances. Errors are those of
//! positions at the end, against a closed form or a much finer solution whose own error is stated. `ga-physics study
//! solvers` writes the figures, and a page with one net at three tolerances.

mod cases;
mod chart;
mod choice;
mod measure;
mod page;
pub mod references;
mod report;
mod row;

pub use cases::{Case, Reference, kepler, net, pendulum};
pub use choice::TARGETS_M;
pub use measure::{Ladder, Scope, middle, run as run_setting, settings, time};
pub use report::{CaseReport, SolverReport};
pub use row::{Figures, Outcome, Purpose, Row, Setting, Time};

use super::{Provenance, StudyError, write_file};
use std::path::Path;
use std::time::Duration;

/// Which settings of a case are run.
fn scope(case: &Case, quick: bool) -> Scope {
    let ladder = |first, count, stride| Ladder { first, stride, count };
    let (steps, tolerances) = match (case.name, quick) {
        ("net", true) => (ladder(7, 2, 1), ladder(2, 2, 3)),
        ("net", false) => (ladder(7, 5, 1), ladder(1, 11, 1)),
        (_, true) => (ladder(6, 4, 2), ladder(2, 4, 3)),
        (_, false) => (ladder(5, 12, 1), ladder(1, 12, 1)),
    };
    Scope { steps, tolerances, budget: Duration::from_secs(if quick { 1 } else { 12 }) }
}

/// The figures of a case, without times.
///
/// # Errors
/// There is no reference, or a solver cannot be used.
pub fn examine(case: &Case, scope: &Scope) -> Result<CaseReport, StudyError> {
    let reference = case.reference()?;
    let rows = settings(case, scope).into_iter().map(|setting| run_setting(case, setting, &reference));
    Ok(CaseReport {
        name: case.name,
        title: case.title,
        end_s: case.end_s,
        rows: rows.collect::<Result<_, _>>()?,
        rounds: 0,
        reference: reference.source,
        reference_uncertainty_m: reference.uncertainty_m,
    })
}

/// Runs and times all cases, and writes `solvers.json`, `solvers.md`, `solvers.svg` and `solvers-net.html` into `out`.
///
/// # Errors
/// There is no reference, a solver cannot be used, or a file cannot be written.
pub fn run(quick: bool, out: &Path, progress: &mut dyn FnMut(&str)) -> Result<SolverReport, StudyError> {
    let mut cases = Vec::new();
    for case in [pendulum(), kepler(), net()] {
        progress(case.name);
        let scope = scope(&case, quick);
        let mut report = examine(&case, &scope)?;
        progress(&format!("{}: times of {} settings", case.name, report.rows.len()));
        report.rounds = time(&case, &mut report.rows, scope.budget);
        cases.push(report);
    }
    let command = if quick { "ga-physics study solvers --quick" } else { "ga-physics study solvers" };
    let report = SolverReport { provenance: Provenance::gather(command), cases };
    report.write(out)?;
    progress("a net at three tolerances");
    write_file(out, "solvers-net.html", &page::page()?)?;
    Ok(report)
}

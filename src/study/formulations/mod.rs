//! Formulations of rigid motion beside each other: rotation matrix, quaternion, rotor, motor, each with every integrator
//! that fits it, on a free body whose attitude is known to thirty digits.
//!
//! What is measured: the time of a step over that of a plain RK4 on nalgebra's quaternion, written for this body alone and
//! timed in the same rounds; the error of the attitude at the end and the drifts on the way; the time for a given error over
//! a ladder of steps and tolerances; bytes of state; lines of code; and what only one of them does. The sentence that says
//! what to pick is made of these figures. `ga-physics study formulations` writes them.

mod case;
mod measure;
mod plain;
mod report;
mod row;
mod sentence;
mod traits;

pub use case::{END_S, reference};
pub use measure::{Scope, examine, run_fixed};
pub use report::FormulationReport;
pub use row::{Figures, Outcome, Row, Setting, Time};
pub use traits::{Traits, lines_of_code, traits};

use super::{Provenance, StudyError};
use std::path::Path;

/// Runs and times everything, and writes `formulations.json`, `formulations.md` and `formulations.svg` into `out`.
///
/// # Errors
/// A solver cannot be used, or a file cannot be written.
pub fn run(quick: bool, out: &Path, progress: &mut dyn FnMut(&str)) -> Result<FormulationReport, StudyError> {
    let command = if quick { "ga-physics study formulations --quick" } else { "ga-physics study formulations" };
    run_scope(if quick { &Scope::QUICK } else { &Scope::FULL }, command, out, progress)
}

/// The same with settings of one's own; the command is what the report says that it comes from.
///
/// # Errors
/// As [`run`].
pub fn run_scope(
    scope: &Scope,
    command: &str,
    out: &Path,
    progress: &mut dyn FnMut(&str),
) -> Result<FormulationReport, StudyError> {
    progress("a free body in every formulation");
    let mut rows = examine(scope)?;
    progress("times");
    let timed = measure::time(&mut rows, scope);
    let report = FormulationReport::new(Provenance::gather(command), rows, timed)?;
    report.write(out)?;
    Ok(report)
}

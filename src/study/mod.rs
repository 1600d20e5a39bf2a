//! The study: what geometric algebra costs and gains, measured by what a user can call.
//!
//! [`kernels`] sets the generated types against the dynamic multivector and the traditional formulas, in time and
//! bytes. [`solvers`] sets the integrators, the stabilisations and the solvers of constraint forces against closed forms,
//! in work and time; [`formulations`] sets rotors and motors against quaternions and matrices. A figure is published with the machine, the command, the repeats and the spread, and beside every
//! time stands the disagreement of the results: a fast wrong kernel, or solver, would be seen.

mod chart;
pub mod formulations;
pub mod kernels;
mod machine;
pub mod solvers;
mod table;
pub mod timing;

pub use machine::Provenance;

use crate::io::files::{WriteError, write_whole};
use crate::ode::OdeError;
use crate::particle::{MotionError, SolverError};
use std::io;
use std::path::{Path, PathBuf};
use timing::Ratio;

/// Why a study gave no figures.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// Two ways to compute the same thing disagree: their times are not worth comparing.
    #[error(
        "{kernel}: {column} differs from the generated code by {difference:.1e} of the result, {limit:.1e} is allowed; \
         one of the two formulas is wrong"
    )]
    Disagreement {
        /// The kernel.
        kernel: &'static str,
        /// The way that is off.
        column: &'static str,
        /// The largest relative difference found.
        difference: f64,
        /// The largest one that rounding explains.
        limit: f64,
    },
    /// A solver of the study cannot be used.
    #[error(transparent)]
    Solver(#[from] SolverError),
    /// What the others are held against cannot be computed.
    #[error("no reference to hold solvers against: {0}")]
    Reference(#[from] OdeError<MotionError>),
    /// A solver of bodies cannot be used.
    #[error(transparent)]
    Bodies(#[from] crate::rigid::SolverError),
    /// A run of bodies that has to arrive does not.
    #[error("a body of the study does not arrive: {0}")]
    Motion(#[from] OdeError<crate::rigid::MotionError>),
    /// A body of the study is none.
    #[error(transparent)]
    Inertia(#[from] crate::rigid::InertiaError),
    /// A file or its directory cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The chart cannot be drawn.
    #[error("cannot draw the chart: {0}")]
    Chart(#[from] plotters::drawing::DrawingAreaErrorKind<io::Error>),
    /// The figures cannot be written as JSON.
    #[error("cannot write the figures as JSON: {0}")]
    Json(#[from] serde_json::Error),
}

/// Three significant digits: `0.49`, `2.05`, `20.5`, `205`.
fn rounded(value: f64) -> String {
    match value {
        value if value < 10.0 => format!("{value:.2}"),
        value if value < 100.0 => format!("{value:.1}"),
        value => format!("{value:.0}"),
    }
}

/// `2.05 [2.01, 2.10]`
fn ratio_text(ratio: Ratio) -> String {
    format!("{} [{}, {}]", rounded(ratio.value), rounded(ratio.low), rounded(ratio.high))
}

/// Writes a file of the study, whole or not at all.
fn write_file(directory: &Path, name: &str, content: &str) -> Result<PathBuf, StudyError> {
    let path = directory.join(name);
    std::fs::create_dir_all(directory).map_err(|source| WriteError { path: directory.to_path_buf(), source })?;
    write_whole(&path, |file| file.write_all(content.as_bytes()))?;
    Ok(path)
}

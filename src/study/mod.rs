//! The study: what geometric algebra costs and gains, measured by what a user can call.
//!
//! [`kernels`] sets the generated types against the dynamic multivector and the traditional formulas, in time and
//! bytes. A figure is published with the machine, the command, the repeats and the spread, and beside every time stands
//! the disagreement of the results: a fast wrong kernel would be seen.

mod chart;
pub mod kernels;
mod machine;
pub mod timing;

pub use machine::Provenance;

use std::io;
use std::path::{Path, PathBuf};

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
    /// A file or its directory cannot be written.
    #[error("cannot write {path}: {source}; is it a directory that you may write to? `--out DIR` names another", path = path.display())]
    Write {
        /// The file or directory.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The chart cannot be drawn.
    #[error("cannot draw the chart: {0}")]
    Chart(#[from] plotters::drawing::DrawingAreaErrorKind<io::Error>),
    /// The figures cannot be written as JSON.
    #[error("cannot write the figures as JSON: {0}")]
    Json(#[from] serde_json::Error),
}

/// Writes a file under a temporary name and renames it, so that a killed study leaves no half file.
fn write_whole(directory: &Path, name: &str, content: &str) -> Result<PathBuf, StudyError> {
    let path = directory.join(name);
    let temporary = directory.join(format!(".{name}.part"));
    std::fs::create_dir_all(directory).map_err(|source| StudyError::Write { path: directory.to_path_buf(), source })?;
    let written = std::fs::write(&temporary, content).and_then(|()| std::fs::rename(&temporary, &path));
    written.map_err(|source| StudyError::Write { path: path.clone(), source })?;
    Ok(path)
}

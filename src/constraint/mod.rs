//! Lagrange multipliers of constraints: rows over blocks of coordinates, two solvers of `J W J^T lambda = b`, projection.
//!
//! ```text
//! C(q) = 0,  J = dC/dq,  q'' = W (Q + J^T lambda),  J W J^T lambda = -Jdot q' - J W Q     (report, 24)
//! ```
//!
//! Always f64: the multipliers see differences of positions, which are f64 in every build.
//!
//! * [`Rows`]: made once with the pattern, refilled by `row_mut`; `times` (J v), `transposed_times`, `response` (`W J^T x`).
//! * [`InverseMass`]: a slice of numbers for particles (0 is fixed); bodies implement it.
//! * [`Direct`] and [`ConjugateGradients`]: `prepare` at new gradients, then `solve` as often as wanted.
//! * [`Multipliers`]: one of the two with the rows it was prepared at, and on it the projections of positions and velocities.
//!
//! Nothing allocates after the first step. The layer knows no particles: a [`Configuration`] evaluates the rows and takes
//! displacements.

mod direct;
mod gradients;
mod multipliers;
mod normal;
mod preconditioner;
mod projection;
mod rows;

pub use direct::Direct;
pub use gradients::{ConjugateGradients, Stop};
pub use multipliers::{Method, Multipliers};
pub use projection::{Configuration, Projected, ProjectionError};
pub use rows::{InverseMass, Row, RowMut, Rows};

use thiserror::Error;

/// Why there are no multipliers.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum SolveError {
    /// A value, gradient, velocity or mass left the range of the numbers.
    #[error("constraint {row}: a number of it is not finite")]
    NotFinite {
        /// Which row.
        row: usize,
    },
    /// The row depends on others, and asks for something else than they do; or on nothing that moves.
    #[error(
        "constraint {row} contradicts others, or nothing that it depends on can move: {excess:e} of it is left over; \
         remove one of them"
    )]
    Contradiction {
        /// Which row.
        row: usize,
        /// What remains of its right-hand side.
        excess: f64,
    },
}

/// How a solution ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Solved {
    /// Whether the accuracy asked for was reached.
    pub converged: bool,
    /// Iterations, or refinements of the direct solver.
    pub iterations: u32,
}

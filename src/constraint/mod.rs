//! Lagrange multipliers of constraints: rows over blocks of coordinates, two solvers of `J W J^T lambda = b`, projection.
//!
//! ```text
//! C(q) = 0,  J = dC/dq,  q'' = W (Q + J^T lambda),  J W J^T lambda = -Jdot q' - J W Q     (report, 24)
//! ```
//!
//! Always f64: the multipliers see differences of positions, which are f64 in every build.
//!
//! * [`Rows`]: made once with the pattern, refilled by `row_mut`; products `times` (J v), `transposed_times`, `response`
//!   (`W J^T x`), `normal_times` (`J W J^T x`); [`worst_violation`](Rows::worst_violation), m.
//! * [`InverseMass`]: a slice of numbers for particles (0 is fixed); bodies implement it.
//! * [`Direct`] and [`ConjugateGradients`]: `prepare` at new gradients, then `solve` as often as wanted.
//! * [`Multipliers`]: one of the two with the rows it was prepared at (`freeze`), and on it `solve`, the projections of
//!   positions (`project`, `project_along_frozen`) and of velocities (`velocity_change`).
//!
//! Nothing allocates after the first step. The layer knows no particles: a [`Configuration`] evaluates the rows and takes
//! displacements.
//!
//! ```
//! use ga_physics::constraint::{Method, Multipliers, Rows};
//!
//! // A pendulum of 2 m: one row, on block 0, which weighs 0.5 kg. C = (|x|² - 4) / 2, J = x, Jdot q' = |v|².
//! let (x, v, w) = ([0.0, -2.0, 0.0], [3.0, 0.0, 0.0], [2.0]);
//! let mut rows = Rows::<3>::new(1, [[0]]);
//! let row = rows.row_mut(0);
//! (*row.value, *row.curvature, row.gradients[0]) = (0.0, 9.0, x);
//!
//! let mut multipliers = Multipliers::new(&rows, w.as_slice(), Method::Direct);
//! multipliers.freeze(&rows, w.as_slice())?;
//! let mut lambda = [0.0];
//! // J W Q = 2 m * 9.81 m/s², so b = -|v|² - 19.62.
//! multipliers.solve(w.as_slice(), &[-9.0 - 19.62], &mut lambda)?;
//! // The rod pulls with |x| |lambda| = m (g + v²/l).
//! assert!((2.0 * lambda[0] + 0.5 * (9.81 + 4.5)).abs() < 1e-14);
//! # Ok::<(), ga_physics::constraint::SolveError>(())
//! ```

mod direct;
mod gradients;
mod multipliers;
mod normal;
mod preconditioner;
mod projection;
mod redundant;
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

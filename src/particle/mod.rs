//! Particles: point masses under forces and constraints (report, section 2.1).
//!
//! ```text
//! xdot = v     m vdot = F + Jᵀ lambda     C(x) = 0     (21), (22)
//! ```
//!
//! [`Particles`] is the state, [`Force`] what acts, [`Constraint`] what is held. Only the forces that are named are
//! evaluated.

mod check;
mod constraint;
mod energy;
mod fast;
mod force;
mod held;
mod method;
mod motion;
mod own;
mod state;
mod system;
pub mod xpbd;

pub use check::SetupError;
pub use constraint::Constraint;
pub use energy::{Totals, totals};
pub use force::{Force, Masses};
pub use method::{LinearSolver, Method, Solver, Stabilisation, Steps};
pub use motion::{Motion, SolverError};
pub use own::{ConstraintFunction, Differentiable, ForceLaw, OwnConstraint, OwnForce, OwnPotential, Potential};
pub use state::{Particles, Rates};
pub use system::{MotionError, Setup, System};

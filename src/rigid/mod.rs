//! Rigid bodies: state, inertia, forces, and the formulations of their motion.
//!
//! A formulation is a file with the functions `rhs`, `renormalise`, `advance`; [`rotor`] is the G(3,0) one.

mod body;
mod energy;
mod force;
pub mod rotor;

pub use crate::particle::Totals;
pub use body::{Bodies, BodyError, Inertia, Rates};
pub use energy::totals;
pub use force::{Force, Forces};

//! Rigid bodies: state, inertia, forces, joints, and the formulations of their motion.
//!
//! A formulation is a file with the functions `rhs`, `renormalise`, `advance`; [`rotor`] is the G(3,0) one, whose state is
//! [`Bodies`].

pub mod axis_splitting;
mod body;
mod energy;
mod error;
mod flight;
mod force;
mod formulation;
pub mod free;
mod held;
mod inertia;
mod joint;
mod jointed;
mod lie;
mod link;
#[cfg(feature = "study")]
pub mod matrix;
mod method;
mod motion;
pub mod motor;
pub mod quaternion;
pub mod rotor;
mod shake;
mod stepping;
mod sums;
mod system;

pub use crate::particle::Totals;
pub use body::Bodies;
pub use energy::totals;
pub use error::{MotionError, SolverError};
pub use force::{Attachment, Force, Forces};
pub use formulation::{Formulation, OrientationLost, Wrenches};
pub use held::Held;
pub use inertia::{Inertia, InertiaError, Principal};
pub use joint::{Joint, JointError};
pub use method::{Form, Method, Solver, Steps};
pub use motion::Motion;
pub use system::{Setup, System};

//! Rigid bodies: state, inertia, forces, joints, and the formulations of their motion.
//!
//! A formulation is a file with the functions `rhs`, `renormalise`, `advance`; [`rotor`] is the G(3,0) one, whose state is
//! [`Bodies`].
//!
//! * [`Inertia`]: checked and inverted once; [`Bodies`]: the states of all; [`Setup`]: what they are subject to.
//! * [`Force`]: at a point, torque, drag, spring; [`Joint`]: ball, hinge, distance, between [`Attachment`]s.
//! * [`Motion`] takes bodies over spans of time by a [`Method`] in a [`Form`]: by Runge-Kutta methods with renormalisation,
//!   by exponentials, or by the exact free motion between the kicks of forces; uniform gravity alone needs no steps.
//! * [`free::FreeMotion`]: one body that nothing turns, at any time, in closed form.
//!
//! ```
//! use ga_physics::algebra::{cga::Point, g3::{Bivector, Rotor, Vector}};
//! use ga_physics::rigid::{Attachment, Bodies, Forces, Inertia, Joint, Method, Motion, Setup, Solver};
//!
//! // A plate that spins about its middle axis, with its centre 0.2 m under a ball joint.
//! let inertia = Inertia::new(0.3, [[0.001, 0.0, 0.0], [0.0, 0.002, 0.0], [0.0, 0.0, 0.003]])?;
//! let mut bodies = Bodies::default();
//! let spin = inertia.momentum_of(Bivector::new(0.0, 8.0, 0.0));
//! let swing = Vector::new(-0.2 * 8.0, 0.0, 0.0) * 0.3;    // the momentum with which the joint stays where it is
//! bodies.push(Point::new(0.0, 0.0, -0.2), Rotor::default(), swing, spin);
//! let joint = Joint::Ball {
//!     a: Attachment::Body { body_idx: 0, at_body: Vector::new(0.0, 0.0, 0.2) },
//!     b: Attachment::World(Point::origin()),
//! };
//! let forces = Forces { gravity: Vector::new(0.0, 0.0, -9.81), forces: vec![] };
//! let setup = Setup { inertias: vec![inertia], forces, joints: vec![joint] };
//! let mut motion = Motion::new(setup, &bodies, &Solver::fixed(Method::Yoshida6, 0.001))?;
//! let before = motion.totals(&bodies).energy();
//! motion.advance(&mut bodies, 0.0, 2.0)?;
//! assert!((motion.totals(&bodies).energy() - before).abs() < 1e-9);
//! assert!(motion.worst_violation(&bodies).is_some_and(|violation_m| violation_m < 1e-13));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

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

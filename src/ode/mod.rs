//! Integrators of ordinary differential equations `dy/dt = f(t, y)`. They know no bodies: a [`State`] says how a rate moves
//! it, a [`System`] what its rate is.

mod adaptive;
mod control;
mod error;
mod event;
mod fixed;
mod leap;
pub mod root;
mod runge_kutta;
mod segment;
mod state;
mod stepper;
mod symplectic;
mod system;
pub mod tableau;

pub use adaptive::Adaptive;
pub use error::{OdeError, StepError};
pub use event::{Crossing, Event, Hit, Watch};
pub use fixed::Fixed;
pub use leap::{Leap, Leaps};
pub use runge_kutta::RungeKutta;
pub use state::{Controlled, SMALLEST_RTOL_EPS, State, Tolerance, ToleranceError};
pub use stepper::{MAX_STEPS, Run, Stepper, Work};
pub use symplectic::{Composition, Symplectic};
pub use system::{Mechanics, System};
pub use tableau::{CashKarp, Dop853, Embedded, Euler, Rk4, Rk4Doubling, Tableau, Tsit5};

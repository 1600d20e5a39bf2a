//! Integrators of ordinary differential equations `dy/dt = f(t, y)`. They know no bodies: a [`State`] says how a rate
//! moves it, a [`System`] what its rate is.
//!
//! | method | order | evaluations a step | error | dense output | for |
//! |---|---|---|---|---|---|
//! | [`Euler`] | 1 | 1 | | 1 | comparison |
//! | [`Rk4`] | 4 | 4 | | 3 | steps of one length |
//! | [`Rk4Doubling`] | 5 | 11 | 4 | 4 | comparison |
//! | [`CashKarp`] | 5 | 6 | 4 | 3 | comparison; errors of 1e-3 |
//! | [`Tsit5`] | 5 | 6 | 4 | 4 | errors down to 1e-5 |
//! | [`Dop853`] | 8 | 12 | 5, 3 | 7 (3 evaluations) | smaller errors |
//! | [`lie::Rkmk4`], [`lie::CommutatorFree4`] | 4 | 4 | 3 | 4 | states on a Lie group: rotors, motors |
//! | [`Composition::Verlet`] | 2 | 1 | | 2 (1) | long conservative runs |
//! | [`Composition::Yoshida4`] | 4 | 3 | | 4 (3) | the same |
//! | [`Composition::Yoshida6`] | 6 | 7 | | 6 (7) | the same |
//!
//! [`Adaptive`] chooses steps by a tolerance, [`Fixed`] and [`Symplectic`] make equal ones; all are [`Stepper`]s. Steps
//! are as long as they are; the state at any time comes from dense output.
//!
//! # Equations of your own
//!
//! Arrays, `Vec` and nalgebra's `SVector` of f32 or f64 are states, closures are systems:
//!
//! ```
//! use ga_physics::ode::{Adaptive, Dop853, Run, Stepper, Tolerance};
//!
//! // Van der Pol: x'' = mu (1 - x²) x' - x
//! let mu = 2.0;
//! let mut oscillator = |_t: f64, y: &[f64; 2], rate: &mut [f64; 2]| *rate = [y[1], mu * (1.0 - y[0] * y[0]) * y[1] - y[0]];
//!
//! let tolerance = Tolerance { rtol: 1e-9, atol: 1e-9 };
//! let mut solver = Adaptive::<Dop853, _, _>::new(0.0, [2.0, 0.0], [0.0; 2], tolerance)?;
//! let mut state = [0.0; 2];
//! for frame in 1..=100 {
//!     solver.advance_to(&mut oscillator, 0.1 * f64::from(frame), &mut state)?;
//! }
//! println!("{state:?} after {:?}", solver.work());
//! # assert!(solver.work().accepted < 100);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A system that can fail, or that must be put back onto a manifold after each step, implements [`System`] itself; a
//! state that is a structure of arrays implements [`State`] and [`Controlled`].
//!
//! # Events
//!
//! ```
//! use ga_physics::ode::{Adaptive, Crossing, Event, Run, Stepper, Tolerance, Tsit5, Watch};
//!
//! // A ball from 1 m, that bounces to a quarter of its height.
//! let mut fall = |_t: f64, y: &[f64; 2], rate: &mut [f64; 2]| *rate = [y[1], -9.81];
//! let tolerance = Tolerance { rtol: 1e-9, atol: 1e-9 };
//! let mut solver = Adaptive::<Tsit5, _, _>::new(0.0, [1.0, 0.0], [0.0; 2], tolerance)?;
//! let mut watch = Watch::new(0.0, [Event::new(Crossing::Falling, |_t, y: &[f64; 2]| y[0]).terminal()]);
//! let (mut state, mut impacts) = ([0.0; 2], vec![]);
//! while let Some(hit) = solver.advance_watching(&mut fall, 1.2, &mut watch, &mut state, &mut |_, _| ())? {
//!     impacts.push(hit.time_s);
//!     state = [0.0, -0.5 * state[1]];
//!     solver.restart(hit.time_s, &state);
//!     watch.restart(hit.time_s);
//! }
//! let first = (2.0_f64 / 9.81).sqrt();
//! assert_eq!(impacts.len(), 3);
//! assert!((impacts[0] - first).abs() < 1e-12 && (impacts[1] - 2.0 * first).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod adaptive;
mod control;
mod error;
mod event;
mod fixed;
mod leap;
pub mod lie;
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

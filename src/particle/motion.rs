//! Particles in motion: a system with the stepper that was chosen for it.

use super::{LinearSolver, Method, MotionError, Particles, Rates, Setup, SetupError, Solver, Steps, System, Totals};
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;
use crate::ode::{
    Adaptive, CashKarp, Composition, Dop853, Euler, Fixed, Leaps, OdeError, Rk4, Rk4Doubling, StepError, Stepper,
    Symplectic, Tolerance, ToleranceError, Tsit5, Work,
};
use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;
use thiserror::Error;

/// Why particles cannot be set in motion.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum SolverError {
    /// The particles, forces or constraints.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The step.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The tolerance.
    #[error(transparent)]
    Tolerance(#[from] ToleranceError),
    /// Sweeps, but not XPBD.
    #[error("`{}` needs multipliers, not sweeps: choose `direct` or `conjugate_gradients`", .0.name())]
    NeedsMultipliers(Method),
    /// Error control without an error estimate.
    #[error("`{}` does not estimate its error and needs a fixed step", .0.name())]
    NotAdaptive(Method),
}

type Step<T> = Box<dyn Stepper<System<T>, State = Particles<T>, Error = MotionError> + Send + Sync>;

/// Particles that move.
pub struct Motion<T: Real> {
    system: System<T>,
    stepper: Step<T>,
    time_s: f64,
    /// The state at the time, if that is within a step.
    interpolated: Particles<T>,
    between: bool,
}

impl<T: Real> Motion<T> {
    /// Starts at time 0.
    ///
    /// # Errors
    /// Particles, forces or constraints that are not sound, a solver that cannot be used.
    pub fn new(setup: Setup<T>, start: Particles<T>, solver: &Solver) -> Result<Self, SolverError> {
        Self::with_max_step(setup, start, solver, None)
    }

    /// Starts at time 0; a method that chooses its steps makes none longer than this, s.
    ///
    /// # Errors
    /// As [`Motion::new`].
    pub fn with_max_step(
        setup: Setup<T>,
        start: Particles<T>,
        solver: &Solver,
        max_step_s: Option<f64>,
    ) -> Result<Self, SolverError> {
        if solver.linear == LinearSolver::Sweeps && solver.method != Method::Xpbd {
            return Err(SolverError::NeedsMultipliers(solver.method));
        }
        let system = System::new(setup, &start, solver)?;
        let stepper = stepper(&start, solver, max_step_s)?;
        Ok(Self { system, stepper, time_s: 0.0, interpolated: start, between: false })
    }

    /// Advances to a time; the state is then that of this time, whatever steps were taken.
    ///
    /// # Errors
    /// A step that cannot be made. State and time are then those of the last good step.
    pub fn advance_to(&mut self, time_s: f64) -> Result<(), OdeError<MotionError>> {
        let from_s = self.time_s;
        let done = self.reach(time_s);
        (self.time_s, self.between) = match done {
            Ok(between) => (time_s, between),
            Err(_) => (self.stepper.time_s(), false),
        };
        done?;
        if is_finite(self.state()) { Ok(()) } else { Err(OdeError::NotFinite { time_s, step_s: time_s - from_s }) }
    }

    /// Steps to a time or past it; whether past it, and the state there had to be interpolated.
    fn reach(&mut self, time_s: f64) -> Result<bool, OdeError<MotionError>> {
        self.stepper.pass(&mut self.system, time_s)?;
        let between = self.stepper.time_s() != time_s;
        if between {
            self.stepper.interpolate(&mut self.system, time_s, &mut self.interpolated)?;
        }
        Ok(between)
    }

    /// No step goes past this time, s: the end of a run.
    pub fn stop_at(&mut self, time_s: f64) {
        self.stepper.stop_at(time_s);
    }

    /// Substeps a step of XPBD; none for other methods.
    #[must_use]
    pub fn substeps(&self) -> Option<usize> {
        self.system.substeps()
    }

    /// The time, s.
    #[must_use]
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// The state.
    #[must_use]
    pub fn state(&self) -> &Particles<T> {
        if self.between { &self.interpolated } else { self.stepper.state() }
    }

    /// Masses, forces, constraints.
    #[must_use]
    pub fn system(&self) -> &System<T> {
        &self.system
    }

    /// The worst violation of a constraint, m, and which; none without constraints.
    pub fn worst_violation(&mut self) -> Option<(usize, f64)> {
        let state = if self.between { &self.interpolated } else { self.stepper.state() };
        self.system.worst_violation(state)
    }

    /// Energy and momenta.
    #[must_use]
    pub fn totals(&self) -> Totals {
        self.system.totals(self.state())
    }

    /// What it has cost.
    #[must_use]
    pub fn work(&self) -> Work {
        self.stepper.work()
    }
}

/// Whether positions and kinetic energies are numbers. Methods without an error estimate do not notice by themselves.
fn is_finite<T: Real>(state: &Particles<T>) -> bool {
    let position = |x: &Point<f64>| x.position().norm_sq().is_finite();
    state.position.iter().all(position) && state.velocity.iter().all(|v| v.norm_sq().is_finite())
}

fn stepper<T: Real>(start: &Particles<T>, solver: &Solver, max_step_s: Option<f64>) -> Result<Step<T>, SolverError> {
    let rates = Rates::zeros(start.len());
    let accelerations: Vec<Vector<T>> = vec![Vector::default(); start.len()];
    macro_rules! fixed {
        ($method:ty, $dt_s:expr) => {
            Box::new(Fixed::<$method, _, T>::new(0.0, start.clone(), rates, $dt_s)?)
        };
    }
    macro_rules! adaptive {
        ($method:ty, $tolerance:expr) => {{
            let free = Adaptive::<$method, _, T>::new(0.0, start.clone(), rates, $tolerance)?;
            Box::new(match max_step_s {
                Some(max_step_s) => free.with_max_step(max_step_s)?,
                None => free,
            })
        }};
    }
    let split = |composition, dt_s| Symplectic::new(composition, 0.0, start.clone(), accelerations, dt_s);
    Ok(match solver.steps {
        Steps::Fixed { dt_s } => match solver.method {
            Method::Euler => fixed!(Euler, dt_s),
            Method::Rk4 | Method::Rk4Doubling => fixed!(Rk4, dt_s),
            Method::CashKarp => fixed!(CashKarp, dt_s),
            Method::Tsit5 => fixed!(Tsit5, dt_s),
            Method::Dop853 => fixed!(Dop853, dt_s),
            Method::Verlet => Box::new(split(Composition::Verlet, dt_s)?),
            Method::Yoshida4 => Box::new(split(Composition::Yoshida4, dt_s)?),
            Method::Yoshida6 => Box::new(split(Composition::Yoshida6, dt_s)?),
            Method::Xpbd => Box::new(Leaps::new(0.0, start.clone(), dt_s)?),
        },
        Steps::Adaptive { tolerance } => {
            let tolerance = Tolerance { rtol: T::from_f64(tolerance.rtol), atol: T::from_f64(tolerance.atol) };
            match solver.method {
                Method::Rk4Doubling => adaptive!(Rk4Doubling, tolerance),
                Method::CashKarp => adaptive!(CashKarp, tolerance),
                Method::Tsit5 => adaptive!(Tsit5, tolerance),
                Method::Dop853 => adaptive!(Dop853, tolerance),
                method => return Err(SolverError::NotAdaptive(method)),
            }
        }
    })
}

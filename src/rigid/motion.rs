//! Bodies in motion: a system with the method that was chosen for it.

use super::stepping::{AdaptiveSteps, Advance, Composed, FixedSteps};
use super::{
    Bodies, Forces, Form, Formulation, Inertia, Method, MotionError, Setup, Solver, SolverError, Steps, System, Totals,
    totals,
};
use crate::algebra::Real;
use crate::ode::{Adaptive, CashKarp, Dop853, OdeError, Rk4, Rk4Doubling, StepError, Tolerance, Tsit5, Work};
use alloc::boxed::Box;

/// Bodies that move: takes any state of theirs over any span of time.
///
/// The state is the caller's. What is kept beside it, like the next step of a method that chooses its steps, is used where
/// the caller goes on from where the last span ended.
pub struct Motion<T: Real> {
    system: System<T>,
    method: Box<dyn Advance<T>>,
    spans: u64,
}

impl<T: Real> Motion<T> {
    /// For as many bodies as there are in a state.
    ///
    /// # Errors
    /// A method that does not fit, a step or tolerance that cannot be used.
    pub fn new(setup: Setup<T>, bodies: &Bodies<T>, solver: &Solver) -> Result<Self, SolverError> {
        if !solver.method.fits(solver.form) {
            return Err(SolverError::DoesNotFit { method: solver.method, form: solver.form });
        }
        let system = System::new(setup, solver.method);
        let method = match solver.form {
            Form::Rotor => method::<Bodies<T>, T>(bodies, solver)?,
            form => return Err(SolverError::DoesNotFit { method: solver.method, form }),
        };
        Ok(Self { system, method, spans: 0 })
    }

    /// Takes bodies from a time over a span, s, in pieces between the times at which forces switch.
    ///
    /// # Errors
    /// A step that cannot be made. The bodies are then somewhere in between.
    pub fn advance(&mut self, bodies: &mut Bodies<T>, t_s: f64, span_s: f64) -> Result<(), OdeError<MotionError>> {
        let end_s = t_s + span_s;
        let mut from_s = t_s;
        for to_s in self.system.setup.forces.switches_within(t_s, end_s).into_iter().chain([end_s]) {
            // The only piece is the span itself, not a difference of absolute times, which would lose its digits.
            let piece_s = if from_s == t_s && to_s == end_s { span_s } else { to_s - from_s };
            self.system.select(from_s, to_s);
            self.method.advance(&mut self.system, bodies, from_s, piece_s)?;
            from_s = to_s;
        }
        self.spans += 1;
        Ok(())
    }

    /// Masses, forces, joints.
    #[must_use]
    pub fn setup(&self) -> &Setup<T> {
        &self.system.setup
    }

    /// Masses and inertias, one a body.
    #[must_use]
    pub fn inertias(&self) -> &[Inertia<T>] {
        &self.system.setup.inertias
    }

    /// Gravity and other forces.
    #[must_use]
    pub fn forces(&self) -> &Forces<T> {
        &self.system.setup.forces
    }

    /// Energy and momenta.
    #[must_use]
    pub fn totals(&self, bodies: &Bodies<T>) -> Totals {
        totals(bodies, self.inertias(), self.forces())
    }

    /// What it has cost.
    #[must_use]
    pub fn work(&self) -> Work {
        self.method.work()
    }
}

/// The method in a formulation.
fn method<F, T>(bodies: &Bodies<T>, solver: &Solver) -> Result<Box<dyn Advance<T>>, SolverError>
where
    T: Real,
    F: Formulation<T> + Send + Sync + 'static,
    F::Rate: Clone + Send + Sync,
{
    match solver.steps {
        Steps::Fixed { dt_s } => fixed::<F, T>(bodies, solver.method, dt_s),
        Steps::Adaptive { tolerance } => {
            let tolerance = Tolerance { rtol: T::from_f64(tolerance.rtol), atol: T::from_f64(tolerance.atol) };
            adaptive::<F, T>(bodies, solver.method, tolerance)
        }
    }
}

fn fixed<F, T>(bodies: &Bodies<T>, method: Method, dt_s: f64) -> Result<Box<dyn Advance<T>>, SolverError>
where
    T: Real,
    F: Formulation<T> + Send + Sync + 'static,
    F::Rate: Clone + Send + Sync,
{
    if !(dt_s > 0.0 && dt_s.is_finite()) {
        return Err(StepError { step_s: dt_s }.into());
    }
    if let Some(composition) = method.composition() {
        return Ok(Box::new(Composed::new(composition, bodies.len(), dt_s)));
    }
    Ok(match method {
        Method::CashKarp => Box::new(FixedSteps::<CashKarp, F, T>::new(bodies, dt_s)),
        Method::Tsit5 => Box::new(FixedSteps::<Tsit5, F, T>::new(bodies, dt_s)),
        Method::Dop853 => Box::new(FixedSteps::<Dop853, F, T>::new(bodies, dt_s)),
        _ => Box::new(FixedSteps::<Rk4, F, T>::new(bodies, dt_s)),
    })
}

fn adaptive<F, T>(
    bodies: &Bodies<T>,
    method: Method,
    tolerance: Tolerance<T>,
) -> Result<Box<dyn Advance<T>>, SolverError>
where
    T: Real,
    F: Formulation<T> + Send + Sync + 'static,
    F::Rate: Clone + Send + Sync,
{
    macro_rules! adaptive {
        ($method:ty) => {{
            let start = F::from_bodies(bodies);
            let rates = start.zero_rates();
            let stepper = Adaptive::<$method, F, T>::new(0.0, start, rates, tolerance)?;
            Box::new(AdaptiveSteps::<_, F, T>::new(stepper, bodies))
        }};
    }
    Ok(match method {
        Method::Rk4Doubling => adaptive!(Rk4Doubling),
        Method::CashKarp => adaptive!(CashKarp),
        Method::Tsit5 => adaptive!(Tsit5),
        Method::Dop853 => adaptive!(Dop853),
        method => return Err(SolverError::NotAdaptive(method)),
    })
}

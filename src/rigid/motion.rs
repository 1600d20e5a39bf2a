//! Bodies in motion: a system with the method that was chosen for it.

use super::flight::Flight;
#[cfg(feature = "study")]
use super::matrix;
use super::stepping::{AdaptiveSteps, Advance, Composed, FixedSteps};
use super::{
    Bodies, Forces, Form, Formulation, Inertia, Method, MotionError, Setup, Solver, SolverError, Steps, System, Totals,
    motor, quaternion, totals,
};
use crate::algebra::Real;
use crate::ode::lie::{CommutatorFree4, LieRungeKutta, LieState, LieStepper, Rkmk4};
use crate::ode::{
    Adaptive, CashKarp, Composition, Dop853, OdeError, Rk4, Rk4Doubling, RungeKutta, StepError, Tolerance, Tsit5, Work,
};
use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;

/// Steps by a tolerance from one state that is asked for to the next, at most: a few seconds of work for a body. What needs
/// more is too stiff for these methods, or the tolerance is.
const MAX_STEPS: u64 = 1_000_000;

/// Bodies that are solved alike.
struct Part<T: Real> {
    /// Of these bodies; the others stand still in it.
    system: System<T>,
    method: Box<dyn Advance<T>>,
    /// Which bodies; all of them where there is one part.
    bodies: Vec<usize>,
    /// These bodies where they are, the others where they were at the start.
    state: Bodies<T>,
}

/// Bodies that move: takes any state of theirs over any span of time.
///
/// The state is the caller's. What is kept beside it, like the next step of a method that chooses its steps, is used where
/// the caller goes on from where the last span ended.
pub struct Motion<T: Real> {
    setup: Setup<T>,
    parts: Vec<Part<T>>,
    /// One entry a body.
    forms: Vec<Form>,
}

impl<T: Real> Motion<T> {
    /// All bodies solved alike. Joints must be held at the start; velocities that they contradict change in the first step:
    /// see [`project_velocities`](Self::project_velocities).
    ///
    /// # Errors
    /// A method that does not fit, a step or tolerance that cannot be used.
    pub fn new(setup: Setup<T>, bodies: &Bodies<T>, solver: &Solver) -> Result<Self, SolverError> {
        Self::mixed(setup, bodies, &[(*solver, (0..bodies.len()).collect())])
    }

    /// Some bodies solved in one way, some in another. Every body is in one list; forces and joints stay within a list.
    ///
    /// # Errors
    /// As [`Motion::new`]; bodies that do not exist, bodies of two lists that something links.
    pub fn mixed(setup: Setup<T>, bodies: &Bodies<T>, lists: &[(Solver, Vec<usize>)]) -> Result<Self, SolverError> {
        setup.check(bodies.len(), lists.iter().flat_map(|(_, own)| own.iter().copied()))?;
        let mut forms = vec![Form::default(); bodies.len()];
        let mut parts = vec![];
        for (solver, own) in lists {
            if !solver.method.fits(solver.form) {
                return Err(SolverError::DoesNotFit { method: solver.method, form: solver.form });
            }
            let system = System::new(setup.of(own)?, bodies, solver);
            let system = system.map_err(|error| error.renumbered(|joint| setup.joint_of(own, joint)))?;
            if solver.method == Method::FreeFlight
                && !(system.setup.forces.forces.is_empty() && system.setup.joints.is_empty())
            {
                return Err(SolverError::NotFree);
            }
            let method = match solver.form {
                #[cfg(feature = "study")]
                Form::Matrix => linear::<matrix::State<T>, T>(bodies, solver)?,
                #[cfg(not(feature = "study"))]
                Form::Matrix => return Err(SolverError::ForStudies),
                Form::Quaternion => linear::<quaternion::State<T>, T>(bodies, solver)?,
                Form::Rotor => on_group::<Bodies<T>, T>(bodies, solver)?,
                Form::Motor => on_group::<motor::State<T>, T>(bodies, solver)?,
            };
            own.iter().for_each(|body_idx| forms[*body_idx] = solver.form);
            parts.push(Part { system, method, bodies: own.clone(), state: bodies.clone() });
        }
        Ok(Self { setup, parts, forms })
    }

    /// Takes bodies from a time over a span, s, in pieces between the times at which forces switch.
    ///
    /// # Errors
    /// A step that cannot be made. The bodies are then somewhere in between.
    pub fn advance(&mut self, bodies: &mut Bodies<T>, t_s: f64, span_s: f64) -> Result<(), OdeError<MotionError>> {
        if let [all] = self.parts.as_mut_slice() {
            return all.advance(bodies, t_s, span_s);
        }
        for part in &mut self.parts {
            let mut state = core::mem::take(&mut part.state);
            part.bodies.iter().for_each(|body_idx| state.assign_body(*body_idx, bodies));
            let done = part.advance(&mut state, t_s, span_s);
            part.bodies.iter().for_each(|body_idx| bodies.assign_body(*body_idx, &state));
            part.state = state;
            done.map_err(|error| match error {
                OdeError::System(error) => {
                    OdeError::System(error.renumbered(|joint| self.setup.joint_of(&part.bodies, joint)))
                }
                error => error,
            })?;
        }
        Ok(())
    }

    /// How the motion of a body is written.
    #[must_use]
    pub fn form_of(&self, body_idx: usize) -> Form {
        self.forms.get(body_idx).copied().unwrap_or_default()
    }

    /// Masses, forces, joints.
    #[must_use]
    pub fn setup(&self) -> &Setup<T> {
        &self.setup
    }

    /// Masses and inertias, one a body.
    #[must_use]
    pub fn inertias(&self) -> &[Inertia<T>] {
        &self.setup.inertias
    }

    /// Gravity and other forces.
    #[must_use]
    pub fn forces(&self) -> &Forces<T> {
        &self.setup.forces
    }

    /// Momenta such that the joints stay held, as after an impact that took no account of them.
    ///
    /// # Errors
    /// A state that is not finite.
    pub fn project_velocities(&mut self, bodies: &mut Bodies<T>, time_s: f64) -> Result<(), MotionError> {
        for part in &mut self.parts {
            let projected = part.system.held.project_velocities(bodies);
            let failed = |source| MotionError::Multipliers { time_s, source };
            projected.map_err(|source| failed(source).renumbered(|joint| self.setup.joint_of(&part.bodies, joint)))?;
        }
        Ok(())
    }

    /// The worst violation of a joint, m; none without joints. See [`Held::worst_violation`](super::Held).
    pub fn worst_violation(&mut self, bodies: &Bodies<T>) -> Option<f64> {
        let worst = self.parts.iter_mut().filter_map(|part| part.system.held.worst_violation(bodies));
        worst.map(|(_, violation_m)| violation_m).reduce(f64::max)
    }

    /// The violation that is asked for, m; none without joints.
    #[must_use]
    pub fn asked_violation_m(&self) -> Option<f64> {
        let held = self.parts.iter().map(|part| &part.system.held).filter(|held| !held.is_empty());
        held.map(super::Held::asked_violation_m).reduce(f64::max)
    }

    /// The most rows of joints that were found redundant at a time; they get no force.
    #[must_use]
    pub fn redundant(&self) -> usize {
        self.parts.iter().map(|part| part.system.held.redundant()).sum()
    }

    /// Drifts of compositions in which joints turned too far for RATTLE; see [`System::redirected`].
    #[must_use]
    pub fn redirected(&self) -> u64 {
        self.parts.iter().map(|part| part.system.redirected()).sum()
    }

    /// Energy and momenta.
    #[must_use]
    pub fn totals(&self, bodies: &Bodies<T>) -> Totals {
        totals(bodies, self.inertias(), self.forces())
    }

    /// What it has cost.
    #[must_use]
    pub fn work(&self) -> Work {
        self.parts.iter().map(|part| part.method.work()).fold(Work::default(), |sum, work| Work {
            rhs_evals: sum.rhs_evals + work.rhs_evals,
            accepted: sum.accepted + work.accepted,
            rejected: sum.rejected + work.rejected,
        })
    }
}

impl<T: Real> Part<T> {
    fn advance(&mut self, bodies: &mut Bodies<T>, t_s: f64, span_s: f64) -> Result<(), OdeError<MotionError>> {
        let end_s = t_s + span_s;
        let mut from_s = t_s;
        for to_s in self.system.setup.forces.switches_within(t_s, end_s).into_iter().chain([end_s]) {
            // The only piece is the span itself, not a difference of absolute times, which would lose its digits.
            let piece_s = if from_s == t_s && to_s == end_s { span_s } else { to_s - from_s };
            if self.system.select(from_s, to_s) {
                self.method.restart();
            }
            self.method.advance(&mut self.system, bodies, from_s, piece_s)?;
            from_s = to_s;
        }
        Ok(())
    }
}

type Solved<T> = Result<Box<dyn Advance<T>>, SolverError>;

/// The method in a formulation on a group, or one that is of this formulation alone.
fn on_group<F, T>(bodies: &Bodies<T>, solver: &Solver) -> Solved<T>
where
    T: Real,
    F: Formulation<T> + LieState<T> + Send + Sync + 'static,
    F::Rate: Clone + Send + Sync,
{
    let fixed_step = |dt_s| StepError::check(dt_s);
    match (solver.method, solver.steps) {
        (Method::FreeFlight, _) => Ok(Box::new(Flight::new())),
        (method, Steps::Fixed { dt_s }) if method.composition().is_some() => {
            let composition = method.composition().unwrap_or(Composition::Verlet);
            Ok(Box::new(Composed::new(composition, method.splits(), bodies.len(), fixed_step(dt_s)?)))
        }
        (Method::Rkmk4, Steps::Fixed { dt_s }) => {
            let make = LieRungeKutta::<Rkmk4, F, T>::new;
            Ok(Box::new(FixedSteps::new(bodies, fixed_step(dt_s)?, make)))
        }
        (Method::CommutatorFree, Steps::Fixed { dt_s }) => {
            let make = LieRungeKutta::<CommutatorFree4, F, T>::new;
            Ok(Box::new(FixedSteps::new(bodies, fixed_step(dt_s)?, make)))
        }
        (Method::CommutatorFree, Steps::Adaptive { tolerance }) => {
            let start = F::from_bodies(bodies);
            let rates = start.zero_rates();
            let stepper = LieStepper::<CommutatorFree4, F, T>::adaptive(0.0, start, rates, in_scalar(tolerance))?;
            Ok(Box::new(AdaptiveSteps::<_, F, T>::new(stepper.with_max_steps(MAX_STEPS), bodies)))
        }
        _ => linear::<F, T>(bodies, solver),
    }
}

/// The method in a formulation whose numbers are added like those of a vector, and brought back after a step.
fn linear<F, T>(bodies: &Bodies<T>, solver: &Solver) -> Solved<T>
where
    T: Real,
    F: Formulation<T> + Send + Sync + 'static,
    F::Rate: Clone + Send + Sync,
{
    macro_rules! fixed {
        ($method:ty, $dt_s:expr) => {
            Box::new(FixedSteps::new(bodies, StepError::check($dt_s)?, RungeKutta::<$method, F, T>::new))
        };
    }
    macro_rules! adaptive {
        ($method:ty, $tolerance:expr) => {{
            let start = F::from_bodies(bodies);
            let rates = start.zero_rates();
            let stepper = Adaptive::<$method, F, T>::new(0.0, start, rates, in_scalar($tolerance))?;
            Box::new(AdaptiveSteps::<_, F, T>::new(stepper.with_max_steps(MAX_STEPS), bodies))
        }};
    }
    Ok(match (solver.method, solver.steps) {
        (Method::Rk4 | Method::Rk4Doubling, Steps::Fixed { dt_s }) => fixed!(Rk4, dt_s),
        (Method::CashKarp, Steps::Fixed { dt_s }) => fixed!(CashKarp, dt_s),
        (Method::Tsit5, Steps::Fixed { dt_s }) => fixed!(Tsit5, dt_s),
        (Method::Dop853, Steps::Fixed { dt_s }) => fixed!(Dop853, dt_s),
        (Method::Rk4Doubling, Steps::Adaptive { tolerance }) => adaptive!(Rk4Doubling, tolerance),
        (Method::CashKarp, Steps::Adaptive { tolerance }) => adaptive!(CashKarp, tolerance),
        (Method::Tsit5, Steps::Adaptive { tolerance }) => adaptive!(Tsit5, tolerance),
        (Method::Dop853, Steps::Adaptive { tolerance }) => adaptive!(Dop853, tolerance),
        (method, Steps::Adaptive { .. }) => return Err(SolverError::NotAdaptive(method)),
        (method, Steps::Fixed { .. }) => return Err(SolverError::DoesNotFit { method, form: solver.form }),
    })
}

fn in_scalar<T: Real>(tolerance: Tolerance<f64>) -> Tolerance<T> {
    Tolerance { rtol: T::from_f64(tolerance.rtol), atol: T::from_f64(tolerance.atol) }
}

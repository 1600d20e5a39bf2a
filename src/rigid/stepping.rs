//! Ways to take bodies over a span of time. Each is a map: it goes on from whatever state it is given, so that a search for
//! impacts can try spans from one state.

use super::{Bodies, Formulation, Inertia, MotionError, System, Wrenches};
use crate::algebra::Real;
use crate::ode::lie::{LieMethod, LieRungeKutta, LieState};
use crate::ode::{self, Composition, OdeError, RungeKutta, Stepper, Tableau, Work};

/// A map of bodies over spans in which no force switches.
pub(super) trait Advance<T: Real>: Send + Sync {
    /// Takes bodies from a time over a span, s.
    fn advance(
        &mut self,
        system: &mut System<T>,
        bodies: &mut Bodies<T>,
        t_s: f64,
        span_s: f64,
    ) -> Result<(), OdeError<MotionError>>;

    /// Other forces act from here on: a step that went past this time is of no use.
    fn restart(&mut self) {}

    /// What it has cost.
    fn work(&self) -> Work;
}

/// A span longer than whole steps by no more than this many eps of the times that it is a difference of is made of whole
/// steps: a caller that goes from 59.98 s to 60 s wants one step of 0.02 s, whatever rounding makes of the difference.
const WHOLE_EPS: f64 = 8.0;

/// How many steps of at most `dt_s` make a span from a time, and how long they are.
fn divide(t_s: f64, span_s: f64, dt_s: f64) -> (u64, f64) {
    let rounding_s = WHOLE_EPS * f64::EPSILON * (t_s.abs() + span_s);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a positive number of steps, saturating"
    )]
    let count = ((span_s - rounding_s) / dt_s).ceil().max(1.0) as u64;
    (count, span_s / count as f64)
}

/// The largest turn in a step of a Runge-Kutta method or of a splitting, rad, of the body or of its angular velocity within
/// it. RK4 is stable to 2.8 and errs by `(1/2)^5 / 120` here, 3e-4 rad a step.
const MAX_TURN_RAD: f64 = 1.0;

/// Refuses steps in which a body turns too far by its `rate`, rad/s, at the start of a span. What spins up within a span of
/// many steps shows at the start of the next.
fn check_turns<T: Real>(
    bodies: &Bodies<T>,
    inertias: &[Inertia<T>],
    (time_s, dt_s): (f64, f64),
    rate: fn([f64; 3], [f64; 3]) -> f64,
) -> Result<(), OdeError<MotionError>> {
    for (body_idx, inertia) in inertias.iter().enumerate().filter(|(_, inertia)| !inertia.is_immovable()) {
        let to_principal = (bodies.rotor[body_idx].map(Real::to_f64) * inertia.principal.axes).rev();
        let momentum = to_principal.apply(bodies.angular_momentum[body_idx].map(Real::to_f64));
        let turn_rad = dt_s.abs() * rate(momentum.into(), inertia.principal.moments);
        if !(turn_rad <= MAX_TURN_RAD) {
            return Err(OdeError::System(MotionError::Spin { body_idx, time_s, turn_rad, dt_s }));
        }
    }
    Ok(())
}

/// The angular velocity or, if that is more, the rate at which it wobbles about where it is: the eigenvalues of Euler's
/// equations `Li' = ci Lj Lk`, linearised, are at most `sqrt(c2 c3 L1² + c3 c1 L2² + c1 c2 L3²)`, and at most sqrt 2 times
/// the root of the largest term, which stands for them here: a rate short of them by that is far inside of what is stable.
fn turn_or_wobble(momentum: [f64; 3], moments: [f64; 3]) -> f64 {
    let [b1, b2, b3] = moments.map(f64::recip);
    let [l1, l2, l3] = momentum;
    let spin = (b1 * l1).hypot(b2 * l2).hypot(b3 * l3);
    let (c1, c2, c3) = (b2 - b3, b1 - b3, b1 - b2);
    spin.max((c2 * c3).sqrt() * l1.abs()).max((c3 * c1).sqrt() * l2.abs()).max((c1 * c2).sqrt() * l3.abs())
}

/// What a splitting turns by: the parts of a step leave the momentum along any of the axes, that of the smallest moment too.
fn any_axis(momentum: [f64; 3], moments: [f64; 3]) -> f64 {
    let [l1, l2, l3] = momentum;
    l1.hypot(l2).hypot(l3) / moments[0]
}

/// A method with its storage, that makes single steps.
pub(super) trait OneStep<F, T: Real> {
    /// Evaluations of the equations of motion a step.
    const STAGES: u64;

    fn step(&mut self, state: &mut F, t_s: f64, h_s: f64, system: &mut System<T>) -> Result<(), MotionError>;
}

impl<M: Tableau, F: Formulation<T>, T: Real> OneStep<F, T> for RungeKutta<M, F, T> {
    const STAGES: u64 = 1 + M::COEFFICIENTS.stages.len() as u64;

    fn step(&mut self, state: &mut F, t_s: f64, h_s: f64, system: &mut System<T>) -> Result<(), MotionError> {
        Self::step(self, state, t_s, h_s, system)
    }
}

impl<M: LieMethod, F: Formulation<T> + LieState<T>, T: Real> OneStep<F, T> for LieRungeKutta<M, F, T> {
    const STAGES: u64 = 4;

    fn step(&mut self, state: &mut F, t_s: f64, h_s: f64, system: &mut System<T>) -> Result<(), MotionError> {
        Self::step(self, state, t_s, h_s, system)
    }
}

/// Steps of one length at most.
pub(super) struct FixedSteps<M, F> {
    method: M,
    state: F,
    dt_s: f64,
    work: Work,
}

impl<M, F> FixedSteps<M, F> {
    /// `make` gets the state, and rates of its size.
    pub(super) fn new<T: Real>(bodies: &Bodies<T>, dt_s: f64, make: impl FnOnce(F, F::Rate) -> M) -> Self
    where
        F: Formulation<T>,
    {
        let state = F::from_bodies(bodies);
        Self { method: make(state.clone(), state.zero_rates()), state, dt_s, work: Work::default() }
    }
}

impl<M, F, T: Real> Advance<T> for FixedSteps<M, F>
where
    F: Formulation<T>,
    M: OneStep<F, T>,
    Self: Send + Sync,
{
    fn advance(
        &mut self,
        system: &mut System<T>,
        bodies: &mut Bodies<T>,
        t_s: f64,
        span_s: f64,
    ) -> Result<(), OdeError<MotionError>> {
        let (count, h_s) = divide(t_s, span_s, self.dt_s);
        check_turns(bodies, &system.setup.inertias, (t_s, h_s), turn_or_wobble)?;
        self.state.read_from(bodies);
        for index in 0..count {
            let start_s = t_s + h_s * index as f64;
            self.method.step(&mut self.state, start_s, h_s, system).map_err(OdeError::System)?;
            let settled = ode::System::<F, T>::settle(system, start_s + h_s, &mut self.state);
            settled.map_err(OdeError::System)?;
        }
        self.work.accepted += count;
        self.work.rhs_evals += count * M::STAGES;
        self.state.write_to(bodies);
        Ok(())
    }

    fn work(&self) -> Work {
        self.work
    }
}

/// A stepper that chooses its steps. It goes on from within its last step where it is asked to go on from where it was.
pub(super) struct AdaptiveSteps<S, F, T> {
    stepper: S,
    out: F,
    /// When and with what the last span ended.
    last: Option<(f64, Bodies<T>)>,
}

impl<S, F: Formulation<T>, T: Real> AdaptiveSteps<S, F, T> {
    pub(super) fn new(stepper: S, bodies: &Bodies<T>) -> Self {
        Self { stepper, out: F::from_bodies(bodies), last: None }
    }
}

/// The time of a state that is gone on from differs from its end by the rounding of sums.
const SAME_TIME_EPS: f64 = 8.0;

/// Whether a state at a time is where another ended.
pub(super) fn goes_on<T: Real>(last: &Option<(f64, Bodies<T>)>, t_s: f64, bodies: &Bodies<T>) -> bool {
    let same_time = |at_s: f64| (at_s - t_s).abs() <= SAME_TIME_EPS * f64::EPSILON * t_s.abs();
    last.as_ref().is_some_and(|(at_s, state)| same_time(*at_s) && state == bodies)
}

impl<S, F, T: Real> Advance<T> for AdaptiveSteps<S, F, T>
where
    F: Formulation<T>,
    S: Stepper<System<T>, State = F, Error = MotionError>,
    Self: Send + Sync,
{
    fn advance(
        &mut self,
        system: &mut System<T>,
        bodies: &mut Bodies<T>,
        t_s: f64,
        span_s: f64,
    ) -> Result<(), OdeError<MotionError>> {
        let from_s = match &self.last {
            Some((at_s, _)) if goes_on(&self.last, t_s, bodies) => *at_s,
            _ => {
                self.out.read_from(bodies);
                self.stepper.restart(t_s, &self.out);
                t_s
            }
        };
        let end_s = from_s + span_s;
        self.last = None;
        if !F::INTERPOLATES {
            self.stepper.stop_at(end_s);
        }
        self.stepper.advance_to(system, end_s, &mut self.out)?;
        self.out.write_to(bodies);
        self.last = Some((end_s, bodies.clone()));
        Ok(())
    }

    fn restart(&mut self) {
        self.last = None;
    }

    fn work(&self) -> Work {
        self.stepper.work()
    }
}

/// Free motions and kicks in turn.
pub(super) struct Composed<T> {
    composition: Composition,
    first: Wrenches<T>,
    last: Wrenches<T>,
    /// The free motion is split into rotations, which must be short.
    splits: bool,
    dt_s: f64,
    work: Work,
}

impl<T: Real> Composed<T> {
    pub(super) fn new(composition: Composition, splits: bool, bodies: usize, dt_s: f64) -> Self {
        let wrenches = Wrenches::zeros(bodies);
        Self { composition, first: wrenches.clone(), last: wrenches, splits, dt_s, work: Work::default() }
    }
}

impl<T: Real> Advance<T> for Composed<T> {
    fn advance(
        &mut self,
        system: &mut System<T>,
        bodies: &mut Bodies<T>,
        t_s: f64,
        span_s: f64,
    ) -> Result<(), OdeError<MotionError>> {
        let (count, h_s) = divide(t_s, span_s, self.dt_s);
        if self.splits {
            check_turns(bodies, &system.setup.inertias, (t_s, h_s), any_axis)?;
        }
        system.wrenches(bodies, &mut self.first);
        for index in 0..count {
            let start_s = t_s + h_s * index as f64;
            let span = (start_s, h_s);
            let done = self.composition.apply(system, span, bodies, &self.first, &mut self.last);
            done.map_err(OdeError::System)?;
            core::mem::swap(&mut self.first, &mut self.last);
        }
        self.work.accepted += count;
        self.work.rhs_evals += 1 + count * self.composition.weights().len() as u64;
        Ok(())
    }

    fn work(&self) -> Work {
        self.work
    }
}

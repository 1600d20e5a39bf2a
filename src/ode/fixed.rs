//! Steps of one length.

use super::segment::Segment;
use super::stepper::MAX_STEPS;
use super::{Controlled, OdeError, Run, State, StepError, Stepper, System, Tableau, Tolerance, Work};
use crate::algebra::Real;

/// Times at equal distances, each computed from the start: a sum of steps would gather rounding.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ticks {
    step_s: f64,
    start_s: f64,
    taken: u64,
    stop_s: f64,
}

impl Ticks {
    pub(super) fn new(start_s: f64, step_s: f64) -> Result<Self, StepError> {
        Ok(Self { step_s: StepError::check(step_s)?, start_s, taken: 0, stop_s: f64::INFINITY })
    }

    pub(super) fn restart(&mut self, start_s: f64) {
        (self.start_s, self.taken) = (start_s, 0);
    }

    pub(super) fn stop_at(&mut self, stop_s: f64) {
        self.stop_s = stop_s;
    }

    /// The end and the length of the next step from a time; shorter before a stop.
    #[expect(clippy::cast_precision_loss, reason = "2^53 steps take years")]
    pub(super) fn next<E>(&self, from_s: f64) -> Result<(f64, f64), OdeError<E>> {
        if from_s >= self.stop_s {
            return Err(OdeError::Stopped { stop_s: self.stop_s });
        }
        let to_s = self.start_s + (self.taken + 1) as f64 * self.step_s;
        let (to_s, h_s) = if to_s >= self.stop_s { (self.stop_s, self.stop_s - from_s) } else { (to_s, self.step_s) };
        if !(to_s > from_s && h_s > 0.0) {
            return Err(OdeError::StepTooSmall { time_s: from_s, step_s: h_s });
        }
        Ok((to_s, h_s))
    }

    /// The step has been taken.
    pub(super) fn took(&mut self, to_s: f64) {
        if to_s == self.stop_s {
            self.restart(to_s);
        } else {
            self.taken += 1;
        }
    }
}

/// Integrates with steps of one length, `Fixed::<Rk4, _, _>`.
#[derive(Clone, Debug)]
pub struct Fixed<M: Tableau, S: State<T>, T> {
    segment: Segment<M, S, T, M::Rates<S::Rate>>,
    ticks: Ticks,
    max_steps: u64,
}

impl<M: Tableau, T: Real, S: State<T> + Clone> Fixed<M, S, T> {
    /// Starts at a time with a state; `rate` is storage of the size of a rate, whatever it holds.
    ///
    /// # Errors
    /// A step that is not positive and finite.
    pub fn new(t_s: f64, state: S, rate: S::Rate, step_s: f64) -> Result<Self, StepError>
    where
        S::Rate: Clone,
    {
        Ok(Self { segment: Segment::new(t_s, state, rate), ticks: Ticks::new(t_s, step_s)?, max_steps: MAX_STEPS })
    }

    /// With at most so many steps between two outputs.
    #[must_use]
    pub fn with_max_steps(mut self, steps: u64) -> Self {
        self.max_steps = steps;
        self
    }
}

impl<M: Tableau, T: Real, S: Controlled<T>> Fixed<M, S, T> {
    /// A rate that is no number is the first that shows of a solution out of range.
    #[inline(always)]
    fn check_finite<E>(&self, step_s: f64) -> Result<(), OdeError<E>> {
        let any = Tolerance { rtol: T::one(), atol: T::one() };
        let state = &self.segment.state;
        if state.error_ratio(state, &[(T::one(), self.segment.end_rate())], any).is_finite() {
            return Ok(());
        }
        Err(OdeError::NotFinite { time_s: self.segment.time_s, step_s })
    }

    #[inline(always)]
    fn try_step<Y: System<S, T> + ?Sized>(
        &mut self,
        to_s: f64,
        h_s: f64,
        system: &mut Y,
    ) -> Result<(), OdeError<Y::Error>> {
        self.segment.attempt(h_s, false, system).map_err(OdeError::System)?;
        self.segment.accept(to_s, false, system).map_err(OdeError::System)?;
        self.check_finite(h_s)
    }
}

impl<M: Tableau, T: Real, S: Controlled<T>, Y: System<S, T> + ?Sized> Stepper<Y> for Fixed<M, S, T> {
    type Error = Y::Error;

    #[inline]
    fn step(&mut self, system: &mut Y) -> Result<(), OdeError<Y::Error>> {
        let (to_s, h_s) = self.ticks.next(self.segment.time_s)?;
        self.segment.know_end(system).map_err(OdeError::System)?;
        self.segment.begin();
        let done = self.try_step(to_s, h_s, system);
        if done.is_err() {
            self.segment.abandon();
        } else {
            self.ticks.took(to_s);
        }
        done
    }

    fn interpolate(&mut self, system: &mut Y, t_s: f64, out: &mut S) -> Result<(), OdeError<Y::Error>> {
        self.segment.interpolate(t_s, out, system)
    }
}

impl<M: Tableau, T: Real, S: State<T>> Run for Fixed<M, S, T> {
    type State = S;

    fn start_s(&self) -> f64 {
        self.segment.from_s
    }

    fn time_s(&self) -> f64 {
        self.segment.time_s
    }

    fn state(&self) -> &S {
        &self.segment.state
    }

    fn work(&self) -> Work {
        self.segment.work
    }

    fn max_steps(&self) -> u64 {
        self.max_steps
    }

    fn restart(&mut self, t_s: f64, state: &S) {
        self.segment.restart(t_s, state);
        self.ticks.restart(t_s);
    }

    fn stop_at(&mut self, t_s: f64) {
        self.ticks.stop_at(t_s);
    }
}

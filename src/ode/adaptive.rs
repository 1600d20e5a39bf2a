//! Steps as long as the tolerance allows.

use super::control::{Controller, first_guess, first_step};
use super::segment::Segment;
use super::stepper::MAX_STEPS;
use super::{Controlled, Embedded, OdeError, Run, State, StepError, Stepper, System, Tolerance, ToleranceError, Work};
use crate::algebra::Real;

/// A remainder before a stop is taken whole if it is at most this much longer than the step: a step of a hundredth
/// would cost as much as a whole one.
const LAST_STEP: f64 = 1.01;

/// The time resolves a step that comes out within this part of it. Coarser, a step that failed could come out as long
/// again.
const RESOLVED: f64 = 0.1;

/// Integrates with a method that estimates its error, `Adaptive::<Dop853, _, _>`.
#[derive(Clone, Debug)]
pub struct Adaptive<M: Embedded, S: State<T>, T> {
    segment: Segment<M, S, T, M::Rates<S::Rate>>,
    tolerance: Tolerance<T>,
    controller: Controller,
    /// The next step, if it is known.
    next_s: Option<f64>,
    max_step_s: f64,
    stop_s: f64,
    max_steps: u64,
}

impl<M: Embedded, T: Real, S: State<T> + Clone> Adaptive<M, S, T> {
    /// Starts at a time with a state; `rate` is storage of the size of a rate, whatever it holds.
    ///
    /// # Errors
    /// A tolerance below what the numbers resolve.
    pub fn new(t_s: f64, state: S, rate: S::Rate, tolerance: Tolerance<T>) -> Result<Self, ToleranceError>
    where
        S::Rate: Clone,
    {
        Ok(Self {
            segment: Segment::new(t_s, state, rate),
            tolerance: tolerance.check()?,
            controller: Controller::new(M::ERROR_ORDER),
            next_s: None,
            max_step_s: f64::INFINITY,
            stop_s: f64::INFINITY,
            max_steps: MAX_STEPS,
        })
    }

    /// With a first step of the caller's instead of an estimated one.
    ///
    /// # Errors
    /// A step that is not positive and finite.
    pub fn with_first_step(mut self, step_s: f64) -> Result<Self, StepError> {
        self.next_s = Some(StepError::check(step_s)?);
        Ok(self)
    }

    /// With no step longer than this: for right-hand sides with short events that a long step would not see.
    ///
    /// # Errors
    /// A step that is not positive and finite.
    pub fn with_max_step(mut self, step_s: f64) -> Result<Self, StepError> {
        self.max_step_s = StepError::check(step_s)?;
        Ok(self)
    }

    /// With at most so many steps taken between two outputs; trials that failed do not count.
    #[must_use]
    pub fn with_max_steps(mut self, steps: u64) -> Self {
        self.max_steps = steps;
        self
    }
}

impl<M: Embedded, T: Real, S: Controlled<T>> Adaptive<M, S, T> {
    /// The first step, from the size of the rate and its change over a short step of Euler's.
    #[cold]
    fn estimate_first<Y: System<S, T> + ?Sized>(&mut self, system: &mut Y) -> Result<f64, Y::Error> {
        let (one, tolerance) = (T::one(), self.tolerance);
        let segment = &mut self.segment;
        let ratio = |segment: &Segment<M, S, T, M::Rates<S::Rate>>, terms: &[(T, &S::Rate)]| {
            segment.state.error_ratio(&segment.state, terms, tolerance).to_f64()
        };
        let rate = ratio(segment, &[(one, segment.end_rate())]);
        let guess = first_guess(rate, tolerance.rtol.to_f64()).min(self.max_step_s);
        segment.trial_rate(guess, system)?;
        let trial = &segment.rates().as_ref()[0];
        let change = ratio(segment, &[(one, trial), (-one, segment.end_rate())]) / guess;
        let step = first_step(guess, rate, if change.is_finite() { change } else { f64::MAX }, M::ORDER);
        Ok(step.min(self.max_step_s))
    }

    /// Tries steps until one is good; its end and the step.
    #[inline(always)]
    fn search<Y: System<S, T> + ?Sized>(&mut self, mut wanted: f64, system: &mut Y) -> Result<f64, OdeError<Y::Error>> {
        let from_s = self.segment.from_s;
        let left = self.stop_s - from_s;
        if left <= 0.0 {
            return Err(OdeError::Stopped { stop_s: self.stop_s });
        }
        // At time 0 every step is resolved, but the shortest there are cannot become shorter.
        let mut failed_s = f64::INFINITY;
        loop {
            let last = left <= LAST_STEP * wanted;
            let to_s = if last { self.stop_s } else { from_s + wanted };
            // What the time really moves by.
            let h_s = to_s - from_s;
            if !(h_s > 0.0 && h_s < failed_s) || !last && (h_s - wanted).abs() > RESOLVED * wanted {
                return Err(OdeError::StepTooSmall { time_s: from_s, step_s: wanted });
            }
            self.segment.attempt(h_s, M::ERROR_AT_END, system).map_err(OdeError::System)?;
            let segment = &self.segment;
            let ratio = M::error_ratio(segment.rates(), &segment.before, &segment.state, h_s, self.tolerance);
            if ratio <= 1.0 {
                let next = if last {
                    self.controller.cut_short(ratio, h_s, wanted)
                } else {
                    self.controller.accepted(ratio, h_s)
                };
                self.next_s = Some(next.min(self.max_step_s));
                return Ok(to_s);
            }
            self.segment.work.rejected += 1;
            failed_s = h_s;
            wanted = self.controller.rejected(ratio, h_s);
        }
    }
}

impl<M: Embedded, T: Real, S: Controlled<T>, Y: System<S, T> + ?Sized> Stepper<Y> for Adaptive<M, S, T> {
    type Error = Y::Error;

    #[inline]
    fn step(&mut self, system: &mut Y) -> Result<(), OdeError<Y::Error>> {
        self.segment.know_end(system).map_err(OdeError::System)?;
        let wanted = match self.next_s {
            Some(step) => step,
            None => self.estimate_first(system).map_err(OdeError::System)?,
        };
        self.segment.begin();
        let found = self.search(wanted, system);
        let done = found.and_then(|to_s| self.segment.accept(to_s, M::ERROR_AT_END, system).map_err(OdeError::System));
        if done.is_err() {
            self.segment.abandon();
        }
        done
    }

    fn interpolate(&mut self, system: &mut Y, t_s: f64, out: &mut S) -> Result<(), OdeError<Y::Error>> {
        self.segment.interpolate(t_s, out, system)
    }
}

impl<M: Embedded, T: Real, S: State<T>> Run for Adaptive<M, S, T> {
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
        self.controller = Controller::new(M::ERROR_ORDER);
        self.next_s = None;
    }

    fn stop_at(&mut self, t_s: f64) {
        self.stop_s = t_s;
    }
}

//! What all integrators have in common: steps, the state at any time within the last step, counters; and what follows
//! from these: output at given times, events.

use super::{Hit, OdeError, Watch};

/// What a run has cost so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Evaluations of the right-hand side, or of the acceleration.
    pub rhs_evals: u64,
    /// Steps taken.
    pub accepted: u64,
    /// Steps tried and found too long.
    pub rejected: u64,
}

/// Steps that [`Stepper::advance_to`] takes at most, unless the integrator is told otherwise: half a minute of the
/// cheapest there are. A run that needs more on the way to one output does not go as it should.
pub const MAX_STEPS: u64 = 100_000_000;

/// A run of steps, whatever it integrates.
pub trait Run {
    /// The state.
    type State;

    /// The start of the last step, s.
    fn start_s(&self) -> f64;
    /// The end of the last step, s.
    fn time_s(&self) -> f64;
    /// The state at the end of the last step.
    fn state(&self) -> &Self::State;
    /// What it has cost.
    fn work(&self) -> Work;
    /// Steps that one call of [`Stepper::advance_to`] takes at most.
    fn max_steps(&self) -> u64;
    /// Continues from another time and state, as after an impact. Counters go on.
    fn restart(&mut self, t_s: f64, state: &Self::State);
    /// No step goes past this time, because the right-hand side jumps there. To go on, let it jump and
    /// [restart](Self::restart), for the rate at the end of a step is kept for the next. Infinity: no such time.
    fn stop_at(&mut self, t_s: f64);
}

/// An integrator of systems `Y`. Where the method is chosen at run time: `Box<dyn Stepper<Y, State = S, Error = E>>`.
pub trait Stepper<Y: ?Sized>: Run {
    /// Why the system cannot go on.
    type Error;

    /// Makes one step, not past [`stop_at`](Run::stop_at).
    ///
    /// # Errors
    /// A step that cannot be made. The state is then that before the step.
    fn step(&mut self, system: &mut Y) -> Result<(), OdeError<Self::Error>>;

    /// The state at a time within the last step, by dense output.
    ///
    /// # Errors
    /// A time outside of the last step; those of the system.
    fn interpolate(&mut self, system: &mut Y, t_s: f64, out: &mut Self::State) -> Result<(), OdeError<Self::Error>>;

    /// Steps until the time is reached or passed.
    ///
    /// # Errors
    /// A step that cannot be made, too many of them.
    fn pass(&mut self, system: &mut Y, t_s: f64) -> Result<(), OdeError<Self::Error>> {
        let (start_s, mut steps) = (self.time_s(), 0);
        while self.time_s() < t_s {
            if steps == self.max_steps() {
                return Err(OdeError::TooManySteps { steps, from_s: start_s, time_s: self.time_s(), to_s: t_s });
            }
            self.step(system)?;
            steps += 1;
        }
        Ok(())
    }

    /// Steps until the time is reached, and writes the state there. The last step may end later; it is not wasted, but
    /// gone on from.
    ///
    /// # Errors
    /// A step that cannot be made, too many of them, a time before the last step.
    fn advance_to(&mut self, system: &mut Y, t_s: f64, out: &mut Self::State) -> Result<(), OdeError<Self::Error>> {
        self.pass(system, t_s)?;
        self.interpolate(system, t_s, out)
    }

    /// As [`advance_to`](Self::advance_to), but stops at the first event that ends it; `out` is then the state there.
    /// Events that end nothing are told to `seen`, with the state, in the order of time.
    ///
    /// # Errors
    /// Those of `advance_to`.
    fn advance_watching(
        &mut self,
        system: &mut Y,
        t_s: f64,
        watch: &mut Watch<'_, Self::State>,
        out: &mut Self::State,
        seen: &mut dyn FnMut(Hit, &Self::State),
    ) -> Result<Option<Hit>, OdeError<Self::Error>> {
        let (start_s, mut steps) = (self.time_s(), 0);
        loop {
            if let Some(hit) = watch.scan(self, system, t_s, out, seen)? {
                return Ok(Some(hit));
            }
            if self.time_s() >= t_s {
                break;
            }
            if steps == self.max_steps() {
                return Err(OdeError::TooManySteps { steps, from_s: start_s, time_s: self.time_s(), to_s: t_s });
            }
            self.step(system)?;
            steps += 1;
        }
        self.interpolate(system, t_s, out)?;
        Ok(None)
    }
}

//! Steps of one length by a map of one's own, for methods that are no Runge-Kutta method nor a splitting: a stepper of
//! it, with output and events like the others.

use super::fixed::Ticks;
use super::stepper::MAX_STEPS;
use super::{OdeError, Run, StepError, Stepper, Work};

/// A system that knows how to step by itself.
pub trait Leap<S> {
    /// Why a step cannot be made.
    type Error;

    /// Takes the state from a time over a step, s.
    ///
    /// # Errors
    /// What the system says. It ends the step; the state is then that before the step, whatever was left in it.
    fn leap(&mut self, t_s: f64, state: &mut S, h_s: f64) -> Result<(), Self::Error>;

    /// The state at a part of a step, 0 at its start, 1 at its end. (A shorter leap would not do: one that corrects
    /// positions finds velocities by dividing by its time.)
    fn between(&mut self, start: &S, end: &S, part: f64, out: &mut S);
}

/// Makes a system leap.
#[derive(Clone, Debug)]
pub struct Leaps<S> {
    ticks: Ticks,
    from_s: f64,
    before: S,
    time_s: f64,
    state: S,
    work: Work,
    max_steps: u64,
}

impl<S: Clone> Leaps<S> {
    /// Starts at a time with a state.
    ///
    /// # Errors
    /// A step that is not positive and finite.
    pub fn new(t_s: f64, state: S, step_s: f64) -> Result<Self, StepError> {
        let ticks = Ticks::new(t_s, step_s)?;
        let before = state.clone();
        Ok(Self { ticks, from_s: t_s, before, time_s: t_s, state, work: Work::default(), max_steps: MAX_STEPS })
    }

    /// With at most so many steps between two outputs.
    #[must_use]
    pub fn with_max_steps(mut self, steps: u64) -> Self {
        self.max_steps = steps;
        self
    }
}

impl<S: Clone, Y: Leap<S> + ?Sized> Stepper<Y> for Leaps<S> {
    type Error = Y::Error;

    fn step(&mut self, system: &mut Y) -> Result<(), OdeError<Y::Error>> {
        let (to_s, h_s) = self.ticks.next(self.time_s)?;
        self.before.clone_from(&self.state);
        self.from_s = self.time_s;
        self.work.rhs_evals += 1;
        if let Err(error) = system.leap(self.from_s, &mut self.state, h_s) {
            self.state.clone_from(&self.before);
            return Err(OdeError::System(error));
        }
        self.time_s = to_s;
        self.ticks.took(to_s);
        self.work.accepted += 1;
        Ok(())
    }

    fn interpolate(&mut self, system: &mut Y, t_s: f64, out: &mut S) -> Result<(), OdeError<Y::Error>> {
        if t_s == self.time_s {
            out.clone_from(&self.state);
            return Ok(());
        }
        if !(t_s >= self.from_s && t_s < self.time_s) {
            return Err(OdeError::Past { asked_s: t_s, from_s: self.from_s });
        }
        system.between(&self.before, &self.state, (t_s - self.from_s) / (self.time_s - self.from_s), out);
        Ok(())
    }
}

impl<S: Clone> Run for Leaps<S> {
    type State = S;

    fn start_s(&self) -> f64 {
        self.from_s
    }

    fn time_s(&self) -> f64 {
        self.time_s
    }

    fn state(&self) -> &S {
        &self.state
    }

    fn work(&self) -> Work {
        self.work
    }

    fn max_steps(&self) -> u64 {
        self.max_steps
    }

    fn restart(&mut self, t_s: f64, state: &S) {
        self.state.clone_from(state);
        self.before.clone_from(state);
        (self.from_s, self.time_s) = (t_s, t_s);
        self.ticks.restart(t_s);
    }

    fn stop_at(&mut self, t_s: f64) {
        self.ticks.stop_at(t_s);
    }
}

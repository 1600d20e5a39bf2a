//! Velocity Verlet and its symmetric compositions of orders 4 and 6 (Yoshida 1990, Physics Letters A 150, 262-268).
//!
//! One substep of length w h is
//!
//! ```text
//! v += w h/2 a(x)     x += w h v     v += w h/2 a(x)
//! ```
//!
//! and a composition makes substeps of lengths `w_1 h, .., w_n h` that sum to h. Two kicks at one place are made as
//! one, and the last acceleration is the first of the next step: one evaluation a substep. The steps stay equal, and
//! the energy of a conservative system then errs by a bounded amount, however long the run.
//!
//! The state within a step is that of a shorter step from its start, of the same order: output between the ends of
//! steps costs an evaluation a substep.

use super::fixed::Ticks;
use super::stepper::MAX_STEPS;
use super::{Mechanics, OdeError, Run, State, StepError, Stepper, Work};
use crate::algebra::Real;
use core::marker::PhantomData;

/// Which composition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Composition {
    /// Velocity Verlet: order 2, one evaluation a step.
    Verlet,
    /// Order 4, three evaluations a step.
    Yoshida4,
    /// Order 6 (solution A of the paper's table 1), seven evaluations a step.
    Yoshida6,
}

impl Composition {
    /// The substeps, as parts of a step.
    #[must_use]
    #[expect(clippy::excessive_precision, reason = "as many digits as order conditions can be held against")]
    pub const fn weights(self) -> &'static [f64] {
        match self {
            Self::Verlet => &[1.0],
            Self::Yoshida4 => {
                &[1.351207191959657634047687809, -1.702414383919315268095375618, 1.351207191959657634047687809]
            }
            Self::Yoshida6 => &[
                0.784513610477557263819497633866350,
                0.235573213359358133684793182978535,
                -1.177679984178871006946415680964316,
                1.315186320683911218884249728238863,
                -1.177679984178871006946415680964316,
                0.235573213359358133684793182978535,
                0.784513610477557263819497633866350,
            ],
        }
    }

    /// The order: the error after a given time falls like this power of the step.
    #[must_use]
    pub const fn order(self) -> u32 {
        match self {
            Self::Verlet => 2,
            Self::Yoshida4 => 4,
            Self::Yoshida6 => 6,
        }
    }

    /// A step `(t_s, h_s)` of a state of the caller's: the acceleration there is `first`, that at the end is left in `last`.
    /// For runs of steps, with output at given times, see [`Symplectic`].
    ///
    /// # Errors
    /// Those of the system; the state is then somewhere within the step.
    pub fn apply<S, T: Real, Y: Mechanics<S, T> + ?Sized>(
        self,
        mechanics: &mut Y,
        (t_s, h_s): (f64, f64),
        state: &mut S,
        first: &Y::Acceleration,
        last: &mut Y::Acceleration,
    ) -> Result<(), Y::Error> {
        let (mut now_s, mut before) = (t_s, 0.0);
        for (index, weight) in self.weights().iter().enumerate() {
            let acceleration = if index == 0 { first } else { &*last };
            mechanics.kick(state, T::from_f64(0.5 * (before + weight) * h_s), acceleration);
            mechanics.drift(now_s, state, T::from_f64(weight * h_s))?;
            now_s += weight * h_s;
            mechanics.acceleration(now_s, state, last)?;
            before = *weight;
        }
        mechanics.kick(state, T::from_f64(0.5 * before * h_s), last);
        mechanics.settle(t_s + h_s, state, T::from_f64(h_s))
    }
}

/// A time that is asked for as another product of the same factors is off by a few eps. The step to there would be all
/// rounding, and constraint forces are what corrects positions divided by it.
const ROUNDED_EPS: f64 = 4.0;

/// Integrates motion with steps of one length.
#[derive(Clone, Debug)]
pub struct Symplectic<S, T, A> {
    composition: Composition,
    ticks: Ticks,
    from_s: f64,
    before: S,
    acceleration_before: A,
    time_s: f64,
    state: S,
    acceleration: A,
    known: bool,
    scratch: A,
    work: Work,
    max_steps: u64,
    scalar: PhantomData<T>,
}

impl<S: Clone, T, A: Clone> Symplectic<S, T, A> {
    /// Starts at a time with a state; `acceleration` is storage of the right size, whatever it holds.
    ///
    /// # Errors
    /// A step that is not positive and finite.
    pub fn new(composition: Composition, t_s: f64, state: S, acceleration: A, step_s: f64) -> Result<Self, StepError> {
        Ok(Self {
            composition,
            ticks: Ticks::new(t_s, step_s)?,
            from_s: t_s,
            before: state.clone(),
            acceleration_before: acceleration.clone(),
            time_s: t_s,
            state,
            acceleration: acceleration.clone(),
            known: false,
            scratch: acceleration,
            work: Work::default(),
            max_steps: MAX_STEPS,
            scalar: PhantomData,
        })
    }

    /// With at most so many steps between two outputs.
    #[must_use]
    pub fn with_max_steps(mut self, steps: u64) -> Self {
        self.max_steps = steps;
        self
    }
}

impl<S: State<T>, T: Real, Y: Mechanics<S, T> + ?Sized> Stepper<Y> for Symplectic<S, T, Y::Acceleration> {
    type Error = Y::Error;

    fn step(&mut self, mechanics: &mut Y) -> Result<(), OdeError<Y::Error>> {
        let (to_s, h_s) = self.ticks.next(self.time_s)?;
        if !self.known {
            mechanics.acceleration(self.time_s, &self.state, &mut self.acceleration).map_err(OdeError::System)?;
            self.work.rhs_evals += 1;
            self.known = true;
        }
        self.before.assign(&self.state);
        core::mem::swap(&mut self.acceleration, &mut self.acceleration_before);
        self.from_s = self.time_s;
        let span = (self.from_s, h_s);
        let (first, last) = (&self.acceleration_before, &mut self.acceleration);
        let done = self.composition.apply(mechanics, span, &mut self.state, first, last);
        self.work.rhs_evals += self.composition.weights().len() as u64;
        if let Err(error) = done {
            self.state.assign(&self.before);
            core::mem::swap(&mut self.acceleration, &mut self.acceleration_before);
            return Err(OdeError::System(error));
        }
        self.time_s = to_s;
        self.ticks.took(to_s);
        self.work.accepted += 1;
        Ok(())
    }

    fn interpolate(&mut self, mechanics: &mut Y, t_s: f64, out: &mut S) -> Result<(), OdeError<Y::Error>> {
        if t_s == self.time_s {
            out.assign(&self.state);
            return Ok(());
        }
        if !(t_s >= self.from_s && t_s < self.time_s) {
            return Err(OdeError::Past { asked_s: t_s, from_s: self.from_s });
        }
        out.assign(&self.before);
        if t_s - self.from_s <= ROUNDED_EPS * f64::EPSILON * t_s.abs() {
            return Ok(());
        }
        let span = (self.from_s, t_s - self.from_s);
        self.work.rhs_evals += self.composition.weights().len() as u64;
        let done = self.composition.apply(mechanics, span, out, &self.acceleration_before, &mut self.scratch);
        done.map_err(OdeError::System)
    }
}

impl<S: State<T>, T: Real, A> Run for Symplectic<S, T, A> {
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
        self.state.assign(state);
        self.before.assign(state);
        (self.from_s, self.time_s, self.known) = (t_s, t_s, false);
        self.ticks.restart(t_s);
    }

    fn stop_at(&mut self, t_s: f64) {
        self.ticks.stop_at(t_s);
    }
}

//! Runs of steps on a group: equal ones, or as long as a tolerance allows.

use super::{LieMethod, LieRungeKutta, LieState, velocity};
use crate::algebra::Real;
use crate::ode::control::{Controller, first_guess, first_step};
use crate::ode::fixed::Ticks;
use crate::ode::stepper::MAX_STEPS;
use crate::ode::{OdeError, Run, StepError, Stepper, System, Tolerance, ToleranceError, Work};

/// The order of the method, and that of the estimate: the error of a step falls like `h` to one more.
const ORDER: u32 = 4;
const ERROR_ORDER: u32 = 3;

/// As for [`Adaptive`](crate::ode::Adaptive): a remainder before a stop is taken whole if it is at most this much longer than
/// the step.
const LAST_STEP: f64 = 1.01;

/// Likewise: the time resolves a step that comes out within this part of it.
const RESOLVED: f64 = 0.1;

/// How steps are chosen.
#[derive(Clone, Debug)]
enum Pace<T> {
    Fixed(Ticks),
    Adaptive { tolerance: Tolerance<T>, controller: Controller, next_s: Option<f64>, stop_s: f64 },
}

/// Integrates on a group, `LieStepper::<CommutatorFree4, _, _>`.
#[derive(Clone, Debug)]
pub struct LieStepper<M, S: LieState<T>, T> {
    method: LieRungeKutta<M, S, T>,
    from_s: f64,
    before: S,
    time_s: f64,
    state: S,
    /// The velocity at the state is the last of the method's.
    end_known: bool,
    /// The logarithm of the last step, for dense output, and whether it is known.
    log: S::Rate,
    log_known: bool,
    pace: Pace<T>,
    work: Work,
    max_steps: u64,
}

impl<M: LieMethod, T: Real, S: LieState<T> + Clone> LieStepper<M, S, T>
where
    S::Rate: Clone,
{
    /// Starts at a time with a state, with steps of one length; `rate` is storage of the size of a rate, whatever it holds.
    ///
    /// # Errors
    /// A step that is not positive and finite.
    pub fn fixed(t_s: f64, state: S, rate: S::Rate, step_s: f64) -> Result<Self, StepError> {
        Ok(Self::new(t_s, state, rate, Pace::Fixed(Ticks::new(t_s, step_s)?)))
    }

    /// With steps by a tolerance.
    ///
    /// # Errors
    /// A tolerance below what the numbers resolve.
    pub fn adaptive(t_s: f64, state: S, rate: S::Rate, tolerance: Tolerance<T>) -> Result<Self, ToleranceError> {
        let (tolerance, controller) = (tolerance.check()?, Controller::new(ERROR_ORDER));
        Ok(Self::new(t_s, state, rate, Pace::Adaptive { tolerance, controller, next_s: None, stop_s: f64::INFINITY }))
    }

    fn new(t_s: f64, state: S, rate: S::Rate, pace: Pace<T>) -> Self {
        Self {
            method: LieRungeKutta::new(state.clone(), rate.clone()),
            from_s: t_s,
            before: state.clone(),
            time_s: t_s,
            state,
            end_known: false,
            log: rate,
            log_known: false,
            pace,
            work: Work::default(),
            max_steps: MAX_STEPS,
        }
    }

    /// With at most so many steps between two outputs.
    #[must_use]
    pub fn with_max_steps(mut self, steps: u64) -> Self {
        self.max_steps = steps;
        self
    }
}

impl<M: LieMethod, T: Real, S: LieState<T>> LieStepper<M, S, T> {
    /// The velocity that the next step starts with, in the last place.
    #[inline(always)]
    fn know_end<Y: System<S, T> + ?Sized>(&mut self, system: &mut Y) -> Result<(), Y::Error> {
        if !self.end_known {
            velocity(system, self.time_s, &self.state, &mut self.method.k[4])?;
            self.work.rhs_evals += 1;
            self.end_known = true;
        }
        Ok(())
    }

    /// The end of the last step becomes the start of the next.
    #[inline(always)]
    fn begin(&mut self) {
        core::mem::swap(&mut self.before, &mut self.state);
        self.method.k.swap(0, 4);
        self.from_s = self.time_s;
        (self.end_known, self.log_known) = (false, false);
    }

    /// A step that cannot be made: the start becomes the end of no step.
    #[cold]
    fn abandon(&mut self) {
        self.state.assign(&self.before);
        self.method.k.swap(0, 4);
        self.time_s = self.from_s;
        self.end_known = true;
    }

    /// The state after a step of `h_s`, without the velocity there.
    #[inline(always)]
    fn attempt<Y: System<S, T> + ?Sized>(&mut self, h_s: f64, system: &mut Y) -> Result<(), Y::Error> {
        self.method.stages(&self.before, self.from_s, h_s, system)?;
        self.work.rhs_evals += 3;
        self.state.assign(&self.before);
        M::advance(&self.method.k, &mut self.method.scratch, &mut self.state, T::from_f64(h_s));
        Ok(())
    }

    /// The step is taken: the system settles.
    #[inline(always)]
    fn accept<Y: System<S, T> + ?Sized>(&mut self, to_s: f64, system: &mut Y) -> Result<(), Y::Error> {
        let moved = system.settle(to_s, &mut self.state)?;
        self.time_s = to_s;
        self.end_known = self.end_known && !moved;
        self.work.accepted += 1;
        Ok(())
    }

    /// The error that a velocity makes when it acts for a time, in units of what is allowed.
    fn error_of(&mut self, terms: &[(T, usize)], tolerance: Tolerance<T>) -> f64 {
        let k = &self.method.k;
        match *terms {
            [(h, i)] => S::combine(&[(h, &k[i])], &mut self.method.scratch),
            [(h, i), (g, j), ..] => S::combine(&[(h, &k[i]), (g, &k[j])], &mut self.method.scratch),
            [] => return 0.0,
        }
        self.state.to_rate(&mut self.method.scratch);
        self.before.error_ratio(&self.state, &[(T::one(), &self.method.scratch)], tolerance).to_f64()
    }

    /// A step of one length. A velocity that is no number is the first that shows of a solution out of range.
    #[inline(always)]
    fn fixed_step<Y: System<S, T> + ?Sized>(
        &mut self,
        to_s: f64,
        h_s: f64,
        system: &mut Y,
    ) -> Result<(), OdeError<Y::Error>> {
        self.attempt(h_s, system).map_err(OdeError::System)?;
        self.accept(to_s, system).map_err(OdeError::System)?;
        let any = Tolerance { rtol: T::one(), atol: T::one() };
        if self.error_of(&[(T::one(), 3)], any).is_finite() {
            return Ok(());
        }
        Err(OdeError::NotFinite { time_s: to_s, step_s: h_s })
    }
}

/// What an adaptive step starts from.
struct Search<T> {
    tolerance: Tolerance<T>,
    controller: Controller,
    wanted_s: f64,
    stop_s: f64,
}

impl<M: LieMethod, T: Real, S: LieState<T>> LieStepper<M, S, T> {
    /// The first step, as of the adaptive methods that add: from the velocity and its change over a short step.
    #[cold]
    fn estimate_first<Y: System<S, T> + ?Sized>(
        &mut self,
        tolerance: Tolerance<T>,
        system: &mut Y,
    ) -> Result<f64, Y::Error> {
        self.before.assign(&self.state);
        let rate = self.error_of(&[(T::one(), 4)], tolerance);
        let guess = first_guess(rate, tolerance.rtol.to_f64());
        self.method.stage.assign(&self.state);
        self.method.stage.act(&[(T::from_f64(guess), &self.method.k[4])]);
        velocity(system, self.time_s + guess, &self.method.stage, &mut self.method.k[0])?;
        self.work.rhs_evals += 1;
        let change = self.error_of(&[(T::one(), 0), (-T::one(), 4)], tolerance) / guess;
        Ok(first_step(guess, rate, if change.is_finite() { change } else { f64::MAX }, ORDER))
    }

    /// Tries steps until one is good; its end, and the next step.
    #[inline(always)]
    fn search<Y: System<S, T> + ?Sized>(
        &mut self,
        search: &mut Search<T>,
        system: &mut Y,
    ) -> Result<(f64, f64), OdeError<Y::Error>> {
        let left = search.stop_s - self.from_s;
        if left <= 0.0 {
            return Err(OdeError::Stopped { stop_s: search.stop_s });
        }
        let mut failed_s = f64::INFINITY;
        loop {
            let wanted = search.wanted_s;
            let last = left <= LAST_STEP * wanted;
            let to_s = if last { search.stop_s } else { self.from_s + wanted };
            // What the time really moves by.
            let h_s = to_s - self.from_s;
            if !(h_s > 0.0 && h_s < failed_s) || !last && (h_s - wanted).abs() > RESOLVED * wanted {
                return Err(OdeError::StepTooSmall { time_s: self.from_s, step_s: wanted });
            }
            self.attempt(h_s, system).map_err(OdeError::System)?;
            velocity(system, to_s, &self.state, &mut self.method.k[4]).map_err(OdeError::System)?;
            self.work.rhs_evals += 1;
            let sixth = T::from_f64(h_s / 6.0);
            let ratio = self.error_of(&[(sixth, 4), (-sixth, 3)], search.tolerance);
            if ratio <= 1.0 {
                self.end_known = true;
                let controller = &mut search.controller;
                let next =
                    if last { controller.cut_short(ratio, h_s, wanted) } else { controller.accepted(ratio, h_s) };
                return Ok((to_s, next));
            }
            self.work.rejected += 1;
            failed_s = h_s;
            search.wanted_s = search.controller.rejected(ratio, h_s);
        }
    }
}

impl<M: LieMethod, T: Real, S: LieState<T>, Y: System<S, T> + ?Sized> Stepper<Y> for LieStepper<M, S, T> {
    type Error = Y::Error;

    fn step(&mut self, system: &mut Y) -> Result<(), OdeError<Y::Error>> {
        self.know_end(system).map_err(OdeError::System)?;
        let done = match self.pace {
            Pace::Fixed(ticks) => {
                let (to_s, h_s) = ticks.next(self.time_s)?;
                self.begin();
                let done = self.fixed_step(to_s, h_s, system);
                if let (Ok(()), Pace::Fixed(ticks)) = (&done, &mut self.pace) {
                    ticks.took(to_s);
                }
                done
            }
            Pace::Adaptive { tolerance, controller, next_s, stop_s } => {
                let wanted_s = match next_s {
                    Some(step) => step,
                    None => self.estimate_first(tolerance, system).map_err(OdeError::System)?,
                };
                self.begin();
                let mut search = Search { tolerance, controller, wanted_s, stop_s };
                let found = self.search(&mut search, system);
                if let Pace::Adaptive { controller, next_s, .. } = &mut self.pace {
                    *controller = search.controller;
                    *next_s = found.as_ref().ok().map(|(_, next)| *next).or(*next_s);
                }
                found.and_then(|(to_s, _)| self.accept(to_s, system).map_err(OdeError::System))
            }
        };
        if done.is_err() {
            self.abandon();
        }
        done
    }

    fn interpolate(&mut self, system: &mut Y, t_s: f64, out: &mut S) -> Result<(), OdeError<Y::Error>> {
        if t_s == self.time_s {
            out.assign(&self.state);
            return Ok(());
        }
        if !(t_s >= self.from_s && t_s < self.time_s) {
            return Err(OdeError::Past { asked_s: t_s, from_s: self.from_s });
        }
        self.know_end(system).map_err(OdeError::System)?;
        let h_s = self.time_s - self.from_s;
        if !self.log_known {
            self.state.log_from(&self.before, &mut self.log);
            self.log_known = true;
        }
        self.end_slope(T::from_f64(h_s));
        let theta = (t_s - self.from_s) / h_s;
        let rest = 1.0 - theta;
        let whole = T::from_f64(theta * theta * (3.0 - 2.0 * theta));
        let start = T::from_f64(h_s * theta * rest * rest);
        let end = T::from_f64(-theta * theta * rest);
        out.assign(&self.before);
        out.act(&[(whole, &self.log), (start, &self.method.k[0]), (end, &self.method.scratch)]);
        system.settle(t_s, out).map_err(OdeError::System)?;
        Ok(())
    }
}

impl<M: LieMethod, T: Real, S: LieState<T>> LieStepper<M, S, T> {
    /// `h udot` at the end, into the scratch: with `y = start exp(u)` and `ydot = y k`,
    /// `udot = k + [u, k]/2 + [u, [u, k]]/12` up to fourth powers of u, which the cubic does not resolve.
    fn end_slope(&mut self, h: T) {
        let (k, u) = (&self.method.k[4], &self.log);
        // The stage is free, but holds no velocity; that of the second stage is not needed any more.
        S::combine(&[(T::zero(), k)], &mut self.method.scratch);
        S::add_bracket(&mut self.method.scratch, h, u, k);
        let [_, inner, ..] = &mut self.method.k;
        S::combine(&[(T::one(), &self.method.scratch)], inner);
        let [_, inner, _, _, k] = &self.method.k;
        S::combine(&[(h, k), (T::ratio(1, 2), inner)], &mut self.method.scratch);
        S::add_bracket(&mut self.method.scratch, T::ratio(1, 12), u, inner);
    }
}

impl<M, T: Real, S: LieState<T>> Run for LieStepper<M, S, T> {
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
        (self.from_s, self.time_s) = (t_s, t_s);
        (self.end_known, self.log_known) = (false, false);
        match &mut self.pace {
            Pace::Fixed(ticks) => ticks.restart(t_s),
            Pace::Adaptive { controller, next_s, .. } => (*controller, *next_s) = (Controller::new(ERROR_ORDER), None),
        }
    }

    fn stop_at(&mut self, t_s: f64) {
        match &mut self.pace {
            Pace::Fixed(ticks) => ticks.stop_at(t_s),
            Pace::Adaptive { stop_s, .. } => *stop_s = t_s,
        }
    }
}

//! The last step of a run and all that is known of it: both ends, the rates, dense output.

use super::tableau::Start;
use super::{OdeError, State, System, Tableau, Work};
use crate::algebra::Real;
use core::marker::PhantomData;

/// A step from `before` to `state`, with rates `R` of method M. Before the first step both are the start.
#[derive(Clone, Debug)]
pub(super) struct Segment<M, S, T, R> {
    pub(super) from_s: f64,
    pub(super) before: S,
    pub(super) time_s: f64,
    pub(super) state: S,
    stage: S,
    rates: R,
    /// The rate at `state` stands at its place among the rates.
    end_known: bool,
    /// The rates for dense output do.
    dense_known: bool,
    pub(super) work: Work,
    of: PhantomData<(M, T)>,
}

impl<M: Tableau, T: Real, S: State<T>> Segment<M, S, T, M::Rates<S::Rate>> {
    /// Where the rate at the end of a step stands.
    const END: usize = M::COEFFICIENTS.end() - 1;

    pub(super) fn new(time_s: f64, state: S, rate: S::Rate) -> Self
    where
        S: Clone,
        S::Rate: Clone,
    {
        Self {
            from_s: time_s,
            before: state.clone(),
            time_s,
            stage: state.clone(),
            state,
            rates: M::rates(rate),
            end_known: false,
            dense_known: false,
            work: Work::default(),
            of: PhantomData,
        }
    }

    pub(super) fn restart(&mut self, time_s: f64, state: &S) {
        self.state.assign(state);
        self.before.assign(state);
        (self.from_s, self.time_s) = (time_s, time_s);
        (self.end_known, self.dense_known) = (false, false);
    }

    /// The rates, that of the end of the step first known.
    pub(super) fn rates(&self) -> &M::Rates<S::Rate> {
        &self.rates
    }

    /// The rate at the state.
    pub(super) fn end_rate(&self) -> &S::Rate {
        &self.rates.as_ref()[Self::END]
    }

    /// The rate that the next step starts with.
    #[inline(always)]
    pub(super) fn know_end<Y: System<S, T> + ?Sized>(&mut self, system: &mut Y) -> Result<(), Y::Error> {
        if !self.end_known {
            system.rate(self.time_s, &self.state, &mut self.rates.as_mut()[Self::END])?;
            self.work.rhs_evals += 1;
            self.end_known = true;
        }
        Ok(())
    }

    /// The rate after a trial of Euler's, into the place of a stage.
    pub(super) fn trial_rate<Y: System<S, T> + ?Sized>(
        &mut self,
        h_s: f64,
        system: &mut Y,
    ) -> Result<&S::Rate, Y::Error> {
        let rates = self.rates.as_mut();
        self.stage.assign(&self.state);
        self.stage.add_scaled(&[(T::from_f64(h_s), &rates[Self::END])]);
        system.rate(self.time_s + h_s, &self.stage, &mut rates[0])?;
        self.work.rhs_evals += 1;
        Ok(&self.rates.as_ref()[0])
    }

    /// The end of the last step becomes the start of the next.
    #[inline(always)]
    pub(super) fn begin(&mut self) {
        core::mem::swap(&mut self.before, &mut self.state);
        self.rates.as_mut().swap(0, Self::END);
        self.from_s = self.time_s;
        (self.end_known, self.dense_known) = (false, false);
    }

    /// A step that cannot be made: the start becomes the end of no step.
    #[cold]
    pub(super) fn abandon(&mut self) {
        self.state.assign(&self.before);
        self.rates.as_mut().swap(0, Self::END);
        self.time_s = self.from_s;
        self.end_known = true;
    }

    /// The state after a step of `h_s`; also the rate there, if `with_end`.
    #[inline(always)]
    pub(super) fn attempt<Y: System<S, T> + ?Sized>(
        &mut self,
        h_s: f64,
        with_end: bool,
        system: &mut Y,
    ) -> Result<(), Y::Error> {
        let start = Start { t_s: self.from_s, state: &self.before, h_s };
        M::stages(&mut self.rates, &mut self.stage, start, system)?;
        self.state.assign(&self.before);
        M::advance(&self.rates, &mut self.state, h_s);
        self.work.rhs_evals += M::COEFFICIENTS.stages.len() as u64;
        if with_end {
            system.rate(self.from_s + h_s, &self.state, &mut self.rates.as_mut()[Self::END])?;
            self.work.rhs_evals += 1;
        }
        Ok(())
    }

    /// The step is taken: the system settles, and the rate at its end is known.
    #[inline(always)]
    pub(super) fn accept<Y: System<S, T> + ?Sized>(
        &mut self,
        time_s: f64,
        end_known: bool,
        system: &mut Y,
    ) -> Result<(), Y::Error> {
        let moved = system.settle(time_s, &mut self.state)?;
        self.time_s = time_s;
        self.end_known = end_known && !moved;
        self.work.accepted += 1;
        self.know_end(system)
    }

    /// The state at a time within the step.
    pub(super) fn interpolate<Y: System<S, T> + ?Sized>(
        &mut self,
        t_s: f64,
        out: &mut S,
        system: &mut Y,
    ) -> Result<(), OdeError<Y::Error>> {
        if t_s == self.time_s {
            out.assign(&self.state);
            return Ok(());
        }
        if !(t_s >= self.from_s && t_s < self.time_s) {
            return Err(OdeError::Past { asked_s: t_s, from_s: self.from_s });
        }
        let h_s = self.time_s - self.from_s;
        if !self.dense_known {
            let start = Start { t_s: self.from_s, state: &self.before, h_s };
            let more = M::dense_stages(&mut self.rates, &mut self.stage, start, system).map_err(OdeError::System)?;
            self.work.rhs_evals += more;
            self.dense_known = true;
        }
        out.assign(&self.before);
        M::interpolate(&self.rates, out, h_s, (t_s - self.from_s) / h_s);
        system.settle(t_s, out).map_err(OdeError::System)?;
        Ok(())
    }
}

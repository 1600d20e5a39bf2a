//! A Runge-Kutta method with its storage: single steps on a state of the caller's.

use super::tableau::Start;
use super::{State, System, Tableau};
use crate::algebra::Real;

/// Stage storage, allocated once, for steps of whatever length the caller likes. For runs of steps, with output at
/// given times, see [`Fixed`](super::Fixed) and [`Adaptive`](super::Adaptive).
#[derive(Clone, Debug)]
pub struct RungeKutta<M: Tableau, S: State<T>, T> {
    stage: S,
    rates: M::Rates<S::Rate>,
}

impl<M: Tableau, T: Real, S: State<T>> RungeKutta<M, S, T> {
    /// Storage for states and rates of the given sizes.
    pub fn new(stage: S, rate: S::Rate) -> Self
    where
        S::Rate: Clone,
    {
        Self { stage, rates: M::rates(rate) }
    }

    /// Advances `state` from time `t_s` by `h_s`.
    ///
    /// # Errors
    /// Those of the system; the state is then as before.
    pub fn step<Y: System<S, T> + ?Sized>(
        &mut self,
        state: &mut S,
        t_s: f64,
        h_s: f64,
        system: &mut Y,
    ) -> Result<(), Y::Error> {
        system.rate(t_s, state, &mut self.rates.as_mut()[0])?;
        M::stages(&mut self.rates, &mut self.stage, Start { t_s, state, h_s }, system)?;
        M::advance(&self.rates, state, h_s);
        Ok(())
    }
}

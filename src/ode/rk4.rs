//! The classical Runge-Kutta method of order 4 (Kutta 1901; report, equation 56). Local error O(h⁵), global O(h⁴).

use super::State;
use crate::algebra::Real;

/// Stage storage, allocated once.
#[derive(Clone, Debug)]
pub struct Rk4<S: State<T>, T> {
    stage: S,
    rates: [S::Rate; 4],
}

impl<T: Real, S: State<T>> Rk4<S, T> {
    /// Storage for states and rates of the given sizes.
    pub fn new(stage: S, rate: S::Rate) -> Self
    where
        S::Rate: Clone,
    {
        Self { stage, rates: [rate.clone(), rate.clone(), rate.clone(), rate] }
    }

    /// Advances `state` from time `t_s` by `h_s`; `rhs` writes the rate of a state at a time.
    pub fn step(&mut self, state: &mut S, t_s: f64, h_s: T, mut rhs: impl FnMut(f64, &S, &mut S::Rate)) {
        let half = h_s * T::ratio(1, 2);
        let middle = t_s + half.to_f64();
        rhs(t_s, state, &mut self.rates[0]);
        for (index, (step, time)) in [(half, middle), (half, middle), (h_s, t_s + h_s.to_f64())].into_iter().enumerate()
        {
            self.stage.assign(state);
            self.stage.add_scaled(&[(step, &self.rates[index])]);
            rhs(time, &self.stage, &mut self.rates[index + 1]);
        }
        let [k1, k2, k3, k4] = &self.rates;
        let (sixth, third) = (h_s * T::ratio(1, 6), h_s * T::ratio(1, 3));
        state.add_scaled(&[(sixth, k1), (third, k2), (third, k3), (sixth, k4)]);
    }
}

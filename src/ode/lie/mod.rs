//! Runge-Kutta methods on Lie groups: states move by exponentials, and stay on the group to rounding.
//!
//! A rotor is no vector: the sum of two is none. So a step of these methods is a product of exponentials of sums of
//! velocities k, where `ydot = y k(t, y)`: the stages are rotors, and so is the end. What else the state holds, like momenta,
//! is a vector space and is added. Both methods are of order 4 and make four evaluations a step:
//!
//! * [`Rkmk4`]: Runge, Kutta and Munthe-Kaas'. One exponential a stage, in whose argument brackets mend what the group does
//!   not commute. Munthe-Kaas, Owren 1999, *Computations in a free Lie algebra*, equation (5.6), with two brackets.
//! * [`CommutatorFree4`]: products of exponentials instead of brackets. Celledoni, Marthinsen, Owren 2003, *Commutator-free
//!   Lie group methods*, section 3.
//!
//! Velocities stand on the right here, `y exp(u)`; where the papers have them on the left, brackets change sign, and factors
//! their order.
//!
//! # Error
//!
//! With the rate k5 at the end of the step, which is the first of the next, `h (k5 - k4) / 6` is what the step would change by
//! if k5 stood in the place of k4: a method of order 3, for stage 4 is at the end to `O(h³)` in both methods, and `b . c³` is
//! as in the classical method. So the estimate falls like `h⁴`, and costs nothing. (Pairs of commutator-free methods with
//! estimates of their own: Curry, Owren 2019, *Variable step size commutator free Lie group integrators*.)
//!
//! # Dense output
//!
//! The cubic of Hermite in the logarithm of the step, from both ends and their velocities: order 4 as well, and on the group
//! everywhere.
//!
//! What it does not do: stiff equations, and steps that turn by more than a half turn.

mod method;
mod stepper;

pub use method::{CommutatorFree4, LieMethod, Rkmk4};
pub use stepper::LieStepper;

use super::{Controlled, System};
use crate::algebra::Real;

/// A state that moves by exponentials: a Lie group, times a vector space.
///
/// Velocities are kept in the storage of rates.
pub trait LieState<T>: Controlled<T> {
    /// From the rate `ydot` at this state to the velocity k with `ydot = y k`.
    fn to_velocity(&self, rate: &mut Self::Rate);

    /// From a velocity k at this state to the rate `y k`.
    fn to_rate(&self, velocity: &mut Self::Rate);

    /// `y exp(sum h_i k_i)`
    fn act(&mut self, terms: &[(T, &Self::Rate)]);

    /// The velocity `sum h_i k_i`.
    fn combine(terms: &[(T, &Self::Rate)], out: &mut Self::Rate);

    /// Adds `scale [a, b]`, the bracket of the group: `a b - b a`.
    fn add_bracket(out: &mut Self::Rate, scale: T, a: &Self::Rate, b: &Self::Rate);

    /// The shortest u with `start exp(u) = y`.
    fn log_from(&self, start: &Self, out: &mut Self::Rate);
}

/// Storage of a step, allocated once: for steps of whatever length the caller likes. For runs of steps, with output at given
/// times, see [`LieStepper`].
#[derive(Clone, Debug)]
pub struct LieRungeKutta<M, S: LieState<T>, T> {
    pub(super) stage: S,
    /// Velocities: of the stages, and at the end.
    pub(super) k: [S::Rate; 5],
    pub(super) scratch: S::Rate,
    of: core::marker::PhantomData<(M, T)>,
}

impl<M: LieMethod, T: Real, S: LieState<T>> LieRungeKutta<M, S, T> {
    /// Storage for states and rates of the given sizes.
    pub fn new(stage: S, rate: S::Rate) -> Self
    where
        S::Rate: Clone,
    {
        let k = core::array::from_fn(|_| rate.clone());
        Self { stage, k, scratch: rate, of: core::marker::PhantomData }
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
        velocity(system, t_s, state, &mut self.k[0])?;
        self.stages(state, t_s, h_s, system)?;
        M::advance(&self.k, &mut self.scratch, state, T::from_f64(h_s));
        Ok(())
    }

    /// The velocities of stages 2 to 4; the first is there.
    #[inline(always)]
    pub(super) fn stages<Y: System<S, T> + ?Sized>(
        &mut self,
        start: &S,
        t_s: f64,
        h_s: f64,
        system: &mut Y,
    ) -> Result<(), Y::Error> {
        let h = T::from_f64(h_s);
        for stage in 1..4 {
            self.stage.assign(start);
            M::stage(stage, &self.k, &mut self.scratch, &mut self.stage, h);
            let t_s = if stage < 3 { t_s + 0.5 * h_s } else { t_s + h_s };
            velocity(system, t_s, &self.stage, &mut self.k[stage])?;
        }
        Ok(())
    }
}

/// The velocity of a state.
#[inline(always)]
pub(super) fn velocity<T, S: LieState<T>, Y: System<S, T> + ?Sized>(
    system: &mut Y,
    t_s: f64,
    state: &S,
    out: &mut S::Rate,
) -> Result<(), Y::Error> {
    system.rate(t_s, state, out)?;
    state.to_velocity(out);
    Ok(())
}

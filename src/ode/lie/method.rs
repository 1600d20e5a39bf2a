//! The two methods, as steps of velocities `k1 .. k4`, counted from 0 in the code.

use super::LieState;
use crate::algebra::Real;

/// An explicit method of order 4 with four stages, at times 0, h/2, h/2, h.
pub trait LieMethod {
    /// Moves the start of a step to stage `index` (1, 2 or 3).
    fn stage<T: Real, S: LieState<T>>(index: usize, k: &[S::Rate; 5], scratch: &mut S::Rate, state: &mut S, h: T);

    /// Moves the start of a step to its end.
    fn advance<T: Real, S: LieState<T>>(k: &[S::Rate; 5], scratch: &mut S::Rate, state: &mut S, h: T);
}

/// Runge, Kutta and Munthe-Kaas' method with two brackets:
///
/// ```text
/// Y2 = y exp(h/2 k1)     Y3 = y exp(h/2 k2 + h²/8 [k1, k2])     Y4 = y exp(h k3)
/// next = y exp(h/6 (k1 + 2 k2 + 2 k3 + k4) + h²/12 [k1, k4])
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Rkmk4;

impl LieMethod for Rkmk4 {
    #[inline(always)]
    fn stage<T: Real, S: LieState<T>>(index: usize, k: &[S::Rate; 5], scratch: &mut S::Rate, state: &mut S, h: T) {
        let half = h * T::ratio(1, 2);
        match index {
            1 => state.act(&[(half, &k[0])]),
            2 => {
                S::combine(&[(half, &k[1])], scratch);
                S::add_bracket(scratch, h * h * T::ratio(1, 8), &k[0], &k[1]);
                state.act(&[(T::one(), scratch)]);
            }
            _ => state.act(&[(h, &k[2])]),
        }
    }

    #[inline(always)]
    fn advance<T: Real, S: LieState<T>>(k: &[S::Rate; 5], scratch: &mut S::Rate, state: &mut S, h: T) {
        let (sixth, third) = (h * T::ratio(1, 6), h * T::ratio(1, 3));
        S::combine(&[(sixth, &k[0]), (third, &k[1]), (third, &k[2]), (sixth, &k[3])], scratch);
        S::add_bracket(scratch, h * h * T::ratio(1, 12), &k[0], &k[3]);
        state.act(&[(T::one(), scratch)]);
    }
}

/// Celledoni, Marthinsen and Owren's method without brackets, with five exponentials:
///
/// ```text
/// Y2 = y exp(h/2 k1)     Y3 = y exp(h/2 k2)     Y4 = Y2 exp(h (k3 - k1/2))
/// next = y exp(h/12 (3 k1 + 2 k2 + 2 k3 - k4)) exp(h/12 (-k1 + 2 k2 + 2 k3 + 3 k4))
/// ```
#[derive(Clone, Copy, Debug)]
pub struct CommutatorFree4;

impl LieMethod for CommutatorFree4 {
    #[inline(always)]
    fn stage<T: Real, S: LieState<T>>(index: usize, k: &[S::Rate; 5], _: &mut S::Rate, state: &mut S, h: T) {
        let half = h * T::ratio(1, 2);
        match index {
            1 => state.act(&[(half, &k[0])]),
            2 => state.act(&[(half, &k[1])]),
            _ => {
                state.act(&[(half, &k[0])]);
                state.act(&[(h, &k[2]), (-half, &k[0])]);
            }
        }
    }

    #[inline(always)]
    fn advance<T: Real, S: LieState<T>>(k: &[S::Rate; 5], _: &mut S::Rate, state: &mut S, h: T) {
        let twelfth = h * T::ratio(1, 12);
        let (one, two, three) = (-twelfth, twelfth * T::ratio(2, 1), twelfth * T::ratio(3, 1));
        state.act(&[(three, &k[0]), (two, &k[1]), (two, &k[2]), (one, &k[3])]);
        state.act(&[(one, &k[0]), (two, &k[1]), (two, &k[2]), (three, &k[3])]);
    }
}

//! What a stepper asks of a state: to be moved by rates, and to say how large an error is.
//!
//! Arrays, vectors and nalgebra's fixed vectors are states whose rate is of the same type. Structures of arrays
//! implement the traits themselves, so that a step touches each array once.

use crate::algebra::Real;
use alloc::vec::Vec;

/// A state that a rate can move: `y + h k`.
///
/// State and rate are separate types, because they need not be of the same kind: a world position may be an f64 point
/// while its rate is an f32 vector.
pub trait State<T> {
    /// The derivative of the state with time.
    type Rate;

    /// Becomes a copy of another state of the same size, without allocation.
    fn assign(&mut self, other: &Self);

    /// `y + sum h_i k_i`. The sum is formed before it is added, so that a large state is rounded once.
    fn add_scaled(&mut self, terms: &[(T, &Self::Rate)]);
}

/// A state whose error can be measured, for steppers that choose their own step.
pub trait Controlled<T>: State<T> {
    /// The error of a step in units of what is allowed, `max_i |sum_j h_j k_j|_i / (atol + rtol max(|y_i|, |next_i|))`:
    /// the step is good if this is at most 1. (Report, B.3: "the highest error relative to the allowable".)
    ///
    /// Not finite if any of the numbers is not. A number without error counts 0 even where nothing is allowed.
    fn error_ratio(&self, next: &Self, terms: &[(T, &Self::Rate)], tolerance: Tolerance<T>) -> T;
}

/// The error that a step may make in a number y: `atol + rtol |y|`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance<T> {
    /// Relative. At least [`SMALLEST_RTOL_EPS`] times the epsilon of the scalar.
    pub rtol: T,
    /// Absolute, in the unit of each number. It matters where a number passes through zero.
    pub atol: T,
}

/// The smallest relative tolerance, in units of the scalar's epsilon: below it the estimate of the error is made of
/// rounding, and the step shrinks without getting better. (The bound of Hairer's codes.)
pub const SMALLEST_RTOL_EPS: f64 = 10.0;

/// Not a tolerance that steps can be chosen by.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ToleranceError {
    /// Below what the numbers resolve.
    #[error(
        "a relative tolerance of {rtol:e} is below what the numbers resolve: the smallest that makes sense is {least:e}"
    )]
    Relative {
        /// What was asked.
        rtol: f64,
        /// The smallest.
        least: f64,
    },
    /// Negative or not finite.
    #[error("an absolute tolerance of {atol:e}: it must be 0 or positive, and finite")]
    Absolute {
        /// What was asked.
        atol: f64,
    },
}

impl<T: Real> Tolerance<T> {
    /// # Errors
    /// A tolerance below what `T` resolves, or one that is no number.
    pub fn check(self) -> Result<Self, ToleranceError> {
        let (rtol, atol) = (self.rtol.to_f64(), self.atol.to_f64());
        let least = SMALLEST_RTOL_EPS * T::EPSILON.to_f64();
        if !(rtol >= least && rtol.is_finite()) {
            Err(ToleranceError::Relative { rtol, least })
        } else if !(atol >= 0.0 && atol.is_finite()) {
            Err(ToleranceError::Absolute { atol })
        } else {
            Ok(self)
        }
    }
}

/// Numbers that are summed at a time: enough to fill the registers, few enough to stay in them.
const BLOCK: usize = 8;

/// `y_i + sum_j h_j k_ji` for `N` numbers: the loops have a known length, and are unrolled.
#[inline(always)]
fn add<T: Real, const N: usize>(y: &mut [T; N], terms: &[(T, &[T; N])]) {
    if let Some(((h, k), rest)) = terms.split_first() {
        let mut sum = k.map(|rate| *h * rate);
        for (h, k) in rest {
            for (sum, rate) in sum.iter_mut().zip(*k) {
                *sum = *sum + *h * *rate;
            }
        }
        for (y, sum) in y.iter_mut().zip(sum) {
            *y = *y + sum;
        }
    }
}

/// The largest error in `N` numbers, and the sum of all: a maximum forgets what is no number, a sum does not.
#[inline(always)]
fn worst<T: Real, const N: usize>(y: &[T; N], next: &[T; N], error: [T; N], tolerance: Tolerance<T>) -> (T, T) {
    let (mut worst, mut sum) = (T::zero(), T::zero());
    for ((error, y), next) in error.into_iter().zip(y).zip(next) {
        let allowed = tolerance.atol + tolerance.rtol * y.abs().max(next.abs());
        let ratio = if error == T::zero() { T::zero() } else { error.abs() / allowed };
        worst = worst.max(ratio);
        // Infinite neighbours of a finite error would otherwise pass: infinity times zero is no number.
        sum = sum + ratio + T::zero() * *next;
    }
    (worst, sum)
}

/// The worst, unless something was not finite.
#[inline(always)]
fn finite_or_sum<T: Real>((worst, sum): (T, T)) -> T {
    if sum.is_finite() { worst } else { sum }
}

impl<T: Real, const N: usize> State<T> for [T; N] {
    type Rate = Self;

    #[inline(always)]
    fn assign(&mut self, other: &Self) {
        *self = *other;
    }

    #[inline(always)]
    fn add_scaled(&mut self, terms: &[(T, &Self)]) {
        add(self, terms);
    }
}

impl<T: Real, const N: usize> Controlled<T> for [T; N] {
    #[inline(always)]
    fn error_ratio(&self, next: &Self, terms: &[(T, &Self)], tolerance: Tolerance<T>) -> T {
        let mut error = [T::zero(); N];
        add(&mut error, terms);
        finite_or_sum(worst(self, next, error, tolerance))
    }
}

impl<T: Real> State<T> for Vec<T> {
    type Rate = Self;

    fn assign(&mut self, other: &Self) {
        self.copy_from_slice(other);
    }

    fn add_scaled(&mut self, terms: &[(T, &Self)]) {
        blocks(self.len(), |at, count| {
            let sum = block_sum(terms, at, count);
            for (y, sum) in self[at..at + count].iter_mut().zip(sum) {
                *y = *y + sum;
            }
        });
    }
}

impl<T: Real> Controlled<T> for Vec<T> {
    fn error_ratio(&self, next: &Self, terms: &[(T, &Self)], tolerance: Tolerance<T>) -> T {
        let mut all = (T::zero(), T::zero());
        blocks(self.len(), |at, count| {
            let error = block_sum(terms, at, count);
            let (mut y, mut after) = ([T::zero(); BLOCK], [T::zero(); BLOCK]);
            y[..count].copy_from_slice(&self[at..at + count]);
            after[..count].copy_from_slice(&next[at..at + count]);
            let (largest, sum) = worst(&y, &after, error, tolerance);
            all = (all.0.max(largest), all.1 + sum);
        });
        finite_or_sum(all)
    }
}

/// Calls with the start and the length of each block.
fn blocks(len: usize, mut call: impl FnMut(usize, usize)) {
    for at in (0..len).step_by(BLOCK) {
        call(at, BLOCK.min(len - at));
    }
}

/// `sum_j h_j k_ji` for the numbers of a block; zero beyond its end.
#[inline(always)]
fn block_sum<T: Real>(terms: &[(T, &Vec<T>)], at: usize, count: usize) -> [T; BLOCK] {
    let mut sum = [T::zero(); BLOCK];
    for (h, k) in terms {
        if count == BLOCK {
            for (sum, rate) in sum.iter_mut().zip(&k[at..at + BLOCK]) {
                *sum = *sum + *h * *rate;
            }
        } else {
            for (sum, rate) in sum.iter_mut().zip(&k[at..at + count]) {
                *sum = *sum + *h * *rate;
            }
        }
    }
    sum
}

impl<T: Real, const N: usize> State<T> for nalgebra::SVector<T, N> {
    type Rate = Self;

    #[inline(always)]
    fn assign(&mut self, other: &Self) {
        *self = *other;
    }

    #[inline(always)]
    fn add_scaled(&mut self, terms: &[(T, &Self)]) {
        let mut sum = [T::zero(); N];
        for (h, k) in terms {
            for (sum, rate) in sum.iter_mut().zip(&k.data.0[0]) {
                *sum = *sum + *h * *rate;
            }
        }
        for (y, sum) in self.data.0[0].iter_mut().zip(sum) {
            *y = *y + sum;
        }
    }
}

impl<T: Real, const N: usize> Controlled<T> for nalgebra::SVector<T, N> {
    #[inline(always)]
    fn error_ratio(&self, next: &Self, terms: &[(T, &Self)], tolerance: Tolerance<T>) -> T {
        let mut error = Self::from_array_storage(nalgebra::ArrayStorage([[T::zero(); N]]));
        error.add_scaled(terms);
        finite_or_sum(worst(&self.data.0[0], &next.data.0[0], error.data.0[0], tolerance))
    }
}

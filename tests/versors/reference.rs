//! The independent answer: the Taylor series of the exponential in the 16 even dimensions of G(4,1), with scaling and
//! squaring, in double-double numbers. It knows nothing of angles, axes and roots.

use crate::double_double::DoubleDouble;
use ga_physics::algebra::cga::{Even, PointPair};
use ga_physics::algebra::{Real, Scalar};
use std::ops::Neg;

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self::from(0.0) - self
    }
}

impl Scalar for DoubleDouble {
    fn ratio(numerator: i32, denominator: i32) -> Self {
        Self::from(f64::from(numerator)) / Self::from(f64::from(denominator))
    }
    fn sqrt(self) -> Self {
        unreachable!("the series takes no roots")
    }
}

/// Exact.
pub(crate) fn wide<T: Real>(x: T) -> DoubleDouble {
    x.to_f64().into()
}

/// A power of two as a scalar.
pub(crate) fn power_of_two(exponent: i32) -> f64 {
    2.0f64.powi(exponent)
}

/// `exp b`. Each squaring doubles the relative error of 1e-32: with a largest coefficient of 100 it stays under 1e-28.
pub(crate) fn exp<T: Real>(b: PointPair<T>) -> Even<DoubleDouble> {
    let numbers: [f64; 10] = b.map(Real::to_f64).into();
    let largest = numbers.iter().fold(0.0f64, |largest, x| largest.max(x.abs()));
    let mut halvings = 0;
    while largest / power_of_two(halvings) > 0.02 {
        halvings += 1;
    }
    let scaled = Even::from(b.map(|x| wide(x.to_f64() / power_of_two(halvings))));
    let one = Even::from_fn(|index| DoubleDouble::from(if index == 0 { 1.0 } else { 0.0 }));
    // 10 coefficients of 0.02 each multiply by less than 0.2: 0.2^25 / 25! is 1e-43.
    let mut sum = one;
    for k in (1..=25).rev() {
        sum = one + scaled * sum / DoubleDouble::from(f64::from(k));
    }
    for _ in 0..halvings {
        sum = sum * sum;
    }
    sum
}

/// The largest difference of some numbers from the reference, as a part of `scale`.
pub(crate) fn difference<T: Real>(found: &[T], expected: &[DoubleDouble], scale: f64) -> f64 {
    assert_eq!(found.len(), expected.len());
    let distance = |(x, y): (&T, &DoubleDouble)| {
        assert!(x.is_finite(), "{x} is no number");
        let d = wide(*x) - *y;
        (d.hi + d.lo).abs()
    };
    found.iter().zip(expected).map(distance).fold(0.0, f64::max) / scale
}

pub(crate) fn largest(numbers: &[DoubleDouble]) -> f64 {
    numbers.iter().fold(0.0, |largest, x| x.hi.abs().max(largest))
}

pub(crate) fn round<T: Real>(x: DoubleDouble) -> T {
    // f32 is rounded twice, which costs nothing that shows.
    T::from_f64(x.hi + x.lo)
}

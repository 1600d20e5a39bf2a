//! Double-double numbers as scalars, feature `twofloat`: sums `hi + lo` of two f64, about 31 digits, for references.
//!
//! `twofloat` computes; its quotient is replaced. It follows Joldes, Muller and Popescu, *Tight and rigorous error bounds
//! for basic building blocks of double-word arithmetic*, 2017, algorithm 18, but forms `1 - hi/hi'` with a product that
//! is rounded, where the algorithm wants it fused: the quotient of 0.8.4 is right to 1e-16 only. Here it is their
//! algorithm 17, whose error is at most 15 u² + 56 u³ with u = 2^-53, 2e-31.
//!
//! Valid while no product or quotient leaves 1e-290 to 1e300 in size: below, `lo` underflows; above, what is infinite
//! in f64 is not a number here.

use super::Scalar;
use core::ops::{Add, Div, Mul, Neg, Sub};
use twofloat::TwoFloat;

/// A double-double number: a [`TwoFloat`] with a quotient that is accurate.
///
/// ```
/// use ga_physics::algebra::{DoubleDouble, Scalar, g3::{Rotor, Vector}};
///
/// let ratio = DoubleDouble::ratio;
/// let turn = Rotor::new(ratio(3, 5), ratio(0, 1), ratio(0, 1), ratio(-4, 5));
/// let turned = turn.apply(Vector::new(ratio(1, 1), ratio(0, 1), ratio(0, 1)));
/// let error = turned.e1 - ratio(-7, 25);
/// assert!(f64::from(error).abs() < 1e-31);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct DoubleDouble(pub TwoFloat);

impl Scalar for DoubleDouble {
    #[inline]
    fn ratio(numerator: i32, denominator: i32) -> Self {
        Self(TwoFloat::new_div(numerator.into(), denominator.into()))
    }

    #[inline]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
}

impl From<f64> for DoubleDouble {
    #[inline]
    fn from(value: f64) -> Self {
        Self(TwoFloat::from_f64(value))
    }
}

impl From<DoubleDouble> for f64 {
    /// The sum rounded to f64.
    #[inline]
    fn from(value: DoubleDouble) -> Self {
        value.0.hi()
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    /// `q = hi/hi'`, then `q + (a - q b)/hi'`: algorithm 17 of the paper.
    #[inline]
    fn div(self, other: Self) -> Self {
        let quotient = self.0.hi() / other.0.hi();
        let rest = self.0 - other.0 * quotient;
        Self(TwoFloat::new_add(quotient, rest.hi() / other.0.hi()))
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

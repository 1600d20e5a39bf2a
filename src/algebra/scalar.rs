//! What generated code asks of a number.
//!
//! [`Scalar`] is enough for every product and kernel: arithmetic, exact small constants, a square root. It is kept this
//! small so that SIMD lanes, dual numbers, intervals, double-double and exact rationals can all be scalars. [`Real`]
//! adds order and elementary functions, for code that decides.

mod interval;

pub use interval::{Interval, NotAnInterval};

use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A commutative field, as far as its precision goes.
pub trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self> + 'static
{
    /// The constant `numerator / denominator`.
    fn ratio(numerator: i32, denominator: i32) -> Self;

    /// The square root of a number that is not negative.
    #[must_use]
    fn sqrt(self) -> Self;
}

/// An ordered scalar with elementary functions: `f32` and `f64`.
///
/// The elementary functions are those of `libm` in every build, so that results do not depend on the platform.
pub trait Real: Scalar + PartialOrd + Default + fmt::Debug + fmt::Display + fmt::LowerExp + Send + Sync {
    /// The distance from 1 to the next larger number.
    const EPSILON: Self;
    /// Rounds from `f64`.
    fn from_f64(value: f64) -> Self;
    /// Exact, for both scalars.
    fn to_f64(self) -> f64;
    /// |x|
    #[must_use]
    fn abs(self) -> Self;
    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// (sin x, cos x), x in radians.
    fn sin_cos(self) -> (Self, Self);
    /// The angle of the point (x, y) = (other, self), in radians.
    #[must_use]
    fn atan2(self, other: Self) -> Self;
    /// e^x
    #[must_use]
    fn exp(self) -> Self;
    /// The natural logarithm.
    #[must_use]
    fn ln(self) -> Self;
    /// (sinh x, cosh x)
    fn sinh_cosh(self) -> (Self, Self);
    /// The x whose sinh this is.
    #[must_use]
    fn asinh(self) -> Self;
    /// The larger of two numbers.
    #[must_use]
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }
    /// The smaller of two numbers.
    #[must_use]
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
    /// 0
    #[must_use]
    fn zero() -> Self {
        Self::ratio(0, 1)
    }
    /// 1
    #[must_use]
    fn one() -> Self {
        Self::ratio(1, 1)
    }
}

macro_rules! implement {
    ($float:ident, $sqrt:path, $sincos:path, $atan2:path, $exp:path, $ln:path, $sinh:path, $cosh:path, $asinh:path) => {
        impl Scalar for $float {
            #[inline]
            fn ratio(numerator: i32, denominator: i32) -> Self {
                // Folds to a literal: both arguments are constants wherever generated code calls this.
                numerator as $float / denominator as $float
            }
            #[inline]
            fn sqrt(self) -> Self {
                #[cfg(feature = "std")]
                return $float::sqrt(self);
                #[cfg(not(feature = "std"))]
                return $sqrt(self);
            }
        }

        impl Real for $float {
            const EPSILON: Self = $float::EPSILON;
            #[inline]
            #[allow(clippy::cast_possible_truncation, reason = "rounding to f32 is what the caller asks for")]
            fn from_f64(value: f64) -> Self {
                value as $float
            }
            #[inline]
            fn to_f64(self) -> f64 {
                self.into()
            }
            #[inline]
            fn abs(self) -> Self {
                $float::abs(self)
            }
            #[inline]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                $sincos(self)
            }
            #[inline]
            fn atan2(self, other: Self) -> Self {
                $atan2(self, other)
            }
            #[inline]
            fn exp(self) -> Self {
                $exp(self)
            }
            #[inline]
            fn ln(self) -> Self {
                $ln(self)
            }
            #[inline]
            fn sinh_cosh(self) -> (Self, Self) {
                ($sinh(self), $cosh(self))
            }
            #[inline]
            fn asinh(self) -> Self {
                $asinh(self)
            }
        }
    };
}

implement!(
    f32,
    libm::sqrtf,
    libm::sincosf,
    libm::atan2f,
    libm::expf,
    libm::logf,
    libm::sinhf,
    libm::coshf,
    libm::asinhf
);
implement!(f64, libm::sqrt, libm::sincos, libm::atan2, libm::exp, libm::log, libm::sinh, libm::cosh, libm::asinh);

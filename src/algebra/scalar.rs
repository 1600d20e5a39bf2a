//! What generated code asks of a number.
//!
//! [`Scalar`] is enough for every product and kernel: arithmetic, exact small constants, a square root. It is kept this
//! small so that SIMD lanes, dual numbers, intervals, double-double and exact rationals can all be scalars. [`Real`]
//! adds order and elementary functions, for code that decides.
//!
//! One file each for the numbers of other crates, which can be made scalars only here, and for intervals.

#[cfg(feature = "twofloat")]
mod double_double;
#[cfg(feature = "num-dual")]
mod dual;
mod interval;
#[cfg(feature = "wide")]
mod lanes;

#[cfg(feature = "twofloat")]
pub use double_double::DoubleDouble;
pub use interval::{Interval, NotAnInterval};

use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A commutative field, as far as its precision goes. Generated code runs on any type that has it.
///
/// | number | type | feature | for |
/// |---|---|---|---|
/// | floats | `f32`, `f64` | | |
/// | SIMD lanes | `simba::simd::{WideF32x4, WideF32x8, WideF64x4}` | `wide` | many items at once |
/// | double-double | `DoubleDouble` | `twofloat` | references: 31 digits |
/// | dual numbers | `num_dual::{Dual, Dual2, HyperDual, DualVec, Dual2Vec}` | `num-dual` | derivatives |
/// | intervals | [`Interval`] | | enclosures of the exact result |
///
/// The crates `simba`, `twofloat` and `num_dual` are re-exported beside this trait, in the versions whose numbers have it.
/// For a number of your own, implement it in your crate: operators, a constant, a root.
///
/// # Many items at once
///
/// A type of lanes holds as many numbers as a register, and an operation acts on all: a `Point<WideF32x4>` is four
/// points. Where results differ by lane, compare and select by lane; code that branches on a number (everything over
/// [`Real`]) does not run on lanes.
///
/// ```
/// use ga_physics::algebra::cga::{Point, Sphere};
/// use ga_physics::algebra::simba::simd::{SimdBool, SimdPartialOrd, SimdValue, WideF32x4};
///
/// let sphere = Sphere::new(0.0, 0.0, 0.0, 1.0).map(WideF32x4::splat);     // the same in all lanes
/// let points = [[0.5_f32, 0.5, 0.5], [0.9, 0.9, 0.0], [0.0, 0.0, 0.1], [2.0, 0.0, 0.0]];
/// let packed = Point::from_fn(|field| points.map(|point| point[field]).into());
///
/// let inner = packed | sphere;                                            // positive inside
/// let inside = inner.simd_gt(WideF32x4::splat(0.0));
/// assert_eq!(inside.bitmask(), 0b0101);                                   // the first and the third
/// let weight = WideF32x4::splat(1.0).select(inside, WideF32x4::splat(0.0));
/// assert_eq!(<[f32; 4]>::from(weight), [1.0, 0.0, 1.0, 0.0]);
/// ```
///
/// For speed keep items packed, as a `Vec<Point<WideF32x8>>`: an array of structs of lanes, from which a load fills a
/// register. Packing for a single product costs more than the product.
///
/// Which instructions lanes become is decided when the crate is compiled. A plain build for x86-64 has registers of 128
/// bits, and uses two for eight f32 or four f64; `RUSTFLAGS="-C target-cpu=x86-64-v3"` makes it one of 256. Results are
/// the same bits in both, and those of f32 and f64. There is no choice at run time: what a lane type is made of is fixed with
/// the build, so a function that is compiled again for wider registers still adds it half by half (`multiversion` on the
/// motor sandwich of f32: no gain). Who must choose at run time loops over `[f32; 8]` inside such a function, one number
/// at a time, and leaves the rest to the compiler: twice as fast there with AVX2 as without.
///
/// # Derivatives
///
/// ```
/// use ga_physics::algebra::{cga::Point, num_dual::Dual64};
/// use ga_physics::geometry::formulas::circumsphere;
///
/// // How fast does the sphere through four points grow while the first moves outward along x?
/// let rest = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]].map(|p| Point::from(p.map(Dual64::from)));
/// let [a, b, c] = rest;
/// let moving = Point::new(Dual64::new(1.0, 1.0), Dual64::from(0.0), Dual64::from(0.0));
/// let sphere = circumsphere(moving, a, b, c);
/// assert_eq!((sphere.rho_sq.re, sphere.rho_sq.eps), (1.0, 1.0));
/// assert_eq!(sphere.x.eps, 0.5);
/// ```
pub trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self> + 'static
{
    /// The constant `numerator / denominator`, as good as the type can hold it: in all lanes, without derivative,
    /// enclosed.
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
    /// This number as nalgebra's vectors ask for it: itself. (As a supertrait it would make every `abs` and `sqrt`
    /// ambiguous.)
    type Field: nalgebra::RealField + Copy + Send + Sync;
    /// For nalgebra.
    fn to_field(self) -> Self::Field;
    /// From nalgebra.
    fn from_field(field: Self::Field) -> Self;
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
            type Field = Self;
            #[inline(always)]
            fn to_field(self) -> Self {
                self
            }
            #[inline(always)]
            fn from_field(field: Self) -> Self {
                field
            }
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

//! Exact signs: on which side of a plane, or of a sphere, does a point lie?
//!
//! Both are the sign of an outer product of conformal points, as it would be in exact arithmetic:
//!
//! * [`orient3d`]: `d . (a ^ b ^ c ^ ninf)*`, that is `a ^ b ^ c ^ d ^ ninf` against `I`; six times the signed volume of
//!   the tetrahedron.
//! * [`insphere`]: `e . (a ^ b ^ c ^ d)*`, that is minus `a ^ b ^ c ^ d ^ e` against `I`.
//!
//! The signs are decided by the adaptive expansions of Shewchuk, *Adaptive precision floating-point arithmetic and fast
//! robust geometric predicates*, 1997 (crate `robust`): a filter in plain arithmetic, and as many digits as it takes
//! where that is not sure. Expansions are exact as long as nothing over- or underflows. Points with coordinates
//! so large or so small that something might, go to integers instead, which are exact for all finite numbers and some
//! tens of times slower.
//!
//! A staged evaluation of the generated product in the place of the filter would repeat it: in the frame of one of the
//! points it is the same determinant of differences.
//!
//! A sign says nothing of the size: constructions with a tolerance are in the files beside this one.

use super::Degenerate;
use crate::algebra::cga::Point;
use num_bigint::{BigInt, Sign as IntegerSign};
use robust::Coord3D;

/// The sign of a number that need not be known itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Sign {
    /// Less than zero.
    Negative,
    /// Zero exactly.
    Zero,
    /// More than zero.
    Positive,
}

impl core::ops::Neg for Sign {
    type Output = Self;

    fn neg(self) -> Self {
        match self {
            Self::Negative => Self::Positive,
            Self::Zero => Self::Zero,
            Self::Positive => Self::Negative,
        }
    }
}

/// The side of the plane through a, b, c on which d lies: [`Positive`](Sign::Positive) on the side of the normal, by the
/// right-hand rule, where `X . plane` is positive; [`Zero`](Sign::Zero) where the four are in one plane, exactly.
///
/// # Errors
/// A coordinate that is infinite or not a number.
pub fn orient3d(a: Point, b: Point, c: Point, d: Point) -> Result<Sign, Degenerate> {
    let points = [a, b, c, d];
    if in_range(&points, 3)? {
        let [a, b, c, d] = points.map(coordinates);
        // Shewchuk's sign is positive for a point *behind* the plane.
        return Ok(-sign(robust::orient3d(a, b, c, d)));
    }
    let [a, b, c] = differences_to_last(&points);
    Ok(-integer_sign(&determinant(&a, &b, &c)))
}

/// The side of the sphere through a, b, c, d on which e lies: [`Positive`](Sign::Positive) inside, where `X . sphere` is
/// positive, if the four points are positively oriented ([`orient3d`]), and outside if they are negatively oriented;
/// [`Zero`](Sign::Zero) where the five are on one sphere, exactly, or on one plane.
///
/// Four points in one plane have no sphere: then the sign is that of the plane that the sphere degenerates to, whichever
/// way it is turned.
///
/// # Errors
/// A coordinate that is infinite or not a number.
pub fn insphere(a: Point, b: Point, c: Point, d: Point, e: Point) -> Result<Sign, Degenerate> {
    let points = [a, b, c, d, e];
    if in_range(&points, 5)? {
        let [a, b, c, d, e] = points.map(coordinates);
        return Ok(-sign(robust::insphere(a, b, c, d, e)));
    }
    let [a, b, c, d] = differences_to_last(&points);
    let square = |[x, y, z]: &[BigInt; 3]| x * x + y * y + z * z;
    let first = square(&a) * determinant(&b, &c, &d) - square(&b) * determinant(&a, &c, &d);
    let second = square(&c) * determinant(&a, &b, &d) - square(&d) * determinant(&a, &b, &c);
    Ok(integer_sign(&(first + second)))
}

/// Are all coordinates 0, or of a magnitude for which no product of this degree over- or underflows?
///
/// Products of n coordinates up to `2^(960/n)` are at most 2^960, and the sums of them that occur at most 2^12 times that.
/// The last bits of coordinates from `2^(52 - 960/n)` on are multiples of `2^(-960/n)`, so those of products are of
/// 2^-960: all of them are numbers of f64, and so, with their digits, are the error bounds, which are some 2^-50 of sums
/// of products; the least normal number is 2^-1022.
fn in_range(points: &[Point], degree: u64) -> Result<bool, Degenerate> {
    const MAGNITUDE: u64 = u64::MAX >> 1;
    const INFINITY: u64 = f64::INFINITY.to_bits();
    let power_of_two = |exponent: u64| exponent << 52;
    let (lowest, highest) = (power_of_two(1023 + 52 - 960 / degree), power_of_two(1023 + 960 / degree));
    // Magnitudes are ordered as their bits are. One less, and 0 is the largest of all: it does not count for the least.
    let (mut least, mut largest) = (u64::MAX, 0);
    for Point { x, y, z } in points {
        for magnitude in [x, y, z].map(|x| x.to_bits() & MAGNITUDE) {
            least = least.min(magnitude.wrapping_sub(1));
            largest = largest.max(magnitude);
        }
    }
    if largest >= INFINITY { Err(Degenerate::NotFinite) } else { Ok(least >= lowest - 1 && largest <= highest) }
}

fn coordinates(point: Point) -> Coord3D<f64> {
    Coord3D { x: point.x, y: point.y, z: point.z }
}

fn sign(value: f64) -> Sign {
    match value {
        value if value > 0.0 => Sign::Positive,
        value if value < 0.0 => Sign::Negative,
        _ => Sign::Zero,
    }
}

fn integer_sign(value: &BigInt) -> Sign {
    match value.sign() {
        IntegerSign::Minus => Sign::Negative,
        IntegerSign::NoSign => Sign::Zero,
        IntegerSign::Plus => Sign::Positive,
    }
}

/// The differences of the first points to the last, in units of the last bit of any coordinate.
fn differences_to_last<const N: usize, const M: usize>(points: &[Point; N]) -> [[BigInt; 3]; M] {
    let parts = points.map(|point| [point.x, point.y, point.z].map(mantissa_and_exponent));
    let exponents = parts.iter().flatten().filter(|(mantissa, _)| *mantissa != 0).map(|(_, exponent)| *exponent);
    let unit = exponents.min().unwrap_or(0);
    // A zero has the least exponent of all, and stays zero.
    let integers =
        parts.map(|xyz| xyz.map(|(mantissa, exponent)| BigInt::from(mantissa) << exponent.saturating_sub(unit)));
    let last = &integers[N - 1];
    core::array::from_fn(|i| core::array::from_fn(|axis| &integers[i][axis] - &last[axis]))
}

/// `value = mantissa * 2^(exponent - 1075)`, for finite numbers.
fn mantissa_and_exponent(value: f64) -> (i64, u64) {
    const FRACTION: u64 = (1 << 52) - 1;
    let bits = value.to_bits();
    let (exponent, fraction) = (bits >> 52 & 0x7ff, bits & FRACTION);
    // Subnormal numbers have the exponent of the least normal ones, and no leading bit.
    let magnitude = if exponent == 0 { fraction } else { fraction | (FRACTION + 1) };
    let mantissa = magnitude.cast_signed();
    (if value.is_sign_negative() { -mantissa } else { mantissa }, exponent.max(1))
}

/// `u . (v x w)`
fn determinant(u: &[BigInt; 3], v: &[BigInt; 3], w: &[BigInt; 3]) -> BigInt {
    let minor = |i: usize, j: usize| &v[i] * &w[j] - &v[j] * &w[i];
    &u[0] * minor(1, 2) + &u[1] * minor(2, 0) + &u[2] * minor(0, 1)
}

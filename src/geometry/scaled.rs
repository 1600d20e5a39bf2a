//! Differences to a first point, and the power of two that brings them near 1.
//!
//! Products of three or four coordinates leave the range of the scalar long before the coordinates do: the sphere through
//! four points 1e-100 apart has a weight of 1e-300, and its square is zero. Division by a power of two loses nothing, so
//! that what is computed of the scaled differences has the digits that it would have in a wider range.

use super::Degenerate;
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;

/// The differences from a point to others.
///
/// # Errors
/// A coordinate that is not finite, a difference that overflows.
pub(super) fn differences<T: Real, const N: usize>(
    from: Point<T>,
    to: [Point<T>; N],
) -> Result<[Vector<T>; N], Degenerate> {
    let finite = |p: Point<T>| p.x.is_finite() && p.y.is_finite() && p.z.is_finite();
    let found = to.map(|point| from.displacement_to(point));
    if !(finite(from) && to.iter().all(|point| finite(*point))) {
        return Err(Degenerate::NotFinite);
    }
    let in_range = found.iter().all(|u| finite(Point::from(*u)));
    if in_range { Ok(found) } else { Err(Degenerate::OutOfRange) }
}

/// The power of two that brings the largest component to between 1 and 2 when it divides; 1 where all are zero.
pub(super) fn power_of_two<T: Real>(vectors: &[Vector<T>]) -> T {
    /// The exponent of an f64, with sign and fraction cleared: a power of two.
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    let component = |largest: T, u: &Vector<T>| largest.max(u.e1.abs()).max(u.e2.abs()).max(u.e3.abs());
    let largest = vectors.iter().fold(T::zero(), component).to_f64();
    if largest == 0.0 {
        return T::one();
    }
    // The subnormal numbers of f64 have no exponent of their own; the least normal one brings them high enough.
    T::from_f64(f64::from_bits(largest.to_bits() & EXPONENT).max(f64::MIN_POSITIVE))
}

/// A length squared back in the given unit.
///
/// # Errors
/// It overflows, or loses digits below the smallest normal number.
pub(super) fn squared_in<T: Real>(scaled: T, unit: T) -> Result<T, Degenerate> {
    let squared = scaled * unit * unit;
    // Powers of two cancel exactly, unless something was lost.
    if squared / unit / unit == scaled { Ok(squared) } else { Err(Degenerate::OutOfRange) }
}

/// Whether a product is so small that its digits are lost: the smallest normal number times epsilon is the smallest
/// number of all, and what is below it is rounded to zero.
pub(super) fn is_subnormal<T: Real>(product: T) -> bool {
    product.abs() * T::EPSILON == T::zero()
}

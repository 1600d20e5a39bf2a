//! Length and direction of a bivector of G(3,0), over the whole range of the scalar.

use crate::algebra::Real;
use crate::algebra::g3::{Bivector, Vector};

/// `|b|` and `b / |b|`; zero has length zero and no direction, given as zero.
///
/// The plain root of the squares errs by an epsilon, and is taken where they keep their digits. Elsewhere the largest
/// component is divided out first, which costs another epsilon.
pub(super) fn direction<T: Real>(b: Bivector<T>) -> (T, Bivector<T>) {
    let norm_sq = b.norm_sq();
    // The smallest normal number times epsilon is the smallest number of all: below it digits are lost.
    if norm_sq.is_finite() && norm_sq * T::EPSILON > T::zero() {
        let norm = norm_sq.sqrt();
        return (norm, b / norm);
    }
    let largest = b.e23.abs().max(b.e31.abs()).max(b.e12.abs());
    if !(largest > T::zero()) {
        return (T::zero(), Bivector::default());
    }
    let scaled = b / largest;
    let norm = scaled.norm_sq().sqrt();
    (largest * norm, scaled / norm)
}

/// The component of a vector along the axis of a plane: the coefficient of `axis ^ v` in e123.
pub(super) fn along<T: Real>(axis: Bivector<T>, v: Vector<T>) -> T {
    (axis ^ v).e123
}

/// The vector of a given length along the axis of a plane.
pub(super) fn axial<T: Real>(axis: Bivector<T>, length: T) -> Vector<T> {
    Vector::new(axis.e23 * length, axis.e31 * length, axis.e12 * length)
}

/// `x / f(x)` or `f(x) / x` for an odd function of slope 1, at its limit 1 where both are zero.
///
/// Sine and arc tangent are good to an ulp however small x is, so this quotient needs no series; the higher ones, like
/// `(cos x - sin x / x) / x²`, do, and nothing here is built on them.
pub(super) fn quotient<T: Real>(numerator: T, denominator: T) -> T {
    if denominator == T::zero() { T::one() } else { numerator / denominator }
}

//! Whether numbers that come from outside are those of a unit type.

use crate::algebra::Real;

/// Is `a ~a = 1`, up to what rounding explains?
///
/// Every coefficient of `a ~a` may be off by the square root of epsilon times the numbers that it is made of. A product
/// of n unit versors is off by a few n epsilons, so a value that drifts passes for some 1e7 products in f64, a thousand
/// in f32; beyond that half of the digits have gone, and whoever reads the value would work with wrong lengths.
///
/// `metric` are the numbers that the scalar coefficient is made of; the other coefficients are sums of products of one
/// of them with any of the `numbers`: a translation of 1e9 m does not loosen the check of its rotation. Large
/// metric numbers do: that of a boost, or of a dilator by 1e9, says little.
#[must_use]
pub fn is_unit<T: Real>(metric: &[T], numbers: &[T], scalar: T, others: &[T]) -> bool {
    let largest = |values: &[T]| values.iter().fold(T::one(), |largest, value| largest.max(value.abs()));
    let (metric, numbers) = (largest(metric), largest(numbers));
    let tolerance = T::EPSILON.sqrt() * metric;
    // An overflow is no unit, even where the tolerance overflows with it.
    let within = |defect: T, tolerance: T| defect.is_finite() && defect.abs() <= tolerance;
    within(scalar - T::one(), tolerance * metric) && others.iter().all(|other| within(*other, tolerance * numbers))
}

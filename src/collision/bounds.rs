//! Bounding balls.

use crate::algebra::Real;
use crate::algebra::cga::Sphere;

/// Do two balls have a point in common? `s1 . s2 + r1 r2 >= 0`, which is `d <= r1 + r2`.
///
/// The report's test, that the spheres meet in a real circle, misses a ball within a ball.
#[must_use]
pub fn balls_overlap<T: Real>(first: Sphere<T>, second: Sphere<T>) -> bool {
    (first | second) + (first.rho_sq * second.rho_sq).sqrt() >= T::zero()
}

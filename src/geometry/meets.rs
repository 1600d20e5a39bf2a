//! Where lines, planes and spheres meet.

use super::rounds::CircleParts;
use super::{Degenerate, line_through};
use crate::algebra::Real;
use crate::algebra::cga::{self, DualLine, Line, Plane, Point, Sphere};
use crate::algebra::g3::Vector;

/// Line and plane are taken for parallel when the sine of their angle is below this many epsilons: the inner product of
/// two unit directions is off by at most 3 unit roundoffs a product, and the sum of the absolute products is below 1.
const PARALLEL_EPSILONS: f64 = 3.0;

/// The point in which the line through two points meets a plane, formed in the frame of `a`: `pi | (a ^ b ^ ninf)`.
///
/// # Errors
/// Coincident points, a line parallel to the plane within rounding, a number that is not finite.
pub fn line_meets_plane<T: Real>(a: Point<T>, b: Point<T>, plane: Plane<T>) -> Result<Point<T>, Degenerate> {
    line_through(a, b)?;
    let flat = cga::line_meets_plane_relative(a, b, plane);
    let direction = a.displacement_to(b).norm_sq();
    let bound = T::from_f64(PARALLEL_EPSILONS) * T::EPSILON;
    if !(flat.no_ninf * flat.no_ninf > bound * bound * direction) {
        return Err(Degenerate::ParallelLineAndPlane);
    }
    Ok(a.moved(flat.point()?.position()))
}

/// The line in which two planes meet, direct: `undual(pi1 ^ pi2)`; it points along `nu1 x nu2`.
///
/// # Errors
/// Planes that are parallel within rounding.
pub fn planes_meet<T: Real>(first: Plane<T>, second: Plane<T>) -> Result<Line<T>, Degenerate> {
    let dual: DualLine<T> = first ^ second;
    let sine_sq = dual.e23 * dual.e23 + dual.e31 * dual.e31 + dual.e12 * dual.e12;
    let bound = T::from_f64(PARALLEL_EPSILONS) * T::EPSILON;
    if !(sine_sq > bound * bound) {
        return Err(Degenerate::ParallelPlanes);
    }
    Ok(dual.undual())
}

/// How two real spheres lie to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpheresMeet<T = f64> {
    /// In a circle; a tangent pair meets in one of radius 0. The normal points from the first centre to the second.
    Circle(CircleParts<T>),
    /// Outside one another.
    Separate,
    /// One lies inside the other without touching it.
    Nested,
    /// The same centre: they coincide, or one lies inside the other.
    Concentric,
}

/// The meet of two spheres, `undual(s1 ^ s2)`, in the frame of the first centre.
///
/// There the first sphere is `no - r1²/2 ninf`, and with the second centre at d along the unit vector u the radical plane
/// is at `h = (d² + r1² - r2²) / 2d`, the circle's radius squared is `r1² - h²`.
///
/// # Errors
/// An imaginary sphere, a number that is not finite.
pub fn spheres_meet<T: Real>(first: Sphere<T>, second: Sphere<T>) -> Result<SpheresMeet<T>, Degenerate> {
    let (r1, r2) = (first.radius()?, second.radius()?);
    let along = first.centre().displacement_to(second.centre());
    let distance = along.norm_sq().sqrt();
    if !(distance.is_finite() && r1.is_finite() && r2.is_finite()) {
        return Err(Degenerate::NotFinite);
    }
    if distance == T::zero() {
        return Ok(SpheresMeet::Concentric);
    }
    if distance > r1 + r2 {
        return Ok(SpheresMeet::Separate);
    }
    if distance < (r1 - r2).abs() {
        return Ok(SpheresMeet::Nested);
    }
    let half = T::ratio(1, 2);
    // (r1 - r2)(r1 + r2) in the place of r1² - r2²: no digits are lost for nearly equal radii.
    let height = (distance + (r1 - r2) * (r1 + r2) / distance) * half;
    let radius_sq = ((r1 - height) * (r1 + height)).max(T::zero());
    let normal: Vector<T> = along / distance;
    let centre = first.centre().moved(normal * height);
    Ok(SpheresMeet::Circle(CircleParts { centre, radius: radius_sq.sqrt(), normal }))
}

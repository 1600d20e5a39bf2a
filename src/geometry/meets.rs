//! Where lines, planes and spheres meet.

use super::rounds::CircleParts;
use super::scaled::{differences, power_of_two};
use super::{Degenerate, formulas};
use crate::algebra::Real;
use crate::algebra::cga::{DualLine, Line, Plane, Point, Sphere};
use crate::algebra::g3::Vector;

/// Line and plane are taken for parallel when the sine of their angle is below this many epsilons: the inner product of
/// two unit directions is off by at most 3 unit roundoffs a product, and the sum of the absolute products is below 1.
const PARALLEL_EPSILONS: f64 = 3.0;

/// The point in which the line through two points meets a plane, formed in the frame of `a`: `pi | (a ^ b ^ ninf)`.
///
/// # Errors
/// Coincident points, a line parallel to the plane within rounding, a number that is not finite.
pub fn line_meets_plane<T: Real>(a: Point<T>, b: Point<T>, plane: Plane<T>) -> Result<Point<T>, Degenerate> {
    let edges = differences(a, [b])?;
    if a == b {
        return Err(Degenerate::CoincidentPoints);
    }
    // Seen from `a` the plane is `nu - height ninf`. The length of u does not matter: it is brought near 1.
    let height = plane.signed_distance(a);
    if !height.is_finite() {
        return Err(Degenerate::NotFinite);
    }
    let local = Plane::new(plane.e1, plane.e2, plane.e3, -height);
    let [u] = edges.map(|edge| edge / power_of_two(&edges));
    let flat = formulas::line_meets_plane_relative(Point::origin(), u.into(), local);
    let bound = T::from_f64(PARALLEL_EPSILONS) * T::EPSILON;
    if flat.no_ninf.abs() <= bound * u.norm_sq().sqrt() {
        return Err(Degenerate::ParallelLineAndPlane);
    }
    Ok(a.moved(flat.point()?.position()))
}

/// The line in which two planes meet, direct: `undual(pi1 ^ pi2)`; it points along `nu1 x nu2`.
///
/// # Errors
/// Planes that are parallel within rounding, a number that is not finite.
pub fn planes_meet<T: Real>(first: Plane<T>, second: Plane<T>) -> Result<Line<T>, Degenerate> {
    let dual: DualLine<T> = first ^ second;
    if !<[T; 6]>::from(dual).iter().all(|part| part.is_finite()) {
        return Err(Degenerate::NotFinite);
    }
    let sine_sq = dual.e23 * dual.e23 + dual.e31 * dual.e31 + dual.e12 * dual.e12;
    let bound = T::from_f64(PARALLEL_EPSILONS) * T::EPSILON;
    if sine_sq <= bound * bound {
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
/// is at `h = (d² + r1² - r2²) / 2d`. The circle's radius `sqrt(r1² - h²)` is the height of a triangle with the sides
/// r1, r2 and d; Heron's formula in factors keeps its digits also where one sphere is much larger than the other.
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
    let sum = r1 + r2;
    let spread = (r1 - r2).abs();
    // Not negative: separate and nested spheres have left above.
    let radius =
        ((distance + sum) * (sum - distance)).sqrt() * ((distance - spread) * (distance + spread)).sqrt() * half
            / distance;
    let normal: Vector<T> = along / distance;
    let centre = first.centre().moved(normal * height);
    Ok(SpheresMeet::Circle(CircleParts { centre, radius, normal }))
}

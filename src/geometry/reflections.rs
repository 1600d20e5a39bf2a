//! Reflections of points in planes, lines and spheres: `M X M` up to weight (report, equation 20), in the frame of the
//! point.

use super::Degenerate;
use crate::algebra::Real;
use crate::algebra::cga::{self, Line, Plane, Point, Sphere};

/// The mirror image in a plane.
#[must_use]
pub fn reflect_in_plane<T: Real>(point: Point<T>, plane: Plane<T>) -> Point<T> {
    cga::reflect_in_plane(point, plane)
}

/// The image under the half-turn round a line.
///
/// # Errors
/// A line without direction.
pub fn reflect_in_line<T: Real>(point: Point<T>, line: Line<T>) -> Result<Point<T>, Degenerate> {
    let image = cga::reflect_in_line_relative(point, line).centre()?;
    Ok(point.moved(image.position()))
}

/// The point of a line that is nearest to a point: the middle between the point and its image.
///
/// # Errors
/// A line without direction.
pub fn closest_point_on_line<T: Real>(point: Point<T>, line: Line<T>) -> Result<Point<T>, Degenerate> {
    let image = cga::reflect_in_line_relative(point, line).centre()?;
    Ok(point.moved(image.position() * T::ratio(1, 2)))
}

/// The inverse in a sphere: on the ray from the centre, at distance `rho² / d`.
///
/// # Errors
/// The centre itself.
pub fn invert_in_sphere<T: Real>(point: Point<T>, sphere: Sphere<T>) -> Result<Point<T>, Degenerate> {
    let image = cga::reflect_in_sphere(point, sphere);
    let finite = image.x.is_finite() && image.y.is_finite() && image.z.is_finite();
    if finite { Ok(image) } else { Err(Degenerate::CentreOfInversion) }
}

//! Reflections of points in planes, lines and spheres: `M X M` up to weight (report, equation 20), in the frame of the
//! point.

use super::scaled::{differences, power_of_two};
use super::{Degenerate, formulas};
use crate::algebra::Real;
use crate::algebra::cga::{Line, Plane, Point, Sphere};
use crate::algebra::g3::Vector;

/// The mirror image in a plane.
#[must_use]
pub fn reflect_in_plane<T: Real>(point: Point<T>, plane: Plane<T>) -> Point<T> {
    formulas::reflect_in_plane(point, plane)
}

/// The image under the half-turn round a line.
///
/// # Errors
/// A line without direction.
pub fn reflect_in_line<T: Real>(point: Point<T>, line: Line<T>) -> Result<Point<T>, Degenerate> {
    Ok(point.moved(to_image(point, line)?))
}

/// The point of a line that is nearest to a point: the middle between the point and its image.
///
/// # Errors
/// A line without direction.
pub fn closest_point_on_line<T: Real>(point: Point<T>, line: Line<T>) -> Result<Point<T>, Degenerate> {
    Ok(point.moved(to_image(point, line)? * T::ratio(1, 2)))
}

/// From a point to its image in a line. The kernel is quadratic in the line, whose weight does not matter: a power of two
/// is taken out, so that short lines do not underflow.
fn to_image<T: Real>(point: Point<T>, line: Line<T>) -> Result<Vector<T>, Degenerate> {
    let unit = power_of_two(&[Vector::new(line.e1_no_ninf, line.e2_no_ninf, line.e3_no_ninf)]);
    let image = formulas::reflect_in_line_relative(point, line.map(|part| part / unit));
    Ok(image.centre()?.position())
}

/// The inverse in a sphere: on the ray from the centre, at distance `rho² / d`.
///
/// That is `s X s` in the frame of the centre C, where `s = C - rho²/2 ninf`. In the frame of X, which the kernel
/// `formulas::reflect_in_sphere` uses, the image of a far point is the small difference of two long vectors: at `d = 1e8 rho`
/// nothing of it would be left.
///
/// # Errors
/// The centre itself, or a point so near to it that the image overflows; a number that is not finite.
pub fn invert_in_sphere<T: Real>(point: Point<T>, sphere: Sphere<T>) -> Result<Point<T>, Degenerate> {
    let [arm] = differences(sphere.centre(), [point])?;
    if !sphere.rho_sq.is_finite() {
        return Err(Degenerate::NotFinite);
    }
    // rho² x / d² with x and d in a unit in which d² neither overflows nor underflows.
    let unit = power_of_two(&[arm]);
    let scaled = arm / unit;
    let image = sphere.centre().moved(scaled * (sphere.rho_sq / scaled.norm_sq() / unit));
    let finite = image.x.is_finite() && image.y.is_finite() && image.z.is_finite();
    if finite { Ok(image) } else { Err(Degenerate::CentreOfInversion) }
}

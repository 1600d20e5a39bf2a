//! Lines and planes through points.

use super::Degenerate;
use super::rounds::{COLLINEAR_EPSILONS, finite};
use crate::algebra::Real;
use crate::algebra::cga::{self, Infinity, Line, Plane, Point};

/// The line `a ^ b ^ ninf`, from `a` to `b`; its norm is their distance.
///
/// # Errors
/// Coincident points, a coordinate that is not finite.
pub fn line_through<T: Real>(a: Point<T>, b: Point<T>) -> Result<Line<T>, Degenerate> {
    finite(&[a, b])?;
    if a == b {
        return Err(Degenerate::CoincidentPoints);
    }
    Ok(a ^ b ^ Infinity)
}

/// The plane through three points, its unit normal by the right-hand rule (counter-clockwise seen from where it
/// points). Formed in the frame of `a`.
///
/// # Errors
/// Collinear points, a coordinate that is not finite.
pub fn plane_through<T: Real>(a: Point<T>, b: Point<T>, c: Point<T>) -> Result<Plane<T>, Degenerate> {
    finite(&[a, b, c])?;
    let (u, v) = (a.displacement_to(b), a.displacement_to(c));
    let plane = cga::plane_relative(a, b, c);
    let doubled_area_sq = plane.e1 * plane.e1 + plane.e2 * plane.e2 + plane.e3 * plane.e3;
    let bound = T::from_f64(COLLINEAR_EPSILONS) * T::EPSILON;
    // Not `<=`: a product that underflowed, or is not a number, is degenerate as well.
    if !(doubled_area_sq > bound * bound * u.norm_sq() * v.norm_sq()) {
        return Err(Degenerate::CollinearPoints);
    }
    let scale = T::one() / doubled_area_sq.sqrt();
    let normal = crate::algebra::g3::Vector::new(plane.e1 * scale, plane.e2 * scale, plane.e3 * scale);
    Ok(Plane::with_normal_through(normal, a))
}

impl<T: Real> Plane<T> {
    /// The plane with a given unit normal through a point: `nu + (nu . a) ninf`.
    #[must_use]
    pub fn with_normal_through(normal: crate::algebra::g3::Vector<T>, through: Point<T>) -> Self {
        Self::new(normal.e1, normal.e2, normal.e3, normal | through.position())
    }

    /// The unit normal.
    #[must_use]
    pub fn normal(self) -> crate::algebra::g3::Vector<T> {
        crate::algebra::g3::Vector::new(self.e1, self.e2, self.e3)
    }

    /// `X . pi = nu . x - delta`: positive on the side to which the normal points.
    #[must_use]
    pub fn signed_distance(self, point: Point<T>) -> T {
        point | self
    }
}

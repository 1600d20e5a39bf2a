//! Lines and planes through points.

use super::rounds::COLLINEAR_EPSILONS;
use super::scaled::{differences, power_of_two};
use super::{Degenerate, formulas};
use crate::algebra::Real;
use crate::algebra::cga::{Infinity, Line, Plane, Point};

/// The line `a ^ b ^ ninf`, from `a` to `b`; `L² = -<L ~L>` is their distance squared.
///
/// Formed as `a ^ u ^ ninf` with `u = b - a`, which is the same: the moment `a ^ b` of two far points would lose as many
/// digits more as their distance is smaller than that from the origin. Its components `ei_no_ninf` are those of `-u`.
///
/// # Errors
/// Coincident points, a coordinate that is not finite.
pub fn line_through<T: Real>(a: Point<T>, b: Point<T>) -> Result<Line<T>, Degenerate> {
    let [u] = differences(a, [b])?;
    if a == b {
        return Err(Degenerate::CoincidentPoints);
    }
    Ok(a ^ u ^ Infinity)
}

/// The plane through three points, its unit normal by the right-hand rule (counter-clockwise seen from where it
/// points). Formed in the frame of `a`.
///
/// # Errors
/// Collinear points, a coordinate that is not finite.
pub fn plane_through<T: Real>(a: Point<T>, b: Point<T>, c: Point<T>) -> Result<Plane<T>, Degenerate> {
    // Only the direction of u ^ v matters: each edge is brought near 1 by itself.
    let [u, v] = differences(a, [b, c])?.map(|edge| edge / power_of_two(&[edge]));
    let plane = formulas::plane_relative(Point::origin(), u.into(), v.into());
    let doubled_area_sq = plane.e1 * plane.e1 + plane.e2 * plane.e2 + plane.e3 * plane.e3;
    let bound = T::from_f64(COLLINEAR_EPSILONS) * T::EPSILON;
    if doubled_area_sq <= bound * bound * u.norm_sq() * v.norm_sq() {
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

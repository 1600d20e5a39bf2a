//! Points and displacements: embedding into the conformal model, extraction from it.
//!
//! `Point + Point` does not exist: a point plus a *displacement* is a point ([`Point::moved`]), and the sum of two
//! conformal points is a sphere, which is written `Round::from(a) + Round::from(b)`.

use super::Degenerate;
use crate::algebra::cga::{FlatPoint, Point, Round};
use crate::algebra::g3::Vector;
use crate::algebra::{Real, Scalar};

impl<T: Scalar> Point<T> {
    /// The origin.
    #[must_use]
    pub fn origin() -> Self {
        Self::from_fn(|_| T::ratio(0, 1))
    }

    /// The vector from the origin to the point.
    #[inline]
    #[must_use]
    pub fn position(self) -> Vector<T> {
        Vector::new(self.x, self.y, self.z)
    }

    /// The vector that leads from this point to another.
    #[inline]
    #[must_use]
    pub fn displacement_to(self, other: Self) -> Vector<T> {
        Vector::new(other.x - self.x, other.y - self.y, other.z - self.z)
    }

    /// The point at a displacement from this one.
    #[inline]
    #[must_use]
    pub fn moved(self, by: Vector<T>) -> Self {
        Self::new(self.x + by.e1, self.y + by.e2, self.z + by.e3)
    }

    /// The squared distance, `-2 X . Y`, with the differences taken first.
    #[inline]
    #[must_use]
    pub fn distance_sq_to(self, other: Self) -> T {
        (self | other) * T::ratio(-2, 1)
    }
}

impl<T: Scalar> From<Vector<T>> for Point<T> {
    /// The point at this displacement from the origin.
    #[inline]
    fn from(position: Vector<T>) -> Self {
        Self::new(position.e1, position.e2, position.e3)
    }
}

impl<T: Real> Round<T> {
    /// The centre: the Euclidean part over the weight. A point is its own centre.
    ///
    /// # Errors
    /// No weight, or a number that is not finite.
    pub fn centre(self) -> Result<Point<T>, Degenerate> {
        over_weight([self.e1, self.e2, self.e3], self.no)
    }
}

impl<T: Real> FlatPoint<T> {
    /// The finite point X of `X ^ ninf`.
    ///
    /// # Errors
    /// A direction, not a point, or a number that is not finite.
    pub fn point(self) -> Result<Point<T>, Degenerate> {
        over_weight([self.e1_ninf, self.e2_ninf, self.e3_ninf], self.no_ninf)
    }
}

fn over_weight<T: Real>(parts: [T; 3], weight: T) -> Result<Point<T>, Degenerate> {
    if !(weight.is_finite() && parts.iter().all(|part| part.is_finite())) {
        return Err(Degenerate::NotFinite);
    }
    let point = Point::from(parts.map(|part| part / weight));
    let finite = [point.x, point.y, point.z].iter().all(|part| part.is_finite());
    if finite { Ok(point) } else { Err(Degenerate::PointAtInfinity) }
}

//! Spheres and circles through points, in the local frame of the first point.
//!
//! The report's example of its library (Fig. 14), corrected: the blade of four points, the check of its orientation on
//! the *dual vector* (on the 4-blade that inner product has no scalar part, and is never positive), single components
//! read and set, the dual kept.
//!
//! ```
//! use ga_physics::algebra::cga::{Point, Round};
//!
//! fn four_point_sphere(one: Point, two: Point, three: Point, four: Point) -> Round {
//!     // The 4-blade of the spherical shell, and its dual vector.
//!     let shell = one ^ two ^ three ^ four;
//!     let mut sphere: Round = shell.dual();
//!     // The order of the points decides the sign. ninf . s = -(weight): make the weight positive, component by
//!     // component, so that s . X is positive inside.
//!     if sphere.no < 0.0 {
//!         sphere.e1 = -sphere.e1;
//!         sphere.e2 = -sphere.e2;
//!         sphere.e3 = -sphere.e3;
//!         sphere.no = -sphere.no;
//!         sphere.ninf = -sphere.ninf;
//!     }
//!     sphere
//! }
//!
//! let [a, b, c, d] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]].map(Point::from);
//! for sphere in [four_point_sphere(a, b, c, d), four_point_sphere(b, a, c, d)] {
//!     assert!((Point::new(0.5, 0.0, 0.0) | sphere) > 0.0, "inside");
//!     assert!((Point::new(0.0, 2.0, 0.0) | sphere) < 0.0, "outside");
//! }
//! ```

use super::scaled::{differences, is_subnormal, power_of_two, squared_in};
use super::{Degenerate, formulas, plane_through};
use crate::algebra::Real;
use crate::algebra::cga::{Circle, Infinity, Point, Round, Sphere};
use crate::algebra::g3::Vector;

/// Three points are taken for collinear when twice their area is within this many epsilons of the product of two edges.
///
/// Each component of the cross product of two differences is off by at most 5 unit roundoffs (two differences, product,
/// subtraction) of its two products, whose sum is at most |u| |v|; over three components that is
/// `5/2 sqrt(3) eps |u| |v|`, doubled for the second product of each component.
pub(super) const COLLINEAR_EPSILONS: f64 = 9.0;

/// Four points are taken for coplanar when six times their volume is within this many epsilons of the product of three
/// edges: 8 unit roundoffs a product (three differences, two products, three additions), and at most `3 sqrt(3)`
/// |u| |v| |w| for the sum of the absolute products.
const COPLANAR_EPSILONS: f64 = 21.0;

/// The sphere through four points: `dual(a ^ b ^ c ^ d)`, normalised, in the frame of `a`.
///
/// # Errors
/// Points that lie in one plane within rounding, a coordinate that is not finite, a squared radius out of range.
pub fn sphere_through<T: Real>(a: Point<T>, b: Point<T>, c: Point<T>, d: Point<T>) -> Result<Sphere<T>, Degenerate> {
    let edges = differences(a, [b, c, d])?;
    let unit = power_of_two(&edges);
    let [u, v, w] = edges.map(|edge| edge / unit);
    let round = formulas::circumsphere_relative(Point::origin(), u.into(), v.into(), w.into());
    let bound = T::from_f64(COPLANAR_EPSILONS) * T::EPSILON;
    if round.no.abs() <= bound * u.norm_sq().sqrt() * v.norm_sq().sqrt() * w.norm_sq().sqrt() {
        return Err(Degenerate::CoplanarPoints);
    }
    let centre = relative_centre(round)?;
    let moved = a.moved(centre * unit);
    Ok(Sphere::new(moved.x, moved.y, moved.z, squared_in(centre.norm_sq(), unit)?))
}

/// The smallest sphere through two points: `(A + B)/2 + (A . B)/2 ninf`.
///
/// # Errors
/// Coincident points, a coordinate that is not finite, a squared radius out of range.
pub fn sphere_through_pair<T: Real>(a: Point<T>, b: Point<T>) -> Result<Sphere<T>, Degenerate> {
    let edges = differences(a, [b])?;
    if a == b {
        return Err(Degenerate::CoincidentPoints);
    }
    let unit = power_of_two(&edges);
    let [half] = edges.map(|edge| edge / unit * T::ratio(1, 2));
    let centre = formulas::pair_sphere(a, b).centre();
    Ok(Sphere::new(centre.x, centre.y, centre.z, squared_in(half.norm_sq(), unit)?))
}

/// A circle by centre, radius and plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CircleParts<T = f64> {
    /// The centre.
    pub centre: Point<T>,
    /// The radius.
    pub radius: T,
    /// The unit normal of its plane, by the right-hand rule in the order of the points.
    pub normal: Vector<T>,
}

/// The circle through three points, formed in the frame of `a`.
///
/// # Errors
/// Collinear points, a coordinate that is not finite, edges of such different length that the square of the area is out
/// of range.
pub fn circle_through<T: Real>(a: Point<T>, b: Point<T>, c: Point<T>) -> Result<CircleParts<T>, Degenerate> {
    let normal = plane_through(a, b, c)?.normal();
    let edges = differences(a, [b, c])?;
    let unit = power_of_two(&edges);
    let [u, v] = edges.map(|edge| edge / unit);
    let centre = relative_centre(formulas::circle_sphere_relative(Point::origin(), u.into(), v.into()))?;
    Ok(CircleParts { centre: a.moved(centre * unit), radius: centre.norm_sq().sqrt() * unit, normal })
}

/// Centre, radius and normal of a circle given by its blade `K`: the centre is that of `K ninf K`,
/// `rho² = -K² / (ninf ^ K)²`.
///
/// A blade in world coordinates has lost `eps d²` of the radius squared, d its distance from the origin: prefer
/// [`circle_through`] where the points are known.
///
/// # Errors
/// No plane (`ninf ^ K = 0`), an imaginary radius, a number that is not finite.
pub fn circle_parts<T: Real>(circle: Circle<T>) -> Result<CircleParts<T>, Degenerate> {
    let plane = (circle ^ Infinity).dual();
    let plane_sq = plane.e1 * plane.e1 + plane.e2 * plane.e2 + plane.e3 * plane.e3;
    if !plane_sq.is_finite() {
        return Err(Degenerate::NotFinite);
    }
    if plane_sq == T::zero() {
        return Err(Degenerate::PointAtInfinity);
    }
    // K² = -<K ~K> for a 3-vector, and (ninf ^ K)² = -|nu|² for the 4-blade.
    let rho_sq = -circle.norm_sq() / plane_sq;
    let centre = formulas::circle_centre(circle).centre()?;
    if !rho_sq.is_finite() {
        return Err(Degenerate::NotFinite);
    }
    if rho_sq < T::zero() {
        return Err(Degenerate::ImaginaryRound);
    }
    let scale = T::one() / plane_sq.sqrt();
    let normal = Vector::new(plane.e1 * scale, plane.e2 * scale, plane.e3 * scale);
    Ok(CircleParts { centre, radius: rho_sq.sqrt(), normal })
}

/// From a point on a round to its centre, for a round that is relative to that point.
fn relative_centre<T: Real>(round: Round<T>) -> Result<Vector<T>, Degenerate> {
    if is_subnormal(round.no) {
        return Err(Degenerate::OutOfRange);
    }
    Ok(Vector::new(round.e1, round.e2, round.e3) / round.no)
}

impl<T: Real> Sphere<T> {
    /// The sphere with a centre and a radius.
    #[must_use]
    pub fn around(centre: Point<T>, radius: T) -> Self {
        Self::new(centre.x, centre.y, centre.z, radius * radius)
    }

    /// The centre.
    #[must_use]
    pub fn centre(self) -> Point<T> {
        Point::new(self.x, self.y, self.z)
    }

    /// The radius.
    ///
    /// # Errors
    /// A negative `rho_sq`: the sphere is imaginary. One that is not finite.
    pub fn radius(self) -> Result<T, Degenerate> {
        if !self.rho_sq.is_finite() {
            return Err(Degenerate::NotFinite);
        }
        if self.rho_sq >= T::zero() { Ok(self.rho_sq.sqrt()) } else { Err(Degenerate::ImaginaryRound) }
    }
}

/// The sphere with the report's sign, `X . s < 0` inside (and `ninf . s = +1`): minus ours.
#[must_use]
pub fn inside_is_negative<T: Real>(sphere: Sphere<T>) -> Round<T> {
    -Round::from(sphere)
}

//! A triangular facet ready for crossing tests: its plane and its reciprocal frame.
//!
//! With `Phi = P1 ^ P2 ^ P3 ^ ninf` and `L1 = P2 ^ P3, ...` the vectors `P^i = -(ninf ^ L_i) | Phi / |Phi|²` satisfy
//! `P^i . P_j = delta_ij`; the barycentric coordinates of a point X of the plane are `P^i . X` (report, equations 43 to
//! 46; the printed sign gives `-delta_ij`). They are formed once for a facet, in the frame of its own vertices.

use super::scaled::{differences, is_subnormal, power_of_two};
use super::{Degenerate, formulas, plane_through};
use crate::algebra::Real;
use crate::algebra::cga::{Plane, Point};
use crate::algebra::g3::Vector;

/// A facet of a body, counter-clockwise seen from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet<T = f64> {
    /// The corners.
    pub corners: [Point<T>; 3],
    /// The plane; its normal points out.
    pub plane: Plane<T>,
    /// The Euclidean parts of the reciprocal vectors: the gradients of the barycentric coordinates.
    gradients: [Vector<T>; 3],
}

/// How a segment crosses a facet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing<T = f64> {
    /// Where.
    pub point: Point<T>,
    /// How far along the segment, 0 at its start.
    pub fraction: T,
    /// The barycentric coordinates; the smallest belongs to the corner opposite the nearest edge.
    pub barycentric: [T; 3],
}

impl<T: Real> Facet<T> {
    /// The facet with three corners.
    ///
    /// # Errors
    /// Collinear corners, a coordinate that is not finite, edges of such different length that the square of the area is
    /// out of range.
    pub fn new(corners: [Point<T>; 3]) -> Result<Self, Degenerate> {
        let [a, b, c] = corners;
        let plane = plane_through(a, b, c)?;
        let gradient = |first: Point<T>, second: Point<T>, third: Point<T>| {
            let edges = differences(first, [second, third])?;
            let unit = power_of_two(&edges);
            let [u, v] = edges.map(|edge| Point::from(edge / unit));
            let reciprocal = formulas::reciprocal_relative(Point::origin(), u, v);
            if is_subnormal(reciprocal.ninf) {
                return Err(Degenerate::OutOfRange);
            }
            // P^i . P_i = 1, and P_i is the origin of this frame: -(ninf coefficient) is the normalising factor.
            Ok(Vector::new(reciprocal.e1, reciprocal.e2, reciprocal.e3) / -reciprocal.ninf / unit)
        };
        let gradients = [gradient(a, b, c)?, gradient(b, c, a)?, gradient(c, a, b)?];
        Ok(Self { corners, plane, gradients })
    }

    /// The barycentric coordinates of a point of the plane: `P^i . X`, each relative to its own corner, so that a
    /// coordinate of 0 or 1 is exact at the corners.
    #[must_use]
    pub fn barycentric(&self, point: Point<T>) -> [T; 3] {
        core::array::from_fn(|i| T::one() + (self.gradients[i] | self.corners[i].displacement_to(point)))
    }

    /// The height of a point over the plane, with the difference to a corner taken first.
    #[must_use]
    pub fn height(&self, point: Point<T>) -> T {
        self.plane.normal() | self.corners[0].displacement_to(point)
    }

    /// Where the segment from `start` to `end` passes through the facet, edges included. A segment that touches the
    /// plane only with its end, or lies in it, does not pass through.
    #[must_use]
    pub fn crossing(&self, start: Point<T>, end: Point<T>) -> Option<Crossing<T>> {
        let (above, below) = (self.height(start), self.height(end));
        let zero = T::zero();
        // Not by the sign of their product, which underflows for small heights.
        if !(above > zero && below < zero || above < zero && below > zero) {
            return None;
        }
        let fraction = above / (above - below);
        // The meet `pi | (start ^ end ^ ninf)`, in the frame of `start`, is `above u ^ ninf` of weight `above - below`, with
        // u = end - start. Dividing first keeps the product of two small lengths from underflowing.
        let point = start.moved(start.displacement_to(end) * fraction);
        let barycentric = self.barycentric(point);
        barycentric.iter().all(|coordinate| *coordinate >= T::zero()).then_some(Crossing {
            point,
            fraction,
            barycentric,
        })
    }
}

//! A convex body for collision tests, in the body frame: its origin is the centre of mass.

use crate::algebra::Real;
use crate::algebra::cga::{Point, Sphere};
use crate::algebra::g3::Vector;
use crate::geometry::mesh::Mesh;
use crate::geometry::{Degenerate, Facet};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use thiserror::Error;

/// Why a mesh makes no polyhedron.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum PolyhedronError {
    /// A facet has no plane.
    #[error("facet {facet}: {source}")]
    Facet {
        /// Which.
        facet: usize,
        /// Why.
        source: Degenerate,
    },
}

/// Two facets whose normals differ by less than this many epsilons (as the sine of their angle) are one face: their
/// common edge is a line drawn on it, and no edge that another body could strike.
const SHARP_EPSILONS: f64 = 64.0;

/// A convex polyhedron.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyhedron<T = f64> {
    /// Its corners.
    pub vertices: Vec<Point<T>>,
    /// Its sharp edges, as vertex indices.
    pub edges: Vec<[usize; 2]>,
    /// Its triangular facets.
    pub facets: Vec<Facet<T>>,
    /// A ball that holds it.
    pub bound: Sphere<T>,
}

impl<T: Real> Polyhedron<T> {
    /// From a convex closed mesh in the body frame, and a ball that holds it.
    ///
    /// # Errors
    /// A facet without area.
    pub fn new(mesh: &Mesh, bound: Sphere<f64>) -> Result<Self, PolyhedronError> {
        let (triangles, vertices) = (&mesh.triangles, mesh.vertices.iter());
        let vertices: Vec<Point<T>> = vertices.map(|vertex| vertex.map(T::from_f64)).collect();
        let corners = |triangle: &[u32; 3]| triangle.map(|index| vertices[index as usize]);
        let facets = triangles.iter().enumerate().map(|(facet, triangle)| {
            Facet::new(corners(triangle)).map_err(|source| PolyhedronError::Facet { facet, source })
        });
        let facets: Vec<Facet<T>> = facets.collect::<Result<_, _>>()?;
        let edges = sharp_edges(triangles, &facets);
        let bound = covering(bound.map(T::from_f64), &vertices);
        Ok(Self { vertices, edges, facets, bound })
    }

    /// The height of a point over the nearest facet's plane, and that facet: not positive within the body.
    #[must_use]
    pub fn height(&self, point: Point<T>) -> Option<(T, &Facet<T>)> {
        let heights = self.facets.iter().map(|facet| (facet.height(point), facet));
        heights.reduce(|highest, next| if next.0 > highest.0 { next } else { highest })
    }

    /// Is the point farther than `margin` beyond the plane of some facet? Stops at the first.
    #[must_use]
    pub fn excludes(&self, point: Point<T>, margin: T) -> bool {
        self.facets.iter().any(|facet| facet.height(point) > margin)
    }
}

/// The edges between facets of different planes.
fn sharp_edges<T: Real>(triangles: &[[u32; 3]], facets: &[Facet<T>]) -> Vec<[usize; 2]> {
    let mut sides: BTreeMap<[u32; 2], Vector<T>> = BTreeMap::new();
    let mut sharp = Vec::new();
    for (triangle, facet) in triangles.iter().zip(facets) {
        let normal = facet.plane.normal();
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let (from, to) = (triangle[from], triangle[to]);
            let key = [from.min(to), from.max(to)];
            let Some(other) = sides.insert(key, normal) else { continue };
            let sine_sq = (other ^ normal).norm_sq();
            let limit = T::from_f64(SHARP_EPSILONS) * T::EPSILON;
            if sine_sq > limit * limit {
                sharp.push(key.map(|index| index as usize));
            }
        }
    }
    sharp
}

/// Grows a ball that was rounded to `T` until it holds the rounded vertices again.
fn covering<T: Real>(bound: Sphere<T>, vertices: &[Point<T>]) -> Sphere<T> {
    let farthest = vertices.iter().map(|vertex| bound.centre().distance_sq_to(*vertex)).fold(bound.rho_sq, T::max);
    // Four roundings in the squared distance, one in its square root later on.
    Sphere { rho_sq: farthest * (T::one() + T::ratio(8, 1) * T::EPSILON), ..bound }
}

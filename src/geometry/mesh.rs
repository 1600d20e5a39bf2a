//! Triangle meshes: shared vertices and triangles of indices into them.
//!
//! A facet is counter-clockwise seen from outside, so that its normal by the right-hand rule points out of the body.
//! [`Mesh::new`] checks what every later step relies on: indices that exist and numbers that are finite. Whether the
//! surface bounds a solid is another question, answered by [`mesh_checks`](crate::geometry::mesh_checks).
//!
//! [`Mesh::welded`] joins vertices with equal coordinates and no others. Nearly equal vertices are never joined: how
//! near is near enough is known to the program that made them, not to this one.

use alloc::vec::Vec;
use core::cmp::Ordering;

use crate::algebra::cga::Point;

/// Vertices (m) and triangles of indices into them.
///
/// The fields are public to be read. Code that edits them keeps the promises of [`Mesh::new`], or makes a new mesh:
/// an index out of range panics where it is used.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Mesh {
    /// Positions, in the frame of the body.
    pub vertices: Vec<Point<f64>>,
    /// Corners of each facet, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// Why a list of vertices and triangles is no mesh. Positions in the lists count from 0.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// There is no triangle.
    #[error("the mesh has no triangles: give it at least four, the fewest that enclose a volume")]
    NoTriangles,
    /// A triangle names a vertex that does not exist.
    #[error(
        "triangle {triangle} (counted from 0) uses vertex {index}, but there are only {n_vertices}: correct the index \
         or add the vertex"
    )]
    IndexOutOfRange {
        /// Position of the triangle in the list.
        triangle: usize,
        /// The index that it holds.
        index: u32,
        /// Number of vertices.
        n_vertices: usize,
    },
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} (counted from 0) is ({:?}, {:?}, {:?}): coordinates must be finite numbers", point.x, point.y, point.z)]
    NotFinite {
        /// Position of the vertex in the list.
        vertex: usize,
        /// The vertex.
        point: Point<f64>,
    },
}

impl Mesh {
    /// A mesh of the given vertices and triangles.
    ///
    /// # Errors
    /// The first of: no triangles, a coordinate that is not finite, an index without a vertex.
    pub fn new(vertices: Vec<Point<f64>>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        if triangles.is_empty() {
            return Err(MeshError::NoTriangles);
        }
        let finite = |p: &Point<f64>| p.x.is_finite() && p.y.is_finite() && p.z.is_finite();
        if let Some((vertex, &point)) = vertices.iter().enumerate().find(|(_, p)| !finite(p)) {
            return Err(MeshError::NotFinite { vertex, point });
        }
        let n_vertices = vertices.len();
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|&&i| i as usize >= n_vertices) {
                return Err(MeshError::IndexOutOfRange { triangle, index, n_vertices });
            }
        }
        Ok(Self { vertices, triangles })
    }

    /// The same surface with vertices of equal coordinates joined into the first of them.
    ///
    /// Equal means equal as numbers: `-0.0` equals `0.0`, and two values one rounding apart differ. A vertex keeps its
    /// place in the order of first appearance, and vertices that no facet uses are kept.
    #[must_use]
    pub fn welded(&self) -> Self {
        // Ranks of the vertices by coordinates, then by place, so that each run of equals starts with the first of them.
        let mut by_place: Vec<(u32, &Point<f64>)> = (0u32..).zip(&self.vertices).collect();
        by_place.sort_unstable_by(|a, b| compare(a.1, b.1).then(a.0.cmp(&b.0)));
        let mut first_equal: Vec<u32> = alloc::vec![0; self.vertices.len()];
        let mut head = 0;
        for (rank, &(place, point)) in by_place.iter().enumerate() {
            if rank == 0 || compare(by_place[rank - 1].1, point).is_ne() {
                head = place;
            }
            first_equal[place as usize] = head;
        }
        let mut vertices = Vec::new();
        let mut new_place: Vec<u32> = alloc::vec![0; self.vertices.len()];
        let mut next = 0u32;
        for ((place, &first), &point) in (0u32..).zip(&first_equal).zip(&self.vertices) {
            if first == place {
                new_place[place as usize] = next;
                vertices.push(point);
                next += 1;
            } else {
                new_place[place as usize] = new_place[first as usize];
            }
        }
        let triangles = self.triangles.iter().map(|t| t.map(|i| new_place[i as usize])).collect();
        Self { vertices, triangles }
    }

    /// The three corners of a facet.
    #[must_use]
    pub fn corners(&self, triangle: [u32; 3]) -> [Point<f64>; 3] {
        triangle.map(|i| self.vertices[i as usize])
    }

    /// For each vertex, whether a facet uses it.
    #[must_use]
    pub fn used(&self) -> Vec<bool> {
        let mut used = alloc::vec![false; self.vertices.len()];
        for &i in self.triangles.iter().flatten() {
            used[i as usize] = true;
        }
        used
    }

    /// The vertices that facets use, in order.
    #[must_use]
    pub fn used_vertices(&self) -> Vec<Point<f64>> {
        let used = self.used();
        self.vertices.iter().zip(used).filter(|(_, used)| *used).map(|(&p, _)| p).collect()
    }
}

/// Orders points by their coordinates as numbers; adding 0.0 turns -0.0 into 0.0 and changes nothing else.
fn compare(a: &Point<f64>, b: &Point<f64>) -> Ordering {
    let by = |a: f64, b: f64| (a + 0.0).total_cmp(&(b + 0.0));
    by(a.x, b.x).then(by(a.y, b.y)).then(by(a.z, b.z))
}

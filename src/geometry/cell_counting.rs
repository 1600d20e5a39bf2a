//! Mass properties by counting cells: the report's way (2.3.3), kept as a rival of the exact integrals.
//!
//! The bounding box is divided into cubes of side h, and a cell counts with all of its mass if its centre lies in the body.
//! The error is that of the staircase that stands for the surface: of order h, erratic, and for generic positions nearer to
//! h^1.5, for cells in and out cancel in part. Two tests say whether a centre lies in the body:
//!
//! * [`Inside::HalfSpaces`]: behind every facet's plane. Right for convex bodies only; of others it finds the part from which
//!   the whole surface can be seen.
//! * [`Inside::Parity`]: the ray upwards crosses the surface an odd number of times. Right for every closed body.
//!
//! **Edge cases.** A ray may pass through an edge or a vertex, or run within a facet, and a centre may lie on the surface. All
//! are decided as if the centre stood at (x + e, y + e², z + e³) with an e smaller than anything else (simulation of
//! simplicity: Edelsbrunner and Mücke, 1990): that point is on no plane and its ray meets no edge. The signs are exact
//! (`robust`), so each crossing counts once, the two tests agree on every convex body, and bodies that share a face share no
//! cell.
//!
//! **The cell's own inertia.** The report sums the cells as point masses, which leaves out the inertia dm h²/6 of each about
//! its own centre: of a cube along the axes the moments come out low by exactly (h/L)². [`CellCounting::own_inertia`] puts it
//! back.

use crate::algebra::cga::Point;
use crate::geometry::mass_properties::{ClosedMesh, MassProperties};
use crate::geometry::mesh::Mesh;
use crate::geometry::predicates::{Sign, orient3d};
use alloc::vec::Vec;
use robust::{Coord, orient2d};

/// Which test says whether a point lies in the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inside {
    /// Behind all planes of the facets: for convex bodies. O(facets) a cell.
    HalfSpaces,
    /// An odd number of facets above. O(facets) a column of cells.
    Parity,
}

/// How to count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellCounting {
    /// Cells along the longest side of the bounding box; as many as fit along the others, rounded up.
    pub cells: u32,
    /// The test.
    pub inside: Inside,
    /// Whether each cell's inertia about its own centre counts; the report leaves it out.
    pub own_inertia: bool,
}

/// Cells along a side beyond which nobody would wait for the counting.
pub const MOST_CELLS: u32 = 1024;

/// Why there is nothing to count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CellError {
    /// None, or too many.
    #[error("{0} cells along the longest side: from 1 to {MOST_CELLS} can be counted")]
    Cells(u32),
    /// The body slips between the centres.
    #[error(
        "no cell's centre lies in the body at {0} cells along its longest side: take more, it is thinner than a cell"
    )]
    NothingInside(u32),
    /// A size in which the cells' side under- or overflows.
    #[error("the bounding box has no size that can be divided: the body is flat, or its size is out of range")]
    NoBox,
}

/// Sums over the cells that count, in units of the cell's side, by exact integers.
#[derive(Default)]
struct Counted {
    cells: i128,
    /// Of the indices along each axis.
    first: [i128; 3],
    /// xx, yy, zz, yz, zx, xy.
    second: [i128; 6],
}

impl CellCounting {
    /// Volume, centre and inertia at unit density of the cells whose centres lie in the body.
    ///
    /// # Errors
    /// [`CellError`].
    pub fn mass_properties(&self, body: ClosedMesh<'_>) -> Result<MassProperties, CellError> {
        if !(1..=MOST_CELLS).contains(&self.cells) {
            return Err(CellError::Cells(self.cells));
        }
        let mesh = body.mesh();
        let (low, size) = bounding_box(mesh);
        let longest = size.into_iter().fold(0.0, f64::max);
        let side = longest / f64::from(self.cells);
        if !(side * side * side * side * side).is_normal() {
            return Err(CellError::NoBox);
        }
        // One cell more than fits where the box is no multiple of the side; none of size zero.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most MOST_CELLS")]
        let counts = size.map(|size| (libm::ceil(size / side) as u32).clamp(1, self.cells));
        let at = |axis: usize, index: u32| low[axis] + (f64::from(index) + 0.5) * side;
        let facets: Vec<[Point<f64>; 3]> = mesh.triangles.iter().map(|&t| mesh.corners(t)).collect();
        let mut counted = Counted::default();
        for (i, j) in (0..counts[0]).flat_map(|i| (0..counts[1]).map(move |j| (i, j))) {
            let (x, y) = (at(0, i), at(1, j));
            let above = self.facets_above(&facets, x, y);
            for k in 0..counts[2] {
                let centre = Point::new(x, y, at(2, k));
                let inside = match self.inside {
                    Inside::HalfSpaces => facets.iter().all(|&facet| !is_before(facet, centre)),
                    Inside::Parity => above.iter().filter(|&&facet| is_above(facet, centre)).count() % 2 == 1,
                };
                if inside {
                    counted.add([i, j, k].map(i128::from));
                }
            }
        }
        counted.mass_properties(low, side, self.own_inertia).ok_or(CellError::NothingInside(self.cells))
    }

    /// The facets that the vertical line through (x, y) crosses.
    fn facets_above(&self, facets: &[[Point<f64>; 3]], x: f64, y: f64) -> Vec<[Point<f64>; 3]> {
        match self.inside {
            Inside::HalfSpaces => Vec::new(),
            Inside::Parity => facets.iter().copied().filter(|&facet| shadow_contains(facet, x, y)).collect(),
        }
    }
}

impl Counted {
    fn add(&mut self, [i, j, k]: [i128; 3]) {
        self.cells += 1;
        for (sum, index) in self.first.iter_mut().zip([i, j, k]) {
            *sum += index;
        }
        for (sum, product) in self.second.iter_mut().zip([i * i, j * j, k * k, j * k, k * i, i * j]) {
            *sum += product;
        }
    }

    /// From indices to lengths: the cells' centres stand at `low + (index + 1/2) side`.
    fn mass_properties(&self, low: [f64; 3], side: f64, own_inertia: bool) -> Option<MassProperties> {
        if self.cells == 0 {
            return None;
        }
        let cells = self.cells as f64;
        let (cell, square) = (side * side * side, side * side);
        let centre = [0, 1, 2].map(|i| low[i] + (self.first[i] as f64 / cells + 0.5) * side);
        // sum (x - mean)(y - mean) = (n sum xy - sum x sum y) / n, of which the numerator is exact.
        let central = |k: usize, i: usize, j: usize| {
            (self.cells * self.second[k] - self.first[i] * self.first[j]) as f64 / cells * cell * square
        };
        // A cube of mass dm has dm h²/6 about each axis, and so dm h²/12 of each second moment.
        let own = if own_inertia { cells * cell * square / 12.0 } else { 0.0 };
        let [xx, yy, zz] = [central(0, 0, 0) + own, central(1, 1, 1) + own, central(2, 2, 2) + own];
        let [yz, zx, xy] = [-central(3, 1, 2), -central(4, 2, 0), -central(5, 0, 1)];
        let [x, y, z] = centre;
        Some(MassProperties {
            volume: cells * cell,
            centre: Point { x, y, z },
            inertia_unit_density: [[yy + zz, xy, zx], [xy, zz + xx, yz], [zx, yz, xx + yy]],
        })
    }
}

/// The low corner of the box around the vertices that facets use, and its sides.
fn bounding_box(mesh: &Mesh) -> ([f64; 3], [f64; 3]) {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for p in mesh.used_vertices() {
        for (axis, x) in [p.x, p.y, p.z].into_iter().enumerate() {
            (low[axis], high[axis]) = (low[axis].min(x), high[axis].max(x));
        }
    }
    (low, [0, 1, 2].map(|axis| high[axis] - low[axis]))
}

/// The sign of twice the area of a triangle in one of the coordinate planes: of a component of the facet's normal.
fn area(u: [f64; 3], v: [f64; 3]) -> f64 {
    let at = |i: usize| Coord { x: u[i], y: v[i] };
    orient2d(at(0), at(1), at(2))
}

/// Whether a point, moved by (e, e², e³), is on the outer side of a facet's plane. A facet without area has none.
fn is_before(facet: [Point<f64>; 3], point: Point<f64>) -> bool {
    let [a, b, c] = facet;
    match orient3d(a, b, c, point) {
        Ok(Sign::Positive) => true,
        Ok(Sign::Negative) => false,
        // The height over the plane grows along each axis with that component of the normal.
        Ok(Sign::Zero) | Err(_) => {
            let [x, y, z] = [facet.map(|p| p.x), facet.map(|p| p.y), facet.map(|p| p.z)];
            [area(y, z), area(z, x), area(x, y)].into_iter().find(|n| *n != 0.0).is_some_and(|n| n > 0.0)
        }
    }
}

/// Whether a facet that the vertical line through a point crosses does so above the point.
fn is_above(facet: [Point<f64>; 3], point: Point<f64>) -> bool {
    let faces_up = area(facet.map(|p| p.x), facet.map(|p| p.y)) > 0.0;
    faces_up != is_before(facet, point)
}

/// Whether the shadow of a facet on the plane z = 0 holds (x + e, y + e²). A vertical facet has a shadow without inside.
fn shadow_contains([a, b, c]: [Point<f64>; 3], x: f64, y: f64) -> bool {
    let beyond = |f: fn(&Point<f64>) -> f64, at: f64| {
        let [a, b, c] = [f(&a), f(&b), f(&c)];
        a.max(b).max(c) < at || a.min(b).min(c) > at
    };
    if beyond(|p| p.x, x) || beyond(|p| p.y, y) {
        return false;
    }
    let flat = |p: Point<f64>| Coord { x: p.x, y: p.y };
    let side = |p: Point<f64>, q: Point<f64>| {
        // On the line, the next to decide is its direction: what the moved point adds to (q - p) x (point - p).
        let signs = [orient2d(flat(p), flat(q), Coord { x, y }), p.y - q.y, q.x - p.x];
        signs.into_iter().find(|sign| *sign != 0.0).unwrap_or(0.0)
    };
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides.iter().all(|&s| s > 0.0) || sides.iter().all(|&s| s < 0.0)
}

//! Volume, centre of mass and inertia of the solid inside a closed mesh, exact but for the last rounding.
//!
//! The divergence theorem turns the integrals over the solid into sums over the tetrahedra that the facets `(a, b, c)`
//! span with an origin. With `d = a . (b x c)` (six times the signed volume) and `s = a + b + c`:
//!
//! ```text
//! volume    V    = sum d / 6
//! first     M_i  = sum d s_i / 24
//! second    S_ij = sum d (a_i a_j + b_i b_j + c_i c_j + s_i s_j) / 120
//! centre    c    = M / V
//! inertia   I_xx = C_yy + C_zz,  I_xy = -C_xy,   with C_ij = S_ij - M_i M_j / V
//! ```
//!
//! Sources: Mirtich, *Fast and accurate computation of polyhedral mass properties*, 1996; Tonon, *Explicit exact
//! formulas for the 3-D tetrahedron inertia tensor*, 2004.
//!
//! The given coordinates count as exact, and the answer is theirs to within [1e-14](self#promise). Two ways to the sums: the
//! fast one (`bounded`) in f64, which bounds its own error as it goes, and where that bound exceeds the promise (thin plates,
//! long rods) a careful one in double-double, which is right to the last rounding.
//!
//! # Promise
//! Relative errors of at most 1e-14, at any distance from the origin: of the volume; of the centre, relative to the mesh's
//! reach or its own distance; of the inertia, relative to its largest entry. Small meshes (fewer than 64 facets: boxes and
//! the like) always take the careful way, so that what is zero by symmetry is zero.
//!
//! Self-intersection is not looked for: a region wound twice counts twice.

mod bounded;
mod careful;
mod principal_axes;

pub use principal_axes::{PrincipalAxes, principal_axes};

use crate::algebra::cga::Point;
use crate::geometry::double_double::DoubleDouble;
use crate::geometry::mesh::Mesh;
use crate::geometry::mesh_topology::{Topology, edges_cancel};

/// What a rigid body needs to know about a solid, at density 1 kg/m³.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// Volume (m³); the mass (kg) at unit density.
    pub volume: f64,
    /// Centre of mass (m), in the frame of the mesh.
    pub centre: Point<f64>,
    /// Inertia (m⁵) about `centre`, in the axes of the mesh; row-major, symmetric, off-diagonals -∫xy.
    pub inertia_unit_density: [[f64; 3]; 3],
}

impl MassProperties {
    /// Those of the solid scaled about the origin: the volume goes with the third power of the factor, the inertia with
    /// the fifth.
    ///
    /// # Errors
    /// [`MassError::OutOfRange`], with the scaled solid's radius of gyration for its extent.
    pub fn scaled(&self, factor: f64) -> Result<Self, MassError> {
        let [[xx, ..], [_, yy, _], [.., zz]] = self.inertia_unit_density;
        let extent = factor * libm::sqrt(0.5 * (xx + yy + zz) / self.volume);
        if !REACH_M.contains(&extent) {
            return Err(MassError::OutOfRange { extent });
        }
        let (square, Point { x, y, z }) = (factor * factor, self.centre);
        Ok(Self {
            volume: self.volume * factor * square,
            centre: Point { x: x * factor, y: y * factor, z: z * factor },
            inertia_unit_density: self.inertia_unit_density.map(|row| row.map(|x| x * factor * square * square)),
        })
    }
}

/// Why a mesh has no mass properties.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MassError {
    /// The surface has a boundary.
    #[error(
        "the mesh is not closed: the edge between vertices {} and {} (counted from 0) belongs to an odd number of \
         triangles; close the hole or weld the crack there", edge[0], edge[1]
    )]
    NotClosed {
        /// The first such edge.
        edge: [u32; 2],
    },
    /// Neighbouring facets disagree about the outside.
    #[error(
        "the facets at the edge between vertices {} and {} (counted from 0) run the same way along it: make the winding \
         of all facets counter-clockwise seen from outside", edge[0], edge[1]
    )]
    NotOriented {
        /// The first such edge.
        edge: [u32; 2],
    },
    /// All facets face inwards.
    #[error("the mesh is inside out: its signed volume is {volume:?} m³; reverse the winding of every facet")]
    InsideOut {
        /// The signed volume (m³).
        volume: f64,
    },
    /// The facets enclose nothing.
    #[error("the mesh encloses no volume: its facets cancel; give it thickness")]
    NoVolume,
    /// The size is outside what the arithmetic holds.
    #[error(
        "the mesh reaches {extent:?} m from the point it is integrated about; between 1e-50 m and 1e50 m is supported: change the unit"
    )]
    OutOfRange {
        /// The largest local coordinate (m).
        extent: f64,
    },
    /// An inertia matrix holds a number that is not finite.
    #[error("the inertia matrix holds a number that is infinite or not a number")]
    InertiaNotFinite,
}

/// Largest and smallest reach of a mesh (m). Second moments go with the fifth power: 1e250 and 1e-250 leave room
/// for the sums above, and for the low halves of double-doubles (2^-106 of the high ones) below.
pub(crate) const REACH_M: core::ops::RangeInclusive<f64> = 1e-50..=1e50;

/// Fewer facets than this take the careful way: microseconds, and no noise where there should be zeros.
const SMALLEST_FINE_MESH: usize = 64;

/// The sums over facets, about `origin`: six times the volume, 24 times the first and 120 times the second moments.
pub(crate) struct Integrals {
    origin: [f64; 3],
    volume_6: DoubleDouble,
    first_24: [DoubleDouble; 3],
    /// xx, yy, zz, yz, zx, xy.
    second_120: [DoubleDouble; 6],
    /// Bound on the error of `volume_6`.
    volume_6_error: f64,
}

/// A mesh whose facets close and agree about the outside, so that integrals over its inside are defined.
///
/// The check needs the edges of the mesh, and takes longer than the integrals. It is made once, when this is.
#[derive(Clone, Copy, Debug)]
pub struct ClosedMesh<'a>(&'a Mesh);

impl<'a> ClosedMesh<'a> {
    /// Checks the edges: O(n) for n facets.
    ///
    /// # Errors
    /// [`MassError`]: not closed, not oriented.
    pub fn new(mesh: &'a Mesh) -> Result<Self, MassError> {
        if edges_cancel(mesh) {
            return Ok(Self(mesh));
        }
        let topology = Topology::new(mesh);
        if let Some(edge) = topology.edges.iter().find(|e| e.is_open()) {
            return Err(MassError::NotClosed { edge: edge.ends });
        }
        if let Some(edge) = topology.edges.iter().find(|e| e.is_misoriented()) {
            return Err(MassError::NotOriented { edge: edge.ends });
        }
        Ok(Self(mesh))
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(self) -> &'a Mesh {
        self.0
    }

    /// The mass properties of the inside at unit density, [to within 1e-14](self#promise). O(n).
    ///
    /// # Errors
    /// [`MassError`]: inside out, no volume, or a size out of range.
    pub fn mass_properties(self) -> Result<MassProperties, MassError> {
        Integrals::new(self.0, &self.0.triangles)?.mass_properties()
    }
}

/// The mass properties of the solid inside a closed, consistently oriented mesh of positive volume, at unit density,
/// [to within 1e-14](self#promise).
///
/// # Errors
/// [`MassError`]: not closed, not oriented, inside out, no volume, or a size out of range.
pub fn mass_properties(mesh: &Mesh) -> Result<MassProperties, MassError> {
    ClosedMesh::new(mesh)?.mass_properties()
}

impl Integrals {
    /// Sums over some facets of a mesh, whether or not they close. Out of range sizes are an error.
    pub(crate) fn new(mesh: &Mesh, triangles: &[[u32; 3]]) -> Result<Self, MassError> {
        bounded::integrals(mesh, triangles).map_or_else(|| careful::integrals(mesh, triangles), Ok)
    }

    /// The signed volume, and zero where the sum is not known to differ from it.
    pub(crate) fn volume(&self) -> f64 {
        if self.volume_6.hi.abs() <= self.volume_6_error { 0.0 } else { (self.volume_6 / 6.0.into()).hi }
    }

    /// Moves the moments to the centre of mass.
    pub(crate) fn mass_properties(&self) -> Result<MassProperties, MassError> {
        let volume = self.volume();
        if volume == 0.0 {
            return Err(MassError::NoVolume);
        }
        if volume < 0.0 {
            return Err(MassError::InsideOut { volume });
        }
        // c = (F / 24) / (D / 6) and C = S / 120 - (F F / 24²) / (D / 6), with the sums F, D, S as stored.
        let centre = self.first_24.map(|f| f / (self.volume_6 * 4.0));
        let mut world = self.origin;
        for (world, local) in world.iter_mut().zip(centre) {
            *world = (local + (*world).into()).hi;
        }
        let central = |k: usize, i: usize, j: usize| {
            self.second_120[k] / 120.0.into() - self.first_24[i] * self.first_24[j] / (self.volume_6 * 96.0)
        };
        let (xx, yy, zz) = (central(0, 0, 0), central(1, 1, 1), central(2, 2, 2));
        let (yz, zx, xy) = (-central(3, 1, 2).hi, -central(4, 2, 0).hi, -central(5, 0, 1).hi);
        let inertia_unit_density = [[(yy + zz).hi, xy, zx], [xy, (zz + xx).hi, yz], [zx, yz, (xx + yy).hi]];
        Ok(MassProperties { volume, centre: Point { x: world[0], y: world[1], z: world[2] }, inertia_unit_density })
    }
}

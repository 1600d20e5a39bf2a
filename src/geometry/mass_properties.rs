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
//! Two sources of error are removed. Far from the origin `V` would be a small difference of large terms: coordinates are
//! taken relative to a point inside the bounding box, on those axes where that subtraction is exact, so the shift costs
//! nothing. What cancellation is left (thin plates, long rods, a facet's far side) is carried in double-double. The
//! given coordinates count as exact; the answer is theirs to within an ulp or two.
//!
//! Self-intersection is not looked for: a region wound twice counts twice.

use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;
use crate::geometry::double_double::DoubleDouble;
use crate::geometry::mesh::Mesh;
use crate::geometry::mesh_topology::Topology;
use nalgebra::{Matrix3, SymmetricEigen};

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

/// Rounding of `d` and of its place in the sum, in double-double: some 16 operations of at most 4 units 2^-106 each,
/// relative to the size of the products that make it up.
const UNIT_ERROR: f64 = 64.0 / (1u128 << 106) as f64;

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

/// The mass properties of the solid inside a closed, consistently oriented mesh of positive volume, at unit density.
///
/// O(n log n) for the check of the edges, O(n) for the sums. Against exact rationals the relative errors stay below 1e-16
/// (the centre relative to its distance from the origin), for plates and rods and at any distance too.
///
/// # Errors
/// [`MassError`]: not closed, not oriented, inside out, no volume, or a size out of range.
pub fn mass_properties(mesh: &Mesh) -> Result<MassProperties, MassError> {
    let topology = Topology::new(mesh);
    if let Some(edge) = topology.edges.iter().find(|e| e.is_open()) {
        return Err(MassError::NotClosed { edge: edge.ends });
    }
    if let Some(edge) = topology.edges.iter().find(|e| e.is_misoriented()) {
        return Err(MassError::NotOriented { edge: edge.ends });
    }
    Integrals::new(mesh, &mesh.triangles)?.mass_properties()
}

impl Integrals {
    /// Sums over some facets of a mesh, whether or not they close. Out of range sizes are an error.
    pub(crate) fn new(mesh: &Mesh, triangles: &[[u32; 3]]) -> Result<Self, MassError> {
        let origin = exact_origin(mesh, triangles);
        let mut sums = Self {
            origin,
            volume_6: DoubleDouble::default(),
            first_24: Default::default(),
            second_120: Default::default(),
            volume_6_error: 0.0,
        };
        let (mut extent, mut magnitude) = (0.0f64, 0.0);
        for &triangle in triangles {
            let corners = mesh.corners(triangle).map(|p| [p.x - origin[0], p.y - origin[1], p.z - origin[2]]);
            let reach = corners.map(|[x, y, z]| x.abs().max(y.abs()).max(z.abs()));
            extent = reach.into_iter().fold(extent, f64::max);
            // |d| is at most 6 times the product of the largest coordinates.
            magnitude += 6.0 * reach[0] * reach[1] * reach[2];
            sums.add(corners);
        }
        if !REACH_M.contains(&extent) {
            return Err(MassError::OutOfRange { extent });
        }
        sums.volume_6_error = (triangles.len() as f64 + 1.0) * UNIT_ERROR * magnitude;
        Ok(sums)
    }

    /// Adds the tetrahedron of one facet.
    fn add(&mut self, [a, b, c]: [[f64; 3]; 3]) {
        let minor = |i: usize, j: usize| DoubleDouble::product(b[i], c[j]) - DoubleDouble::product(b[j], c[i]);
        let d = minor(1, 2) * a[0] + minor(2, 0) * a[1] + minor(0, 1) * a[2];
        let s = [0, 1, 2].map(|i| DoubleDouble::sum(a[i], b[i]) + c[i].into());
        self.volume_6 = self.volume_6 + d;
        for (sum, s) in self.first_24.iter_mut().zip(s) {
            *sum = *sum + d * s;
        }
        for (sum, (i, j)) in self.second_120.iter_mut().zip([(0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1)]) {
            let corners = DoubleDouble::product(a[i], a[j])
                + DoubleDouble::product(b[i], b[j])
                + DoubleDouble::product(c[i], c[j]);
            *sum = *sum + d * (corners + s[i] * s[j]);
        }
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

/// A point near the mesh from which differences to all vertices used are exact.
///
/// On an axis where all coordinates `p` have one sign and the largest is at most twice the smallest, `p - o` is exact for
/// any `o` between them (Sterbenz), and the middle is taken. Elsewhere the box lies no further from zero than it is wide;
/// zero itself is near enough, and subtracting it is exact.
fn exact_origin(mesh: &Mesh, triangles: &[[u32; 3]]) -> [f64; 3] {
    let mut bounds = [(f64::INFINITY, f64::NEG_INFINITY); 3];
    for &i in triangles.iter().flatten() {
        let p = mesh.vertices[i as usize];
        for (bound, x) in bounds.iter_mut().zip([p.x, p.y, p.z]) {
            *bound = (bound.0.min(x), bound.1.max(x));
        }
    }
    bounds.map(|(low, high)| {
        let (near, far) = if low > 0.0 { (low, high) } else { (-high, -low) };
        if near > 0.0 && far <= 2.0 * near { low + 0.5 * (high - low) } else { 0.0 }
    })
}

/// Principal moments of inertia and the axes they belong to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipalAxes {
    /// The moments, in the unit of the matrix, smallest first.
    pub moments: [f64; 3],
    /// Unit vectors along the principal axes, in the order of the moments, right-handed: `axes[0] x axes[1] = axes[2]`.
    pub axes: [Vector<f64>; 3],
}

/// An off-diagonal entry below this share of the largest entry is the rounding of a zero (each entry is known to about
/// an ulp of the largest: 2^-52, four of them here). Kept, it would turn the axes of a cube anywhere.
const OFF_DIAGONAL_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Principal moments and axes of a symmetric inertia matrix (only its lower half is read).
///
/// Equal moments leave the axes free within their plane; a diagonal matrix keeps its own axes, in the order of the
/// moments.
///
/// # Errors
/// [`MassError::InertiaNotFinite`].
pub fn principal_axes(inertia: [[f64; 3]; 3]) -> Result<PrincipalAxes, MassError> {
    if inertia.iter().flatten().any(|x| !x.is_finite()) {
        return Err(MassError::InertiaNotFinite);
    }
    let largest = inertia.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    let scale = if largest > 0.0 { largest } else { 1.0 };
    let matrix = Matrix3::from_fn(|i, j| {
        let entry = inertia[i.max(j)][i.min(j)] / scale;
        if i != j && entry.abs() <= OFF_DIAGONAL_ROUNDING { 0.0 } else { entry }
    });
    let eigen = SymmetricEigen::new(matrix);
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
    let column = |i: usize| eigen.eigenvectors.column(i).into_owned();
    let (first, second) = (column(order[0]), column(order[1]));
    let axes = [first, second, first.cross(&second)];
    Ok(PrincipalAxes {
        moments: order.map(|i| eigen.eigenvalues[i] * scale),
        axes: axes.map(|v| Vector { e1: v.x, e2: v.y, e3: v.z }),
    })
}

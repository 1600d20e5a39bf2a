//! The sums over facets in double-double, about a point from which differences to the vertices are exact.
//!
//! For surfaces whose terms cancel too much for [`bounded`](super::bounded): thin plates, long rods, shapes far to one
//! side of the point. Some forty times its cost.

use super::{Integrals, MassError, REACH_M};
use crate::geometry::double_double::DoubleDouble;
use crate::geometry::mesh::Mesh;

/// Rounding of `d` and of its place in the sum, in double-double: some 16 operations of at most 4 units 2^-106 each,
/// relative to the size of the products that make it up.
const UNIT_ERROR: f64 = 64.0 / (1u128 << 106) as f64;

/// The sums over some facets of a mesh, whether or not they close. Out of range sizes are an error.
pub(super) fn integrals(mesh: &Mesh, triangles: &[[u32; 3]]) -> Result<Integrals, MassError> {
    let origin = exact_origin(mesh, triangles);
    let mut sums = Integrals {
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
        add(&mut sums, corners);
    }
    if !REACH_M.contains(&extent) {
        return Err(MassError::OutOfRange { extent });
    }
    sums.volume_6_error = (triangles.len() as f64 + 1.0) * UNIT_ERROR * magnitude;
    Ok(sums)
}

/// Adds the tetrahedron of one facet.
fn add(sums: &mut Integrals, [a, b, c]: [[f64; 3]; 3]) {
    let minor = |i: usize, j: usize| DoubleDouble::product(b[i], c[j]) - DoubleDouble::product(b[j], c[i]);
    let d = minor(1, 2) * a[0] + minor(2, 0) * a[1] + minor(0, 1) * a[2];
    let s = [0, 1, 2].map(|i| DoubleDouble::sum(a[i], b[i]) + c[i].into());
    sums.volume_6 = sums.volume_6 + d;
    for (sum, s) in sums.first_24.iter_mut().zip(s) {
        *sum = *sum + d * s;
    }
    for (sum, (i, j)) in sums.second_120.iter_mut().zip([(0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1)]) {
        let corners =
            DoubleDouble::product(a[i], a[j]) + DoubleDouble::product(b[i], b[j]) + DoubleDouble::product(c[i], c[j]);
        *sum = *sum + d * (corners + s[i] * s[j]);
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

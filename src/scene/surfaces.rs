//! The surfaces of the shapes that a scene can name, and the ellipsoid that stands for a bare inertia.

use crate::algebra::cga::Point;
use crate::geometry::mass_properties::principal_axes;
use crate::geometry::mesh::{Mesh, MeshError};
use crate::geometry::predicates::{Sign, orient3d};

/// A box about the origin, edges along the axes. Vertex index: bit 0 for +x, bit 1 for +y, bit 2 for +z.
///
/// # Errors
/// Sizes that are not finite.
pub(super) fn cuboid(size: [f64; 3]) -> Result<Mesh, MeshError> {
    let half = size.map(|edge| edge * 0.5);
    let side = |index: usize, bit: usize| if index >> bit & 1 == 1 { half[bit] } else { -half[bit] };
    let vertices = (0..8).map(|index| Point::new(side(index, 0), side(index, 1), side(index, 2)));
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    Mesh::new(vertices.collect(), triangles.collect())
}

/// A pyramid on a square base about the origin of the xy plane, apex on +z.
///
/// # Errors
/// Sizes that are not finite.
pub(super) fn pyramid(base: f64, height: f64) -> Result<Mesh, MeshError> {
    let half = base * 0.5;
    let corners = [[-half, -half, 0.0], [half, -half, 0.0], [half, half, 0.0], [-half, half, 0.0], [0.0, 0.0, height]];
    let triangles = vec![[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
    Mesh::new(corners.map(Point::from).to_vec(), triangles)
}

/// A tetrahedron with its corners in any order.
///
/// # Errors
/// Coordinates that are not finite.
pub(super) fn tetrahedron(corners: [[f64; 3]; 4]) -> Result<Mesh, MeshError> {
    let [a, b, c, d] = corners.map(Point::from);
    // With d behind the plane of a, b, c, these are seen from outside. What is not finite has no side, and is no mesh either.
    let outward = orient3d(a, b, c, d) == Ok(Sign::Negative);
    let triangles = if outward {
        [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
    } else {
        [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
    };
    Mesh::new(corners.map(Point::from).to_vec(), triangles.to_vec())
}

/// A lamina is drawn this thick, as a share of its largest half-axis: thin to the eye, and not lost on edge.
const LEAST_THICKNESS: f64 = 0.02;

/// The half-axes of the solid ellipsoid with this mass and inertia, along the body axes as far as the inertia is
/// diagonal: from `I_x = m (b² + c²) / 5` and its like, `a² = 5 (I_y + I_z - I_x) / 2m`. A lamina is given a small
/// thickness, so that it can be seen.
#[must_use]
pub(super) fn ellipsoid_half_axes(mass: f64, inertia: [[f64; 3]; 3]) -> [f64; 3] {
    let off_diagonal = inertia[0][1] != 0.0 || inertia[0][2] != 0.0 || inertia[1][2] != 0.0;
    let moments = match principal_axes(inertia) {
        Ok(axes) if off_diagonal => axes.moments,
        _ => [inertia[0][0], inertia[1][1], inertia[2][2]],
    };
    let squares = [0, 1, 2].map(|i| 2.5 * (moments[(i + 1) % 3] + moments[(i + 2) % 3] - moments[i]) / mass);
    let largest = squares.into_iter().fold(0.0, f64::max).sqrt();
    squares.map(|square| square.max(0.0).sqrt().max(largest * LEAST_THICKNESS))
}

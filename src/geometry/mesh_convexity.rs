//! Whether a closed surface bounds a convex solid, decided by exact signs.
//!
//! Every sign is of an [`orient3d`], which is exact, so there is no tolerance: facets in one plane are convex, and a dent
//! of one rounding is a dent. A mesh of a round solid written with few digits often has such dents between nearly coplanar
//! facets; whoever needs it convex takes its hull.
//!
//! Fast path, O(n), after Mehlhorn et al., *Checking geometric programs or verification of geometric structures*, 1996.
//! The solid is convex if
//!
//! 1. no edge is reflex: the far corner of each neighbour lies behind or on the plane of the facet;
//! 2. a point `o` lies strictly behind every facet, so that the facets, seen from `o`, cover all directions evenly;
//! 3. one direction is covered once: the ray from `o` to a point of one facet crosses no other.
//!
//! The third rejects what the first two let pass: the great icosahedron (every edge convex, covered seven times), a
//! surface wound twice, a box in a box. Where no `o` is found (a sliver thinner than the roundings of `o`) or facets of
//! zero area leave gaps in 1, every vertex is held against every facet, O(n²), and 3 is asked from a vertex.

use alloc::vec::Vec;

use crate::algebra::cga::Point;
use crate::geometry::mesh::Mesh;
use crate::geometry::mesh_topology::Topology;
use crate::geometry::predicates::{Sign, orient3d};
use robust::{Coord, orient2d};

/// The answer, with a witness of the contrary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Convexity {
    /// The surface bounds a convex solid.
    Convex,
    /// A vertex lies in front of the plane of a facet.
    Protrudes {
        /// The facet.
        triangle: usize,
        /// The vertex in front of it.
        vertex: u32,
    },
    /// The surface covers some direction more than once, or not at all.
    Overlaps,
}

/// Positive where `p` is behind the facet, zero where it is on its plane.
fn behind([a, b, c]: [Point<f64>; 3], p: Point<f64>) -> Sign {
    // The vertices of a mesh are finite; a mean of them that overflows is behind nothing.
    orient3d(a, b, c, p).map_or(Sign::Zero, |side| -side)
}

/// Whether the corners lie on one line exactly: their shadows on all three coordinate planes do.
pub(crate) fn has_zero_area([a, b, c]: [Point<f64>; 3]) -> bool {
    let shadow = |f: fn(Point<f64>) -> Coord<f64>| orient2d(f(a), f(b), f(c)) == 0.0;
    shadow(|p| Coord { x: p.x, y: p.y }) && shadow(|p| Coord { x: p.y, y: p.z }) && shadow(|p| Coord { x: p.z, y: p.x })
}

/// Whether the solid inside is convex, for a closed, oriented surface with two triangles on every edge and positive volume.
pub(crate) fn convexity(mesh: &Mesh, topology: &Topology) -> Convexity {
    if let Some(reflex) = reflex_edge(mesh, topology) {
        return reflex;
    }
    let facets: Vec<(usize, [Point<f64>; 3])> = mesh.triangles.iter().map(|&t| mesh.corners(t)).enumerate().collect();
    let n_all = facets.len();
    let facets: Vec<_> = facets.into_iter().filter(|(_, f)| !has_zero_area(*f)).collect();
    let inner = mean(&mesh.used_vertices());
    let all_behind = facets.iter().all(|&(_, f)| behind(f, inner) == Sign::Positive);
    if facets.len() == n_all && all_behind {
        return covered_once(&facets, inner);
    }
    protruding_vertex(mesh, &facets).unwrap_or_else(|| {
        // With every vertex behind or on every plane, the surface lies on the boundary of the hull. From a vertex, a ray
        // into the solid leaves that boundary once, so the facets it crosses count how often the hull is covered.
        let apex = facets.first().map(|&(_, [a, _, _])| a);
        apex.map_or(Convexity::Overlaps, |apex| covered_once(&facets, apex))
    })
}

/// The first edge at which the solid is dented, if any.
fn reflex_edge(mesh: &Mesh, topology: &Topology) -> Option<Convexity> {
    topology.edges.iter().find_map(|edge| {
        let [side, other] = topology.sides(edge) else {
            return None;
        };
        let vertex = mesh.triangles[other.triangle][(other.corner + 2) % 3];
        let triangle = side.triangle;
        let facet = mesh.corners(mesh.triangles[triangle]);
        (behind(facet, mesh.vertices[vertex as usize]) == Sign::Negative)
            .then_some(Convexity::Protrudes { triangle, vertex })
    })
}

/// The first vertex in front of a facet, by comparing all with all.
fn protruding_vertex(mesh: &Mesh, facets: &[(usize, [Point<f64>; 3])]) -> Option<Convexity> {
    let used = mesh.used();
    let vertices: Vec<(u32, Point<f64>)> =
        (0u32..).zip(mesh.vertices.iter().copied()).filter(|&(i, _)| used[i as usize]).collect();
    facets.iter().find_map(|&(triangle, facet)| {
        let protrudes = vertices.iter().find(|&&(_, p)| behind(facet, p) == Sign::Negative);
        protrudes.map(|&(vertex, _)| Convexity::Protrudes { triangle, vertex })
    })
}

/// Whether a ray from `apex` crosses exactly one facet.
///
/// A ray through an edge or a vertex decides nothing. Then the next facet is aimed at; all edges would have to conspire
/// against every one of them.
fn covered_once(facets: &[(usize, [Point<f64>; 3])], apex: Point<f64>) -> Convexity {
    let targets = facets.iter().filter(|&&(_, f)| behind(f, apex) == Sign::Positive);
    let crossings = targets.map(|(_, f)| mean(f)).find_map(|target| crossings(facets, apex, target));
    if crossings == Some(1) { Convexity::Convex } else { Convexity::Overlaps }
}

/// How many facets the ray from `apex` towards `target` crosses, if it meets no edge.
fn crossings(facets: &[(usize, [Point<f64>; 3])], apex: Point<f64>, target: Point<f64>) -> Option<usize> {
    let mut count = 0;
    for &(_, facet) in facets.iter().filter(|&&(_, f)| behind(f, apex) == Sign::Positive) {
        let [a, b, c] = facet;
        // Seen from the apex, inside of each edge: the target is on the same side of (apex, a, b) as c.
        let sides = [[a, b], [b, c], [c, a]].map(|[p, q]| behind([apex, q, p], target));
        let outside = sides.contains(&Sign::Negative);
        if !outside && sides.contains(&Sign::Zero) {
            return None;
        }
        count += usize::from(!outside);
    }
    (count > 0).then_some(count)
}

/// The mean, as differences from the first point.
fn mean(points: &[Point<f64>]) -> Point<f64> {
    let Some(&first) = points.first() else {
        return Point { x: 0.0, y: 0.0, z: 0.0 };
    };
    let n = points.len() as f64;
    let along = |f: fn(&Point<f64>) -> f64| f(&first) + points.iter().map(|p| f(p) - f(&first)).sum::<f64>() / n;
    Point { x: along(|p| p.x), y: along(|p| p.y), z: along(|p| p.z) }
}

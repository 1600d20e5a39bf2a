//! The findings of [`check`](crate::geometry::mesh_checks::check) in words: what, how many, where the first is, the remedy.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::algebra::cga::Point;
use crate::geometry::mesh::Mesh;
use crate::geometry::mesh_checks::{Examination, Message, Severity};
use crate::geometry::mesh_convexity::Convexity;
use crate::geometry::mesh_topology::{Edge, Topology};

/// All findings, errors first.
pub(crate) fn messages(found: &Examination<'_>) -> Vec<Message> {
    let errors = [open_edges(found), flipped(found), doubled(found), volume(found)];
    let warnings =
        [crowded_edges(found), cancelling(found), pinched(found), repeating(found), zero_area(found), negative(found)];
    let notes = [unused(found), not_convex(found), crossing(found)];
    let with = |severity| move |text: String| Message { severity, text };
    let errors = errors.into_iter().flatten().map(with(Severity::Error));
    let warnings = warnings.into_iter().flatten().map(with(Severity::Warning));
    errors.chain(warnings).chain(notes.into_iter().flatten().map(with(Severity::Note))).collect()
}

/// `1 edge`, `2 edges`, `2 vertices`, `2 boundaries`.
fn counted(n: usize, noun: &str) -> String {
    let plural = match noun {
        "vertex" => "vertices".into(),
        "boundary" => "boundaries".into(),
        _ => format!("{noun}s"),
    };
    if n == 1 { format!("1 {noun}") } else { format!("{n} {plural}") }
}

fn vertex(mesh: &Mesh, index: u32) -> String {
    let p = mesh.vertices[index as usize];
    format!("vertex {index} ({:?}, {:?}, {:?})", p.x, p.y, p.z)
}

fn edge(mesh: &Mesh, edge: &Edge) -> String {
    format!("between {} and {}", vertex(mesh, edge.ends[0]), vertex(mesh, edge.ends[1]))
}

fn triangle(mesh: &Mesh, index: usize) -> String {
    let [a, b, c] = mesh.triangles[index];
    format!("triangle {index} of {}, {}, {}", vertex(mesh, a), vertex(mesh, b), vertex(mesh, c))
}

fn open_edges(found: &Examination<'_>) -> Option<String> {
    let (mesh, topology) = (found.mesh, &found.topology);
    if topology.edges.is_empty() {
        return Some("every triangle repeats a vertex, so there is no surface: export the mesh again".into());
    }
    let first = topology.edges.iter().find(|e| e.is_open())?;
    let open = counted(found.counts.open_edges, "edge");
    let boundaries = counted(topology.n_boundaries(mesh), "boundary");
    let remedy = crack(mesh, topology).unwrap_or_else(|| "close the holes in the program that made the mesh".into());
    Some(format!(
        "the surface is not closed: {open} with an odd number of triangles, in {boundaries}; the first is {}, with {}; {remedy}",
        edge(mesh, first),
        counted(first.triangles(), "triangle"),
    ))
}

/// A gap between boundary vertices below this share of the size of the mesh is a crack, not a hole: it is what is left of
/// one vertex after two roundings to six digits or to f32 (relative 5e-7 and 6e-8).
const CRACK_SHARE: f64 = 1e-6;

/// The remedy if the boundary is a crack: two boundary vertices in nearly the same place, with no edge between them.
fn crack(mesh: &Mesh, topology: &Topology) -> Option<String> {
    let (a, b, gap) = nearest_boundary_pair(mesh, topology)?;
    let used: Vec<[f64; 3]> = mesh.used_vertices().into_iter().map(coordinates).collect();
    let low = used.iter().fold([f64::INFINITY; 3], |low, p| [0, 1, 2].map(|i| low[i].min(p[i])));
    let high = used.iter().fold([f64::NEG_INFINITY; 3], |high, p| [0, 1, 2].map(|i| high[i].max(p[i])));
    let size = distance(low, high);
    (gap <= CRACK_SHARE * size).then(|| {
        format!(
            "this is a crack: {} and {} are {gap:.1e} m apart but not equal; weld such vertices in the program that made \
             the mesh (only equal coordinates are welded here)",
            vertex(mesh, a),
            vertex(mesh, b)
        )
    })
}

fn coordinates(p: Point<f64>) -> [f64; 3] {
    [p.x, p.y, p.z]
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    libm::sqrt((0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum())
}

/// A direction along which few vertices of a regular grid are level. Slightly shorter than a unit vector, so that levels
/// are never further apart than the points, rounding included.
const SLANT: [f64; 3] = [0.47, 0.59, 0.65];

/// The two nearest vertices on the boundary that no edge joins.
///
/// A sweep along [`SLANT`]: a pair further apart along it than the best distance so far is further apart in space.
fn nearest_boundary_pair(mesh: &Mesh, topology: &Topology) -> Option<(u32, u32, f64)> {
    let mut on_boundary: Vec<u32> = topology.edges.iter().filter(|e| e.is_open()).flat_map(|e| e.ends).collect();
    on_boundary.sort_unstable();
    on_boundary.dedup();
    let mut swept: Vec<(f64, u32, [f64; 3])> = on_boundary
        .into_iter()
        .map(|i| (i, coordinates(mesh.vertices[i as usize])))
        .map(|(i, p)| (SLANT[0] * p[0] + SLANT[1] * p[1] + SLANT[2] * p[2], i, p))
        .collect();
    swept.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let joined = |a: u32, b: u32| topology.edges.binary_search_by_key(&[a.min(b), a.max(b)], |e| e.ends).is_ok();
    let mut best: Option<(u32, u32, f64)> = None;
    for (place, &(level, i, p)) in swept.iter().enumerate() {
        for &(other_level, j, q) in &swept[place + 1..] {
            let gap = best.map_or(f64::INFINITY, |b| b.2);
            // A level carries three roundings of its own, each below an ulp of the largest coordinate.
            let rounding = 8.0 * f64::EPSILON * (0..3).map(|i| p[i].abs() + q[i].abs()).sum::<f64>();
            if other_level - level > gap + rounding {
                break;
            }
            let apart = distance(p, q);
            if apart < gap && !joined(i, j) {
                best = Some((i, j, apart));
            }
        }
    }
    best
}

fn flipped(found: &Examination<'_>) -> Option<String> {
    let first = found.topology.edges.iter().find(|e| e.is_misoriented())?;
    let edges = counted(found.counts.misoriented_edges, "edge");
    let start = format!("the facets disagree about the outside: {edges} run along the same way by both sides; ");
    let place = format!("the first is {}; ", edge(found.mesh, first));
    let remedy = match found.patches.flipped.first() {
        _ if !found.patches.orientable => {
            "the surface has one side only (like a Moebius strip) and bounds no solid".into()
        }
        Some(&one) => format!(
            "{} wound against the rest, the first is {}; reverse the winding of these",
            counted(found.patches.flipped.len(), "triangle"),
            triangle(found.mesh, one)
        ),
        None => "reverse the winding of the facets on one side".into(),
    };
    Some(start + &place + &remedy)
}

fn doubled(found: &Examination<'_>) -> Option<String> {
    let mut doubled = found.duplicates.iter().filter(|(_, doubled)| *doubled).map(|(run, _)| run);
    let run = doubled.next()?;
    let sets = counted(1 + doubled.count(), "set");
    Some(format!(
        "{sets} of triangles on the same three vertices with the same sense, {} in the first, {}; the space behind them \
         would count more than once; delete the copies",
        run.len(),
        triangle(found.mesh, run[0]),
    ))
}

fn volume(found: &Examination<'_>) -> Option<String> {
    match found.volume? {
        Err(error) => Some(format!("{error}")),
        Ok(volume) if volume > 0.0 => None,
        Ok(volume) if volume < 0.0 => Some(format!(
            "the mesh is inside out: its signed volume is {volume:?} m³; reverse the winding of every facet, so that it is \
             counter-clockwise seen from outside"
        )),
        Ok(_) => {
            Some("the mesh encloses no volume: its facets cancel (a flat or doubled sheet); give it thickness".into())
        }
    }
}

fn crowded_edges(found: &Examination<'_>) -> Option<String> {
    let first = found.topology.edges.iter().find(|e| e.triangles() > 2)?;
    let balanced = !found.topology.edges.iter().any(|e| e.triangles() > 2 && (e.is_open() || e.is_misoriented()));
    let meaning = if balanced {
        "their directions cancel, as where two boxes touch along an edge; such a solid is usable and counts as one body"
    } else {
        "their directions do not cancel; delete inner or doubled facets"
    };
    let n = counted(found.counts.crowded_edges, "edge");
    Some(format!(
        "{n} with more than two triangles (not manifold); the first is {}, with {} triangles; {meaning}",
        edge(found.mesh, first),
        first.triangles()
    ))
}

fn cancelling(found: &Examination<'_>) -> Option<String> {
    let mut cancelling = found.duplicates.iter().filter(|(_, doubled)| !doubled).map(|(run, _)| run);
    let run = cancelling.next()?;
    let sets = counted(1 + cancelling.count(), "set");
    Some(format!(
        "{sets} of triangles on the same three vertices with opposite senses, a sheet without thickness; the first is {}; delete both",
        triangle(found.mesh, run[0])
    ))
}

fn pinched(found: &Examination<'_>) -> Option<String> {
    let &(first, fans) = found.pinched.first()?;
    let n = counted(found.pinched.len(), "vertex");
    Some(format!(
        "{n} in which parts of the surface touch in a point only (not manifold); the first is {}, with {fans} fans of \
         triangles; if the parts should be apart, give each a vertex of its own",
        vertex(found.mesh, first)
    ))
}

fn repeating(found: &Examination<'_>) -> Option<String> {
    let &first = found.repeating.first()?;
    let n = counted(found.repeating.len(), "triangle");
    Some(format!(
        "{n} with the same vertex twice, ignored; the first is {}; delete such triangles",
        triangle(found.mesh, first)
    ))
}

fn zero_area(found: &Examination<'_>) -> Option<String> {
    let &first = found.zero_area.first()?;
    let n = counted(found.zero_area.len(), "triangle");
    Some(format!(
        "{n} of zero area, which have no normal; the first is {}; collapse such triangles",
        triangle(found.mesh, first)
    ))
}

fn negative(found: &Examination<'_>) -> Option<String> {
    let &(patch, volume) = found.negative_patches.first()?;
    let place = found.patches.patch.iter().position(|&p| p == Some(patch))?;
    (found.is_usable()).then(|| {
        format!(
            "{} of the {} parts of the surface with negative volume, the first of {volume} m³ with {}; right for a cavity, \
             otherwise that part is inside out (whether it lies inside another part is not checked)",
            found.negative_patches.len(),
            found.patches.count,
            triangle(found.mesh, place)
        )
    })
}

fn unused(found: &Examination<'_>) -> Option<String> {
    let first = (0u32..).zip(found.mesh.used()).find(|(_, used)| !used)?.0;
    let n = counted(found.counts.unused_vertices, "vertex");
    Some(format!("{n} not used by any facet and ignored; the first is {}", vertex(found.mesh, first)))
}

fn not_convex(found: &Examination<'_>) -> Option<String> {
    match found.convexity {
        Some(Convexity::Convex) => None,
        Some(Convexity::Protrudes { triangle: facet, vertex: i }) => {
            Some(format!("not convex: {} lies in front of {}", vertex(found.mesh, i), triangle(found.mesh, facet)))
        }
        Some(Convexity::Overlaps) => Some("not convex: parts of the surface lie within or over one another".into()),
        None => found.is_usable().then(|| "not convex: the surface touches itself".into()),
    }
}

fn crossing(found: &Examination<'_>) -> Option<String> {
    // A convex surface is known not to.
    let unknown = found.is_usable() && found.convexity != Some(Convexity::Convex);
    unknown.then(|| "whether the surface crosses itself is not checked".into())
}

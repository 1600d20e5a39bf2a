//! What is wrong with a mesh, where, and what to do about it.
//!
//! [`check`] answers whether a surface can serve as a body: **closed** (every edge has an even number of triangles, two
//! on a manifold), **oriented** (each edge is run along as often one way as the other, open ends aside) and of positive
//! volume. Such a surface is the boundary of a solid in the sense of the divergence theorem, so its mass properties are
//! defined. Short of a **manifold** (more than two triangles on an edge, triangles that cancel in pairs, a vertex in
//! which separate fans touch) it is still usable, with a warning: two boxes that touch along an edge or in a corner are
//! such solids. A triangle that is there twice with the same sense is refused, for its side would count twice.
//!
//! **Convex** is decided by exact signs, without a tolerance.
//!
//! Self-intersection is not looked for: a surface may pass all checks and cross itself.

use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use crate::geometry::mass_properties::{Integrals, MassError, MassProperties};
use crate::geometry::mesh::Mesh;
use crate::geometry::mesh_convexity::{Convexity, convexity, has_zero_area};
use crate::geometry::mesh_findings;
use crate::geometry::mesh_topology::{Patches, Topology, repeats_vertex};

/// How much a finding matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Good to know; nothing suffers.
    Note,
    /// Usable, but probably not what was meant.
    Warning,
    /// Not usable as a body.
    Error,
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Error => "error",
        })
    }
}

/// One finding: what is broken, where, and the remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// How much it matters.
    pub severity: Severity,
    /// The finding in a sentence or two.
    pub text: String,
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.severity, self.text)
    }
}

/// How often each thing occurs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct MeshCounts {
    /// Vertices, used or not.
    pub vertices: usize,
    /// Vertices that no facet uses.
    pub unused_vertices: usize,
    /// Undirected edges.
    pub edges: usize,
    /// Facets.
    pub triangles: usize,
    /// Edges with an odd number of triangles.
    pub open_edges: usize,
    /// Edges with more than two triangles.
    pub crowded_edges: usize,
    /// Edges whose triangles disagree about the outside.
    pub misoriented_edges: usize,
    /// Vertices in which several fans of triangles touch.
    pub pinched_vertices: usize,
    /// Triangles with the three vertices of an earlier one.
    pub duplicate_triangles: usize,
    /// Triangles that name a vertex twice.
    pub repeating_triangles: usize,
    /// Triangles of three different vertices on a line.
    pub zero_area_triangles: usize,
    /// Parts of the surface that share no edge.
    pub patches: usize,
}

/// The result of [`check`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MeshReport {
    /// Every edge has an even number of triangles: two on a manifold, 2k where parts of the surface touch.
    pub closed: bool,
    /// Each edge is run along as often one way as the other, open ends aside. True of an open surface of one sense.
    pub oriented: bool,
    /// At most two triangles on an edge, one fan at a vertex, no triangle twice. An open surface may be manifold.
    pub manifold: bool,
    /// The surface bounds a convex solid. False where there is no solid.
    pub convex: bool,
    /// Closed, oriented, of positive volume, and no triangle there twice with the same sense.
    pub usable_as_body: bool,
    /// The signed volume (m³), negative inside out; none where the surface is not closed and oriented.
    pub volume: Option<f64>,
    /// Volume, centre and inertia of a mesh that is usable as a body.
    pub mass_properties: Option<MassProperties>,
    /// How often each thing occurs.
    pub counts: MeshCounts,
    /// Findings, errors first.
    pub messages: Vec<Message>,
}

/// Everything the findings are worded from.
pub(crate) struct Examination<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) topology: Topology,
    pub(crate) patches: Patches,
    pub(crate) pinched: Vec<(u32, usize)>,
    /// Runs of triangles on the same three vertices, in order, and whether their senses fail to cancel.
    pub(crate) duplicates: Vec<(Vec<usize>, bool)>,
    pub(crate) repeating: Vec<usize>,
    pub(crate) zero_area: Vec<usize>,
    pub(crate) counts: MeshCounts,
    /// Why there is no volume, or the signed volume; none where the surface is not closed and oriented.
    pub(crate) volume: Option<Result<f64, MassError>>,
    /// Where that volume is positive.
    pub(crate) mass_properties: Option<MassProperties>,
    /// Patches with negative volume, where there are several patches.
    pub(crate) negative_patches: Vec<(usize, f64)>,
    /// None where the surface is not manifold or encloses nothing.
    pub(crate) convexity: Option<Convexity>,
}

/// Examines a mesh: closed, oriented, manifold, convex, usable, with counts and messages.
///
/// O(n log n) for n triangles. Only a surface that is locally convex everywhere and yet has facets of zero area, or is
/// thinner than its own roundings, costs O(n²).
#[must_use]
pub fn check(mesh: &Mesh) -> MeshReport {
    let found = Examination::new(mesh);
    let closed = found.topology.is_closed();
    let oriented = found.topology.is_oriented();
    let volume = found.volume.as_ref().and_then(|v| v.as_ref().ok()).copied();
    MeshReport {
        closed,
        oriented,
        manifold: found.is_manifold(),
        convex: found.convexity == Some(Convexity::Convex),
        usable_as_body: found.is_usable(),
        volume,
        mass_properties: found.mass_properties.filter(|_| found.is_usable()),
        counts: found.counts,
        messages: mesh_findings::messages(&found),
    }
}

impl<'a> Examination<'a> {
    fn new(mesh: &'a Mesh) -> Self {
        let topology = Topology::new(mesh);
        let patches = topology.patches();
        let pinched = topology.pinched_vertices(mesh);
        let (repeating, proper): (Vec<usize>, Vec<usize>) =
            (0..mesh.triangles.len()).partition(|&t| repeats_vertex(mesh.triangles[t]));
        let zero_area = proper.into_iter().filter(|&t| has_zero_area(mesh.corners(mesh.triangles[t]))).collect();
        let mut found = Self {
            mesh,
            topology,
            patches,
            pinched,
            duplicates: duplicates(mesh),
            repeating,
            zero_area,
            counts: MeshCounts::default(),
            volume: None,
            mass_properties: None,
            negative_patches: Vec::new(),
            convexity: None,
        };
        found.counts = found.count();
        found.measure();
        found
    }

    fn count(&self) -> MeshCounts {
        let edges = &self.topology.edges;
        MeshCounts {
            vertices: self.mesh.vertices.len(),
            unused_vertices: self.mesh.used().iter().filter(|used| !**used).count(),
            edges: edges.len(),
            triangles: self.mesh.triangles.len(),
            open_edges: edges.iter().filter(|e| e.is_open()).count(),
            crowded_edges: edges.iter().filter(|e| e.triangles() > 2).count(),
            misoriented_edges: edges.iter().filter(|e| e.is_misoriented()).count(),
            pinched_vertices: self.pinched.len(),
            duplicate_triangles: self.duplicates.iter().map(|(run, _)| run.len() - 1).sum(),
            repeating_triangles: self.repeating.len(),
            zero_area_triangles: self.zero_area.len(),
            patches: self.patches.count,
        }
    }

    /// Volume and convexity, where they are defined.
    fn measure(&mut self) {
        if !(self.topology.is_closed() && self.topology.is_oriented()) {
            return;
        }
        let sums = Integrals::new(self.mesh, &self.mesh.triangles);
        self.mass_properties = sums.as_ref().ok().and_then(|sums| sums.mass_properties().ok());
        self.volume = Some(sums.map(|sums| sums.volume()));
        if self.patches.count > 1 {
            self.negative_patches =
                self.volumes_of_patches().into_iter().enumerate().filter(|(_, v)| *v < 0.0).collect();
        }
        if self.is_usable() && self.is_manifold() {
            self.convexity = Some(convexity(self.mesh, &self.topology));
        }
    }

    fn volumes_of_patches(&self) -> Vec<f64> {
        let mut parts = alloc::vec![Vec::new(); self.patches.count];
        for (&triangle, patch) in self.mesh.triangles.iter().zip(&self.patches.patch) {
            if let Some(patch) = *patch {
                parts[patch].push(triangle);
            }
        }
        parts.iter().map(|part| Integrals::new(self.mesh, part).map_or(0.0, |sums| sums.volume())).collect()
    }

    pub(crate) fn is_manifold(&self) -> bool {
        self.counts.crowded_edges == 0 && self.counts.duplicate_triangles == 0 && self.counts.pinched_vertices == 0
    }

    pub(crate) fn is_usable(&self) -> bool {
        let encloses = matches!(self.volume, Some(Ok(volume)) if volume > 0.0);
        encloses && !self.duplicates.iter().any(|(_, doubled)| *doubled)
    }
}

/// The triangles on the same three vertices, and whether more than one is left after opposite senses cancel.
fn duplicates(mesh: &Mesh) -> Vec<(Vec<usize>, bool)> {
    let mut keyed: Vec<([u32; 3], usize, bool)> = Vec::with_capacity(mesh.triangles.len());
    for (place, &[a, b, c]) in mesh.triangles.iter().enumerate().filter(|(_, t)| !repeats_vertex(**t)) {
        let mut key = [a, b, c];
        key.sort_unstable();
        // The sense is whether the corners, turned to start with the smallest, then rise.
        let rising = [[a, b, c], [b, c, a], [c, a, b]].contains(&key);
        keyed.push((key, place, rising));
    }
    keyed.sort_unstable();
    let runs = keyed.chunk_by(|a, b| a.0 == b.0).filter(|run| run.len() > 1);
    let mut found: Vec<(Vec<usize>, bool)> = runs
        .map(|run| {
            let rising = run.iter().filter(|r| r.2).count();
            (run.iter().map(|r| r.1).collect(), rising.abs_diff(run.len() - rising) > 1)
        })
        .collect();
    found.sort_unstable();
    found
}

//! The edges of a mesh: which triangles meet at each, in which direction they run along it, and what follows.
//!
//! A surface encloses something when its directed edges cancel: each undirected edge is run along as often one way as
//! the other. That is what the divergence theorem needs; it holds for two triangles on an edge (a manifold one) and
//! also for 2k balanced ones, as where two boxes touch along an edge. Triangles that repeat a vertex run back along
//! their own edge, cancel themselves, and are left out here.
//!
//! Found by sorting the half-edges, first into buckets by their smaller end, so that what is left to sort are the few
//! edges of one vertex: O(n) on meshes, the same order on every machine. It knows indices only, no coordinates.

use alloc::vec::Vec;
use core::ops::Range;

use crate::geometry::disjoint_sets::DisjointSets;
use crate::geometry::mesh::Mesh;

/// One side of a triangle, filed under its undirected edge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HalfEdge {
    /// The ends, the smaller index first.
    pub(crate) ends: [u32; 2],
    /// The triangle.
    pub(crate) triangle: usize,
    /// Which corner of the triangle the side starts at.
    pub(crate) corner: usize,
    /// Whether it runs from the smaller index to the larger.
    pub(crate) forward: bool,
}

/// An undirected edge and its half-edges.
#[derive(Clone, Debug)]
pub(crate) struct Edge {
    /// The ends, the smaller index first.
    pub(crate) ends: [u32; 2],
    /// Where its half-edges stand in [`Topology::half_edges`].
    pub(crate) half_edges: Range<usize>,
    /// How many run from the smaller index to the larger.
    pub(crate) forward: usize,
}

impl Edge {
    /// How many triangles meet here.
    pub(crate) fn triangles(&self) -> usize {
        self.half_edges.len()
    }

    /// Whether the surface ends here: an odd number of triangles cannot cancel.
    pub(crate) fn is_open(&self) -> bool {
        self.triangles() % 2 == 1
    }

    /// Whether more triangles run one way than an open end would explain.
    pub(crate) fn is_misoriented(&self) -> bool {
        let backward = self.triangles() - self.forward;
        self.forward.abs_diff(backward) > self.triangles() % 2
    }
}

/// The half-edges of a mesh, sorted by edge, then by triangle.
pub(crate) struct Topology {
    pub(crate) half_edges: Vec<HalfEdge>,
    pub(crate) edges: Vec<Edge>,
    n_triangles: usize,
}

/// How the triangles hang together across edges.
pub(crate) struct Patches {
    /// For each triangle the number of its patch, counted from 0; `None` where it repeats a vertex.
    pub(crate) patch: Vec<Option<usize>>,
    /// How many patches there are.
    pub(crate) count: usize,
    /// The triangles that run against the greater part of their patch.
    pub(crate) flipped: Vec<usize>,
    /// Whether each patch can be given one sense at all (a Moebius strip cannot).
    pub(crate) orientable: bool,
}

/// Whether a triangle names the same vertex twice.
pub(crate) fn repeats_vertex([a, b, c]: [u32; 3]) -> bool {
    a == b || b == c || c == a
}

/// Whether the surface closes and agrees about the outside: each edge is run along as often one way as the other.
///
/// The same as asking the [`Topology`] for open and misoriented edges, without naming any: a tally for each end that is
/// larger than the smaller one's, so nothing needs to be sorted.
pub(crate) fn edges_cancel(mesh: &Mesh) -> bool {
    // Loops, not chains of iterators: those took six times as long.
    let mut next = alloc::vec![0usize; mesh.vertices.len() + 1];
    for &[a, b, c] in mesh.triangles.iter().filter(|t| !repeats_vertex(**t)) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            next[from.min(to) as usize + 1] += 1;
        }
    }
    for vertex in 1..next.len() {
        next[vertex] += next[vertex - 1];
    }
    let mut ends = alloc::vec![(0u32, 0i32); next[mesh.vertices.len()]];
    for &[a, b, c] in mesh.triangles.iter().filter(|t| !repeats_vertex(**t)) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let place = &mut next[from.min(to) as usize];
            ends[*place] = if from < to { (to, 1) } else { (from, -1) };
            *place += 1;
        }
    }
    // A bucket that has been filled ends where the next began.
    let (mut start, mut balance) = (0, alloc::vec![0i32; mesh.vertices.len()]);
    next[..mesh.vertices.len()].iter().all(|&end| {
        let bucket = &ends[start..end];
        start = end;
        bucket.iter().for_each(|&(end, sense)| balance[end as usize] += sense);
        bucket.iter().all(|&(end, _)| balance[end as usize] == 0)
    })
}

/// The half-edges by edge, then by triangle.
fn sorted_half_edges(mesh: &Mesh) -> Vec<HalfEdge> {
    let proper = || (0..mesh.triangles.len()).filter(|&t| !repeats_vertex(mesh.triangles[t]));
    let sides = |triangle: usize| {
        let corners = mesh.triangles[triangle];
        [0, 1, 2].map(|corner| {
            let (from, to) = (corners[corner], corners[(corner + 1) % 3]);
            HalfEdge { ends: [from.min(to), from.max(to)], triangle, corner, forward: from < to }
        })
    };
    // Where the bucket of each vertex starts, and then, while it is filled, where it goes on.
    let mut next = alloc::vec![0usize; mesh.vertices.len() + 1];
    for side in proper().flat_map(sides) {
        next[side.ends[0] as usize + 1] += 1;
    }
    for vertex in 1..next.len() {
        next[vertex] += next[vertex - 1];
    }
    let nothing = HalfEdge { ends: [0; 2], triangle: 0, corner: 0, forward: false };
    let mut half_edges = alloc::vec![nothing; next[mesh.vertices.len()]];
    for side in proper().flat_map(sides) {
        let place = &mut next[side.ends[0] as usize];
        half_edges[*place] = side;
        *place += 1;
    }
    for bucket in half_edges.chunk_by_mut(|a, b| a.ends[0] == b.ends[0]) {
        bucket.sort_unstable_by_key(|h| (h.ends[1], h.triangle));
    }
    half_edges
}

impl Topology {
    /// Sorts the half-edges of the mesh.
    pub(crate) fn new(mesh: &Mesh) -> Self {
        let half_edges = sorted_half_edges(mesh);
        let mut edges = Vec::with_capacity(half_edges.len() / 2);
        let mut start = 0;
        for run in half_edges.chunk_by(|a, b| a.ends == b.ends) {
            let end = start + run.len();
            let forward = run.iter().filter(|h| h.forward).count();
            edges.push(Edge { ends: run[0].ends, half_edges: start..end, forward });
            start = end;
        }
        Self { half_edges, edges, n_triangles: mesh.triangles.len() }
    }

    /// The sides of triangles that meet at an edge.
    pub(crate) fn sides(&self, edge: &Edge) -> &[HalfEdge] {
        &self.half_edges[edge.half_edges.clone()]
    }

    /// Whether every edge has an even number of triangles.
    pub(crate) fn is_closed(&self) -> bool {
        !self.edges.is_empty() && self.edges.iter().all(|e| !e.is_open())
    }

    /// Whether no edge is run along more often one way than the other, open ends aside.
    pub(crate) fn is_oriented(&self) -> bool {
        self.edges.iter().all(|e| !e.is_misoriented())
    }

    /// The patches of triangles joined across edges, and the triangles of the wrong sense in each.
    ///
    /// Sense is compared across edges with two triangles; where more meet, no pairing is known.
    pub(crate) fn patches(&self) -> Patches {
        let mut sets = DisjointSets::new(self.n_triangles);
        let mut orientable = true;
        for edge in self.edges.iter().filter(|e| e.triangles() == 2) {
            if let [a, b] = self.sides(edge) {
                orientable &= sets.join(a.triangle, b.triangle, a.forward == b.forward);
            }
        }
        let senses: Vec<(usize, bool)> = (0..self.n_triangles).map(|t| sets.find(t)).collect();
        let (mut size, mut against) = (alloc::vec![0usize; self.n_triangles], alloc::vec![0usize; self.n_triangles]);
        for &(root, odd) in &senses {
            size[root] += 1;
            against[root] += usize::from(odd);
        }
        let minority = |&(root, odd): &(usize, bool)| odd == (2 * against[root] <= size[root]) && against[root] > 0;
        let flipped = (0..self.n_triangles).filter(|&t| minority(&senses[t])).collect();
        let (patch, count) = self.number_patches(&mut sets);
        Patches { patch, count, flipped, orientable }
    }

    /// Joins the patches that meet at an edge of many triangles too, and numbers them in the order of the triangles.
    fn number_patches(&self, sets: &mut DisjointSets) -> (Vec<Option<usize>>, usize) {
        let mut counts = alloc::vec![false; self.n_triangles];
        for edge in &self.edges {
            for pair in self.sides(edge).windows(2) {
                sets.join(pair[0].triangle, pair[1].triangle, false);
            }
            for side in self.sides(edge) {
                counts[side.triangle] = true;
            }
        }
        let mut number = alloc::vec![None; self.n_triangles];
        let mut count = 0;
        let mut patch = Vec::with_capacity(self.n_triangles);
        for (triangle, &counts) in counts.iter().enumerate() {
            let root = sets.find(triangle).0;
            if counts && number[root].is_none() {
                number[root] = Some(count);
                count += 1;
            }
            patch.push(if counts { number[root] } else { None });
        }
        (patch, count)
    }

    /// The vertices at which several fans of triangles touch in that vertex only, in order, with the number of fans.
    ///
    /// At a vertex of a manifold the triangles form one fan: each reaches the next across an edge of that vertex.
    pub(crate) fn pinched_vertices(&self, mesh: &Mesh) -> Vec<(u32, usize)> {
        let mut fans = DisjointSets::new(3 * self.n_triangles);
        let corner_at = |side: &HalfEdge, vertex: u32| {
            let corner =
                if mesh.triangles[side.triangle][side.corner] == vertex { side.corner } else { (side.corner + 1) % 3 };
            3 * side.triangle + corner
        };
        for edge in &self.edges {
            for pair in self.sides(edge).windows(2) {
                for end in edge.ends {
                    fans.join(corner_at(&pair[0], end), corner_at(&pair[1], end), false);
                }
            }
        }
        let mut n_fans = alloc::vec![0usize; mesh.vertices.len()];
        for side in &self.half_edges {
            let corner = 3 * side.triangle + side.corner;
            if fans.find(corner).0 == corner {
                n_fans[mesh.triangles[side.triangle][side.corner] as usize] += 1;
            }
        }
        (0u32..).zip(n_fans).filter(|&(_, n)| n > 1).collect()
    }

    /// How many separate boundaries the open edges form.
    pub(crate) fn n_boundaries(&self, mesh: &Mesh) -> usize {
        let mut loops = DisjointSets::new(mesh.vertices.len());
        let mut on_boundary = alloc::vec![false; mesh.vertices.len()];
        for edge in self.edges.iter().filter(|e| e.is_open()) {
            let [a, b] = edge.ends.map(|i| i as usize);
            loops.join(a, b, false);
            (on_boundary[a], on_boundary[b]) = (true, true);
        }
        (0..on_boundary.len()).filter(|&v| on_boundary[v] && loops.find(v).0 == v).count()
    }
}

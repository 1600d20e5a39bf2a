//! Disjoint sets with parity: which items hang together, and whether two of them agree or oppose each other.
//!
//! Union by size with path halving would lose the parities, so paths are compressed in a second walk.
//! Source: Tarjan, *Efficiency of a good but not linear set union algorithm*, 1975; the parity is the usual extension.

use alloc::vec::Vec;

/// A partition of `0..n`. Each item holds its parity relative to its parent.
pub(crate) struct DisjointSets {
    parent: Vec<usize>,
    odd: Vec<bool>,
    size: Vec<usize>,
}

impl DisjointSets {
    /// `n` sets of one item each.
    pub(crate) fn new(n: usize) -> Self {
        Self { parent: (0..n).collect(), odd: alloc::vec![false; n], size: alloc::vec![1; n] }
    }

    /// The item that stands for the set of `item`, and whether `item` opposes it.
    pub(crate) fn find(&mut self, item: usize) -> (usize, bool) {
        let (mut root, mut odd) = (item, false);
        while self.parent[root] != root {
            odd ^= self.odd[root];
            root = self.parent[root];
        }
        let (mut at, mut odd_at) = (item, odd);
        while self.parent[at] != root {
            let (next, step) = (self.parent[at], self.odd[at]);
            (self.parent[at], self.odd[at]) = (root, odd_at);
            odd_at ^= step;
            at = next;
        }
        (root, odd)
    }

    /// Joins the sets of `a` and `b`, which oppose each other if `oppose`. False if they were known to do otherwise.
    pub(crate) fn join(&mut self, a: usize, b: usize, oppose: bool) -> bool {
        let ((a, a_odd), (b, b_odd)) = (self.find(a), self.find(b));
        if a == b {
            return (a_odd ^ b_odd) == oppose;
        }
        let (large, small) = if self.size[a] >= self.size[b] { (a, b) } else { (b, a) };
        self.parent[small] = large;
        self.odd[small] = a_odd ^ b_odd ^ oppose;
        self.size[large] += self.size[small];
        true
    }
}

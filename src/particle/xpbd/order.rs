//! The order of the links: blocks of consecutive particles, and colours within them.
//!
//! ```text
//! inner[k]   both ends in block k                      windows of BLOCK particles from 0
//! even[k]    between the blocks 2k and 2k + 1          windows of 2 BLOCK from 0
//! odd[k]     between the blocks 2k + 1 and 2k + 2      windows of 2 BLOCK from BLOCK
//! rest       between blocks that are no neighbours     one window of all
//! ```
//!
//! Windows of one kind are disjoint: their parts can be swept at the same time. A greedy colouring gives each link the
//! first colour that neither of its particles has (at most twice the largest number of links at a particle).

use super::{BLOCK, GROUP};
use alloc::vec;
use alloc::vec::Vec;

/// Two particles, counted from the start of a window, and their squared distance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub(super) a: u32,
    pub(super) b: u32,
    pub(super) length_sq: f64,
}

impl Link {
    #[expect(clippy::cast_possible_truncation, reason = "more particles than 32 bits count are refused")]
    pub(super) fn new(a: usize, b: usize, length: f64) -> Self {
        Self { a: a as u32, b: b as u32, length_sq: length * length }
    }

    fn blocks(self) -> (usize, usize) {
        let (a, b) = (self.a as usize / BLOCK, self.b as usize / BLOCK);
        (a.min(b), a.max(b))
    }
}

/// Links within a window, and the groups of them that are to be swept again.
#[derive(Clone, Debug, Default)]
pub(super) struct Part {
    pub(super) links: Vec<Link>,
    pub(super) again: Vec<u32>,
}

/// All links.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) inner: Vec<Part>,
    pub(super) even: Vec<Part>,
    pub(super) odd: Vec<Part>,
    pub(super) rest: Part,
}

impl Plan {
    pub(super) fn new(particles: usize, mut links: Vec<Link>) -> Self {
        // Memory is then read in its order, however the constraints were listed.
        links.sort_by_key(|link| (link.a.max(link.b), link.a.min(link.b)));
        let blocks = particles.div_ceil(BLOCK);
        let mut inner = vec![Vec::new(); blocks];
        let mut even = vec![Vec::new(); blocks.div_ceil(2)];
        let mut odd = vec![Vec::new(); blocks.saturating_sub(1).div_ceil(2)];
        let mut rest = Vec::new();
        for link in links {
            match link.blocks() {
                (low, high) if low == high => inner[low].push(link),
                (low, high) if low + 1 < high => rest.push(link),
                (low, _) if low % 2 == 0 => even[low / 2].push(link),
                (low, _) => odd[low / 2].push(link),
            }
        }
        let mut used = vec![0; particles];
        let mut parts = |links: Vec<Vec<Link>>, window: usize, start: usize| -> Vec<Part> {
            let base = |index: usize| start + index * window;
            links.into_iter().enumerate().map(|(index, links)| Part::new(&links, base(index), &mut used)).collect()
        };
        let (inner, even, odd) = (parts(inner, BLOCK, 0), parts(even, 2 * BLOCK, 0), parts(odd, 2 * BLOCK, BLOCK));
        Self { inner, even, odd, rest: Part::new(&rest, 0, &mut used) }
    }

    /// Every part, with the start of its window.
    pub(super) fn parts(&self) -> impl Iterator<Item = (usize, &Part)> {
        let windows =
            |parts: &'_ [Part], window: usize, start: usize| (0..parts.len()).map(move |k| start + k * window);
        let starts = windows(&self.inner, BLOCK, 0)
            .chain(windows(&self.even, 2 * BLOCK, 0))
            .chain(windows(&self.odd, 2 * BLOCK, BLOCK))
            .chain([0]);
        starts.zip(self.inner.iter().chain(&self.even).chain(&self.odd).chain([&self.rest]))
    }
}

impl Part {
    /// Orders by colours. `used` holds, for every particle, the colours that it has: zeros, and zeros again afterwards.
    #[expect(clippy::cast_possible_truncation, reason = "an index within a window fits, as those of all particles do")]
    fn new(links: &[Link], start: usize, used: &mut [u64]) -> Self {
        let mut coloured: Vec<(u32, Link)> = Vec::with_capacity(links.len());
        for link in links {
            let (a, b) = (link.a as usize, link.b as usize);
            // A particle of more than 63 links has the rest of them in the last colour: only slower.
            let colour = (used[a] | used[b]).trailing_ones().min(63);
            used[a] |= 1 << colour;
            used[b] |= 1 << colour;
            coloured.push((colour, Link { a: link.a - start as u32, b: link.b - start as u32, ..*link }));
        }
        for link in links {
            used[link.a as usize] = 0;
            used[link.b as usize] = 0;
        }
        coloured.sort_by_key(|(colour, _)| *colour);
        let mut links: Vec<Link> = coloured.into_iter().map(|(_, link)| link).collect();
        // It is collected in the place of the pairs, which were larger.
        links.shrink_to_fit();
        Self { again: Vec::with_capacity(links.len().div_ceil(GROUP)), links }
    }
}

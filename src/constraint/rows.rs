//! The rows of all constraints: values C, gradients J, curvatures `Jdot q'`, over blocks of D coordinates.
//!
//! A block is what moves as one: a particle (D = 3), a body (D = 6). Row r has entries (block, gradient); where the
//! entries are is fixed when the rows are made, their numbers are refilled at every evaluation without allocation.
//!
//! ```text
//! C' = J q',   C'' = J q'' + Jdot q',   q'' = W (Q + J^T lambda)   =>   J W J^T lambda = -Jdot q' - J W Q   (report, 24)
//! ```
//!
//! W holds the inverse masses. Sign: `+J^T lambda` is the force. Units: those of C divided by those of q, row by row.
//! Nothing here knows what a constraint is, nor how positions are stored.

use alloc::vec;
use alloc::vec::Vec;

/// The inverse masses of the blocks.
pub trait InverseMass<const D: usize> {
    /// `W x` for one block: the acceleration that a force gives it.
    fn accelerate(&self, block: usize, force: [f64; D]) -> [f64; D];

    /// Whether nothing moves the block: `W = 0`.
    fn is_fixed(&self, block: usize) -> bool;
}

/// One number a block, 1/kg; 0 is fixed.
impl<const D: usize> InverseMass<D> for [f64] {
    #[inline]
    fn accelerate(&self, block: usize, force: [f64; D]) -> [f64; D] {
        force.map(|x| x * self[block])
    }

    #[inline]
    fn is_fixed(&self, block: usize) -> bool {
        self[block] == 0.0
    }
}

/// Values, gradients and curvatures of constraints.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows<const D: usize> {
    value: Vec<f64>,
    curvature: Vec<f64>,
    /// The entries of row r are `starts[r] .. starts[r + 1]`.
    starts: Vec<u32>,
    block: Vec<u32>,
    gradient: Vec<[f64; D]>,
    blocks: usize,
}

/// A row to read.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a, const D: usize> {
    /// C.
    pub value: f64,
    /// `Jdot q'`.
    pub curvature: f64,
    /// Which blocks.
    pub blocks: &'a [u32],
    /// The gradient of C with each of them.
    pub gradients: &'a [[f64; D]],
}

/// A row to fill.
#[derive(Debug)]
pub struct RowMut<'a, const D: usize> {
    /// C.
    pub value: &'a mut f64,
    /// `Jdot q'`.
    pub curvature: &'a mut f64,
    /// The gradient of C with each block, in the order of the pattern.
    pub gradients: &'a mut [[f64; D]],
}

/// Indices are kept in 32 bits: half the memory traffic of sparse loops.
#[expect(clippy::cast_possible_truncation, reason = "asserted")]
pub(super) fn narrow(index: usize) -> u32 {
    assert!(index < u32::MAX as usize, "{index} is too many for the rows of constraints");
    index as u32
}

#[inline]
pub(super) fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl<const D: usize> Rows<D> {
    /// Rows over `blocks` blocks, one for each list of the blocks that it depends on, all numbers 0. A block may occur
    /// twice in a row; the gradients add.
    ///
    /// # Panics
    /// A block that is not among them.
    #[must_use]
    pub fn new<L: IntoIterator<Item = usize>>(blocks: usize, pattern: impl IntoIterator<Item = L>) -> Self {
        let (mut starts, mut block) = (vec![0], Vec::new());
        for row in pattern {
            block.extend(row.into_iter().map(|index| {
                assert!(index < blocks, "a row names block {index} of {blocks}");
                narrow(index)
            }));
            starts.push(narrow(block.len()));
        }
        let rows = starts.len() - 1;
        let gradient = vec![[0.0; D]; block.len()];
        Self { value: vec![0.0; rows], curvature: vec![0.0; rows], starts, block, gradient, blocks }
    }

    /// How many rows.
    #[inline]
    #[must_use]
    pub fn len(&self) -> usize {
        self.value.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.value.is_empty()
    }

    /// How many blocks there are, in rows or not.
    #[must_use]
    pub fn blocks(&self) -> usize {
        self.blocks
    }

    /// C of every row.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.value
    }

    /// `Jdot q'` of every row.
    #[must_use]
    pub fn curvatures(&self) -> &[f64] {
        &self.curvature
    }

    #[inline]
    pub(super) fn entries(&self, row: usize) -> core::ops::Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }

    pub(super) fn block_of(&self, entry: usize) -> usize {
        self.block[entry] as usize
    }

    pub(super) fn gradients(&self) -> &[[f64; D]] {
        &self.gradient
    }

    pub(super) fn blocks_of_entries(&self) -> &[u32] {
        &self.block
    }

    /// One row.
    #[inline]
    #[must_use]
    pub fn row(&self, row: usize) -> Row<'_, D> {
        let entries = self.entries(row);
        Row {
            value: self.value[row],
            curvature: self.curvature[row],
            blocks: &self.block[entries.clone()],
            gradients: &self.gradient[entries],
        }
    }

    /// One row, to be filled.
    #[inline]
    pub fn row_mut(&mut self, row: usize) -> RowMut<'_, D> {
        let entries = self.entries(row);
        RowMut {
            value: &mut self.value[row],
            curvature: &mut self.curvature[row],
            gradients: &mut self.gradient[entries],
        }
    }

    /// The gradients of another evaluation of the same constraints, without allocation.
    pub fn assign_gradients(&mut self, other: &Self) {
        self.gradient.copy_from_slice(&other.gradient);
    }

    /// `J v`; `v` gives the coordinates of a block.
    #[inline]
    pub fn times(&self, v: impl Fn(usize) -> [f64; D], out: &mut [f64]) {
        for (out, window) in out.iter_mut().zip(self.starts.windows(2)) {
            let entries = window[0] as usize..window[1] as usize;
            let terms = self.block[entries.clone()].iter().zip(&self.gradient[entries]);
            *out = terms.map(|(block, gradient)| dot(gradient, &v(*block as usize))).sum();
        }
    }

    /// `J^T x`, entry by entry: `add` gets a block and what the row adds to it.
    #[inline]
    pub fn transposed_times(&self, x: &[f64], mut add: impl FnMut(usize, [f64; D])) {
        for (x, window) in x.iter().zip(self.starts.windows(2)) {
            let entries = window[0] as usize..window[1] as usize;
            for (block, gradient) in self.block[entries.clone()].iter().zip(&self.gradient[entries]) {
                add(*block as usize, gradient.map(|g| g * x));
            }
        }
    }

    /// `W J^T x`, a displacement or an impulse's change of velocity, into one array a block.
    pub fn response(&self, inverse_mass: &(impl InverseMass<D> + ?Sized), x: &[f64], out: &mut [[f64; D]]) {
        out.fill([0.0; D]);
        self.transposed_times(x, |block, force| add_to(&mut out[block], force));
        for (block, out) in out.iter_mut().enumerate() {
            *out = inverse_mass.accelerate(block, *out);
        }
    }

    /// `A x = J W J^T x` without A. `room` holds one array a block.
    pub fn normal_times(
        &self,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        x: &[f64],
        room: &mut [[f64; D]],
        out: &mut [f64],
    ) {
        self.response(inverse_mass, x, room);
        self.times(|block| room[block], out);
    }
}

#[inline]
pub(super) fn add_to<const D: usize>(sum: &mut [f64; D], term: [f64; D]) {
    for (sum, term) in sum.iter_mut().zip(term) {
        *sum += term;
    }
}

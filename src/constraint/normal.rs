//! The matrix `A = J W J^T` of the multipliers, assembled: its lower triangle, row by row, in a given order of the rows.
//!
//! Rows r and q meet in A where they share a block that moves: `A_rq = sum over shared blocks g_r . W g_q`. Which pairs of
//! entries of J meet where is found once; filling is then one pass over the pairs.

use super::rows::{dot, narrow};
use super::{InverseMass, Rows};
use alloc::vec;
use alloc::vec::Vec;

#[derive(Clone, Debug)]
pub(super) struct Normal<const D: usize> {
    /// Row k of the order is row `order[k]` of the constraints.
    pub(super) order: Vec<u32>,
    /// Entries of row k: `starts[k] .. starts[k + 1]`, columns ascending, the diagonal last.
    pub(super) starts: Vec<u32>,
    pub(super) column: Vec<u32>,
    pub(super) value: Vec<f64>,
    /// Pairs of entries of J that add up to an entry of A.
    pair_starts: Vec<u32>,
    pairs: Vec<(u32, u32)>,
    /// `W g` of every entry of J.
    weighted: Vec<[f64; D]>,
}

/// The rows that each moving block couples, as lists of (row, entry).
pub(super) fn meetings<const D: usize>(
    rows: &Rows<D>,
    inverse_mass: &(impl InverseMass<D> + ?Sized),
) -> Vec<Vec<(usize, usize)>> {
    let mut at_block = vec![Vec::new(); rows.blocks()];
    for row in 0..rows.len() {
        for entry in rows.entries(row) {
            let block = rows.block_of(entry);
            if !inverse_mass.is_fixed(block) {
                at_block[block].push((row, entry));
            }
        }
    }
    at_block
}

/// The full symmetric pattern of A without values, by columns, each ascending: what an ordering reads.
pub(super) fn pattern<const D: usize>(
    rows: &Rows<D>,
    inverse_mass: &(impl InverseMass<D> + ?Sized),
) -> Vec<Vec<usize>> {
    let mut columns: Vec<Vec<usize>> = (0..rows.len()).map(|row| vec![row]).collect();
    for meeting in meetings(rows, inverse_mass) {
        for (row, _) in &meeting {
            columns[*row].extend(meeting.iter().map(|(other, _)| *other));
        }
    }
    for column in &mut columns {
        column.sort_unstable();
        column.dedup();
    }
    columns
}

impl<const D: usize> Normal<D> {
    pub(super) fn new(rows: &Rows<D>, inverse_mass: &(impl InverseMass<D> + ?Sized), order: Vec<u32>) -> Self {
        let mut place = vec![0; order.len()];
        for (at, row) in order.iter().enumerate() {
            place[*row as usize] = at;
        }
        // (column, first entry of J, second): pairs of the same column become neighbours by sorting.
        let mut found: Vec<Vec<(u32, u32, u32)>> = vec![Vec::new(); order.len()];
        for meeting in meetings(rows, inverse_mass) {
            for (row, entry) in &meeting {
                let lower = meeting.iter().filter(|(other, _)| place[*other] <= place[*row]);
                found[place[*row]]
                    .extend(lower.map(|(other, of_other)| (narrow(place[*other]), narrow(*entry), narrow(*of_other))));
            }
        }
        let (mut starts, mut column, mut pair_starts, mut pairs) = (vec![0], Vec::new(), vec![0], Vec::new());
        for (at, mut row) in found.into_iter().enumerate() {
            row.sort_unstable();
            for same in row.chunk_by(|a, b| a.0 == b.0) {
                column.push(same[0].0);
                pairs.extend(same.iter().map(|(_, a, b)| (*a, *b)));
                pair_starts.push(narrow(pairs.len()));
            }
            // A row of fixed blocks alone still has its diagonal: 0.
            if column[starts[at] as usize..].last() != Some(&narrow(at)) {
                column.push(narrow(at));
                pair_starts.push(narrow(pairs.len()));
            }
            starts.push(narrow(column.len()));
        }
        let value = vec![0.0; column.len()];
        let weighted = vec![[0.0; D]; rows.gradients().len()];
        Self { order, starts, column, value, pair_starts, pairs, weighted }
    }

    /// Computes the values from the present gradients.
    pub(super) fn fill(&mut self, rows: &Rows<D>, inverse_mass: &(impl InverseMass<D> + ?Sized)) {
        let gradients = rows.gradients();
        for ((weighted, gradient), block) in self.weighted.iter_mut().zip(gradients).zip(rows.blocks_of_entries()) {
            *weighted = inverse_mass.accelerate(*block as usize, *gradient);
        }
        for (value, window) in self.value.iter_mut().zip(self.pair_starts.windows(2)) {
            let pairs = &self.pairs[window[0] as usize..window[1] as usize];
            *value = pairs.iter().map(|(a, b)| dot(&gradients[*a as usize], &self.weighted[*b as usize])).sum();
        }
    }

    /// Columns and values of a row in the order, the diagonal last.
    #[inline]
    pub(super) fn row(&self, at: usize) -> (&[u32], &[f64]) {
        let entries = self.starts[at] as usize..self.starts[at + 1] as usize;
        (&self.column[entries.clone()], &self.value[entries])
    }
}

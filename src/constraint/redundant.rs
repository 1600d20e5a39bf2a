//! Which of the rows that depend on each other to drop.
//!
//! Elimination drops the last of them, even where those before nearly depend on each other without it. It is better to drop
//! those that have the largest shares in the dependences (Chan 1987, *Rank revealing QR factorizations*): the others are
//! then as independent as can be, or nearly.
//!
//! Rows that depend on each other *because* the constraints hold, as those of a linkage, do so up to the square of the
//! violation. Where gradients are off by delta, a pivot that should be 0 is up to `(4 delta)² sum v_i² a_ii`, with the v of
//! rounding ([`super::direct::NOISE`]), and its row is redundant all the same: taken as independent it would ask for
//! multipliers like 1 / delta. A light block between heavy ones leaves small pivots too, though, and its rows must be kept.
//! So this is decided with the gradients alone, in a measure in which all blocks weigh alike.

use super::direct::NOISE;
use super::{Direct, InverseMass, Rows, SolveError};
use alloc::vec::Vec;

/// Where a pivot keeps less than this of its diagonal and rows are redundant, others may be the better ones to drop: with
/// a kept row that depends on others up to 1 %, gradients that turn by 1 % change what it asks for by all of it.
const WEAK: f64 = 1e-2;

/// More redundant rows stay as they are: the search for better ones takes the square of their number times all rows.
const MOST_EXCHANGED: usize = 32;

/// By how many times the relative violation of a constraint its gradients are off: those of the blocks on both sides turn,
/// each by what both of its constraints leave. From 1 to 16 four-bars held to 1e-6 to 1e-4 move alike.
const OFF: f64 = 4.0;

/// Gradients that may be off by more are taken to be off by this: of a chain of n bodies between two walls, all of whose rows
/// are independent, the last pivot is `1 / n²` of its sum, and n may be 250.
const MOST_OFF: f64 = 1e-3;

/// How far gradients may be off, and a measure of blocks in which none is light.
#[derive(Clone, Debug, Default)]
pub(super) struct Apart<const D: usize> {
    inverse: Vec<[f64; D]>,
    off: f64,
}

impl<const D: usize> InverseMass<D> for Apart<D> {
    fn accelerate(&self, block: usize, force: [f64; D]) -> [f64; D] {
        core::array::from_fn(|i| force[i] * self.inverse[block][i])
    }

    /// Of no account: what is fixed is not in the pattern of A.
    fn is_fixed(&self, _block: usize) -> bool {
        false
    }
}

/// The index and the size of the largest number.
fn largest(x: &[f64]) -> (usize, f64) {
    let sizes = x.iter().map(|x| x.abs()).enumerate();
    sizes.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
}

impl<const D: usize> Direct<D> {
    /// See [`Multipliers::measure_by`](super::Multipliers::measure_by).
    pub(super) fn measure_by(&mut self, inverse: Vec<[f64; D]>) {
        self.apart.inverse = inverse;
    }

    /// See [`Multipliers::assume_off`](super::Multipliers::assume_off).
    pub(super) fn assume_off(&mut self, relative: f64) {
        self.apart.off = relative;
    }

    /// Marks the rows that are redundant up to what gradients are off; whether that may be more than those up to rounding.
    ///
    /// # Errors
    /// A gradient that is not finite.
    pub(super) fn look_apart(&mut self, rows: &Rows<D>) -> Result<bool, SolveError> {
        let off = (OFF * self.apart.off.min(MOST_OFF)).powi(2);
        if off <= NOISE || self.apart.inverse.is_empty() {
            return Ok(false);
        }
        let apart = core::mem::take(&mut self.apart);
        self.noise = NOISE + off;
        let mut looked = self.prepare_alike(rows, &apart);
        if looked.is_ok() && self.exchange() {
            looked = self.prepare_alike(rows, &apart);
        }
        (self.noise, self.apart) = (NOISE, apart);
        looked.map(|()| true)
    }

    /// Marks the rows to drop by a factorisation alike, if the last one kept a weak row; whether it did.
    pub(super) fn exchange(&mut self) -> bool {
        if self.weakest >= WEAK || !(1..=MOST_EXCHANGED).contains(&self.redundant.len()) {
            return false;
        }
        let (n, mut shares) = (self.inv_pivot.len(), core::mem::take(&mut self.shares));
        shares.clear();
        for k in (0..n).filter(|k| self.inv_pivot[*k] == 0.0) {
            self.append_dependence(k, &mut shares);
        }
        self.inv_pivot.fill(1.0);
        // Gaussian elimination with complete pivoting: the pivots' columns are the rows to drop.
        let mut left = shares.as_mut_slice();
        while !left.is_empty() {
            let sizes = left.chunks(n).map(|row| largest(row).1).enumerate();
            let best = sizes.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(index, _)| index);
            for column in 0..n {
                left.swap(column, best * n + column);
            }
            let (pivot, rest) = left.split_at_mut(n);
            let column = largest(pivot).0;
            self.inv_pivot[column] = 0.0;
            for other in rest.chunks_mut(n) {
                let part = other[column] / pivot[column];
                other.iter_mut().zip(&*pivot).for_each(|(x, y)| *x -= part * y);
            }
            left = rest;
        }
        self.shares = shares;
        true
    }

    /// The combination of rows that is 0 with a dropped row k: `L^T v = 0` before k, `v_k = 1`; in units in which A has a
    /// unit diagonal.
    fn append_dependence(&self, k: usize, shares: &mut Vec<f64>) {
        let first = shares.len();
        shares.resize(first + self.inv_pivot.len(), 0.0);
        let v = &mut shares[first..];
        v[k] = 1.0;
        for j in (0..k).rev() {
            let below = self.column_starts[j] as usize..self.column_starts[j + 1] as usize;
            let terms = self.row[below.clone()].iter().zip(&self.factor[below]);
            v[j] = -terms.map(|(row, l)| l * v[*row as usize]).sum::<f64>();
        }
        for (k, v) in v.iter_mut().enumerate() {
            // A row of nothing that moves depends on no other, and keeps its 1.
            *v *= self.normal.row(k).1.last().map_or(1.0, |value| if *value > 0.0 { value.sqrt() } else { 1.0 });
        }
    }
}

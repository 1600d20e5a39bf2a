//! Which of the rows that depend on each other to drop.
//!
//! Elimination drops the last of them, even where those before nearly depend on each other without it. It is better to drop
//! those that have the largest shares in the dependences (Chan 1987, *Rank revealing QR factorizations*): the others are
//! then as independent as can be, or nearly.

use super::Direct;

/// Where a pivot keeps less than this of its diagonal and rows are redundant, others may be the better ones to drop: with
/// a kept row that depends on others up to 1 %, gradients that turn by 1 % change what it asks for by all of it.
const WEAK: f64 = 1e-2;

/// More redundant rows stay as they are: the search for better ones takes the square of their number times all rows.
const MOST_EXCHANGED: usize = 32;

/// The index and the size of the largest number.
fn largest(x: &[f64]) -> (usize, f64) {
    let sizes = x.iter().map(|x| x.abs()).enumerate();
    sizes.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
}

impl<const D: usize> Direct<D> {
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

//! `J W J^T lambda = b` solved directly: sparse `L D L^T`, up-looking (Davis 2005, *Algorithm 849: LDL*), in a fill-reducing
//! order (approximate minimum degree, Amestoy, Davis and Duff 1996; crate `amd`).
//!
//! The order and the pattern of L are found once; every factorisation is numbers only, without allocation. The same code
//! serves two links and ten thousand: a pendulum's system costs about as much as written by hand, a chain's is O(n) because
//! its order has no fill.
//!
//! Redundant rows make A singular. A pivot that rounding alone could have left ([`NOISE`]) drops its row: its multiplier is
//! 0, and the others carry it; if the right-hand side does not agree, that is a [`SolveError::Contradiction`].
//!
//! Why not a crate for the factorisation too: those at hand fail on a singular A or do not tell which rows are redundant,
//! and are 2 to 800 times slower on small systems. Supernodal ones win from about 20000 rows on, by 2 to 3.

use super::normal::{self, Normal};
use super::redundant::Apart;
use super::rows::narrow;
use super::{InverseMass, Rows, SolveError, Solved};
use alloc::vec;
use alloc::vec::Vec;

/// A pivot that is left with less than this of its diagonal has lost as much precision, because the entries of A are
/// rounded sums: a light particle between heavy ones. Refining with `J W J^T lambda` factor by factor, where nothing is
/// summed beforehand, brings it back. Without, ten digits remain, more than the steps of any integrator leave.
const LOSS_TO_REFINE: f64 = 1e-6;

/// What rounding can make of a pivot: `d_k = v . A v` for the v of [`Direct::noise`], and every entry of A is off by its own
/// roundings, a sum of D products and one subtraction for each elimination, some `4 eps sqrt(a_ii a_jj)` at random; twice
/// that. A row whose pivot is less is taken for redundant: nobody could tell.
pub(super) const NOISE: f64 = 8.0 * f64::EPSILON;

/// Pivots over this part of their diagonal are not examined; no v of practical size makes noise of that. More where there
/// is more than rounding.
const SUSPECT: f64 = 1e-6;

/// Each refinement gains the digits that the factor has. With three, 5 digits are enough for all 16.
const MAX_REFINEMENTS: u32 = 3;

/// A dropped row contradicts the others when it is off by more than half the digits: consistent right-hand sides leave
/// rounding there, contradicting ones leave their difference.
const CONTRADICTION: f64 = 1.5e-8; // sqrt(f64::EPSILON)

/// The direct solver of a fixed pattern of rows.
#[derive(Clone, Debug)]
pub struct Direct<const D: usize> {
    pub(super) normal: Normal<D>,
    /// L by columns, without its unit diagonal; rows ascending.
    pub(super) column_starts: Vec<u32>,
    pub(super) row: Vec<u32>,
    pub(super) factor: Vec<f64>,
    /// The pattern of L by rows, ascending.
    row_starts: Vec<u32>,
    column: Vec<u32>,
    /// 1 / d, 0 for a dropped row.
    pub(super) inv_pivot: Vec<f64>,
    pub(super) redundant: Vec<u32>,
    /// The smallest `d_k / a_kk` that was kept.
    pub(super) weakest: f64,
    /// What is kept of a pivot must be more than this; see [`Direct::noise`].
    pub(super) noise: f64,
    /// How far gradients may be off, and in which measure.
    pub(super) apart: Apart<D>,
    /// Room for the dependences of redundant rows.
    pub(super) shares: Vec<f64>,
    filled: Vec<u32>,
    work: Vec<f64>,
    residual: Vec<f64>,
    correction: Vec<f64>,
    room: Vec<[f64; D]>,
}

/// A fill-reducing order of the rows.
fn fill_reducing(pattern: &[Vec<usize>]) -> Vec<u32> {
    let mut starts = vec![0_i64];
    let mut rows = Vec::new();
    let wide = |index: usize| i64::from(narrow(index));
    for column in pattern {
        rows.extend(column.iter().map(|row| wide(*row)));
        starts.push(wide(rows.len()));
    }
    let natural = || (0..pattern.len()).map(narrow).collect();
    // It refuses malformed patterns only, and any order is right.
    let Ok((order, ..)) = amd::order(wide(pattern.len()), &starts, &rows, &amd::Control::default()) else {
        return natural();
    };
    order.iter().filter_map(|row| u32::try_from(*row).ok()).collect()
}

impl<const D: usize> Direct<D> {
    /// Finds the order and the pattern for these rows. A block that is fixed now must stay so, or a new one be made.
    #[must_use]
    pub fn new(rows: &Rows<D>, inverse_mass: &(impl InverseMass<D> + ?Sized)) -> Self {
        let order = fill_reducing(&normal::pattern(rows, inverse_mass));
        let normal = Normal::new(rows, inverse_mass, order);
        let n = rows.len();
        let (row_starts, column) = fill(&normal);
        let mut column_starts = vec![0; n + 1];
        for j in &column {
            column_starts[*j as usize + 1] += 1;
        }
        for j in 0..n {
            column_starts[j + 1] += column_starts[j];
        }
        let (mut filled, mut row) = (column_starts[..n].to_vec(), vec![0; column.len()]);
        for k in 0..n {
            for j in &column[row_starts[k] as usize..row_starts[k + 1] as usize] {
                let next = &mut filled[*j as usize];
                row[*next as usize] = narrow(k);
                *next += 1;
            }
        }
        Self {
            normal,
            column_starts,
            factor: vec![0.0; row.len()],
            row,
            row_starts,
            column,
            inv_pivot: vec![1.0; n],
            redundant: Vec::with_capacity(n),
            weakest: 1.0,
            noise: NOISE,
            apart: Apart::default(),
            shares: Vec::new(),
            filled,
            work: vec![0.0; n],
            residual: vec![0.0; n],
            correction: vec![0.0; n],
            room: vec![[0.0; D]; rows.blocks()],
        }
    }

    /// How many numbers L has.
    #[must_use]
    pub fn fill(&self) -> usize {
        self.factor.len()
    }

    /// The rows that the last factorisation found to be combinations of others (or without any moving block).
    #[must_use]
    pub fn redundant(&self) -> &[u32] {
        &self.redundant
    }

    /// How many rows are independent.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.inv_pivot.len() - self.redundant.len()
    }

    /// Factors A at the present gradients.
    ///
    /// # Errors
    /// A gradient or mass that is not finite.
    pub fn prepare(&mut self, rows: &Rows<D>, inverse_mass: &(impl InverseMass<D> + ?Sized)) -> Result<(), SolveError> {
        self.inv_pivot.fill(1.0);
        if self.look_apart(rows)? {
            return self.prepare_alike(rows, inverse_mass);
        }
        self.prepare_alike(rows, inverse_mass)?;
        if self.exchange() { self.prepare_alike(rows, inverse_mass) } else { Ok(()) }
    }

    /// The same at gradients near the last ones, dropping what was dropped there too. Rows that depend on each other
    /// *because* they hold, as those of a spatial linkage, do so up to the square of the violation: off the constraints by
    /// more than half the digits they would pass for independent, and what they ask for then would be arbitrary.
    ///
    /// # Errors
    /// A gradient or mass that is not finite.
    pub fn prepare_alike(
        &mut self,
        rows: &Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
    ) -> Result<(), SolveError> {
        self.normal.fill(rows, inverse_mass);
        self.redundant.clear();
        self.weakest = 1.0;
        let suspect = SUSPECT * (self.noise / NOISE);
        let n = self.inv_pivot.len();
        self.filled.copy_from_slice(&self.column_starts[..n]);
        for k in 0..n {
            let (pivot, diagonal) = self.eliminate(k);
            if !pivot.is_finite() {
                self.work.fill(0.0);
                return Err(SolveError::NotFinite { row: self.normal.order[k] as usize });
            }
            let dropped = self.inv_pivot[k] == 0.0;
            if dropped || (pivot <= suspect * diagonal && pivot <= self.noise(k, diagonal)) {
                self.inv_pivot[k] = 0.0;
                self.redundant.push(self.normal.order[k]);
            } else {
                self.inv_pivot[k] = 1.0 / pivot;
                self.weakest = self.weakest.min(pivot / diagonal);
            }
        }
        Ok(())
    }

    /// Row k of L, and its pivot: solves `L D l = a` for the part of A's row left of the diagonal.
    #[inline]
    fn eliminate(&mut self, k: usize) -> (f64, f64) {
        let (columns, values) = self.normal.row(k);
        for (column, value) in columns.iter().zip(values) {
            self.work[*column as usize] = *value;
        }
        let diagonal = core::mem::take(&mut self.work[k]);
        let mut pivot = diagonal;
        for j in &self.column[self.row_starts[k] as usize..self.row_starts[k + 1] as usize] {
            let j = *j as usize;
            let y = core::mem::take(&mut self.work[j]);
            let done = self.column_starts[j] as usize..self.filled[j] as usize;
            self.filled[j] += 1;
            let end = done.end;
            for (row, l) in self.row[done.clone()].iter().zip(&self.factor[done]) {
                self.work[*row as usize] -= l * y;
            }
            let l = y * self.inv_pivot[j];
            pivot -= l * y;
            self.factor[end] = l;
        }
        (pivot, diagonal)
    }

    /// What rounding can make of pivot k, on average: `v_k = 1` and `L^T v = 0` before, so that `d_k = v . A v`.
    fn noise(&mut self, k: usize, diagonal: f64) -> f64 {
        let before = self.row_starts[k] as usize..self.row_starts[k + 1] as usize;
        self.work[k] = 1.0;
        let mut sum = diagonal;
        for j in self.column[before.clone()].iter().rev() {
            let j = *j as usize;
            let known = self.column_starts[j] as usize..self.filled[j] as usize;
            let terms = self.row[known.clone()].iter().zip(&self.factor[known]);
            let v: f64 = terms.map(|(row, l)| l * self.work[*row as usize]).sum();
            self.work[j] = -v;
            sum += v * v * self.normal.row(j).1.last().copied().unwrap_or(0.0);
        }
        self.work[k] = 0.0;
        for j in &self.column[before] {
            self.work[*j as usize] = 0.0;
        }
        self.noise * sum
    }

    /// `x = A^-1 b` by the factor, with 0 for dropped rows.
    fn substitute(&mut self, b: &[f64], x: &mut [f64]) {
        let Self { work, factor, row, .. } = self;
        for (work, row) in work.iter_mut().zip(&self.normal.order) {
            *work = b[*row as usize];
        }
        for (k, window) in self.column_starts.windows(2).enumerate() {
            let (z, entries) = (work[k], window[0] as usize..window[1] as usize);
            for (row, l) in row[entries.clone()].iter().zip(&factor[entries]) {
                work[*row as usize] -= l * z;
            }
        }
        for (k, window) in self.column_starts.windows(2).enumerate().rev() {
            let entries = window[0] as usize..window[1] as usize;
            let below = row[entries.clone()].iter().zip(&factor[entries]);
            let sum: f64 = below.map(|(row, l)| l * work[*row as usize]).sum();
            // A dropped row has no column in L, only a multiplier of 0.
            work[k] = work[k] * self.inv_pivot[k] - sum;
        }
        for (work, row) in work.iter_mut().zip(&self.normal.order) {
            x[*row as usize] = core::mem::take(work);
        }
    }

    /// `b - A x`, without the assembled A.
    fn leave(&mut self, rows: &Rows<D>, inverse_mass: &(impl InverseMass<D> + ?Sized), b: &[f64], x: &[f64]) {
        rows.normal_times(inverse_mass, x, &mut self.room, &mut self.residual);
        for (residual, b) in self.residual.iter_mut().zip(b) {
            *residual = b - *residual;
        }
    }

    /// Solves `A lambda = b` with the rows that were prepared; they must not have changed since.
    ///
    /// # Errors
    /// Rows that contradict each other; a right-hand side that is not finite.
    pub fn solve(
        &mut self,
        rows: &Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        b: &[f64],
        lambda: &mut [f64],
    ) -> Result<Solved, SolveError> {
        let refinements = self.solve_leaving(rows, inverse_mass, b, lambda)?;
        if !self.redundant.is_empty() {
            self.leave(rows, inverse_mass, b, lambda);
            self.agree(b, lambda)?;
        }
        Ok(Solved { converged: true, iterations: refinements })
    }

    /// `A lambda = b` to the digits that the factor has: for a step of Newton's method, which is checked by where it leads.
    ///
    /// # Errors
    /// A right-hand side that is not finite.
    pub(super) fn solve_roughly(&mut self, b: &[f64], lambda: &mut [f64]) -> Result<(), SolveError> {
        self.substitute(b, lambda);
        match lambda.iter().position(|x| !x.is_finite()) {
            Some(row) => Err(SolveError::NotFinite { row }),
            None => Ok(()),
        }
    }

    /// The same without a look at the dropped rows: whatever they ask for is left. The refinements that it took.
    pub(super) fn solve_leaving(
        &mut self,
        rows: &Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        b: &[f64],
        lambda: &mut [f64],
    ) -> Result<u32, SolveError> {
        self.solve_roughly(b, lambda)?;
        Ok(if self.weakest < LOSS_TO_REFINE { self.refine(rows, inverse_mass, b, lambda) } else { 0 })
    }

    /// As long as the corrections shrink and are more than rounding.
    fn refine(
        &mut self,
        rows: &Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        b: &[f64],
        lambda: &mut [f64],
    ) -> u32 {
        let largest = |x: &[f64]| x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let mut last = largest(lambda);
        for refinement in 0..MAX_REFINEMENTS {
            self.leave(rows, inverse_mass, b, lambda);
            let (residual, mut correction) =
                (core::mem::take(&mut self.residual), core::mem::take(&mut self.correction));
            self.substitute(&residual, &mut correction);
            let size = largest(&correction);
            let shrinks = size < 0.5 * last;
            if shrinks {
                lambda.iter_mut().zip(&correction).for_each(|(lambda, correction)| *lambda += correction);
            }
            (self.residual, self.correction) = (residual, correction);
            if !shrinks || size <= f64::EPSILON * largest(lambda) {
                return refinement + 1;
            }
            last = size;
        }
        MAX_REFINEMENTS
    }

    /// Whether the dropped rows hold too. In units in which A has a unit diagonal, so that rows of different kinds compare.
    fn agree(&self, b: &[f64], lambda: &[f64]) -> Result<(), SolveError> {
        let diagonal = |k: usize| self.normal.row(k).1.last().map_or(0.0, |value| value.sqrt());
        let (mut scale, order) = (0.0_f64, &self.normal.order);
        for (k, row) in order.iter().enumerate() {
            let (root, row) = (diagonal(k), *row as usize);
            if root > 0.0 {
                scale = scale.max(b[row].abs() / root + lambda[row].abs() * root);
            }
        }
        for (k, row) in order.iter().enumerate().filter(|(k, _)| self.inv_pivot[*k] == 0.0) {
            let row = *row as usize;
            if self.residual[row].abs() > CONTRADICTION * scale * diagonal(k) {
                return Err(SolveError::Contradiction { row, excess: self.residual[row] });
            }
        }
        Ok(())
    }
}

/// The pattern of L by rows: from every entry of A's row up the elimination tree (Davis 2005, figure 1).
fn fill<const D: usize>(normal: &Normal<D>) -> (Vec<u32>, Vec<u32>) {
    let n = normal.order.len();
    let (mut parent, mut seen) = (vec![usize::MAX; n], vec![usize::MAX; n]);
    let (mut starts, mut column) = (vec![0], Vec::new());
    for k in 0..n {
        seen[k] = k;
        let first = column.len();
        for j in normal.row(k).0 {
            let mut j = *j as usize;
            while seen[j] != k {
                seen[j] = k;
                column.push(narrow(j));
                if parent[j] == usize::MAX {
                    parent[j] = k;
                }
                j = parent[j];
            }
        }
        column[first..].sort_unstable();
        starts.push(narrow(column.len()));
    }
    (starts, column)
}

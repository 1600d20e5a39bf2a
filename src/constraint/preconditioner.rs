//! What makes conjugate gradients take fewer iterations: `M^-1 r` with M near A.
//!
//! * the diagonal of A;
//! * incomplete `L D L^T` without fill (Meijerink and van der Vorst 1977): L has A's pattern. What it leaves out depends on
//!   the order; that of Cuthill and McKee (1969), breadth first over the blocks, reversed, leaves out nothing for chains
//!   and trees, so that one iteration solves, and does well on nets. A random order takes up to ten times the iterations.
//!
//! An incomplete pivot may break down although A is positive. One that lost nearly all of its diagonal is replaced by the
//! diagonal: M stays positive definite, whatever A is.

use super::normal::{Normal, meetings};
use super::rows::narrow;
use super::{InverseMass, Rows, SolveError};
use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;

/// Pivots below this part of their diagonal are replaced. Redundant rows leave rounding, which must not be divided by;
/// in between it matters little, as the preconditioner changes the speed and not the result.
const BREAKDOWN: f64 = 1e-8;

#[derive(Clone, Debug)]
pub(super) enum Preconditioner<const D: usize> {
    Diagonal,
    Incomplete(Box<Incomplete<D>>),
}

impl<const D: usize> Preconditioner<D> {
    pub(super) fn prepare(
        &mut self,
        rows: &Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
    ) -> Result<(), SolveError> {
        match self {
            Self::Diagonal => Ok(()),
            Self::Incomplete(incomplete) => incomplete.factor(rows, inverse_mass),
        }
    }

    /// `z = M^-1 r`.
    pub(super) fn apply(&mut self, diagonal: &[f64], r: &[f64], z: &mut [f64]) {
        match self {
            // A row that nothing moves has no multiplier.
            Self::Diagonal => z
                .iter_mut()
                .zip(r)
                .zip(diagonal)
                .for_each(|((z, r), diagonal)| *z = if *diagonal == 0.0 { 0.0 } else { r / diagonal }),
            Self::Incomplete(incomplete) => incomplete.apply(r, z),
        }
    }
}

/// `L D L^T` on the pattern of A.
#[derive(Clone, Debug)]
pub(super) struct Incomplete<const D: usize> {
    normal: Normal<D>,
    /// L by rows, at the places of A's entries.
    factor: Vec<f64>,
    inv_pivot: Vec<f64>,
    work: Vec<f64>,
    /// The vector in the order of the factor.
    ordered: Vec<f64>,
}

impl<const D: usize> Incomplete<D> {
    pub(super) fn new(rows: &Rows<D>, inverse_mass: &(impl InverseMass<D> + ?Sized)) -> Self {
        let n = rows.len();
        let normal = Normal::new(rows, inverse_mass, outermost_first(rows, inverse_mass));
        Self {
            factor: vec![0.0; normal.value.len()],
            normal,
            inv_pivot: vec![0.0; n],
            work: vec![0.0; n],
            ordered: vec![0.0; n],
        }
    }

    fn factor(&mut self, rows: &Rows<D>, inverse_mass: &(impl InverseMass<D> + ?Sized)) -> Result<(), SolveError> {
        self.normal.fill(rows, inverse_mass);
        let Self { normal, factor, inv_pivot, work, .. } = self;
        for k in 0..inv_pivot.len() {
            let entries = normal.starts[k] as usize..normal.starts[k + 1] as usize;
            let (diagonal_at, mut pivot) = (entries.end - 1, normal.value[entries.end - 1]);
            let diagonal = pivot;
            // `work` holds `d_j l_kj` of the columns done, 0 elsewhere.
            for at in entries.start..diagonal_at {
                let j = normal.column[at] as usize;
                let of_j = normal.starts[j] as usize..normal.starts[j + 1] as usize - 1;
                let known = normal.column[of_j.clone()].iter().zip(&factor[of_j]);
                let y = normal.value[at] - known.map(|(m, l)| l * work[*m as usize]).sum::<f64>();
                work[j] = y;
                factor[at] = y * inv_pivot[j];
                pivot -= y * factor[at];
            }
            for at in entries.start..diagonal_at {
                work[normal.column[at] as usize] = 0.0;
            }
            if !pivot.is_finite() {
                work.fill(0.0);
                return Err(SolveError::NotFinite { row: normal.order[k] as usize });
            }
            let kept = if pivot > BREAKDOWN * diagonal { pivot } else { diagonal };
            inv_pivot[k] = if kept == 0.0 { 0.0 } else { 1.0 / kept };
        }
        Ok(())
    }

    fn apply(&mut self, r: &[f64], out: &mut [f64]) {
        let Self { normal, factor, inv_pivot, ordered: z, .. } = self;
        for k in 0..z.len() {
            let left = normal.starts[k] as usize..normal.starts[k + 1] as usize - 1;
            let known = normal.column[left.clone()].iter().zip(&factor[left]);
            z[k] = r[normal.order[k] as usize] - known.map(|(j, l)| l * z[*j as usize]).sum::<f64>();
        }
        for (z, inv_pivot) in z.iter_mut().zip(inv_pivot) {
            *z *= *inv_pivot;
        }
        for k in (0..z.len()).rev() {
            let left = normal.starts[k] as usize..normal.starts[k + 1] as usize - 1;
            let x = z[k];
            out[normal.order[k] as usize] = x;
            for (j, l) in normal.column[left.clone()].iter().zip(&factor[left]) {
                z[*j as usize] -= l * x;
            }
        }
    }
}

/// Rows by how far their moving blocks are from where a search breadth first began, the farthest first. It begins at a
/// block of few rows: the end of a chain, the corner of a net. Fixed blocks couple nothing: they are not passed through.
fn outermost_first<const D: usize>(rows: &Rows<D>, inverse_mass: &(impl InverseMass<D> + ?Sized)) -> Vec<u32> {
    let at_block = meetings(rows, inverse_mass);
    let mut place = vec![usize::MAX; rows.blocks()];
    let mut starts: Vec<usize> = (0..rows.blocks()).collect();
    starts.sort_by_key(|block| at_block[*block].len());
    let mut queue = Vec::with_capacity(rows.blocks());
    for start in starts {
        if place[start] != usize::MAX {
            continue;
        }
        let mut next = queue.len();
        place[start] = next;
        queue.push(start);
        while let Some(block) = queue.get(next).copied() {
            next += 1;
            let near = at_block[block].iter().flat_map(|(row, _)| rows.entries(*row)).map(|entry| rows.block_of(entry));
            for other in near {
                if place[other] == usize::MAX && !inverse_mass.is_fixed(other) {
                    place[other] = queue.len();
                    queue.push(other);
                }
            }
        }
    }
    let places = |row: u32| {
        let moving = rows.entries(row as usize).map(|entry| rows.block_of(entry));
        let places = moving.filter(|block| !inverse_mass.is_fixed(*block)).map(|block| place[block]);
        places.fold((usize::MAX, 0), |(least, most), place| (least.min(place), most.max(place)))
    };
    let mut order: Vec<u32> = (0..rows.len()).map(narrow).collect();
    order.sort_by_key(|row| core::cmp::Reverse(places(*row)));
    order
}

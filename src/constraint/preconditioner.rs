//! What makes conjugate gradients take fewer iterations: `M^-1 r` with M near A.
//!
//! * the diagonal of A;
//! * incomplete `L D L^T` without fill (Meijerink and van der Vorst 1977): L has A's pattern, in the order of the rows. For
//!   a chain or tree numbered from its ends nothing is left out, and one iteration solves.
//!
//! An incomplete pivot may break down although A is positive. One that lost nearly all of its diagonal is replaced by the
//! diagonal: M stays positive definite, whatever A is.

use super::gradients::inverse_diagonal;
use super::normal::Normal;
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
    Diagonal(Vec<f64>),
    Incomplete(Box<Incomplete<D>>),
}

impl<const D: usize> Preconditioner<D> {
    pub(super) fn prepare(
        &mut self,
        rows: &Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
    ) -> Result<(), SolveError> {
        let inverse = match self {
            Self::Diagonal(inverse) => {
                inverse_diagonal(rows, inverse_mass, inverse);
                inverse
            }
            Self::Incomplete(incomplete) => {
                incomplete.factor(rows, inverse_mass);
                &mut incomplete.inv_pivot
            }
        };
        inverse.iter().position(|x| !x.is_finite()).map_or(Ok(()), |row| Err(SolveError::NotFinite { row }))
    }

    pub(super) fn apply(&self, r: &[f64], z: &mut [f64]) {
        match self {
            Self::Diagonal(inverse) => z.iter_mut().zip(r).zip(inverse).for_each(|((z, r), inverse)| *z = r * inverse),
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
}

impl<const D: usize> Incomplete<D> {
    pub(super) fn new(rows: &Rows<D>, inverse_mass: &(impl InverseMass<D> + ?Sized)) -> Self {
        let n = rows.len();
        let normal = Normal::new(rows, inverse_mass, (0..n).map(narrow).collect());
        Self { factor: vec![0.0; normal.value.len()], normal, inv_pivot: vec![0.0; n], work: vec![0.0; n] }
    }

    fn factor(&mut self, rows: &Rows<D>, inverse_mass: &(impl InverseMass<D> + ?Sized)) {
        self.normal.fill(rows, inverse_mass);
        let Self { normal, factor, inv_pivot, work } = self;
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
            let kept = if pivot > BREAKDOWN * diagonal { pivot } else { diagonal };
            inv_pivot[k] = if kept == 0.0 { 0.0 } else { 1.0 / kept };
        }
    }

    fn apply(&self, r: &[f64], z: &mut [f64]) {
        let Self { normal, factor, inv_pivot, .. } = self;
        for k in 0..z.len() {
            let left = normal.starts[k] as usize..normal.starts[k + 1] as usize - 1;
            let known = normal.column[left.clone()].iter().zip(&factor[left]);
            z[k] = r[k] - known.map(|(j, l)| l * z[*j as usize]).sum::<f64>();
        }
        for (z, inv_pivot) in z.iter_mut().zip(inv_pivot) {
            *z *= inv_pivot;
        }
        for k in (0..z.len()).rev() {
            let left = normal.starts[k] as usize..normal.starts[k + 1] as usize - 1;
            let x = z[k];
            for (j, l) in normal.column[left.clone()].iter().zip(&factor[left]) {
                z[*j as usize] -= l * x;
            }
        }
    }
}

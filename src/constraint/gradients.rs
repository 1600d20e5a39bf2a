//! `J W J^T lambda = b` by preconditioned conjugate gradients (Hestenes and Stiefel 1952), without forming A for the
//! products. The report's solver (section 2.1.2, after Numerical Recipes).
//!
//! Starts from the multipliers it is given: the last ones. Stops where `|b - A lambda| <= max(relative |b|, absolute)`, in
//! the Euclidean norm, checked against the residual itself: the recurrence for it drifts from the truth by rounding.
//!
//! Redundant rows make A singular. The iterates stay in the range of A plus the start, where it is regular, so consistent
//! systems are solved as well as others; contradicting ones do not converge, which is said.

use super::direct::NOISE;
use super::preconditioner::{Incomplete, Preconditioner};
use super::rows::dot;
use super::{InverseMass, Rows, SolveError, Solved};
use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;

/// When conjugate gradients stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Residual over right-hand side.
    pub relative: f64,
    /// Residual, in the unit of the right-hand side. For rows of different units choose 0.
    pub absolute: f64,
    /// Products with A.
    pub max_iterations: u32,
}

impl Stop {
    /// Down to the rounding of a right-hand side of n rows, with two digits to spare for what the recurrence loses. In
    /// exact arithmetic n iterations are enough; rounding delays them on ill-conditioned systems, by this factor.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a count")]
    pub fn tight(rows: usize) -> Self {
        let max_iterations = u32::try_from(rows).unwrap_or(u32::MAX).saturating_mul(4).saturating_add(16);
        Self { relative: 100.0 * f64::EPSILON * (rows as f64).sqrt(), absolute: 0.0, max_iterations }
    }
}

/// A residual that the recurrence calls small but is not is started from anew; each time gains the digits that were lost.
const MAX_RESTARTS: u32 = 4;

/// Conjugate gradients for a fixed pattern of rows.
#[derive(Clone, Debug)]
pub struct ConjugateGradients<const D: usize> {
    /// When to stop.
    pub stop: Stop,
    preconditioner: Preconditioner<D>,
    diagonal: Vec<f64>,
    residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    preconditioned: Vec<f64>,
    room: Vec<[f64; D]>,
}

impl<const D: usize> ConjugateGradients<D> {
    fn with(rows: &Rows<D>, stop: Stop, preconditioner: Preconditioner<D>) -> Self {
        let zeros = || vec![0.0; rows.len()];
        Self {
            stop,
            preconditioner,
            diagonal: zeros(),
            residual: zeros(),
            direction: zeros(),
            image: zeros(),
            preconditioned: zeros(),
            room: vec![[0.0; D]; rows.blocks()],
        }
    }

    /// Preconditioned by the diagonal of A: the least memory.
    #[must_use]
    pub fn jacobi(rows: &Rows<D>, stop: Stop) -> Self {
        Self::with(rows, stop, Preconditioner::Diagonal)
    }

    /// Preconditioned by an incomplete factor of A: exact for chains and trees.
    #[must_use]
    pub fn incomplete(rows: &Rows<D>, inverse_mass: &(impl InverseMass<D> + ?Sized), stop: Stop) -> Self {
        Self::with(rows, stop, Preconditioner::Incomplete(Box::new(Incomplete::new(rows, inverse_mass))))
    }

    /// Makes the preconditioner at the present gradients.
    ///
    /// # Errors
    /// A gradient or mass that is not finite.
    pub fn prepare(&mut self, rows: &Rows<D>, inverse_mass: &(impl InverseMass<D> + ?Sized)) -> Result<(), SolveError> {
        diagonal(rows, inverse_mass, &mut self.diagonal)?;
        self.preconditioner.prepare(rows, inverse_mass)
    }

    /// Solves `A lambda = b`, from the `lambda` it is given.
    ///
    /// # Errors
    /// A right-hand side or start that is not finite.
    pub fn solve(
        &mut self,
        rows: &Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        b: &[f64],
        lambda: &mut [f64],
    ) -> Result<Solved, SolveError> {
        self.solve_to(self.stop, rows, inverse_mass, b, lambda)
    }

    pub(super) fn solve_to(
        &mut self,
        stop: Stop,
        rows: &Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        b: &[f64],
        lambda: &mut [f64],
    ) -> Result<Solved, SolveError> {
        let goal = (stop.relative * norm(b)).max(stop.absolute);
        let mut iterations = 0;
        for _ in 0..=MAX_RESTARTS {
            rows.normal_times(inverse_mass, lambda, &mut self.room, &mut self.image);
            for ((residual, b), image) in self.residual.iter_mut().zip(b).zip(&self.image) {
                *residual = b - image;
            }
            if let Some(row) = self.residual.iter().position(|x| !x.is_finite()) {
                return Err(SolveError::NotFinite { row });
            }
            if norm(&self.residual) <= goal {
                return Ok(Solved { converged: true, iterations });
            }
            let done = self.descend(rows, inverse_mass, lambda, goal, stop.max_iterations - iterations);
            iterations += done;
            if done == 0 || iterations >= stop.max_iterations {
                break;
            }
        }
        Ok(Solved { converged: norm(&self.residual) <= goal, iterations })
    }

    /// From the residual at hand until the recurrence says that it is small enough. The iterations made.
    fn descend(
        &mut self,
        rows: &Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        lambda: &mut [f64],
        goal: f64,
        most: u32,
    ) -> u32 {
        self.direction.fill(0.0);
        let mut last = 0.0;
        for iteration in 0..most {
            self.preconditioner.apply(&self.diagonal, &self.residual, &mut self.preconditioned);
            let descent = inner(&self.residual, &self.preconditioned);
            let beta = if iteration == 0 { 0.0 } else { descent / last };
            for (direction, fresh) in self.direction.iter_mut().zip(&self.preconditioned) {
                *direction = fresh + beta * *direction;
            }
            rows.normal_times(inverse_mass, &self.direction, &mut self.room, &mut self.image);
            let curvature = inner(&self.direction, &self.image);
            let squares = self.direction.iter().zip(&self.diagonal).map(|(p, diagonal)| p * p * diagonal);
            // A direction that A does not see: what is left of the residual is out of its range, and a step along it
            // would lead nowhere, far away.
            if !(curvature > NOISE * squares.sum::<f64>() && descent > 0.0) {
                return iteration;
            }
            let alpha = descent / curvature;
            for (lambda, direction) in lambda.iter_mut().zip(&self.direction) {
                *lambda += alpha * direction;
            }
            for (residual, image) in self.residual.iter_mut().zip(&self.image) {
                *residual -= alpha * image;
            }
            if norm(&self.residual) <= goal {
                return iteration + 1;
            }
            last = descent;
        }
        most
    }
}

fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    inner(a, a).sqrt()
}

/// The diagonal of A.
fn diagonal<const D: usize>(
    rows: &Rows<D>,
    inverse_mass: &(impl InverseMass<D> + ?Sized),
    out: &mut [f64],
) -> Result<(), SolveError> {
    for (index, out) in out.iter_mut().enumerate() {
        let row = rows.row(index);
        let entries = row.blocks.iter().zip(row.gradients);
        *out = entries.map(|(block, g)| dot(g, &inverse_mass.accelerate(*block as usize, *g))).sum();
        if !out.is_finite() {
            return Err(SolveError::NotFinite { row: index });
        }
    }
    Ok(())
}

//! A solver together with the gradients that it was prepared at: what an integrator keeps of its constraints.
//!
//! `freeze` copies the gradients and factors A there; every solution and projection goes by these until the next `freeze`.
//! The rows that the caller refills may meanwhile be elsewhere.

use super::{ConjugateGradients, Direct, InverseMass, Rows, SolveError, Solved, Stop};
use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;

/// Conjugate gradients stop a step of Newton's method here: a step with a frozen factor rarely gains more than four digits,
/// and iterations for more would solve for what the next step solves for.
const STEP_ACCURACY: f64 = 1e-4;

/// Which solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Sparse `L D L^T`.
    Direct,
    /// Conjugate gradients with an incomplete factor.
    ConjugateGradients(Stop),
}

#[derive(Clone, Debug)]
pub(super) enum Solver<const D: usize> {
    Direct(Box<Direct<D>>),
    ConjugateGradients(Box<ConjugateGradients<D>>),
}

/// The multipliers of constraints at frozen gradients.
#[derive(Clone, Debug)]
pub struct Multipliers<const D: usize> {
    pub(super) solver: Solver<D>,
    pub(super) frozen: Rows<D>,
    pub(super) valid: bool,
    pub(super) lambda: Vec<f64>,
    /// The multipliers of the last projection along frozen gradients.
    pub(super) along: Vec<f64>,
    pub(super) step: Vec<[f64; D]>,
    pub(super) total: Vec<[f64; D]>,
    speed: Vec<f64>,
}

impl<const D: usize> Multipliers<D> {
    /// For rows of this pattern. A block that is fixed now must stay so, or new multipliers be made.
    #[must_use]
    pub fn new(rows: &Rows<D>, inverse_mass: &(impl InverseMass<D> + ?Sized), method: Method) -> Self {
        let solver = match method {
            Method::Direct => Solver::Direct(Box::new(Direct::new(rows, inverse_mass))),
            Method::ConjugateGradients(stop) => {
                Solver::ConjugateGradients(Box::new(ConjugateGradients::incomplete(rows, inverse_mass, stop)))
            }
        };
        let blocks = || vec![[0.0; D]; rows.blocks()];
        let numbers = || vec![0.0; rows.len()];
        Self {
            solver,
            frozen: rows.clone(),
            valid: false,
            lambda: numbers(),
            along: numbers(),
            step: blocks(),
            total: blocks(),
            speed: numbers(),
        }
    }

    /// Says in which measure no block is lighter than others, block by block, as inverse masses: redundant rows are told
    /// apart in it where gradients may be off ([`assume_off`](Self::assume_off)). Conjugate gradients do not tell.
    pub fn measure_by(&mut self, inverse: Vec<[f64; D]>) {
        if let Solver::Direct(solver) = &mut self.solver {
            solver.measure_by(inverse);
        }
    }

    /// Says how far gradients may be off at the next `freeze`, relative to their size, because the constraints hold only so
    /// far. Rows that this alone tells apart are redundant. At first 0, rounding.
    pub fn assume_off(&mut self, relative: f64) {
        if let Solver::Direct(solver) = &mut self.solver {
            solver.assume_off(relative);
        }
    }

    /// Takes over the gradients and factors A there.
    ///
    /// # Errors
    /// A gradient or mass that is not finite.
    pub fn freeze(&mut self, rows: &Rows<D>, inverse_mass: &(impl InverseMass<D> + ?Sized)) -> Result<(), SolveError> {
        self.frozen.assign_gradients(rows);
        self.valid = false;
        match &mut self.solver {
            Solver::Direct(solver) => solver.prepare(&self.frozen, inverse_mass)?,
            Solver::ConjugateGradients(solver) => solver.prepare(&self.frozen, inverse_mass)?,
        }
        self.valid = true;
        Ok(())
    }

    /// The same, but rows that were redundant at the last ones stay so ([`Direct::prepare_alike`]): within a step, between
    /// places where the constraints hold.
    ///
    /// # Errors
    /// A gradient or mass that is not finite.
    pub fn freeze_alike(
        &mut self,
        rows: &Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
    ) -> Result<(), SolveError> {
        self.frozen.assign_gradients(rows);
        self.valid = false;
        match &mut self.solver {
            Solver::Direct(solver) => solver.prepare_alike(&self.frozen, inverse_mass)?,
            Solver::ConjugateGradients(solver) => solver.prepare(&self.frozen, inverse_mass)?,
        }
        self.valid = true;
        Ok(())
    }

    /// The rows with the gradients of the last `freeze`; their values and curvatures are older.
    #[must_use]
    pub fn frozen(&self) -> &Rows<D> {
        &self.frozen
    }

    /// The rows that the last factorisation found redundant; conjugate gradients do not find out.
    #[must_use]
    pub fn redundant(&self) -> &[u32] {
        match &self.solver {
            Solver::Direct(solver) => solver.redundant(),
            Solver::ConjugateGradients(_) => &[],
        }
    }

    /// Solves `A lambda = b` at the frozen gradients; conjugate gradients start from the `lambda` given.
    ///
    /// # Errors
    /// Rows that contradict each other; a right-hand side that is not finite.
    pub fn solve(
        &mut self,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        b: &[f64],
        lambda: &mut [f64],
    ) -> Result<Solved, SolveError> {
        match &mut self.solver {
            Solver::Direct(solver) => solver.solve(&self.frozen, inverse_mass, b, lambda),
            Solver::ConjugateGradients(solver) => solver.solve(&self.frozen, inverse_mass, b, lambda),
        }
    }

    /// The same, but what redundant rows ask for is left open: within a step, off the constraints by an error of its order,
    /// they disagree by as much. Conjugate gradients may stop short.
    ///
    /// # Errors
    /// A right-hand side that is not finite.
    pub fn solve_leaving(
        &mut self,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        b: &[f64],
        lambda: &mut [f64],
    ) -> Result<(), SolveError> {
        match &mut self.solver {
            Solver::Direct(solver) => solver.solve_leaving(&self.frozen, inverse_mass, b, lambda).map(drop),
            Solver::ConjugateGradients(solver) => solver.solve(&self.frozen, inverse_mass, b, lambda).map(drop),
        }
    }

    /// The change `-W J^T A^-1 J v` that takes velocities onto `J v = 0`, block by block; J at the frozen gradients. The
    /// smallest such change in the norm of the kinetic energy.
    ///
    /// # Errors
    /// A velocity that is not finite.
    pub fn velocity_change(
        &mut self,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        velocity: impl Fn(usize) -> [f64; D],
    ) -> Result<&[[f64; D]], SolveError> {
        let (mut speed, mut lambda) = (core::mem::take(&mut self.speed), core::mem::take(&mut self.lambda));
        self.frozen.times(velocity, &mut speed);
        lambda.fill(0.0);
        let outcome = self.solve_leaving(inverse_mass, &speed, &mut lambda);
        (self.speed, self.lambda) = (speed, lambda);
        outcome?;
        displacement(&self.frozen, inverse_mass, &self.lambda, &mut self.step);
        Ok(&self.step)
    }

    /// `step = -W J^T A^-1 b` at the frozen gradients, to a few digits: a step of Newton's method.
    pub(super) fn newton_step(
        &mut self,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        b: &[f64],
    ) -> Result<(), SolveError> {
        let Self { solver, frozen, lambda, step, .. } = self;
        match solver {
            Solver::Direct(solver) => solver.solve_roughly(b, lambda)?,
            Solver::ConjugateGradients(solver) => {
                lambda.fill(0.0);
                let stop = Stop { relative: solver.stop.relative.max(STEP_ACCURACY), ..solver.stop };
                solver.solve_to(stop, frozen, inverse_mass, b, lambda).map(drop)?;
            }
        }
        displacement(frozen, inverse_mass, lambda, step);
        Ok(())
    }
}

/// `-W J^T lambda`.
pub(super) fn displacement<const D: usize>(
    rows: &Rows<D>,
    inverse_mass: &(impl InverseMass<D> + ?Sized),
    lambda: &[f64],
    out: &mut [[f64; D]],
) {
    rows.response(inverse_mass, lambda, out);
    for out in out {
        *out = out.map(|x| -x);
    }
}

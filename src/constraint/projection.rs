//! Positions onto `C(q) = 0` by Newton's method with a factor that is kept while it serves.
//!
//! ```text
//! q <- q - W J^T (J W J^T)^-1 C(q)
//! ```
//!
//! With J of every iterate the convergence is quadratic; with J frozen at a nearby place it is linear, by a factor as small
//! as the place is near, and an iteration costs a substitution instead of a factorisation. At singular configurations (a
//! straight chain between two pins) even Newton's method halves the distance only. A step that does not bring the worst
//! violation down is cut in half, so nothing blows up.
//!
//! The violation of a row is `|C| / max |g|` over its blocks: how far a single block would have to move, in metres where
//! the coordinates are.

use super::rows::dot;
use super::{InverseMass, Multipliers, Rows, SolveError};
use thiserror::Error;

/// What has coordinates and constraints.
pub trait Configuration<const D: usize> {
    /// Fills values and gradients of the rows at the present coordinates.
    fn evaluate(&mut self, rows: &mut Rows<D>);

    /// Moves every block: `q += displacement`.
    fn displace(&mut self, displacement: &[[f64; D]]);
}

/// A projection that arrived.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projected {
    /// Evaluations of the rows.
    pub evaluations: u32,
    /// Factorisations.
    pub factorisations: u32,
    /// The worst row.
    pub violation_m: f64,
}

/// Why the positions are not on the constraints. They are where the violation was least.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum ProjectionError {
    /// No step brings the worst row down.
    #[error(
        "constraint {row} stays violated by {violation_m:e} m after {evaluations} evaluations: it contradicts others, is \
         too far off, or the step is too long"
    )]
    NotConverged {
        /// The worst row.
        row: usize,
        /// By how much.
        violation_m: f64,
        /// Evaluations of the rows.
        evaluations: u32,
    },
    /// The row is violated and says no direction: its gradient is 0, as that of a distance between coincident points.
    #[error("constraint {row} is violated and its gradient is zero: move what it constrains apart")]
    NoGradient {
        /// Which row.
        row: usize,
    },
    /// The equations have no solution.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

/// Newton's method doubles the digits and needs five iterations from anywhere near; the halving of the distance at a
/// singular configuration, which quarters the violation, needs 25 for the 15 digits from a metre.
const MAX_STEPS: u32 = 40;

/// Halvings of a step before it is given up: a thousandth of a Newton step that brings nothing down never will.
const MAX_HALVINGS: u32 = 10;

/// A factor is renewed when, at the present rate, it would take more than this many substitutions to arrive; on nets and
/// chains of any size a factorisation costs as much as two to six of them.
const PATIENCE: f64 = 3.0;

/// The worst row and its violation, m.
fn worst<const D: usize>(rows: &Rows<D>) -> Result<(usize, f64), ProjectionError> {
    let mut worst = (0, 0.0);
    for index in 0..rows.len() {
        let row = rows.row(index);
        if row.value == 0.0 {
            continue;
        }
        let steepest = row.gradients.iter().fold(0.0_f64, |most, gradient| most.max(dot(gradient, gradient)));
        if steepest == 0.0 {
            return Err(ProjectionError::NoGradient { row: index });
        }
        let violation = row.value.abs() / steepest.sqrt();
        if !violation.is_finite() {
            return Err(SolveError::NotFinite { row: index }.into());
        }
        if violation > worst.1 {
            worst = (index, violation);
        }
    }
    Ok(worst)
}

impl<const D: usize> Multipliers<D> {
    /// The worst violation of rows, m, and which row; (0, 0.0) for none.
    ///
    /// # Errors
    /// A number that is not finite, a violated row without gradient.
    pub fn worst_violation(rows: &Rows<D>) -> Result<(usize, f64), ProjectionError> {
        worst(rows)
    }

    /// Moves a configuration until every row is violated by at most `tolerance_m`. A factor of an earlier `freeze` or
    /// projection is used as long as it serves. `rows` are those of the configuration; afterwards they hold their values
    /// at its end.
    ///
    /// # Errors
    /// See [`ProjectionError`]. The configuration is then where the violation was least.
    pub fn project<C: Configuration<D>>(
        &mut self,
        rows: &mut Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        configuration: &mut C,
        tolerance_m: f64,
    ) -> Result<Projected, ProjectionError> {
        self.newton(rows, inverse_mass, configuration, tolerance_m, true)
    }

    /// The same along the gradients of the last `freeze` alone, `q - W J_frozen^T mu`: the projection within a step of
    /// SHAKE and RATTLE (Andersen 1983), whose forces act along the gradients at the start of the step. Never freezes.
    ///
    /// # Errors
    /// See [`ProjectionError`]; the step is too long when the gradients turn much within it.
    ///
    /// # Panics
    /// Without an earlier `freeze`.
    pub fn project_along_frozen<C: Configuration<D>>(
        &mut self,
        rows: &mut Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        configuration: &mut C,
        tolerance_m: f64,
    ) -> Result<Projected, ProjectionError> {
        assert!(self.valid, "no gradients are frozen: the projection along them needs a `freeze`");
        self.newton(rows, inverse_mass, configuration, tolerance_m, false)
    }

    /// How far the last projection moved every block, m.
    #[must_use]
    pub fn displacement(&self) -> &[[f64; D]] {
        &self.total
    }

    fn newton<C: Configuration<D>>(
        &mut self,
        rows: &mut Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        configuration: &mut C,
        tolerance_m: f64,
        may_freeze: bool,
    ) -> Result<Projected, ProjectionError> {
        self.total.fill([0.0; D]);
        configuration.evaluate(rows);
        let (mut evaluations, mut factorisations) = (1, 0);
        let (mut row, mut violation_m) = worst(rows)?;
        let mut stale = !self.valid;
        for _ in 0..MAX_STEPS {
            if violation_m <= tolerance_m {
                return Ok(Projected { evaluations, factorisations, violation_m });
            }
            if stale && may_freeze {
                self.freeze(rows, inverse_mass)?;
                factorisations += 1;
            }
            let fresh = stale && may_freeze;
            self.newton_step(inverse_mass, rows.values())?;
            let (tried, found) = self.descend(rows, configuration, violation_m)?;
            evaluations += tried;
            match found {
                Some(better) => {
                    stale = is_slow(violation_m, better.1, tolerance_m);
                    (row, violation_m) = better;
                }
                // With its own gradients a step must go down, if only a little. With older ones, that is why it did not.
                None if fresh || !may_freeze => break,
                None => stale = true,
            }
        }
        if violation_m <= tolerance_m {
            return Ok(Projected { evaluations, factorisations, violation_m });
        }
        Err(ProjectionError::NotConverged { row, violation_m, evaluations })
    }

    /// Takes the step at hand, or as much of it as brings the worst violation down. How many evaluations that took, and
    /// what is worst then; none if no part of the step is better, and everything is as before.
    fn descend<C: Configuration<D>>(
        &mut self,
        rows: &mut Rows<D>,
        configuration: &mut C,
        violation_m: f64,
    ) -> Result<(u32, Option<(usize, f64)>), ProjectionError> {
        configuration.displace(&self.step);
        let mut part = 1.0;
        for halving in 0..=MAX_HALVINGS {
            configuration.evaluate(rows);
            // A long step may leave the range of the numbers or hit a point without gradient: shorter ones do not.
            if let Ok(worst) = worst(rows)
                && worst.1 < violation_m
            {
                for (total, step) in self.total.iter_mut().zip(&self.step) {
                    for (total, step) in total.iter_mut().zip(step) {
                        *total += part * step;
                    }
                }
                return Ok((halving + 1, Some(worst)));
            }
            // Back to half of it, at the end all the way.
            let back = if halving == MAX_HALVINGS { part } else { 0.5 * part };
            move_by(configuration, &mut self.step, -back);
            part -= back;
        }
        configuration.evaluate(rows);
        Ok((MAX_HALVINGS + 2, None))
    }
}

/// `q += part * step`; the step is scaled in place and back, by powers of two, exactly.
fn move_by<const D: usize, C: Configuration<D>>(configuration: &mut C, step: &mut [[f64; D]], part: f64) {
    for step in step.iter_mut() {
        *step = step.map(|x| x * part);
    }
    configuration.displace(step);
    for step in step.iter_mut() {
        *step = step.map(|x| x / part);
    }
}

/// Whether at this rate more than [`PATIENCE`] steps are to come.
fn is_slow(before: f64, after: f64, tolerance: f64) -> bool {
    after > tolerance && (tolerance / after).ln() < PATIENCE * (after / before).ln()
}

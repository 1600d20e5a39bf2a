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
//! the coordinates are. A configuration may measure it otherwise ([`Configuration::worst_violation`]).

use super::multipliers::{Solver, displacement};
use super::rows::dot;
use super::{InverseMass, Multipliers, Rows, SolveError};
use thiserror::Error;

/// What has coordinates and constraints.
pub trait Configuration<const D: usize> {
    /// After how many more substitutions, at the present rate, a projection along frozen gradients leaves them and goes on
    /// along the present ones. An integrator stays symmetric with the old ones, and others may be dearer than patience.
    const PATIENCE_ALONG: f64 = 12.0;

    /// Fills values and gradients of the rows at the present coordinates.
    fn evaluate(&mut self, rows: &mut Rows<D>);

    /// Moves every block: `q += displacement`.
    fn displace(&mut self, displacement: &[[f64; D]]);

    /// The worst row and its violation, m, where the rows were last evaluated. Where blocks also turn, `|C| / max |g|` mixes
    /// lengths with angles, and rows may have zeros that are none of the constraint: such a configuration has its own.
    ///
    /// # Errors
    /// A number that is not finite, a violated row without gradient.
    fn worst_violation(&self, rows: &Rows<D>) -> Result<(usize, f64), ProjectionError> {
        rows.worst_violation()
    }
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
/// singular configuration, which quarters the violation, needs 25 for the 15 digits from a metre. As many again for what
/// goes before along frozen gradients.
const MAX_STEPS: u32 = 60;

/// Halvings of a step before it is given up: a thousandth of a Newton step that brings nothing down never will.
const MAX_HALVINGS: u32 = 10;

/// A factor is renewed when, at the present rate, it would take more than this many substitutions to arrive; on nets and
/// chains of any size a factorisation costs as much as two to six of them.
const PATIENCE: f64 = 3.0;

impl<const D: usize> Rows<D> {
    /// The worst row and its violation, m; `(0, 0.0)` when all hold.
    ///
    /// # Errors
    /// A number that is not finite, a violated row without gradient.
    pub fn worst_violation(&self) -> Result<(usize, f64), ProjectionError> {
        let mut worst = (0, 0.0);
        for index in 0..self.len() {
            let row = self.row(index);
            if !row.value.is_finite() {
                return Err(SolveError::NotFinite { row: index }.into());
            }
            if row.value == 0.0 {
                continue;
            }
            let steepest = row.gradients.iter().fold(0.0_f64, |most, gradient| most.max(dot(gradient, gradient)));
            if steepest == 0.0 {
                return Err(ProjectionError::NoGradient { row: index });
            }
            let violation = row.value.abs() / steepest.sqrt();
            if violation > worst.1 {
                worst = (index, violation);
            }
        }
        Ok(worst)
    }
}

impl<const D: usize> Multipliers<D> {
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
        self.total.fill([0.0; D]);
        self.newton(rows, inverse_mass, configuration, tolerance_m, PATIENCE)
    }

    /// The same along the gradients of the last `freeze`, `q - W J_frozen^T mu`: the projection within a step of SHAKE and
    /// RATTLE (Andersen 1983), whose forces act along the gradients at the start of the step. `warm` is what part of the
    /// last such displacement to begin near: `(h / h_last)²` within a motion, 0 after anything else.
    ///
    /// Where the gradients turn too much within the step, or are singular, there is no such mu, or none is found in
    /// reasonable time. The way goes on along the present gradients then, and [`Projected::factorisations`] is not 0.
    ///
    /// # Errors
    /// See [`ProjectionError`].
    ///
    /// # Panics
    /// Without an earlier `freeze`.
    pub fn project_along_frozen<C: Configuration<D>>(
        &mut self,
        rows: &mut Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        configuration: &mut C,
        tolerance_m: f64,
        warm: f64,
    ) -> Result<Projected, ProjectionError> {
        assert!(self.valid, "no gradients are frozen: the projection along them needs a `freeze`");
        self.begin(inverse_mass, warm)?;
        configuration.displace(&self.total);
        self.newton(rows, inverse_mass, configuration, tolerance_m, C::PATIENCE_ALONG)
    }

    /// How far the last projection moved every block, m.
    #[must_use]
    pub fn displacement(&self) -> &[[f64; D]] {
        &self.total
    }

    /// The beginning of a projection along frozen gradients: the displacement along them that comes nearest to a part of the
    /// last one, in the norm of the kinetic energy.
    ///
    /// The last multipliers with the present gradients would be another displacement than the last: forces that balanced
    /// each other on a light block then do not quite, and fling it away.
    fn begin(&mut self, inverse_mass: &(impl InverseMass<D> + ?Sized), warm: f64) -> Result<(), SolveError> {
        if warm == 0.0 || self.along.iter().all(|mu| *mu == 0.0) {
            self.along.fill(0.0);
            self.total.fill([0.0; D]);
            return Ok(());
        }
        if let Solver::ConjugateGradients(_) = self.solver {
            // They would take as long for it as for a step, and light blocks are not for them.
            self.along.iter_mut().for_each(|mu| *mu *= warm);
            displacement(&self.frozen, inverse_mass, &self.along, &mut self.total);
            return Ok(());
        }
        let Self { frozen, total, along, .. } = self;
        frozen.times(|block| total[block].map(|x| -warm * x), along);
        let asked = core::mem::take(&mut self.along);
        let begun = self.newton_step(inverse_mass, &asked);
        self.along = asked;
        begun?;
        self.along.copy_from_slice(&self.lambda);
        self.total.copy_from_slice(&self.step);
        Ok(())
    }

    fn newton<C: Configuration<D>>(
        &mut self,
        rows: &mut Rows<D>,
        inverse_mass: &(impl InverseMass<D> + ?Sized),
        configuration: &mut C,
        tolerance_m: f64,
        patience: f64,
    ) -> Result<Projected, ProjectionError> {
        configuration.evaluate(rows);
        let (mut evaluations, mut factorisations) = (1, 0);
        let (mut row, mut violation_m) = configuration.worst_violation(rows)?;
        let (mut stale, mut anew) = (!self.valid, false);
        for _ in 0..MAX_STEPS {
            if violation_m <= tolerance_m {
                return Ok(Projected { evaluations, factorisations, violation_m });
            }
            let fresh = stale;
            if stale {
                if anew {
                    self.freeze(rows, inverse_mass)?
                } else {
                    self.freeze_alike(rows, inverse_mass)?
                }
                factorisations += 1;
            }
            self.newton_step(inverse_mass, rows.values())?;
            let (tried, found) = self.descend(rows, configuration, violation_m)?;
            evaluations += tried;
            match found {
                Some(Taken { part, row: next, violation_m: next_m }) => {
                    // Of several directions the sum is no beginning for the next step.
                    let (kept, taken) = if factorisations == 0 { (1.0, part) } else { (0.0, 0.0) };
                    self.along.iter_mut().zip(&self.lambda).for_each(|(mu, lambda)| *mu = kept * *mu + taken * lambda);
                    let patience = if factorisations == 0 { patience } else { PATIENCE };
                    stale = is_slow(violation_m, next_m, tolerance_m, patience);
                    (row, violation_m) = (next, next_m);
                }
                // With its own gradients a step must go down, if only a little. With older ones, that is why it did not; or
                // because a row that was redundant no longer is.
                None if fresh && (anew || self.redundant().is_empty()) => break,
                None => (stale, anew) = (true, fresh),
            }
        }
        if violation_m <= tolerance_m {
            return Ok(Projected { evaluations, factorisations, violation_m });
        }
        Err(ProjectionError::NotConverged { row, violation_m, evaluations })
    }

    /// Takes the step at hand, or as much of it as brings the worst violation down. How many evaluations that took, which
    /// part of the step it was, and what is worst then; none if no part is better, and everything is as before.
    fn descend<C: Configuration<D>>(
        &mut self,
        rows: &mut Rows<D>,
        configuration: &mut C,
        violation_m: f64,
    ) -> Result<(u32, Option<Taken>), ProjectionError> {
        configuration.displace(&self.step);
        let mut part = 1.0;
        for halving in 0..=MAX_HALVINGS {
            configuration.evaluate(rows);
            // A long step may leave the range of the numbers or hit a point without gradient: shorter ones do not.
            if let Ok(worst) = configuration.worst_violation(rows)
                && worst.1 < violation_m
            {
                for (total, step) in self.total.iter_mut().zip(&self.step) {
                    for (total, step) in total.iter_mut().zip(step) {
                        *total += part * step;
                    }
                }
                return Ok((halving + 1, Some(Taken { part, row: worst.0, violation_m: worst.1 })));
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

/// The part of a step that was taken, and the worst row after it.
struct Taken {
    part: f64,
    row: usize,
    violation_m: f64,
}

/// Whether at this rate more steps are to come than one has patience for.
fn is_slow(before: f64, after: f64, tolerance: f64, patience: f64) -> bool {
    after > tolerance && (tolerance / after).ln() < patience * (after / before).ln()
}

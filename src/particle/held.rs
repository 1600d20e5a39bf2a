//! The constraints of particles as rows over particles, and their multipliers.

use super::own::Scratch;
use super::system::move_by;
use super::{Constraint, LinearSolver, Particles, Setup, Solver};
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;
use crate::constraint::{Configuration, Method, Multipliers, ProjectionError, Rows, SolveError, Stop};
use alloc::vec;
use alloc::vec::Vec;

/// The coordinates of a particle.
const D: usize = 3;

/// What projection cannot get below: the rounding of coordinates, in units of eps times the largest. The difference of two
/// of them errs by one eps, the length of three such by less than two, and moving there rounds again.
const ROUNDING_EPS: f64 = 4.0;

/// Steps whose squares grow by more than this begin without the last multipliers: the error of what they promise would be
/// more than that of promising nothing.
const MAX_WARM: f64 = 4.0;

/// Rows, solver and room for them.
#[derive(Clone, Debug)]
pub(super) struct Held {
    rows: Rows<D>,
    multipliers: Option<Multipliers<D>>,
    inv_mass: Vec<f64>,
    lambda: Vec<f64>,
    right_side: Vec<f64>,
    /// The positions at which the rows were evaluated and the multipliers frozen; empty if elsewhere.
    frozen_at: Vec<Point<f64>>,
    violation_m: f64,
    /// The step of the last [`shake`](Self::shake), s; 0 for none.
    last_h_s: f64,
    redundant: usize,
    scratch: Scratch,
}

/// The positions as what a projection moves.
struct Positions<'a> {
    constraints: &'a [Constraint],
    position: &'a mut [Point<f64>],
    scratch: &'a mut Scratch,
}

impl Configuration<D> for Positions<'_> {
    fn evaluate(&mut self, rows: &mut Rows<D>) {
        evaluate(self.constraints, self.position, rows, self.scratch);
    }

    fn displace(&mut self, displacement: &[[f64; D]]) {
        for (position, by) in self.position.iter_mut().zip(displacement) {
            *position = position.moved(Vector::from(*by));
        }
    }
}

/// Values and gradients.
fn evaluate(constraints: &[Constraint], position: &[Point<f64>], rows: &mut Rows<D>, scratch: &mut Scratch) {
    for (index, constraint) in constraints.iter().enumerate() {
        let row = rows.row_mut(index);
        *row.value = constraint.value(position, scratch);
        let mut gradients = row.gradients.iter_mut();
        constraint.gradient(position, scratch, |_, gradient| {
            if let Some(slot) = gradients.next() {
                *slot = gradient.into();
            }
        });
    }
}

impl Held {
    pub(super) fn new<T: Real>(setup: &Setup<T>, start: &Particles<T>, solver: &Solver) -> Self {
        let inv_mass: Vec<f64> = setup.masses.inv_mass.iter().map(|x| x.to_f64()).collect();
        let pattern = setup.constraints.iter().map(|constraint| {
            let mut particles = Vec::new();
            constraint.for_each_particle(|particle| particles.push(particle));
            particles
        });
        let rows = Rows::new(start.len(), pattern);
        let method = match solver.linear {
            LinearSolver::Direct | LinearSolver::Sweeps => Method::Direct,
            LinearSolver::ConjugateGradients => Method::ConjugateGradients(Stop::tight(rows.len())),
        };
        let held = !rows.is_empty() && solver.linear != LinearSolver::Sweeps;
        Self {
            multipliers: held.then(|| Multipliers::new(&rows, inv_mass.as_slice(), method)),
            lambda: vec![0.0; rows.len()],
            right_side: vec![0.0; rows.len()],
            frozen_at: Vec::with_capacity(start.len()),
            violation_m: solver.violation * shortest(&setup.constraints),
            last_h_s: 0.0,
            redundant: 0,
            scratch: Scratch::default(),
            inv_mass,
            rows,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.multipliers.is_none()
    }

    pub(super) fn redundant(&self) -> usize {
        self.redundant
    }

    pub(super) fn violation_m(&self) -> f64 {
        self.violation_m
    }

    /// Evaluates the rows and factors `J W Jᵀ` at these positions, unless they were there last.
    fn freeze(&mut self, constraints: &[Constraint], position: &[Point<f64>]) -> Result<(), SolveError> {
        let Some(multipliers) = &mut self.multipliers else {
            return Ok(());
        };
        if self.frozen_at == position {
            return Ok(());
        }
        self.frozen_at.clear();
        evaluate(constraints, position, &mut self.rows, &mut self.scratch);
        multipliers.freeze(&self.rows, self.inv_mass.as_slice())?;
        self.redundant = self.redundant.max(multipliers.redundant().len());
        self.frozen_at.extend_from_slice(position);
        Ok(())
    }

    /// Adds the accelerations by constraint forces to those by forces.
    pub(super) fn constrain<T: Real>(
        &mut self,
        constraints: &[Constraint],
        state: &Particles<T>,
        acceleration: &mut [Vector<T>],
        baumgarte: f64,
    ) -> Result<(), SolveError> {
        self.freeze(constraints, &state.position)?;
        let Self { multipliers: Some(multipliers), rows, right_side, lambda, inv_mass, scratch, .. } = self else {
            return Ok(());
        };
        multipliers.frozen().times(|particle| acceleration[particle].map(Real::to_f64).into(), right_side);
        for (index, (b, constraint)) in right_side.iter_mut().zip(constraints).enumerate() {
            *b = -(*b + constraint.curvature(state, scratch));
            if baumgarte != 0.0 {
                let row = rows.row(index);
                let velocity = |block: &u32| <[f64; D]>::from(state.velocity[*block as usize].map(Real::to_f64));
                let terms = row.blocks.iter().zip(row.gradients);
                let speed: f64 =
                    terms.map(|(block, g)| velocity(block).iter().zip(g).map(|(v, g)| v * g).sum::<f64>()).sum();
                *b -= baumgarte * (2.0 * speed + baumgarte * row.value);
            }
        }
        multipliers.solve_leaving(inv_mass.as_slice(), right_side, lambda)?;
        multipliers.frozen().transposed_times(lambda, |particle, force| {
            acceleration[particle] += (Vector::from(force) * inv_mass[particle]).map(T::from_f64);
        });
        Ok(())
    }

    /// Positions onto `C = 0`, then velocities onto `dC/dt = 0`.
    pub(super) fn project<T: Real>(
        &mut self,
        constraints: &[Constraint],
        state: &mut Particles<T>,
    ) -> Result<(), ProjectionError> {
        self.project_positions(constraints, &mut state.position)?;
        Ok(self.project_velocities(constraints, state)?)
    }

    /// The same along the gradients where the positions are now: a projection that is a force, not a correction of
    /// rounding.
    pub(super) fn pull(
        &mut self,
        constraints: &[Constraint],
        position: &mut [Point<f64>],
    ) -> Result<&[[f64; D]], ProjectionError> {
        self.freeze(constraints, position)?;
        self.project_positions(constraints, position)
    }

    /// Positions onto `C = 0`; how far each moved, m.
    fn project_positions(
        &mut self,
        constraints: &[Constraint],
        position: &mut [Point<f64>],
    ) -> Result<&[[f64; D]], ProjectionError> {
        let tolerance_m = self.tolerance(position);
        self.frozen_at.clear();
        let Self { multipliers: Some(multipliers), rows, inv_mass, scratch, .. } = self else {
            return Ok(&[]);
        };
        let mut positions = Positions { constraints, position, scratch };
        multipliers.project(rows, inv_mass.as_slice(), &mut positions, tolerance_m)?;
        Ok(multipliers.displacement())
    }

    /// Velocities onto `dC/dt = 0`.
    pub(super) fn project_velocities<T: Real>(
        &mut self,
        constraints: &[Constraint],
        state: &mut Particles<T>,
    ) -> Result<(), SolveError> {
        self.freeze(constraints, &state.position)?;
        let Self { multipliers: Some(multipliers), inv_mass, .. } = self else {
            return Ok(());
        };
        let velocity = |particle: usize| state.velocity[particle].map(Real::to_f64).into();
        let changes = multipliers.velocity_change(inv_mass.as_slice(), velocity)?;
        for (velocity, change) in state.velocity.iter_mut().zip(changes) {
            *velocity += Vector::from(*change).map(T::from_f64);
        }
        Ok(())
    }

    /// `x += h v + W Jᵀ mu` with J of the start, so that `C = 0`; v is what led there. Whether such a mu was found; if not,
    /// `C = 0` was reached along later gradients.
    pub(super) fn shake<T: Real>(
        &mut self,
        constraints: &[Constraint],
        state: &mut Particles<T>,
        h_s: f64,
    ) -> Result<bool, ProjectionError> {
        self.freeze(constraints, &state.position)?;
        move_by(state, T::from_f64(h_s));
        let tolerance_m = self.tolerance(&state.position);
        let Self { multipliers: Some(multipliers), rows, inv_mass, scratch, .. } = self else {
            return Ok(true);
        };
        let mut positions = Positions { constraints, position: &mut state.position, scratch };
        // Multipliers go with the square of the step; of a very different one they tell nothing.
        let squared = (h_s / self.last_h_s).powi(2);
        let warm = if squared < MAX_WARM { squared } else { 0.0 };
        self.last_h_s = h_s;
        let projected = multipliers.project_along_frozen(rows, inv_mass.as_slice(), &mut positions, tolerance_m, warm);
        let straight = matches!(&projected, Ok(projected) if projected.factorisations == 0);
        if !straight {
            // Also after an error: the factor may be that of another place.
            self.frozen_at.clear();
        }
        projected?;
        for (velocity, moved) in state.velocity.iter_mut().zip(multipliers.displacement()) {
            *velocity += (Vector::from(*moved) / h_s).map(T::from_f64);
        }
        Ok(straight)
    }

    /// What projection is asked for, m: no less than rounding leaves.
    fn tolerance(&self, position: &[Point<f64>]) -> f64 {
        let farthest = position.iter().fold(0.0, |most: f64, p| most.max(p.x.abs()).max(p.y.abs()).max(p.z.abs()));
        self.violation_m.max(ROUNDING_EPS * f64::EPSILON * farthest)
    }
}

/// The shortest length that is held, m; 1 where none is.
fn shortest(constraints: &[Constraint]) -> f64 {
    let lengths = constraints.iter().filter_map(|constraint| match constraint {
        Constraint::Distance { length, .. } | Constraint::ToPoint { length, .. } => Some(*length),
        Constraint::On { .. } | Constraint::Own(_) => None,
    });
    lengths.reduce(f64::min).unwrap_or(1.0)
}

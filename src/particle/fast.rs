//! The fast mode: positions are predicted and then corrected onto the constraints, velocities are what led there.
//!
//! ```text
//! v += h a     x* = x + h v     x' = x* with C(x') = 0     v = (x' - x) / h
//! ```
//!
//! Of order 1, and it loses energy, but nothing makes it blow up: a net may snap taut. Two ways to correct: sweeps, link by
//! link ([`Xpbd`](super::xpbd)), or, with a multiplier solver, Newton's method on all constraints at once, which holds them
//! as exactly as is asked.

use super::system::move_by;
use super::xpbd::{Substeps, Xpbd, XpbdError};
use super::{Force, LinearSolver, MotionError, Particles, Setup, Solver, Steps, System};
use crate::algebra::Real;
use crate::algebra::g3::Vector;
use crate::ode::Leap;
use alloc::boxed::Box;

/// How positions are corrected.
#[derive(Clone, Debug)]
pub(super) enum Correction<T> {
    /// One sweep a substep.
    Sweeps(Box<Xpbd<T>>),
    /// All at once.
    Global,
}

/// What a step is made of.
#[derive(Clone, Debug)]
pub(super) struct Fast<T> {
    pub(super) correction: Correction<T>,
    pub(super) substeps: usize,
    pub(super) violation: f64,
}

impl<T: Real> Fast<T> {
    pub(super) fn new(setup: &Setup<T>, start: &Particles<T>, solver: &Solver) -> Result<Self, XpbdError> {
        let Steps::Fixed { dt_s } = solver.steps else {
            return Ok(Self { correction: Correction::Global, substeps: 1, violation: solver.violation });
        };
        if solver.linear != LinearSolver::Sweeps {
            let substeps = solver.substeps.unwrap_or(1).max(1);
            return Ok(Self { correction: Correction::Global, substeps, violation: solver.violation });
        }
        let xpbd = Box::new(Xpbd::new(start, &setup.masses.inv_mass, &setup.constraints)?);
        let gravity = uniform(&setup.forces).norm_sq().sqrt();
        let enough = || xpbd.substeps(dt_s, gravity, solver.violation);
        let substeps = solver.substeps.unwrap_or_else(enough).max(1);
        Ok(Self { correction: Correction::Sweeps(xpbd), substeps, violation: solver.violation })
    }
}

/// The sum of all uniform accelerations, m/s².
fn uniform<T: Real>(forces: &[Force<T>]) -> Vector<f64> {
    let given = forces.iter().filter_map(|force| match force {
        Force::Uniform { acceleration } => Some(acceleration.map(Real::to_f64)),
        _ => None,
    });
    given.fold(Vector::default(), |sum, g| sum + g)
}

impl<T: Real> Leap<Particles<T>> for System<T> {
    type Error = MotionError;

    fn leap(&mut self, t_s: f64, state: &mut Particles<T>, h_s: f64) -> Result<(), MotionError> {
        let Some(mut fast) = self.fast.take() else {
            move_by(state, T::from_f64(h_s));
            return Ok(());
        };
        let done = match &mut fast.correction {
            Correction::Sweeps(xpbd) => {
                let steps = Substeps { dt_s: h_s, count: fast.substeps, violation: fast.violation };
                self.sweep(xpbd, t_s, state, &steps);
                Ok(())
            }
            Correction::Global => self.correct(t_s, state, h_s, fast.substeps),
        };
        self.fast = Some(fast);
        done
    }

    /// Linear, which is of the order of the method.
    fn between(&mut self, start: &Particles<T>, end: &Particles<T>, part: f64, out: &mut Particles<T>) {
        for (index, out) in out.position.iter_mut().enumerate() {
            *out = start.position[index].moved(start.position[index].displacement_to(end.position[index]) * part);
        }
        for (index, out) in out.velocity.iter_mut().enumerate() {
            let gained = end.velocity[index] - start.velocity[index];
            *out = start.velocity[index] + gained * T::from_f64(part);
        }
    }
}

impl<T: Real> System<T> {
    fn sweep(&mut self, xpbd: &mut Xpbd<T>, t_s: f64, state: &mut Particles<T>, steps: &Substeps) {
        let Setup { masses, forces, .. } = &self.setup;
        if forces.iter().all(|force| matches!(force, Force::Uniform { .. })) {
            return xpbd.step(state, &masses.inv_mass, steps, uniform(forces));
        }
        // The closure borrows the whole system.
        let inv_mass = masses.inv_mass.clone();
        let Ok(()) = xpbd.step_with(state, &inv_mass, steps, |since_s, state, acceleration| {
            self.free(t_s + since_s, state, acceleration);
            Ok::<(), core::convert::Infallible>(())
        });
    }

    /// Newton's method on all constraints, from free flight.
    fn correct(&mut self, t_s: f64, state: &mut Particles<T>, h_s: f64, substeps: usize) -> Result<(), MotionError> {
        #[expect(clippy::cast_precision_loss, reason = "a count of substeps")]
        let part_s = h_s / substeps as f64;
        let h = T::from_f64(part_s);
        for substep in 0..substeps {
            #[expect(clippy::cast_precision_loss, reason = "a count of substeps")]
            let now_s = t_s + substep as f64 * part_s;
            let mut acceleration = core::mem::take(&mut self.acceleration);
            acceleration.resize(state.len(), Vector::default());
            self.free(now_s, state, &mut acceleration);
            for (velocity, acceleration) in state.velocity.iter_mut().zip(&acceleration) {
                *velocity += *acceleration * h;
            }
            self.acceleration = acceleration;
            move_by(state, h);
            let moved = self.held.pull(&self.setup.constraints, &mut state.position);
            let displacement = moved.map_err(|source| MotionError::Projection { time_s: now_s, source })?;
            for (velocity, moved) in state.velocity.iter_mut().zip(displacement) {
                *velocity += (Vector::from(*moved) / part_s).map(T::from_f64);
            }
        }
        Ok(())
    }
}

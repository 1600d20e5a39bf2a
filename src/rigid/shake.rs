//! The drift of RATTLE on bodies (Andersen 1983; Hairer, Lubich and Wanner, *Geometric Numerical Integration*, VII.5).
//!
//! Impulses `J^T mu` at the start, along the gradients there, such that the free motion that follows ends on the joints,
//! `C(q(h; p + J^T mu)) = 0`. A free body turns, so this is not linear in mu; Newton's method with the factor of the start
//! finds it all the same, every trial being a free motion. With kicks before and after, and velocities projected at the
//! end of a step, it is symmetric and of order 2, symplectic if the free motion is, and its compositions are of order 4
//! and 6.

use super::jointed::{Masses, evaluate, place, unprojected, worst};
use super::link::{D, Link, Pose};
use super::{Bodies, Held, Inertia};
use crate::algebra::Real;
use crate::algebra::g3::Rotor;
use crate::constraint::{Configuration, ProjectionError, Rows};
use crate::ode::State;
use alloc::vec::Vec;

/// Steps whose squares grow by more than this begin without the last multipliers, as for particles.
const MAX_WARM: f64 = 4.0;

/// The end of a free motion as what a projection moves, by impulses at its start.
struct Drift<'a, T, F> {
    links: &'a [Link],
    principal: &'a [Rotor<f64>],
    masses: &'a Masses,
    inertias: &'a [Inertia<T>],
    before: &'a Bodies<T>,
    start: &'a [Pose],
    bodies: &'a mut Bodies<T>,
    poses: &'a mut Vec<Pose>,
    /// The displacements asked for so far: h times the changes of velocity at the start.
    total: &'a mut [[f64; D]],
    h_s: f64,
    drift: F,
}

impl<T: Real, F: Fn(&mut Bodies<T>, &[Inertia<T>], f64)> Configuration<D> for Drift<'_, T, F> {
    /// The derivative at the end of a free motion is that of its start turned by as much as the bodies turn, so that Newton's
    /// method with the factor of the start gains half a digit a trial at a turn of 0.3 rad; 13 digits are asked for. Impulses
    /// along later gradients cost energy, and halves of the drift as many trials.
    const PATIENCE_ALONG: f64 = 36.0;

    fn evaluate(&mut self, rows: &mut Rows<D>) {
        self.bodies.assign(self.before);
        for (body_idx, (total, pose)) in self.total.iter().zip(self.start).enumerate() {
            self.masses.push(body_idx, self.bodies, pose, total.map(|x| x / self.h_s));
        }
        (self.drift)(self.bodies, self.inertias, self.h_s);
        place(self.bodies, self.principal, self.poses);
        evaluate(self.links, self.poses, rows);
    }

    fn displace(&mut self, displacement: &[[f64; D]]) {
        for (total, by) in self.total.iter_mut().zip(displacement) {
            for (total, by) in total.iter_mut().zip(by) {
                *total += by;
            }
        }
    }

    fn worst_violation(&self, _rows: &Rows<D>) -> Result<(usize, f64), ProjectionError> {
        worst(self.links, self.poses)
    }
}

impl<T: Real> Held<T> {
    /// Changes the momenta along the joints' gradients such that the free motion over h ends on the joints, and takes the
    /// bodies there; `drift` is the free motion of all bodies.
    ///
    /// Whether the impulses were found. If bodies turn too far in h for them, the joints are held by impulses along the
    /// gradients where the bodies arrive, which is not symmetric and changes the energy: take a smaller step.
    ///
    /// # Errors
    /// See [`ProjectionError`]. The bodies are then anywhere: go back to a copy.
    pub fn shake(
        &mut self,
        bodies: &mut Bodies<T>,
        inertias: &[Inertia<T>],
        h_s: f64,
        drift: impl Fn(&mut Bodies<T>, &[Inertia<T>], f64),
    ) -> Result<bool, ProjectionError> {
        if self.is_empty() || h_s == 0.0 {
            drift(bodies, inertias, h_s);
            return Ok(true);
        }
        self.freeze(bodies)?;
        let tolerance_m = self.tolerance_m(bodies);
        self.before.assign(bodies);
        self.start.clone_from(&self.poses);
        self.room.fill([0.0; D]);
        // Displacements go with the square of the step; of a very different one they tell nothing.
        let squared = (h_s / self.last_h_s).powi(2);
        let warm = if squared < MAX_WARM { squared } else { 0.0 };
        self.last_h_s = h_s;
        let Self { multipliers: Some(multipliers), rows, masses, links, principal, poses, start, before, room, .. } =
            self
        else {
            return Ok(true);
        };
        let (masses, total) = (&*masses, room);
        let mut end = Drift { links, principal, masses, inertias, before, start, bodies, poses, total, h_s, drift };
        let projected = multipliers.project_along_frozen(rows, masses, &mut end, tolerance_m, warm);
        let straight = matches!(&projected, Ok(projected) if projected.factorisations == 0);
        if !straight {
            // Also after an error: the factor may be that of another place.
            self.frozen_at.0.clear();
        }
        projected.map_err(|error| unprojected(&self.links, error))?;
        Ok(straight)
    }
}

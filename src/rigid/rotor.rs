//! The G(3,0) rotor formulation of rigid motion (report, equations 35 and 36, with the frames corrected):
//!
//! ```text
//! xdot = p / m     Rdot = -1/2 R Omega_body     pdot = F     Ldot = tau = r ^ F     Omega_body = I^-1 (~R L R)
//! ```
//!
//! Integrated by classical RK4; the rotor is brought back to unit norm after every step. L and p are exact where no
//! force acts.

use super::force::Motion;
use super::{Bodies, Force, Forces, Inertia, Rates};
use crate::algebra::Real;
use crate::algebra::g3::Rotor;
use crate::ode::{Rk4, RungeKutta};
use crate::versor::NotARotor;
use alloc::vec::Vec;

/// The largest turn of any body in one substep, rad. RK4 then errs by less than `(0.03/2)^5 / 120`, 6e-12 rad, a
/// substep; ten times the turn costs five digits, a tenth of it gains nothing visible before round-off.
pub const MAX_TURN_RAD: f64 = 0.03;

/// The largest change of the phase of a body's own wobble in one substep, rad. In the body frame the momentum turns at up
/// to `|L| / I_min`, which for a slender body is far above its spin; RK4 is stable to 2.8 of this, and accurate at 1 for a
/// wobble that is small.
const MAX_WOBBLE_RAD: f64 = 1.0;

/// A step that would take more substeps is refused: the body spins faster than its step can follow.
const MAX_SUBSTEPS: f64 = 1e6;

/// Why a step cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum AdvanceError {
    /// The orientation of a body is no rotor any more: its numbers overflowed.
    #[error("the orientation of body {body_idx} is lost at {time_s} s: {source}")]
    Orientation {
        /// The body.
        body_idx: usize,
        /// When.
        time_s: f64,
        /// The rotor found.
        source: NotARotor,
    },
    /// Too fast a spin for the step.
    #[error(
        "at {time_s} s body {body_idx} spins at {omega_rad_s:e} rad/s, too fast for a step of {dt_s} s: take a smaller `dt_s`"
    )]
    Spin {
        /// The body.
        body_idx: usize,
        /// When.
        time_s: f64,
        /// How fast.
        omega_rad_s: f64,
        /// The step.
        dt_s: f64,
    },
}

/// Integrates the rotor form; holds the stage storage.
#[derive(Clone, Debug)]
pub struct Integrator<T: Real> {
    rk4: RungeKutta<Rk4, Bodies<T>, T>,
    /// Indices of the forces that act in the current span.
    acting: Vec<usize>,
}

impl<T: Real> Integrator<T> {
    /// Storage for as many bodies as the state has.
    #[must_use]
    pub fn new(bodies: &Bodies<T>) -> Self {
        Self { rk4: RungeKutta::new(bodies.clone(), Rates::zeros(bodies.len())), acting: Vec::new() }
    }

    /// Advances all bodies from `time_s` by `dt_s`, in equal substeps between the times at which forces switch. Returns
    /// the number of substeps.
    ///
    /// # Errors
    /// A spin that the step cannot follow, an orientation that overflowed.
    pub fn advance(
        &mut self,
        bodies: &mut Bodies<T>,
        inertias: &[Inertia<T>],
        forces: &Forces<T>,
        time_s: f64,
        dt_s: f64,
    ) -> Result<usize, AdvanceError> {
        let mut from = time_s;
        let mut count = 0;
        let switches = forces.switches_within(time_s, time_s + dt_s);
        for to in switches.into_iter().chain([time_s + dt_s]) {
            // The last span is what is left of dt, not a difference of absolute times, which would lose its digits.
            let span = if from == time_s && to == time_s + dt_s { dt_s } else { to - from };
            count += self.advance_span(bodies, inertias, forces, from, span)?;
            from = to;
        }
        Ok(count)
    }

    fn advance_span(
        &mut self,
        bodies: &mut Bodies<T>,
        inertias: &[Inertia<T>],
        forces: &Forces<T>,
        time_s: f64,
        dt_s: f64,
    ) -> Result<usize, AdvanceError> {
        let substeps = substeps(bodies, inertias, time_s, dt_s)?;
        self.acting.clear();
        let acting = forces.forces.iter().enumerate().filter(|(_, force)| force.acts_in(time_s, time_s + dt_s));
        self.acting.extend(acting.map(|(index, _)| index));
        let h = dt_s / f64::from(substeps);
        for index in 0..substeps {
            let start = time_s + h * f64::from(index);
            let acting = &self.acting;
            let mut motion = |_: f64, state: &Bodies<T>, rates: &mut Rates<T>| {
                rhs(state, inertias, forces.gravity, acting.iter().map(|index| &forces.forces[*index]), rates);
            };
            let Ok(()) = self.rk4.step(bodies, start, h, &mut motion);
            renormalise(bodies, start + h)?;
        }
        Ok(substeps as usize)
    }
}

/// Enough substeps that no body turns by more than [`MAX_TURN_RAD`], nor wobbles by more than [`MAX_WOBBLE_RAD`], in one.
fn substeps<T: Real>(bodies: &Bodies<T>, inertias: &[Inertia<T>], time_s: f64, dt_s: f64) -> Result<u32, AdvanceError> {
    let mut most = 1.0_f64;
    for (body_idx, inertia) in inertias.iter().enumerate() {
        let omega_rad_s = bodies.omega_body(body_idx, inertia).norm_sq().sqrt().to_f64();
        // The Frobenius norm of the inverse inertia is at least 1 / I_min, and at most sqrt(3) times that.
        let inverse = inertia.inv_inertia_body.iter().flatten().map(|x| x.to_f64() * x.to_f64()).sum::<f64>().sqrt();
        let wobble_rad_s = inverse * bodies.angular_momentum[body_idx].norm_sq().to_f64().sqrt();
        let wanted = (dt_s * (omega_rad_s / MAX_TURN_RAD).max(wobble_rad_s / MAX_WOBBLE_RAD)).ceil();
        if !(wanted <= MAX_SUBSTEPS) {
            return Err(AdvanceError::Spin { body_idx, time_s, omega_rad_s, dt_s });
        }
        most = most.max(wanted);
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 1 and MAX_SUBSTEPS")]
    Ok(most as u32)
}

/// The equations of motion, for every body.
pub fn rhs<'a, T: Real>(
    bodies: &Bodies<T>,
    inertias: &[Inertia<T>],
    gravity: crate::algebra::g3::Vector<T>,
    forces: impl Iterator<Item = &'a Force<T>>,
    rates: &mut Rates<T>,
) {
    for (body_idx, inertia) in inertias.iter().enumerate() {
        let rotor = bodies.rotor[body_idx];
        let omega_body = bodies.omega_body(body_idx, inertia);
        rates.position[body_idx] = bodies.momentum[body_idx] * inertia.inv_mass;
        rates.rotor[body_idx] = (rotor * omega_body) * T::ratio(-1, 2);
        rates.momentum[body_idx] = gravity * inertia.mass;
        rates.angular_momentum[body_idx] = Default::default();
    }
    for force in forces {
        let body_idx = force.body_idx();
        let motion = Motion {
            rotor: bodies.rotor[body_idx],
            velocity: rates.position[body_idx],
            omega_world: bodies.omega_world(body_idx, &inertias[body_idx]),
        };
        let (push, torque) = force.apply(motion);
        rates.momentum[body_idx] += push;
        rates.angular_momentum[body_idx] += torque;
    }
}

/// Brings every rotor back to unit norm.
///
/// # Errors
/// A rotor whose numbers overflowed.
pub fn renormalise<T: Real>(bodies: &mut Bodies<T>, time_s: f64) -> Result<(), AdvanceError> {
    for (body_idx, rotor) in bodies.rotor.iter_mut().enumerate() {
        let lost = |source| AdvanceError::Orientation { body_idx, time_s, source };
        *rotor = Rotor::normalise((*rotor).into()).map_err(lost)?;
    }
    Ok(())
}

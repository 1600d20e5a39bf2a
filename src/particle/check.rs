//! What must hold of a setup before it can move.

use super::xpbd::XpbdError;
use super::{Constraint, Force, Particles, Setup};
use crate::algebra::Real;
use thiserror::Error;

/// What is wrong with particles, forces or constraints.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum SetupError {
    /// Constraints that cannot be swept over.
    #[error(transparent)]
    Sweeps(#[from] XpbdError),
    /// Arrays of different lengths.
    #[error(
        "{particles} positions, {velocities} velocities, {masses} masses, {inv_masses} inverse masses: give one each a particle"
    )]
    Sizes {
        /// Positions.
        particles: usize,
        /// Velocities.
        velocities: usize,
        /// Masses.
        masses: usize,
        /// Inverse masses.
        inv_masses: usize,
    },
    /// A mass that is none.
    #[error(
        "particle {particle} has the mass {mass:e} kg and the inverse mass {inv_mass:e} 1/kg: both must be finite and not \
         negative, and the inverse 0 for a fixed particle only"
    )]
    Mass {
        /// Which.
        particle: usize,
        /// kg.
        mass: f64,
        /// 1/kg.
        inv_mass: f64,
    },
    /// A position or velocity that is no number.
    #[error("the position or velocity of particle {particle} is not finite")]
    NotFinite {
        /// Which.
        particle: usize,
    },
    /// A force on a particle that does not exist.
    #[error("force {force} is on particle {particle}, but there are {particles}")]
    NoSuchParticleOfForce {
        /// Which.
        force: usize,
        /// Its particle.
        particle: usize,
        /// Their number.
        particles: usize,
    },
    /// A constraint on a particle that does not exist.
    #[error("constraint {constraint} is on particle {particle}, but there are {particles}")]
    NoSuchParticle {
        /// Which.
        constraint: usize,
        /// Its particle.
        particle: usize,
        /// Their number.
        particles: usize,
    },
    /// A distance of a particle to itself, or one that is not positive.
    #[error(
        "constraint {constraint} holds a distance of {length_m:e} m: it needs two particles, or a particle and a point, and a positive length"
    )]
    Distance {
        /// Which.
        constraint: usize,
        /// m.
        length_m: f64,
    },
}

/// Checks everything that the equations of motion take for granted.
pub(super) fn check<T: Real>(setup: &Setup<T>, start: &Particles<T>) -> Result<(), SetupError> {
    let (masses, particles) = (&setup.masses, start.position.len());
    let sizes = [start.velocity.len(), masses.mass.len(), masses.inv_mass.len()];
    if sizes != [particles; 3] {
        let [velocities, masses, inv_masses] = sizes;
        return Err(SetupError::Sizes { particles, velocities, masses, inv_masses });
    }
    for (particle, (mass, inv_mass)) in masses.mass.iter().zip(&masses.inv_mass).enumerate() {
        let (mass, inv_mass) = (mass.to_f64(), inv_mass.to_f64());
        let sound = |x: f64| x >= 0.0 && x.is_finite();
        if !(sound(mass) && sound(inv_mass)) {
            return Err(SetupError::Mass { particle, mass, inv_mass });
        }
    }
    let finite = |particle: &usize| {
        <[f64; 3]>::from(start.position[*particle]).iter().all(|x| x.is_finite())
            && <[T; 3]>::from(start.velocity[*particle]).iter().all(|x| x.is_finite())
    };
    if let Some(particle) = (0..particles).find(|particle| !finite(particle)) {
        return Err(SetupError::NotFinite { particle });
    }
    setup.forces.iter().enumerate().try_for_each(|(index, force)| check_force(index, force, particles))?;
    setup.constraints.iter().enumerate().try_for_each(|(index, held)| check_constraint(index, held, particles))
}

fn check_force<T: Real>(force: usize, what: &Force<T>, particles: usize) -> Result<(), SetupError> {
    let beyond = |named: &[usize]| named.iter().copied().find(|particle| *particle >= particles);
    let found = match what {
        Force::LinearDrag { particle, .. } | Force::QuadraticDrag { particle, .. } => beyond(particle.as_slice()),
        Force::Spring { a, b, .. } => beyond(&[*a, *b]),
        Force::Potential(own) => beyond(own.particles()),
        Force::Law(own) => beyond(own.particles()),
        Force::InverseSquare { .. } | Force::InverseSquareToPoint { .. } | Force::Uniform { .. } => None,
    };
    found.map_or(Ok(()), |particle| Err(SetupError::NoSuchParticleOfForce { force, particle, particles }))
}

fn check_constraint(constraint: usize, held: &Constraint, particles: usize) -> Result<(), SetupError> {
    let mut beyond = None;
    held.for_each_particle(|particle| beyond = beyond.or((particle >= particles).then_some(particle)));
    if let Some(particle) = beyond {
        return Err(SetupError::NoSuchParticle { constraint, particle, particles });
    }
    let (length_m, apart) = match held {
        Constraint::Distance { a, b, length } => (*length, a != b),
        Constraint::ToPoint { length, .. } => (*length, true),
        Constraint::On { .. } | Constraint::Own(_) => return Ok(()),
    };
    let sound = apart && length_m > 0.0 && length_m.is_finite();
    if sound { Ok(()) } else { Err(SetupError::Distance { constraint, length_m }) }
}

//! Energy and momenta of all particles together.

use super::own::Scratch;
use super::{Force, Masses, Particles};
use crate::algebra::Real;
use crate::algebra::g3::{Bivector, Vector};

/// Sums over everything that moves, in f64. Angular momentum is about the origin, orbital part included.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Totals {
    /// Kinetic energy, J.
    pub kinetic: f64,
    /// Potential energy, J; in uniform gravity zero at the origin.
    pub potential: f64,
    /// Momentum, kg m/s.
    pub momentum: Vector<f64>,
    /// Angular momentum about the origin, kg m²/s.
    pub angular_momentum: Bivector<f64>,
    /// Sum of |p|, the scale of momentum drift.
    pub momentum_scale: f64,
    /// Sum of |L|, the scale of angular momentum drift.
    pub angular_momentum_scale: f64,
}

impl Totals {
    /// Kinetic and potential energy, J.
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.kinetic + self.potential
    }
}

impl core::ops::AddAssign for Totals {
    fn add_assign(&mut self, other: Self) {
        self.kinetic += other.kinetic;
        self.potential += other.potential;
        self.momentum += other.momentum;
        self.angular_momentum += other.angular_momentum;
        self.momentum_scale += other.momentum_scale;
        self.angular_momentum_scale += other.angular_momentum_scale;
    }
}

/// Sums over all movable particles, and the potentials of the forces.
#[must_use]
pub fn totals<T: Real>(state: &Particles<T>, masses: &Masses<T>, forces: &[Force<T>]) -> Totals {
    let mut totals = Totals::default();
    for index in (0..state.len()).filter(|index| masses.inv_mass[*index] > T::zero()) {
        let velocity = state.velocity[index].map(Real::to_f64);
        let momentum = velocity * masses.mass[index].to_f64();
        let about_origin = state.position[index].position() ^ momentum;
        totals.kinetic += 0.5 * (momentum | velocity);
        totals.momentum += momentum;
        totals.angular_momentum += about_origin;
        totals.momentum_scale += momentum.norm_sq().sqrt();
        totals.angular_momentum_scale += about_origin.norm_sq().sqrt();
    }
    let mut scratch = Scratch::default();
    totals.potential = forces.iter().map(|force| force.energy(state, masses, &mut scratch)).sum();
    totals
}

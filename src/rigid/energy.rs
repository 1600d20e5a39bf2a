//! Energy and momenta of all bodies together.

use super::{Bodies, Forces, Inertia};
use crate::algebra::Real;
use crate::particle::Totals;

/// Sums over all movable bodies, and the potentials of gravity and springs.
#[must_use]
pub fn totals<T: Real>(bodies: &Bodies<T>, inertias: &[Inertia<T>], forces: &Forces<T>) -> Totals {
    let mut totals = Totals { potential: forces.potential(bodies, inertias), ..Totals::default() };
    for (body_idx, inertia) in inertias.iter().enumerate().filter(|(_, inertia)| !inertia.is_immovable()) {
        let momentum = bodies.momentum[body_idx].map(Real::to_f64);
        let spin = bodies.angular_momentum[body_idx].map(Real::to_f64);
        let omega = bodies.omega_world(body_idx, inertia).map(Real::to_f64);
        let about_origin = spin + (bodies.position[body_idx].position() ^ momentum);
        // The scalar product of bivectors is minus that of their components.
        let spin_energy = -(spin | omega) * 0.5;
        totals.kinetic += 0.5 * momentum.norm_sq() / inertia.mass.to_f64() + spin_energy;
        totals.momentum += momentum;
        totals.angular_momentum += about_origin;
        totals.momentum_scale += momentum.norm_sq().sqrt();
        totals.angular_momentum_scale += about_origin.norm_sq().sqrt();
    }
    totals
}

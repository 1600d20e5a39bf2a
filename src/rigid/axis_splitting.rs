//! The free motion split into rotations about the three principal axes, each exact (McLachlan 1993; Reich 1994), order 2.
//!
//! The kinetic energy is `sum L_i² / 2 I_i`; by each term alone the body turns about axis i at the constant rate `L_i / I_i`.
//! Half a step about 1 and 2, a whole one about 3, and back: symmetric, so that compositions raise its order.

use super::Inertia;
use crate::algebra::Real;
use crate::algebra::g3::{Bivector, Rotor};

/// The orientation after a time, s, of a body that nothing turns. Arithmetic in f64.
#[must_use]
pub fn turn<T: Real>(inertia: &Inertia<T>, rotor: Rotor<T>, angular_momentum: Bivector<T>, h_s: f64) -> Rotor<T> {
    let principal = &inertia.principal;
    if inertia.is_immovable() {
        return rotor;
    }
    let momentum = angular_momentum.map(Real::to_f64);
    let mut turned = rotor.map(Real::to_f64) * principal.axes;
    let halves = [(0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5)];
    for (axis, part) in halves {
        let in_body: [f64; 3] = turned.rev().apply(momentum).into();
        let mut angle = [0.0; 3];
        angle[axis] = in_body[axis] / principal.moments[axis] * (part * h_s);
        turned = turned * Rotor::exp(Bivector::from(angle) * -0.5);
    }
    let turned = turned * principal.axes.rev();
    turned.renormalise().unwrap_or(turned).map(T::from_f64)
}

//! What a contact does: the impulse with restitution (report, equation 54, corrected).
//!
//! ```text
//! j = (1 + e) n.(v_a - v_b) / (1/m_a + 1/m_b + n.(r_a . I_a^-1(r_a ^ n)) + n.(r_b . I_b^-1(r_b ^ n)))
//! ```
//!
//! n points from a to b; `+j n` acts on b, `-j n` on a; `j >= 0`. Printed with `n ^ r` the angular terms change sign and
//! the denominator can reach zero.

use super::Contact;
use crate::algebra::Real;
use crate::algebra::g3::{Bivector, Vector};
use crate::rigid::{Bodies, Inertia};
use alloc::vec::Vec;

/// An impulse that was applied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impulse<T> {
    /// Where.
    pub contact: Contact<T>,
    /// j, N s.
    pub magnitude: T,
}

/// Approach speeds below this many epsilons of the speeds at the contact are rounding: such a contact is not struck.
/// A point's velocity is a sum of six products, each off by a few roundings of terms no larger than the speeds.
const APPROACH_EPSILONS: f64 = 16.0;

/// With several contacts at once an impulse at one can make another approach. Passes over them stop after this many
/// impulses a contact; what is left then meets again at once, as an impact of its own.
const IMPULSES_PER_CONTACT: usize = 16;

/// Applies impulses, each at the contact that approaches fastest, until none approaches.
pub fn resolve<T: Real>(
    contacts: &[Contact<T>],
    bodies: &mut Bodies<T>,
    inertias: &[Inertia<T>],
    restitution: T,
) -> Vec<Impulse<T>> {
    let mut impulses: Vec<Impulse<T>> = Vec::new();
    for _ in 0..contacts.len() * IMPULSES_PER_CONTACT {
        let approaching = contacts.iter().map(|contact| (contact.approach_speed(bodies, inertias), contact));
        let fastest = approaching.reduce(|best, next| if next.0 > best.0 { next } else { best });
        let Some((speed, contact)) = fastest else { break };
        if !(speed > rounding(contact, bodies, inertias)) {
            break;
        }
        let magnitude = (T::one() + restitution) * speed / compliance(contact, bodies, inertias);
        apply(contact, contact.normal * magnitude, bodies);
        match impulses.iter_mut().find(|known| known.contact == *contact) {
            Some(known) => known.magnitude = known.magnitude + magnitude,
            None => impulses.push(Impulse { contact: *contact, magnitude }),
        }
    }
    impulses
}

/// The rounding of an approach speed.
fn rounding<T: Real>(contact: &Contact<T>, bodies: &Bodies<T>, inertias: &[Inertia<T>]) -> T {
    let speed = |body_idx: usize, arm: Vector<T>| {
        let inertia = &inertias[body_idx];
        let spin = bodies.omega_body(body_idx, inertia).norm_sq() * arm.norm_sq();
        bodies.velocity(body_idx, inertia).norm_sq().sqrt() + spin.sqrt()
    };
    T::from_f64(APPROACH_EPSILONS) * T::EPSILON * (speed(contact.a, contact.arm_a) + speed(contact.b, contact.arm_b))
}

/// The change of the relative normal velocity per unit impulse, 1/kg. Positive unless both bodies are immovable.
fn compliance<T: Real>(contact: &Contact<T>, bodies: &Bodies<T>, inertias: &[Inertia<T>]) -> T {
    let normal = contact.normal;
    let of = |body_idx: usize, arm: Vector<T>| {
        let (inertia, rotor) = (&inertias[body_idx], bodies.rotor[body_idx]);
        let moment_body: Bivector<T> = rotor.rev().apply(arm ^ normal);
        let turn = rotor.apply(inertia.velocity_of(moment_body));
        inertia.inv_mass + (normal | (arm | turn))
    };
    of(contact.a, contact.arm_a) + of(contact.b, contact.arm_b)
}

fn apply<T: Real>(contact: &Contact<T>, impulse: Vector<T>, bodies: &mut Bodies<T>) {
    bodies.momentum[contact.a] -= impulse;
    bodies.angular_momentum[contact.a] -= contact.arm_a ^ impulse;
    bodies.momentum[contact.b] += impulse;
    bodies.angular_momentum[contact.b] += contact.arm_b ^ impulse;
}

//! What contacts do: impulses with restitution (report, equation 54, corrected).
//!
//! ```text
//! j = (1 + e) n.(v_a - v_b) / (1/m_a + 1/m_b + n.(r_a . I_a^-1(r_a ^ n)) + n.(r_b . I_b^-1(r_b ^ n)))
//! ```
//!
//! n points from a to b; `+j n` acts on b, `-j n` on a; `j >= 0`. Printed with `n ^ r` the angular terms change sign and
//! the denominator can reach zero.
//!
//! Several contacts at once, the corners of a box that lands flat, are struck together: the approach speeds s become
//! `s+ <= -e s`, with `j >= 0` and one of the two an equality at each contact. This changes the energy by
//! `-(1 - e) sum(j s) / 2`, never upwards, and treats equal corners alike; impulses one after the other would not.

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

/// Impulses at some contacts can make others approach; those are struck in a further pass. What this many passes leave
/// meets again at once, as an impact of its own.
const MAX_PASSES: usize = 16;

/// Sweeps of projected Gauss-Seidel over the contacts of one pass. Each divides what is left by a factor that depends on
/// how the contacts share the load, about 2 for the four corners of a face; 200 reach rounding there with room to spare.
const MAX_SWEEPS: usize = 200;

/// Applies impulses until no contact approaches. Returns those that were not zero.
pub fn resolve<T: Real>(
    contacts: &[Contact<T>],
    bodies: &mut Bodies<T>,
    inertias: &[Inertia<T>],
    restitution: T,
) -> Vec<Impulse<T>> {
    let mut total: Vec<T> = contacts.iter().map(|_| T::zero()).collect();
    for _ in 0..MAX_PASSES {
        let struck: Vec<Struck<T>> = contacts
            .iter()
            .enumerate()
            .map(|(index, contact)| Struck {
                index,
                speed: contact.approach_speed(bodies, inertias),
                rounding: rounding(contact, bodies, inertias),
                compliance: compliance(contact, bodies, inertias),
            })
            .filter(|struck| struck.speed > struck.rounding)
            .collect();
        if struck.is_empty() {
            break;
        }
        strike_together(&struck, contacts, bodies, inertias, restitution, &mut total);
    }
    let impulses = contacts.iter().zip(total).map(|(contact, magnitude)| Impulse { contact: *contact, magnitude });
    impulses.filter(|impulse| impulse.magnitude > T::zero()).collect()
}

/// A contact that approaches.
struct Struck<T> {
    index: usize,
    /// Before the impulses of the pass.
    speed: T,
    rounding: T,
    compliance: T,
}

/// Projected Gauss-Seidel on `j >= 0`, `s+ + e s <= 0`, complementary. One contact is done in one sweep, exactly.
fn strike_together<T: Real>(
    struck: &[Struck<T>],
    contacts: &[Contact<T>],
    bodies: &mut Bodies<T>,
    inertias: &[Inertia<T>],
    restitution: T,
    total: &mut [T],
) {
    let mut magnitudes: Vec<T> = struck.iter().map(|_| T::zero()).collect();
    for sweep in 0..MAX_SWEEPS {
        let mut settled = true;
        for (one, magnitude) in struck.iter().zip(&mut magnitudes) {
            let contact = &contacts[one.index];
            let speed =
                if sweep == 0 && struck.len() == 1 { one.speed } else { contact.approach_speed(bodies, inertias) };
            let excess = speed + restitution * one.speed;
            let next = (*magnitude + excess / one.compliance).max(T::zero());
            settled &= (next - *magnitude).abs() * one.compliance <= one.rounding;
            apply(contact, contact.normal * (next - *magnitude), bodies);
            *magnitude = next;
        }
        if settled || struck.len() == 1 {
            break;
        }
    }
    for (one, magnitude) in struck.iter().zip(magnitudes) {
        total[one.index] = total[one.index] + magnitude;
    }
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

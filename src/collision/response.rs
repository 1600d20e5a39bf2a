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
//! `-(1 - e) sum(j s) / 2`, never upwards, and treats equal corners alike; impulses one after the other would not. With
//! the matrix K of the formula's denominators that is the problem `min j K j / 2 - (1 + e) s j, j >= 0`, solved exactly by
//! an active set (Lawson and Hanson 1974, chapter 23).

use super::Contact;
use crate::algebra::Real;
use crate::algebra::g3::{Bivector, Vector};
use crate::rigid::{Bodies, Inertia, Motion, MotionError};
use alloc::vec;
use alloc::vec::Vec;
use nalgebra::{DMatrix, DVector};

/// An impulse that was applied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impulse<T> {
    /// Where.
    pub contact: Contact<T>,
    /// j, N s.
    pub magnitude: T,
}

/// Impulses at some contacts can make others approach; those are struck in a further pass. What this many passes leave
/// meets again at once, as an impact of its own.
const MAX_PASSES: usize = 16;

/// Applies impulses until no contact approaches. Returns those that were not zero.
pub fn resolve<T: Real>(
    contacts: &[Contact<T>],
    bodies: &mut Bodies<T>,
    inertias: &[Inertia<T>],
    restitution: T,
) -> Vec<Impulse<T>> {
    let mut total = vec![T::zero(); contacts.len()];
    for _ in 0..MAX_PASSES {
        let approaching = |index: &usize| contacts[*index].approaches(bodies, inertias);
        let struck: Vec<usize> = (0..contacts.len()).filter(approaching).collect();
        if struck.is_empty() {
            break;
        }
        let chosen: Vec<Contact<T>> = struck.iter().map(|index| contacts[*index]).collect();
        let speeds: Vec<T> = chosen.iter().map(|contact| contact.approach_speed(bodies, inertias)).collect();
        let magnitudes = strike_together(&chosen, &speeds, bodies, inertias, restitution);
        for ((index, contact), magnitude) in struck.iter().zip(&chosen).zip(magnitudes) {
            apply(contact, contact.normal * magnitude, bodies);
            total[*index] = total[*index] + magnitude;
        }
    }
    let impulses = contacts.iter().zip(total).map(|(contact, magnitude)| Impulse { contact: *contact, magnitude });
    impulses.filter(|impulse| impulse.magnitude > T::zero()).collect()
}

/// The same where joints hold bodies: their impulses are part of the impact, so that `s+ <= -e s` holds with them.
///
/// # Errors
/// Velocities that the joints cannot take up: a state that is not finite.
pub fn resolve_jointed<T: Real>(
    contacts: &[Contact<T>],
    bodies: &mut Bodies<T>,
    motion: &mut Motion<T>,
    restitution: T,
    time_s: f64,
) -> Result<Vec<Impulse<T>>, MotionError> {
    let mut total = vec![T::zero(); contacts.len()];
    for _ in 0..MAX_PASSES {
        let approaching = |index: &usize| contacts[*index].approaches(bodies, motion.inertias());
        let struck: Vec<usize> = (0..contacts.len()).filter(approaching).collect();
        if struck.is_empty() {
            break;
        }
        let chosen: Vec<Contact<T>> = struck.iter().map(|index| contacts[*index]).collect();
        let speed = |contact: &Contact<T>| contact.approach_speed(bodies, motion.inertias());
        let wanted = chosen.iter().map(|contact| ((T::one() + restitution) * speed(contact)).to_f64());
        let wanted = DVector::from_iterator(chosen.len(), wanted);
        let rounding = chosen.iter().map(|contact| contact.speed_rounding(bodies, motion.inertias()).to_f64());
        let rounding = DVector::from_iterator(chosen.len(), rounding);
        let matrix = jointed_couplings(&chosen, bodies, motion, time_s)?;
        let magnitudes = least_impulses(&matrix, &wanted, &rounding, T::EPSILON.to_f64());
        for ((index, contact), magnitude) in struck.iter().zip(&chosen).zip(magnitudes.into_iter().map(T::from_f64)) {
            apply(contact, contact.normal * magnitude, bodies);
            total[*index] = total[*index] + magnitude;
        }
        motion.project_velocities(bodies, time_s)?;
    }
    let impulses = contacts.iter().zip(total).map(|(contact, magnitude)| Impulse { contact: *contact, magnitude });
    Ok(impulses.filter(|impulse| impulse.magnitude > T::zero()).collect())
}

/// How much a unit impulse at one contact slows the approach at another, 1/kg, with the impulses by which the joints answer:
/// found by giving it to the bodies at rest.
fn jointed_couplings<T: Real>(
    contacts: &[Contact<T>],
    bodies: &Bodies<T>,
    motion: &mut Motion<T>,
    time_s: f64,
) -> Result<DMatrix<f64>, MotionError> {
    let n = contacts.len();
    let mut matrix = DMatrix::zeros(n, n);
    for (column, from) in contacts.iter().enumerate() {
        let mut pushed = bodies.clone();
        pushed.momentum.fill(Vector::default());
        pushed.angular_momentum.fill(Bivector::default());
        apply(from, from.normal, &mut pushed);
        motion.project_velocities(&mut pushed, time_s)?;
        for (row, at) in contacts.iter().enumerate() {
            matrix[(row, column)] = -at.approach_speed(&pushed, motion.inertias()).to_f64();
        }
    }
    Ok(matrix)
}

/// The impulses of contacts that approach.
fn strike_together<T: Real>(
    contacts: &[Contact<T>],
    speeds: &[T],
    bodies: &Bodies<T>,
    inertias: &[Inertia<T>],
    restitution: T,
) -> Vec<T> {
    let responses: Vec<[Side<T>; 2]> = contacts.iter().map(|contact| Side::both(contact, bodies, inertias)).collect();
    if let ([response], [speed]) = (&responses[..], speeds) {
        return vec![(T::one() + restitution) * *speed / coupling(response, response)];
    }
    let n = contacts.len();
    let matrix = DMatrix::from_fn(n, n, |row, column| coupling(&responses[row], &responses[column]).to_f64());
    let wanted = DVector::from_fn(n, |row, _| ((T::one() + restitution) * speeds[row]).to_f64());
    let rounding = DVector::from_fn(n, |row, _| contacts[row].speed_rounding(bodies, inertias).to_f64());
    least_impulses(&matrix, &wanted, &rounding, T::EPSILON.to_f64()).into_iter().map(T::from_f64).collect()
}

/// What a unit impulse at a contact does to one of its bodies.
struct Side<T> {
    body_idx: usize,
    /// The direction of the impulse on this body.
    push: Vector<T>,
    arm: Vector<T>,
    inv_mass: T,
    /// `I^-1 (r ^ n)`.
    turn: Bivector<T>,
}

impl<T: Real> Side<T> {
    fn both(contact: &Contact<T>, bodies: &Bodies<T>, inertias: &[Inertia<T>]) -> [Self; 2] {
        let side = |body_idx: usize, arm: Vector<T>, push: Vector<T>| {
            let (inertia, rotor) = (&inertias[body_idx], bodies.rotor[body_idx]);
            let turn = rotor.apply(inertia.velocity_of(rotor.rev().apply(arm ^ push)));
            Self { body_idx, push, arm, inv_mass: inertia.inv_mass, turn }
        };
        [side(contact.a, contact.arm_a, -contact.normal), side(contact.b, contact.arm_b, contact.normal)]
    }
}

/// How much a unit impulse at one contact slows the approach at another, 1/kg.
fn coupling<T: Real>(at: &[Side<T>; 2], from: &[Side<T>; 2]) -> T {
    let mut sum = T::zero();
    for here in at {
        for there in from.iter().filter(|there| there.body_idx == here.body_idx) {
            let velocity = there.push * there.inv_mass + (here.arm | there.turn);
            sum = sum + (here.push | velocity);
        }
    }
    sum
}

/// `j >= 0` with `K j >= wanted`, an equality wherever `j > 0`: Lawson and Hanson's active set on the normal equations.
/// The active contacts are independent, so there are at most six a moving body, however many corners a face has.
///
/// A contact counts as served when it is so to within rounding: that of its speed, and that of the sum of the others'
/// effects. The set grows by one independent contact at a time and no set comes twice, so the search ends; the cap is
/// against cycling by rounding, and what it leaves is struck again.
fn least_impulses(matrix: &DMatrix<f64>, wanted: &DVector<f64>, rounding: &DVector<f64>, epsilon: f64) -> Vec<f64> {
    let n = wanted.len();
    let mut impulses = DVector::zeros(n);
    let (mut active, mut dependent): (Vec<usize>, Vec<usize>) = (vec![], vec![]);
    for _ in 0..3 * n + 3 {
        let effect = matrix * &impulses;
        let noise = |i: usize| {
            rounding[i] + epsilon * matrix.row(i).iter().zip(&impulses).map(|(k, j)| (k * j).abs()).sum::<f64>()
        };
        let lacking = |i: &usize| wanted[*i] - effect[*i] - noise(*i);
        let open = (0..n).filter(|i| !active.contains(i) && !dependent.contains(i) && lacking(i) > 0.0);
        let Some(next) = open.max_by(|x, y| lacking(x).total_cmp(&lacking(y))) else { break };
        active.push(next);
        if !equalise(matrix, wanted, epsilon, &mut active, &mut impulses) {
            active.retain(|index| *index != next);
            dependent.push(next);
        }
    }
    impulses.iter().copied().collect()
}

/// Makes the active contacts equalities, dropping those whose impulse would become negative on the way. False where the
/// newest depends on the others.
fn equalise(
    matrix: &DMatrix<f64>,
    wanted: &DVector<f64>,
    epsilon: f64,
    active: &mut Vec<usize>,
    impulses: &mut DVector<f64>,
) -> bool {
    while !active.is_empty() {
        let size = active.len();
        let block = DMatrix::from_fn(size, size, |row, column| matrix[(active[row], active[column])]);
        let Some(factor) = block.cholesky() else { return false };
        // A pivot that is rounding of the diagonal that it came from is a dependence that the factor did not notice.
        let pivot = |i: usize| factor.l_dirty()[(i, i)].powi(2) <= 4.0 * epsilon * matrix[(active[i], active[i])];
        if pivot(size - 1) {
            return false;
        }
        let solution = factor.solve(&DVector::from_fn(size, |row, _| wanted[active[row]]));
        let shares: Vec<f64> = (0..size)
            .map(|i| if solution[i] > 0.0 { 1.0 } else { impulses[active[i]] / (impulses[active[i]] - solution[i]) })
            .collect();
        let step = shares.iter().copied().fold(1.0, f64::min);
        for (i, index) in active.iter().enumerate() {
            // What stops the step is exactly zero after it: left at its rounding, it could stop the next one as well.
            let stops = solution[i] <= 0.0 && shares[i] <= step;
            impulses[*index] = if stops { 0.0 } else { impulses[*index] + step * (solution[i] - impulses[*index]) };
        }
        if step >= 1.0 {
            return true;
        }
        active.retain(|index| impulses[*index] > 0.0);
        impulses.iter_mut().for_each(|j| *j = j.max(0.0));
    }
    true
}

fn apply<T: Real>(contact: &Contact<T>, impulse: Vector<T>, bodies: &mut Bodies<T>) {
    bodies.momentum[contact.a] -= impulse;
    bodies.angular_momentum[contact.a] -= contact.arm_a ^ impulse;
    bodies.momentum[contact.b] += impulse;
    bodies.angular_momentum[contact.b] += contact.arm_b ^ impulse;
}

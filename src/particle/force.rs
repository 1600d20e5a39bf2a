//! The forces of the report's Table 2, springs, and forces of one's own.

use super::own::Scratch;
use super::{OwnForce, OwnPotential, Particles};
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;
use alloc::vec::Vec;

/// A force on particles. Fixed particles feel none.
#[derive(Clone, Debug)]
pub enum Force<T> {
    /// `F = C m1 m2 r / (r² + s²)^(3/2)` between every two particles, attractive for C > 0; `C m1 m2 / r²` without
    /// softening (Table 2, row 1). All pairs are evaluated: the cost is n².
    InverseSquare {
        /// C, m³/(kg s²).
        constant: T,
        /// Softening length s, m (Plummer 1911); 0 for none.
        softening: T,
    },
    /// `F = D m r / (r² + s²)^(3/2)` towards a point (row 2).
    InverseSquareToPoint {
        /// World.
        point: Point<f64>,
        /// D, m³/s².
        constant: T,
        /// Softening length s, m.
        softening: T,
    },
    /// `F = m g` (row 3).
    Uniform {
        /// g, m/s².
        acceleration: Vector<T>,
    },
    /// `F = -k v` (row 4), on one particle or on all.
    LinearDrag {
        /// Which; all if none is named.
        particle: Option<usize>,
        /// k, kg/s.
        k: T,
    },
    /// `F = -k |v| v` (row 5, with the misprint corrected), on one particle or on all.
    QuadraticDrag {
        /// Which; all if none is named.
        particle: Option<usize>,
        /// k, kg/m.
        k: T,
    },
    /// `F = -(k (r - l) + c rdot)` along the line of two particles.
    Spring {
        /// First particle.
        a: usize,
        /// Second particle.
        b: usize,
        /// k, N/m.
        stiffness: T,
        /// c, N s/m.
        damping: T,
        /// l, m.
        rest_length: T,
    },
    /// The negative gradient of a potential of one's own.
    Potential(OwnPotential),
    /// A law of one's own.
    Law(OwnForce),
}

/// The masses of all particles.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Masses<T> {
    /// kg. A fixed particle has one too: it attracts.
    pub mass: Vec<T>,
    /// 1 / mass; 0 for a fixed particle.
    pub inv_mass: Vec<T>,
}

impl<T: Real> Force<T> {
    /// Adds the accelerations that the force gives to all particles; those of fixed ones are of no account.
    pub(super) fn accelerate(
        &self,
        t_s: f64,
        state: &Particles<T>,
        masses: &Masses<T>,
        acceleration: &mut [Vector<T>],
        scratch: &mut Scratch,
    ) {
        let Masses { mass, inv_mass } = masses;
        match self {
            Self::InverseSquare { constant, softening } => {
                attract_all(*constant, *softening, &state.position, mass, acceleration);
            }
            Self::InverseSquareToPoint { point, constant, softening } => {
                for (a, x) in acceleration.iter_mut().zip(&state.position) {
                    *a += attraction(x.displacement_to(*point).map(T::from_f64), *softening) * *constant;
                }
            }
            Self::Uniform { acceleration: g } => acceleration.iter_mut().for_each(|a| *a += *g),
            Self::LinearDrag { particle, k } => on_each(*particle, acceleration, |index, a| {
                *a -= state.velocity[index] * (*k * inv_mass[index]);
            }),
            Self::QuadraticDrag { particle, k } => on_each(*particle, acceleration, |index, a| {
                let v = state.velocity[index];
                *a -= v * (*k * v.norm_sq().sqrt() * inv_mass[index]);
            }),
            Self::Spring { a, b, .. } => {
                let pull = self.pull(state);
                acceleration[*a] += pull * inv_mass[*a];
                acceleration[*b] -= pull * inv_mass[*b];
            }
            Self::Potential(own) => own.force(&state.position, scratch, |index, force| {
                acceleration[index] += force.map(T::from_f64) * inv_mass[index];
            }),
            Self::Law(own) => own.force(t_s, state, scratch, |index, force| {
                acceleration[index] += force.map(T::from_f64) * inv_mass[index];
            }),
        }
    }

    /// The force of a spring on its first particle. Ends at one place pull nowhere.
    fn pull(&self, state: &Particles<T>) -> Vector<T> {
        let Self::Spring { a, b, stiffness, damping, rest_length } = self else {
            return Vector::default();
        };
        let to_b = state.position[*a].displacement_to(state.position[*b]).map(T::from_f64);
        let length = to_b.norm_sq().sqrt();
        if length == T::zero() {
            return Vector::default();
        }
        let along = to_b / length;
        let speed = along | (state.velocity[*b] - state.velocity[*a]);
        along * (*stiffness * (length - *rest_length) + *damping * speed)
    }

    /// The potential energy, J; 0 where there is none. In f64.
    pub(super) fn energy(&self, state: &Particles<T>, masses: &Masses<T>, scratch: &mut Scratch) -> f64 {
        let moving = |index: &usize| masses.inv_mass[*index] > T::zero();
        let mass = |index: usize| masses.mass[index].to_f64();
        let every = || (0..state.len()).filter(moving);
        match self {
            Self::InverseSquare { constant, softening } => {
                let s = softening.to_f64();
                let pair = |a: usize, b: usize| {
                    let d_sq = state.position[a].distance_sq_to(state.position[b]);
                    mass(a) * mass(b) / (d_sq + s * s).sqrt()
                };
                let pairs = (0..state.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
                -constant.to_f64() * pairs.map(|(a, b)| pair(a, b)).sum::<f64>()
            }
            Self::InverseSquareToPoint { point, constant, softening } => {
                let s = softening.to_f64();
                let one = |index: usize| mass(index) / (state.position[index].distance_sq_to(*point) + s * s).sqrt();
                -constant.to_f64() * every().map(one).sum::<f64>()
            }
            Self::Uniform { acceleration } => {
                let g = acceleration.map(Real::to_f64);
                -every().map(|index| mass(index) * (g | state.position[index].position())).sum::<f64>()
            }
            Self::Spring { a, b, stiffness, rest_length, .. } => {
                let stretch = state.position[*a].distance_sq_to(state.position[*b]).sqrt() - rest_length.to_f64();
                0.5 * stiffness.to_f64() * stretch * stretch
            }
            Self::Potential(own) => own.energy(&state.position, scratch),
            Self::LinearDrag { .. } | Self::QuadraticDrag { .. } | Self::Law(_) => 0.0,
        }
    }
}

fn on_each<T>(particle: Option<usize>, acceleration: &mut [Vector<T>], mut act: impl FnMut(usize, &mut Vector<T>)) {
    match particle {
        Some(index) => act(index, &mut acceleration[index]),
        None => acceleration.iter_mut().enumerate().for_each(|(index, a)| act(index, a)),
    }
}

/// `r / (r² + s²)^(3/2)`.
#[inline]
fn attraction<T: Real>(to: Vector<T>, softening: T) -> Vector<T> {
    let d_sq = to.norm_sq() + softening * softening;
    to / (d_sq * d_sq.sqrt())
}

/// Every pair once: what one gains, the other loses.
fn attract_all<T: Real>(
    constant: T,
    softening: T,
    position: &[Point<f64>],
    mass: &[T],
    acceleration: &mut [Vector<T>],
) {
    for a in 1..position.len() {
        let mut gained = Vector::default();
        for b in 0..a {
            let pull = attraction(position[a].displacement_to(position[b]).map(T::from_f64), softening) * constant;
            gained += pull * mass[b];
            acceleration[b] -= pull * mass[a];
        }
        acceleration[a] += gained;
    }
}

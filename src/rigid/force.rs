//! Forces on bodies: uniform gravity, a force at a body point for a time span, linear drag.

use crate::algebra::Real;
use crate::algebra::g3::{Bivector, Vector};
use alloc::vec::Vec;

/// A force on one body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Force<T> {
    /// A constant force at a point of the body, from `start_s` (inclusive) to `end_s` (exclusive).
    AtPoint {
        /// The body.
        body_idx: usize,
        /// The point, in the body frame, m.
        at_body: Vector<T>,
        /// The force, N, world.
        force_world: Vector<T>,
        /// Start, s.
        start_s: f64,
        /// End, s.
        end_s: f64,
    },
    /// `F = -k v` and torque `-k_angular Omega`.
    LinearDrag {
        /// The body.
        body_idx: usize,
        /// k, kg/s.
        k: T,
        /// `k_angular`, N m s.
        k_angular: T,
    },
}

/// All forces of a scene.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Forces<T> {
    /// Uniform gravity, m/s².
    pub gravity: Vector<T>,
    /// The others.
    pub forces: Vec<Force<T>>,
}

/// What a force sees of its body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<T> {
    pub(super) rotor: crate::algebra::g3::Rotor<T>,
    pub(super) velocity: Vector<T>,
    pub(super) omega_world: Bivector<T>,
}

impl<T: Real> Forces<T> {
    /// The times strictly within a span at which a force starts or ends: the integrator must not step across them, or
    /// it falls to first order there.
    #[must_use]
    pub fn switches_within(&self, from_s: f64, to_s: f64) -> Vec<f64> {
        let mut times: Vec<f64> = Vec::new();
        for force in &self.forces {
            if let Force::AtPoint { start_s, end_s, .. } = force {
                times.extend([*start_s, *end_s].into_iter().filter(|time| from_s < *time && *time < to_s));
            }
        }
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }
}

impl<T: Real> Force<T> {
    /// The body that it acts on.
    #[must_use]
    pub fn body_idx(&self) -> usize {
        match self {
            Self::AtPoint { body_idx, .. } | Self::LinearDrag { body_idx, .. } => *body_idx,
        }
    }

    /// Does it act in a span that it does not switch within?
    #[must_use]
    pub fn acts_in(&self, from_s: f64, to_s: f64) -> bool {
        match self {
            Self::AtPoint { start_s, end_s, .. } => {
                let middle = from_s + (to_s - from_s) * 0.5;
                *start_s <= middle && middle < *end_s
            }
            Self::LinearDrag { .. } => true,
        }
    }

    /// Force, N, and torque `r ^ F` about the centre of mass, N m; world.
    pub(super) fn apply(&self, motion: Motion<T>) -> (Vector<T>, Bivector<T>) {
        match self {
            Self::AtPoint { at_body, force_world, .. } => {
                let arm = motion.rotor.apply(*at_body);
                (*force_world, arm ^ *force_world)
            }
            Self::LinearDrag { k, k_angular, .. } => (-motion.velocity * *k, -motion.omega_world * *k_angular),
        }
    }
}

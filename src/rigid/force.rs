//! Forces and torques on bodies: uniform gravity, a force at a body point or a torque for a time span, drag, springs
//! between points of bodies or of the world.

use super::{Formulation, Inertia, Wrenches};
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::{Bivector, Vector};
use alloc::vec::Vec;

/// A point that something is attached to: the end of a spring or joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Attachment<T> {
    /// A point of a body.
    Body {
        /// The body.
        body_idx: usize,
        /// The point, in the body frame, m.
        at_body: Vector<T>,
    },
    /// A point of the world, m.
    World(Point<f64>),
}

/// Where an attachment is: the arm from the centre of mass of its body to it, world, and its velocity.
#[derive(Clone, Copy, Debug)]
pub(super) struct End<T> {
    pub(super) arm: Vector<T>,
    pub(super) position: Point<f64>,
    pub(super) velocity: Vector<T>,
}

impl<T: Real> Attachment<T> {
    /// Its body; none for a point of the world.
    #[must_use]
    pub fn body_idx(&self) -> Option<usize> {
        match self {
            Self::Body { body_idx, .. } => Some(*body_idx),
            Self::World(_) => None,
        }
    }

    pub(super) fn end(&self, state: &impl Formulation<T>, inertias: &[Inertia<T>]) -> End<T> {
        match self {
            Self::Body { body_idx, at_body } => {
                let arm = state.to_world(*body_idx, *at_body);
                let inertia = &inertias[*body_idx];
                // v = x . Omega
                let velocity = state.velocity(*body_idx, inertia) + (arm | state.omega_world(*body_idx, inertia));
                End { arm, position: state.position(*body_idx).moved(arm.map(Real::to_f64)), velocity }
            }
            Self::World(point) => End { arm: Vector::default(), position: *point, velocity: Vector::default() },
        }
    }
}

/// A force.
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
    /// A constant torque, from `start_s` (inclusive) to `end_s` (exclusive).
    Torque {
        /// The body.
        body_idx: usize,
        /// The torque, N m, world: it turns from e2 to e3 where its component e23 is positive.
        torque_world: Bivector<T>,
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
    /// `F = -(k (r - l) + c rdot)` along the line of two points.
    Spring {
        /// The first end.
        a: Attachment<T>,
        /// The second end.
        b: Attachment<T>,
        /// k, N/m.
        stiffness: T,
        /// c, N s/m.
        damping: T,
        /// l, m.
        rest_length: T,
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

impl<T: Real> Forces<T> {
    /// The times strictly within a span at which a force starts or ends: the integrator must not step across them, or
    /// it falls to first order there.
    #[must_use]
    pub fn switches_within(&self, from_s: f64, to_s: f64) -> Vec<f64> {
        let mut times: Vec<f64> = Vec::new();
        for force in &self.forces {
            if let Force::AtPoint { start_s, end_s, .. } | Force::Torque { start_s, end_s, .. } = force {
                times.extend([*start_s, *end_s].into_iter().filter(|time| from_s < *time && *time < to_s));
            }
        }
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// What gravity and the forces listed do to every body that moves.
    pub fn wrenches(
        &self,
        acting: &[usize],
        state: &impl Formulation<T>,
        inertias: &[Inertia<T>],
        wrenches: &mut Wrenches<T>,
    ) {
        for (force, inertia) in wrenches.force.iter_mut().zip(inertias) {
            *force = self.gravity * inertia.mass;
        }
        wrenches.torque.fill(Bivector::default());
        for index in acting {
            self.forces[*index].add_to(state, inertias, wrenches);
        }
        for (body_idx, _) in inertias.iter().enumerate().filter(|(_, inertia)| inertia.is_immovable()) {
            wrenches.force[body_idx] = Vector::default();
            wrenches.torque[body_idx] = Bivector::default();
        }
    }

    /// The potential energy of gravity and springs, J; that of gravity is zero at the origin.
    #[must_use]
    pub fn potential(&self, state: &impl Formulation<T>, inertias: &[Inertia<T>]) -> f64 {
        let gravity = self.gravity.map(Real::to_f64);
        let weight = |(body_idx, inertia): (usize, &Inertia<T>)| {
            -inertia.mass.to_f64() * (gravity | state.position(body_idx).position())
        };
        let weights: f64 = inertias.iter().enumerate().map(weight).sum();
        weights + self.forces.iter().map(|force| force.potential(state, inertias)).sum::<f64>()
    }
}

impl<T: Real> Force<T> {
    /// The bodies that it acts on.
    #[must_use]
    pub fn bodies(&self) -> [Option<usize>; 2] {
        match self {
            Self::AtPoint { body_idx, .. } | Self::Torque { body_idx, .. } | Self::LinearDrag { body_idx, .. } => {
                [Some(*body_idx), None]
            }
            Self::Spring { a, b, .. } => [a.body_idx(), b.body_idx()],
        }
    }

    /// Does it act in a span that it does not switch within?
    #[must_use]
    pub fn acts_in(&self, from_s: f64, to_s: f64) -> bool {
        match self {
            Self::AtPoint { start_s, end_s, .. } | Self::Torque { start_s, end_s, .. } => {
                let middle = from_s + (to_s - from_s) * 0.5;
                *start_s <= middle && middle < *end_s
            }
            Self::LinearDrag { .. } | Self::Spring { .. } => true,
        }
    }

    /// Whether its numbers are finite. It may last forever.
    pub(super) fn is_finite(&self) -> bool {
        let all = |numbers: &[T]| numbers.iter().all(|x| x.is_finite());
        let vector = |v: Vector<T>| all(&<[T; 3]>::from(v));
        let end = |end: &Attachment<T>| match end {
            Attachment::Body { at_body, .. } => vector(*at_body),
            Attachment::World(point) => <[f64; 3]>::from(*point).iter().all(|x| x.is_finite()),
        };
        match self {
            Self::AtPoint { at_body, force_world, start_s, end_s, .. } => {
                vector(*at_body) && vector(*force_world) && !start_s.is_nan() && !end_s.is_nan()
            }
            Self::Torque { torque_world, start_s, end_s, .. } => {
                all(&<[T; 3]>::from(*torque_world)) && !start_s.is_nan() && !end_s.is_nan()
            }
            Self::LinearDrag { k, k_angular, .. } => all(&[*k, *k_angular]),
            Self::Spring { a, b, stiffness, damping, rest_length } => {
                end(a) && end(b) && all(&[*stiffness, *damping, *rest_length])
            }
        }
    }

    fn add_to(&self, state: &impl Formulation<T>, inertias: &[Inertia<T>], wrenches: &mut Wrenches<T>) {
        match self {
            Self::AtPoint { body_idx, at_body, force_world, .. } => {
                wrenches.force[*body_idx] += *force_world;
                wrenches.torque[*body_idx] += state.to_world(*body_idx, *at_body) ^ *force_world;
            }
            Self::Torque { body_idx, torque_world, .. } => wrenches.torque[*body_idx] += *torque_world,
            Self::LinearDrag { body_idx, k, k_angular } => {
                let inertia = &inertias[*body_idx];
                wrenches.force[*body_idx] -= state.velocity(*body_idx, inertia) * *k;
                wrenches.torque[*body_idx] -= state.omega_world(*body_idx, inertia) * *k_angular;
            }
            Self::Spring { a, b, stiffness, damping, rest_length } => {
                let (end_a, end_b) = (a.end(state, inertias), b.end(state, inertias));
                let between = end_a.position.displacement_to(end_b.position).map(T::from_f64);
                let length = between.norm_sq().sqrt();
                // Ends at one place pull nowhere.
                if length == T::zero() {
                    return;
                }
                let along = between / length;
                let rate = along | (end_b.velocity - end_a.velocity);
                let pull = along * (*stiffness * (length - *rest_length) + *damping * rate);
                for (attachment, end, pull) in [(a, end_a, pull), (b, end_b, -pull)] {
                    if let Some(body_idx) = attachment.body_idx() {
                        wrenches.force[body_idx] += pull;
                        wrenches.torque[body_idx] += end.arm ^ pull;
                    }
                }
            }
        }
    }

    fn potential(&self, state: &impl Formulation<T>, inertias: &[Inertia<T>]) -> f64 {
        let Self::Spring { a, b, stiffness, rest_length, .. } = self else {
            return 0.0;
        };
        let (from, to) = (a.end(state, inertias).position, b.end(state, inertias).position);
        let stretch = from.distance_sq_to(to).sqrt() - rest_length.to_f64();
        0.5 * stiffness.to_f64() * stretch * stretch
    }
}

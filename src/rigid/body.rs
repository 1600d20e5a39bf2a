//! The state of all bodies as a structure of arrays: that of the rotor formulation, and what all others are made from and
//! read back into.
//!
//! World positions are f64, everything relative is `T`. The body frame has the axes of the shape; its origin is the
//! centre of mass.

use super::Inertia;
use crate::algebra::Real;
use crate::algebra::cga::{Motor, Point};
use crate::algebra::g3::{Bivector, Rotor, Vector};
use alloc::vec::Vec;

/// The states of all bodies. Every array has one entry a body.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Bodies<T> {
    /// Centre of mass, world, m.
    pub position: Vec<Point<f64>>,
    /// Orientation, body to world.
    pub rotor: Vec<Rotor<T>>,
    /// Momentum, kg m/s.
    pub momentum: Vec<Vector<T>>,
    /// Angular momentum about the centre of mass, world, kg m²/s.
    pub angular_momentum: Vec<Bivector<T>>,
    /// The orientations as the matrix formulation keeps them, rotations or not any more, body to world; the rotors are then
    /// the nearest ones. Empty in the other formulations.
    pub matrix: Vec<nalgebra::Matrix3<T>>,
}

impl<T: Real> Bodies<T> {
    /// The number of bodies.
    #[must_use]
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Are there none?
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Bytes of state a body.
    #[must_use]
    pub fn bytes_per_body() -> usize {
        size_of::<Point<f64>>() + size_of::<Rotor<T>>() + size_of::<Vector<T>>() + size_of::<Bivector<T>>()
    }

    /// Adds a body; its angular momentum is that in the world, `R apply (I Omega_body)`.
    pub fn push(&mut self, position: Point<f64>, rotor: Rotor<T>, momentum: Vector<T>, angular_momentum: Bivector<T>) {
        self.position.push(position);
        self.rotor.push(rotor);
        self.momentum.push(momentum);
        self.angular_momentum.push(angular_momentum);
    }

    /// Takes over the state of one body.
    pub(super) fn assign_body(&mut self, body_idx: usize, other: &Self) {
        self.position[body_idx] = other.position[body_idx];
        self.rotor[body_idx] = other.rotor[body_idx];
        self.momentum[body_idx] = other.momentum[body_idx];
        self.angular_momentum[body_idx] = other.angular_momentum[body_idx];
        if let Some(matrix) = other.matrix.get(body_idx) {
            if self.matrix.is_empty() {
                self.matrix.clone_from(&other.matrix);
            }
            self.matrix[body_idx] = *matrix;
        }
    }

    /// Moves a body, and turns it about its centre of mass by a rotation vector in its own frame, rad, as a bivector:
    /// `R exp(-Theta/2)`, formed in f64 and rounded once.
    pub(super) fn displace(&mut self, body_idx: usize, by: Vector<f64>, turn_body: Bivector<f64>) {
        self.position[body_idx] = self.position[body_idx].moved(by);
        let turn = Rotor::exp(turn_body * -0.5);
        let turned = self.rotor[body_idx].map(Real::to_f64) * turn;
        self.rotor[body_idx] = turned.renormalise().unwrap_or(turned).map(T::from_f64);
        if let Some(matrix) = self.matrix.get_mut(body_idx) {
            let turn = nalgebra::UnitQuaternion::from(turn).to_rotation_matrix();
            *matrix = (matrix.map(Real::to_f64) * turn.matrix()).map(T::from_f64);
        }
    }

    /// `Omega_world = R (I^-1 (~R L R)) ~R`, rad/s.
    #[must_use]
    pub fn omega_world(&self, body_idx: usize, inertia: &Inertia<T>) -> Bivector<T> {
        self.rotor[body_idx].apply(self.omega_body(body_idx, inertia))
    }

    /// `Omega_body = I^-1 (~R L R)`, rad/s.
    #[inline]
    #[must_use]
    pub fn omega_body(&self, body_idx: usize, inertia: &Inertia<T>) -> Bivector<T> {
        inertia.velocity_of(self.rotor[body_idx].rev().apply(self.angular_momentum[body_idx]))
    }

    /// Velocity of the centre of mass, m/s.
    #[must_use]
    pub fn velocity(&self, body_idx: usize, inertia: &Inertia<T>) -> Vector<T> {
        self.momentum[body_idx] * inertia.inv_mass
    }

    /// The motor that takes the frame of body `b` to that of body `a`; the difference of positions is taken in f64.
    #[must_use]
    pub fn relative_pose(&self, a: usize, b: usize) -> Motor<T> {
        let to_a = self.rotor[a].rev();
        let between = self.position[a].displacement_to(self.position[b]).map(T::from_f64);
        Motor::from_parts(to_a.apply(between), to_a * self.rotor[b])
    }
}

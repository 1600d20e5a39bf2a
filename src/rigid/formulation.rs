//! What the formulations of rigid motion have in common: a state of all bodies, however it stores their orientations.

use super::{Bodies, Inertia};
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::{Bivector, Vector};
use crate::ode::Controlled;
use alloc::vec;
use alloc::vec::Vec;
use thiserror::Error;

/// Force, N, and torque about the centre of mass, N m, on every body; world frame.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Wrenches<T> {
    /// N.
    pub force: Vec<Vector<T>>,
    /// N m: `r ^ F`.
    pub torque: Vec<Bivector<T>>,
}

impl<T: Real> Wrenches<T> {
    /// None on any of `n` bodies.
    #[must_use]
    pub fn zeros(n: usize) -> Self {
        Self { force: vec![Vector::default(); n], torque: vec![Bivector::default(); n] }
    }
}

/// The orientation of a body is none any more: its numbers overflowed or vanished.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("the orientation of body {body_idx} is lost: {reason}; take a smaller `dt_s`")]
pub struct OrientationLost {
    /// The body.
    pub body_idx: usize,
    /// What was found.
    pub reason: &'static str,
}

/// The state of all bodies in one of the formulations, as forces, joints and steppers see it.
///
/// Every formulation is a file with the same functions: `rhs`, `renormalise`, `advance`.
pub trait Formulation<T: Real>: Controlled<T> + Clone {
    /// Whether a state and rates at another may be combined: dense output does. If not, steps end where a state is asked for.
    const INTERPOLATES: bool = true;

    /// These bodies in this formulation.
    fn from_bodies(bodies: &Bodies<T>) -> Self;

    /// Back into bodies that there are as many of. A stored orientation that is no rotation gives the nearest one.
    fn write_to(&self, bodies: &mut Bodies<T>);

    /// Takes over bodies that there are as many of.
    fn read_from(&mut self, bodies: &Bodies<T>) {
        *self = Self::from_bodies(bodies);
    }

    /// Rates of the right size.
    fn zero_rates(&self) -> Self::Rate;

    /// The number of bodies.
    fn len(&self) -> usize;

    /// Are there none?
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Centre of mass, world, m.
    fn position(&self, body_idx: usize) -> Point<f64>;

    /// A vector of the body frame in the world frame.
    fn to_world(&self, body_idx: usize, x_body: Vector<T>) -> Vector<T>;

    /// Of the centre of mass, m/s.
    fn velocity(&self, body_idx: usize, inertia: &Inertia<T>) -> Vector<T>;

    /// rad/s.
    fn omega_world(&self, body_idx: usize, inertia: &Inertia<T>) -> Bivector<T>;

    /// The equations of motion under forces and torques.
    fn rhs(&self, inertias: &[Inertia<T>], wrenches: &Wrenches<T>, rates: &mut Self::Rate);

    /// After a step: orientations back to what orientations are. Whether it changed anything.
    ///
    /// # Errors
    /// An orientation whose numbers overflowed or vanished.
    fn renormalise(&mut self) -> Result<bool, OrientationLost>;
}

//! The state of all particles as a structure of arrays. World positions are f64, velocities are `T`.

use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;
use crate::ode::{Controlled, State, Tolerance};
use alloc::vec;
use alloc::vec::Vec;

/// The states of all particles. Every array has one entry a particle.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Particles<T> {
    /// World, m.
    pub position: Vec<Point<f64>>,
    /// m/s.
    pub velocity: Vec<Vector<T>>,
}

impl<T: Real> Particles<T> {
    /// The number of particles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Are there none?
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Adds a particle.
    pub fn push(&mut self, position: Point<f64>, velocity: Vector<T>) {
        self.position.push(position);
        self.velocity.push(velocity);
    }

    /// Bytes of state a particle, its inverse mass included.
    #[must_use]
    pub fn bytes_per_particle() -> usize {
        size_of::<Point<f64>>() + size_of::<Vector<T>>() + size_of::<T>()
    }
}

/// The rate of change of every array of [`Particles`].
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Rates<T> {
    /// xdot, m/s.
    pub velocity: Vec<Vector<T>>,
    /// vdot, m/s².
    pub acceleration: Vec<Vector<T>>,
}

impl<T: Real> Rates<T> {
    /// Zero rates of `n` particles.
    #[must_use]
    pub fn zeros(n: usize) -> Self {
        Self { velocity: vec![Vector::default(); n], acceleration: vec![Vector::default(); n] }
    }
}

impl<T: Real> State<T> for Particles<T> {
    type Rate = Rates<T>;

    fn assign(&mut self, other: &Self) {
        self.position.clone_from(&other.position);
        self.velocity.clone_from(&other.velocity);
    }

    fn add_scaled(&mut self, terms: &[(T, &Rates<T>)]) {
        for (index, (position, velocity)) in self.position.iter_mut().zip(&mut self.velocity).enumerate() {
            let (mut moved, mut gained) = (Vector::default(), Vector::default());
            for (h, rates) in terms {
                moved += rates.velocity[index] * *h;
                gained += rates.acceleration[index] * *h;
            }
            *position = position.moved(moved.map(Real::to_f64));
            *velocity += gained;
        }
    }
}

impl<T: Real> Controlled<T> for Particles<T> {
    /// Coordinate by coordinate, positions in m and velocities in m/s.
    fn error_ratio(&self, next: &Self, terms: &[(T, &Rates<T>)], tolerance: Tolerance<T>) -> T {
        let (mut worst, mut sum) = (T::zero(), T::zero());
        let mut take = |error: T, before: T, after: T| {
            let allowed = tolerance.atol + tolerance.rtol * before.abs().max(after.abs());
            let ratio = if error == T::zero() { T::zero() } else { error.abs() / allowed };
            worst = worst.max(ratio);
            sum = sum + ratio;
        };
        for index in 0..self.len() {
            let (mut moved, mut gained) = (Vector::default(), Vector::default());
            for (h, rates) in terms {
                moved += rates.velocity[index] * *h;
                gained += rates.acceleration[index] * *h;
            }
            let ends = |at: &Self| (at.position[index].position().map(T::from_f64), at.velocity[index]);
            let ((x, v), (next_x, next_v)) = (ends(self), ends(next));
            for (error, before, after) in [(moved, x, next_x), (gained, v, next_v)] {
                take(error.e1, before.e1, after.e1);
                take(error.e2, before.e2, after.e2);
                take(error.e3, before.e3, after.e3);
            }
        }
        // A maximum forgets what is no number, a sum does not.
        if sum.is_finite() { worst } else { sum }
    }
}

//! Where the last positions are kept during a step: in the place of the velocities, if those are f64.
//!
//! ```text
//! start   x_old = x - h (v + h a)        end   v = (x - x_old) / h
//! ```
//!
//! Between substeps velocities are not needed. To have them hold positions saves 24 bytes a particle.

use super::{Particles, Xpbd};
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;

/// Can three numbers of type T hold a position?
pub(super) fn holds_positions<T: Real>() -> bool {
    T::EPSILON.to_f64() <= f64::EPSILON
}

/// A place for a position.
pub(super) trait Last: Send {
    fn get(&self) -> Point<f64>;
    fn set(&mut self, position: Point<f64>);
}

impl Last for Point<f64> {
    fn get(&self) -> Point<f64> {
        *self
    }

    fn set(&mut self, position: Point<f64>) {
        *self = position;
    }
}

impl<T: Real> Last for Vector<T> {
    fn get(&self) -> Point<f64> {
        <[T; 3]>::from(*self).map(Real::to_f64).into()
    }

    fn set(&mut self, position: Point<f64>) {
        *self = <[f64; 3]>::from(position).map(T::from_f64).into();
    }
}

impl<T: Real> Xpbd<T> {
    /// Sets the last positions such that the next prediction is `x + h (v + h a)`.
    pub(super) fn begin(
        &mut self,
        particles: &mut Particles<T>,
        inv_mass: &[T],
        h_s: f64,
        acceleration: Option<&[Vector<T>]>,
    ) {
        let last = |index: usize, velocity: Vector<T>| {
            let position = particles.position[index];
            if inv_mass[index] == T::zero() {
                return position;
            }
            let gained = acceleration.map_or(Vector::default(), |a| a[index].map(Real::to_f64) * h_s);
            position.moved((velocity.map(Real::to_f64) + gained) * -h_s)
        };
        if holds_positions::<T>() {
            particles
                .velocity
                .iter_mut()
                .enumerate()
                .for_each(|(index, velocity)| velocity.set(last(index, *velocity)));
        } else {
            let velocities = particles.velocity.iter().zip(&mut self.last).enumerate();
            velocities.for_each(|(index, (velocity, place))| place.set(last(index, *velocity)));
        }
    }

    /// Sets the velocities from the last positions; puts fixed particles back, which a sweep may have turned from -0 to 0.
    pub(super) fn finish(&mut self, particles: &mut Particles<T>, inv_mass: &[T], h_s: f64) {
        let inv_h = 1.0 / h_s;
        let Particles { position, velocity } = particles;
        for (index, ((position, velocity), w)) in position.iter_mut().zip(velocity).zip(inv_mass).enumerate() {
            let last = if holds_positions::<T>() { velocity.get() } else { self.last[index] };
            *velocity = if *w == T::zero() {
                *position = last;
                Vector::default()
            } else {
                (last.displacement_to(*position) * inv_h).map(T::from_f64)
            };
        }
    }
}

//! Random translators, motors and poses; what is drawn number by number, or from a sphere, is generated with its type.

use crate::algebra::Real;
use crate::algebra::cga::{Motor, Pose, Translator};
use crate::algebra::g3::{Rotor, Vector};
use rand::Rng;
use rand::distr::{Distribution, StandardUniform};

impl<T: Real> Distribution<Translator<T>> for StandardUniform
where
    Self: Distribution<T>,
{
    /// Moves by a number from 0 to 1 along each axis.
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> Translator<T> {
        Translator::by(Distribution::<Vector<T>>::sample(self, rng))
    }
}

impl<T: Real> Distribution<Motor<T>> for StandardUniform
where
    Self: Distribution<T>,
{
    /// Turns by a rotor that is uniform over all rotations, then moves by a number from 0 to 1 along each axis.
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> Motor<T> {
        let rotor = Distribution::<Rotor<T>>::sample(self, rng);
        Motor::from_parts(Distribution::<Vector<T>>::sample(self, rng), rotor)
    }
}

impl<T: Real> Distribution<Pose<T>> for StandardUniform
where
    Self: Distribution<T>,
{
    /// As a motor.
    fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> Pose<T> {
        let Rotor { s, e23, e31, e12 } = Distribution::<Rotor<T>>::sample(self, rng);
        let Vector { e1: x, e2: y, e3: z } = Distribution::<Vector<T>>::sample(self, rng);
        Pose { x, y, z, s, e23, e31, e12 }
    }
}

//! Poses: motors stored as their translation and their rotor, `M = T R`, in seven numbers.

use crate::algebra::Scalar;
use crate::algebra::cga::{Motor, Point, Pose};
use crate::algebra::g3::{Rotor, Vector};
use crate::formula;

/// A motor as a pose: its rotor, and the translation that is left, `M ~R`.
#[formula(crate::algebra::cga)]
fn pose_of(motor: Motor) -> Pose {
    motor
}

/// A pose as a motor, `T R`.
#[formula(crate::algebra::cga)]
fn motor_of(pose: Pose) -> Motor {
    pose
}

impl<T: Scalar> From<Motor<T>> for Pose<T> {
    #[inline]
    fn from(motor: Motor<T>) -> Self {
        pose_of(motor)
    }
}

impl<T: Scalar> From<Pose<T>> for Motor<T> {
    #[inline]
    fn from(pose: Pose<T>) -> Self {
        motor_of(pose)
    }
}

impl<T: Scalar> Pose<T> {
    /// First the rotation, then the translation: `T R`.
    #[inline]
    #[must_use]
    pub fn from_parts(translation: Vector<T>, rotor: Rotor<T>) -> Self {
        let Vector { e1: x, e2: y, e3: z } = translation;
        let Rotor { s, e23, e31, e12 } = rotor;
        Self { x, y, z, s, e23, e31, e12 }
    }

    /// The rotor of `M = T R`.
    #[inline]
    #[must_use]
    pub fn rotor(self) -> Rotor<T> {
        Rotor::new(self.s, self.e23, self.e31, self.e12)
    }

    /// The translation of `M = T R`: where it takes the origin.
    #[inline]
    #[must_use]
    pub fn translation(self) -> Vector<T> {
        Vector::new(self.x, self.y, self.z)
    }

    /// Where it takes the origin.
    #[inline]
    #[must_use]
    pub fn position(self) -> Point<T> {
        Point::new(self.x, self.y, self.z)
    }
}

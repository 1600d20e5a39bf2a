//! Translators `T = 1 - t ninf / 2` and motors `M = T R`.

use crate::algebra::Scalar;
use crate::algebra::cga::{Motor, Translator};
use crate::algebra::g3::{Rotor, Vector};

impl<T: Scalar> Translator<T> {
    /// The translator that moves by `t`: `1 - t ninf / 2`.
    #[inline]
    #[must_use]
    pub fn by(t: Vector<T>) -> Self {
        Self::new(t.e1, t.e2, t.e3)
    }

    /// The displacement.
    #[inline]
    #[must_use]
    pub fn displacement(self) -> Vector<T> {
        Vector::new(self.x, self.y, self.z)
    }
}

impl<T: Scalar> Motor<T> {
    /// First the rotation, then the translation: `T R`.
    #[inline]
    #[must_use]
    pub fn from_parts(translation: Vector<T>, rotor: Rotor<T>) -> Self {
        Translator::by(translation) * rotor
    }

    /// The rotor of `M = T R`.
    #[inline]
    #[must_use]
    pub fn rotor(self) -> Rotor<T> {
        Rotor::new(self.s, self.e23, self.e31, self.e12)
    }

    /// The translation of `M = T R`: where the motor takes the origin.
    #[inline]
    #[must_use]
    pub fn translation(self) -> Vector<T> {
        let image = self.apply(crate::algebra::cga::Origin);
        Vector::new(image.x, image.y, image.z)
    }
}

//! Rotors of G(3,0): the exponential of a bivector, and normalisation of a sum of rotors.
//!
//! `exp(B) = cos b + (sin b / b) B` with `b = |B|`. A rotation by `phi` in the plane and sense of the unit bivector `B`
//! is `exp(-B phi / 2)`, acting as `x' = R x ~R`.

use crate::algebra::Real;
use crate::algebra::g3::{Bivector, Even, Rotor, Vector};

/// An even multivector that no scale turns into a rotor: its norm is zero, infinite or not a number.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("no rotor has norm squared {norm_sq:e}: give four numbers that are finite and not all zero")]
pub struct NotARotor {
    /// The sum of the squares of its numbers, as found.
    pub norm_sq: f64,
}

/// Below this angle `sin b / b` is its series `1 - b²/6`: the next term, b⁴/120 = 7e-17, is then under half an epsilon of
/// f64; above it the quotient loses nothing, since libm's sine is good to an ulp.
const SERIES_BELOW: f64 = 3e-4;

impl<T: Real> Rotor<T> {
    /// `exp(b)`, with `b` in radians of half the angle of rotation.
    #[must_use]
    pub fn exp(b: Bivector<T>) -> Self {
        let angle = b.norm_sq().sqrt();
        let (sin, cos) = angle.sin_cos();
        let sinc =
            if angle < T::from_f64(SERIES_BELOW) { T::one() - angle * angle * T::ratio(1, 6) } else { sin / angle };
        Self::new(cos, b.e23 * sinc, b.e31 * sinc, b.e12 * sinc)
    }

    /// The rotation by `angle_rad` round an axis of any length but zero, by the right-hand rule.
    ///
    /// # Errors
    /// An axis whose length is zero, infinite or not a number.
    pub fn from_axis_angle(axis: Vector<T>, angle_rad: T) -> Result<Self, NotARotor> {
        // The largest component is taken out first: the square of a short axis would underflow, and lose its digits.
        let largest = axis.e1.abs().max(axis.e2.abs()).max(axis.e3.abs());
        let axis = axis / largest;
        let half = angle_rad * T::ratio(1, 2) / axis.norm_sq().sqrt();
        if !(largest > T::zero() && half.is_finite()) {
            return Err(NotARotor { norm_sq: (largest * largest * axis.norm_sq()).to_f64() });
        }
        Ok(Self::exp(Bivector::new(-axis.e1 * half, -axis.e2 * half, -axis.e3 * half)))
    }

    /// The unit rotor in the direction of an even multivector: all numbers times `1/sqrt(a ~a)`.
    ///
    /// # Errors
    /// A norm that is zero, infinite or not a number, or whose square is so small that it has lost digits.
    pub fn normalise(a: Even<T>) -> Result<Self, NotARotor> {
        let norm_sq = a.norm_sq();
        let scale = T::one() / norm_sq.sqrt();
        // The smallest normal number times epsilon is the smallest number of all.
        if !(scale.is_finite() && norm_sq.is_finite() && norm_sq * T::EPSILON > T::zero()) {
            return Err(NotARotor { norm_sq: norm_sq.to_f64() });
        }
        Ok(Self::new(a.s * scale, a.e23 * scale, a.e31 * scale, a.e12 * scale))
    }
}

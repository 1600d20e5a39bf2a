//! Rotors of G(3,0): exponential, logarithm, powers, interpolation, and normalisation of a sum of rotors.
//!
//! `exp(B) = cos b + (sin b / b) B` with `b = |B|`. A rotation by `phi` in the plane and sense of the unit bivector `B`
//! is `exp(-B phi / 2)`, acting as `x' = R x ~R`.

use super::direction::{direction, quotient};
use crate::algebra::Real;
use crate::algebra::g3::{Bivector, Even, Rotor, Vector};

/// An even multivector that no scale turns into a rotor: its norm is zero, infinite or not a number.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("no rotor has norm squared {norm_sq:e}: give four numbers that are finite and not all zero")]
pub struct NotARotor {
    /// The sum of the squares of its numbers, as found.
    pub norm_sq: f64,
}

impl<T: Real> Rotor<T> {
    /// `exp(b) = cos |b| + (sin |b| / |b|) b`, with `|b|` in radians of half the angle of rotation: the rotation by `phi`
    /// in the plane and sense of the unit bivector `B` is `exp(-B phi / 2)`. With an angular velocity Omega,
    /// `Rdot = -1/2 Omega R`, it is `R(t) = exp(-Omega t / 2) R(0)`.
    ///
    /// Errs by `2 eps (1 + |b|)`: the rounding of `|b|` is an error of the angle. A component that is not finite makes the
    /// result NaN.
    #[must_use]
    pub fn exp(b: Bivector<T>) -> Self {
        let (angle, _) = direction(b);
        let (sin, cos) = angle.sin_cos();
        let sinc = quotient(sin, angle);
        Self::new(cos, b.e23 * sinc, b.e31 * sinc, b.e12 * sinc)
    }

    /// The logarithm of the rotation: the shortest `b` with `exp(b) = R` or `-R`, which are the same rotation. It is that
    /// of `R` where the scalar part is not negative, else that of `-R`, so that `|b| <= pi/2`: a turn of at most pi.
    ///
    /// The branch is at a turn of pi: there `b` jumps to `-b`. At scalar part zero exactly it has the sense of the
    /// rotor's own bivector. The length of the rotor does not matter.
    ///
    /// Taken from the arc tangent of both parts: the arc cosine of the scalar part alone loses half the digits of small
    /// angles, and all below 1e-8.
    #[must_use]
    pub fn log(self) -> Bivector<T> {
        let r = self.shorter();
        let b = Bivector::new(r.e23, r.e31, r.e12);
        let (sin, _) = direction(b);
        b * quotient(sin.atan2(r.s), sin)
    }

    /// The part t of the rotation, `exp(t log R)`: the shorter way round, at constant speed for growing t.
    #[must_use]
    pub fn powf(self, t: T) -> Self {
        Self::exp(self.log() * t)
    }

    /// From this rotor at t = 0 to `to` at t = 1 by the shorter arc, at constant angular velocity; beyond, it turns on.
    ///
    /// Where the scalar part of `~R to` is negative, the shorter arc ends at `-to`, the same rotation. Both ends are met
    /// to the bit. Between rotations that differ by a half turn both arcs are equally long; see [`Rotor::log`].
    #[must_use]
    pub fn interpolate(self, to: Self, t: T) -> Self {
        let relative = self.rev() * to;
        let log = relative.log();
        // From the nearer end, so that neither is off by the rounding of the other.
        if t <= T::ratio(1, 2) {
            return self * Self::exp(log * t);
        }
        let end = if relative.s < T::zero() { -to } else { to };
        end * Self::exp(log * (t - T::one()))
    }

    /// Of R and -R, which are the same rotation, the one with the smaller angle.
    fn shorter(self) -> Self {
        if self.s < T::zero() { -self } else { self }
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

    /// A rotor that has drifted, back at unit length: the nearest rotor.
    ///
    /// # Errors
    /// As for [`Rotor::normalise`].
    pub fn renormalise(self) -> Result<Self, NotARotor> {
        Self::normalise(self.into())
    }
}

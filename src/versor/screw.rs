//! Exponential, logarithm, powers, interpolation and renormalisation of motors, and the same for translators.
//!
//! With a twist `b + w ninf`, b a bivector and w a vector, `p = |b|`, and the axis `a` of b: w is split along and across the
//! axis, `w_a = a . w`. A screw turns by p and slides by `w_a` along its axis, two motions that commute, so
//!
//! ```text
//! exp(b + w ninf) = cos p + (sin p / p) b + v ninf + c e123_ninf
//! v = (sin p / p) (w - w_a a) + cos p w_a a        c = sin p w_a
//! log:  p = atan2(|b|, s)    w_a = s v_a + |b| c    w = (p / sin p) (v - v_a a) + w_a a
//! ```
//!
//! These are the dual-number forms `exp = C(N) + S(N) V`, `N = V² = -p² + 2 p w_a e123_ninf`, with the derivative of
//! `sin p / p`, which is a difference of nearly equal numbers at small p, multiplied out. So nothing cancels at any p, no
//! series and no small-angle switch is needed, and translations of any length stay exact.

use super::direction::{along, axial, direction, quotient};
use crate::algebra::Real;
use crate::algebra::cga::{Motor, Translator, Twist};
use crate::algebra::g3::{Bivector, Vector};

/// A multivector that cannot be scaled and projected to a motor.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NotAMotor {
    /// The rotation has no direction.
    #[error(
        "no motor has a rotation of norm squared {norm_sq:e}: its first four numbers must be finite and not all zero"
    )]
    Rotation {
        /// The sum of the squares of the first four numbers, as found.
        norm_sq: f64,
    },
    /// The translation is infinite or not a number, or the projection made it so.
    #[error("the translation of a motor is not finite")]
    Translation,
}

impl<T: Real> Motor<T> {
    /// `exp(v)`: a screw. The twist V of a motion, `Mdot = -1/2 V M`, leads to `M(t) = exp(-V t / 2) M(0)`; the
    /// translation by t is `exp(-t ninf / 2)`.
    ///
    /// Errs by a few eps of the largest number, times `1 + |b|`. A component that is not finite makes the result NaN.
    #[must_use]
    pub fn exp(v: Twist<T>) -> Self {
        let (b, w) = (Bivector::new(v.e23, v.e31, v.e12), Vector::new(v.e1_ninf, v.e2_ninf, v.e3_ninf));
        let (angle, axis) = direction(b);
        let (sin, cos) = angle.sin_cos();
        let sinc = quotient(sin, angle);
        let slide = along(axis, w);
        let v = w * sinc + axial(axis, slide * (cos - sinc));
        from_parts(cos, b * sinc, v, sin * slide)
    }

    /// The logarithm of the motion: the shortest twist v with `exp(v) = M` or `-M`, which are the same motion. It is that of
    /// `M` where the scalar part is not negative, else that of `-M`: a screw that turns by at most pi.
    ///
    /// The branch is at a turn of pi: there the axis changes its sense. At scalar part zero exactly it has the sense of the
    /// motor's own bivector. Near a turn of 2 pi the logarithm of the other sign would be a full turn about an axis far
    /// away, which holds no digits of the motion.
    ///
    /// The motor has to be unit; [`Motor::renormalise`] makes it so.
    #[must_use]
    pub fn log(self) -> Twist<T> {
        let m = if self.s < T::zero() { -self } else { self };
        let (b, v) = (Bivector::new(m.e23, m.e31, m.e12), Vector::new(m.e1_ninf, m.e2_ninf, m.e3_ninf));
        let (sin, axis) = direction(b);
        let ratio = quotient(sin.atan2(m.s), sin);
        let v_along = along(axis, v);
        let slide = m.s * v_along + sin * m.e123_ninf;
        let w = (v - axial(axis, v_along)) * ratio + axial(axis, slide);
        Twist::new(b.e23 * ratio, b.e31 * ratio, b.e12 * ratio, w.e1, w.e2, w.e3)
    }

    /// The part t of the motion, `exp(t log M)`: along one screw, turning the shorter way, at constant speed for growing t.
    #[must_use]
    pub fn powf(self, t: T) -> Self {
        Self::exp(self.log() * t)
    }

    /// From this motor at t = 0 to `to` at t = 1 along one screw, turning the shorter way, at constant speed; beyond, it goes on.
    ///
    /// Where the scalar part of `~M to` is negative, it ends at `-to`, the same motion. Both ends are met to the bit.
    /// Between motions that differ by a half turn both ways are equally long; see [`Motor::log`].
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

    /// A motor that has drifted, back on its manifold: `M (~M M)^(-1/2)`, both parts of `M ~M = 1`.
    ///
    /// `~M M = sigma (1 + 2 delta e123_ninf)`, so the factor is `sigma^(-1/2) (1 - delta e123_ninf)`.
    ///
    /// # Errors
    /// A rotation whose norm is zero, not finite, or so small that its square has lost digits; a translation that is not
    /// finite.
    pub fn renormalise(self) -> Result<Self, NotAMotor> {
        let b = Bivector::new(self.e23, self.e31, self.e12);
        let v = Vector::new(self.e1_ninf, self.e2_ninf, self.e3_ninf);
        let norm_sq = self.s * self.s + b.norm_sq();
        let scale = T::one() / norm_sq.sqrt();
        if !(scale.is_finite() && norm_sq.is_finite() && norm_sq * T::EPSILON > T::zero()) {
            return Err(NotAMotor::Rotation { norm_sq: norm_sq.to_f64() });
        }
        let (s, b, v, c) = (self.s * scale, b * scale, v * scale, self.e123_ninf * scale);
        let delta = s * c - along(b, v);
        let v = v + axial(b, delta);
        let c = c - s * delta;
        let finite = v.e1.is_finite() && v.e2.is_finite() && v.e3.is_finite() && c.is_finite();
        if finite { Ok(from_parts(s, b, v, c)) } else { Err(NotAMotor::Translation) }
    }
}

impl<T: Real> Translator<T> {
    /// The logarithm, `-t ninf / 2`: exact.
    #[must_use]
    pub fn log(self) -> Twist<T> {
        let [x, y, z] = <[T; 3]>::from(self).map(|x| x * T::ratio(-1, 2));
        Twist::new(T::zero(), T::zero(), T::zero(), x, y, z)
    }

    /// The part t of the way.
    #[must_use]
    pub fn powf(self, t: T) -> Self {
        self.map(|x| x * t)
    }

    /// From this translator at t = 0 to `to` at t = 1, on a straight line at constant speed; both ends are met to the bit.
    #[must_use]
    pub fn interpolate(self, to: Self, t: T) -> Self {
        // Not from + t (to - from): the difference may overflow, and does not end at `to`.
        let rest = T::one() - t;
        Self::new(self.x * rest + to.x * t, self.y * rest + to.y * t, self.z * rest + to.z * t)
    }
}

fn from_parts<T: Real>(s: T, b: Bivector<T>, v: Vector<T>, e123_ninf: T) -> Motor<T> {
    Motor::from([s, b.e23, b.e31, b.e12, v.e1, v.e2, v.e3, e123_ninf])
}

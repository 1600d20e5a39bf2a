//! Exponential, logarithm, powers, interpolation and renormalisation of general conformal rotors.
//!
//! Every one of them is an exponential, up to sign: a rotation with a dilation (a spiral), with a translation along its
//! axis (a screw), or with a motion round a circle. Compare Dorst and Valkenburg, *Square root and logarithm of rotors in
//! 3D conformal geometric algebra using polar decomposition*, 2011; what is used here is in [`super::functions`].

use super::direction::quotient;
use super::functions::{self, Number};
use crate::algebra::Real;
use crate::algebra::cga::{ConformalRotor, DirectSphere, Even, PointPair};
use crate::algebra::g3;

/// Why a conformal rotor has no exponential or logarithm, or cannot be renormalised.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NotAConformalRotor {
    /// A number of the operand or of the result is infinite or not a number.
    #[error("a conformal rotor leaves the range of the scalar: a number of it is infinite or none")]
    OutOfRange,
    /// `V ~V` is no positive number and a small rest, so that no scale and projection makes it 1.
    #[error("no conformal rotor has `V ~V` = {norm_sq:e}, 4-vector of norm squared {rest_sq:e}: it must be near 1, 0")]
    NotUnit {
        /// The scalar part of `V ~V`; negative for what exchanges inside and outside.
        norm_sq: f64,
        /// The square of its 4-vector part.
        rest_sq: f64,
    },
    /// Within rounding of an antipodal map, which turns by pi in two planes at once: every pair of such planes has it.
    #[error("the logarithm is not unique: the versor takes every point of some sphere to the opposite one")]
    Antipodal,
}

impl<T: Real> ConformalRotor<T> {
    /// `exp(b)` of any bivector.
    ///
    /// Errs by a few eps of the largest number, times the larger of 1 and the angle. For similarities, where v or w is zero,
    /// p and q are each good to that, however far their sizes are apart.
    ///
    /// # Errors
    /// A result that overflows; a bivector with numbers that are not finite, or whose square overflows.
    pub fn exp(b: PointPair<T>) -> Result<Self, NotAConformalRotor> {
        #[expect(clippy::eq_op, reason = "the outer square of a bivector is not zero, as that of a vector is")]
        let four = b ^ b;
        let [cosh, sinhc] = functions::exponential(-b.norm_sq(), four.norm_sq());
        let two = b * sinhc.scalar + (b | four) * sinhc.four;
        let raw = assemble(cosh.scalar, two, four * cosh.four);
        finite(complete(raw))
    }

    /// The logarithm of the map: the shortest b with `exp(b) = V` or `-V`, which map alike. It is that of `V` where its scalar
    /// part is not negative, else that of `-V`.
    ///
    /// The branch is where the scalar part is zero: a turn of pi. The versor has to be unit up to rounding, which
    /// [`ConformalRotor::renormalise`] sees to; only what is off by half of it is refused. The logarithm of the dilation errs by eps absolutely, since p and q
    /// are near 1 for a small one.
    ///
    /// # Errors
    /// Numbers that are not finite, or whose squares overflow; `V ~V` that is nowhere near 1; a versor that takes every point of some sphere, real or imaginary, to the opposite
    /// one, whose logarithm is not unique. Near such a one at a distance d the error is `eps / d`.
    pub fn log(self) -> Result<PointPair<T>, NotAConformalRotor> {
        let v = finite(self.positive())?;
        if !((v.norm_sq() - T::one()).abs() <= T::ratio(1, 2)) {
            return Err(v.not_unit());
        }
        let (c, two, four) = parts(v);
        let (f2, m, crossed) = (four.norm_sq(), -two.norm_sq(), two | four);
        let b = if functions::turns_are_close(c, f2, m) {
            isoclinic_log(c, two, crossed, f2.sqrt()).ok_or(NotAConformalRotor::Antipodal)?
        } else {
            let function = functions::logarithm(c, f2, m);
            two * function.scalar + crossed * function.four
        };
        let numbers: [T; 10] = b.into();
        if numbers.iter().all(|x| x.is_finite()) { Ok(b) } else { Err(NotAConformalRotor::OutOfRange) }
    }

    /// The part t of the map, `exp(t log V)`.
    ///
    /// # Errors
    /// As for the logarithm and the exponential.
    pub fn powf(self, t: T) -> Result<Self, NotAConformalRotor> {
        Self::exp(self.log()? * t)
    }

    /// From this versor at t = 0 to `to` at t = 1 along one orbit, turning the shorter way; beyond, it goes on.
    ///
    /// Where the scalar part of `~V to` is negative, it ends at `-to`, the same map. Both ends are met to the bit.
    ///
    /// # Errors
    /// As for the logarithm of `~V to` and the exponential.
    pub fn interpolate(self, to: Self, t: T) -> Result<Self, NotAConformalRotor> {
        let relative = self.rev() * to;
        let log = relative.log()?;
        // From the nearer end, so that neither is off by the rounding of the other.
        if t <= T::ratio(1, 2) {
            return Ok(self * Self::exp(log * t)?);
        }
        let end = if relative.is_negative() { -to } else { to };
        Ok(end * Self::exp(log * (t - T::one()))?)
    }

    /// A conformal rotor that has drifted, back on its manifold: `(V ~V)^(-1/2) V`.
    ///
    /// With `V ~V = n + F` and `r² = n² - F²` the factor is `(n + r - F) / (r sqrt(2 (n + r)))`.
    ///
    /// # Errors
    /// Numbers that are not finite; `V ~V` without a root that is positive, or so small that its square has lost digits.
    pub fn renormalise(self) -> Result<Self, NotAConformalRotor> {
        let (n, _, four) = parts(finite(self * self.rev())?);
        let r_sq = n * n - four.norm_sq();
        // The smallest normal number times epsilon is the smallest number of all.
        if !(n > T::zero() && r_sq * T::EPSILON > T::zero() && r_sq.is_finite()) {
            return Err(self.not_unit());
        }
        let r = r_sq.sqrt();
        let scale = T::one() / (r * ((n + r) * T::ratio(2, 1)).sqrt());
        let factor = Number { scalar: (n + r) * scale, four: -scale };
        finite(assemble(factor.scalar, PointPair::default(), four * factor.four) * self)
    }

    /// Of V and -V, which map alike, the one with a scalar part that is not negative.
    fn positive(self) -> Self {
        if self.is_negative() { -self } else { self }
    }

    /// What `V ~V` is instead of 1.
    fn not_unit(self) -> NotAConformalRotor {
        let (n, _, four) = parts(self * self.rev());
        NotAConformalRotor::NotUnit { norm_sq: n.to_f64(), rest_sq: four.norm_sq().to_f64() }
    }

    /// Is the scalar part negative?
    fn is_negative(self) -> bool {
        self.p + self.q < T::zero()
    }
}

/// The scalar, bivector and 4-vector of a versor.
fn parts<T: Real>(v: ConformalRotor<T>) -> (T, PointPair<T>, DirectSphere<T>) {
    let even = Even::from(v);
    (even.s, even.grade2(), even.grade4())
}

/// Below this many epsilons the sine of an angle near pi is the rounding of the numbers that it is the norm of.
const ANTIPODAL_EPSILONS: i32 = 16;

/// The logarithm of a versor that turns in two planes by nearly the same angle: `F = r J`, `J² = 1`, and its halves by
/// `(1 +- J)/2` are unit quaternions with cosine `c +- r`, whose logarithms add. `None` where one is -1, to rounding.
fn isoclinic_log<T: Real>(c: T, two: PointPair<T>, crossed: PointPair<T>, r: T) -> Option<PointPair<T>> {
    let half = T::ratio(1, 2);
    let part = |part: PointPair<T>, cos: T| {
        // The squared norm of a half is half of that of the quaternion.
        let sin = (part.norm_sq() * T::ratio(2, 1)).max(T::zero()).sqrt();
        let defined = cos > T::zero() || sin > T::ratio(ANTIPODAL_EPSILONS, 1) * T::EPSILON;
        defined.then(|| part * quotient(sin.atan2(cos), sin))
    };
    Some(part((two + crossed / r) * half, c + r)? + part((two - crossed / r) * half, c - r)?)
}

/// The versor with this scalar, bivector and 4-vector.
fn assemble<T: Real>(c: T, b: PointPair<T>, f: DirectSphere<T>) -> ConformalRotor<T> {
    let minus_two = T::ratio(-2, 1);
    ConformalRotor {
        p: c + b.no_ninf,
        q: c - b.no_ninf,
        p23: b.e23 + f.e23_no_ninf,
        q23: b.e23 - f.e23_no_ninf,
        p31: b.e31 + f.e31_no_ninf,
        q31: b.e31 - f.e31_no_ninf,
        p12: b.e12 + f.e12_no_ninf,
        q12: b.e12 - f.e12_no_ninf,
        v1: b.e1_no,
        v2: b.e2_no,
        v3: b.e3_no,
        v123: f.e123_no,
        w1: b.e1_ninf * minus_two,
        w2: b.e2_ninf * minus_two,
        w3: b.e3_ninf * minus_two,
        w123: f.e123_ninf * minus_two,
    }
}

/// The smaller of the even blocks from the others, by `V ~V = 1`: `p ~q + w ~v = 1`, `q ~p + v ~w = 1`.
///
/// As a sum of hyperbolic functions the smaller one has only the absolute error of the larger one. The equation gives it with
/// `eps (1 + |v w|) / |p|`, which is better where `|p|²` is over that.
fn complete<T: Real>(v: ConformalRotor<T>) -> ConformalRotor<T> {
    let p = g3::Even::new(v.p, v.p23, v.p31, v.p12);
    let q = g3::Even::new(v.q, v.q23, v.q31, v.q12);
    let odd_v = g3::Odd::new(v.v1, v.v2, v.v3, v.v123);
    let odd_w = g3::Odd::new(v.w1, v.w2, v.w3, v.w123);
    // Sizes are largest components, at most twice smaller than norms: their squares would overflow.
    let (p_size, q_size) = (largest::<T, 4>(p.into()), largest::<T, 4>(q.into()));
    let bound = T::one() + T::ratio(4, 1) * largest::<T, 4>(odd_v.into()) * largest::<T, 4>(odd_w.into());
    let one = g3::Even::new(T::one(), T::zero(), T::zero(), T::zero());
    if p_size > q_size && p_size > bound / p_size {
        // ~q = ~p (1 - w ~v) / |p|²
        let p = p / p_size;
        let q = (one - odd_w * odd_v.rev()).rev() * p / (p.norm_sq() * p_size);
        return ConformalRotor { q: q.s, q23: q.e23, q31: q.e31, q12: q.e12, ..v };
    }
    if q_size > p_size && q_size > bound / q_size {
        let q = q / q_size;
        let p = (one - odd_v * odd_w.rev()).rev() * q / (q.norm_sq() * q_size);
        return ConformalRotor { p: p.s, p23: p.e23, p31: p.e31, p12: p.e12, ..v };
    }
    v
}

fn largest<T: Real, const N: usize>(numbers: [T; N]) -> T {
    numbers.into_iter().fold(T::zero(), |largest, x| largest.max(x.abs()))
}

fn finite<T: Real>(v: ConformalRotor<T>) -> Result<ConformalRotor<T>, NotAConformalRotor> {
    let numbers: [T; 16] = v.into();
    if numbers.iter().all(|x| x.is_finite()) { Ok(v) } else { Err(NotAConformalRotor::OutOfRange) }
}

//! The exact motion of a body on which no torque acts.
//!
//! The momentum, constant in the world, moves in the body by Jacobi's elliptic functions; the attitude follows from its
//! direction and one phase. [`FreeMotion`] prepares both as quickly converging series (theta functions: Jacobi 1850; as a
//! numerical method van Zon and Schofield, J. Comput. Phys. 225, 2007, 145) and evaluates them at any time, however far;
//! [`turn`] takes one step from any state, as compositions with the kicks of forces need it.
//!
//! What they err by is rounding: a few eps of the direction, and a few eps of the phase, which is what the last bit of the
//! input moves it by. Near the separatrix, `|L|² = 2 E I2`, the problem itself is ill-conditioned: there the time of the
//! next flip moves by `1/lambda` times the relative error of the distance from it.
//!
//! All arithmetic is f64; the scalar of the state matters at the border only.

mod frame;
mod hyperbolic;
mod landen;
mod short;
mod top;
mod trigonometric;

use super::Inertia;
use crate::algebra::Real;
use crate::algebra::g3::{Bivector, Even, Rotor};
use frame::{Frame, exchange, upright};
use hyperbolic::Hyperbolic;
use top::{Top, rotor as rotor_of};
use trigonometric::Trigonometric;

/// A momentum whose direction is off a principal axis by less lies on it: that is how far the rounding of two products of
/// rotors and of the sandwich puts it off, at most. Only for the middle axis does it matter, from which all else departs.
const ON_AXIS: f64 = 16.0 * f64::EPSILON;

/// Two terms of `S` that differ by less than this part of them are equal: each errs by half as much.
const ON_SEPARATRIX: f64 = 4.0 * f64::EPSILON;

/// The modulus k' at which both series have the same nome e^-pi: `K'/K = 1/2`, `k' = (sqrt 2 - 1)²` (DLMF 22.2, 19.6).
const SWITCH: f64 = 0.171_572_875_253_809_9;

/// What kind of motion it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Case {
    /// No momentum, or a body that nothing turns.
    Still,
    /// Three equal moments: a uniform rotation.
    Spherical,
    /// The momentum along a principal axis, to rounding: a uniform rotation, for the middle axis an unstable one.
    SingleAxis,
    /// Two equal moments, to rounding: precession about the momentum, rotation about the axis of symmetry, both uniform.
    Symmetric,
    /// `|L|² < 2 E I2`: the momentum goes round the axis of the smallest moment.
    AboutSmallest,
    /// `|L|² > 2 E I2`: the momentum goes round the axis of the largest moment.
    AboutLargest,
    /// `|L|² = 2 E I2`, to rounding: one flip, from the middle axis to its opposite, that takes forever.
    Separatrix,
}

#[derive(Clone, Copy, Debug)]
enum Series {
    Still,
    Trigonometric(Trigonometric),
    Hyperbolic(Hyperbolic),
}

/// The attitude of a free body at any time, prepared once.
#[derive(Clone, Copy, Debug)]
pub struct FreeMotion {
    case: Case,
    /// From the frame with the momentum along z to the world.
    left: Rotor<f64>,
    series: Series,
    /// From the body frame to that of the series.
    right: Rotor<f64>,
}

impl FreeMotion {
    /// Of a body with an orientation, body to world, and a momentum about the centre of mass, world, kg m²/s.
    #[must_use]
    pub fn new<T: Real>(inertia: &Inertia<T>, rotor: Rotor<T>, angular_momentum: Bivector<T>) -> Self {
        let axes = inertia.principal.axes;
        let rotor = rotor.map(Real::to_f64);
        match Top::new(inertia.principal.moments, rotor * axes, angular_momentum.map(Real::to_f64)) {
            Some(top) => Self::of(&top, axes),
            None => Self { case: Case::Still, left: rotor, series: Series::Still, right: Rotor::default() },
        }
    }

    /// The orientation after a time, s, of either sign. A phase so large that it overflows, which has no digits left, counts
    /// as none.
    #[must_use]
    pub fn at<T: Real>(&self, t_s: f64) -> Rotor<T> {
        let [alpha, beta] = match &self.series {
            Series::Still => return self.left.map(T::from_f64),
            Series::Trigonometric(series) => series.at(t_s),
            Series::Hyperbolic(series) => series.at(t_s),
        };
        (self.left * unit(alpha, beta) * self.right).map(T::from_f64)
    }

    /// What kind of motion it is.
    #[must_use]
    pub fn case(&self) -> Case {
        self.case
    }

    fn of(top: &Top, axes: Rotor<f64>) -> Self {
        let z = top.nearest_axis();
        let off_axis = top.u[(z + 1) % 3].abs().max(top.u[(z + 2) % 3].abs());
        if top.a[1] == 0.0 || off_axis <= ON_AXIS {
            return Self::uniform(top, axes, z, off_axis <= ON_AXIS);
        }
        let frame = Frame::new(top);
        let (_, k_complement) = frame.modulus;
        let case = match frame {
            _ if top.a[0] == 0.0 || top.a[2] == 0.0 => Case::Symmetric,
            _ if frame.off_separatrix <= ON_SEPARATRIX => Case::Separatrix,
            Frame { sense, .. } if sense > 0.0 => Case::AboutLargest,
            _ => Case::AboutSmallest,
        };
        let series = if k_complement >= SWITCH {
            Series::Trigonometric(Trigonometric::new(&frame))
        } else {
            Series::Hyperbolic(Hyperbolic::new(&frame))
        };
        let right = frame.from_principal * axes.rev();
        let mut motion = Self { case, left: Rotor::default(), series, right };
        let start: Rotor<f64> = motion.at(0.0);
        motion.left = unit_again(top.rotor * axes.rev() * start.rev());
        motion
    }

    /// A rotation about the momentum, which stays where it is in the body; on the principal axis itself if it is next to it.
    fn uniform(top: &Top, axes: Rotor<f64>, z: usize, on_axis: bool) -> Self {
        let (exchanged, u) = exchange(z, top.u);
        let (turned, u) = upright(u);
        let to_frame = turned * exchanged;
        // The shortest arc from u to z.
        let scale = 1.0 / (2.0 * (1.0 + u[2])).sqrt();
        let arc = rotor_of((1.0 + u[2]) * scale, [u[1] * scale, -u[0] * scale, 0.0]);
        let left = unit_again(top.rotor * to_frame.rev() * arc.rev());
        let right = if on_axis { to_frame } else { arc * to_frame } * axes.rev();
        let case = if on_axis { Case::SingleAxis } else { Case::Spherical };
        let phase_rad_s = top.rate_rad_s * top.b[z];
        Self { case, left, series: Series::Trigonometric(Trigonometric::uniform(phase_rad_s)), right }
    }
}

/// The orientation after a time, s, of either sign, of a body that nothing turns: one exact step.
///
/// A step in which the momentum goes round by less than a fifth of a radian in the body takes a series, twice the time of
/// RK4's; any other is [`FreeMotion`]'s, and takes three to four times as long. A step rounds the rotor: N of them err by
/// some `sqrt(N)` eps in energy and attitude, which [`FreeMotion`] does not add up.
#[must_use]
pub fn turn<T: Real>(inertia: &Inertia<T>, rotor: Rotor<T>, angular_momentum: Bivector<T>, h_s: f64) -> Rotor<T> {
    let axes = inertia.principal.axes;
    let start = rotor.map(Real::to_f64);
    let top = Top::new(inertia.principal.moments, start * axes, angular_momentum.map(Real::to_f64));
    let Some(top) = top else { return rotor };
    let t = top.rate_rad_s * h_s;
    let [u1, _, u3] = top.u;
    let on_middle = u1.abs().max(u3.abs()) <= ON_AXIS;
    if !(top.a[1] * t.abs() <= short::LONGEST && t.abs() <= short::MOST_TURN) || on_middle {
        return long_turn(&top, axes, h_s).map(T::from_f64);
    }
    let change = short::turn_less_one(&top, t);
    // In the body frame, and added: what is small is rounded with what it is added to, once.
    let turned = axes.apply(Bivector::new(change.e23, change.e31, change.e12));
    let change = Even::new(change.s, turned.e23, turned.e31, turned.e12);
    let start = Even::from(start);
    let turned = start * change;
    // What the start lacks of unit length is given to the end: given to the start's own direction it would grow in steps of
    // more than a half turn.
    let end = start + (turned + (start + turned) * (0.5 * (1.0 - start.norm_sq())));
    Rotor::new(end.s, end.e23, end.e31, end.e12).map(T::from_f64)
}

/// Half the turn that a long step leaves to be added, rad: far more than the last place of a rotor, and so little that it
/// does not matter how well the momentum's direction is known. Its sine is itself, its cosine less 1 is `-x²/2`, to 1e-26.
const LAST_HALF_RAD: f64 = 1.0 / (1 << 21) as f64;

/// A step of any length, with the energy of its start.
///
/// The error of the energy is measured and made good. It is less than the last place of the rotor, to which nothing so small
/// can be added: so the end is made short of a turn about the momentum, on which the energy does not depend, and correction
/// and turn are added together and rounded once.
fn long_turn(top: &Top, axes: Rotor<f64>, h_s: f64) -> Rotor<f64> {
    let less_one = -0.5 * LAST_HALF_RAD * LAST_HALF_RAD;
    let plane = top.direction * -LAST_HALF_RAD;
    let short_of = Rotor::new(1.0 + less_one, -plane.e23, -plane.e31, -plane.e12) * FreeMotion::of(top, axes).at(h_s);
    let correction = top.energy_correction(short_of * axes).map(|x| -0.5 * x);
    let correction = axes.apply(Bivector::from(correction));
    let short_of = Even::from(short_of);
    let small = short_of * Even::new(0.0, correction.e23, correction.e31, correction.e12);
    let last = Even::new(less_one, plane.e23, plane.e31, plane.e12);
    let end = short_of + (last * (short_of + small) + small);
    Rotor::new(end.s, end.e23, end.e31, end.e12)
}

/// A rotor whose length is off 1 by the rounding of f32 at most, at unit length: the first step of Newton's method. Its own
/// sandwich takes the unit length for granted.
#[inline]
fn unit_again(rotor: Rotor<f64>) -> Rotor<f64> {
    let square = rotor.s * rotor.s + rotor.e23 * rotor.e23 + rotor.e31 * rotor.e31 + rotor.e12 * rotor.e12;
    let scale = 1.5 - 0.5 * square;
    Rotor::new(rotor.s * scale, rotor.e23 * scale, rotor.e31 * scale, rotor.e12 * scale)
}

/// `alpha + beta j` at unit length, as a rotor; the imaginary unit of both is k.
#[inline]
fn unit(alpha: (f64, f64), beta: (f64, f64)) -> Rotor<f64> {
    let square = alpha.0 * alpha.0 + alpha.1 * alpha.1 + (beta.0 * beta.0 + beta.1 * beta.1);
    let scale = 1.0 / square.sqrt();
    rotor_of(alpha.0 * scale, [-beta.1 * scale, beta.0 * scale, alpha.1 * scale])
}

/// `e^(i rate t)`; 1 for a phase that is not finite.
#[inline]
fn phase(rate_rad_s: f64, t_s: f64) -> (f64, f64) {
    let phase_rad = rate_rad_s * t_s;
    if !phase_rad.is_finite() {
        return (1.0, 0.0);
    }
    let (sin, cos) = Real::sin_cos(phase_rad);
    (cos, sin)
}

//! A free body in its principal frame, without units: what all forms of its motion start from.
//!
//! With `l = |L|`, the moments `I1 <= I2 <= I3` and time counted in `I1 / l`, Euler's equations of the direction
//! `u = L_body / l` are
//!
//! ```text
//! u1' = -a1 u2 u3     u2' = a2 u3 u1     u3' = -a3 u1 u2
//! a1 = I1/I2 - I1/I3     a2 = I1/I1 - I1/I3     a3 = I1/I1 - I1/I2
//! ```
//!
//! All a are taken from differences of moments, which are exact for moments that are close.

use crate::algebra::g3::{Bivector, Even, Rotor};

/// Moments that differ by less than this part are one: it is what an eigenvalue errs by, and over any time the change of
/// the attitude is that of a phase by its own rounding.
const EQUAL_MOMENTS: f64 = 4.0 * f64::EPSILON;

/// The largest turn that rounding may have to be made good for, rad. Next to the middle axis the energy hardly changes with the
/// direction, and its own rounding would ask for more.
const MOST_CORRECTION: f64 = 8.0 * f64::EPSILON;

/// Lengths whose squares, and the squares of components that matter beside them, are normal numbers.
const PLAIN_LENGTHS: core::ops::Range<f64> = 1e-130..1e150;

/// A turning body, and which way its momentum points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Top {
    /// `I1 / Ii`.
    pub(super) b: [f64; 3],
    /// The differences of `b`, none negative.
    pub(super) a: [f64; 3],
    /// `|L| / I1`, rad/s.
    pub(super) rate_rad_s: f64,
    /// The direction of the momentum in the principal frame.
    pub(super) u: [f64; 3],
    /// Principal frame to world, as given.
    pub(super) rotor: Rotor<f64>,
    /// The direction of the momentum in the world.
    pub(super) direction: Bivector<f64>,
}

impl Top {
    /// From the principal moments in ascending order, the rotor from the principal frame to the world, and the momentum
    /// in the world. `None` if it stands still: no momentum, or a body that nothing turns.
    #[inline]
    pub(super) fn new(moments: [f64; 3], rotor: Rotor<f64>, momentum: Bivector<f64>) -> Option<Self> {
        let [i1, i2, i3] = moments;
        let (length, direction) = length_and_direction(momentum)?;
        let rate_rad_s = length / i1;
        if !(rate_rad_s > 0.0 && i1 > 0.0) {
            return None;
        }
        let (b2, b3) = (i1 / i2, i1 / i3);
        let difference = |larger: f64, smaller: f64| {
            let part = (larger - smaller) / larger;
            if part <= EQUAL_MOMENTS { 0.0 } else { part }
        };
        let a = [b2 * difference(i3, i2), difference(i3, i1), difference(i2, i1)];
        Some(Self { b: [1.0, b2, b3], a, rate_rad_s, u: seen_from(rotor, direction), rotor, direction })
    }

    /// The small turn of the body, as an axial vector in the principal frame, that gives a rotor near the end of a motion the
    /// energy of its start.
    ///
    /// Rounding alone would leave an error of a few eps that need not be as often up as down: over a million steps it would add
    /// up. The energy is `b3 + P` and `b1 - Q`, of which the smaller part loses no digits:
    ///
    /// ```text
    /// P = a2 u1² + a1 u2²     Q = a3 u2² + a2 u3²     P' = c . (grad P x u)
    /// ```
    pub(super) fn energy_correction(&self, end: Rotor<f64>) -> [f64; 3] {
        let [a1, a2, a3] = self.a;
        let [s1, s2, s3] = self.u.map(|x| x * x);
        let (p, q) = (a2 * s1 + a1 * s2, a3 * s2 + a2 * s3);
        let (form, start) = if p < q { ([a2, a1, 0.0], p) } else { ([0.0, a3, a2], q) };
        let u = seen_from(end, self.direction);
        let slope = [2.0 * form[0] * u[0], 2.0 * form[1] * u[1], 2.0 * form[2] * u[2]];
        let excess = 0.5 * (slope[0] * u[0] + slope[1] * u[1] + slope[2] * u[2]) - start;
        let turn =
            [slope[1] * u[2] - slope[2] * u[1], slope[2] * u[0] - slope[0] * u[2], slope[0] * u[1] - slope[1] * u[0]];
        let steep_sq = turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2];
        if excess * excess < MOST_CORRECTION * MOST_CORRECTION * steep_sq {
            turn.map(|x| -x * (excess / steep_sq))
        } else {
            [0.0; 3]
        }
    }

    /// The body axis that the momentum is nearest to.
    pub(super) fn nearest_axis(&self) -> usize {
        largest(self.u)
    }
}

/// A world direction in the frame of a rotor, which may be off unit length by the rounding of f32 at most: its own sandwich
/// takes the length for granted, and `2 - R ~R` is as good as a quotient.
#[inline]
fn seen_from(rotor: Rotor<f64>, direction: Bivector<f64>) -> [f64; 3] {
    let as_given = Even::from(rotor);
    let u = as_given.rev() * direction * as_given;
    let scale = 2.0 - as_given.norm_sq();
    [u.e23 * scale, u.e31 * scale, u.e12 * scale]
}

/// The index of the number with the largest absolute value.
#[inline]
pub(super) fn largest(x: [f64; 3]) -> usize {
    let [x0, x1, x2] = x.map(f64::abs);
    if x0 >= x1 && x0 >= x2 {
        0
    } else if x1 >= x2 {
        1
    } else {
        2
    }
}

/// The rotor with the axial vector of a quaternion's imaginary part: `w + x i + y j + z k` is `w - x e23 - y e31 - z e12`.
#[inline]
pub(super) fn rotor(w: f64, [x, y, z]: [f64; 3]) -> Rotor<f64> {
    Rotor::new(w, -x, -y, -z)
}

/// Likewise, not of unit length.
#[inline]
pub(super) fn even(w: f64, [x, y, z]: [f64; 3]) -> Even<f64> {
    Even::new(w, -x, -y, -z)
}

/// The length, and the unit bivector along it; `None` for none.
#[inline]
fn length_and_direction(momentum: Bivector<f64>) -> Option<(f64, Bivector<f64>)> {
    let length = |b: Bivector<f64>| (b.e23 * b.e23 + b.e31 * b.e31 + b.e12 * b.e12).sqrt();
    let scaled = |b: Bivector<f64>, scale: f64| Bivector::new(b.e23 * scale, b.e31 * scale, b.e12 * scale);
    let plain = length(momentum);
    if PLAIN_LENGTHS.contains(&plain) {
        return Some((plain, scaled(momentum, 1.0 / plain)));
    }
    let largest = momentum.e23.abs().max(momentum.e31.abs()).max(momentum.e12.abs());
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    // By quotients: the reciprocal of a subnormal number may overflow.
    let momentum = Bivector::new(momentum.e23 / largest, momentum.e31 / largest, momentum.e12 / largest);
    let length = length(momentum);
    Some((largest * length, scaled(momentum, 1.0 / length)))
}

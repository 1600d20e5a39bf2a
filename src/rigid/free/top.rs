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
        // The rotor may be off unit length, by the rounding of f32 at most: its own sandwich takes the length for granted,
        // and `2 - R ~R` is as good as a quotient.
        let rotor_as_given = Even::from(rotor);
        let u = rotor_as_given.rev() * direction * rotor_as_given;
        let scale = 2.0 - rotor_as_given.norm_sq();
        Some(Self { b: [1.0, b2, b3], a, rate_rad_s, u: [u.e23 * scale, u.e31 * scale, u.e12 * scale], rotor })
    }

    /// The body axis that the momentum is nearest to.
    pub(super) fn nearest_axis(&self) -> usize {
        largest(self.u)
    }
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

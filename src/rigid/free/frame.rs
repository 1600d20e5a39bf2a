//! The frame in which a free body's momentum is `(A cn, s B sn, C dn)` with s = 1 or -1, and what is constant in it.
//!
//! Which axis is z, that of dn, follows from the sign of `a1 u3² - a3 u1²`: the largest moment's if positive, the
//! smallest's if negative. y is the middle one's. With `ux, uz >= 0` (half turns see to it)
//!
//! ```text
//! W = ay ux² + ax uy²     V = az uy² + ay uz²     S = ax uz² - az ux²      ax = |1/Iy - 1/Iz| I1, and so on; ay = ax + az
//! A² = W/ay     B² = W/ax     C² = V/ay     k² = az W / (ax V)     k'² = ay S / (ax V)
//! tau = l / I1 sqrt(ax V) t
//! ```
//!
//! Only S is a difference. What it loses near the separatrix, S = 0, no formula holds: the last bit of u moves the time of
//! the next flip by as much.

use super::top::{Top, rotor};
use crate::algebra::g3::Rotor;
use core::f64::consts::FRAC_1_SQRT_2;

/// What is constant, in the frame of the case.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Principal frame to this one.
    pub(super) from_principal: Rotor<f64>,
    /// s: 1 if z is the axis of the largest moment, else -1.
    pub(super) sense: f64,
    /// The direction of the momentum here.
    pub(super) u: [f64; 3],
    /// ax, ay, az.
    pub(super) a: [f64; 3],
    /// A, B, C.
    pub(super) amplitudes: [f64; 3],
    /// k and k'.
    pub(super) modulus: (f64, f64),
    /// The difference of the terms of S by the larger one: how far the separatrix is.
    pub(super) off_separatrix: f64,
    /// d tau / dt, rad/s.
    pub(super) lambda_rad_s: f64,
    /// The rate of the phase about z in the shortest-arc frame, `psi' = (omega.u + omega.z) / (1 + u.z)`, at `sn = 0`, rad/s.
    pub(super) phase_rad_s: f64,
}

/// The half turn that exchanges axis `z` with the third, and turns over what is left; none for the third.
pub(super) fn exchange(z: usize, u: [f64; 3]) -> (Rotor<f64>, [f64; 3]) {
    let half = FRAC_1_SQRT_2;
    match z {
        0 => (rotor(0.0, [half, 0.0, half]), [u[2], -u[1], u[0]]),
        1 => (rotor(0.0, [0.0, half, half]), [-u[0], u[2], u[1]]),
        _ => (Rotor::default(), u),
    }
}

/// The half turn about a coordinate axis that makes z, and if it can be x, not negative.
pub(super) fn upright(u: [f64; 3]) -> (Rotor<f64>, [f64; 3]) {
    match (u[0] < 0.0, u[2] < 0.0) {
        (false, false) => (Rotor::default(), u),
        (true, false) => (rotor(0.0, [0.0, 0.0, 1.0]), [-u[0], -u[1], u[2]]),
        (false, true) => (rotor(0.0, [1.0, 0.0, 0.0]), [u[0], -u[1], -u[2]]),
        (true, true) => (rotor(0.0, [0.0, 1.0, 0.0]), [-u[0], u[1], -u[2]]),
    }
}

impl Frame {
    /// Of a body that is no sphere and does not spin about one axis.
    pub(super) fn new(top: &Top) -> Self {
        let [a1, a2, a3] = top.a;
        let about_largest = {
            let (largest, smallest) = (a1.sqrt() * top.u[2].abs(), a3.sqrt() * top.u[0].abs());
            // At equality both will do, but a symmetric body has one axis only.
            largest > smallest || (largest == smallest && a1 > 0.0)
        };
        let (z, sense, a) = if about_largest { (2, 1.0, [a1, a2, a3]) } else { (0, -1.0, [a3, a2, a1]) };
        let (exchanged, u) = exchange(z, top.u);
        let (turned, u) = upright(u);
        let [ax, ay, az] = a;
        let [ux, uy, uz] = u;
        let (w, v) = (ay * ux * ux + ax * uy * uy, az * uy * uy + ay * uz * uz);
        let amplitudes = [(w / ay).sqrt(), (w / ax).sqrt(), (v / ay).sqrt()];
        let (plus, minus) = (ax.sqrt() * uz, az.sqrt() * ux);
        let difference = (plus - minus).max(0.0);
        let modulus = if az > 0.0 {
            // Of the factors of S, not of S, which would underflow.
            let complement = (ay / (ax * v)).sqrt() * difference.sqrt() * (plus + minus).sqrt();
            ((az * w / (ax * v)).sqrt(), complement.min(1.0))
        } else {
            (0.0, 1.0)
        };
        let rate = top.rate_rad_s;
        // At uy = 0, as sums of what is positive.
        let phase = if about_largest { top.b[2] + w / (1.0 + amplitudes[2]) } else { top.b[2] + a2 * amplitudes[2] };
        Self {
            from_principal: turned * exchanged,
            sense,
            u,
            a,
            amplitudes,
            modulus,
            off_separatrix: difference / plus,
            lambda_rad_s: rate * (ax * v).sqrt(),
            phase_rad_s: rate * phase,
        }
    }

    /// sn and cn at the start.
    pub(super) fn start(&self) -> (f64, f64) {
        let ([a, b, _], [ux, uy, _]) = (self.amplitudes, self.u);
        if a > 0.0 { (self.sense * uy / b, ux / a) } else { (0.0, 1.0) }
    }
}

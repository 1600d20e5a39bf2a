//! The free motion near the separatrix and on it: the series of `trigonometric`, transformed (Jacobi's imaginary
//! transformation, DLMF 20.7.30 to 20.7.33), in hyperbolic functions.
//!
//! ```text
//! X = pi tau / 4K'     Y = pi y / 4K'     p = e^(-pi K / 2K')
//! alpha ~ theta2(iX + Y | p) e^(i nu t)     beta ~ -r i theta1(iX + Y | p) e^(i nu t)
//! ```
//!
//! in the cell `|X| <= X(K)`; from one cell to the next the phase goes on by -2Y and beta changes sign. On the
//! separatrix p = 0, and there is one cell. With `w = e^(-2X)` and `g = p²/w`, neither above 1, for X >= 0
//!
//! ```text
//! M = e^(-iY) + p² w² e^(3iY) + p² g² e^(-5iY)     N = w e^(iY) + g e^(-3iY) + p^6 w³ e^(5iY) + p^6 g³ e^(-7iY)
//! theta2 ~ M + N     i theta1 ~ i (M - N)
//! ```
//!
//! and the conjugates for X < 0. At p = e^-pi, where this series takes over, the terms left out are below 1e-16.

use super::frame::Frame;
use super::landen::{Landen, nome_over_square};
use super::phase;
use super::trigonometric::{add, times};
use crate::algebra::Real;

/// Series in exponentials.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hyperbolic {
    /// X at the start.
    start: f64,
    /// dX/dt, 1/s.
    x_per_s: f64,
    /// `2 X(K)`, infinite on the separatrix.
    cell: f64,
    /// nu, rad/s.
    nu_rad_s: f64,
    /// r
    ratio: f64,
    p: f64,
    /// `e^(-iY)` to the powers 1, 3, 5, 7.
    powers: [(f64, f64); 4],
    /// 2Y.
    jump: f64,
}

impl Hyperbolic {
    pub(super) fn new(frame: &Frame) -> Self {
        let (k, k_complement) = frame.modulus;
        let landen = Landen::new(k_complement, k);
        let p = k_complement * nome_over_square(k_complement, k).sqrt();
        let ([ax, ay, az], [_, b, c]) = (frame.a, frame.amplitudes);
        let (sin_2y, cos_2y) = landen.circular((ax / ay).sqrt(), (az / ay).sqrt());
        let jump = Real::atan2(sin_2y, cos_2y);
        // Y is at most pi/4.
        let cos_y = (0.5 + 0.5 * cos_2y).sqrt();
        let one = (cos_y, -0.5 * sin_2y / cos_y);
        let two = (cos_2y, -sin_2y);
        let three = times(one, two);
        let five = times(three, two);
        let (p2, p6) = (p * p, p * p * p * p * p * p);
        // r at v = pi/2, where dn = k'.
        let (cos_4y, p4) = (cos_2y * cos_2y - sin_2y * sin_2y, p2 * p2);
        let cos_6y = cos_2y * (2.0 * cos_4y - 1.0);
        let (even, odd) = (1.0 + 2.0 * p4 * cos_4y, 2.0 * p * (cos_2y + p4 * p4 * cos_6y));
        let ratio = b / (1.0 + c * k_complement) * ((even + odd) / (even - odd));
        let x_per_s = frame.sense * frame.lambda_rad_s / (2.0 * landen.quarter);
        // d arg(alpha) / dX at X = 0, where the phase's rate is known.
        let turn = (one.1 + 3.0 * p2 * three.1 + 5.0 * p6 * five.1) / (one.0 + p2 * three.0 + p6 * five.0);
        let (sn, cn) = frame.start();
        Self {
            start: 0.5 * frame.sense * Real::asinh(landen.hyperbolic(sn, cn)),
            x_per_s,
            cell: if p > 0.0 { -Real::ln(p) } else { f64::INFINITY },
            nu_rad_s: 0.5 * frame.phase_rad_s - x_per_s * turn,
            ratio,
            p,
            powers: [one, three, five, times(five, two)],
            jump,
        }
    }

    /// alpha and beta at a time from the start, of any length but zero.
    #[inline]
    pub(super) fn at(&self, t_s: f64) -> [(f64, f64); 2] {
        let x = self.start + self.x_per_s * t_s;
        let cells = if x.is_finite() { (x / self.cell).round() } else { 0.0 };
        let x = if cells == 0.0 { x } else { x - cells * self.cell };
        let w = Real::exp(-2.0 * x.abs());
        // Neither may be 0/0 where an exponential has underflown.
        let g = if w > 0.0 { self.p * (self.p / w) } else { 0.0 };
        let (p2, p6) = (self.p * self.p, self.p * self.p * self.p * self.p * self.p * self.p);
        let [y1, y3, y5, y7] = self.powers;
        let (w2, g2) = (p2 * w * w, p2 * g * g);
        let (w3, g3) = (p6 * w * w * w, p6 * g * g * g);
        let m = (y1.0 + w2 * y3.0 + g2 * y5.0, y1.1 - w2 * y3.1 + g2 * y5.1);
        let n = (w * y1.0 + g * y3.0 + w3 * y5.0 + g3 * y7.0, -w * y1.1 + g * y3.1 - w3 * y5.1 + g3 * y7.1);
        let alpha = add(m, n);
        // i (M - N)
        let beta = (n.1 - m.1, m.0 - n.0);
        let mirror = if x < 0.0 { -1.0 } else { 1.0 };
        let parity = if cells % 2.0 == 0.0 { -self.ratio } else { self.ratio };
        let turn = phase(self.nu_rad_s, t_s);
        let turn = if cells == 0.0 { turn } else { times(turn, phase(-self.jump, cells)) };
        let beta = times((beta.0, mirror * beta.1), turn);
        [times((alpha.0, mirror * alpha.1), turn), (parity * beta.0, parity * beta.1)]
    }
}

//! The free motion away from the separatrix, as trigonometric series; uniform and symmetric motions are their first terms.
//!
//! The rotor from the frame of `frame` to one with the momentum along z has the Cayley-Klein parameters (Jacobi 1850;
//! Klein and Sommerfeld 1897, VI; in this form derived from `1 + C dn = 2 |alpha|²`)
//!
//! ```text
//! alpha = n theta4(v - i b | q²) e^(i mu t)     beta = -n r theta1(v - i b | q²) e^(i mu t)     v = s pi tau / 2K
//! ```
//!
//! where n makes it unit, r is real, and `b = pi y / 2K` with `sn(y, k') = sqrt(ax/ay)`: the zeros of `1 + C dn` and
//! `1 - C dn` are those of theta4 and theta1. It is smooth wherever `uz > -1`, so the phase of alpha, half that of the
//! shortest-arc frame, is well-conditioned, also where the momentum passes the axis. mu follows from its rate at v = 0. In
//! `z = e^(iv)`, `E = e^(-2b)` and `G = q / E`, none above 1,
//!
//! ```text
//! theta4 ~ 1 - q G z² - q² E z^-2 + q^6 G² z^4 + q^8 E² z^-4 - q^15 G³ z^6 - q^18 E³ z^-6
//! theta1 ~ z - E z^-1 - q³ G z³ + q^4 E² z^-3 + q^10 G² z^5 - q^12 E³ z^-5 - q^21 G³ z^7
//! ```
//!
//! At the nome where the other series takes over, q = e^(-pi/2), the terms left out are below 1e-16.

use super::frame::Frame;
use super::landen::{Landen, nome_over_square};
use super::phase;

/// Series in the cosines and sines of multiples of v.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trigonometric {
    /// `e^(iv)` at the start.
    start: (f64, f64),
    /// dv/dt, rad/s.
    v_rad_s: f64,
    /// mu, rad/s.
    mu_rad_s: f64,
    /// r
    ratio: f64,
    /// Of alpha: cosines and sines of 2v, 4v, 6v.
    even: [(f64, f64); 3],
    /// Of beta: cosines and sines of v, 3v, 5v, 7v.
    odd: [(f64, f64); 4],
}

impl Trigonometric {
    pub(super) fn new(frame: &Frame) -> Self {
        let (k, k_complement) = frame.modulus;
        let landen = Landen::new(k, k_complement);
        let (k1, k1_complement) = landen.first;
        let q = k1 * nome_over_square(k1, k1_complement).sqrt();
        let (e, g) = shift(frame, &landen, q);
        let [q2, q3, q4] = [q * q, q * q * q, q * q * q * q];
        let (q6, q8) = (q3 * q3, q4 * q4);
        let above = [-q * g, q6 * g * g, -q6 * q6 * q3 * g * g * g];
        let below = [-q2 * e, q8 * e * e, -q8 * q8 * q2 * e * e * e];
        let odd_above = [1.0, -q3 * g, q4 * q6 * g * g, -q8 * q8 * q4 * q * g * g * g];
        let odd_below = [-e, q4 * e * e, -q6 * q6 * e * e * e, 0.0];
        let [_, b, c] = frame.amplitudes;
        // At v = pi/2, where dn = k' and all terms of the one series have one sign, and all of the other.
        let quarter = 1.0 - above[0] - below[0] + above[1] + below[1] - above[2] - below[2];
        let odd_quarter: f64 = odd_above.iter().chain(&odd_below).map(|x| x.abs()).sum();
        let ratio = b / (1.0 + c * k_complement) * (quarter / odd_quarter);
        let v_rad_s = frame.sense * frame.lambda_rad_s / landen.quarter;
        // d arg(alpha) / dv at v = 0, where the phase's rate is known.
        let turn = [2.0, 4.0, 6.0].iter().zip(above.iter().zip(&below)).map(|(m, (a, b))| m * (a - b)).sum::<f64>();
        let sum = 1.0 + above.iter().zip(&below).map(|(a, b)| a + b).sum::<f64>();
        let (sn, cn) = frame.start();
        let (sin, cos) = landen.circular(sn, cn);
        Self {
            start: (cos, frame.sense * sin),
            v_rad_s,
            mu_rad_s: 0.5 * frame.phase_rad_s - v_rad_s * (turn / sum),
            ratio,
            even: core::array::from_fn(|i| (above[i] + below[i], above[i] - below[i])),
            odd: core::array::from_fn(|i| (odd_above[i] + odd_below[i], odd_above[i] - odd_below[i])),
        }
    }

    /// A momentum that stays where it is in the body, on z.
    pub(super) fn uniform(phase_rad_s: f64) -> Self {
        let none = (0.0, 0.0);
        Self {
            start: (1.0, 0.0),
            v_rad_s: 0.0,
            mu_rad_s: 0.5 * phase_rad_s,
            ratio: 0.0,
            even: [none; 3],
            odd: [none; 4],
        }
    }

    /// alpha and beta at a time from the start, of any length but zero.
    #[inline]
    pub(super) fn at(&self, t_s: f64) -> [(f64, f64); 2] {
        let z = times(self.start, phase(self.v_rad_s, t_s));
        let z2 = square(z);
        let z4 = square(z2);
        let (z3, z6) = (times(z2, z), times(z4, z2));
        let (z5, z7) = (times(z4, z), times(z4, z3));
        let term = |(c, s): (f64, f64), z: (f64, f64)| (c * z.0, s * z.1);
        let [e2, e4, e6] = self.even;
        let [o1, o3, o5, o7] = self.odd;
        let alpha = add(add((1.0, 0.0), term(e2, z2)), add(term(e4, z4), term(e6, z6)));
        let beta = add(add(term(o1, z), term(o3, z3)), add(term(o5, z5), term(o7, z7)));
        let turn = phase(self.mu_rad_s, t_s);
        let beta = times(beta, turn);
        [times(alpha, turn), (-self.ratio * beta.0, -self.ratio * beta.1)]
    }
}

/// E and G, from `sc(y, k') = sqrt(ax/az)` and `sc(K' - y, k') = C/A`, of which the smaller is at most `1/sqrt(k)`.
fn shift(frame: &Frame, landen: &Landen, q: f64) -> (f64, f64) {
    let ([ax, _, az], [a, _, c]) = (frame.a, frame.amplitudes);
    let (ax, az) = (ax.sqrt(), az.sqrt());
    let of = |sinh: f64| {
        let exp = sinh + (1.0 + sinh * sinh).sqrt();
        1.0 / (exp * exp)
    };
    if ax * a <= c * az {
        let e = of(landen.hyperbolic(ax, az));
        (e, q / e)
    } else {
        let g = of(landen.hyperbolic(c, a));
        (if q > 0.0 { q / g } else { 0.0 }, g)
    }
}

/// The product of complex numbers.
#[inline]
pub(super) fn times(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

/// The sum of complex numbers.
#[inline]
pub(super) fn add(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (a.0 + b.0, a.1 + b.1)
}

#[inline]
fn square(a: (f64, f64)) -> (f64, f64) {
    (a.0 * a.0 - a.1 * a.1, 2.0 * a.0 * a.1)
}

//! A short step of the free motion from any state, without elliptic integrals.
//!
//! The functions of the step alone, `S = sn(h)`, c, d with `S' = c d`, `c² = 1 - e1 S²`, `d² = 1 - e2 S²`, are Maclaurin
//! series; Jacobi's addition theorem, which needs no case here, gives the direction of the momentum in the body at half the
//! step, m, and at its end. So energy and |L| are kept to rounding whatever the step.
//!
//! The rotor D of the whole step takes the end's direction to the start's, `D u(h) ~D = u(0)`, which leaves one number to
//! find: its components are `w : k1 m1 : k2 m2 : k3 m3` with (S, c, d of half the step)
//!
//! ```text
//! k2 - k3 c = a1 S w     k1 d - k3 c = a2 S w     k1 d - k2 = a3 S w
//! ```
//!
//! The last is the phase about the body axis next to m, `psi' = (omega.u + omega.z) / (1 + u.z)`, integrated by a
//! formula of order 10 from its values and derivatives at the start, at half the step, and at the end.
//!
//! D is returned as what it differs from 1 by, so that a small turn is rounded once, when it is added to the rotor.

use super::top::{Top, even, largest};
use crate::algebra::Real;
use crate::algebra::g3::Even;

/// The longest step, in units of `I1 / (a2 l)`: the phase of the momentum's own motion in the body, at most. The series for
/// sn then errs by `0.0015 (x/2)^14`, the integral by `0.014 (x/6)^10`, both less than rounding.
pub(super) const LONGEST: f64 = 0.2;

/// The largest step in units of `I1 / l`, of which a body of almost equal moments may take many: its powers do not overflow.
pub(super) const MOST_TURN: f64 = 1e70;

/// `D - 1`, in the principal frame, of a step of `t` in units of `I1 / l`.
pub(super) fn turn_less_one(top: &Top, t: f64) -> Even<f64> {
    let ([a1, a2, a3], u) = (top.a, top.u);
    let g = 0.5 * t;
    let e1 = a1 * (a3 * u[1] * u[1] + a2 * u[2] * u[2]);
    let e2 = a3 * (a2 * u[0] * u[0] + a1 * u[1] * u[1]);
    let s = sn(e1, e2, g);
    let (c, d) = ((1.0 - e1 * s * s).sqrt(), (1.0 - e2 * s * s).sqrt());
    let pole = a1 * a3 * s * s;
    let scale = 1.0 / (1.0 - pole * u[1] * u[1]);
    let m = [
        (u[0] * c - a1 * u[1] * u[2] * s * d) * scale,
        (u[1] * c * d + a2 * u[2] * u[0] * s) * scale,
        (u[2] * d - a3 * u[0] * u[1] * s * c) * scale,
    ];
    let change = 2.0 * s / (1.0 - pole * m[1] * m[1]);
    let delta = [-a1 * m[1] * m[2] * d * change, a2 * m[2] * m[0] * change, -a3 * m[0] * m[1] * c * change];
    let p = largest(m);
    let (w, k) = about(top, p, [u, m, [u[0] + delta[0], u[1] + delta[1], u[2] + delta[2]]], delta, t);
    let sw = s * w;
    let k = match p {
        0 => [k, k * d - a3 * sw, (k * d - a2 * sw) / c],
        1 => [(k + a3 * sw) / d, k, (k - a1 * sw) / c],
        _ => [(k * c + a2 * sw) / d, k * c + a1 * sw, k],
    };
    let v = [k[0] * m[0], k[1] * m[1], k[2] * m[2]];
    let v2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    let n = (w * w + v2).sqrt();
    let scale = 1.0 / n;
    // w/n - 1, which cancels for a small turn.
    let less_one = if w > 0.0 { -v2 * scale / (n + w) } else { w * scale - 1.0 };
    even(less_one, v.map(|x| x * scale))
}

/// The scalar part of D, and its k about the axis p, both times one factor.
fn about(top: &Top, p: usize, [u0, m, u1]: [[f64; 3]; 3], delta: [f64; 3], t: f64) -> (f64, f64) {
    let (j, k) = ((p + 1) % 3, (p + 2) % 3);
    let signed = [top.a[0], -top.a[1], top.a[2]];
    let (ap, aj, ak) = (signed[p], signed[j], signed[k]);
    let sign = if m[p] < 0.0 { -1.0 } else { 1.0 };
    let [z0, z, z1] = [sign * u0[p], sign * m[p], sign * u1[p]];
    let [f0, f, f1] = [1.0 / (1.0 + z0), 1.0 / (1.0 + z), 1.0 / (1.0 + z1)];
    // z' = -ap uj uk, and u' likewise in it.
    let first = |u: &[f64; 3]| -sign * ap * u[j] * u[k];
    let second = |u: &[f64; 3], z: f64| z * ap * (aj * u[k] * u[k] + ak * u[j] * u[j]);
    let (d0, d1) = (first(&u0), first(&u1));
    let bend = |d: f64, dd: f64, f: f64| (2.0 * d * d * f - dd) * f * f;
    let (b0, b, b1) = (bend(d0, second(&u0, z0), f0), bend(first(&m), second(&m, z), f), bend(d1, second(&u1, z1), f1));
    let g = 0.5 * t;
    // The moments of 1, x², .. x^8 over -g .. g from f and f'' at the middle, f, f' and f'' at the ends.
    let sum = 128.0 / 105.0 * f
        + 41.0 / 105.0 * (f0 + f1)
        + g * (2.0 / 35.0 * (d1 * f1 * f1 - d0 * f0 * f0) + g / 315.0 * (b0 + b1 + 16.0 * b));
    // 2E I1/l² - bp
    let excess = aj * u0[k] * u0[k] - ak * u0[j] * u0[j];
    let (sin, cos) = Real::sin_cos(0.5 * (t * top.b[p] + excess * g * sum));
    let less = 0.5 * (delta[0] * delta[0] + delta[1] * delta[1] + delta[2] * delta[2]);
    let (plus, minus) = (2.0 + z0 + z1 - less, z0 + z1 + 2.0 * z0 * z1 + less);
    let cross = -sign * (u0[j] * delta[k] - u0[k] * delta[j]);
    ((cos * plus + sin * cross) * z, sin * minus + cos * cross)
}

/// The Maclaurin series of `S' = c d`: those of sn (Abramowitz and Stegun, 16.22.1) with `e1 = 1`, `e2 = k²`, made
/// homogeneous, in their sum and product.
#[inline]
fn sn(e1: f64, e2: f64, h: f64) -> f64 {
    let (s, p) = ((e1 + e2) * h * h, e1 * e2 * h * h * h * h);
    let c2 = s * s + 12.0 * p;
    let c3 = s * (s * s + 132.0 * p);
    let c4 = s * s * (s * s + 1224.0 * p) + 3024.0 * p * p;
    let c5 = s * (s * s * (s * s + 11_064.0 * p) + 132_624.0 * p * p);
    let c6 = s * s * (s * s * (s * s + 99_636.0 * p) + 4_095_792.0 * p * p) + 4_390_848.0 * p * p * p;
    h * (1.0 - s / 6.0 + c2 / 120.0 - c3 / 5040.0 + c4 / 362_880.0 - c5 / 39_916_800.0 + c6 / 6_227_020_800.0)
}

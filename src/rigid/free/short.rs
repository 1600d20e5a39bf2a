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

/// `(e1 + e2) h²` below which four terms of sn are enough: the fifth is at most 0.0014 of its fourth power.
const FOUR_TERMS: f64 = 3e-4;

/// `D - 1`, in the principal frame, of a step of `t` in units of `I1 / l`.
#[inline]
pub(super) fn turn_less_one(top: &Top, t: f64) -> Even<f64> {
    let ([a1, a2, a3], u) = (top.a, top.u);
    let e1 = a1 * (a3 * u[1] * u[1] + a2 * u[2] * u[2]);
    let e2 = a3 * (a2 * u[0] * u[0] + a1 * u[1] * u[1]);
    let s = sn(e1, e2, 0.5 * t);
    let (c, d) = ((1.0 - e1 * s * s).sqrt(), (1.0 - e2 * s * s).sqrt());
    // m times the denominator of the addition theorem.
    let pole = a1 * a3 * s * s;
    let below = 1.0 - pole * u[1] * u[1];
    let above =
        [u[0] * c - a1 * u[1] * u[2] * s * d, u[1] * c * d + a2 * u[2] * u[0] * s, u[2] * d - a3 * u[0] * u[1] * s * c];
    // From m to the end and from m to the start differ by the odd terms of the theorem.
    let change = 2.0 * s / (below * below - pole * above[1] * above[1]);
    let [x, y, z] = above;
    let delta = [-a1 * d * (y * z) * change, a2 * (z * x) * change, -a3 * c * (x * y) * change];
    let scale = 1.0 / below;
    let m = above.map(|x| x * scale);
    let (w, k) = match largest(above) {
        0 => {
            let (w, k) = about::<0>(top, m, delta, t);
            (w, [k, k * d - a3 * s * w, (k * d - a2 * s * w) / c])
        }
        1 => {
            let (w, k) = about::<1>(top, m, delta, t);
            (w, [(k + a3 * s * w) / d, k, (k - a1 * s * w) / c])
        }
        _ => {
            let (w, k) = about::<2>(top, m, delta, t);
            (w, [(k * c + a2 * s * w) / d, k * c + a1 * s * w, k])
        }
    };
    let v = [k[0] * m[0], k[1] * m[1], k[2] * m[2]];
    // w - 1, which cancels for a small turn.
    let less_one = if w > 0.0 { -(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / (1.0 + w) } else { w - 1.0 };
    even(less_one, v)
}

/// w and kp of D, with p the largest component of m, known to the compiler.
#[inline]
fn about<const P: usize>(top: &Top, m: [f64; 3], delta: [f64; 3], t: f64) -> (f64, f64) {
    let (p, j, k) = (P, (P + 1) % 3, (P + 2) % 3);
    let (start, end) = (top.u, [top.u[0] + delta[0], top.u[1] + delta[1], top.u[2] + delta[2]]);
    let signed = [top.a[0], -top.a[1], top.a[2]];
    let (ap, aj, ak) = (signed[p], signed[j], signed[k]);
    let sign = if m[p] < 0.0 { -1.0 } else { 1.0 };
    let [z0, z, z1] = [sign * start[p], sign * m[p], sign * end[p]];
    let [f0, f, f1] = [1.0 / (1.0 + z0), 1.0 / (1.0 + z), 1.0 / (1.0 + z1)];
    // z' = -ap uj uk, and u' likewise in it.
    let first = |u: &[f64; 3]| -sign * ap * u[j] * u[k];
    let second = |u: &[f64; 3], z: f64| z * ap * (aj * u[k] * u[k] + ak * u[j] * u[j]);
    let (d0, d1) = (first(&start), first(&end));
    let bend = |d: f64, dd: f64, f: f64| (2.0 * d * d * f - dd) * f * f;
    let ends = bend(d0, second(&start, z0), f0) + bend(d1, second(&end, z1), f1);
    let middle = bend(first(&m), second(&m, z), f);
    let g = 0.5 * t;
    // The moments of 1, x², .. x^8 over -g .. g from f and f'' at the middle, f, f' and f'' at the ends.
    let sum = 128.0 / 105.0 * f
        + 41.0 / 105.0 * (f0 + f1)
        + g * (2.0 / 35.0 * (d1 * f1 * f1 - d0 * f0 * f0) + g / 315.0 * (ends + 16.0 * middle));
    // 2E I1/l² - bp
    let excess = aj * start[k] * start[k] - ak * start[j] * start[j];
    let (sin, cos) = Real::sin_cos(0.5 * (t * top.b[p] + excess * g * sum));
    // From the shortest arcs at both ends, and the turn between them: their product, before it is made unit.
    let less = 0.5 * (delta[0] * delta[0] + delta[1] * delta[1] + delta[2] * delta[2]);
    let (plus, minus) = (2.0 + z0 + z1 - less, z0 + z1 + 2.0 * z0 * z1 + less);
    let cross = -sign * (start[j] * delta[k] - start[k] * delta[j]);
    let unit = 0.5 * (f0 * f1).sqrt();
    ((cos * plus + sin * cross) * unit, (sin * minus + cos * cross) * (unit / z))
}

/// The Maclaurin series of `S' = c d`: those of sn (Abramowitz and Stegun, 16.22.1) with `e1 = 1`, `e2 = k²`, made
/// homogeneous, in their sum and product. What is left out of short ones is below 1e-17.
#[inline]
fn sn(e1: f64, e2: f64, h: f64) -> f64 {
    let h2 = h * h;
    let (s, p) = ((e1 + e2) * h2, e1 * e2 * (h2 * h2));
    let s2 = s * s;
    let c2 = s2 + 12.0 * p;
    let c3 = s * (s2 + 132.0 * p);
    let short = 1.0 - s / 6.0 + c2 / 120.0 - c3 / 5040.0;
    if s < FOUR_TERMS {
        return h * short;
    }
    let c4 = s2 * (s2 + 1224.0 * p) + 3024.0 * p * p;
    let c5 = s * (s2 * (s2 + 11_064.0 * p) + 132_624.0 * p * p);
    let c6 = s2 * (s2 * (s2 + 99_636.0 * p) + 4_095_792.0 * p * p) + 4_390_848.0 * p * p * p;
    h * (short + (c4 / 362_880.0 - c5 / 39_916_800.0 + c6 / 6_227_020_800.0))
}

//! Descending Landen transformations: elliptic functions of a modulus as trigonometric or hyperbolic ones.
//!
//! From the modulus `k` and its complement `k'` (Abramowitz and Stegun, *Handbook of Mathematical Functions*, 16.12):
//!
//! ```text
//! k1 = (1 - k') / (1 + k')     K = (1 + k1) K1     sn(u, k) = (1 + k1) s1 / (1 + k1 s1²)     s1 = sn(u / (1 + k1), k1)
//! ```
//!
//! which is solved for `s1`, so that `pi u / 2K` is found from sn and cn of u without an inverse function; with `u = i w`
//! for `w` likewise. `k` falls quadratically: from 0.985 the fifth is 5e-11.

/// Where the moduli end. Of the last one sn differs from sin by `k² / 4`, and for the largest s that the step before leaves,
/// `1/sqrt(k)`, from sinh by the part k.
const LAST_MODULUS: f64 = 1e-16;

/// A step to a modulus below moves sine and cosine by less than eps.
const CIRCULAR_MODULUS: f64 = 0.25 * f64::EPSILON;

/// From a modulus of 0.99 six steps lead below [`LAST_MODULUS`].
const MOST_STEPS: usize = 6;

/// The moduli below one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Landen {
    moduli: [f64; MOST_STEPS],
    steps: usize,
    /// `2 K / pi`.
    pub(super) quarter: f64,
    /// The first of them, and its complement.
    pub(super) first: (f64, f64),
}

impl Landen {
    /// Of a modulus up to 0.99 and its complement.
    pub(super) fn new(k: f64, k_complement: f64) -> Self {
        let mut chain = Self { moduli: [0.0; MOST_STEPS], steps: 0, quarter: 1.0, first: (0.0, 1.0) };
        let (mut k, mut k_complement) = (k, k_complement);
        while chain.steps == 0 || (k > LAST_MODULUS && chain.steps < MOST_STEPS) {
            let scale = 1.0 / (1.0 + k_complement);
            let root = k * scale;
            (k, k_complement) = (root * root, 2.0 * k_complement.sqrt() * scale);
            if chain.steps == 0 {
                chain.first = (k, k_complement);
            }
            chain.moduli[chain.steps] = k;
            chain.steps += 1;
            chain.quarter *= 1.0 + k;
        }
        chain
    }

    /// Sine and cosine of `pi u / 2K`, from `sn(u)` and `cn(u)`.
    pub(super) fn circular(&self, sn: f64, cn: f64) -> (f64, f64) {
        let (mut s, mut c) = (sn, cn);
        for k in self.moduli[..self.steps].iter().filter(|k| **k > CIRCULAR_MODULUS) {
            let (sum, difference) = (1.0 + k, 1.0 - k);
            s = 2.0 * s / (sum + (difference * difference + 4.0 * k * c * c).sqrt());
            c *= (1.0 + k * s * s) / (1.0 - k * k * s * s).sqrt();
        }
        let scale = 1.0 / (s * s + c * c).sqrt();
        (s * scale, c * scale)
    }

    /// `sinh(pi w / 2K)`, from `sn(i w) = i s / c`; `c` may be 0 if the modulus is not.
    pub(super) fn hyperbolic(&self, s: f64, c: f64) -> f64 {
        let (mut s, mut c) = (s, c);
        for k in &self.moduli[..self.steps] {
            let sum = 1.0 + k;
            s *= 2.0;
            c = sum * c + (sum * sum * c * c + k * s * s).sqrt();
        }
        s / c
    }
}

/// The nome of a modulus up to 0.71, divided by `k²`: with `e = (1 - sqrt(k')) / (2 (1 + sqrt(k')))` it is
/// `e + 2 e^5 + 15 e^9 + 150 e^13 + ...` (Abramowitz and Stegun, 17.3.21). The next term is 1707 e^17 < 2e-20 there.
pub(super) fn nome_over_square(k: f64, k_complement: f64) -> f64 {
    let root = k_complement.sqrt();
    let over_square = 0.5 / ((1.0 + k_complement) * (1.0 + root) * (1.0 + root));
    let e = over_square * k * k;
    let e4 = (e * e) * (e * e);
    over_square * (1.0 + e4 * (2.0 + e4 * (15.0 + e4 * 150.0)))
}

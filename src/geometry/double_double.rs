//! Double-double numbers: an unevaluated sum `hi + lo` of two f64 with `|lo| <= ulp(hi)/2`, about 106 bits.
//!
//! For sums in which terms cancel, where the answer is then rounded once to f64. Sources: Dekker, *A floating-point
//! technique for extending the available precision*, 1971 (splitting, products, quotient); Knuth, TAOCP 2, 4.2.2
//! (`two_sum`); Li et al., *Design, implementation and testing of extended and mixed precision BLAS*, 2002 (the sum).
//! Products are split and not fused: without a hardware instruction a fused multiply-add is a slow library call.
//! Valid while no product leaves 1e-290 to 1e290: below, `lo` underflows; above, the splitting overflows.

use core::ops::{Add, Div, Mul, Sub};

/// `hi + lo`.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct DoubleDouble {
    /// The sum rounded to f64.
    pub(crate) hi: f64,
    /// What the rounding lost.
    pub(crate) lo: f64,
}

/// 2^27 + 1 cuts 53 bits into two halves of at most 26, whose products are exact.
const SPLITTER: f64 = 134_217_729.0;

impl DoubleDouble {
    /// `a + b` exactly.
    pub(crate) fn sum(a: f64, b: f64) -> Self {
        let hi = a + b;
        let b_part = hi - a;
        Self { hi, lo: (a - (hi - b_part)) + (b - b_part) }
    }

    /// `a b` exactly.
    pub(crate) fn product(a: f64, b: f64) -> Self {
        let ((a_hi, a_lo), (b_hi, b_lo)) = (split(a), split(b));
        let hi = a * b;
        Self { hi, lo: ((a_hi * b_hi - hi) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo }
    }

    /// `hi + lo` exactly, for `|hi| >= |lo|`.
    fn ordered_sum(hi: f64, lo: f64) -> Self {
        let sum = hi + lo;
        Self { hi: sum, lo: lo - (sum - hi) }
    }
}

fn split(a: f64) -> (f64, f64) {
    let scaled = SPLITTER * a;
    let hi = scaled - (scaled - a);
    (hi, a - hi)
}

impl From<f64> for DoubleDouble {
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    /// Relative error at most 3 * 2^-106, whatever the signs.
    fn add(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.hi, other.hi), Self::sum(self.lo, other.lo));
        let high = Self::ordered_sum(high.hi, high.lo + low.hi);
        Self::ordered_sum(high.hi, high.lo + low.lo)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + Self { hi: -other.hi, lo: -other.lo }
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.hi, other.hi);
        Self::ordered_sum(product.hi, product.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Mul<f64> for DoubleDouble {
    type Output = Self;
    fn mul(self, other: f64) -> Self {
        let product = Self::product(self.hi, other);
        Self::ordered_sum(product.hi, product.lo + self.lo * other)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let quotient = self.hi / other.hi;
        let rest = self - other * quotient;
        Self::ordered_sum(quotient, rest.hi / other.hi)
    }
}

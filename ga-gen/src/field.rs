//! Fingerprints: values of a scalar expression at random points of a prime field.
//!
//! Whether a coefficient is identically zero, constant, or equal to another one is decided by evaluating it at
//! [`POINTS`] random points modulo the Mersenne prime 2^61 - 1 (Schwartz 1980, Zippel 1979): two different
//! expressions of degree d agree at one point with probability at most d / 2^61, at both with less than 1e-33 for
//! every expression met here. Inputs of unit types are drawn from the unit versors themselves (see `spec`), so
//! identities that hold *because* a versor is unit are seen as well. The points come from a fixed generator: the same
//! source gives the same code, always.

use crate::scalar::Rational;

/// 2^61 - 1.
const PRIME: u128 = (1 << 61) - 1;

/// The largest numerator of a constant that is recognised. A random residue is taken for one with probability 1e-15 at
/// one point.
const LARGEST_CONSTANT: u64 = 64;

/// Number of random points in a fingerprint.
pub const POINTS: usize = 2;

/// An element of the prime field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Residue(u64);

#[expect(clippy::cast_possible_truncation, reason = "both parts are below 2^61 by their masks")]
fn reduce(value: u128) -> Residue {
    // 2^61 = 1 modulo the prime: fold the high bits once, then subtract at most once.
    const SHORT: u64 = PRIME as u64;
    let folded = (value as u64 & SHORT) + (value >> 61) as u64;
    let folded = (folded & SHORT) + (folded >> 61);
    Residue(if folded >= SHORT { folded - SHORT } else { folded })
}

impl Residue {
    /// 0.
    pub const ZERO: Self = Self(0);
    /// 1.
    pub const ONE: Self = Self(1);

    /// Sum.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        reduce(u128::from(self.0) + u128::from(other.0))
    }

    /// Product.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        reduce(u128::from(self.0) * u128::from(other.0))
    }

    /// Additive inverse.
    #[must_use]
    pub fn negated(self) -> Self {
        reduce(PRIME - u128::from(self.0))
    }

    fn power(self, mut exponent: u128) -> Self {
        let (mut base, mut result) = (self, Self::ONE);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = result.times(base);
            }
            base = base.times(base);
            exponent >>= 1;
        }
        result
    }

    /// Multiplicative inverse by Euclid's algorithm; 0 maps to 0.
    #[must_use]
    pub fn inverse(self) -> Self {
        // r = (something) * PRIME + t * self throughout.
        let (mut r, mut next_r) = (PRIME.cast_signed(), i128::from(self.0));
        let (mut t, mut next_t) = (0_i128, 1_i128);
        while next_r != 0 {
            let quotient = r / next_r;
            (r, next_r) = (next_r, r - quotient * next_r);
            (t, next_t) = (next_t, t - quotient * next_t);
        }
        match (r, t < 0) {
            (1, false) => reduce(t.unsigned_abs()),
            (1, true) => reduce(t.unsigned_abs()).negated(),
            _ => Self::ZERO,
        }
    }

    /// The integer of small magnitude that it is, if there is one.
    fn small(self) -> Option<i128> {
        let (value, bound) = (u128::from(self.0), u128::from(LARGEST_CONSTANT));
        if value <= bound {
            Some(value.cast_signed())
        } else {
            (PRIME - value <= bound).then(|| -(PRIME - value).cast_signed())
        }
    }

    /// A square root, where there is one: x^((p+1)/4), because p = 3 modulo 4.
    #[must_use]
    pub fn sqrt(self) -> Option<Self> {
        let root = self.power(PRIME.div_ceil(4));
        (root.times(root) == self).then_some(root)
    }
}

impl From<Rational> for Residue {
    fn from(value: Rational) -> Self {
        let part = |n: i128| reduce(n.unsigned_abs());
        let inverse = if value.denominator() == 1 { Self::ONE } else { part(value.denominator()).inverse() };
        let magnitude = part(value.numerator()).times(inverse);
        if value.is_negative() { magnitude.negated() } else { magnitude }
    }
}

/// The values of one scalar at all random points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Fingerprint(pub [Residue; POINTS]);

impl Fingerprint {
    /// The fingerprint of a constant.
    #[must_use]
    pub fn constant(value: Rational) -> Self {
        Self([value.into(); POINTS])
    }

    /// Combines two fingerprints point by point.
    #[must_use]
    pub fn zip(self, other: Self, f: impl Fn(Residue, Residue) -> Residue) -> Self {
        Self(std::array::from_fn(|i| f(self.0[i], other.0[i])))
    }

    /// Maps every point.
    #[must_use]
    pub fn map(self, f: impl Fn(Residue) -> Residue) -> Self {
        Self(self.0.map(f))
    }

    /// Sum.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        self.zip(other, Residue::plus)
    }

    /// Product.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        self.zip(other, Residue::times)
    }

    /// Is it zero at every point?
    #[must_use]
    pub fn is_zero(self) -> bool {
        self == Self::constant(Rational::ZERO)
    }

    /// The small rational that it is at every point, if there is one.
    #[must_use]
    pub fn as_constant(self) -> Option<Rational> {
        if self.0.iter().any(|value| *value != self.0[0]) {
            return None;
        }
        // Coefficients that arise are small dyadic numbers and small integers.
        [1, 2, 4, 8, 16].into_iter().find_map(|denominator| {
            let numerator = self.0[0].times(Rational::from(denominator).into()).small()?;
            Rational::new(numerator, denominator.into())
        })
    }

    /// The constant `c` with `self = c * other`, if there is one.
    #[must_use]
    pub fn ratio_to(self, other: Self) -> Option<Rational> {
        self.times(other.map(Residue::inverse)).as_constant()
    }

    /// A representative of the class of all constant multiples: the same for `x` and `c x`.
    #[must_use]
    pub fn direction(self) -> Self {
        let scale = self.0[0].inverse();
        self.map(|value| value.times(scale))
    }
}

/// A deterministic stream of residues (SplitMix64, Steele, Lea and Flood 2014).
#[derive(Clone, Debug)]
pub struct Stream(u64);

impl Stream {
    /// A stream that belongs to a name, so that it does not depend on the order of declaration.
    #[must_use]
    pub fn named(name: &str) -> Self {
        // FNV-1a: any fixed hash does; it must not change from run to run, as the standard one may.
        Self(
            name.bytes()
                .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)),
        )
    }

    /// The next residue.
    pub fn next_residue(&mut self) -> Residue {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        reduce(u128::from(z ^ (z >> 31)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn field_laws_hold_on_random_elements() {
        let mut stream = Stream::named("laws");
        for _ in 0..1000 {
            let [a, b, c] = std::array::from_fn(|_| stream.next_residue());
            assert_eq!(a.times(b.plus(c)), a.times(b).plus(a.times(c)));
            assert_eq!(a.times(a.inverse()), Residue::ONE);
            assert_eq!(a.plus(a.negated()), Residue::ZERO);
            let root = a.times(a).sqrt().expect("a square has a root");
            assert!(root == a || root == a.negated());
        }
    }

    #[test]
    fn constants_are_recognised() {
        for (n, d) in [(0, 1), (1, 1), (-1, 2), (3, 4), (-8, 1)] {
            let value = Rational::new(n, d).expect("denominator is not zero");
            assert_eq!(Fingerprint::constant(value).as_constant(), Some(value));
        }
    }
}

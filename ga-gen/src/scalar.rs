//! Exact rational numbers: the coefficients of symbolic geometric algebra.
//!
//! Coefficients that arise are products of a few small integers and halves. Literals are 32-bit, but a specification can
//! multiply them without end: what exceeds 128 bits becomes [`Rational::OVERFLOW`], which stays what it is through every
//! operation and is refused where code would be made of it (see [`Rational::fits`]).

use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

/// A fraction in lowest terms with a positive denominator; denominator 0 marks an overflow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Rational {
    numerator: i128,
    denominator: i128,
}

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}

impl Rational {
    /// 0.
    pub const ZERO: Self = Self { numerator: 0, denominator: 1 };
    /// 1.
    pub const ONE: Self = Self { numerator: 1, denominator: 1 };
    /// What was too large to hold.
    pub const OVERFLOW: Self = Self { numerator: 1, denominator: 0 };

    /// `numerator / denominator` in lowest terms; `None` for a zero denominator.
    #[must_use]
    pub fn new(numerator: i128, denominator: i128) -> Option<Self> {
        if denominator == 0 {
            return None;
        }
        let divisor = gcd(numerator, denominator) * denominator.signum();
        Some(Self { numerator: numerator / divisor, denominator: denominator / divisor })
    }

    /// The reciprocal; `None` of zero.
    #[must_use]
    pub fn recip(self) -> Option<Self> {
        if self.denominator == 0 { Some(self) } else { Self::new(self.denominator, self.numerator) }
    }

    /// Can generated code say it: are both parts 32-bit?
    #[must_use]
    pub fn fits(self) -> bool {
        let part = |n: i128| i32::try_from(n).is_ok_and(|n| n != i32::MIN);
        self.denominator != 0 && part(self.numerator) && part(self.denominator)
    }

    /// `numerator / denominator` in lowest terms, from parts that may have overflowed.
    fn checked(numerator: Option<i128>, denominator: Option<i128>) -> Self {
        match (numerator, denominator) {
            // The most negative number has no absolute value.
            (Some(n), Some(d)) if d != 0 && n != i128::MIN => {
                let divisor = gcd(n, d);
                Self { numerator: n / divisor, denominator: d / divisor }
            }
            _ => Self::OVERFLOW,
        }
    }

    /// The numerator, with the sign.
    #[must_use]
    pub fn numerator(self) -> i128 {
        self.numerator
    }

    /// The denominator, positive.
    #[must_use]
    pub fn denominator(self) -> i128 {
        self.denominator
    }

    /// Is it 0?
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.numerator == 0
    }

    /// Is it below 0?
    #[must_use]
    pub fn is_negative(self) -> bool {
        self.numerator < 0
    }

    /// |self|.
    #[must_use]
    pub fn abs(self) -> Self {
        Self { numerator: self.numerator.abs(), ..self }
    }

    /// The greatest rational that divides both to integers: gcd of numerators over lcm of denominators.
    #[must_use]
    pub fn content(self, other: Self) -> Self {
        if self.denominator == 0 || other.denominator == 0 {
            return Self::OVERFLOW;
        }
        if self.abs() == Self::ONE && other.denominator == 1 {
            return Self::ONE;
        }
        let numerator = gcd(self.numerator, other.numerator);
        let shared = gcd(self.denominator, other.denominator);
        let denominator = (self.denominator / shared).checked_mul(other.denominator);
        denominator.map_or(Self::OVERFLOW, |denominator| Self { numerator, denominator })
    }
}

impl From<i32> for Rational {
    fn from(value: i32) -> Self {
        Self { numerator: value.into(), denominator: 1 }
    }
}

impl Add for Rational {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        // Nearly all coefficients are small integers: no common divisor is looked for.
        if let (1, 1, Some(numerator)) = (self.denominator, rhs.denominator, self.numerator.checked_add(rhs.numerator))
            && numerator != i128::MIN
        {
            return Self { numerator, denominator: 1 };
        }
        let left = self.numerator.checked_mul(rhs.denominator);
        let right = rhs.numerator.checked_mul(self.denominator);
        let numerator = left.zip(right).and_then(|(left, right)| left.checked_add(right));
        Self::checked(numerator, self.denominator.checked_mul(rhs.denominator))
    }
}

impl Sub for Rational {
    type Output = Self;
    fn sub(self, rhs: Self) -> Self {
        self + -rhs
    }
}

impl Mul for Rational {
    type Output = Self;
    fn mul(self, rhs: Self) -> Self {
        if let (1, 1, Some(numerator)) = (self.denominator, rhs.denominator, self.numerator.checked_mul(rhs.numerator))
            && numerator != i128::MIN
        {
            return Self { numerator, denominator: 1 };
        }
        let numerator = self.numerator.checked_mul(rhs.numerator);
        Self::checked(numerator, self.denominator.checked_mul(rhs.denominator))
    }
}

impl Neg for Rational {
    type Output = Self;
    fn neg(self) -> Self {
        Self { numerator: -self.numerator, ..self }
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.denominator == 0 {
            write!(f, "(a number beyond 128 bits)")
        } else if self.denominator == 1 {
            write!(f, "{}", self.numerator)
        } else {
            write!(f, "{}/{}", self.numerator, self.denominator)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(numerator: i128, denominator: i128) -> Rational {
        Rational::new(numerator, denominator).expect("denominator is not zero")
    }

    #[test]
    fn fractions_stay_in_lowest_terms() {
        assert_eq!(ratio(6, -4), ratio(-3, 2));
        assert_eq!(ratio(1, 6) + ratio(1, 10), ratio(4, 15));
        assert_eq!(ratio(2, 3) * ratio(3, 4), ratio(1, 2));
        assert_eq!(ratio(4, 3).content(ratio(6, 5)), ratio(2, 15));
        assert_eq!(Rational::ZERO.recip(), None);
    }

    #[test]
    fn an_overflow_is_never_lost() {
        let large = Rational::from(i32::MAX);
        let power = (0..5).fold(Rational::ONE, |power, _| power * large);
        let smallest = Rational::from(i32::MIN);
        let lowest = (0..4).fold(-Rational::from(8), |power, _| power * smallest);
        for lost in [power, power.recip().expect("not zero"), lowest * Rational::from(-1), power + Rational::ONE] {
            assert!(!lost.fits(), "{lost}");
            for again in [lost * Rational::ZERO, lost - lost, -lost, lost.content(lost), Rational::ZERO.content(lost)] {
                assert!(!again.fits() && !again.is_zero(), "{again}");
            }
        }
        assert!(large.fits() && !(large + Rational::ONE).fits() && !smallest.fits());
    }
}

//! Exact rational numbers: the coefficients of symbolic geometric algebra.
//!
//! Coefficients that arise are products of a few small integers and halves; 128-bit parts leave no way to overflow
//! from a specification, whose literals are 32-bit.

use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

/// A fraction in lowest terms with a positive denominator.
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
        Self::new(self.denominator, self.numerator)
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
        let numerator = gcd(self.numerator, other.numerator);
        let denominator = self.denominator / gcd(self.denominator, other.denominator) * other.denominator;
        Self { numerator, denominator }
    }
}

impl From<i32> for Rational {
    fn from(value: i32) -> Self {
        Self { numerator: value.into(), denominator: 1 }
    }
}

fn lowest(numerator: i128, denominator: i128) -> Rational {
    let divisor = gcd(numerator, denominator);
    Rational { numerator: numerator / divisor, denominator: denominator / divisor }
}

impl Add for Rational {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        lowest(self.numerator * rhs.denominator + rhs.numerator * self.denominator, self.denominator * rhs.denominator)
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
        lowest(self.numerator * rhs.numerator, self.denominator * rhs.denominator)
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
        if self.denominator == 1 {
            write!(f, "{}", self.numerator)
        } else {
            write!(f, "{}/{}", self.numerator, self.denominator)
        }
    }
}

//! Exact rationals as a scalar: with them the generated code and the dynamic multivector must agree to the last digit.

use ga_physics::algebra::Scalar;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A fraction in lowest terms; overflow panics, so that no wrong number passes unseen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Rational {
    numerator: i128,
    denominator: i128,
}

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}

impl Rational {
    pub(crate) fn new(numerator: i128, denominator: i128) -> Self {
        assert_ne!(denominator, 0, "division by zero");
        let divisor = gcd(numerator, denominator) * denominator.signum();
        Self { numerator: numerator / divisor, denominator: denominator / divisor }
    }

    fn times(a: i128, b: i128) -> i128 {
        a.checked_mul(b).expect("rational overflow: use smaller samples")
    }
}

impl Add for Rational {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        let common = gcd(self.denominator, b.denominator);
        let (left, right) = (b.denominator / common, self.denominator / common);
        let numerator = Self::times(self.numerator, left).checked_add(Self::times(b.numerator, right));
        Self::new(numerator.expect("rational overflow"), Self::times(self.denominator, left))
    }
}

impl Sub for Rational {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for Rational {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        let (x, y) = (gcd(self.numerator, b.denominator).max(1), gcd(b.numerator, self.denominator).max(1));
        Self::new(
            Self::times(self.numerator / x, b.numerator / y),
            Self::times(self.denominator / y, b.denominator / x),
        )
    }
}

impl Div for Rational {
    type Output = Self;
    #[allow(clippy::suspicious_arithmetic_impl, reason = "division is multiplication by the reciprocal")]
    fn div(self, b: Self) -> Self {
        self * Self::new(b.denominator, b.numerator)
    }
}

impl Neg for Rational {
    type Output = Self;
    fn neg(self) -> Self {
        Self { numerator: -self.numerator, ..self }
    }
}

impl Scalar for Rational {
    fn ratio(numerator: i32, denominator: i32) -> Self {
        Self::new(numerator.into(), denominator.into())
    }

    fn sqrt(self) -> Self {
        let root = |n: i128| {
            let root = (n as f64).sqrt().round() as i128;
            assert_eq!(root * root, n, "no rational square root");
            root
        };
        Self::new(root(self.numerator), root(self.denominator))
    }
}

//! Two scalars that a user could write: exact rationals, and numbers that bound the rounding of others.

use ga_physics::algebra::Scalar;
use num_rational::BigRational;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A rational of any size. Leaked, because a scalar is `Copy`: a test ends soon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Exact(pub(crate) &'static BigRational);

impl Exact {
    pub(crate) fn new(value: BigRational) -> Self {
        Self(Box::leak(Box::new(value)))
    }

    /// The value of a finite float.
    pub(crate) fn of(value: f64) -> Self {
        Self::new(rational(value))
    }
}

pub(crate) fn rational(value: f64) -> BigRational {
    BigRational::from_float(value).unwrap()
}

macro_rules! exact {
    ($($operation:ident $method:ident;)*) => {$(
        impl $operation for Exact {
            type Output = Self;
            fn $method(self, b: Self) -> Self { Self::new(self.0.$method(b.0)) }
        }
    )*};
}

exact! { Add add; Sub sub; Mul mul; Div div; }

impl Neg for Exact {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.0)
    }
}

impl Scalar for Exact {
    fn ratio(numerator: i32, denominator: i32) -> Self {
        Self::new(BigRational::new(numerator.into(), denominator.into()))
    }

    /// Of squares.
    fn sqrt(self) -> Self {
        let root = BigRational::new(self.0.numer().sqrt(), self.0.denom().sqrt());
        assert_eq!(&(&root * &root), self.0, "no rational root");
        Self::new(root)
    }
}

/// A number and a bound of what rounding made of it, in units of the unit roundoff: the running error analysis of
/// Wilkinson (Higham, *Accuracy and Stability of Numerical Algorithms*, 3.3), to first order. Each operation and each
/// constant may be off by one unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounded {
    pub(crate) value: f64,
    pub(crate) units: f64,
    /// The largest relative error, in units, of a divisor on the way: first order is enough while this is small.
    pub(crate) worst_divisor: f64,
}

impl Bounded {
    fn new(value: f64, units: f64, parts: [Self; 2]) -> Self {
        let worst_divisor = parts[0].worst_divisor.max(parts[1].worst_divisor);
        Self { value, units: units + value.abs(), worst_divisor }
    }
}

impl Add for Bounded {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self::new(self.value + b.value, self.units + b.units, [self, b])
    }
}

impl Sub for Bounded {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for Bounded {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        let units = self.units * b.value.abs() + b.units * self.value.abs();
        Self::new(self.value * b.value, units, [self, b])
    }
}

impl Div for Bounded {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let quotient = self.value / b.value;
        let units = (self.units + b.units * quotient.abs()) / b.value.abs();
        let divisor = Self { worst_divisor: b.worst_divisor.max(b.units / b.value.abs()), ..b };
        Self::new(quotient, units, [self, divisor])
    }
}

impl Neg for Bounded {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Scalar for Bounded {
    fn ratio(numerator: i32, denominator: i32) -> Self {
        let value = f64::from(numerator) / f64::from(denominator);
        Self { value, units: value.abs(), worst_divisor: 0.0 }
    }

    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Self::new(root, self.units / (2.0 * root), [self, self])
    }
}

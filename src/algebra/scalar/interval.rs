//! Intervals as scalars: two f64 that enclose the exact result, whatever was rounded on the way.
//!
//! Moore, *Interval Analysis*, 1966; the conventions are those of IEEE 1788-2015 with the empty set left out. Every
//! operation rounds outward: sums by the sign of their rounding error (Knuth, TAOCP 2, 4.2.2), so that an exact sum stays
//! as it is; products, quotients and roots to the next number below and above, so by less than 2 ulp in all.
//!
//! Two occurrences of a number are taken as independent: `x - x` is `[inf - sup, sup - inf]`, not 0. Enclosures of long
//! formulas are therefore wide for wide operands, and tell more about small boxes than about large ones.
//!
//! Own code, because the crate for it, `inari`, does not build for a plain x86-64 (it wants Haswell's instructions) and
//! needs the standard library.

use super::Scalar;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// All real numbers from `inf` to `sup`, which may be infinite: then there is no bound on that side.
///
/// ```
/// use ga_physics::algebra::{Interval, cga::{Point, Sphere}};
///
/// // Is the point certainly inside, when each of its coordinates is known to a millimetre?
/// let near = |x: f64| Interval::new(x - 1e-3, x + 1e-3);
/// let exactly = |x: f64| Interval::new(x, x);
/// let unit_sphere = Sphere::new(exactly(0.0)?, exactly(0.0)?, exactly(0.0)?, exactly(1.0)?);
/// let inside = Point::new(near(0.6)?, near(0.0)?, near(0.7)?) | unit_sphere;
/// let unknown = Point::new(near(0.6)?, near(0.0)?, near(0.8)?) | unit_sphere;
/// assert!(inside.inf() > 0.0);
/// assert!(unknown.contains(0.0));
/// # Ok::<(), ga_physics::algebra::NotAnInterval>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Interval {
    // inf <= sup, inf < infinity, sup > -infinity, neither NaN.
    inf: f64,
    sup: f64,
}

/// Two ends with no number between them.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("no real number lies between {inf:e} and {sup:e}: give the smaller end first, and no NaN")]
pub struct NotAnInterval {
    /// The end given as the smaller.
    pub inf: f64,
    /// The end given as the larger.
    pub sup: f64,
}

impl Interval {
    /// Every real number: what is known when nothing is.
    pub const WHOLE: Self = Self { inf: f64::NEG_INFINITY, sup: f64::INFINITY };

    /// The numbers from `inf` to `sup`, both included.
    ///
    /// # Errors
    /// `inf > sup`, NaN, or both ends infinite on the same side: no real number lies between.
    pub fn new(inf: f64, sup: f64) -> Result<Self, NotAnInterval> {
        if inf <= sup && inf < f64::INFINITY && sup > f64::NEG_INFINITY {
            Ok(Self { inf, sup })
        } else {
            Err(NotAnInterval { inf, sup })
        }
    }

    /// The lower end.
    #[must_use]
    pub fn inf(self) -> f64 {
        self.inf
    }

    /// The upper end.
    #[must_use]
    pub fn sup(self) -> f64 {
        self.sup
    }

    /// `sup - inf`, rounded upward.
    #[must_use]
    pub fn width(self) -> f64 {
        sum_up(self.sup, -self.inf)
    }

    /// Does `x` lie in it? NaN lies in none.
    #[must_use]
    pub fn contains(self, x: f64) -> bool {
        self.inf <= x && x <= self.sup
    }
}

/// What rounding took from `sum = a + b`: exact; NaN where the sum overflows.
fn sum_error(a: f64, b: f64, sum: f64) -> f64 {
    let b_part = sum - a;
    (a - (sum - b_part)) + (b - b_part)
}

/// The largest f64 that is not above `a + b`. An error that is NaN counts as one: from infinity it steps to the largest
/// number, from minus infinity nowhere.
fn sum_down(a: f64, b: f64) -> f64 {
    let sum = a + b;
    if sum_error(a, b, sum) >= 0.0 { sum } else { sum.next_down() }
}

/// The smallest f64 that is not below `a + b`.
fn sum_up(a: f64, b: f64) -> f64 {
    -sum_down(-a, -b)
}

/// At most `a b`, and at least the number before it. Zero times an end at infinity is zero: the end is not a number of
/// the interval, but a bound to numbers that are finite.
fn product_down(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { (a * b).next_down() }
}

/// At least `a b`.
fn product_up(a: f64, b: f64) -> f64 {
    -product_down(-a, b)
}

/// At most `a / b`, for a `b` that is not zero.
fn quotient_down(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { (a / b).next_down() }
}

/// At least `a / b`.
fn quotient_up(a: f64, b: f64) -> f64 {
    -quotient_down(-a, b)
}

impl Interval {
    /// The hull of what `down` and `up` give for the four pairs of ends.
    fn of_ends(self, other: Self, down: fn(f64, f64) -> f64, up: fn(f64, f64) -> f64) -> Self {
        let ends = [(self.inf, other.inf), (self.inf, other.sup), (self.sup, other.inf), (self.sup, other.sup)];
        Self {
            inf: ends.iter().fold(f64::INFINITY, |least, (a, b)| least.min(down(*a, *b))),
            sup: ends.iter().fold(f64::NEG_INFINITY, |most, (a, b)| most.max(up(*a, *b))),
        }
    }
}

impl Scalar for Interval {
    /// Encloses `numerator / denominator`; exact where f64 is.
    fn ratio(numerator: i32, denominator: i32) -> Self {
        let quotient = f64::from(numerator) / f64::from(denominator);
        // What remains of the denominator without its powers of two must divide the numerator.
        let odd = denominator >> denominator.trailing_zeros().min(i32::BITS - 1);
        let exact = odd != 0 && numerator.wrapping_rem(odd) == 0;
        if exact {
            Self { inf: quotient, sup: quotient }
        } else {
            let exactly = |value: i32| Self { inf: value.into(), sup: value.into() };
            exactly(numerator) / exactly(denominator)
        }
    }

    /// The roots of the numbers that have one. Where none has, it is [`WHOLE`](Self::WHOLE): the type has no empty set, and
    /// a number that does not exist is bounded by nothing.
    fn sqrt(self) -> Self {
        if self.sup < 0.0 {
            return Self::WHOLE;
        }
        let down = |x: f64| if x > 0.0 { Scalar::sqrt(x).next_down() } else { 0.0 };
        let up = |x: f64| if x > 0.0 { Scalar::sqrt(x).next_up() } else { 0.0 };
        Self { inf: down(self.inf), sup: up(self.sup) }
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { inf: sum_down(self.inf, other.inf), sup: sum_up(self.sup, other.sup) }
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.of_ends(other, product_down, product_up)
    }
}

impl Div for Interval {
    type Output = Self;
    /// Divided by an interval that contains zero, in its inside or as an end, the quotient is
    /// [`WHOLE`](Self::WHOLE).
    fn div(self, other: Self) -> Self {
        if other.contains(0.0) { Self::WHOLE } else { self.of_ends(other, quotient_down, quotient_up) }
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { inf: -self.sup, sup: -self.inf }
    }
}

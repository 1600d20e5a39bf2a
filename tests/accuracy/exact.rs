//! The exact answers: dense multivectors of G(4,1) over the rationals, in an orthonormal basis e1, e2, e3, p, m with
//! `no = (m - p)/2`, `ninf = p + m`. Floats are taken as the exact numbers that they are.

use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

pub(crate) type Big = BigRational;

pub(crate) fn big(x: f64) -> Big {
    Big::from_float(x).expect("finite")
}

pub(crate) fn ratio(n: i64, d: i64) -> Big {
    Big::new(n.into(), d.into())
}

/// `|found - exact|`, rounded once.
pub(crate) fn distance(found: f64, exact: &Big) -> f64 {
    (big(found) - exact).to_f64().unwrap().abs()
}

/// The coefficient of each of the 32 blades, by its set of factors.
#[derive(Clone)]
pub(crate) struct Exact(Vec<Big>);

const DIMENSION: usize = 5;
const SIZE: usize = 1 << DIMENSION;

/// The sign of `e_a e_b`: one for each pair of factors out of order, and the square -1 of m.
fn is_negative(a: usize, b: usize) -> bool {
    let pairs = (0..DIMENSION).filter(|i| a >> i & 1 == 1).map(|i| (b & ((1 << i) - 1)).count_ones()).sum::<u32>();
    (pairs + u32::from(a & b & 0b10000 != 0)) % 2 == 1
}

impl Exact {
    fn zero() -> Self {
        Self(vec![Big::zero(); SIZE])
    }

    pub(crate) fn scalar(x: Big) -> Self {
        let mut result = Self::zero();
        result.0[0] = x;
        result
    }

    fn vector(name: &str) -> Self {
        let mut result = Self::zero();
        let half = ratio(1, 2);
        let parts = match name {
            "no" => vec![(3, -half.clone()), (4, half)],
            "ninf" => vec![(3, ratio(1, 1)), (4, ratio(1, 1))],
            digit => vec![(digit.parse::<usize>().unwrap() - 1, ratio(1, 1))],
        };
        parts.into_iter().for_each(|(index, x)| result.0[1 << index] = x);
        result
    }

    /// `s`, `e31`, `e1_no_ninf`: the outer product of the factors as written.
    pub(crate) fn blade(name: &str) -> Self {
        let mut result = Self::scalar(ratio(1, 1));
        for part in name.split('_').filter(|part| *part != "s") {
            let vectors: Vec<String> = match part.strip_prefix('e') {
                Some(digits) => digits.chars().map(String::from).collect(),
                None => vec![part.to_string()],
            };
            for vector in vectors {
                result = result.product(&Self::vector(&vector), |a, b| a & b == 0);
            }
        }
        result
    }

    /// A sum of blades.
    pub(crate) fn sum<'a>(terms: impl IntoIterator<Item = (&'a str, Big)>) -> Self {
        terms.into_iter().fold(Self::zero(), |sum, (name, x)| sum.plus(&Self::blade(name).scaled(&x)))
    }

    /// `x + no + x²/2 ninf`.
    pub(crate) fn point(x: &[Big; 3]) -> Self {
        let square: Big = x.iter().map(|x| x * x).sum();
        let [a, b, c] = x.clone();
        Self::sum([("e1", a), ("e2", b), ("e3", c), ("no", ratio(1, 1)), ("ninf", square / ratio(2, 1))])
    }

    fn product(&self, other: &Self, counts: impl Fn(usize, usize) -> bool) -> Self {
        let mut result = Self::zero();
        for (a, x) in self.0.iter().enumerate().filter(|(_, x)| !x.is_zero()) {
            for (b, y) in other.0.iter().enumerate().filter(|(b, y)| !y.is_zero() && counts(a, *b)) {
                let product = x * y;
                result.0[a ^ b] += if is_negative(a, b) { -product } else { product };
            }
        }
        result
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        self.product(other, |_, _| true)
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(x, y)| x + y).collect())
    }

    pub(crate) fn scaled(&self, factor: &Big) -> Self {
        Self(self.0.iter().map(|x| x * factor).collect())
    }

    pub(crate) fn reversed(&self) -> Self {
        let odd = |blade: usize| blade.count_ones() & 2 == 2;
        Self(self.0.iter().enumerate().map(|(b, x)| if odd(b) { -x } else { x.clone() }).collect())
    }

    /// The place of a point of any weight.
    pub(crate) fn place(&self) -> [Big; 3] {
        // no = (m - p)/2 and ninf = p + m: the weight is the coefficient of m minus that of p.
        let weight = &self.0[16] - &self.0[8];
        [&self.0[1] / &weight, &self.0[2] / &weight, &self.0[4] / &weight]
    }

    /// The coefficient of a blade that is named with `no` and `ninf` last: `p = ninf/2 - no`, `m = ninf/2 + no`, and so
    /// `p ^ m = -no ^ ninf`.
    pub(crate) fn coefficient(&self, name: &str) -> Big {
        let euclidean: Vec<&str> = name.split('_').filter(|part| *part != "no" && *part != "ninf").collect();
        let bare = Self::blade(euclidean.first().unwrap_or(&"s"));
        let (index, sign) = bare.0.iter().enumerate().find(|(_, x)| !x.is_zero()).map(|(i, x)| (i, x.clone())).unwrap();
        let part = |pair: usize| &self.0[index | pair << 3];
        let value = match (name.contains("_no") || name == "no_ninf", name.contains("ninf")) {
            (false, false) => part(0).clone(),
            (true, false) => part(2) - part(1),
            (false, true) => (part(1) + part(2)) / ratio(2, 1),
            (true, true) => -part(3).clone(),
        };
        value / sign
    }
}

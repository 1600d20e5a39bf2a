//! The dynamic multivector: what the generated types replace, and what they are tested and measured against.
//!
//! As in the report's appendix A: a shared pointer to coefficients on the heap, with the blades that are present
//! tracked at run time, so that no product is formed of absent ones. It is built to be a fair rival: one allocation a
//! result, only present coefficients stored, signs from a table made at compile time. It works in an orthonormal basis
//! and knows nothing of null pairs, so it is an independent check on the generated code, which works in the null basis.

use super::Scalar;
use alloc::rc::Rc;
use core::marker::PhantomData;
use core::ops::{Add, BitAnd, BitOr, BitXor, Mul, Neg, Sub};

/// The largest number of basis vectors.
const MAX_DIMENSION: usize = 6;
/// The largest number of basis blades.
const MAX_BLADES: usize = 1 << MAX_DIMENSION;

/// An orthonormal basis: the marker type of an algebra.
pub trait Metric: Copy + 'static {
    /// The squares of the basis vectors: +1, -1 or 0.
    const SQUARES: &'static [i8];
    /// The sign of `I` against the product of the basis vectors in order; 0 where no `I` was declared.
    const PSEUDOSCALAR_SIGN: i8;
}

/// A value as a dynamic multivector of the algebra `M`.
pub trait ToDynamic<M: Metric, T: Scalar> {
    /// The same multivector, in the orthonormal basis.
    fn to_dynamic(&self) -> Dynamic<M, T>;
}

/// A multivector with the blades that it holds known at run time. Blades are bit sets over the orthonormal basis.
#[derive(Debug)]
pub struct Dynamic<M: Metric, T: Scalar> {
    /// Bit b is set when blade b is present.
    present: u64,
    /// The coefficients of the present blades, in order of the blade.
    coefficients: Rc<[T]>,
    metric: PhantomData<M>,
}

impl<M: Metric, T: Scalar> Clone for Dynamic<M, T> {
    fn clone(&self) -> Self {
        Self { present: self.present, coefficients: Rc::clone(&self.coefficients), metric: PhantomData }
    }
}

/// The sign of every product of basis blades, made at compile time.
struct Signs<M>(PhantomData<M>);

impl<M: Metric> Signs<M> {
    const TABLE: [[i8; MAX_BLADES]; MAX_BLADES] = {
        assert!(M::SQUARES.len() <= MAX_DIMENSION, "at most six basis vectors");
        let count = 1 << M::SQUARES.len();
        let mut table = [[0; MAX_BLADES]; MAX_BLADES];
        let mut a = 0;
        while a < count {
            let mut b = 0;
            while b < count {
                table[a][b] = sign(M::SQUARES, a, b);
                b += 1;
            }
            a += 1;
        }
        table
    };
}

/// Swaps that sort the factors of a and b, times the squares of the common ones.
const fn sign(squares: &[i8], a: usize, b: usize) -> i8 {
    let mut result = 1;
    let mut index = 0;
    while index < squares.len() {
        if b >> index & 1 == 1 {
            if (a >> (index + 1)).count_ones() % 2 == 1 {
                result = -result;
            }
            if a >> index & 1 == 1 {
                result *= squares[index];
            }
        }
        index += 1;
    }
    result
}

/// Coefficients that are being summed, with the blades that occurred.
struct Sums<T> {
    present: u64,
    values: [T; MAX_BLADES],
}

impl<T: Scalar> Sums<T> {
    fn new() -> Self {
        Self { present: 0, values: [T::ratio(0, 1); MAX_BLADES] }
    }

    fn add(&mut self, blade: usize, value: T) {
        self.present |= 1 << blade;
        self.values[blade] = self.values[blade] + value;
    }

    /// Packs the present coefficients to the front, in place, and makes the one allocation.
    fn finish<M: Metric>(mut self) -> Dynamic<M, T> {
        let mut count = 0;
        for blade in Bits(self.present) {
            self.values[count] = self.values[blade];
            count += 1;
        }
        Dynamic { present: self.present, coefficients: Rc::from(&self.values[..count]), metric: PhantomData }
    }
}

/// The set bits of a word, from the lowest.
struct Bits(u64);

impl Iterator for Bits {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        let index = self.0.trailing_zeros() as usize;
        self.0 &= self.0.wrapping_sub(1);
        (index < 64).then_some(index)
    }
}

impl<M: Metric, T: Scalar> Dynamic<M, T> {
    /// The multivector with the given terms; equal blades add up. Bits of a blade beyond the basis are ignored.
    #[must_use]
    pub fn from_terms(terms: &[(u32, T)]) -> Self {
        let mut sums = Sums::new();
        let mask = (1 << M::SQUARES.len()) - 1;
        for (blade, value) in terms {
            sums.add((*blade & mask) as usize, *value);
        }
        sums.finish()
    }

    /// The terms that are present.
    pub fn terms(&self) -> impl Iterator<Item = (usize, T)> + '_ {
        Bits(self.present).zip(self.coefficients.iter().copied())
    }

    /// The coefficient of a blade; 0 where it is absent.
    #[must_use]
    pub fn coefficient(&self, blade: u32) -> T {
        self.terms().find(|(known, _)| *known == blade as usize).map_or(T::ratio(0, 1), |(_, value)| value)
    }

    /// The bytes of the heap block behind the shared pointer: two reference counts, then the coefficients.
    #[must_use]
    pub fn heap_bytes(&self) -> usize {
        2 * size_of::<usize>() + size_of_val(&*self.coefficients)
    }

    fn product(&self, other: &Self, keep: impl Fn(usize, usize) -> bool) -> Self {
        let mut sums = Sums::new();
        for (a, x) in self.terms() {
            for (b, y) in other.terms() {
                match Signs::<M>::TABLE[a][b] {
                    1 if keep(a, b) => sums.add(a ^ b, x * y),
                    -1 if keep(a, b) => sums.add(a ^ b, -(x * y)),
                    _ => {}
                }
            }
        }
        sums.finish()
    }

    fn map(&self, f: impl Fn(usize, T) -> (usize, T)) -> Self {
        let mut sums = Sums::new();
        for (blade, value) in self.terms() {
            let (image, value) = f(blade, value);
            sums.add(image, value);
        }
        sums.finish()
    }

    /// The reverse.
    #[must_use]
    pub fn rev(&self) -> Self {
        self.map(|blade, value| (blade, if blade.count_ones() & 2 == 2 { -value } else { value }))
    }

    /// The part of one grade.
    #[must_use]
    pub fn grade(&self, grade: u32) -> Self {
        let mut sums = Sums::new();
        for (blade, value) in self.terms().filter(|(blade, _)| blade.count_ones() == grade) {
            sums.add(blade, value);
        }
        sums.finish()
    }

    /// `I a`; `None` where no pseudoscalar was declared or `I² = 0`.
    #[must_use]
    pub fn dual(&self) -> Option<Self> {
        let full = (1 << M::SQUARES.len()) - 1;
        let square = Signs::<M>::TABLE[full][full];
        (M::PSEUDOSCALAR_SIGN != 0 && square != 0).then(|| {
            self.map(|blade, value| {
                let negative = Signs::<M>::TABLE[full][blade] * M::PSEUDOSCALAR_SIGN < 0;
                (full ^ blade, if negative { -value } else { value })
            })
        })
    }

    /// `I^-1 a`.
    #[must_use]
    pub fn undual(&self) -> Option<Self> {
        let full = (1 << M::SQUARES.len()) - 1;
        let dual = self.dual()?;
        Some(if Signs::<M>::TABLE[full][full] < 0 { -&dual } else { dual })
    }

    /// `undual(dual a ^ dual b)`.
    #[must_use]
    pub fn meet(&self, other: &Self) -> Option<Self> {
        (&self.dual()? ^ &other.dual()?).undual()
    }

    /// `self x ~self`, restricted to the grades of x.
    #[must_use]
    pub fn apply(&self, x: &Self) -> Self {
        let image = &(self * x) * &self.rev();
        let grades = x.terms().fold(0_u32, |grades, (blade, _)| grades | 1 << blade.count_ones());
        let mut sums = Sums::new();
        for (blade, value) in image.terms().filter(|(blade, _)| grades >> blade.count_ones() & 1 == 1) {
            sums.add(blade, value);
        }
        sums.finish()
    }

    /// Every coefficient times a scalar.
    #[must_use]
    pub fn scaled(&self, factor: T) -> Self {
        self.map(|blade, value| (blade, value * factor))
    }
}

impl<M: Metric, T: Scalar + PartialEq> PartialEq for Dynamic<M, T> {
    /// The same multivector: an absent coefficient equals a zero.
    fn eq(&self, other: &Self) -> bool {
        Bits(self.present | other.present).all(|blade| {
            let blade = u32::try_from(blade).unwrap_or(u32::MAX);
            self.coefficient(blade) == other.coefficient(blade)
        })
    }
}

macro_rules! operators {
    ($($(#[$doc:meta])* $operator:ident $method:ident |$a:ident, $b:ident| $body:expr;)*) => {$(
        impl<M: Metric, T: Scalar> $operator for &Dynamic<M, T> {
            type Output = Dynamic<M, T>;
            $(#[$doc])*
            fn $method(self, other: Self) -> Dynamic<M, T> {
                let ($a, $b) = (self, other);
                $body
            }
        }
    )*};
}

operators! {
    /// The geometric product.
    Mul mul |a, b| a.product(b, |_, _| true);
    /// The outer product.
    BitXor bitxor |a, b| a.product(b, |x, y| x & y == 0);
    /// The left contraction.
    BitOr bitor |a, b| a.product(b, |x, y| x & y == x);
    /// The sum.
    Add add |a, b| {
        let mut sums = Sums::new();
        a.terms().chain(b.terms()).for_each(|(blade, value)| sums.add(blade, value));
        sums.finish()
    };
    /// The difference.
    Sub sub |a, b| a + &-b;
}

impl<M: Metric, T: Scalar> Neg for &Dynamic<M, T> {
    type Output = Dynamic<M, T>;
    fn neg(self) -> Dynamic<M, T> {
        self.map(|blade, value| (blade, -value))
    }
}

impl<M: Metric, T: Scalar> BitAnd for &Dynamic<M, T> {
    type Output = Option<Dynamic<M, T>>;
    /// The meet; `None` where the algebra has no dual.
    fn bitand(self, other: Self) -> Option<Dynamic<M, T>> {
        self.meet(other)
    }
}

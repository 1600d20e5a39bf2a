//! The dynamic multivector: what the generated types replace, and what they are tested and measured against.
//!
//! As in the report's appendix A: a shared pointer to coefficients on the heap, with the blades that are present
//! tracked at run time, so that no product is formed of absent ones. It is built to be a fair rival: one allocation a
//! result and no step of an operation on the heap, only present coefficients stored, the surviving products of blades
//! and their signs as bit sets made at compile time. It works in an orthonormal basis and knows nothing of null pairs,
//! so it is an independent check on the generated code, which works in the null basis.

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

/// A set of blades, as bits, for each blade.
type Sets = [u64; MAX_BLADES];

/// The products of basis blades. For each blade a, the blades b with ...
struct Products {
    /// ... `a b` a negative multiple of the blade `a xor b`.
    negative: Sets,
    /// ... `a b` other than 0.
    geometric: Sets,
    /// ... `a ^ b` other than 0.
    outer: Sets,
    /// ... `a | b` other than 0.
    contraction: Sets,
}

impl Products {
    const fn new(squares: &[i8]) -> Self {
        assert!(squares.len() <= MAX_DIMENSION, "at most six basis vectors");
        let none = [0; MAX_BLADES];
        let mut products = Self { negative: none, geometric: none, outer: none, contraction: none };
        let count = 1 << squares.len();
        let mut a = 0;
        while a < count {
            let mut b = 0;
            while b < count {
                let sign = sign(squares, a, b);
                products.negative[a] |= ((sign < 0) as u64) << b;
                products.geometric[a] |= ((sign != 0) as u64) << b;
                products.outer[a] |= ((sign != 0 && a & b == 0) as u64) << b;
                products.contraction[a] |= ((sign != 0 && a & b == a) as u64) << b;
                b += 1;
            }
            a += 1;
        }
        products
    }
}

/// The table of an algebra, made at compile time.
struct Table<M>(PhantomData<M>);

impl<M: Metric> Table<M> {
    const PRODUCTS: &'static Products = &Products::new(M::SQUARES);
}

/// The blades of each grade among all [`MAX_BLADES`].
const GRADES: [u64; MAX_DIMENSION + 1] = {
    let mut grades = [0; MAX_DIMENSION + 1];
    let mut blade = 0_usize;
    while blade < MAX_BLADES {
        grades[blade.count_ones() as usize] |= 1 << blade;
        blade += 1;
    }
    grades
};

/// The blades that the reverse negates: k (k - 1) / 2 is odd for the grades 2, 3 and 6.
const REVERSED: u64 = GRADES[2] | GRADES[3] | GRADES[6];

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

/// `{a xor b: b in set}`: for each bit of a, neighbouring groups of bits change places.
fn translated<const N: usize>(mut set: u64, a: usize) -> u64 {
    const LOWER: [u64; MAX_DIMENSION] = [
        0x5555_5555_5555_5555,
        0x3333_3333_3333_3333,
        0x0f0f_0f0f_0f0f_0f0f,
        0x00ff_00ff_00ff_00ff,
        0x0000_ffff_0000_ffff,
        0x0000_0000_ffff_ffff,
    ];
    for (index, lower) in LOWER.iter().enumerate().take(N.trailing_zeros() as usize) {
        if a >> index & 1 == 1 {
            set = (set & lower) << (1 << index) | set >> (1 << index) & lower;
        }
    }
    set
}

/// The set bits of a word, from the lowest.
struct Bits(u64);

impl Iterator for Bits {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        if self.0 == 0 {
            return None;
        }
        let index = self.0.trailing_zeros() as usize;
        self.0 &= self.0 - 1;
        Some(index)
    }
}

/// Coefficients on the stack, N blades: a result before its one allocation, or a step within an operation.
struct Sums<T, const N: usize> {
    present: u64,
    values: [T; N],
}

impl<T: Scalar, const N: usize> Sums<T, N> {
    fn new() -> Self {
        Self { present: 0, values: [T::ratio(0, 1); N] }
    }

    /// The coefficients of a multivector, each in the place of its blade.
    fn unpacked<M: Metric>(multivector: &Dynamic<M, T>) -> Self {
        let mut sums = Self::new();
        for (blade, value) in multivector.terms() {
            sums.set(blade, value);
        }
        sums
    }

    fn set(&mut self, blade: usize, value: T) {
        self.present |= 1 << blade;
        // N is a power of two and larger than any blade: the mask only tells the compiler so.
        self.values[blade & (N - 1)] = value;
    }

    fn add(&mut self, blade: usize, value: T) {
        self.set(blade, self.values[blade & (N - 1)] + value);
    }

    /// Packs the present coefficients to the front, in place, and makes the one allocation.
    fn finish<M: Metric>(mut self) -> Dynamic<M, T> {
        let mut count = 0;
        for blade in Bits(self.present) {
            self.values[count & (N - 1)] = self.values[blade & (N - 1)];
            count += 1;
        }
        Dynamic { present: self.present, coefficients: Rc::from(&self.values[..count]), metric: PhantomData }
    }

    /// The sum of the products of terms. For each blade a, `row` says which blades b to multiply it with, and for which
    /// of them the sign is negative.
    #[inline]
    fn multiply<M: Metric>(
        a: impl Iterator<Item = (usize, T)>,
        b: &Dynamic<M, T>,
        row: impl Fn(usize) -> (u64, u64),
    ) -> Self {
        let mut sums = Self::new();
        let dense = Self::unpacked(b);
        for (blade_a, x) in a {
            let (kept, negative) = row(blade_a);
            for blade_b in Bits(kept & b.present) {
                let product = x * dense.values[blade_b & (N - 1)];
                sums.add(blade_a ^ blade_b, if negative >> blade_b & 1 == 1 { -product } else { product });
            }
        }
        sums
    }
}

/// Calls a function with the number of blades of the basis as a constant, so that no more of them are touched.
macro_rules! sized {
    ($function:ident($($argument:expr),*)) => {
        match M::SQUARES.len() {
            0..=3 => Self::$function::<8>($($argument),*),
            4 => Self::$function::<16>($($argument),*),
            5 => Self::$function::<32>($($argument),*),
            _ => Self::$function::<MAX_BLADES>($($argument),*),
        }
    };
}

impl<M: Metric, T: Scalar> Dynamic<M, T> {
    /// The multivector with the given terms; equal blades add up. Bits of a blade beyond the basis are ignored.
    #[must_use]
    pub fn from_terms(terms: &[(u32, T)]) -> Self {
        let mask = (1 << M::SQUARES.len()) - 1;
        let terms = terms.iter().map(|(blade, value)| ((*blade & mask) as usize, *value));
        sized!(summed(terms))
    }

    fn summed<const N: usize>(terms: impl Iterator<Item = (usize, T)>) -> Self {
        let mut sums = Sums::<T, N>::new();
        terms.for_each(|(blade, value)| sums.add(blade, value));
        sums.finish()
    }

    /// The terms that are present.
    pub fn terms(&self) -> impl Iterator<Item = (usize, T)> + '_ {
        Bits(self.present).zip(self.coefficients.iter().copied())
    }

    /// The coefficient of a blade; 0 where it is absent.
    #[must_use]
    pub fn coefficient(&self, blade: u32) -> T {
        let below = 1_u64.checked_shl(blade).map_or(u64::MAX, |bit| bit - 1);
        let present = self.present.checked_shr(blade).is_some_and(|rest| rest & 1 == 1);
        let rank = (self.present & below).count_ones() as usize;
        self.coefficients.get(rank).copied().filter(|_| present).unwrap_or(T::ratio(0, 1))
    }

    /// The bytes of the heap block behind the shared pointer: two reference counts, then the coefficients,
    /// padded to a whole word.
    #[must_use]
    pub fn heap_bytes(&self) -> usize {
        (2 * size_of::<usize>() + size_of_val(&*self.coefficients)).next_multiple_of(align_of::<usize>())
    }

    fn product(&self, other: &Self, kept: &Sets) -> Self {
        sized!(product_of(self, other, kept))
    }

    fn product_of<const N: usize>(a: &Self, b: &Self, kept: &Sets) -> Self {
        let negative = &Table::<M>::PRODUCTS.negative;
        Sums::<T, N>::multiply(a.terms(), b, |a| (kept[a], negative[a])).finish()
    }

    fn map(&self, f: impl Fn(usize, T) -> (usize, T)) -> Self {
        sized!(summed(self.terms().map(|(blade, value)| f(blade, value))))
    }

    /// The reverse.
    #[must_use]
    pub fn rev(&self) -> Self {
        self.map(|blade, value| (blade, if REVERSED >> blade & 1 == 1 { -value } else { value }))
    }

    /// The part of one grade.
    #[must_use]
    pub fn grade(&self, grade: u32) -> Self {
        let terms = self.terms().filter(|(blade, _)| blade.count_ones() == grade);
        sized!(summed(terms))
    }

    /// The bits of the pseudoscalar's blade.
    const FULL: usize = (1 << M::SQUARES.len()) - 1;
    /// Was a pseudoscalar declared, and `I²` is not 0?
    const HAS_DUAL: bool =
        M::PSEUDOSCALAR_SIGN != 0 && Products::new(M::SQUARES).geometric[Self::FULL] >> Self::FULL & 1 == 1;

    /// `I a`; `None` where no pseudoscalar was declared or `I² = 0`.
    #[must_use]
    pub fn dual(&self) -> Option<Self> {
        Self::HAS_DUAL.then(|| self.dual_unchecked())
    }

    /// `I^-1 a`.
    #[must_use]
    pub fn undual(&self) -> Option<Self> {
        Self::HAS_DUAL.then(|| self.undual_unchecked())
    }

    /// `I a` for generated code, which has checked that there is a dual: else this does not compile.
    #[doc(hidden)]
    #[must_use]
    pub fn __dual(&self) -> Self {
        const { assert!(Self::HAS_DUAL, "no pseudoscalar with a square other than 0") };
        self.dual_unchecked()
    }

    /// `I^-1 a` for generated code.
    #[doc(hidden)]
    #[must_use]
    pub fn __undual(&self) -> Self {
        const { assert!(Self::HAS_DUAL, "no pseudoscalar with a square other than 0") };
        self.undual_unchecked()
    }

    fn dual_unchecked(&self) -> Self {
        self.times_pseudoscalar(M::PSEUDOSCALAR_SIGN < 0)
    }

    fn undual_unchecked(&self) -> Self {
        let square_is_negative = Table::<M>::PRODUCTS.negative[Self::FULL] >> Self::FULL & 1 == 1;
        self.times_pseudoscalar((M::PSEUDOSCALAR_SIGN < 0) != square_is_negative)
    }

    /// The product of the orthonormal basis in order, times `self`, times the given sign.
    fn times_pseudoscalar(&self, negated: bool) -> Self {
        let row = Table::<M>::PRODUCTS.negative[Self::FULL];
        let negative = if negated { !row } else { row };
        self.map(|blade, value| (Self::FULL ^ blade, if negative >> blade & 1 == 1 { -value } else { value }))
    }

    /// `undual(dual a ^ dual b)`; where `I² = 0` the regressive product of which the declared I is the unit, as in
    /// generated code. `None` where no pseudoscalar was declared.
    #[must_use]
    pub fn meet(&self, other: &Self) -> Option<Self> {
        (M::PSEUDOSCALAR_SIGN != 0).then(|| self.meet_unchecked(other))
    }

    /// The meet for generated code, which has checked that a pseudoscalar was declared: else this does not compile.
    #[doc(hidden)]
    #[must_use]
    pub fn __meet(&self, other: &Self) -> Self {
        const { assert!(M::PSEUDOSCALAR_SIGN != 0, "no pseudoscalar") };
        self.meet_unchecked(other)
    }

    fn meet_unchecked(&self, other: &Self) -> Self {
        if Self::HAS_DUAL {
            (&self.dual_unchecked() ^ &other.dual_unchecked()).undual_unchecked()
        } else {
            self.regressive(other)
        }
    }

    fn regressive(&self, other: &Self) -> Self {
        sized!(regressive_of(self, other))
    }

    /// By the common factor, `(a' ^ f) & (f ^ b') = [a' ^ f ^ b'] f` with `[I] = 1`: no complement is taken.
    fn regressive_of<const N: usize>(a: &Self, b: &Self) -> Self {
        let mut sums = Sums::<T, N>::new();
        let negative = &Table::<M>::PRODUCTS.negative;
        let odd = |left: usize, right: usize| negative[left] >> right & 1 == 1;
        for (blade_a, x) in a.terms() {
            for (blade_b, y) in b.terms().filter(|(blade_b, _)| blade_a | blade_b == Self::FULL) {
                // The sign of `a' ^ f` against a enters both sides.
                let (common, rest) = (blade_a & blade_b, blade_b & !blade_a);
                let negated = odd(common, rest) ^ odd(blade_a, rest) ^ (M::PSEUDOSCALAR_SIGN < 0);
                let product = x * y;
                sums.add(common, if negated { -product } else { product });
            }
        }
        sums.finish()
    }

    /// `self x ~self`, restricted to the grades of x.
    #[must_use]
    pub fn apply(&self, x: &Self) -> Self {
        sized!(image_of(self, x))
    }

    /// The half-way product stays on the stack, the reverse is read off the versor itself, and of the second product
    /// only the wanted grades are formed.
    fn image_of<const N: usize>(versor: &Self, x: &Self) -> Self {
        let Products { geometric, negative, .. } = Table::<M>::PRODUCTS;
        let half = Sums::<T, N>::multiply(versor.terms(), x, |a| (geometric[a], negative[a]));
        let half = Bits(half.present).map(|blade| (blade, half.values[blade & (N - 1)]));
        let wanted = GRADES.iter().filter(|grade| *grade & x.present != 0).fold(0, |all, grade| all | grade);
        let row = |a: usize| (geometric[a] & translated::<N>(wanted, a), negative[a] ^ REVERSED);
        Sums::<T, N>::multiply(half, versor, row).finish()
    }

    fn from_both(a: &Self, b: &Self) -> Self {
        sized!(summed(a.terms().chain(b.terms())))
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
    Mul mul |a, b| a.product(b, &Table::<M>::PRODUCTS.geometric);
    /// The outer product.
    BitXor bitxor |a, b| a.product(b, &Table::<M>::PRODUCTS.outer);
    /// The left contraction.
    BitOr bitor |a, b| a.product(b, &Table::<M>::PRODUCTS.contraction);
    /// The sum.
    Add add |a, b| Dynamic::from_both(a, b);
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
    /// The meet; `None` where no pseudoscalar was declared.
    fn bitand(self, other: Self) -> Option<Dynamic<M, T>> {
        self.meet(other)
    }
}

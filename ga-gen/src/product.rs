//! The three products and the unary operations on multivectors of the generator, on bare blades: what survives, and
//! with which factor. Everything that multiplies multivectors in this crate goes through [`blade_product`].

use crate::blade::{Blade, swaps_are_odd};
use crate::scalar::Rational;
use crate::signature::{Signature, Terms};

/// A bilinear product.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// `a b`, operator `*`.
    Geometric,
    /// `a ^ b`: the part of grade `r + s`.
    Outer,
    /// `a | b`, left contraction: the part of grade `s - r`.
    Contraction,
}

/// The product of two basis blades.
pub fn blade_product(signature: &Signature, kind: Kind, a: Blade, b: Blade) -> impl Iterator<Item = (Blade, Rational)> {
    let survives = move |blade: Blade| match kind {
        Kind::Geometric => true,
        Kind::Outer => blade.grade() == a.grade() + b.grade(),
        Kind::Contraction => blade.grade() + a.grade() == b.grade(),
    };
    signature.geometric(a, b).iter().copied().filter(move |(blade, _)| survives(*blade))
}

/// `I`, as a basis blade of highest grade with its sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pseudoscalar {
    /// The blade.
    pub blade: Blade,
    /// The sign.
    pub sign: Rational,
    /// `I^2`: 0 where the metric is degenerate, and then there is no dual, and the meet goes by complements.
    pub square: Rational,
}

impl Pseudoscalar {
    /// The pseudoscalar `sign * (all basis vectors)`.
    #[must_use]
    pub fn new(signature: &Signature, sign: Rational) -> Self {
        let blade = Blade((1 << signature.dimension()) - 1);
        let square = signature.geometric(blade, blade);
        let square = square.iter().find(|(b, _)| *b == Blade::SCALAR).map_or(Rational::ZERO, |(_, c)| *c);
        Self { blade, sign, square }
    }

    /// `dual(b) = I b`.
    #[must_use]
    pub fn dual(self, signature: &Signature, b: Blade) -> Terms {
        scaled(signature.geometric(self.blade, b), self.sign)
    }

    /// `undual(b) = I^-1 b`, the inverse of [`Self::dual`].
    #[must_use]
    pub fn undual(self, signature: &Signature, b: Blade) -> Terms {
        let inverse = (self.sign * self.square).recip().unwrap_or(Rational::ZERO);
        scaled(signature.geometric(self.blade, b), inverse)
    }

    /// The right complement, `b ^ complement(b) = I`: needs no metric, only the order that `I` gives to the basis.
    #[must_use]
    pub fn complement(self, b: Blade) -> Terms {
        let rest = Blade(self.blade.0 & !b.0);
        vec![(rest, if swaps_are_odd(b, rest) { -self.sign } else { self.sign })]
    }

    /// The left complement, `uncomplement(b) ^ b = I`: the inverse of [`Self::complement`].
    #[must_use]
    pub fn uncomplement(self, b: Blade) -> Terms {
        let rest = Blade(self.blade.0 & !b.0);
        vec![(rest, if swaps_are_odd(rest, b) { -self.sign } else { self.sign })]
    }
}

fn scaled(terms: &[(Blade, Rational)], factor: Rational) -> Terms {
    terms.iter().map(|(blade, c)| (*blade, *c * factor)).collect()
}

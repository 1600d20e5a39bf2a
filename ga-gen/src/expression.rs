//! Multivector expressions: what an item computes, before any scalar is named.

use crate::blade::Blade;
use crate::product;
use crate::scalar::Rational;
use std::collections::BTreeMap;

/// A multivector expression over typed parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Expression {
    /// The parameter with this index; in a formula, the ones after the parameters are its steps.
    Input(usize),
    /// A constant multivector.
    Constant(BTreeMap<Blade, Rational>),
    /// A linear combination.
    Sum(Vec<(Rational, Expression)>),
    /// A bilinear product.
    Product(product::Kind, Box<Expression>, Box<Expression>),
    /// `undual(dual a ^ dual b)`; where `I^2 = 0`, `uncomplement(complement a ^ complement b)`.
    Meet(Box<Expression>, Box<Expression>),
    /// The reverse: every blade's factors in reversed order.
    Reverse(Box<Expression>),
    /// `I a`.
    Dual(Box<Expression>),
    /// `I^-1 a`.
    Undual(Box<Expression>),
    /// The part of one grade.
    Grade(u32, Box<Expression>),
    /// `v x ~v`, restricted to the grades of x.
    Sandwich(Box<Expression>, Box<Expression>),
}

impl Expression {
    /// `a * b`, `a ^ b` or `a | b`.
    #[must_use]
    pub fn product(kind: product::Kind, a: Self, b: Self) -> Self {
        Self::Product(kind, Box::new(a), Box::new(b))
    }

    /// `a + sign b`.
    #[must_use]
    pub fn sum(a: Self, sign: Rational, b: Self) -> Self {
        Self::Sum(vec![(Rational::ONE, a), (sign, b)])
    }

    /// Adds the operands that it reads to a list.
    pub fn operands(&self, found: &mut Vec<usize>) {
        match self {
            Self::Input(index) => found.push(*index),
            Self::Constant(_) => {}
            Self::Sum(parts) => parts.iter().for_each(|(_, part)| part.operands(found)),
            Self::Product(_, a, b) | Self::Meet(a, b) | Self::Sandwich(a, b) => {
                a.operands(found);
                b.operands(found);
            }
            Self::Reverse(a) | Self::Dual(a) | Self::Undual(a) | Self::Grade(_, a) => a.operands(found),
        }
    }

    /// The number that it is, if it is one.
    #[must_use]
    pub fn as_number(&self) -> Option<Rational> {
        match self {
            Self::Constant(terms) if terms.is_empty() => Some(Rational::ZERO),
            Self::Constant(terms) if terms.len() == 1 => terms.get(&Blade::SCALAR).copied(),
            Self::Sum(parts) => {
                let mut numbers = parts.iter().map(|(factor, part)| Some(*factor * part.as_number()?));
                numbers.try_fold(Rational::ZERO, |sum, number| Some(sum + number?))
            }
            Self::Product(product::Kind::Geometric, a, b) => Some(a.as_number()? * b.as_number()?),
            _ => None,
        }
    }

    /// A number.
    #[must_use]
    pub fn number(value: Rational) -> Self {
        Self::Constant([(Blade::SCALAR, value)].into())
    }
}

//! Multivector expressions: what an item computes, before any scalar is named.

use crate::blade::Blade;
use crate::product;
use crate::scalar::Rational;
use std::collections::BTreeMap;

/// A multivector expression over typed parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Expression {
    /// The parameter with this index.
    Input(usize),
    /// A constant multivector.
    Constant(BTreeMap<Blade, Rational>),
    /// A linear combination.
    Sum(Vec<(Rational, Expression)>),
    /// A bilinear product.
    Product(product::Kind, Box<Expression>, Box<Expression>),
    /// `undual(dual a ^ dual b)`.
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
    /// Divided by its weight, or by its norm where the result type has no weight.
    Normalised(Box<Expression>),
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
}

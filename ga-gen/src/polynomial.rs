//! Polynomials with rational coefficients: what a type's coefficient is in terms of its fields.

use crate::field::Fingerprint;
use crate::scalar::Rational;
use std::collections::BTreeMap;

/// A sum of products of fields; a field is named by its index, a product is a sorted list of indices.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Polynomial(BTreeMap<Vec<usize>, Rational>);

impl Polynomial {
    /// A constant.
    #[must_use]
    pub fn constant(value: Rational) -> Self {
        Self::monomial(value, vec![])
    }

    /// One field.
    #[must_use]
    pub fn field(index: usize) -> Self {
        Self::monomial(Rational::ONE, vec![index])
    }

    fn monomial(value: Rational, fields: Vec<usize>) -> Self {
        let mut result = Self::default();
        result.add_term(fields, value);
        result
    }

    fn add_term(&mut self, fields: Vec<usize>, value: Rational) {
        let sum = self.0.get(&fields).copied().unwrap_or(Rational::ZERO) + value;
        if sum.is_zero() {
            self.0.remove(&fields);
        } else {
            self.0.insert(fields, sum);
        }
    }

    /// The terms, in a fixed order.
    pub fn terms(&self) -> impl Iterator<Item = (&[usize], Rational)> {
        self.0.iter().map(|(fields, value)| (fields.as_slice(), *value))
    }

    /// Is it identically zero?
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Its value, if it has no field.
    #[must_use]
    pub fn as_constant(&self) -> Option<Rational> {
        match self.0.len() {
            0 => Some(Rational::ZERO),
            1 => self.0.get(&vec![]).copied(),
            _ => None,
        }
    }

    /// `(c, field)` if it is `c * field`.
    #[must_use]
    pub fn as_stored(&self) -> Option<(Rational, usize)> {
        let (fields, value) = self.0.first_key_value().filter(|_| self.0.len() == 1)?;
        if let [field] = fields[..] { Some((*value, field)) } else { None }
    }

    /// `c`, if it is `c * field + (terms without the field)`.
    #[must_use]
    pub fn linear_in(&self, field: usize) -> Option<Rational> {
        let mut with = self.terms().filter(|(fields, _)| fields.contains(&field));
        let (fields, value) = with.next()?;
        (fields.len() == 1 && with.next().is_none()).then_some(value)
    }

    /// All fields that occur.
    #[must_use]
    pub fn fields(&self) -> Vec<usize> {
        let mut fields: Vec<usize> = self.0.keys().flatten().copied().collect();
        fields.sort_unstable();
        fields.dedup();
        fields
    }

    /// Sum.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let mut result = self.clone();
        for (fields, value) in other.terms() {
            result.add_term(fields.to_vec(), value);
        }
        result
    }

    /// Product.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let mut result = Self::default();
        for (a, x) in self.terms() {
            for (b, y) in other.terms() {
                let mut fields = [a, b].concat();
                fields.sort_unstable();
                result.add_term(fields, x * y);
            }
        }
        result
    }

    /// The same polynomial in fields that are counted from further on.
    #[must_use]
    pub fn shifted(&self, by: usize) -> Self {
        let shift = |fields: &Vec<usize>| fields.iter().map(|field| field + by).collect();
        Self(self.0.iter().map(|(fields, value)| (shift(fields), *value)).collect())
    }

    /// Product with a number.
    #[must_use]
    pub fn scaled(&self, factor: Rational) -> Self {
        self.times(&Self::constant(factor))
    }

    /// The value for given fields.
    #[must_use]
    pub fn fingerprint(&self, fields: &[Fingerprint]) -> Fingerprint {
        self.terms().fold(Fingerprint::constant(Rational::ZERO), |sum, (term, value)| {
            let product = term.iter().fold(Fingerprint::constant(value), |p, field| p.times(fields[*field]));
            sum.plus(product)
        })
    }
}

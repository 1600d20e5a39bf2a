//! Products in a split basis: matrix units in the place of basis blades.
//!
//! A null pair `(o, i)` with `o.i = c` makes `E = o ^ i` with `E² = 1`, and with it the idempotents `P, Q = (1 ± E)/2`.
//! Every multivector is `p P + q Q + v o + w (c/2) i` with p, q, v, w from the algebra of the other vectors, and products
//! of P, Q, o and i are single terms or zero, where the blade table has `o i = c + E`: eight small products in the place
//! of a table in which every second product has two terms. A vector a with `a² = 1` splits what is left a second time,
//! by `(1 ± a)/2`.
//!
//! Exact in the algebra, but only as accurate as the coordinates: `p = A0 + A1` of a multivector that is stored by its
//! blades mixes sizes. So the split is used by itself where a type is *stored* split, and else on demand.

use crate::blade::{Blade, swaps_are_odd};
use crate::lower::{Components, Lowering};
use crate::program::Scaled;
use crate::scalar::Rational;
use crate::signature::{Kind, Signature};
use std::collections::BTreeMap;

/// How far to split.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Depth {
    /// On the first null pair.
    Pair,
    /// On the first null pair, and then on the last vector with square 1.
    PairAndVector,
}

/// A sparse linear map: each result as a sum of multiples of what goes in.
type Map = Vec<Vec<(usize, Rational)>>;

/// A split basis. Coordinates are counted like the blades at whose place they stand.
#[derive(Clone, Debug)]
pub struct SplitBasis {
    /// From blade coefficients to coordinates, stage by stage; each stage forms sums of two at most.
    pub forward: Vec<Map>,
    /// From coordinates to blade coefficients.
    pub backward: Vec<Map>,
    /// The product of two coordinates, by `left * size + right`.
    pub products: Map,
}

impl SplitBasis {
    /// The split of a signature, if it has what is to be split.
    #[must_use]
    pub fn new(signature: &Signature, depth: Depth) -> Option<Self> {
        let kinds = signature.kinds();
        let (pair, c) = kinds.iter().enumerate().find_map(|(index, kind)| match kind {
            Kind::PairFirst(c) => Some((index, *c)),
            _ => None,
        })?;
        let mut stages = vec![pair_stage(signature, pair, c)];
        if depth == Depth::PairAndVector {
            let vector = kinds.iter().rposition(|kind| *kind == Kind::Square(1))?;
            stages.push(vector_stage(signature, vector, pair));
        }
        let (forward, backward): (Vec<Map>, Vec<Map>) = stages.into_iter().unzip();
        let backward: Vec<Map> = backward.into_iter().rev().collect();
        let products = products(signature, &forward, &backward);
        Some(Self { forward, backward, products })
    }
}

/// The pairs `(b, b E)` become `(b P, b Q)`; `b i` becomes `b (c/2) i`.
fn pair_stage(signature: &Signature, pair: usize, c: i8) -> (Map, Map) {
    let (o, i) = (Blade::vector(pair), Blade::vector(pair + 1));
    let both = Blade(o.0 | i.0);
    let c = Rational::from(i32::from(c));
    split(signature, both, both, |blade| match blade.0 & both.0 {
        part if part == i.0 => Some(c * Rational::from(2)),
        part if part == o.0 => Some(Rational::ONE),
        _ => None,
    })
}

/// The pairs `(x, x a)` become `(x (1 + a)/2, x (1 - a)/2)`, x in front of each of P, Q, o and i.
fn vector_stage(signature: &Signature, vector: usize, pair: usize) -> (Map, Map) {
    split(signature, Blade::vector(vector), Blade(0b11 << pair), |_| None)
}

/// `(x, x u)` to `x (1 ± u)/2`, for a blade u with square 1; `kept` are left, scaled. The pair's vectors only say at
/// which element of the pair x stands.
fn split(signature: &Signature, unit: Blade, pair: Blade, kept: impl Fn(Blade) -> Option<Rational>) -> (Map, Map) {
    let size = 1 << signature.dimension();
    let half = Rational::new(1, 2).unwrap_or(Rational::ONE);
    let (mut forward, mut backward): (Map, Map) = (vec![vec![]; size], vec![vec![]; size]);
    for index in 0..size {
        let blade = Blade(u32::try_from(index).unwrap_or_default());
        if let Some(scale) = kept(blade) {
            forward[index] = vec![(index, scale)];
            backward[index] = vec![(index, scale.recip().unwrap_or(Rational::ONE))];
        } else if blade.0 & unit.0 == 0 {
            let other = (blade.0 | unit.0) as usize;
            // x u may be minus the blade in declared order.
            let sign = if swaps_are_odd(Blade(blade.0 & !pair.0), unit) { -Rational::ONE } else { Rational::ONE };
            forward[index] = vec![(index, Rational::ONE), (other, sign)];
            forward[other] = vec![(index, Rational::ONE), (other, -sign)];
            backward[index] = vec![(index, half), (other, half)];
            backward[other] = vec![(index, half * sign), (other, -half * sign)];
        }
    }
    (forward, backward)
}

fn apply(map: &Map, values: &BTreeMap<usize, Rational>) -> BTreeMap<usize, Rational> {
    let mut result = BTreeMap::new();
    for (index, row) in map.iter().enumerate() {
        let value = |input: &usize| values.get(input).copied().unwrap_or(Rational::ZERO);
        let sum = row.iter().fold(Rational::ZERO, |sum, (input, factor)| sum + value(input) * *factor);
        if !sum.is_zero() {
            result.insert(index, sum);
        }
    }
    result
}

fn products(signature: &Signature, forward: &[Map], backward: &[Map]) -> Map {
    let size = 1 << signature.dimension();
    let element = |index| backward.iter().fold(BTreeMap::from([(index, Rational::ONE)]), |x, map| apply(map, &x));
    let elements: Vec<BTreeMap<usize, Rational>> = (0..size).map(element).collect();
    let blade = |index: usize| Blade(u32::try_from(index).unwrap_or_default());
    let mut table = Vec::with_capacity(size * size);
    for left in &elements {
        for right in &elements {
            let mut product: BTreeMap<usize, Rational> = BTreeMap::new();
            for (a, x) in left {
                for (b, y) in right {
                    for (image, c) in signature.geometric(blade(*a), blade(*b)) {
                        let sum = product.entry(image.0 as usize).or_insert(Rational::ZERO);
                        *sum = *sum + *x * *y * *c;
                    }
                }
            }
            let product = forward.iter().fold(product, |x, map| apply(map, &x));
            table.push(product.into_iter().collect());
        }
    }
    table
}

/// Coordinates or coefficients at lowering, by index.
type Lowered = BTreeMap<usize, Scaled>;

impl Lowering<'_> {
    /// A geometric product by way of the split basis; `None` where the metric has none.
    pub fn split_product(&mut self, depth: Depth, a: &Components, b: &Components) -> Option<Components> {
        let basis = self.spec.split_basis(depth)?;
        let size = 1 << self.spec.signature.dimension();
        let (x, y) = (self.coordinates(&basis.forward, a), self.coordinates(&basis.forward, b));
        let hint = self.hint();
        let mut sums: BTreeMap<usize, Vec<(Rational, Vec<Scaled>)>> = BTreeMap::new();
        for (i, u) in &x {
            for (j, v) in &y {
                for (k, factor) in &basis.products[i * size + j] {
                    sums.entry(*k).or_default().push((*factor, vec![*u, *v]));
                }
            }
        }
        let product: Lowered = sums.iter().map(|(k, terms)| (*k, self.builder.sum(terms, &hint))).collect();
        let blades = basis.backward.iter().fold(product, |values, map| self.mapped(map, &values));
        Some(
            blades.into_iter().map(|(index, value)| (Blade(u32::try_from(index).unwrap_or_default()), value)).collect(),
        )
    }

    fn coordinates(&mut self, forward: &[Map], a: &Components) -> Lowered {
        let blades: Lowered = a.iter().map(|(blade, value)| (blade.0 as usize, *value)).collect();
        forward.iter().fold(blades, |values, map| self.mapped(map, &values))
    }

    fn mapped(&mut self, map: &Map, values: &Lowered) -> Lowered {
        let mut result = Lowered::new();
        for (index, row) in map.iter().enumerate() {
            let terms: Vec<_> = row.iter().filter_map(|(i, c)| Some((*c, vec![*values.get(i)?]))).collect();
            let value = self.builder.sum(&terms, "split");
            if !value.is_zero() {
                result.insert(index, value);
            }
        }
        result
    }

    /// Are the coordinates of both operands known already, and do they differ from the coefficients at all?
    pub(crate) fn is_stored_split(&mut self, a: &Components, b: &Components) -> bool {
        let Some(basis) = self.spec.split_basis(Depth::Pair).filter(|_| self.stored_split) else { return false };
        let mixes = |row: &Vec<(usize, Rational)>, x: &Components| {
            row.iter().filter(|(i, _)| x.keys().any(|blade| blade.0 as usize == *i)).count() > 1
        };
        if !basis.forward.iter().flatten().any(|row| mixes(row, a) || mixes(row, b)) {
            return false;
        }
        let mark = self.builder.entries().len();
        self.coordinates(&basis.forward, a);
        self.coordinates(&basis.forward, b);
        let known = self.builder.entries().len() == mark;
        self.builder.roll_back(mark);
        known
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn conformal() -> Signature {
        let mut signature = Signature::default();
        for name in ["e1", "e2", "e3"] {
            signature.push(name.into(), 1);
        }
        signature.push_pair("no".into(), "ninf".into(), -1);
        signature
    }

    #[test]
    fn coordinates_lead_back_to_the_blades() {
        for depth in [Depth::Pair, Depth::PairAndVector] {
            let basis = SplitBasis::new(&conformal(), depth).expect("there is a null pair");
            for index in 0..32 {
                let start = BTreeMap::from([(index, Rational::ONE)]);
                let there = basis.forward.iter().fold(start.clone(), |x, map| apply(map, &x));
                assert_eq!(basis.backward.iter().fold(there, |x, map| apply(map, &x)), start, "{depth:?} {index}");
            }
        }
    }

    #[test]
    fn products_have_one_term_or_none_and_are_fewer_than_in_the_table() {
        let count = |depth| {
            let basis = SplitBasis::new(&conformal(), depth).expect("there is a null pair");
            assert!(basis.products.iter().all(|terms| terms.len() <= 1), "{depth:?}");
            basis.products.iter().filter(|terms| terms.len() == 1).count()
        };
        assert_eq!(count(Depth::Pair), 512, "half of 32 x 32");
        assert_eq!(count(Depth::PairAndVector), 256, "a quarter");
    }
}

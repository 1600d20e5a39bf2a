//! How a type stores a multivector: reading its fields back from the coefficients.
//!
//! A type says what each coefficient is in terms of its fields. Where that is linear, the fields follow by Gaussian
//! elimination over the rationals: a stored coefficient is the simplest case, a versor that is stored split on a null
//! pair (`(p + q)/2 + (p - q)/2*no_ninf`) the next. Fields that occur in derived coefficients only have no such reading
//! (see [`crate::infer`]).

use crate::blade::Blade;
use crate::polynomial::Polynomial;
use crate::scalar::Rational;
use std::collections::BTreeMap;

/// A field as a linear combination of coefficients, plus a constant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Readout {
    /// The coefficients with their factors.
    pub terms: Vec<(Blade, Rational)>,
    /// What is added.
    pub constant: Rational,
}

/// One linear equation: the fields on the left, coefficients and a constant on the right.
#[derive(Clone, Debug)]
struct Row {
    left: Vec<Rational>,
    right: BTreeMap<Blade, Rational>,
    constant: Rational,
}

impl Row {
    fn scaled(&self, factor: Rational) -> Self {
        Self {
            left: self.left.iter().map(|c| *c * factor).collect(),
            right: self.right.iter().map(|(blade, c)| (*blade, *c * factor)).collect(),
            constant: self.constant * factor,
        }
    }

    fn minus(&mut self, other: &Self) {
        self.left.iter_mut().zip(&other.left).for_each(|(a, b)| *a = *a - *b);
        for (blade, c) in &other.right {
            let sum = self.right.entry(*blade).or_insert(Rational::ZERO);
            *sum = *sum - *c;
        }
        self.constant = self.constant - other.constant;
    }
}

/// The reading of each field, where the linear coefficients determine it.
#[must_use]
pub fn readouts(coefficients: &BTreeMap<Blade, Polynomial>, fields: usize) -> Vec<Option<Readout>> {
    // Simple rows first: where a field is stored as such, that is how it is read.
    let mut rows: Vec<Row> = coefficients.iter().filter_map(|(blade, p)| linear_row(*blade, p, fields)).collect();
    rows.sort_by_key(|row| row.left.iter().filter(|c| !c.is_zero()).count());
    let mut pivots: Vec<Option<Row>> = vec![None; fields];
    for mut row in rows {
        for (field, pivot) in pivots.iter().enumerate() {
            if let Some(pivot) = pivot {
                row.minus(&pivot.scaled(row.left[field]));
            }
        }
        let Some(field) = row.left.iter().position(|c| !c.is_zero()) else { continue };
        let Some(inverse) = row.left[field].recip() else { continue };
        let row = row.scaled(inverse);
        for pivot in pivots.iter_mut().flatten() {
            pivot.minus(&row.scaled(pivot.left[field]));
        }
        pivots[field] = Some(row);
    }
    pivots.into_iter().map(|pivot| pivot.and_then(solved)).collect()
}

fn linear_row(blade: Blade, polynomial: &Polynomial, fields: usize) -> Option<Row> {
    let mut left = vec![Rational::ZERO; fields];
    let mut constant = Rational::ZERO;
    for (factors, value) in polynomial.terms() {
        match factors {
            [] => constant = -value,
            [field] => left[*field] = value,
            _ => return None,
        }
    }
    Some(Row { left, right: BTreeMap::from([(blade, Rational::ONE)]), constant })
}

fn solved(row: Row) -> Option<Readout> {
    let alone = row.left.iter().filter(|c| !c.is_zero()).count() == 1;
    let terms = row.right.into_iter().filter(|(_, c)| !c.is_zero()).collect();
    alone.then_some(Readout { terms, constant: row.constant })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(n: i128, d: i128) -> Rational {
        Rational::new(n, d).expect("denominator is not zero")
    }

    #[test]
    fn sums_and_differences_are_solved_and_derived_fields_are_not() {
        let [p, q, r] = [0, 1, 2].map(Polynomial::field);
        let half = ratio(1, 2);
        let coefficients = BTreeMap::from([
            (Blade(0), p.plus(&q).scaled(half)),
            (Blade(1), p.plus(&q.scaled(-Rational::ONE)).scaled(half)),
            (Blade(2), r.times(&r)),
        ]);
        let readouts = readouts(&coefficients, 3);
        let terms = |sign: Rational| vec![(Blade(0), Rational::ONE), (Blade(1), sign)];
        assert_eq!(readouts[0].as_ref().expect("linear").terms, terms(Rational::ONE));
        assert_eq!(readouts[1].as_ref().expect("linear").terms, terms(-Rational::ONE));
        assert_eq!(readouts[2], None);
    }

    #[test]
    fn a_constant_part_moves_to_the_other_side() {
        let x = Polynomial::field(0).scaled(ratio(-1, 2)).plus(&Polynomial::constant(Rational::ONE));
        let readouts = readouts(&BTreeMap::from([(Blade(4), x)]), 1);
        let expected = Readout { terms: vec![(Blade(4), Rational::from(-2))], constant: Rational::from(2) };
        assert_eq!(readouts[0], Some(expected));
    }
}

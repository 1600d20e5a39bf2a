//! Division of a multivector by its weight or by its norm.

use crate::blade::Blade;
use crate::lower::{Components, Lowering};
use crate::program::Scaled;
use crate::scalar::Rational;
use std::collections::BTreeMap;

/// `a / sqrt(|<a ~a>|)`, and the sign of `<a ~a>`; `None` where that is not a sum of squares of one sign, so that its
/// own is not known.
pub fn by_norm(lowering: &mut Lowering<'_>, a: &Components) -> Option<(Components, Rational)> {
    let square = lowering.norm_sq(a);
    let sign = lowering.builder.sign_of_squares(square)?;
    let root = lowering.builder.sqrt(square.scaled(sign), "norm");
    let inverse = lowering.builder.quotient(Rational::ONE, root, "inv_norm")?;
    Some((lowering.scaled(a, inverse), sign))
}

/// Divides by the coefficient that the type fixes; also returns by what it multiplied. One division: the reciprocal
/// carries the factor that most stored coefficients share.
pub fn by_weight(
    lowering: &mut Lowering<'_>,
    components: &Components,
    weight: (Blade, Rational),
) -> Option<(Components, Scaled)> {
    let (blade, constant) = weight;
    let weight = components.get(&blade)?.scaled(constant.recip()?);
    let inverse = weight.coefficient.recip()?;
    let mut shares: BTreeMap<Rational, usize> = BTreeMap::new();
    for value in components.iter().filter(|(other, _)| **other != blade).map(|(_, value)| value) {
        *shares.entry((value.coefficient * inverse).abs()).or_insert(0) += 1;
    }
    let share = shares.into_iter().max_by_key(|(_, count)| *count).map_or(Rational::ONE, |(share, _)| share);
    let reciprocal = lowering.builder.quotient(share * weight.coefficient, weight, "inv_weight")?;
    let factor = reciprocal.scaled((share * weight.coefficient).recip()?);
    Some((lowering.scaled(components, factor), factor))
}

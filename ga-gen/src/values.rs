//! Multivectors at the random points: what is decided about a lowered multivector without writing code for it.

use crate::blade::Blade;
use crate::field::Fingerprint;
use crate::lower::Components;
use crate::program::Builder;
use crate::scalar::Rational;
use crate::signature::{Kind, Signature};
use std::collections::BTreeMap;

/// The fingerprint in front of each blade; a blade that is absent has coefficient zero.
pub type Values = BTreeMap<Blade, Fingerprint>;

/// The values of lowered components.
#[must_use]
pub fn of(builder: &Builder, components: &Components) -> Values {
    components.iter().map(|(blade, value)| (*blade, builder.fingerprint(*value))).collect()
}

/// The geometric product, without zeros.
#[must_use]
pub fn product(signature: &Signature, a: &Values, b: &Values) -> Values {
    let mut result = Values::new();
    for (blade_a, x) in a {
        for (blade_b, y) in b {
            let value = x.times(*y);
            for (blade, c) in signature.geometric(*blade_a, *blade_b) {
                let sum = result.entry(*blade).or_insert(Fingerprint::constant(Rational::ZERO));
                *sum = sum.plus(value.times(Fingerprint::constant(*c)));
            }
        }
    }
    result.retain(|_, value| !value.is_zero());
    result
}

/// The reverse.
#[must_use]
pub fn reversed(a: &Values) -> Values {
    let minus = Fingerprint::constant(-Rational::ONE);
    a.iter().map(|(blade, x)| (*blade, if blade.reverse_is_negative() { x.times(minus) } else { *x })).collect()
}

/// One basis blade.
#[must_use]
pub fn blade(blade: Blade) -> Values {
    Values::from([(blade, Fingerprint::constant(Rational::ONE))])
}

/// `a ~a = 1`.
#[must_use]
pub fn is_unit(signature: &Signature, a: &Values) -> bool {
    product(signature, a, &reversed(a)) == blade(Blade::SCALAR)
}

/// Does a unit versor keep every point at infinity, so that it neither scales nor inverts? Then `x + [v, x] ~v` adds no
/// large number that it takes away again.
#[must_use]
pub fn is_isometry(signature: &Signature, v: &Values) -> bool {
    let pairs = signature.kinds().iter().enumerate().filter(|(_, kind)| **kind == Kind::PairSecond);
    is_unit(signature, v)
        && pairs.map(|(index, _)| blade(Blade::vector(index))).all(|infinity| {
            let half = product(signature, v, &infinity);
            product(signature, &half, &reversed(v)) == infinity
        })
}

//! Random elements of a type, for fingerprints: unit types are sampled from their own manifold.

use crate::blade::Blade;
use crate::field::{Fingerprint, POINTS, Residue, Stream};
use crate::polynomial::Polynomial;
use crate::scalar::Rational;
use crate::spec::Spec;
use crate::types::Type;
use std::collections::BTreeMap;
use syn::Error;

impl Spec {
    /// Random values for the fields of a type, from its own manifold: unit types are sampled from unit elements.
    ///
    /// # Errors
    /// A unit type that is neither an even versor nor a vector.
    pub fn sample(&self, index: usize, parameter: &str) -> syn::Result<Vec<Fingerprint>> {
        let key = (index, parameter.to_string());
        if let Some(known) = self.samples.borrow().get(&key) {
            return Ok(known.clone());
        }
        let fields = self.sample_type(&self.types[index], parameter)?;
        self.samples.borrow_mut().insert(key, fields.clone());
        Ok(fields)
    }

    fn sample_type(&self, ty: &Type, parameter: &str) -> syn::Result<Vec<Fingerprint>> {
        if let Some(factors) = &ty.factors {
            let sampled: syn::Result<Vec<_>> = factors.iter().map(|f| self.sample_type(f, parameter)).collect();
            return Ok(sampled?.concat());
        }
        let mut stream = Stream::named(&format!("{parameter}: {}", ty.name));
        let mut fields = vec![Fingerprint::constant(Rational::ZERO); ty.fields.len()];
        let mut elements = Vec::new();
        for point in 0..POINTS {
            let element = if ty.unit { Some(self.unit_element(ty, &mut stream)?) } else { None };
            for (field, values) in fields.iter_mut().enumerate() {
                values.0[point] = match &element {
                    None => stream.next_residue(),
                    Some(element) => stored_value(ty, field, element),
                };
            }
            elements.extend(element);
        }
        let contradicts = |(blade, polynomial): (&Blade, &Polynomial)| {
            let Fingerprint(values) = polynomial.fingerprint(&fields);
            elements.iter().zip(values).any(|(element, value)| value_of(element, *blade) != value)
        };
        if ty.coefficients.iter().any(contradicts) {
            let message = "`unit` contradicts the constants of this type: a unit multivector has other coefficients";
            return Err(Error::new(ty.name.span(), message));
        }
        Ok(fields)
    }

    /// A random unit element: a product of `(a + b B)^2 / (a^2 - b^2 B^2)` over basis bivectors B, applied to a basis
    /// vector if the type is a vector.
    fn unit_element(&self, ty: &Type, stream: &mut Stream) -> syn::Result<Dense> {
        let blades: Vec<Blade> = ty.coefficients.keys().copied().collect();
        let is_vector = blades.iter().all(|blade| blade.grade() == 1);
        let bivectors: Vec<Blade> = if is_vector {
            pairs(&blades)
        } else {
            blades.iter().copied().filter(|blade| blade.grade() == 2).collect()
        };
        let mut versor: Dense = [(Blade::SCALAR, Residue::ONE)].into();
        for blade in [&bivectors[..], &bivectors[..]].concat() {
            let (a, b) = (stream.next_residue(), stream.next_residue());
            let factor: Dense = [(Blade::SCALAR, a), (blade, b)].into();
            let square = self.dense_product(&[(blade, Residue::ONE)].into(), &[(blade, Residue::ONE)].into());
            let square = square.get(&Blade::SCALAR).copied().unwrap_or(Residue::ZERO);
            let norm = a.times(a).plus(b.times(b).times(square).negated()).inverse();
            let mut unit = self.dense_product(&factor, &factor);
            unit.values_mut().for_each(|value| *value = value.times(norm));
            versor = self.dense_product(&versor, &unit);
        }
        let element = if is_vector {
            let start =
                blades.iter().copied().find(|b| self.signature.geometric(*b, *b) == [(Blade::SCALAR, Rational::ONE)]);
            let start = start.unwrap_or_default();
            let image = self.dense_product(&versor, &[(start, Residue::ONE)].into());
            self.dense_product(&image, &reversed(&versor))
        } else {
            versor
        };
        let inside =
            element.iter().all(|(blade, value)| *value == Residue::ZERO || ty.coefficients.contains_key(blade));
        let even = is_vector || blades.iter().all(|blade| blade.grade() % 2 == 0);
        if !(inside && even) {
            let message =
                "`unit` is for even versors that form a group, and for vectors; this set of blades is neither";
            return Err(Error::new(ty.name.span(), message));
        }
        Ok(element)
    }

    fn dense_product(&self, a: &Dense, b: &Dense) -> Dense {
        let mut result = Dense::new();
        for (blade_a, x) in a {
            for (blade_b, y) in b {
                for (blade, c) in self.signature.geometric(*blade_a, *blade_b) {
                    let sum = result.entry(*blade).or_insert(Residue::ZERO);
                    *sum = sum.plus(x.times(*y).times((*c).into()));
                }
            }
        }
        result
    }
}

/// A multivector over the prime field.
type Dense = BTreeMap<Blade, Residue>;

fn reversed(a: &Dense) -> Dense {
    a.iter().map(|(b, value)| (*b, if b.reverse_is_negative() { value.negated() } else { *value })).collect()
}

fn value_of(element: &Dense, blade: Blade) -> Residue {
    element.get(&blade).copied().unwrap_or(Residue::ZERO)
}

fn pairs(vectors: &[Blade]) -> Vec<Blade> {
    let all = vectors.iter().flat_map(|a| vectors.iter().map(move |b| (a, b)));
    all.filter(|(a, b)| a < b).map(|(a, b)| Blade(a.0 | b.0)).collect()
}

fn stored_value(ty: &Type, field: usize, element: &Dense) -> Residue {
    ty.readouts[field].as_ref().map_or(Residue::ZERO, |readout| {
        let term = |(blade, factor): &(Blade, Rational)| value_of(element, *blade).times((*factor).into());
        readout.terms.iter().fold(readout.constant.into(), |sum: Residue, part| sum.plus(term(part)))
    })
}

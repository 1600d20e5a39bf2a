//! Which declared type holds a result: the smallest one that is *proved* to.
//!
//! A type holds a multivector if every blade present is one of the type's, every constant and derived coefficient has
//! the value that the fields imply, and the type's facts hold. All of it is decided on fingerprints, on the manifold of
//! the inputs: so the product of two unit rotors is seen to be a unit rotor, the difference of two points is not taken
//! for a plane, and a sphere moved by a motor is seen to keep its radius.

use crate::blade::Blade;
use crate::field::Fingerprint;
use crate::lower::Components;
use crate::program::{Builder, Scaled};
use crate::spec::Spec;
use crate::types::Type;
use crate::values;

/// The type of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Output {
    /// A bare scalar.
    Scalar,
    /// A declared type.
    Type(usize),
}

/// The smallest type that holds the components, with its fields; ties go to unit types, then to the first declared.
#[must_use]
pub fn infer(
    spec: &Spec,
    builder: &mut Builder,
    components: &Components,
    full_allowed: bool,
) -> Option<(Output, Vec<Scaled>)> {
    if components.is_empty() {
        return None;
    }
    if let Some(value) = as_scalar(components) {
        return Some((Output::Scalar, vec![value]));
    }
    let mut candidates: Vec<usize> = (0..spec.types.len()).filter(|i| full_allowed || !spec.is_full(*i)).collect();
    candidates.sort_by_key(|index| (spec.types[*index].fields.len(), !spec.types[*index].unit));
    candidates.into_iter().find_map(|index| Some((Output::Type(index), fit(spec, builder, components, index)?)))
}

fn as_scalar(components: &Components) -> Option<Scaled> {
    (components.len() == 1).then(|| components.get(&Blade::SCALAR).copied()).flatten()
}

/// The fields of a type that hold the components, if it holds them.
pub fn fit(spec: &Spec, builder: &mut Builder, components: &Components, index: usize) -> Option<Vec<Scaled>> {
    fit_type(spec, builder, components, &spec.types[index])
}

/// The same for a type that need not be one of the algebra's own list.
pub fn fit_type(spec: &Spec, builder: &mut Builder, components: &Components, ty: &Type) -> Option<Vec<Scaled>> {
    if components.keys().any(|blade| !ty.coefficients.contains_key(blade)) {
        return None;
    }
    let mark = builder.entries().len();
    let fields = solve(builder, components, ty).filter(|fields| {
        let solved: Vec<Fingerprint> = fields.iter().map(|field| builder.fingerprint(*field)).collect();
        let proved = ty.coefficients.iter().all(|(blade, polynomial)| {
            let actual = components.get(blade).copied().unwrap_or(Scaled::ZERO);
            polynomial.fingerprint(&solved) == builder.fingerprint(actual)
        });
        proved && (!ty.unit || values::is_unit(&spec.signature, &values::of(builder, components)))
    });
    if fields.is_none() {
        builder.roll_back(mark);
    }
    fields
}

/// Fields from coefficients: those that are linear in them, then those that occur linearly in a derived coefficient.
fn solve(builder: &mut Builder, components: &Components, ty: &Type) -> Option<Vec<Scaled>> {
    let actual = |blade: &Blade| components.get(blade).copied().unwrap_or(Scaled::ZERO);
    let mut fields: Vec<Option<Scaled>> = Vec::new();
    for (field, readout) in ty.fields.iter().zip(&ty.readouts) {
        let linear = readout.as_ref().map(|readout| {
            let terms = readout.terms.iter().map(|(blade, factor)| (*factor, vec![actual(blade)]));
            let products: Vec<_> = terms.chain([(readout.constant, vec![])]).collect();
            builder.sum(&products, field)
        });
        fields.push(linear);
    }
    for (blade, polynomial) in &ty.coefficients {
        let unknown: Vec<usize> = polynomial.fields().into_iter().filter(|f| fields[*f].is_none()).collect();
        let [field] = unknown[..] else { continue };
        let inverse = polynomial.linear_in(field)?.recip()?;
        let mut products = vec![(inverse, vec![actual(blade)])];
        for (term, value) in polynomial.terms().filter(|(term, _)| !term.contains(&field)) {
            let scalars: Option<Vec<Scaled>> = term.iter().map(|f| fields[*f]).collect();
            products.push((-(value * inverse), scalars?));
        }
        fields[field] = Some(builder.sum(&products, &ty.fields[field]));
    }
    fields.into_iter().collect()
}

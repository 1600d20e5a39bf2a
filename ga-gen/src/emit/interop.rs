//! Tokens of the call that gives a type the traits of other crates: text, serialisation, bytes, comparison, sampling.
//!
//! The impls themselves are written by a macro of the library, `__interop!`, because only the library knows which
//! features it was built with. Here stands what that macro cannot find out: how a type reads, when a unit type is unit,
//! whether random values of it can be drawn.

use super::code::{self, identifier};
use crate::blade::Blade;
use crate::item;
use crate::scalar::Rational;
use crate::spec::Spec;
use crate::types::Type;
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};
use std::collections::{BTreeMap, BTreeSet};

/// The call for one type.
pub(super) fn interoperate(spec: &Spec, index: usize) -> TokenStream {
    let ty = &spec.types[index];
    let name = &ty.name;
    if ty.fields.is_empty() {
        let text = constants_text(spec, ty);
        return quote!(::ga_physics::__interop! { #name = #text });
    }
    let fields: Vec<Ident> = ty.fields.iter().map(|field| identifier(field)).collect();
    let texts = ty.fields.iter().map(|field| field.strip_prefix("r#").unwrap_or(field));
    let (form, constants) =
        if is_sum(spec, ty) { (quote!(terms), constants_text(spec, ty)) } else { (quote!(named), String::new()) };
    let unit = ty.unit.then(|| unit_check(spec, index));
    let sample = sample(spec, ty);
    quote! {
        ::ga_physics::__interop! {
            #name { #(#fields #texts)* }
            display #form #constants
            unit { #unit }
            sample #sample
        }
    }
}

/// Is the type a constant plus every stored number times the blade that it is named after?
fn is_sum(spec: &Spec, ty: &Type) -> bool {
    ty.coefficients.iter().all(|(blade, coefficient)| {
        let named = |(factor, field): (Rational, usize)| {
            let sign = |odd: bool| if odd { -Rational::ONE } else { Rational::ONE };
            let meant = spec.signature.parse(&ty.fields[field]);
            meant.is_some_and(|(meant, odd)| meant == *blade && factor == sign(odd))
        };
        coefficient.as_constant().is_some() || coefficient.as_stored().is_some_and(named)
    })
}

/// `1`, `no - 2 ninf`: what is the same in every value of the type.
fn constants_text(spec: &Spec, ty: &Type) -> String {
    let mut text = String::new();
    for (blade, coefficient) in &ty.coefficients {
        let Some(value) = coefficient.as_constant() else { continue };
        text.push_str(match (text.is_empty(), value.is_negative()) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        });
        let magnitude = value.abs();
        text.push_str(&match (*blade == Blade::SCALAR, magnitude == Rational::ONE) {
            (true, _) => magnitude.to_string(),
            (false, true) => spec.signature.name(*blade),
            (false, false) => format!("{magnitude} {}", spec.signature.name(*blade)),
        });
    }
    text
}

/// A closure: is `a ~a = 1` as far as rounding goes?
fn unit_check(spec: &Spec, index: usize) -> TokenStream {
    let ty = &spec.types[index];
    let all = ty.fields.iter().map(|field| identifier(field));
    let normed = |blade: &Blade| ty.coefficients.keys().any(|other| !inner(spec, *blade, *other).is_zero());
    let metric = ty.coefficients.iter().filter(|(blade, _)| normed(blade)).flat_map(|(_, c)| c.fields());
    let metric: BTreeSet<usize> = metric.collect();
    let metric = metric.into_iter().map(|field| identifier(&ty.fields[field]));
    let program = item::unit_defects(spec, index);
    let steps = code::steps(&program);
    let of = |scalar: bool| program.outputs.iter().filter(move |output| (output.name == "s") == scalar);
    let scalar = of(true).map(|output| code::value(&output.value));
    let others: Vec<TokenStream> = of(false).map(|output| code::value(&output.value)).collect();
    // Named, because clippy takes a difference within an array for a forgotten comma.
    let names: Vec<Ident> = (0..others.len()).map(|index| format_ident!("defect_{index}")).collect();
    quote! {
        |a| {
            #steps
            #(let #names = #others;)*
            ::ga_physics::algebra::support::is_unit(&[#(a.#metric),*], &[#(a.#all),*], #(#scalar)*, &[#(#names),*])
        }
    }
}

/// How random values are drawn: number by number; a unit type whose norm is a sum of squares from the sphere, with the
/// numbers that do not enter the norm drawn one by one. Other unit types have no distribution that one would expect.
fn sample(spec: &Spec, ty: &Type) -> TokenStream {
    if !ty.unit {
        return quote!(numbers);
    }
    let blades: Vec<Blade> = ty.coefficients.keys().copied().collect();
    let diagonal = blades.iter().all(|a| blades.iter().all(|b| a == b || anticommutes(spec, *a, *b)));
    let stored: Vec<(Blade, Ident)> = stored(ty).collect();
    let (free, unit): (Vec<_>, Vec<_>) = stored.iter().partition(|(blade, _)| inner(spec, *blade, *blade).is_zero());
    let positive = unit.iter().all(|(blade, _)| inner(spec, *blade, *blade) == Rational::ONE);
    if !(diagonal && positive && unit.len() > 1 && stored.len() == blades.len()) {
        return quote!(none);
    }
    let (unit, free) = (unit.iter().map(|(_, field)| field), free.iter().map(|(_, field)| field));
    quote!(sphere { #(#unit)* } { #(#free)* })
}

/// The fields that are coefficients, with their blades.
fn stored(ty: &Type) -> impl Iterator<Item = (Blade, Ident)> + '_ {
    ty.coefficients.iter().filter_map(|(blade, c)| Some((*blade, identifier(&ty.fields[c.as_stored()?.1]))))
}

/// The scalar part of `a ~b`.
fn inner(spec: &Spec, a: Blade, b: Blade) -> Rational {
    let terms = spec.signature.geometric(a, b);
    let scalar = terms.iter().find(|(blade, _)| *blade == Blade::SCALAR).map_or(Rational::ZERO, |(_, c)| *c);
    if b.reverse_is_negative() { -scalar } else { scalar }
}

/// Is `a ~b + b ~a = 0`, so that the product of the two coefficients does not enter `x ~x`?
fn anticommutes(spec: &Spec, a: Blade, b: Blade) -> bool {
    let mut sum: BTreeMap<Blade, Rational> = BTreeMap::new();
    for (left, right) in [(a, b), (b, a)] {
        for (blade, coefficient) in spec.signature.geometric(left, right) {
            let coefficient = if right.reverse_is_negative() { -*coefficient } else { *coefficient };
            let entry = sum.entry(*blade).or_insert(Rational::ZERO);
            *entry = *entry + coefficient;
        }
    }
    sum.values().all(|coefficient| coefficient.is_zero())
}

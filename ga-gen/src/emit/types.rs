//! Tokens of the types: structs, constructors, conversions, linear operations, the view in an orthonormal basis.

use super::arithmetic;
use super::code::identifier;
use crate::blade::{Blade, swaps_are_odd};
use crate::item;
use crate::polynomial::Polynomial;
use crate::scalar::Rational;
use crate::signature::Kind;
use crate::spec::Spec;
use crate::types::Type;
use proc_macro2::{Literal, TokenStream};
use quote::quote;
use std::collections::BTreeMap;

/// The most arguments that a positional constructor has.
const LONGEST_CONSTRUCTOR: usize = 7;

/// The type with its scalar: `Rotor<T>`, `super::g3::Vector<T>`, `Infinity`.
pub(super) fn path(spec: &Spec, index: usize) -> TokenStream {
    let ty = &spec.types[index];
    let name = &ty.name;
    let base = match (&spec.extends, ty.shared) {
        (Some(base), true) => quote!(#base::),
        _ => TokenStream::new(),
    };
    if ty.fields.is_empty() { quote!(#base #name) } else { quote!(#base #name<T>) }
}

/// The expression that builds a value of the type from an expression for each field.
pub(super) fn construct(spec: &Spec, index: usize, values: &[TokenStream]) -> TokenStream {
    let ty = &spec.types[index];
    let name = &ty.name;
    let base = match (&spec.extends, ty.shared) {
        (Some(base), true) => quote!(#base::),
        _ => TokenStream::new(),
    };
    let fields = ty.fields.iter().map(|field| identifier(field));
    if ty.fields.is_empty() { quote!(#base #name) } else { quote!(#base #name { #(#fields: #values),* }) }
}

/// The struct and everything that concerns it alone.
pub(super) fn declare(spec: &Spec, index: usize, ty: &Type) -> TokenStream {
    let (visibility, name, docs) = (&spec.visibility, &ty.name, &ty.docs);
    let shape = shape_text(spec, ty);
    let interop = super::interop::interoperate(spec, index);
    if ty.fields.is_empty() {
        return quote! {
            #(#docs)*
            #[doc = ""]
            #[doc = #shape]
            #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
            #visibility struct #name;
            #interop
        };
    }
    let fields: Vec<_> = ty.fields.iter().map(|field| identifier(field)).collect();
    let field_docs = (0..fields.len()).map(|field| field_text(spec, ty, field));
    let default = if ty.unit { TokenStream::new() } else { quote!(Default,) };
    let mut tokens = quote! {
        #(#docs)*
        #[doc = ""]
        #[doc = #shape]
        #[derive(Clone, Copy, Debug, #default PartialEq)]
        #[repr(C)]
        #visibility struct #name<T = f64> {
            #(#[doc = #field_docs] pub #fields: T,)*
        }
    };
    tokens.extend(constructors(ty));
    if ty.is_linear() {
        tokens.extend(linear_operations(ty));
    }
    if ty.unit {
        tokens.extend(unit_operations(spec, index, ty));
    }
    tokens.extend(interop);
    tokens
}

/// `x e1 + y e2 + z e3 + no + (1/2 x x + ...) ninf`
fn shape_text(spec: &Spec, ty: &Type) -> String {
    let parts: Vec<String> = ty
        .coefficients
        .iter()
        .map(|(blade, polynomial)| {
            let name = spec.signature.name(*blade);
            match (polynomial.as_constant(), polynomial_text(ty, polynomial)) {
                (Some(value), _) if value == Rational::ONE => name,
                (_, text) if *blade == Blade::SCALAR => text,
                (_, text) => format!("({text}) {name}"),
            }
        })
        .collect();
    let facts = if ty.unit { "; unit: `a ~a = 1`" } else { "" };
    format!("`{}`{facts}", parts.join(" + "))
}

fn polynomial_text(ty: &Type, polynomial: &Polynomial) -> String {
    let terms = polynomial.terms().map(|(fields, value)| {
        let names: Vec<&str> = fields.iter().map(|field| ty.fields[*field].as_str()).collect();
        match (value == Rational::ONE, names.is_empty()) {
            (true, false) => names.join(" "),
            (false, false) if value == -Rational::ONE => format!("-{}", names.join(" ")),
            (false, false) => format!("{value} {}", names.join(" ")),
            (_, true) => value.to_string(),
        }
    });
    terms.collect::<Vec<_>>().join(" + ")
}

fn field_text(spec: &Spec, ty: &Type, field: usize) -> String {
    let stored = ty.coefficients.iter().find(|(_, polynomial)| polynomial.as_stored().is_some_and(|(_, f)| f == field));
    match stored {
        Some((blade, _)) if *blade == Blade::SCALAR => "The scalar part.".into(),
        Some((blade, polynomial)) => {
            let factor = polynomial.as_stored().map_or(Rational::ONE, |(factor, _)| factor);
            let name = spec.signature.name(*blade);
            if factor == Rational::ONE {
                format!("The coefficient of `{name}`.")
            } else {
                format!("The coefficient of `{name}` is {factor} times this.")
            }
        }
        None => "Enters derived coefficients only; see the type.".into(),
    }
}

fn constructors(ty: &Type) -> TokenStream {
    let name = &ty.name;
    let fields: Vec<_> = ty.fields.iter().map(|field| identifier(field)).collect();
    let count = Literal::usize_unsuffixed(fields.len());
    let indices = (0..fields.len()).map(Literal::usize_unsuffixed);
    // Beyond this many numbers a position says nothing to a reader: arrays and struct literals remain.
    let new = (fields.len() <= LONGEST_CONSTRUCTOR).then(|| {
        quote! {
            /// From the stored numbers, in declared order.
            #[inline]
            pub const fn new(#(#fields: T),*) -> Self {
                Self { #(#fields),* }
            }
        }
    });
    quote! {
        impl<T> #name<T> {
            #new
            /// From a function of the index of each stored number.
            #[inline]
            pub fn from_fn(mut f: impl FnMut(usize) -> T) -> Self {
                Self { #(#fields: f(#indices)),* }
            }
            /// Every stored number mapped, for a change of scalar.
            #[inline]
            pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> #name<U> {
                #name { #(#fields: f(self.#fields)),* }
            }
        }
        impl<T> From<[T; #count]> for #name<T> {
            #[inline]
            fn from([#(#fields),*]: [T; #count]) -> Self {
                Self { #(#fields),* }
            }
        }
        impl<T> From<#name<T>> for [T; #count] {
            #[inline]
            fn from(value: #name<T>) -> Self {
                [#(value.#fields),*]
            }
        }
    }
}

fn linear_operations(ty: &Type) -> TokenStream {
    let name = &ty.name;
    let fields: Vec<_> = ty.fields.iter().map(|field| identifier(field)).collect();
    quote! {
        impl<T: ::ga_physics::algebra::Scalar> ::core::ops::Add for #name<T> {
            type Output = Self;
            #[inline]
            fn add(self, b: Self) -> Self { Self { #(#fields: self.#fields + b.#fields),* } }
        }
        impl<T: ::ga_physics::algebra::Scalar> ::core::ops::Sub for #name<T> {
            type Output = Self;
            #[inline]
            fn sub(self, b: Self) -> Self { Self { #(#fields: self.#fields - b.#fields),* } }
        }
        impl<T: ::ga_physics::algebra::Scalar> ::core::ops::AddAssign for #name<T> {
            #[inline]
            fn add_assign(&mut self, b: Self) { *self = *self + b; }
        }
        impl<T: ::ga_physics::algebra::Scalar> ::core::ops::SubAssign for #name<T> {
            #[inline]
            fn sub_assign(&mut self, b: Self) { *self = *self - b; }
        }
        impl<T: ::ga_physics::algebra::Scalar> ::core::ops::Neg for #name<T> {
            type Output = Self;
            #[inline]
            fn neg(self) -> Self { Self { #(#fields: -self.#fields),* } }
        }
        impl<T: ::ga_physics::algebra::Scalar> ::core::ops::Mul<T> for #name<T> {
            type Output = Self;
            #[inline]
            fn mul(self, b: T) -> Self { Self { #(#fields: self.#fields * b),* } }
        }
        impl<T: ::ga_physics::algebra::Scalar> ::core::ops::Div<T> for #name<T> {
            type Output = Self;
            #[inline]
            fn div(self, b: T) -> Self { Self { #(#fields: self.#fields / b),* } }
        }
        impl ::core::ops::Mul<#name<f32>> for f32 {
            type Output = #name<f32>;
            #[inline]
            fn mul(self, b: #name<f32>) -> #name<f32> { b * self }
        }
        impl ::core::ops::Mul<#name<f64>> for f64 {
            type Output = #name<f64>;
            #[inline]
            fn mul(self, b: #name<f64>) -> #name<f64> { b * self }
        }
    }
}

fn unit_operations(spec: &Spec, index: usize, ty: &Type) -> TokenStream {
    let name = &ty.name;
    let fields: Vec<_> = ty.fields.iter().map(|field| identifier(field)).collect();
    let program = item::unit_defects(spec, index);
    let steps = super::code::steps(&program);
    let checks = program.outputs.iter().map(|output| {
        let value = super::code::value(&output.value);
        if output.name == "s" { quote!(near(#value, T::ratio(1, 1))) } else { quote!(near(#value, T::ratio(0, 1))) }
    });
    let mut tokens = quote! {
        impl<T: ::ga_physics::algebra::Scalar> #name<T> {
            /// Is every coefficient of `a ~a` within `tolerance` of that of 1?
            #[inline]
            pub fn is_unit(self, tolerance: T) -> bool where T: PartialOrd {
                let a = self;
                let near = |x: T, y: T| x - y <= tolerance && y - x <= tolerance;
                #steps
                #(#checks)&&*
            }
        }
    };
    if ty.negates() {
        // Where a coefficient is fixed or a product of numbers, minus the versor is not of the type, or not this.
        tokens.extend(quote! {
            impl<T: ::ga_physics::algebra::Scalar> ::core::ops::Neg for #name<T> {
                type Output = Self;
                #[inline]
                fn neg(self) -> Self { Self { #(#fields: -self.#fields),* } }
            }
        });
    }
    if ty.versor {
        let identity = ty.identity().into_iter().map(arithmetic::constant);
        tokens.extend(quote! {
            impl<T: ::ga_physics::algebra::Scalar> Default for #name<T> {
                /// The identity.
                #[inline]
                fn default() -> Self { Self { #(#fields: #identity),* } }
            }
            impl<T> #name<T> {
                /// `a x ~a`: the image of `x`.
                #[inline]
                pub fn apply<X>(self, x: X) -> <Self as ::ga_physics::algebra::Apply<X>>::Output
                where
                    Self: ::ga_physics::algebra::Apply<X>,
                {
                    ::ga_physics::algebra::Apply::apply(self, x)
                }
            }
        });
    }
    tokens
}

/// A basis blade of the declared basis as a sum over orthonormal blades: `o = c (p - m) / 2`, `i = p + m`, so
/// `o ^ i = c p ^ m`, for a null pair with `o . i = c`.
pub(super) fn orthonormal(spec: &Spec, blade: Blade) -> Vec<(Blade, Rational)> {
    let mut terms = vec![(Blade::SCALAR, Rational::ONE)];
    let half = Rational::new(1, 2).unwrap_or(Rational::ONE);
    for (index, kind) in spec.signature.kinds().iter().enumerate().filter(|(index, _)| blade.contains(*index)) {
        let (this, next) = (Blade::vector(index), Blade::vector(index + 1));
        let vector = match kind {
            Kind::Square(_) => vec![(this, Rational::ONE)],
            Kind::PairFirst(c) => vec![(this, half * i32::from(*c).into()), (next, -half * i32::from(*c).into())],
            Kind::PairSecond => vec![(Blade::vector(index - 1), Rational::ONE), (this, Rational::ONE)],
        };
        let mut sums: BTreeMap<Blade, Rational> = BTreeMap::new();
        for (a, x) in &terms {
            for (b, y) in vector.iter().filter(|(b, _)| a.0 & b.0 == 0) {
                let sign = if swaps_are_odd(*a, *b) { -Rational::ONE } else { Rational::ONE };
                let sum = sums.entry(Blade(a.0 | b.0)).or_insert(Rational::ZERO);
                *sum = *sum + *x * *y * sign;
            }
        }
        terms = sums.into_iter().filter(|(_, c)| !c.is_zero()).collect();
    }
    terms
}

/// The sign of the declared pseudoscalar against the product of the orthonormal basis.
pub(super) fn orthonormal_pseudoscalar_sign(spec: &Spec) -> Literal {
    let declared =
        spec.pseudoscalar.map(|i| orthonormal(spec, i.blade).first().map_or(Rational::ONE, |(_, c)| *c) * i.sign);
    // 0 says that no pseudoscalar was declared.
    Literal::i8_unsuffixed(declared.map_or(0, |sign| if sign.is_negative() { -1 } else { 1 }))
}

/// The conversion to the dynamic multivector, in the orthonormal basis.
pub(super) fn to_dynamic(spec: &Spec, index: usize) -> TokenStream {
    let ty = &spec.types[index];
    if ty.fields.is_empty() {
        let terms = ty.coefficients.iter().flat_map(|(blade, c)| {
            let value = c.as_constant().unwrap_or(Rational::ZERO);
            orthonormal(spec, *blade).into_iter().map(move |(b, d)| (b, d * value))
        });
        let entries = terms.map(|(blade, value)| {
            let (blade, value) = (Literal::u32_unsuffixed(blade.0), arithmetic::constant(value));
            quote!((#blade, #value))
        });
        let path = path(spec, index);
        return quote! {
            impl<T: ::ga_physics::algebra::Scalar> ::ga_physics::algebra::dynamic::ToDynamic<Algebra, T> for #path {
                fn to_dynamic(&self) -> ::ga_physics::algebra::dynamic::Dynamic<Algebra, T> {
                    ::ga_physics::algebra::dynamic::Dynamic::from_terms(&[#(#entries),*])
                }
            }
        };
    }
    let fields: Vec<_> = ty.fields.iter().map(|field| identifier(field)).collect();
    let mut by_blade: BTreeMap<Blade, Polynomial> = BTreeMap::new();
    for (blade, polynomial) in &ty.coefficients {
        for (image, factor) in orthonormal(spec, *blade) {
            let sum = by_blade.entry(image).or_default().plus(&polynomial.scaled(factor));
            by_blade.insert(image, sum);
        }
    }
    let entries = by_blade.iter().filter(|(_, p)| !p.is_zero()).map(|(blade, polynomial)| {
        let blade = Literal::u32_unsuffixed(blade.0);
        let terms = polynomial.terms().map(|(term, value)| {
            let (value, factors) = (arithmetic::constant(value), term.iter().map(|field| &fields[*field]));
            quote!(#value #(* self.#factors)*)
        });
        quote!((#blade, #(#terms)+*))
    });
    let path = path(spec, index);
    quote! {
        impl<T: ::ga_physics::algebra::Scalar> ::ga_physics::algebra::dynamic::ToDynamic<Algebra, T> for #path {
            fn to_dynamic(&self) -> ::ga_physics::algebra::dynamic::Dynamic<Algebra, T> {
                ::ga_physics::algebra::dynamic::Dynamic::from_terms(&[#(#entries),*])
            }
        }
    }
}

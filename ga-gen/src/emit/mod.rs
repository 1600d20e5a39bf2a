//! Rust tokens: of an algebra its types, operations, metric, and the macro that carries the specification; of a formula
//! the function and its dynamic twin.
//!
//! Generated code names the library as `::ga_physics`, is generic over `T: Scalar`, and contains no branch, no loop and
//! no call but arithmetic.

mod arithmetic;
mod code;
mod formula;
mod interop;
mod operations;
mod twin;
mod types;

pub use formula::{formula, formula_function};

use crate::item::{self, Item, Operation};
use crate::signature::Kind;
use crate::spec::Spec;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

/// Everything that `algebra!` expands to; the chain is the tokens of all algebras that it stands on, and its own.
///
/// # Errors
/// A unit type that cannot be sampled.
pub fn algebra(spec: &Spec, chain: &[TokenStream]) -> syn::Result<TokenStream> {
    let mut result = metric(spec);
    result.extend(shared(spec));
    for (index, ty) in spec.types.iter().enumerate().filter(|(_, ty)| !ty.shared) {
        result.extend(types::declare(spec, index, ty));
    }
    for index in 0..spec.types.len() {
        result.extend(types::to_dynamic(spec, index));
    }
    result.extend(operations::traits(spec));
    let mut listed = TokenStream::new();
    for operation in item::operations(spec) {
        if let Some(item) = item::compile(spec, operation)? {
            let tokens = operations::emit(spec, &item);
            if !tokens.is_empty() {
                listed.extend(list_entry(spec, operation));
            }
            result.extend(tokens);
        }
    }
    let (spec_macro, operations_macro) =
        (format_ident!("__ga_spec_{}", spec.name), format_ident!("__ga_operations_{}", spec.name));
    result.extend(quote! {
        #[doc(hidden)]
        #[macro_export]
        macro_rules! #spec_macro {
            ($then:ident $($rest:tt)*) => { ::ga_physics::$then! { #({ #chain })* $($rest)* } };
        }
        #[doc(hidden)]
        pub use #spec_macro as __spec;
        /// Calls a macro with the list of all operations: for exhaustive tests.
        #[doc(hidden)]
        #[macro_export]
        macro_rules! #operations_macro {
            ($visit:ident) => { $visit! { #listed } };
        }
        #[doc(hidden)]
        pub use #operations_macro as __operations;
    });
    Ok(result)
}

/// The types of the base algebra, by their own names: so every type of this algebra is found in its module. Hidden, so
/// that messages of the compiler go on naming them where they are declared.
fn shared(spec: &Spec) -> TokenStream {
    let Some(base) = &spec.extends else { return TokenStream::new() };
    let names: Vec<_> = spec.types.iter().filter(|ty| ty.shared).map(|ty| &ty.name).collect();
    let visibility = &spec.visibility;
    quote! {
        #[doc(hidden)]
        #[allow(unused_imports, reason = "for formulas and for whoever wants one place to look")]
        #visibility use #base::{#(#names),*};
    }
}

/// The tokens of one item.
#[must_use]
pub fn item(spec: &Spec, item: &Item) -> TokenStream {
    operations::emit(spec, item)
}

/// `(mul Rotor Vector)`: an operation as tokens.
fn list_entry(spec: &Spec, operation: Operation) -> TokenStream {
    let name = |index: usize| &spec.types[index].name;
    match operation {
        Operation::Product(kind, a, b) => {
            let (method, a, b) = (operations::method(kind), name(a), name(b));
            quote!((#method #a #b))
        }
        Operation::Meet(a, b) => {
            let (a, b) = (name(a), name(b));
            quote!((meet #a #b))
        }
        Operation::Apply(a, b) => {
            let (a, b) = (name(a), name(b));
            quote!((apply #a #b))
        }
        Operation::Embed(a, b) => {
            let (a, b) = (name(a), name(b));
            quote!((embed #a #b))
        }
        Operation::Reverse(a) => {
            let a = name(a);
            quote!((rev #a))
        }
        Operation::Dual(a) => {
            let a = name(a);
            quote!((dual #a))
        }
        Operation::Undual(a) => {
            let a = name(a);
            quote!((undual #a))
        }
        Operation::Grade(grade, a) => {
            let (method, a) = (format_ident!("grade{grade}"), name(a));
            let grade = Literal::u32_unsuffixed(grade);
            quote!((grade #a #method #grade))
        }
        Operation::NormSq(a) => {
            let a = name(a);
            quote!((norm_sq #a))
        }
    }
}

/// The marker type of the algebra, with the squares of its orthonormal basis.
fn metric(spec: &Spec) -> TokenStream {
    let mut squares = Vec::new();
    for kind in spec.signature.kinds() {
        match kind {
            Kind::Square(square) => squares.push(Literal::i8_unsuffixed(square.abs())),
            Kind::PairFirst(_) => squares.push(Literal::i8_unsuffixed(1)),
            Kind::PairSecond => squares.push(Literal::i8_unsuffixed(1)),
        }
    }
    let signs = spec.signature.kinds().iter().zip(squares).map(|(kind, magnitude)| match kind {
        Kind::Square(-1) | Kind::PairSecond => quote!(-#magnitude),
        _ => quote!(#magnitude),
    });
    let sign = types::orthonormal_pseudoscalar_sign(spec);
    let doc = format!(
        "The metric of `{}` in an orthonormal basis: a null pair `(o, i)` stands for two vectors `p, m` of squares +1, -1 with `i = p + m`.",
        spec.name
    );
    quote! {
        #[doc = #doc]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct Algebra;
        impl ::ga_physics::algebra::dynamic::Metric for Algebra {
            const SQUARES: &'static [i8] = &[#(#signs),*];
            const PSEUDOSCALAR_SIGN: i8 = #sign;
        }
    }
}

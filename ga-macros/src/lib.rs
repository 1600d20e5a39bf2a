//! `algebra!` and `#[formula]`: tokens in, tokens out, an error on the right token. All work is done in `ga_gen`.

use proc_macro::TokenStream;

/// Generates the types and products of a geometric algebra; see `ga_gen::parse` for the grammar.
///
/// Write it alone in a module: the items are emitted where the invocation stands.
#[proc_macro]
pub fn algebra(input: TokenStream) -> TokenStream {
    expand(ga_gen::expand(input.into()))
}

/// Compiles a function over the types of an algebra as one formula.
#[proc_macro_attribute]
pub fn formula(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand(ga_gen::formula_attribute(attribute.into(), item.into()))
}

/// The second half of an `algebra!` that extends another one: called by the base algebra's specification macro.
#[doc(hidden)]
#[proc_macro]
pub fn __algebra_with_base(input: TokenStream) -> TokenStream {
    expand(ga_gen::expand_with_base(input.into()))
}

/// The second half of a formula: called by the specification macro of its algebra.
#[doc(hidden)]
#[proc_macro]
pub fn __formula_with_spec(input: TokenStream) -> TokenStream {
    expand(ga_gen::expand_formula(input.into()))
}

fn expand(result: Result<proc_macro2::TokenStream, ga_gen::Error>) -> TokenStream {
    result.unwrap_or_else(|error| error.to_compile_error()).into()
}

//! Symbolic geometric algebra, compiled to straight-line Rust.
//!
//! The way of an `algebra!` invocation through this crate:
//!
//! ```text
//! tokens -> parse -> spec (types as sets of blades with knowledge)
//!        -> expression (multivector operations on typed inputs)
//!        -> lower -> program (scalar steps, with counts) -> optimise
//!        -> infer (the smallest declared type that holds the result)
//!        -> emit (Rust tokens)  and  print (readable text), both from the same program
//! ```
//!
//! and of a `#[formula(..)]`, which the algebra's specification macro hands over together with the algebra:
//!
//! ```text
//! tokens -> header (options, signature) -> read (steps, with what the names mean)
//!        -> formula (lower, choose the cheapest, prove the frame)
//!        -> emit (the function from its program, the dynamic twin from its steps)  and  print
//! ```
//!
//! An ordinary library: it knows no physics and needs no compiler, so inspection and tests call it directly.

pub mod alternatives;
pub mod blade;
pub mod body;
pub mod emit;
mod evaluate;
pub mod expression;
pub mod factored;
pub mod field;
pub mod formula;
pub mod frame;
pub mod header;
pub mod infer;
#[cfg(feature = "inspect")]
pub mod inspect;
pub mod item;
#[cfg(feature = "inspect")]
pub mod ledger;
mod literal;
pub mod lower;
mod names;
pub mod normalise;
pub mod optimise;
pub mod parse;
pub mod polynomial;
pub mod print;
pub mod product;
pub mod program;
pub mod read;
mod sample;
pub mod sandwich;
pub mod scalar;
pub mod signature;
pub mod spec;
pub mod split;
pub mod storage;
pub mod types;
mod unsupported;
pub mod values;

use proc_macro2::TokenStream;
pub use syn::Error;

/// Expands one `algebra!` invocation to Rust items.
///
/// An algebra that extends another one cannot be expanded from its own tokens alone: the expansion then calls the
/// base algebra's specification macro, which comes back here through [`expand_with_base`].
///
/// # Errors
/// A sentence on the token at fault.
pub fn expand(tokens: TokenStream) -> syn::Result<TokenStream> {
    let source: parse::Source = syn::parse2(tokens.clone())?;
    if let Some(base) = &source.extends {
        let specification = specification(base);
        return Ok(quote::quote! { #specification! { __algebra_with_base #tokens } });
    }
    let spec = spec::Spec::new(&source, None)?;
    emit::algebra(&spec, &[tokens])
}

/// Expands an algebra that extends another: the tokens of the algebras that it stands on, each in braces, then its own.
///
/// # Errors
/// A sentence on the token at fault.
pub fn expand_with_base(tokens: TokenStream) -> syn::Result<TokenStream> {
    let parse::WithBase { chain, own, own_tokens } = syn::parse2(tokens)?;
    let base = spec_of(&chain)?;
    let spec = spec::Spec::new(&own, base.as_ref())?;
    let chain: Vec<TokenStream> = chain.0.into_iter().map(|(_, tokens)| tokens).chain([own_tokens]).collect();
    emit::algebra(&spec, &chain)
}

/// Expands one `#[formula(..)]`: to a call of the specification macro of its algebra, which comes back here through
/// [`expand_formula`].
///
/// # Errors
/// A sentence on the token at fault, as far as it can be told without the algebra.
pub fn formula_attribute(attribute: TokenStream, item: TokenStream) -> syn::Result<TokenStream> {
    let source = header::Source::new(attribute.clone(), item.clone())?;
    let specification = specification(&source.options.path);
    Ok(quote::quote! { #specification! { __formula_with_spec (#attribute) #item } })
}

/// Expands a formula: the tokens of its algebra and of those that it stands on, each in braces, the options of the
/// attribute in brackets, the function.
///
/// # Errors
/// A sentence on the token at fault.
pub fn expand_formula(tokens: TokenStream) -> syn::Result<TokenStream> {
    let parse::WithFormula { chain, attribute, item } = syn::parse2(tokens)?;
    let source = header::Source::new(attribute, item)?;
    let missing = || Error::new(proc_macro2::Span::call_site(), "no algebra was handed over");
    let spec = spec_of(&chain)?.ok_or_else(missing)?;
    let compiled = formula::compile(&spec, &read::read(&spec, &source)?)?;
    Ok(emit::formula(&spec, &compiled))
}

/// The last algebra of a chain; `None` where the chain is empty.
fn spec_of(chain: &parse::Chain) -> syn::Result<Option<spec::Spec>> {
    let mut last = None;
    for (source, _) in &chain.0 {
        last = Some(spec::Spec::new(source, last.as_ref())?);
    }
    Ok(last)
}

/// The path of the macro that carries the specification of the algebra in a module.
fn specification(module: &syn::Path) -> TokenStream {
    use syn::spanned::Spanned;
    let name = syn::Ident::new("__spec", module.span());
    quote::quote!(#module::#name)
}

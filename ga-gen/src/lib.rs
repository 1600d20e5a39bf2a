//! Symbolic geometric algebra, compiled to straight-line Rust.
//!
//! The way of an `algebra!` invocation through this crate:
//!
//! ```text
//! tokens -> parse -> spec (types as sets of blades with knowledge)
//!        -> expression (multivector operations on typed inputs)
//!        -> lower -> program (scalar steps, with counts) -> optimise
//!        -> infer (the smallest declared type that holds the result)
//!        -> emit (Rust tokens)  and  formula (readable text), both from the same program
//! ```
//!
//! An ordinary library: it knows no physics and needs no compiler, so inspection and tests call it directly.

pub mod alternatives;
pub mod blade;
pub mod emit;
pub mod expression;
pub mod factored;
pub mod field;
pub mod formula;
pub mod infer;
pub mod inspect;
pub mod item;
pub mod kernel;
pub mod lower;
pub mod optimise;
pub mod parse;
pub mod polynomial;
pub mod product;
pub mod program;
mod sample;
pub mod sandwich;
pub mod scalar;
pub mod signature;
pub mod spec;
pub mod split;
pub mod storage;
pub mod types;
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
        return Ok(quote::quote! { #base::__spec! { #tokens } });
    }
    let spec = spec::Spec::new(&source, None)?;
    emit::algebra(&spec, &tokens)
}

/// Expands an algebra that extends another: the base's tokens in braces, then its own.
///
/// # Errors
/// A sentence on the token at fault.
pub fn expand_with_base(tokens: TokenStream) -> syn::Result<TokenStream> {
    let parse::WithBase { base, own, own_tokens } = syn::parse2(tokens)?;
    let base = spec::Spec::new(&base, None)?;
    let spec = spec::Spec::new(&own, Some(&base))?;
    emit::algebra(&spec, &own_tokens)
}

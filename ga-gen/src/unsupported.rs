//! What Rust has and a formula has not: a sentence for each, on the token at fault.
//!
//! A formula is straight-line arithmetic on multivectors, so that it runs on lanes and can be rewritten as a whole.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Error, Expr, Safety, Signature};

/// Refuses what the signature of a formula cannot have.
///
/// # Errors
/// The first such token.
pub(crate) fn refuse_signature(signature: &Signature) -> syn::Result<()> {
    let generics = &signature.generics;
    let safety = match &signature.safety {
        Safety::Unsafe(token) => Some(token.span()),
        Safety::Safe(token) => Some(token.span()),
        Safety::Default => None,
    };
    let where_clause = generics.where_clause.as_ref().map(|clause| clause.where_token.span());
    let faults: [(Option<Span>, &str); 7] = [
        (signature.constness.map(|token| token.span()), "a formula is generic over its scalar, so it is not `const`"),
        (signature.asyncness.map(|token| token.span()), "a formula computes: it is not `async`"),
        (safety, "a formula is arithmetic: it is neither `unsafe` nor `safe`"),
        (signature.abi.as_ref().map(Spanned::span), "a formula is generic over its scalar, so it is not `extern`"),
        ((!generics.params.is_empty()).then(|| generics.params.span()), {
            "a formula is generic over its scalar by itself: leave the generics out"
        }),
        (where_clause, "a formula is generic over its scalar by itself: leave the `where` clause out"),
        (signature.variadic.as_ref().map(Spanned::span), "a formula has a fixed number of parameters"),
    ];
    match faults.into_iter().find_map(|(span, message)| Some(Error::new(span?, message))) {
        Some(error) => Err(error),
        None => Ok(()),
    }
}

/// The error for an expression that no formula has.
#[must_use]
pub(crate) fn expression(expression: &Expr) -> Error {
    let message = match expression {
        Expr::If(_) | Expr::Match(_) | Expr::Let(_) => {
            "a formula has no branches: compute both values, and choose between them outside of it"
        }
        Expr::ForLoop(_) | Expr::While(_) | Expr::Loop(_) | Expr::Break(_) | Expr::Continue(_) => {
            "a formula has no loops: write the steps out, or loop outside of it"
        }
        Expr::Closure(_) => "a formula has no closures: write another formula, and call it",
        Expr::Block(_) | Expr::Unsafe(_) | Expr::Const(_) | Expr::TryBlock(_) => {
            "a formula has no blocks within expressions: use brackets, or a `let` before"
        }
        Expr::Macro(_) => "a formula has no macros: it is read before they are expanded",
        Expr::Reference(_) | Expr::RawAddr(_) => "operands of a formula are values: leave `&` out",
        Expr::Return(_) => "a formula ends with its result, without `return`",
        Expr::Try(_) => "a formula cannot fail: it has no `?`",
        Expr::Async(_) | Expr::Await(_) => "a formula computes: it is not `async`",
        Expr::Assign(_) => "nothing changes in a formula: use another `let`",
        Expr::Cast(_) => "a formula has one scalar type: it has no `as`",
        Expr::Index(_) | Expr::Array(_) | Expr::Repeat(_) => "a formula has no arrays: read a component by its name",
        Expr::Struct(_) => "a formula has no struct literals: write a sum of blades, like `x*e1 + y*e2`",
        Expr::Range(_) => "a formula has no ranges",
        Expr::Tuple(_) => "a formula has tuples only as its result",
        _ => "a formula has names, numbers, + - * / ^ | &, brackets, components and methods of multivectors",
    };
    Error::new_spanned(expression, message)
}

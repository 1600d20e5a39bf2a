//! Tokens of straight-line scalar code.

use crate::program::{Call, Product, Program, Step, Value};
use crate::scalar::Rational;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens, format_ident, quote};

/// Sums of up to this many terms are a chain; longer ones a balanced tree, which has the shorter dependency chain and
/// the smaller error bound. A tree holds more numbers at a time: for the sums of eight terms of a product of motors, in a
/// loop over a slice, it took 204 instructions for two items where the chain took 195, on 16 registers.
const LONGEST_CHAIN: usize = 8;

/// Results whose longest sum has more terms than this are computed longest first.
const SHORT_SUM: usize = 4;

/// `let` statements for the shared steps of a program without calls.
pub(super) fn steps(program: &Program) -> TokenStream {
    steps_with(program, |_| TokenStream::new())
}

/// `let` statements for the shared steps; a call is written by the caller, who knows the types.
pub(super) fn steps_with(program: &Program, call: impl Fn(&Call) -> TokenStream) -> TokenStream {
    let statement = |step: &Step| {
        let name = path(&step.name);
        let value = match &step.value {
            Value::Call(known) => call(known),
            other => value(other),
        };
        quote!(let #name = #value;)
    };
    program.steps.iter().map(statement).collect()
}

/// The results of a program as code.
pub(super) struct Results {
    /// Statements before the steps: results that are read from the operands alone.
    pub(super) before: TokenStream,
    /// Statements after the steps.
    pub(super) after: TokenStream,
    /// The expression of each result, in the order of the fields.
    pub(super) values: Vec<TokenStream>,
}

/// The code of the results.
///
/// Where sums differ in length the longest are computed first, and those that need no step before the steps: while all
/// operands are needed, no short result takes a register. For a product of motors that saves 19 of 214 instructions, for
/// one of poses 7 of 135.
pub(super) fn results(program: &Program) -> Results {
    let length = |output: &Step| if let Value::Sum(products) = &output.value { products.len() } else { 1 };
    let is_step =
        |factor: &String| program.steps.iter().any(|step| Some(step.name.as_str()) == factor.split('.').next());
    let direct = |output: &Step| match &output.value {
        Value::Sum(products) => products.len() > 1 && !products.iter().flat_map(|p| &p.factors).any(is_step),
        _ => false,
    };
    let name = |output: &Step| format!("result_{}", output.name.replace('.', "_"));
    let taken = |name: &String| program.steps.iter().any(|step| step.name == *name) || reads(program, name);
    let mut result = Results { before: TokenStream::new(), after: TokenStream::new(), values: vec![] };
    let longest = program.outputs.iter().map(length).max().unwrap_or_default();
    let differ = program.outputs.iter().any(|output| length(output) != longest);
    let direct_first = !program.steps.is_empty() && differ && longest > 1;
    let sorted = longest > SHORT_SUM && differ;
    if !(direct_first || sorted) || program.outputs.iter().map(name).any(|name| taken(&name)) {
        result.values = program.outputs.iter().map(|output| value(&output.value)).collect();
        return result;
    }
    let mut ordered: Vec<&Step> = program.outputs.iter().collect();
    ordered.sort_by_key(|output| std::cmp::Reverse(if sorted { length(output) } else { 0 }));
    for output in ordered {
        let (name, value, early) = (identifier(&name(output)), value(&output.value), direct_first && direct(output));
        let statement = quote!(let #name = #value;);
        if early {
            result.before.extend(statement);
        } else if sorted {
            result.after.extend(statement);
        }
    }
    result.values = program
        .outputs
        .iter()
        .map(|output| {
            let named = sorted || direct(output);
            if named { identifier(&name(output)).into_token_stream() } else { value(&output.value) }
        })
        .collect();
    result
}

/// Programs with more operations than the first are beyond what the compiler inlines at `#[inline]`; beyond the second a
/// call costs nothing beside them.
const INLINED: std::ops::RangeInclusive<usize> = 40..=160;

/// The attribute for a function with a program of this size. A call of a product of motors copies 24 numbers to memory
/// and back, and hides the loop around it from the vectoriser.
pub(super) fn inline(program: &Program) -> TokenStream {
    if INLINED.contains(&program.counts().operations()) { quote!(#[inline(always)]) } else { quote!(#[inline]) }
}

/// The expression of a step or output that is no call.
pub(super) fn value(value: &Value) -> TokenStream {
    match value {
        Value::Call(_) => TokenStream::new(),
        Value::Quotient(numerator, denominator) => {
            let (numerator, denominator) = (signed_product(numerator), path(denominator));
            quote!(#numerator / #denominator)
        }
        Value::Sqrt(radicand) => {
            let radicand = path(radicand);
            quote!(::ga_physics::algebra::Scalar::sqrt(#radicand))
        }
        Value::Sum(products) if products.is_empty() => constant(Rational::ZERO),
        Value::Sum(products) => sum(products),
    }
}

/// A positive product stands first, unless all are negative.
fn sum(products: &[Product]) -> TokenStream {
    if products.len() > LONGEST_CHAIN {
        let (left, right) = products.split_at(products.len().div_ceil(2));
        if right[0].coefficient.is_negative() {
            let right: Vec<Product> = right.iter().map(negated).collect();
            let (left, right) = (sum(left), sum(&right));
            return quote!((#left) - (#right));
        }
        let (left, right) = (sum(left), sum(right));
        return quote!((#left) + (#right));
    }
    let mut tokens = TokenStream::new();
    for (index, term) in products.iter().enumerate() {
        let negative = term.coefficient.is_negative();
        if index == 0 {
            tokens.extend(signed_product(term));
        } else {
            let product = product(term.coefficient.abs(), &term.factors);
            tokens.extend(if negative { quote!(- #product) } else { quote!(+ #product) });
        }
    }
    tokens
}

fn negated(product: &Product) -> Product {
    Product { coefficient: -product.coefficient, factors: product.factors.clone() }
}

fn signed_product(term: &Product) -> TokenStream {
    if term.coefficient == -Rational::ONE && !term.factors.is_empty() {
        let product = product(Rational::ONE, &term.factors);
        return if term.factors.len() == 1 { quote!(-#product) } else { quote!(-(#product)) };
    }
    product(term.coefficient, &term.factors)
}

fn product(coefficient: Rational, factors: &[String]) -> TokenStream {
    let mut parts: Vec<TokenStream> = Vec::new();
    if coefficient != Rational::ONE || factors.is_empty() {
        parts.push(constant(coefficient));
    }
    parts.extend(factors.iter().map(|factor| path(factor)));
    let mut parts = parts.into_iter();
    let first = parts.next();
    quote!(#first #(* #parts)*)
}

/// `T::ratio(n, d)`, which folds to a literal for floats.
fn constant(value: Rational) -> TokenStream {
    let part = |n: i128| Literal::i32_unsuffixed(i32::try_from(n).unwrap_or(i32::MAX));
    let (magnitude, denominator) = (part(value.numerator().abs()), part(value.denominator()));
    let numerator = if value.is_negative() { quote!(-#magnitude) } else { quote!(#magnitude) };
    quote!(T::ratio(#numerator, #denominator))
}

/// `a.e1` or a local name.
fn path(name: &str) -> TokenStream {
    let mut parts = name.split('.').map(|part| match part.parse::<usize>() {
        Ok(index) => Literal::usize_unsuffixed(index).into_token_stream(),
        Err(_) => identifier(part).into_token_stream(),
    });
    let first = parts.next();
    quote!(#first #(.#parts)*)
}

/// An identifier from a generated name.
pub(super) fn identifier(name: &str) -> Ident {
    match name.strip_prefix("r#") {
        Some(raw) => Ident::new_raw(raw, Span::call_site()),
        None if KEYWORDS.contains(&name) => format_ident!("{name}_"),
        None => Ident::new(name, Span::call_site()),
    }
}

/// What Rust does not take as a name. A list, because asking the parser about every name of every product took a third
/// of the time of an expansion.
const KEYWORDS: [&str; 53] = [
    "_", "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do",
    "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro",
    "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static", "struct", "super",
    "trait", "true", "try", "type", "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// Does the program read a parameter?
pub(super) fn reads(program: &Program, parameter: &str) -> bool {
    let reads = |name: &String| name.split('.').next() == Some(parameter);
    program.values().into_iter().any(|value| match value {
        Value::Quotient(numerator, name) => reads(name) || numerator.factors.iter().any(reads),
        Value::Sqrt(name) => reads(name),
        Value::Sum(products) => products.iter().any(|product| product.factors.iter().any(reads)),
        Value::Call(_) => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_rust_reserves_are_changed() {
        for keyword in KEYWORDS {
            assert_eq!(identifier(keyword).to_string(), format!("{keyword}_"));
            // The parser of syn knows `gen` as a name; since the 2024 edition it is none.
            assert!(keyword == "gen" || syn::parse_str::<Ident>(keyword).is_err(), "{keyword} is a name");
        }
        for name in ["e1", "r#type", "union", "default", "auto", "raw", "x"] {
            assert_eq!(identifier(name).to_string(), name);
            assert!(syn::parse_str::<Ident>(name).is_ok(), "{name} is no name");
        }
    }
}

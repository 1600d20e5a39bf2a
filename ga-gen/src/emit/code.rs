//! Tokens of straight-line scalar code.

use super::arithmetic::{constant, path, signed_product, sum};
use crate::program::{Call, Program, Step, Value};
use crate::scalar::Rational;
use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, format_ident, quote};
use std::collections::BTreeSet;

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
    let steps: BTreeSet<&str> = program.steps.iter().map(|step| step.name.as_str()).collect();
    let is_step = |factor: &String| steps.contains(root(factor));
    let direct = |output: &Step| match &output.value {
        Value::Sum(products) => products.len() > 1 && !products.iter().flat_map(|p| &p.factors).any(is_step),
        _ => false,
    };
    let name = |output: &Step| format!("result_{}", output.name.replace('.', "_"));
    let read = roots(program);
    let taken = |name: String| steps.contains(name.as_str()) || read.contains(name.as_str());
    let mut result = Results { before: TokenStream::new(), after: TokenStream::new(), values: vec![] };
    let longest = program.outputs.iter().map(length).max().unwrap_or_default();
    let differ = program.outputs.iter().any(|output| length(output) != longest);
    let direct_first = !program.steps.is_empty() && differ && longest > 1;
    let sorted = longest > SHORT_SUM && differ;
    if !(direct_first || sorted) || program.outputs.iter().map(name).any(taken) {
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
    roots(program).contains(parameter)
}

/// `a` of `a.e1`.
fn root(name: &str) -> &str {
    name.split('.').next().unwrap_or(name)
}

/// The names of all that a program reads, steps included.
fn roots(program: &Program) -> BTreeSet<&str> {
    let mut found = BTreeSet::new();
    for value in program.values() {
        match value {
            Value::Quotient(numerator, name) => {
                found.insert(root(name));
                found.extend(numerator.factors.iter().map(|factor| root(factor)));
            }
            Value::Sqrt(name) => {
                found.insert(root(name));
            }
            Value::Sum(products) => found.extend(products.iter().flat_map(|p| &p.factors).map(|factor| root(factor))),
            Value::Call(_) => {}
        }
    }
    found
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

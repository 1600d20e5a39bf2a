//! Tokens of sums of products.
//!
//! Written token by token into one list: an algebra has some hundred thousand factors, and a stream of its own for each
//! took a seventh of an expansion.

use super::code::identifier;
use crate::program::Product;
use crate::scalar::Rational;
use proc_macro2::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

/// Sums of up to this many terms are a chain; longer ones a balanced tree, which has the shorter dependency chain and
/// the smaller error bound. A tree holds more numbers at a time: for the sums of eight terms of a product of motors, in a
/// loop over a slice, it took 204 instructions for two items where the chain took 195, on 16 registers.
const LONGEST_CHAIN: usize = 8;

type Tokens = Vec<TokenTree>;

/// A sum; a positive product stands first, unless all are negative.
pub(super) fn sum(products: &[Product]) -> TokenStream {
    stream(|tokens| push_sum(tokens, products))
}

/// A product with its sign.
pub(super) fn signed_product(term: &Product) -> TokenStream {
    stream(|tokens| push_signed(tokens, term))
}

/// `T::ratio(n, d)`, which folds to a literal for floats.
pub(super) fn constant(value: Rational) -> TokenStream {
    stream(|tokens| push_constant(tokens, value))
}

/// `a.e1` or a local name.
pub(super) fn path(name: &str) -> TokenStream {
    stream(|tokens| push_path(tokens, name))
}

fn stream(write: impl FnOnce(&mut Tokens)) -> TokenStream {
    let mut tokens = Tokens::new();
    write(&mut tokens);
    tokens.into_iter().collect()
}

fn push_sum(tokens: &mut Tokens, products: &[Product]) {
    if products.len() > LONGEST_CHAIN {
        let (left, right) = products.split_at(products.len().div_ceil(2));
        tokens.push(bracketed(|inner| push_sum(inner, left)));
        if right[0].coefficient.is_negative() {
            let right: Vec<Product> = right.iter().map(negated).collect();
            tokens.push(symbol('-'));
            tokens.push(bracketed(|inner| push_sum(inner, &right)));
        } else {
            tokens.push(symbol('+'));
            tokens.push(bracketed(|inner| push_sum(inner, right)));
        }
        return;
    }
    for (index, term) in products.iter().enumerate() {
        if index == 0 {
            push_signed(tokens, term);
        } else {
            tokens.push(symbol(if term.coefficient.is_negative() { '-' } else { '+' }));
            push_product(tokens, term.coefficient.abs(), &term.factors);
        }
    }
}

fn negated(product: &Product) -> Product {
    Product { coefficient: -product.coefficient, factors: product.factors.clone() }
}

fn push_signed(tokens: &mut Tokens, term: &Product) {
    if term.coefficient != -Rational::ONE || term.factors.is_empty() {
        push_product(tokens, term.coefficient, &term.factors);
        return;
    }
    tokens.push(symbol('-'));
    if term.factors.len() == 1 {
        push_product(tokens, Rational::ONE, &term.factors);
    } else {
        tokens.push(bracketed(|inner| push_product(inner, Rational::ONE, &term.factors)));
    }
}

fn push_product(tokens: &mut Tokens, coefficient: Rational, factors: &[String]) {
    let mut first = true;
    if coefficient != Rational::ONE || factors.is_empty() {
        push_constant(tokens, coefficient);
        first = false;
    }
    for factor in factors {
        if !first {
            tokens.push(symbol('*'));
        }
        push_path(tokens, factor);
        first = false;
    }
}

fn push_constant(tokens: &mut Tokens, value: Rational) {
    let part = |n: i128| TokenTree::from(Literal::i32_unsuffixed(i32::try_from(n).unwrap_or(i32::MAX)));
    tokens.push(Ident::new("T", Span::call_site()).into());
    tokens.push(Punct::new(':', Spacing::Joint).into());
    tokens.push(symbol(':'));
    tokens.push(Ident::new("ratio", Span::call_site()).into());
    tokens.push(bracketed(|inner| {
        if value.is_negative() {
            inner.push(symbol('-'));
        }
        inner.extend([part(value.numerator().abs()), symbol(','), part(value.denominator())]);
    }));
}

fn push_path(tokens: &mut Tokens, name: &str) {
    for (index, part) in name.split('.').enumerate() {
        if index > 0 {
            tokens.push(symbol('.'));
        }
        tokens.push(match part.parse::<usize>() {
            Ok(number) => Literal::usize_unsuffixed(number).into(),
            Err(_) => identifier(part).into(),
        });
    }
}

fn symbol(character: char) -> TokenTree {
    Punct::new(character, Spacing::Alone).into()
}

fn bracketed(write: impl FnOnce(&mut Tokens)) -> TokenTree {
    Group::new(Delimiter::Parenthesis, stream(write)).into()
}

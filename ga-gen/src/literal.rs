//! Numbers in formulas: integers and decimals, both exact.

use crate::scalar::Rational;
use syn::{Error, Lit};

/// Larger numbers do not fit the constants of generated code.
const DIGITS: usize = 9;

/// The number that a literal is.
///
/// # Errors
/// A literal with a suffix, of another kind, or with too many digits.
pub(crate) fn number(literal: &Lit) -> syn::Result<Rational> {
    let (digits, suffix) = match literal {
        Lit::Int(value) => (value.base10_digits(), value.suffix()),
        Lit::Float(value) => (value.base10_digits(), value.suffix()),
        other => return Err(Error::new(other.span(), "a formula has integers, decimals and fractions like 1/2")),
    };
    let fault = |message: String| Error::new(literal.span(), message);
    if !suffix.is_empty() {
        return Err(fault(format!("numbers in a formula have no type: leave `{suffix}` out")));
    }
    if let (Lit::Int(_), Ok(integer)) = (literal, digits.parse::<i32>()) {
        return Ok(integer.into());
    }
    let (whole, decimals) = digits.split_once('.').unwrap_or((digits, ""));
    let decimals = decimals.trim_end_matches('0');
    let all = format!("{whole}{decimals}");
    let numerator = all.parse::<i32>().ok().filter(|_| decimals.len() <= DIGITS);
    let denominator = 10_i128.pow(u32::try_from(decimals.len().min(DIGITS)).unwrap_or(0));
    let value = numerator.and_then(|numerator| Rational::new(numerator.into(), denominator));
    value.ok_or_else(|| {
        fault(format!("numbers in a formula are exact, without exponent, and go up to {}; this is none", i32::MAX))
    })
}

/// The number of a grade.
///
/// # Errors
/// Anything but an integer.
pub(crate) fn grade(literal: &Lit) -> syn::Result<u32> {
    match literal {
        Lit::Int(value) => Ok(value.base10_parse().unwrap_or(u32::MAX)),
        other => Err(Error::new(other.span(), "the grade is a number, like grade(2)")),
    }
}

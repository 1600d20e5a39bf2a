//! Names and equations in LaTeX.
//!
//! Basis vectors are written `e_{1}`, `n_o`, `n_\infty`; a number of an operand, `a.e23`, is a subscript, `a_{e_{23}}`, and
//! so is a step `t_e23`. Two names of one program that would look alike are told apart by primes.

use super::escaped;
use crate::program::{Product, Program, Step, Value};
use crate::scalar::Rational;
use crate::spec::Spec;
use std::collections::{BTreeMap, BTreeSet};

/// Terms on one line of a formula; more would leave the page.
const TERMS_ON_A_LINE: usize = 5;

/// The steps and outputs of a program, one equation each.
pub(super) fn equations(spec: &Spec, program: &Program) -> String {
    let names = Names::new(program);
    let output = |step: &Step| match step.name.as_str() {
        "" => "\\mathrm{result}".into(),
        name => symbol_of(&format!("result.{name}")),
    };
    let steps = program.steps.iter().map(|step| (names.of(&step.name), &step.value));
    let outputs = program.outputs.iter().map(|step| (output(step), &step.value));
    let equation = |(name, value): (String, &Value)| {
        let lines = names.lines(spec, value);
        format!("{name} &= {}", lines.join(" \\\\\n  &\\quad"))
    };
    let equations: Vec<String> = steps.chain(outputs).map(equation).collect();
    format!("\\begin{{align*}}\n{}\n\\end{{align*}}\n", equations.join(" \\\\\n"))
}

/// A part of a name between underscores: `e23`, `ninf`, `x`, `w123`, `inverse`.
fn word(text: &str) -> String {
    let digits = text.trim_start_matches(|c: char| !c.is_ascii_digit());
    let letters = text.trim_end_matches(|c: char| c.is_ascii_digit());
    match (letters, digits) {
        ("no", "") => "n_o".into(),
        ("ninf", "") => "n_\\infty".into(),
        ("", digits) => digits.into(),
        (letters, digits) if letters.len() + digits.len() == text.len() => {
            let letters = if letters.len() == 1 { letters.into() } else { format!("\\mathrm{{{}}}", escaped(letters)) };
            if digits.is_empty() { letters } else { format!("{letters}_{{{digits}}}") }
        }
        _ => format!("\\mathrm{{{}}}", escaped(text)),
    }
}

/// A basis blade: `e_{23} \wedge n_o`; the scalar one is 1.
pub(super) fn blade(name: &str) -> String {
    if name == "s" { "1".into() } else { name.split('_').map(word).collect::<Vec<_>>().join(" \\wedge ") }
}

/// A product of basis blades.
pub(super) fn cell(terms: &[(Rational, String)]) -> String {
    let mut text = String::new();
    for (coefficient, name) in terms {
        let magnitude = coefficient.abs();
        text += match (coefficient.is_negative(), text.is_empty()) {
            (true, _) => "-",
            (false, true) => "",
            (false, false) => "+",
        };
        text += &match (name.as_str(), magnitude == Rational::ONE) {
            ("s", _) => constant(magnitude),
            (name, true) => blade(name),
            (name, false) => format!("{}\\, {}", constant(magnitude), blade(name)),
        };
    }
    if text.is_empty() { "0".into() } else { text }
}

fn constant(value: Rational) -> String {
    let sign = if value.is_negative() { "-" } else { "" };
    match (value.abs().numerator(), value.denominator()) {
        (n, 1) => format!("{sign}{n}"),
        (n, d) => format!("{sign}\\tfrac{{{n}}}{{{d}}}"),
    }
}

/// A name of a program: its root with the rest as subscript.
fn symbol_of(name: &str) -> String {
    let split = name.find(['.', '_']).filter(|at| *at > 0);
    let Some(at) = split else { return word(name) };
    let rest = name[at + 1..].split(['.', '_']).filter(|part| !part.is_empty()).map(word);
    // The root in braces: it may have a subscript of its own.
    format!("{{{}}}_{{{}}}", word(&name[..at]), rest.collect::<Vec<_>>().join("\\,"))
}

/// How each name of a program is written.
struct Names(BTreeMap<String, String>);

impl Names {
    fn new(program: &Program) -> Self {
        let mut names: BTreeSet<&str> = program.steps.iter().map(|step| step.name.as_str()).collect();
        for value in program.values() {
            match value {
                Value::Sum(products) => names.extend(products.iter().flat_map(|p| &p.factors).map(String::as_str)),
                Value::Quotient(numerator, denominator) => {
                    names.extend(numerator.factors.iter().chain([denominator]).map(String::as_str));
                }
                Value::Sqrt(radicand) => {
                    names.insert(radicand);
                }
                Value::Call(_) => {}
            }
        }
        let (mut written, mut taken) = (BTreeMap::new(), BTreeSet::new());
        for name in names {
            let plain = symbol_of(name);
            let mut unique = plain.clone();
            let mut primes = 0;
            while !taken.insert(unique.clone()) {
                primes += 1;
                unique = format!("{{{plain}}}^{{{}}}", "\\prime".repeat(primes));
            }
            written.insert(name.to_string(), unique);
        }
        Self(written)
    }

    fn of(&self, name: &str) -> String {
        self.0.get(name).cloned().unwrap_or_else(|| symbol_of(name))
    }

    fn product(&self, product: &Product) -> String {
        let magnitude = product.coefficient.abs();
        let factors: Vec<String> = product.factors.iter().map(|factor| self.of(factor)).collect();
        let constant = (magnitude != Rational::ONE || factors.is_empty()).then(|| constant(magnitude));
        constant.into_iter().chain(factors).collect::<Vec<_>>().join("\\, ")
    }

    /// The lines of a value.
    fn lines(&self, spec: &Spec, value: &Value) -> Vec<String> {
        let one = |text: String| vec![text];
        match value {
            Value::Sum(products) if products.is_empty() => one("0".into()),
            Value::Sum(products) => {
                let term = |(index, product): (usize, &Product)| {
                    let sign = match (index, product.coefficient.is_negative()) {
                        (0, false) => "",
                        (0, true) => "-",
                        (_, false) => " + ",
                        (_, true) => " - ",
                    };
                    format!("{sign}{}", self.product(product))
                };
                let terms: Vec<String> = products.iter().enumerate().map(term).collect();
                terms.chunks(TERMS_ON_A_LINE).map(<[String]>::concat).collect()
            }
            Value::Quotient(numerator, denominator) => {
                let sign = if numerator.coefficient.is_negative() { "-" } else { "" };
                one(format!("{sign}\\frac{{{}}}{{{}}}", self.product(numerator), self.of(denominator)))
            }
            Value::Sqrt(radicand) => one(format!("\\sqrt{{{}}}", self.of(radicand))),
            Value::Call(call) => {
                let argument = |argument: &crate::program::Argument<Step>| {
                    let values: Vec<String> =
                        argument.fields.iter().map(|field| self.lines(spec, &field.value).concat()).collect();
                    let values = values.join(",\\, ");
                    let ty = argument.ty.map(|index| spec.types[index].name.to_string());
                    ty.map_or(values.clone(), |ty| format!("\\mathrm{{{}}}({values})", escaped(&ty)))
                };
                let arguments: Vec<String> = call.arguments.iter().map(argument).collect();
                one(format!("\\mathrm{{{}}}({})", escaped(&call.function), arguments.join(",\\, ")))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_would_look_alike_are_told_apart() {
        let product = |factors: &[&str]| Product {
            coefficient: Rational::ONE,
            factors: factors.iter().map(|factor| factor.to_string()).collect(),
        };
        let step = |name: &str, factors: &[&str]| Step { name: name.into(), value: Value::Sum(vec![product(factors)]) };
        let steps = vec![step("t_e1", &["t.e1", "b"]), step("t_e1_2", &["t_e1", "b"])];
        let names = Names::new(&Program { steps, outputs: vec![step("", &["t_e1_2"])] });
        assert_eq!(names.of("t.e1"), "{t}_{e_{1}}");
        assert_eq!(names.of("t_e1"), "{{t}_{e_{1}}}^{\\prime}");
        assert_eq!(names.of("t_e1_2"), "{t}_{e_{1}\\,2}");
        assert_eq!(names.of("b"), "b");
    }

    #[test]
    fn names_are_written_as_in_books() {
        for (name, written) in [
            ("a.e23", "{a}_{e_{23}}"),
            ("a.e1_no_ninf", "{a}_{e_{1}\\,n_o\\,n_\\infty}"),
            ("0.rho_sq", "{0}_{\\mathrm{rho}\\,\\mathrm{sq}}"),
            ("inverse_2", "{\\mathrm{inverse}}_{2}"),
            ("a.w123", "{a}_{w_{123}}"),
        ] {
            assert_eq!(symbol_of(name), written);
        }
        assert_eq!(blade("e23_ninf"), "e_{23} \\wedge n_\\infty");
    }
}

//! A program as readable text: what documentation and inspection show.

use crate::infer::Output;
use crate::item::Item;
use crate::program::{Counts, Product, Program, Value};
use crate::scalar::Rational;
use crate::spec::Spec;
use std::fmt::Write;

/// The steps and outputs, one line each.
#[must_use]
pub fn program_text(program: &Program) -> String {
    let mut text = String::new();
    for step in &program.steps {
        let _ = writeln!(text, "{} = {}", step.name, value_text(&step.value));
    }
    for output in &program.outputs {
        let target = if output.name.is_empty() { "result".to_string() } else { format!("result.{}", output.name) };
        let _ = writeln!(text, "{target} = {}", value_text(&output.value));
    }
    text
}

fn value_text(value: &Value) -> String {
    match value {
        Value::Quotient(numerator, denominator) => format!("{numerator} / {denominator}"),
        Value::Sqrt(radicand) => format!("sqrt({radicand})"),
        Value::Sum(products) if products.is_empty() => "0".into(),
        Value::Sum(products) => {
            let mut text = String::new();
            for (index, product) in products.iter().enumerate() {
                let negative = product.coefficient.is_negative();
                text += match (index, negative) {
                    (0, false) => "",
                    (0, true) => "-",
                    (_, false) => " + ",
                    (_, true) => " - ",
                };
                text += &product_text(product);
            }
            text
        }
    }
}

fn product_text(product: &Product) -> String {
    let magnitude = product.coefficient.abs();
    let factors = product.factors.join(" ");
    match (magnitude == Rational::ONE, product.factors.is_empty()) {
        (true, false) => factors,
        (false, false) => format!("{magnitude} {factors}"),
        (_, true) => magnitude.to_string(),
    }
}

/// `16 mul, 12 add`
#[must_use]
pub fn counts_text(counts: Counts) -> String {
    let named =
        [("mul", counts.mul), ("add", counts.add), ("neg", counts.neg), ("div", counts.div), ("sqrt", counts.sqrt)];
    let parts: Vec<String> = named.iter().filter(|(_, n)| *n > 0).map(|(name, n)| format!("{n} {name}")).collect();
    if parts.is_empty() { "none".into() } else { parts.join(", ") }
}

/// The type of a result, by name.
#[must_use]
pub fn output_name(spec: &Spec, output: Output) -> String {
    match output {
        Output::Scalar => "T".into(),
        Output::Type(index) => spec.types[index].name.to_string(),
    }
}

/// `a: Rotor(s, e23, e31, e12)`
#[must_use]
pub fn layout_text(spec: &Spec, item: &Item) -> String {
    let parameters = item.parameters.iter().map(|(name, ty)| {
        let ty = &spec.types[*ty];
        format!("{name}: {}({})", ty.name, ty.fields.join(", "))
    });
    parameters.collect::<Vec<_>>().join("; ")
}

/// The documentation of an item: layout, formula and cost, all from its program.
#[must_use]
pub fn documentation(spec: &Spec, item: &Item) -> String {
    let assumption = match item.parameters.iter().any(|(_, ty)| spec.types[*ty].unit) {
        true => "\n\nA unit operand is taken to be unit; `is_unit` tells.",
        false => "",
    };
    format!(
        "{} with {}; operations: {}.{assumption}\n\n```text\n{}```",
        item.name.replace('*', " * ").replace('^', " ^ ").replace('|', " | ").replace('&', " & "),
        layout_text(spec, item),
        counts_text(item.program.counts()),
        program_text(&item.program)
    )
}

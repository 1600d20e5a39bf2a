//! A program as readable text: what documentation and inspection show.

use crate::formula::Compiled;
use crate::infer::Output;
use crate::item::Item;
use crate::program::{Argument, Counts, Product, Program, Step, Value};
use crate::scalar::Rational;
use crate::spec::Spec;
use std::fmt::Write;

/// The steps and outputs, one line each.
#[must_use]
pub fn program_text(spec: &Spec, program: &Program) -> String {
    let mut text = String::new();
    for step in &program.steps {
        let value = match &step.value {
            Value::Call(call) => {
                let arguments = call.arguments.iter().map(|argument| argument_text(spec, argument));
                format!("{}({})", call.function, arguments.collect::<Vec<_>>().join(", "))
            }
            other => value_text(other),
        };
        let _ = writeln!(text, "{} = {value}", step.name);
    }
    for output in &program.outputs {
        let target = if output.name.is_empty() { "result".to_string() } else { format!("result.{}", output.name) };
        let _ = writeln!(text, "{target} = {}", value_text(&output.value));
    }
    text
}

fn argument_text(spec: &Spec, Argument { ty, fields }: &Argument<Step>) -> String {
    let values: Vec<String> = fields.iter().map(|field| value_text(&field.value)).collect();
    ty.map_or_else(|| values.concat(), |index| format!("{}({})", spec.types[index].name, values.join(", ")))
}

fn value_text(value: &Value) -> String {
    match value {
        Value::Call(call) => call.function.clone(),
        Value::Quotient(numerator, denominator) => {
            let sign = if numerator.coefficient.is_negative() { "-" } else { "" };
            format!("{sign}{} / {denominator}", product_text(numerator))
        }
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
        program_text(spec, &item.program)
    )
}

/// The documentation of a formula: layout, program and cost.
#[must_use]
pub fn formula_documentation(spec: &Spec, compiled: &Compiled) -> String {
    let units = compiled.formula.parameters.iter();
    let unit = |ty: &Output| matches!(ty, Output::Type(index) if spec.types[*index].unit);
    let assumption = match units.clone().any(unit) {
        true => "\n\nA unit operand is taken to be unit; `is_unit` tells.",
        false => "",
    };
    let calls = if calls(&compiled.program).is_empty() { "" } else { ", and those of the calls" };
    format!(
        "With {}; operations: {}{calls}.{assumption}\n\n```text\n{}```",
        formula_layout(spec, compiled),
        counts_text(compiled.program.counts()),
        program_text(spec, &compiled.program)
    )
}

/// The names of the formulas that a program calls.
#[must_use]
pub fn calls(program: &Program) -> Vec<&str> {
    let called = program.steps.iter().filter_map(|step| match &step.value {
        Value::Call(call) => Some(call.function.as_str()),
        _ => None,
    });
    called.collect()
}

/// `a: Rotor(s, e23, e31, e12); k: Scalar`
#[must_use]
pub fn formula_layout(spec: &Spec, compiled: &Compiled) -> String {
    let formula = &compiled.formula;
    let parameters = formula.source.header.parameters.iter().zip(&formula.parameters).map(|((name, _), ty)| match ty {
        Output::Scalar => format!("{name}: Scalar"),
        Output::Type(index) => {
            let ty = &spec.types[*index];
            format!("{name}: {}({})", ty.name, ty.fields.join(", "))
        }
    });
    let parameters: Vec<String> = parameters.collect();
    if parameters.is_empty() { "no operands".into() } else { parameters.join("; ") }
}

/// The type of the result of a formula: `Sphere`, `(Sphere, T)`.
#[must_use]
pub fn formula_output(spec: &Spec, compiled: &Compiled) -> String {
    let formula = &compiled.formula;
    let names = formula.results.iter().filter_map(|operand| Some(output_name(spec, formula.type_of(*operand)?)));
    let names: Vec<String> = names.collect();
    if formula.source.header.tuple { format!("({})", names.join(", ")) } else { names.concat() }
}

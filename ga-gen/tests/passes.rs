//! Every pass of the optimiser and every way to lower something leave the values as they are, and what inspection shows as
//! the last program is the one that is emitted.
//!
//! Programs are run on random residues from the manifolds of their operands: two rational functions that agree there are
//! equal but for a chance of 2^-60 a number.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use ga_gen::field::Fingerprint;
use ga_gen::formula::{self, Compiled};
use ga_gen::infer::Output;
use ga_gen::inspect;
use ga_gen::item::{self, Item};
use ga_gen::optimise::{Effort, optimise, stages};
use ga_gen::program::{Product, Program, Value};
use ga_gen::scalar::Rational;
use ga_gen::spec::Spec;
use std::collections::BTreeMap;
use support::source_of;

type Values = BTreeMap<String, Fingerprint>;

fn product(values: &Values, product: &Product) -> Fingerprint {
    let constant = Fingerprint::constant(product.coefficient);
    product.factors.iter().fold(constant, |result, factor| result.times(values[factor]))
}

/// The outputs of a program on given inputs.
fn run(program: &Program, inputs: &Values) -> Vec<(String, Fingerprint)> {
    let value = |values: &Values, value: &Value| match value {
        Value::Sum(products) => {
            let zero = Fingerprint::constant(Rational::ZERO);
            products.iter().fold(zero, |sum, term| sum.plus(product(values, term)))
        }
        Value::Quotient(numerator, denominator) => {
            product(values, numerator).times(values[denominator].map(|value| value.inverse()))
        }
        Value::Sqrt(_) | Value::Call(_) => panic!("no formula here takes a root or calls another"),
    };
    let mut values = inputs.clone();
    for step in &program.steps {
        let result = value(&values, &step.value);
        assert!(values.insert(step.name.clone(), result).is_none(), "{} hides another value", step.name);
    }
    program.outputs.iter().map(|output| (output.name.clone(), value(&values, &output.value))).collect()
}

/// The numbers of the operands, on the manifolds of their types.
fn inputs(spec: &Spec, operands: &[(String, Output)]) -> Values {
    let mut inputs = Values::new();
    for (name, ty) in operands {
        match ty {
            Output::Type(index) => {
                let fields = spec.types[*index].fields.iter().map(|field| format!("{name}.{field}"));
                inputs.extend(fields.zip(spec.sample(*index, name).unwrap()));
            }
            Output::Scalar => {
                let mut stream = ga_gen::field::Stream::named(name);
                inputs.insert(name.clone(), Fingerprint(std::array::from_fn(|_| stream.next_residue())));
            }
        }
    }
    inputs
}

/// Holds the stages of one lowering against a program; returns how many passes changed something.
fn compare(name: &str, stages: &[(&str, Option<Program>)], program: &Program, inputs: &Values) -> usize {
    let expected = run(program, inputs);
    let programs: Vec<(&str, &Program)> = stages.iter().filter_map(|(n, p)| Some((*n, p.as_ref()?))).collect();
    for (pass, stage) in &programs {
        assert_eq!(run(stage, inputs), expected, "{name} after {pass}");
    }
    programs.windows(2).filter(|pair| pair[0].1 != pair[1].1).count()
}

fn check_item(spec: &Spec, item: &Item) -> usize {
    // The squared norm of a unit type is computed as if it were not known to be 1.
    if matches!(item.operation, item::Operation::NormSq(_)) {
        return 0;
    }
    let operands: Vec<_> = item.parameters.iter().map(|(name, ty)| (name.clone(), Output::Type(*ty))).collect();
    let inputs = inputs(spec, &operands);
    let lowered = |plan| item::lower_by(spec, item.operation, plan).unwrap().map(|(lowered, _)| lowered);
    let chosen = lowered(item.plan.again()).unwrap();
    let passes = stages(&chosen.builder, &chosen.fields, Effort::Product);
    assert_eq!(passes.last().unwrap().1.as_ref(), Some(&item.program), "{}", item.name);
    let changed = compare(&item.name, &passes, &item.program, &inputs);
    for (point, choice) in item.plan.made().iter().enumerate() {
        for way in 0..choice.ways.len() {
            let Some(other) = lowered(item.plan.with(point, way)) else { continue };
            // Another way may leave another type proved of the result.
            if other.output == item.output {
                let program = optimise(&other.builder, &other.fields, Effort::Product);
                let name = format!("{} by {}", item.name, choice.ways[way]);
                assert_eq!(run(&program, &inputs), run(&item.program, &inputs), "{name}");
            }
        }
    }
    changed
}

fn check_formula(spec: &Spec, compiled: &Compiled) -> usize {
    let formula = &compiled.formula;
    let names = formula.source.header.parameters.iter().map(|(name, _)| name.to_string());
    let inputs = inputs(spec, &names.zip(formula.parameters.iter().copied()).collect::<Vec<_>>());
    let (lowered, _) = formula::lower(spec, formula, compiled.plan.again()).unwrap();
    let outputs = formula::outputs(spec, formula, &lowered.results);
    let passes = stages(&lowered.builder, &outputs, Effort::Whole);
    let name = formula.source.header.name.to_string();
    assert_eq!(passes.last().unwrap().1.as_ref(), Some(&compiled.program), "{name}");
    compare(&name, &passes, &compiled.program, &inputs)
}

#[test]
fn no_pass_and_no_way_changes_an_item() {
    let g3 = Spec::new(&source_of("g3"), None).unwrap();
    let cga = Spec::new(&source_of("cga"), Some(&g3)).unwrap();
    let mut changed = 0;
    for item in inspect::items(&g3).unwrap() {
        changed += check_item(&g3, &item);
    }
    // The versors, where there is a choice, and every twelfth of the rest.
    let items = inspect::items(&cga).unwrap();
    let chosen = items.iter().enumerate().filter(|(index, item)| index % 12 == 0 || !item.plan.made().is_empty());
    for (_, item) in chosen {
        changed += check_item(&cga, item);
    }
    assert!(changed > 500, "{changed} passes changed something: the rest was not tried");
}

#[test]
fn no_pass_changes_a_formula() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../src");
    let mut changed = 0;
    for file in ["geometry/formulas.rs", "algebra/split.rs", "versor/pose.rs"] {
        let inspected = inspect::load(&root.join(file), Some(&root.join("algebra/cga.rs"))).unwrap();
        changed += inspected.formulas.iter().map(|(spec, compiled)| check_formula(spec, compiled)).sum::<usize>();
    }
    assert!(changed > 20, "{changed} passes changed something: the rest was not tried");
}

//! Can the comparison see anything? Every sign of a program is turned round, one at a time.

use crate::algebras::Algebra;
use crate::dense::Oracle;
use crate::elements::Random;
use crate::evaluate::run;
use crate::formulas::{point, read};
use ga_gen::formula;
use ga_gen::program::{Product, Program, Step, Value};

/// The products of a right-hand side.
fn products(step: &mut Step) -> &mut [Product] {
    match &mut step.value {
        Value::Sum(products) => products,
        Value::Quotient(numerator, _) => std::slice::from_mut(numerator),
        Value::Sqrt(_) | Value::Call(_) => &mut [],
    }
}

/// Does the sign of a whole step cancel: is it used in products of an even number of it only?
fn is_even(program: &Program, name: &str) -> bool {
    let uses = |product: &Product| product.factors.iter().filter(|factor| *factor == name).count();
    program.values().into_iter().all(|value| match value {
        Value::Sum(products) => products.iter().all(|product| uses(product) % 2 == 0),
        Value::Quotient(numerator, denominator) => denominator != name && uses(numerator) % 2 == 0,
        Value::Sqrt(radicand) => radicand != name,
        Value::Call(_) => true,
    })
}

/// Turns each sign of a compiled formula; returns how many mutants there were, and those that no value shows.
pub(crate) fn survivors(algebra: &Algebra, text: &str) -> (usize, Vec<String>) {
    let oracle = Oracle::new(&algebra.spec);
    let compiled = formula::compile(&algebra.spec, &read(algebra, text).unwrap()).unwrap();
    let point = point(algebra, &oracle, &compiled.formula, &compiled.signs, &mut Random(11)).unwrap();
    let expected = run(&compiled.program, &point.inputs);
    let (mut count, mut survivors) = (0, vec![]);
    let steps = compiled.program.steps.len();
    for index in 0..steps + compiled.program.outputs.len() {
        let mut term = 0;
        loop {
            let mut mutant = compiled.program.clone();
            let step = if index < steps { &mut mutant.steps[index] } else { &mut mutant.outputs[index - steps] };
            let name = step.name.clone();
            let (products, last) = (products(step), term);
            let alone = products.len() == 1;
            let Some(product) = products.get_mut(last) else { break };
            product.coefficient = -product.coefficient;
            if run(&mutant, &point.inputs) == expected && !(alone && is_even(&compiled.program, &name)) {
                survivors.push(format!("{text}: {name}, term {term}"));
            }
            (count, term) = (count + 1, term + 1);
        }
    }
    (count, survivors)
}

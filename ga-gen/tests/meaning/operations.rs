//! Every operation of two types by every plan, schedule and effort, after every pass; and every compiled item.

use crate::algebras::Algebra;
use crate::dense::{Dense, Oracle};
use crate::elements::{Random, fields};
use crate::evaluate::{Names, run};
use crate::interpret::inputs;
use crate::plans::every_plan;
use ga_gen::expression::Expression;
use ga_gen::field::Residue;
use ga_gen::infer::Output;
use ga_gen::item::{self, Item, Operation};
use ga_gen::lower::{Lowering, Schedule};
use ga_gen::optimise::{Effort, stages};
use ga_gen::product::Kind;
use ga_gen::program::Scaled;
use ga_gen::scalar::Rational;
use std::collections::BTreeMap;

/// More plans of one operation are not tried in full: products of two general multivectors have three, sandwiches 30.
const MOST_PLANS: usize = 40;

/// What was run.
#[derive(Debug, Default)]
pub(crate) struct Tally {
    pub(crate) expressions: usize,
    pub(crate) plans: usize,
    pub(crate) programs: usize,
    pub(crate) passes: BTreeMap<&'static str, usize>,
}

pub(crate) struct Check<'a> {
    pub(crate) algebra: &'a Algebra,
    pub(crate) oracle: Oracle,
    pub(crate) random: Random,
    pub(crate) tally: Tally,
}

impl<'a> Check<'a> {
    pub(crate) fn new(algebra: &'a Algebra) -> Self {
        let oracle = Oracle::new(&algebra.spec);
        Self { algebra, oracle, random: Random(0x9e37_79b9_7f4a_7c15), tally: Tally::default() }
    }

    fn sample(&mut self, types: &[usize]) -> (Vec<Dense>, Names<Residue>) {
        let spec = &self.algebra.spec;
        let sampled: Vec<Vec<Residue>> =
            types.iter().map(|ty| fields(&self.oracle, &spec.types[*ty], &mut self.random)).collect();
        let values = types.iter().zip(&sampled).map(|(ty, f)| self.oracle.value(&spec.types[*ty], f)).collect();
        let named = ["a", "b", "c", "d"].into_iter().zip(types.iter().map(|ty| Output::Type(*ty)));
        (values, inputs(spec, named, &sampled))
    }

    /// The expression over parameters of these types, lowered in every way, against the dense value.
    pub(crate) fn expression(&mut self, expression: &Expression, types: &[usize]) {
        let (values, inputs) = self.sample(types);
        let expected = self.oracle.expression(expression, &values);
        let expected = expected.map(|value| self.oracle.coefficients(&value));
        self.tally.expressions += 1;
        for schedule in [Schedule::Stable, Schedule::Split] {
            let mut tally = std::mem::take(&mut self.tally);
            tally.plans += every_plan(MOST_PLANS, |plan| {
                let mut lowering = Lowering::new(&self.algebra.spec, plan, schedule);
                for (name, ty) in ["a", "b", "c", "d"].into_iter().zip(types) {
                    lowering.add_parameter(name, *ty).unwrap();
                }
                let lowered = lowering.lower(expression);
                assert_eq!(lowered.is_some(), expected.is_some(), "{expression:?}");
                let (builder, plan) = lowering.finish();
                if let (Some(components), Some(expected)) = (lowered, &expected) {
                    let spec = &self.algebra.spec;
                    let names = components.iter().map(|(blade, value)| (spec.signature.name(*blade), *value));
                    let outputs: Vec<(String, Scaled)> = names.collect();
                    let mut sparse = vec![Residue::ZERO; expected.len()];
                    for effort in [Effort::Product, Effort::Whole] {
                        let mut last = None;
                        for (pass, program) in stages(&builder, &outputs, effort) {
                            let Some(program) = program else { continue };
                            *tally.passes.entry(pass).or_default() += 1;
                            if last.as_ref() == Some(&program) {
                                continue;
                            }
                            let found = run(&program, &inputs).unwrap();
                            components.keys().zip(found).for_each(|(blade, x)| sparse[blade.0 as usize] = x);
                            let text = || {
                                let names: Vec<String> =
                                    types.iter().map(|ty| spec.types[*ty].name.to_string()).collect();
                                format!("{expression:?} of {names:?}, {schedule:?}, {plan:?}, {effort:?}, after {pass}")
                            };
                            assert!(sparse == *expected, "{}: {}", self.algebra.name, text());
                            tally.programs += 1;
                            last = Some(program);
                        }
                    }
                }
                plan
            });
            self.tally = tally;
        }
    }

    /// All operations of one type and of two.
    pub(crate) fn operations(&mut self, wanted: impl Fn(usize, usize) -> bool) {
        let a = || Box::new(Expression::Input(0));
        let b = || Box::new(Expression::Input(1));
        let spec = &self.algebra.spec;
        for i in 0..spec.types.len() {
            if spec.types[i].fields.is_empty() {
                continue;
            }
            let mut unary = vec![Expression::Reverse(a()), Expression::Dual(a()), Expression::Undual(a())];
            unary.extend(
                (0..=spec.signature.dimension()).map(|grade| Expression::Grade(u32::try_from(grade).unwrap(), a())),
            );
            unary.push(Expression::Product(Kind::Geometric, a(), Box::new(Expression::Reverse(a()))));
            unary.iter().for_each(|expression| self.expression(expression, &[i]));
            for j in (0..spec.types.len()).filter(|j| wanted(i, *j)) {
                for kind in [Kind::Geometric, Kind::Outer, Kind::Contraction] {
                    self.expression(&Expression::Product(kind, a(), b()), &[i, j]);
                }
                self.expression(&Expression::Meet(a(), b()), &[i, j]);
                self.expression(&Expression::sum(*a(), -Rational::ONE, *b()), &[i, j]);
                if spec.types[i].versor || i == j {
                    self.expression(&Expression::Sandwich(a(), b()), &[i, j]);
                }
            }
        }
    }

    /// A compiled item against the dense value.
    pub(crate) fn item(&mut self, item: &Item) {
        let spec = &self.algebra.spec;
        let types: Vec<usize> = item.parameters.iter().map(|(_, ty)| *ty).collect();
        let (values, mut inputs) = self.sample(&types);
        let a = || Expression::Input(0);
        let expected = match item.operation {
            Operation::NormSq(ty) => {
                // Nothing but the stored numbers is known: the norm is of use where it is not 1.
                let fields: Vec<Residue> = spec.types[ty].fields.iter().map(|_| self.random.residue()).collect();
                let value = self.oracle.value(&spec.types[ty], &fields);
                inputs = crate::interpret::inputs(spec, [("a", Output::Type(ty))], &[fields]);
                self.oracle.scalar(self.oracle.norm_sq(&value))
            }
            Operation::Product(kind, ..) => self.value(Expression::product(kind, a(), Expression::Input(1)), &values),
            Operation::Meet(..) => self.value(Expression::Meet(Box::new(a()), Box::new(Expression::Input(1))), &values),
            Operation::Apply(..) => {
                self.value(Expression::Sandwich(Box::new(a()), Box::new(Expression::Input(1))), &values)
            }
            Operation::Reverse(_) => self.value(Expression::Reverse(Box::new(a())), &values),
            Operation::Dual(_) => self.value(Expression::Dual(Box::new(a())), &values),
            Operation::Undual(_) => self.value(Expression::Undual(Box::new(a())), &values),
            Operation::Grade(grade, _) => self.value(Expression::Grade(grade, Box::new(a())), &values),
            Operation::Embed(..) => values[0].clone(),
        };
        let found = self.oracle.output(spec, item.output, &run(&item.program, &inputs).unwrap());
        // The image of a type with a weight is divided by its own.
        let expected = match (item.operation, item.output) {
            (Operation::Apply(..), Output::Type(ty)) if spec.types[ty].weight().is_some() => {
                self.oracle.by_weight(&spec.types[ty], &expected)
            }
            _ => expected,
        };
        assert!(found == expected, "{}: {}", self.algebra.name, item.name);
    }

    fn value(&self, expression: Expression, values: &[Dense]) -> Dense {
        self.oracle.expression(&expression, values).expect("an item has a value")
    }

    pub(crate) fn items(&mut self) -> Vec<Item> {
        let items = ga_gen::inspect::items(&self.algebra.spec).unwrap();
        items.iter().for_each(|item| self.item(item));
        items
    }
}

/// Is an item of an operation that exists for every type there at all?
pub(crate) fn operations_of(algebra: &Algebra) -> usize {
    item::operations(&algebra.spec).len()
}

//! No pass loses digits: the bound of the running error does not grow, and what is measured does not either.
//!
//! Evaluated with all signs positive, a program gives the sum of the sizes of all its terms: rounding errors are that, times
//! epsilon, times the length of the longest chain. Common factors, shared sums and scales keep it; a rewrite that brings
//! in terms that cancel would not.

use crate::algebras::Algebra;
use crate::elements::Random;
use crate::evaluate::{Names, Number, run};
use crate::formulas::read;
use ga_gen::alternatives::Plan;
use ga_gen::formula;
use ga_gen::optimise::{Effort, stages};
use ga_gen::program::{Program, Scaled};
use ga_gen::scalar::Rational;

/// A number and the sum of the sizes of the terms that it is made of.
#[derive(Clone, Copy, Debug)]
struct Size {
    value: f64,
    terms: f64,
}

impl Number for Size {
    fn constant(value: Rational) -> Self {
        let value = f64::constant(value);
        Self { value, terms: value.abs() }
    }
    fn plus(self, other: Self) -> Self {
        Self { value: self.value + other.value, terms: self.terms + other.terms }
    }
    fn times(self, other: Self) -> Self {
        Self { value: self.value * other.value, terms: self.terms * other.terms }
    }
    fn over(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        // d(a/b) = da/b - a db/b².
        Self { value: quotient, terms: (self.terms + quotient.abs() * other.terms) / other.value.abs() }
    }
    fn root(self) -> Option<Self> {
        let root = self.value.root()?;
        Some(Self { value: root, terms: root + self.terms / root })
    }
}

/// About 31 digits: the sum of two floats that do not overlap (Dekker 1971).
#[derive(Clone, Copy, Debug)]
struct Wide(f64, f64);

fn two_sum(a: f64, b: f64) -> Wide {
    let sum = a + b;
    let part = sum - a;
    Wide(sum, (a - (sum - part)) + (b - part))
}

impl Number for Wide {
    fn constant(value: Rational) -> Self {
        let [n, d] = [value.numerator(), value.denominator()].map(|n| Self(n as f64, 0.0));
        n.over(d)
    }
    fn plus(self, other: Self) -> Self {
        let Self(high, low) = two_sum(self.0, other.0);
        two_sum(high, low + self.1 + other.1)
    }
    fn times(self, other: Self) -> Self {
        let high = self.0 * other.0;
        let low = self.0.mul_add(other.0, -high) + self.0 * other.1 + self.1 * other.0;
        two_sum(high, low)
    }
    fn over(self, other: Self) -> Self {
        let first = self.0 / other.0;
        let rest = self.plus(other.times(Self(-first, 0.0)));
        Self(first, 0.0).plus(Self(rest.0 / other.0, 0.0))
    }
    fn root(self) -> Option<Self> {
        let first = self.0.root()?;
        let rest = self.plus(Self(first, 0.0).times(Self(-first, 0.0)));
        Some(Self(first, 0.0).plus(Self(rest.0 / (2.0 * first), 0.0)))
    }
}

/// Parameters with numbers of very different size.
fn graded(program: &Program, decades: f64, random: &mut Random) -> Names<f64> {
    let mut names = Names::new();
    let steps: Vec<&String> = program.steps.iter().map(|step| &step.name).collect();
    let factors = program.values().into_iter().flat_map(|value| match value {
        ga_gen::program::Value::Sum(products) => products.iter().flat_map(|p| p.factors.clone()).collect(),
        ga_gen::program::Value::Quotient(n, d) => [&n.factors[..], std::slice::from_ref(d)].concat(),
        ga_gen::program::Value::Sqrt(of) => vec![of.clone()],
        ga_gen::program::Value::Call(_) => vec![],
    });
    for name in factors.filter(|name| !steps.contains(&name)) {
        let unit = |random: &mut Random| random.below(2_000_001) as f64 / 1e6 - 1.0;
        let size = 10.0_f64.powf(decades / 2.0 * unit(random));
        names.entry(name).or_insert(size * unit(random));
    }
    names
}

/// The stages of a formula as it stands, by the first ways.
fn programs(algebra: &Algebra, text: &str) -> Vec<(&'static str, Program)> {
    let formula = read(algebra, text).unwrap();
    let (lowered, _) = formula::lower(&algebra.spec, &formula, Plan::default()).unwrap();
    let fields = lowered.results.iter().flat_map(|(_, fields)| fields).enumerate();
    let outputs: Vec<(String, Scaled)> = fields.map(|(index, value)| (format!("n{index}"), *value)).collect();
    let stages = stages(&lowered.builder, &outputs, Effort::Whole);
    stages.into_iter().filter_map(|(pass, program)| Some((pass, program?))).collect()
}

/// Rounding of the sums of sizes themselves.
const SLACK: f64 = 1.0 + 1e-12;

/// Where the sum of the sizes of the terms of a result grows from one pass to the next.
pub(crate) fn growth(algebra: &Algebra, text: &str, random: &mut Random) -> Vec<String> {
    let stages = programs(algebra, text);
    let mut grown = Vec::new();
    for _ in 0..8 {
        let inputs = graded(&stages[0].1, 6.0, random);
        let sized = inputs.iter().map(|(name, x)| (name.clone(), Size { value: *x, terms: x.abs() })).collect();
        let all: Option<Vec<Vec<Size>>> = stages.iter().map(|(_, program)| run(program, &sized)).collect();
        let Some(all) = all else { continue };
        for (index, pair) in all.windows(2).enumerate() {
            for (before, after) in pair[0].iter().zip(&pair[1]) {
                if !(after.terms <= before.terms * SLACK) {
                    grown.push(format!("{text}: {} makes {before:?} of {after:?}", stages[index + 1].0));
                }
            }
        }
    }
    grown
}

/// Worst errors of numbers graded over twelve decades, before and after factoring, in epsilons of the sum of the sizes.
pub(crate) fn errors(algebra: &Algebra, text: &str, random: &mut Random) -> [f64; 2] {
    let stages = programs(algebra, text);
    let factor = stages.iter().position(|(pass, _)| *pass == "factor").expect("a formula is factored");
    let (before, after) = (&stages[factor - 1].1, &stages[stages.len() - 1].1);
    let mut worst = [0.0_f64; 2];
    for _ in 0..200 {
        let inputs = graded(before, 12.0, random);
        let wide = inputs.iter().map(|(name, x)| (name.clone(), Wide(*x, 0.0))).collect();
        let sized = inputs.iter().map(|(name, x)| (name.clone(), Size { value: *x, terms: x.abs() })).collect();
        let (Some(exact), Some(sizes)) = (run(before, &wide), run(before, &sized)) else { continue };
        for (worst, program) in worst.iter_mut().zip([before, after]) {
            let Some(found) = run::<f64>(program, &inputs) else { continue };
            for ((x, exact), size) in found.iter().zip(&exact).zip(&sizes) {
                let error = (x - exact.0) - exact.1;
                *worst = worst.max(error.abs() / (size.terms * f64::EPSILON));
            }
        }
    }
    worst
}

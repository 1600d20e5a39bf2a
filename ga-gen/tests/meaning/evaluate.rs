//! Runs a program, over any numbers.

use ga_gen::field::Residue;
use ga_gen::program::{Product, Program, Value};
use ga_gen::scalar::Rational;
use std::collections::BTreeMap;

pub(crate) trait Number: Copy {
    fn constant(value: Rational) -> Self;
    fn plus(self, other: Self) -> Self;
    fn times(self, other: Self) -> Self;
    fn over(self, other: Self) -> Self;
    /// `None` where there is none.
    fn root(self) -> Option<Self>;
}

impl Number for Residue {
    fn constant(value: Rational) -> Self {
        value.into()
    }
    fn plus(self, other: Self) -> Self {
        Self::plus(self, other)
    }
    fn times(self, other: Self) -> Self {
        Self::times(self, other)
    }
    fn over(self, other: Self) -> Self {
        self.times(other.inverse())
    }
    fn root(self) -> Option<Self> {
        self.sqrt()
    }
}

impl Number for f64 {
    fn constant(value: Rational) -> Self {
        value.numerator() as Self / value.denominator() as Self
    }
    fn plus(self, other: Self) -> Self {
        self + other
    }
    fn times(self, other: Self) -> Self {
        self * other
    }
    fn over(self, other: Self) -> Self {
        self / other
    }
    fn root(self) -> Option<Self> {
        (self >= 0.0).then(|| self.sqrt())
    }
}

/// Named numbers.
pub(crate) type Names<N> = BTreeMap<String, N>;

/// The outputs, in order; `None` where a root does not exist.
pub(crate) fn run<N: Number>(program: &Program, inputs: &Names<N>) -> Option<Vec<N>> {
    let mut known = inputs.clone();
    for step in &program.steps {
        let value = value(&step.value, &known)?;
        assert!(known.insert(step.name.clone(), value).is_none(), "`{}` stands twice", step.name);
    }
    program.outputs.iter().map(|output| value(&output.value, &known)).collect()
}

fn value<N: Number>(value: &Value, known: &Names<N>) -> Option<N> {
    let of = |name: &String| *known.get(name).unwrap_or_else(|| panic!("`{name}` is used before it is computed"));
    let product = |p: &Product| {
        let mut factors = p.factors.iter().map(of);
        match (p.coefficient == Rational::ONE, factors.next()) {
            (true, Some(first)) => factors.fold(first, Number::times),
            (false, Some(first)) => factors.fold(N::constant(p.coefficient).times(first), Number::times),
            (_, None) => N::constant(p.coefficient),
        }
    };
    match value {
        Value::Sum(products) => {
            let mut terms = products.iter().map(product);
            let first = terms.next().unwrap_or(N::constant(Rational::ZERO));
            Some(terms.fold(first, Number::plus))
        }
        Value::Quotient(numerator, denominator) => Some(product(numerator).over(of(denominator))),
        Value::Sqrt(radicand) => of(radicand).root(),
        Value::Call(call) => panic!("a call of {}", call.function),
    }
}

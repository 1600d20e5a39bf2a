//! Expressions and formulas, evaluated densely: what a compiled program has to agree with.

use crate::dense::{Dense, Oracle, Part};
use crate::evaluate::{Names, Number};
use ga_gen::body::{Component, Formula, Operation, Step};
use ga_gen::expression::Expression;
use ga_gen::field::Residue;
use ga_gen::infer::Output;
use ga_gen::product::Kind;
use ga_gen::scalar::Rational;
use ga_gen::spec::Spec;
use ga_gen::types::Type;

impl Oracle {
    /// The value of an expression; `None` where it has none.
    pub(crate) fn expression(&self, expression: &Expression, operands: &[Dense]) -> Option<Dense> {
        let of = |expression| self.expression(expression, operands);
        Some(match expression {
            Expression::Input(index) => operands[*index].clone(),
            Expression::Constant(terms) => terms
                .iter()
                .fold(self.zero(), |sum, (blade, c)| self.sum(&sum, &self.scaled(self.blade(*blade), (*c).into()))),
            Expression::Sum(parts) => {
                let mut sum = self.zero();
                for (factor, part) in parts {
                    sum = self.sum(&sum, &self.scaled(&of(part)?, (*factor).into()));
                }
                sum
            }
            Expression::Product(kind, a, b) => {
                let part = match kind {
                    Kind::Geometric => Part::All,
                    Kind::Outer => Part::Outer,
                    Kind::Contraction => Part::Contraction,
                };
                self.product(part, &of(a)?, &of(b)?)
            }
            Expression::Meet(a, b) => self.meet(&of(a)?, &of(b)?)?,
            Expression::Reverse(a) => self.reverse(&of(a)?),
            Expression::Dual(a) => {
                // Where I squares to zero there is no dual by rule, though I a could be formed.
                self.undual(&self.zero())?;
                self.dual(&of(a)?)?
            }
            Expression::Undual(a) => self.undual(&of(a)?)?,
            Expression::Grade(wanted, a) => self.grade(&of(a)?, |grade| grade == *wanted),
            Expression::Sandwich(v, x) => self.sandwich(&of(v)?, &of(x)?),
        })
    }

    /// The values of the results of a formula, seen from the world; `None` where a root does not exist at this point.
    pub(crate) fn formula(
        &self,
        spec: &Spec,
        formula: &Formula,
        signs: &[Option<Rational>],
        fields: &[Vec<Residue>],
    ) -> Option<Vec<Dense>> {
        let mut operands: Vec<Dense> =
            formula.parameters.iter().zip(fields).map(|(ty, fields)| self.output(spec, *ty, fields)).collect();
        let needed = formula.needed();
        for (index, step) in formula.steps.iter().enumerate() {
            let value = needed[index].then(|| self.step(spec, step, signs[index], &operands, fields));
            operands.push(value.unwrap_or_else(|| Some(self.zero()))?);
        }
        Some(formula.results.iter().map(|result| operands[*result].clone()).collect())
    }

    fn step(
        &self,
        spec: &Spec,
        step: &Step,
        sign: Option<Rational>,
        operands: &[Dense],
        fields: &[Vec<Residue>],
    ) -> Option<Dense> {
        let of = |expression| self.expression(expression, operands).expect("the formula has a value");
        Some(match &step.operation {
            Operation::Value(value) | Operation::Typed { value, normalised: false, .. } => of(value),
            Operation::Typed { value, normalised: true, .. } => match step.ty.and_then(|ty| weighted(spec, ty)) {
                Some(ty) => self.by_weight(ty, &of(value)),
                None => self.by_norm(&of(value), sign)?,
            },
            Operation::Normalised(value) => self.by_norm(&of(value), sign)?,
            Operation::Sqrt(value) => self.scalar(of(value)[0].root()?),
            Operation::Quotient(a, b) => self.scaled(&of(a), of(b)[0].inverse()),
            Operation::Component(of, Component::Field(field)) => {
                self.scalar(fields.get(*of).expect("a field of a parameter")[*field])
            }
            Operation::Component(of, Component::Coefficient(blade, odd)) => {
                let value = self.coefficients(&operands[*of])[blade.0 as usize];
                self.scalar(if *odd { value.negated() } else { value })
            }
            Operation::Call { .. } | Operation::Part(..) => panic!("calls are opaque: no value of their own"),
        })
    }

    /// Divided so that the constant coefficient of the type has its value.
    pub(crate) fn by_weight(&self, ty: &Type, a: &Dense) -> Dense {
        let (blade, constant) = ty.weight().expect("a type with a weight");
        let weight = self.coefficients(a)[blade.0 as usize];
        self.scaled(a, weight.inverse().times(constant.into()))
    }

    fn by_norm(&self, a: &Dense, sign: Option<Rational>) -> Option<Dense> {
        let sign: Residue = sign.unwrap_or(Rational::ONE).into();
        Some(self.scaled(a, self.norm_sq(a).times(sign).root()?.inverse()))
    }

    /// A value of a type, or a scalar.
    pub(crate) fn output(&self, spec: &Spec, ty: Output, fields: &[Residue]) -> Dense {
        match ty {
            Output::Scalar => self.scalar(fields[0]),
            Output::Type(index) => self.value(&spec.types[index], fields),
        }
    }
}

fn weighted(spec: &Spec, ty: Output) -> Option<&Type> {
    let Output::Type(index) = ty else { return None };
    Some(&spec.types[index]).filter(|ty| ty.weight().is_some())
}

/// The fields of parameters by the names that programs give them.
pub(crate) fn inputs<'a>(
    spec: &Spec,
    parameters: impl IntoIterator<Item = (&'a str, Output)>,
    fields: &[Vec<Residue>],
) -> Names<Residue> {
    let mut names = Names::new();
    for ((name, ty), values) in parameters.into_iter().zip(fields) {
        for (field, value) in ga_gen::item::field_names(spec, ty).into_iter().zip(values) {
            names.insert(if field.is_empty() { name.to_string() } else { format!("{name}.{field}") }, *value);
        }
    }
    names
}

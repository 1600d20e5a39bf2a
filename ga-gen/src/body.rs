//! A formula that has been read: its names mean something in an algebra, and nothing is computed yet.
//!
//! The body is a list of steps. Operand `i` of an expression ([`Expression::Input`]) is parameter `i`, or else, after the
//! parameters, a step before: so what a `let` names is one node, however often it is used. Whatever can fail only when
//! it is computed (a quotient, a root, a norm) is a step of its own and keeps its place in the source.

use crate::blade::Blade;
use crate::expression::Expression;
use crate::header::Source;
use crate::infer::Output;
use proc_macro2::{Span, TokenStream};
use syn::{Ident, Path};

/// A formula over a given algebra.
#[derive(Clone)]
pub struct Formula {
    /// As written.
    pub source: Source,
    /// The types of the parameters.
    pub parameters: Vec<Output>,
    /// The steps, operands before their users.
    pub steps: Vec<Step>,
    /// The results: operands that are [`Operation::Typed`] steps.
    pub results: Vec<usize>,
    /// Parameters and `let`s that nothing reads.
    pub unused: Vec<Ident>,
    /// What a change of origin might change.
    pub fixed: Vec<Fixed>,
}

/// One step.
#[derive(Clone)]
pub struct Step {
    /// What to call it.
    pub name: String,
    /// Where a fault of it stands: from the first of these tokens to the last.
    pub place: TokenStream,
    /// What it computes.
    pub operation: Operation,
    /// Its type, where one is stated.
    pub ty: Option<Output>,
}

/// What a step computes.
#[derive(Clone)]
pub enum Operation {
    /// An expression.
    Value(Expression),
    /// An expression held by the step's type; is it divided by its weight, or, where the type has none, its norm?
    Typed {
        /// The expression.
        value: Expression,
        /// Whether it is divided.
        normalised: bool,
        /// The type, as written.
        declared: Ident,
    },
    /// Divided by its norm.
    Normalised(Expression),
    /// The square root of a scalar.
    Sqrt(Expression),
    /// The first divided by the second, a scalar.
    Quotient(Expression, Expression),
    /// A component of an operand.
    Component(usize, Component),
    /// A call; the results are [`Operation::Part`]s.
    Call {
        /// The formula.
        function: Path,
        /// The arguments.
        arguments: Vec<Expression>,
        /// Its results are a tuple.
        tuple: bool,
    },
    /// A result of a call: the step, and which result.
    Part(usize, usize),
}

/// A number in a multivector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// The field of its type.
    Field(usize),
    /// The coefficient of a blade; is the blade written with the opposite sense?
    Coefficient(Blade, bool),
}

/// Something that is tied to the origin.
#[derive(Clone, Debug)]
pub struct Fixed {
    /// Where it stands.
    pub span: Span,
    /// As written.
    pub text: String,
    /// What it is.
    pub what: Tied,
}

/// The ways to be tied to the origin.
#[derive(Clone, Debug)]
pub enum Tied {
    /// A constant, which may change under translations.
    Constant(Expression),
    /// A parameter, whose type may not be kept by translations.
    Parameter(usize),
    /// A component of an operand.
    Component,
}

impl Operation {
    /// The expressions that it reads.
    #[must_use]
    pub fn expressions(&self) -> Vec<&Expression> {
        match self {
            Self::Value(a) | Self::Typed { value: a, .. } | Self::Normalised(a) | Self::Sqrt(a) => vec![a],
            Self::Quotient(a, b) => vec![a, b],
            Self::Call { arguments, .. } => arguments.iter().collect(),
            Self::Component(..) | Self::Part(..) => vec![],
        }
    }
}

impl Formula {
    /// The step behind an operand, if it is none of the parameters.
    #[must_use]
    pub fn step(&self, operand: usize) -> Option<&Step> {
        self.steps.get(operand.checked_sub(self.parameters.len())?)
    }

    /// The type of an operand, where one is stated.
    #[must_use]
    pub fn type_of(&self, operand: usize) -> Option<Output> {
        self.parameters.get(operand).copied().or_else(|| self.step(operand)?.ty)
    }

    /// For each step: do the results need it?
    #[must_use]
    pub fn needed(&self) -> Vec<bool> {
        self.read().split_off(self.parameters.len())
    }

    /// For each operand: do the results need it?
    #[must_use]
    pub fn read(&self) -> Vec<bool> {
        let count = self.parameters.len();
        let mut needed = vec![false; count + self.steps.len()];
        self.results.iter().for_each(|result| needed[*result] = true);
        for index in (0..self.steps.len()).rev() {
            if !needed[count + index] {
                continue;
            }
            let operation = &self.steps[index].operation;
            let mut operands = Vec::new();
            operation.expressions().into_iter().for_each(|expression| expression.operands(&mut operands));
            if let Operation::Component(of, _) | Operation::Part(of, _) = operation {
                operands.push(*of);
            }
            operands.into_iter().for_each(|operand| needed[operand] = true);
        }
        needed
    }
}

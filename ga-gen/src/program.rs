//! The intermediate representation: scalar steps between the algebra and the tokens.
//!
//! A [`Builder`] grows a graph in normal form: zeros vanish, constants fold, a step that equals an earlier one up to a
//! rational factor *is* that earlier one (decided by fingerprints, see [`crate::field`]), and the greatest common
//! rational factor of a sum is pulled out of it, so that signs and halves float outwards. [`crate::optimise`] turns
//! the graph into a [`Program`]: a flat list of named sums of products, from which the code, the formula and the
//! operation counts are all made.

use crate::field::Fingerprint;
use crate::scalar::Rational;
use std::collections::BTreeMap;

/// Index of a node in a [`Builder`].
pub type NodeId = usize;

/// A scalar: a rational number times a node, or the number alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Scaled {
    /// The rational factor.
    pub coefficient: Rational,
    /// The node; `None` for a constant.
    pub node: Option<NodeId>,
}

impl Scaled {
    /// 0.
    pub const ZERO: Self = Self { coefficient: Rational::ZERO, node: None };
    /// 1.
    pub const ONE: Self = Self { coefficient: Rational::ONE, node: None };

    /// A constant.
    #[must_use]
    pub fn constant(value: Rational) -> Self {
        Self { coefficient: value, node: None }
    }

    /// Times a rational.
    #[must_use]
    pub fn scaled(self, factor: Rational) -> Self {
        Self { coefficient: self.coefficient * factor, ..self }
    }

    /// Is it identically zero?
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.coefficient.is_zero()
    }
}

/// A product of nodes with a rational factor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Term {
    /// The rational factor.
    pub coefficient: Rational,
    /// The factors, sorted.
    pub factors: Vec<NodeId>,
}

/// What a node is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Node {
    /// A number handed to the function, by the path that names it there (`self.e1`).
    Input(String),
    /// A sum of products.
    Sum(Vec<Term>),
    /// `numerator / denominator`.
    Quotient(Term, NodeId),
    /// The square root.
    Sqrt(NodeId),
    /// A call of another formula: no number itself, but its parts are.
    Call(Box<CallNode>),
    /// A number of the result of a call, by its path within it (`e1`, `0.e1`; empty for a bare scalar).
    Part(NodeId, String),
}

/// A call of another formula, of which nothing is known but its arguments.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CallNode {
    /// Which call of the formula it is.
    pub call: usize,
    /// The function, for reading.
    pub function: String,
    /// The arguments, with the value of each field.
    pub arguments: Vec<Argument<(String, Scaled)>>,
}

/// An argument of a call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Argument<Field> {
    /// Its type, as declared; none for a scalar.
    pub ty: Option<usize>,
    /// Its fields, in order; a scalar has one without a name.
    pub fields: Vec<Field>,
}

/// A node with its name and values.
#[derive(Clone, Debug)]
pub struct Entry {
    /// What it is.
    pub node: Node,
    /// A name with a meaning in the algebra, for the generated code.
    pub hint: String,
    /// Its values at the random points.
    pub fingerprint: Fingerprint,
}

/// Grows a graph of nodes in normal form.
#[derive(Clone, Debug, Default)]
pub struct Builder {
    entries: Vec<Entry>,
    by_direction: BTreeMap<Fingerprint, NodeId>,
}

impl Builder {
    /// All nodes, operands before their users.
    #[must_use]
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// The values of a scalar at the random points.
    #[must_use]
    pub fn fingerprint(&self, value: Scaled) -> Fingerprint {
        let constant = Fingerprint::constant(value.coefficient);
        value.node.map_or(constant, |id| constant.times(self.entries[id].fingerprint))
    }

    /// Forgets that the nodes added since there were `mark` of them stand for their values, except the given ones.
    ///
    /// A value that was found by a path that cancels must not be reused where the caller derives it again from
    /// differences: same number on paper, many digits apart in floating point.
    pub fn forget_since(&mut self, mark: usize, keep: &[Scaled]) {
        self.by_direction.retain(|_, id| *id < mark || keep.iter().any(|value| value.node == Some(*id)));
    }

    /// Forgets the nodes added since there were `mark` of them: a proof that failed leaves no trace in the program.
    pub fn roll_back(&mut self, mark: usize) {
        if self.entries.len() > mark {
            self.entries.truncate(mark);
            self.by_direction.retain(|_, id| *id < mark);
        }
    }

    /// Adds an input.
    pub fn input(&mut self, path: &str, fingerprint: Fingerprint) -> Scaled {
        self.intern(Node::Input(path.into()), path, fingerprint)
    }

    fn intern(&mut self, node: Node, hint: &str, fingerprint: Fingerprint) -> Scaled {
        if let Some(known) = self.recognise(fingerprint) {
            return known;
        }
        let id = self.entries.len();
        self.entries.push(Entry { node, hint: hint.into(), fingerprint });
        self.by_direction.insert(fingerprint.direction(), id);
        Scaled { coefficient: Rational::ONE, node: Some(id) }
    }

    /// A constant, or a known node up to a rational factor.
    fn recognise(&self, fingerprint: Fingerprint) -> Option<Scaled> {
        if let Some(value) = fingerprint.as_constant() {
            return Some(Scaled::constant(value));
        }
        let id = *self.by_direction.get(&fingerprint.direction())?;
        let coefficient = fingerprint.ratio_to(self.entries[id].fingerprint)?;
        Some(Scaled { coefficient, node: Some(id) })
    }

    /// A sum of products of scalars, in normal form.
    pub fn sum(&mut self, products: &[(Rational, Vec<Scaled>)], hint: &str) -> Scaled {
        let mut collected: BTreeMap<Vec<NodeId>, Rational> = BTreeMap::new();
        for (factor, scalars) in products {
            let coefficient = scalars.iter().fold(*factor, |c, scalar| c * scalar.coefficient);
            let mut nodes: Vec<NodeId> = scalars.iter().filter_map(|scalar| scalar.node).collect();
            nodes.sort_unstable();
            let sum = collected.entry(nodes).or_insert(Rational::ZERO);
            *sum = *sum + coefficient;
        }
        let mut terms: Vec<Term> = collected
            .into_iter()
            .filter(|(_, coefficient)| !coefficient.is_zero())
            .map(|(factors, coefficient)| Term { coefficient, factors })
            .collect();
        let Some(first) = terms.first() else {
            return Scaled::ZERO;
        };
        // The primitive part: coefficients without a common factor, the first one positive.
        let sign = if first.coefficient.is_negative() { -Rational::ONE } else { Rational::ONE };
        let content = terms.iter().fold(Rational::ZERO, |c, term| term.coefficient.content(c)) * sign;
        let inverse = content.recip().unwrap_or(Rational::ONE);
        terms.iter_mut().for_each(|term| term.coefficient = term.coefficient * inverse);
        if let [Term { factors, .. }] = &terms[..]
            && factors.len() <= 1
        {
            return Scaled { coefficient: content, node: factors.first().copied() };
        }
        let fingerprint = self.value_of(&terms);
        self.intern(Node::Sum(terms), hint, fingerprint).scaled(content)
    }

    fn value_of(&self, terms: &[Term]) -> Fingerprint {
        terms.iter().fold(Fingerprint::constant(Rational::ZERO), |sum, term| {
            let constant = Fingerprint::constant(term.coefficient);
            sum.plus(term.factors.iter().fold(constant, |p, id| p.times(self.entries[*id].fingerprint)))
        })
    }

    /// `numerator / denominator`; a constant denominator folds.
    pub fn quotient(&mut self, numerator: Rational, denominator: Scaled, hint: &str) -> Option<Scaled> {
        let factor = numerator * denominator.coefficient.recip()?;
        let Some(id) = denominator.node else {
            return Some(Scaled::constant(factor));
        };
        let fingerprint = self.entries[id].fingerprint.map(|value| value.inverse());
        let fingerprint = fingerprint.times(Fingerprint::constant(factor));
        let numerator = Term { coefficient: factor, factors: vec![] };
        Some(self.intern(Node::Quotient(numerator, id), hint, fingerprint))
    }

    /// The sign, 1 or -1, of a scalar that is a sum of squares with coefficients of one sign, or a constant.
    #[must_use]
    pub fn sign_of_squares(&self, value: Scaled) -> Option<Rational> {
        let sign = |c: Rational| if c.is_negative() { -Rational::ONE } else { Rational::ONE };
        let Some(id) = value.node else { return Some(sign(value.coefficient)) };
        let Node::Sum(terms) = &self.entries[id].node else { return None };
        let first = sign(terms.first()?.coefficient);
        let squares = |term: &Term| term.factors.is_empty() || matches!(term.factors[..], [x, y] if x == y);
        let definite = terms.iter().all(|term| sign(term.coefficient) == first && squares(term));
        definite.then(|| first * sign(value.coefficient))
    }

    /// The square root of a scalar. Its values at the random points are opaque: fresh random numbers that belong to the
    /// radicand, because a residue need not have a root.
    pub fn sqrt(&mut self, radicand: Scaled, hint: &str) -> Scaled {
        if self.fingerprint(radicand) == Fingerprint::constant(Rational::ONE) {
            return Scaled::ONE;
        }
        let radicand = self.sum_as_node(radicand, hint);
        let mut stream = crate::field::Stream::named(&format!("sqrt {:?}", self.entries[radicand].fingerprint));
        let fingerprint = Fingerprint(std::array::from_fn(|_| stream.next_residue()));
        self.intern(Node::Sqrt(radicand), hint, fingerprint)
    }

    /// A call. Its values at the random points are opaque, like those of a root: they belong to function and arguments.
    pub fn call(&mut self, call: CallNode, hint: &str) -> NodeId {
        let fields = call.arguments.iter().flat_map(|argument| &argument.fields);
        let arguments: Vec<Fingerprint> = fields.map(|(_, value)| self.fingerprint(*value)).collect();
        let mut stream = crate::field::Stream::named(&format!("{} {arguments:?}", call.function));
        let fingerprint = Fingerprint(std::array::from_fn(|_| stream.next_residue()));
        let known = self.by_direction.get(&fingerprint.direction()).copied();
        known.unwrap_or_else(|| {
            self.entries.push(Entry { node: Node::Call(Box::new(call)), hint: hint.into(), fingerprint });
            self.by_direction.insert(fingerprint.direction(), self.entries.len() - 1);
            self.entries.len() - 1
        })
    }

    /// A number of the result of a call, with its values at the random points.
    pub fn part(&mut self, call: NodeId, path: &str, fingerprint: Fingerprint) -> Scaled {
        self.intern(Node::Part(call, path.into()), path, fingerprint)
    }

    /// A node whose value is exactly the scalar, factor included.
    fn sum_as_node(&mut self, value: Scaled, hint: &str) -> NodeId {
        match value.node {
            Some(id) if value.coefficient == Rational::ONE => id,
            node => {
                let terms = vec![Term { coefficient: value.coefficient, factors: node.into_iter().collect() }];
                let fingerprint = self.fingerprint(value);
                self.entries.push(Entry { node: Node::Sum(terms), hint: format!("{hint}_sq"), fingerprint });
                self.entries.len() - 1
            }
        }
    }
}

/// A product of named factors with a rational number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Product {
    /// The rational factor.
    pub coefficient: Rational,
    /// The names of the factors.
    pub factors: Vec<String>,
}

/// The right-hand side of a step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// A sum of products; positive terms stand first.
    Sum(Vec<Product>),
    /// `numerator / denominator`.
    Quotient(Product, String),
    /// The square root.
    Sqrt(String),
    /// A call of another formula; its parts are named by the step.
    Call(Call),
}

/// A call of another formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call {
    /// Which call of the formula it is.
    pub call: usize,
    /// The function, for reading.
    pub function: String,
    /// The arguments.
    pub arguments: Vec<Argument<Step>>,
}

/// A named scalar step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// The name.
    pub name: String,
    /// Its value.
    pub value: Value,
}

/// Straight-line scalar code: steps in order, then the outputs.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Program {
    /// Shared steps.
    pub steps: Vec<Step>,
    /// The fields of the result.
    pub outputs: Vec<Step>,
}

/// Operation counts of the emitted code. `add` counts subtractions as well.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Counts {
    /// Multiplications, also by constants.
    pub mul: usize,
    /// Additions and subtractions.
    pub add: usize,
    /// Sign changes that no sum absorbs.
    pub neg: usize,
    /// Divisions.
    pub div: usize,
    /// Square roots.
    pub sqrt: usize,
}

impl Counts {
    /// Multiplications, additions and sign changes: what a program is judged by.
    #[must_use]
    pub fn operations(self) -> usize {
        self.mul + self.add + self.neg
    }
}

impl Value {
    fn constants(&self) -> Vec<Rational> {
        match self {
            Self::Quotient(numerator, _) => vec![numerator.coefficient],
            Self::Sqrt(_) | Self::Call(_) => vec![],
            Self::Sum(products) => products.iter().map(|product| product.coefficient).collect(),
        }
    }
}

impl Program {
    /// Every right-hand side, the arguments of calls included.
    #[must_use]
    pub fn values(&self) -> Vec<&Value> {
        let mut values = Vec::new();
        for step in self.steps.iter().chain(&self.outputs) {
            if let Value::Call(call) = &step.value {
                values.extend(call.arguments.iter().flat_map(|argument| &argument.fields).map(|field| &field.value));
            }
            values.push(&step.value);
        }
        values
    }

    /// The first constant that generated code could not say, if there is one.
    #[must_use]
    pub fn oversized(&self) -> Option<Rational> {
        self.values().iter().flat_map(|value| value.constants()).find(|constant| !constant.fits())
    }

    /// Counts the operations that the emitted code performs.
    #[must_use]
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        for value in self.values() {
            match value {
                Value::Call(_) => {}
                Value::Quotient(numerator, _) => {
                    counts.div += 1;
                    count_sum(std::slice::from_ref(numerator), &mut counts);
                }
                Value::Sqrt(_) => counts.sqrt += 1,
                Value::Sum(products) => count_sum(products, &mut counts),
            }
        }
        counts
    }
}

fn count_sum(products: &[Product], counts: &mut Counts) {
    counts.add += products.len().saturating_sub(1);
    for product in products {
        let constant = usize::from(product.coefficient.abs() != Rational::ONE && !product.factors.is_empty());
        counts.mul += (product.factors.len() + constant).saturating_sub(1);
    }
    // A leading minus is an operation of its own, unless it sits in the constant factor.
    if let Some(first) = products.first()
        && first.coefficient == -Rational::ONE
        && !first.factors.is_empty()
    {
        counts.neg += 1;
    }
}

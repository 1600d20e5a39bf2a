//! From the graph in normal form to the program that is emitted.
//!
//! The passes, in order: dead code is left behind; complete squares are put together (`squares`); a step that is used
//! once is inlined where that costs nothing (`flatten`); equal constant factors within a sum are pulled into one
//! (`scale`). Each preserves the value exactly as a rational function; none touches a difference of squares.

mod factor;
mod flatten;
mod fuse;
mod moves;
mod scale;
mod squares;

use crate::field::Fingerprint;
use crate::program::{
    Argument, Builder, Call, CallNode, Entry, Node, NodeId, Product, Program, Scaled, Step, Term, Value,
};
use crate::scalar::Rational;
use std::collections::BTreeMap;

/// A node of the working graph: its name and what it is.
#[derive(Clone, Debug)]
struct Work {
    hint: String,
    node: Node,
    fingerprint: Fingerprint,
}

/// Where a sum stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Node(NodeId),
    Output(usize),
}

/// The working graph: nodes by id, and the outputs.
#[derive(Clone, Debug)]
struct Graph {
    nodes: Vec<Work>,
    outputs: Vec<(String, Vec<Term>)>,
}

impl Graph {
    /// The values of a sum.
    fn value_of(&self, terms: &[Term]) -> Fingerprint {
        terms.iter().fold(Fingerprint::constant(Rational::ZERO), |sum, term| {
            let constant = Fingerprint::constant(term.coefficient);
            sum.plus(term.factors.iter().fold(constant, |product, id| product.times(self.nodes[*id].fingerprint)))
        })
    }

    /// The terms of a sum or an output; none of anything else.
    fn terms(&self, place: Place) -> &[Term] {
        match place {
            Place::Output(index) => &self.outputs[index].1,
            Place::Node(id) => match &self.nodes[id].node {
                Node::Sum(terms) => terms,
                _ => &[],
            },
        }
    }

    /// Changes the terms of a sum or an output; does nothing to anything else.
    fn edit(&mut self, place: Place, change: impl FnOnce(&mut Vec<Term>)) {
        match place {
            Place::Output(index) => change(&mut self.outputs[index].1),
            Place::Node(id) => {
                if let Node::Sum(terms) = &mut self.nodes[id].node {
                    change(terms);
                }
            }
        }
    }

    /// A new node.
    fn push(&mut self, node: Node, hint: &str) -> NodeId {
        let fingerprint = match &node {
            Node::Sum(terms) => self.value_of(terms),
            Node::Quotient(numerator, denominator) => {
                let inverse = self.nodes[*denominator].fingerprint.map(|value| value.inverse());
                self.value_of(std::slice::from_ref(numerator)).times(inverse)
            }
            // Passes make no other nodes.
            _ => Fingerprint::constant(Rational::ZERO),
        };
        self.nodes.push(Work { hint: hint.into(), node, fingerprint });
        self.nodes.len() - 1
    }

    /// A node for a sum, for use in another one: a known one up to a rational factor, or a new one.
    fn sum(&mut self, terms: Vec<Term>, hint: String, user: NodeId) -> (Rational, NodeId) {
        let fingerprint = self.value_of(&terms);
        let direction = fingerprint.direction();
        let known = self.nodes.iter().enumerate().find_map(|(id, work)| {
            let same = work.fingerprint.direction() == direction;
            let factor = if same { fingerprint.ratio_to(work.fingerprint)? } else { return None };
            (!self.depends(id, user)).then_some((factor, id))
        });
        known.unwrap_or_else(|| (Rational::ONE, self.push(Node::Sum(terms), &hint)))
    }

    /// Is a node computed from another one?
    fn depends(&self, id: NodeId, on: NodeId) -> bool {
        let mut pending = vec![id];
        while let Some(id) = pending.pop() {
            if id == on {
                return true;
            }
            pending.extend(operands(&self.nodes[id].node));
        }
        false
    }

    /// How often each node is used, counting only what the outputs need.
    fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.nodes.len()];
        let mut pending: Vec<NodeId> = Vec::new();
        for (_, terms) in &self.outputs {
            pending.extend(terms.iter().flat_map(|term| term.factors.iter().copied()));
        }
        while let Some(id) = pending.pop() {
            uses[id] += 1;
            if uses[id] == 1 {
                pending.extend(operands(&self.nodes[id].node));
            }
        }
        uses
    }
}

fn operands(node: &Node) -> Vec<NodeId> {
    match node {
        Node::Input(_) => vec![],
        Node::Sum(terms) => terms.iter().flat_map(|term| term.factors.iter().copied()).collect(),
        Node::Quotient(numerator, id) => [&numerator.factors[..], &[*id]].concat(),
        Node::Sqrt(id) | Node::Part(id, _) => vec![*id],
        Node::Call(call) => {
            let fields = call.arguments.iter().flat_map(|argument| &argument.fields);
            fields.filter_map(|(_, value)| value.node).collect()
        }
    }
}

/// How much time a program is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Effort {
    /// One of the some thousand products of an algebra, most of which nobody calls: no search for common factors.
    Product,
    /// A formula that somebody wrote.
    Whole,
}

/// A pass, by name: it changes the graph and keeps its values.
type Pass = (&'static str, Effort, fn(&mut Graph));

/// The passes in order, each with the least effort that includes it.
const PASSES: [Pass; 10] = [
    ("flatten", Effort::Product, flatten::flatten),
    ("squares", Effort::Product, squares::complete_squares),
    ("flatten", Effort::Product, flatten::flatten),
    ("factor", Effort::Whole, factor::extract),
    ("flatten", Effort::Whole, flatten::flatten),
    ("fuse", Effort::Product, fuse::fuse_quotients),
    ("scale", Effort::Product, scale::pull_scales),
    ("flatten", Effort::Product, flatten::flatten),
    ("moves", Effort::Product, moves::move_scales),
    ("signs", Effort::Product, moves::align_signs),
];

/// Turns the parts of a graph that the outputs need into a program.
#[must_use]
pub fn optimise(builder: &Builder, outputs: &[(String, Scaled)], effort: Effort) -> Program {
    let mut graph = working_graph(builder, outputs);
    for (_, _, pass) in PASSES.iter().filter(|(_, least, _)| *least <= effort) {
        pass(&mut graph);
    }
    schedule(&graph)
}

/// The program before all passes (`lower`) and after each of them, scheduled for reading; none for a pass that the
/// effort leaves out. The last one is what [`optimise`] returns.
#[must_use]
pub fn stages(builder: &Builder, outputs: &[(String, Scaled)], effort: Effort) -> Vec<(&'static str, Option<Program>)> {
    let mut graph = working_graph(builder, outputs);
    let mut stages = vec![("lower", Some(schedule(&graph)))];
    for (name, least, pass) in PASSES {
        if least <= effort {
            pass(&mut graph);
        }
        stages.push((name, (least <= effort).then(|| schedule(&graph))));
    }
    stages
}

fn working_graph(builder: &Builder, outputs: &[(String, Scaled)]) -> Graph {
    let work = |e: &Entry| Work { hint: e.hint.clone(), node: e.node.clone(), fingerprint: e.fingerprint };
    let nodes = builder.entries().iter().map(work).collect();
    let output = |(name, value): &(String, Scaled)| {
        let term = Term { coefficient: value.coefficient, factors: value.node.into_iter().collect() };
        (name.clone(), vec![term])
    };
    Graph { nodes, outputs: outputs.iter().map(output).collect() }
}

/// Names the steps and lists them in dependency order.
fn schedule(graph: &Graph) -> Program {
    // A step must not hide a parameter, nor a function that is called.
    let parameters = graph.nodes.iter().filter_map(|work| match &work.node {
        Node::Input(path) => path.split('.').next().map(|root| (root.to_string(), 1)),
        Node::Call(call) => Some((call.function.clone(), 1)),
        _ => None,
    });
    let taken = parameters.collect();
    let mut scheduler = Scheduler { graph, names: BTreeMap::new(), taken, program: Program::default() };
    for (name, terms) in &graph.outputs {
        scheduler.name_all(terms.iter().flat_map(|term| term.factors.iter().copied()));
        let value = Value::Sum(scheduler.products(terms));
        scheduler.program.outputs.push(Step { name: name.clone(), value });
    }
    scheduler.program
}

struct Scheduler<'a> {
    graph: &'a Graph,
    names: BTreeMap<NodeId, String>,
    taken: BTreeMap<String, usize>,
    program: Program,
}

impl Scheduler<'_> {
    /// Names the operands of some nodes before them, in the order in which [`Self::name`] would. It calls itself for each
    /// operand without a name, and a long chain of steps would end the stack.
    fn name_all(&mut self, roots: impl DoubleEndedIterator<Item = NodeId>) {
        let mut pending: Vec<(NodeId, bool)> = roots.rev().map(|id| (id, false)).collect();
        while let Some((id, ready)) = pending.pop() {
            if self.names.contains_key(&id) {
                continue;
            }
            if ready {
                self.name(id);
                continue;
            }
            pending.push((id, true));
            let work = &self.graph.nodes[id];
            pending.extend(operands(&work.node).into_iter().rev().map(|operand| (operand, false)));
        }
    }

    fn name(&mut self, id: NodeId) -> String {
        if let Some(name) = self.names.get(&id) {
            return name.clone();
        }
        let Work { hint, node, .. } = &self.graph.nodes[id];
        let name = match node {
            Node::Input(path) => path.clone(),
            Node::Sum(terms) => {
                let value = Value::Sum(self.products(terms));
                self.push(hint, value)
            }
            Node::Quotient(numerator, denominator) => {
                let numerator = self.product(numerator);
                let value = Value::Quotient(numerator, self.name(*denominator));
                self.push(hint, value)
            }
            Node::Sqrt(radicand) => {
                let value = Value::Sqrt(self.name(*radicand));
                self.push(hint, value)
            }
            Node::Call(call) => {
                let value = Value::Call(self.call(call));
                self.push(hint, value)
            }
            Node::Part(call, path) if path.is_empty() => self.name(*call),
            Node::Part(call, path) => format!("{}.{path}", self.name(*call)),
        };
        self.names.insert(id, name.clone());
        name
    }

    fn call(&mut self, call: &CallNode) -> Call {
        let mut field = |(name, value): &(String, Scaled)| {
            let term = Term { coefficient: value.coefficient, factors: value.node.into_iter().collect() };
            Step { name: name.clone(), value: Value::Sum(self.products(&[term])) }
        };
        let arguments = call.arguments.iter();
        let arguments =
            arguments.map(|known| Argument { ty: known.ty, fields: known.fields.iter().map(&mut field).collect() });
        let arguments = arguments.collect();
        Call { call: call.call, function: call.function.clone(), arguments }
    }

    fn push(&mut self, hint: &str, value: Value) -> String {
        let count = self.taken.entry(hint.to_string()).or_insert(0);
        *count += 1;
        let name = if *count == 1 { hint.to_string() } else { format!("{hint}_{count}") };
        self.program.steps.push(Step { name: name.clone(), value });
        name
    }

    fn product(&mut self, term: &Term) -> Product {
        Product { coefficient: term.coefficient, factors: term.factors.iter().map(|id| self.name(*id)).collect() }
    }

    fn products(&mut self, terms: &[Term]) -> Vec<Product> {
        let mut products: Vec<Product> = terms.iter().map(|term| self.product(term)).collect();
        // A positive term first, if there is one: a leading minus is an operation of its own. The others keep the order of
        // their factors: neighbouring sums then read the same operands one after the other, which saves registers.
        if let Some(positive) = products.iter().position(|product| !product.coefficient.is_negative()) {
            products[..=positive].rotate_right(1);
        }
        products
    }
}

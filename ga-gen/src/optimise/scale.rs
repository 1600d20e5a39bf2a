//! Pulls equal constant factors of several terms of a sum into one: `x + 2 a b + 2 c d` becomes `x + 2 (a b + c d)`.

use super::Graph;
use crate::program::{Node, Term};
use crate::scalar::Rational;
use std::collections::BTreeMap;

/// Rewrites every sum and output.
pub(super) fn pull_scales(graph: &mut Graph) {
    for id in 0..graph.nodes.len() {
        if let Node::Sum(terms) = graph.nodes[id].node.clone() {
            let hint = graph.nodes[id].hint.clone();
            graph.nodes[id].node = Node::Sum(pulled(graph, terms, &hint));
        }
    }
    for index in 0..graph.outputs.len() {
        let (name, terms) = graph.outputs[index].clone();
        // `0.e1` is a number of the first of several results; a bare scalar has no name, or a number.
        let field = name.rsplit('.').next().filter(|field| field.starts_with(char::is_alphabetic));
        graph.outputs[index].1 = pulled(graph, terms, field.unwrap_or("result"));
    }
}

fn pulled(graph: &mut Graph, terms: Vec<Term>, hint: &str) -> Vec<Term> {
    let mut groups: BTreeMap<Rational, Vec<Term>> = BTreeMap::new();
    for term in terms {
        groups.entry(term.coefficient.abs()).or_default().push(term);
    }
    let mut result = Vec::new();
    for (magnitude, mut group) in groups {
        if magnitude == Rational::ONE || group.len() < 2 {
            result.extend(group);
            continue;
        }
        // The group's sign goes with its first term, so that the inner sum does not start with a minus.
        let first_positive = group.iter().position(|term| !term.coefficient.is_negative());
        let scale = if first_positive.is_some() { magnitude } else { -magnitude };
        let inverse = scale.recip().unwrap_or(Rational::ONE);
        group.iter_mut().for_each(|term| term.coefficient = term.coefficient * inverse);
        let part = graph.push(Node::Sum(group), &format!("{hint}_part"));
        result.push(Term { coefficient: scale, factors: vec![part] });
    }
    result
}

//! Inlines steps that are used once where that changes no count: a product into a product, a sum into a sum.

use super::Graph;
use crate::program::{Node, Term};
use crate::scalar::Rational;

/// Repeats until nothing changes.
pub(super) fn flatten(graph: &mut Graph) {
    let uses = graph.uses();
    // Operands come before their users, so one pass from the front sees every operand already flat.
    for id in 0..graph.nodes.len() {
        if let Node::Sum(terms) = &graph.nodes[id].node {
            let flat = flatten_terms(graph, &uses, terms);
            graph.nodes[id].node = Node::Sum(flat);
        }
    }
    for index in 0..graph.outputs.len() {
        let flat = flatten_terms(graph, &uses, &graph.outputs[index].1);
        graph.outputs[index].1 = flat;
    }
}

fn flatten_terms(graph: &Graph, uses: &[usize], terms: &[Term]) -> Vec<Term> {
    let mut result = Vec::new();
    for term in terms {
        let mut expanded = expand_products(graph, uses, term);
        // A sum used once, with coefficient +-1 and no other factor, dissolves into this sum.
        if let [only] = expanded.factors[..]
            && uses[only] == 1
            && let Node::Sum(inner) = &graph.nodes[only].node
            && (expanded.coefficient.abs() == Rational::ONE || terms.len() == 1 && inner.len() == 1)
        {
            let sign = expanded.coefficient;
            result.extend(inner.iter().map(|t| Term { coefficient: t.coefficient * sign, factors: t.factors.clone() }));
            continue;
        }
        expanded.factors.sort_unstable();
        result.push(expanded);
    }
    result
}

fn expand_products(graph: &Graph, uses: &[usize], term: &Term) -> Term {
    let mut result = Term { coefficient: term.coefficient, factors: vec![] };
    for factor in &term.factors {
        match &graph.nodes[*factor].node {
            Node::Sum(inner) if uses[*factor] == 1 && inner.len() == 1 => {
                result.coefficient = result.coefficient * inner[0].coefficient;
                result.factors.extend(&inner[0].factors);
            }
            _ => result.factors.push(*factor),
        }
    }
    result
}

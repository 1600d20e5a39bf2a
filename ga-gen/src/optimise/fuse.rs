//! `a (1 / b)` becomes `a / b` where the reciprocal has no other use.

use super::{Graph, Place};
use crate::program::{Node, NodeId, Term};
use crate::scalar::Rational;

/// Rewrites every product that is the only user of a reciprocal.
pub(super) fn fuse_quotients(graph: &mut Graph) {
    let uses = graph.uses();
    let alone =
        |id: &NodeId| uses[*id] == 1 && matches!(&graph.nodes[*id].node, Node::Quotient(n, _) if n.factors.is_empty());
    let reciprocals: Vec<NodeId> = (0..uses.len()).filter(alone).collect();
    let nodes = (0..graph.nodes.len()).filter(|id| uses[*id] > 0 && matches!(graph.nodes[*id].node, Node::Sum(_)));
    let places: Vec<Place> = nodes.map(Place::Node).chain((0..graph.outputs.len()).map(Place::Output)).collect();
    for place in places {
        for index in 0..graph.terms(place).len() {
            let term = graph.terms(place)[index].clone();
            let Some(position) = term.factors.iter().position(|factor| reciprocals.contains(factor)) else { continue };
            if term.factors.len() > 1 {
                let fused = fuse(graph, &term, position);
                graph.edit(place, |terms| terms[index] = fused);
            }
        }
    }
}

fn fuse(graph: &mut Graph, term: &Term, position: usize) -> Term {
    let mut factors = term.factors.clone();
    let reciprocal = factors.remove(position);
    let Node::Quotient(numerator, denominator) = graph.nodes[reciprocal].node.clone() else { return term.clone() };
    // The constant goes where it costs nothing.
    let coefficient = term.coefficient * numerator.coefficient;
    let sign = if coefficient.is_negative() { -Rational::ONE } else { Rational::ONE };
    let numerator = Term { coefficient: coefficient.abs(), factors };
    let quotient = graph.push(Node::Quotient(numerator, denominator), "quotient");
    Term { coefficient: sign, factors: vec![quotient] }
}

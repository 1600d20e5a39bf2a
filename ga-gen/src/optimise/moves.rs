//! Moves rational factors and signs between a sum and its uses, where that saves a multiplication or a sign change.
//!
//! Scaling a node by s multiplies its terms by s and divides every use by it. Quotients take any scale for nothing: it
//! goes into their constant numerator.

use super::{Graph, Place, operands};
use crate::program::{Node, NodeId, Term};
use crate::scalar::Rational;

/// Sweeps over all nodes until none moves; each move lowers the count, so this ends.
pub(super) fn move_scales(graph: &mut Graph) {
    if whole_cost(graph) == 0 {
        return;
    }
    let users = users(graph);
    // Every node is tried in a sweep, also after one has moved.
    while (0..users.len()).filter(|id| try_node(graph, *id, &users[*id])).count() > 0 {}
}

/// Turns nodes round so that results add them: where neighbouring results read alike, compilers compute them side by side.
/// A node turns alone, or together with one that it is made of; never at a cost.
pub(super) fn align_signs(graph: &mut Graph) {
    let is_negative = |term: &Term| term.coefficient.is_negative();
    if !graph.outputs.iter().any(|(_, terms)| terms.iter().any(|term| is_negative(term) && term.factors.len() == 1)) {
        return;
    }
    let users = users(graph);
    let minus = -Rational::ONE;
    for index in 0..graph.outputs.len() {
        let subtracted = |term: &Term| match term.factors[..] {
            [node] if term.coefficient.is_negative() && !users[node].is_empty() => Some(node),
            _ => None,
        };
        let Some(node) = graph.outputs[index].1.iter().find_map(subtracted) else { continue };
        let Node::Sum(terms) = &graph.nodes[node].node else { continue };
        let mut parts: Vec<NodeId> = terms.iter().flat_map(|term| term.factors.iter().copied()).collect();
        parts.retain(|part| !users[*part].is_empty() && matches!(graph.nodes[*part].node, Node::Sum(_)));
        let before = whole_cost(graph);
        rescale(graph, node, &users[node], minus, minus);
        let alone = whole_cost(graph) <= before;
        let turned = alone
            || parts.into_iter().any(|part| {
                rescale(graph, part, &users[part], minus, minus);
                let kept = whole_cost(graph) <= before;
                if !kept {
                    rescale(graph, part, &users[part], minus, minus);
                }
                kept
            });
        if !turned {
            rescale(graph, node, &users[node], minus, minus);
        }
    }
}

/// Multiplications by constants and leading sign changes in all sums; nodes that nobody uses stay as they are.
fn whole_cost(graph: &Graph) -> usize {
    let nodes = (0..graph.nodes.len()).map(Place::Node);
    nodes.chain((0..graph.outputs.len()).map(Place::Output)).map(|place| sum_cost(graph.terms(place))).sum()
}

fn try_node(graph: &mut Graph, id: NodeId, users: &[Place]) -> bool {
    let Node::Sum(terms) = &graph.nodes[id].node else { return false };
    if users.is_empty() {
        return false;
    }
    let mut scales = vec![-Rational::ONE];
    let uses = users.iter().flat_map(|place| graph.terms(*place)).filter(|term| term.factors.contains(&id));
    for magnitude in terms.iter().chain(uses).map(|term| term.coefficient.abs()) {
        scales.extend([magnitude, magnitude.recip().unwrap_or(Rational::ONE)]);
    }
    scales.sort_unstable();
    scales.dedup();
    let before = local_cost(graph, id, users);
    for scale in scales.into_iter().filter(|scale| *scale != Rational::ONE) {
        let Some(inverse) = scale.recip() else { continue };
        rescale(graph, id, users, scale, inverse);
        if local_cost(graph, id, users) < before {
            return true;
        }
        rescale(graph, id, users, inverse, scale);
    }
    false
}

/// The sums and quotients that use each node; none for a node that is not used, or by something that takes no factor.
fn users(graph: &Graph) -> Vec<Vec<Place>> {
    let uses = graph.uses();
    let mut users: Vec<Option<Vec<Place>>> = vec![Some(vec![]); graph.nodes.len()];
    for (user, work) in graph.nodes.iter().enumerate().filter(|(user, _)| uses[*user] > 0) {
        let mut used = operands(&work.node);
        used.sort_unstable();
        used.dedup();
        for id in used {
            let takes_factor = match &work.node {
                Node::Sum(_) => true,
                Node::Quotient(numerator, denominator) => numerator.factors.is_empty() && *denominator == id,
                _ => false,
            };
            users[id] = users[id].take().filter(|_| takes_factor);
            if let Some(users) = &mut users[id] {
                users.push(Place::Node(user));
            }
        }
    }
    for index in 0..graph.outputs.len() {
        let place = Place::Output(index);
        for id in graph.terms(place).iter().flat_map(|term| &term.factors) {
            if let Some(users) = users[*id].as_mut().filter(|users| !users.contains(&place)) {
                users.push(place);
            }
        }
    }
    users.into_iter().map(Option::unwrap_or_default).collect()
}

fn rescale(graph: &mut Graph, id: NodeId, users: &[Place], scale: Rational, inverse: Rational) {
    graph.edit(Place::Node(id), |terms| terms.iter_mut().for_each(|term| term.coefficient = term.coefficient * scale));
    graph.nodes[id].fingerprint = graph.nodes[id].fingerprint.times(crate::field::Fingerprint::constant(scale));
    for place in users {
        if let Place::Node(user) = place
            && let Node::Quotient(numerator, _) = &mut graph.nodes[*user].node
        {
            numerator.coefficient = numerator.coefficient * scale;
            continue;
        }
        let divide = |term: &mut Term| {
            for _ in term.factors.iter().filter(|factor| **factor == id) {
                term.coefficient = term.coefficient * inverse;
            }
        };
        graph.edit(*place, |terms| terms.iter_mut().for_each(divide));
    }
}

/// Multiplications by constants and leading sign changes in a node and its users.
fn local_cost(graph: &Graph, id: NodeId, users: &[Place]) -> usize {
    let all = std::iter::once(Place::Node(id)).chain(users.iter().copied());
    all.map(|place| sum_cost(graph.terms(place))).sum()
}

fn sum_cost(terms: &[Term]) -> usize {
    let scaled =
        terms.iter().filter(|term| term.coefficient.abs() != Rational::ONE && !term.factors.is_empty()).count();
    let negative = terms.iter().all(|term| term.coefficient.is_negative());
    // A minus in a constant factor costs nothing.
    scaled + usize::from(negative && terms.first().is_some_and(|term| term.coefficient == -Rational::ONE))
}

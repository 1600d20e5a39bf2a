//! Two-term and two-factor extraction: `a b c + a b d` becomes `t (c + d)` with `t = a b`, over all sums at once.
//!
//! Greedy, as in logic synthesis (Brayton and McMullen 1982, kernels of two cubes): of all pairs of factors that stand in
//! a term, and all pairs of terms of a sum divided by what they share, the one that saves most is made a node wherever
//! it occurs; again, until nothing saves anything. Equal minors, common factors and shared sums are found alike. The
//! difference of two squares has no common factor and is left as it is.

use super::{Graph, Place};
use crate::program::{Node, NodeId, Term};
use crate::scalar::Rational;
use std::collections::BTreeMap;

/// Programs with more terms are left alone: every round looks at all pairs within every sum.
const MOST_TERMS: usize = 640;

/// What may become a node.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Divisor {
    /// The product of two nodes.
    Factors(NodeId, NodeId),
    /// `r + ratio s`, for two products without common factor.
    Terms(Vec<NodeId>, Vec<NodeId>, Rational),
}

/// Where a divisor stands: the sum, and one or two of its terms.
struct Occurrence {
    place: Place,
    terms: Vec<usize>,
    /// What is left of the terms: `replaced * divisor`.
    replaced: Term,
    gain: usize,
}

/// Multiplications in a product.
fn multiplications(coefficient: Rational, factors: usize) -> usize {
    (factors + usize::from(coefficient.abs() != Rational::ONE)).saturating_sub(1)
}

fn cost(term: &Term) -> usize {
    multiplications(term.coefficient, term.factors.len())
}

impl Divisor {
    fn cost(&self) -> usize {
        match self {
            Self::Factors(..) => 1,
            Self::Terms(r, s, ratio) => multiplications(Rational::ONE, r.len()) + multiplications(*ratio, s.len()) + 1,
        }
    }

    fn into_terms(self) -> Vec<Term> {
        match self {
            Self::Factors(a, b) => vec![Term { coefficient: Rational::ONE, factors: vec![a, b] }],
            Self::Terms(r, s, ratio) => {
                vec![Term { coefficient: Rational::ONE, factors: r }, Term { coefficient: ratio, factors: s }]
            }
        }
    }
}

/// Extracts until nothing is gained.
pub(super) fn extract(graph: &mut Graph) {
    while let Some((divisor, occurrences)) = best(graph) {
        let hint = match &divisor {
            Divisor::Factors(..) => "product",
            Divisor::Terms(..) => "shared",
        };
        let node = graph.push(Node::Sum(divisor.into_terms()), hint);
        let mut removed: BTreeMap<Place, Vec<usize>> = BTreeMap::new();
        for Occurrence { place, terms, mut replaced, .. } in occurrences {
            replaced.factors.push(node);
            replaced.factors.sort_unstable();
            graph.edit(place, |terms| terms.push(replaced));
            removed.entry(place).or_default().extend(terms);
        }
        for (place, mut indices) in removed {
            indices.sort_unstable();
            graph.edit(place, |terms| {
                indices.into_iter().rev().for_each(|index| {
                    terms.remove(index);
                });
            });
        }
    }
}

/// The divisor that saves most, with occurrences that share no term.
fn best(graph: &Graph) -> Option<(Divisor, Vec<Occurrence>)> {
    let places = graph.live_sums();
    if places.iter().map(|place| graph.terms(*place).len()).sum::<usize>() > MOST_TERMS {
        return None;
    }
    let mut found: BTreeMap<Divisor, Vec<Occurrence>> = BTreeMap::new();
    for place in places {
        let terms = graph.terms(place);
        for (index, term) in terms.iter().enumerate() {
            pairs_of_factors(place, index, term, terms.len() == 1, &mut found);
            for (other, second) in terms.iter().enumerate().skip(index + 1) {
                pair_of_terms(place, [(index, term), (other, second)], &mut found);
            }
        }
    }
    let candidates = found.into_iter().filter_map(|(divisor, occurrences)| {
        let disjoint = without_overlap(occurrences);
        let gain = disjoint.iter().map(|o| o.gain).sum::<usize>();
        (gain > divisor.cost()).then(|| (gain - divisor.cost(), divisor, disjoint))
    });
    // Of equal gains the first divisor, so that the result does not depend on a hash.
    let best = candidates.reduce(|best, other| if other.0 > best.0 { other } else { best });
    best.map(|(_, divisor, occurrences)| (divisor, occurrences))
}

fn pairs_of_factors(
    place: Place,
    index: usize,
    term: &Term,
    alone: bool,
    found: &mut BTreeMap<Divisor, Vec<Occurrence>>,
) {
    for (i, a) in term.factors.iter().enumerate() {
        for (j, b) in term.factors.iter().enumerate().skip(i + 1) {
            let divisor = Divisor::Factors(*a, *b);
            let rest = term.factors.iter().enumerate().filter(|(k, _)| *k != i && *k != j).map(|(_, f)| *f);
            let replaced = Term { coefficient: term.coefficient, factors: rest.collect() };
            // A node that is this product alone is the divisor already, and names it for the others.
            let gain = usize::from(!(alone && replaced.factors.is_empty() && matches!(place, Place::Node(_))));
            let known = found.entry(divisor).or_default();
            if known.last().is_none_or(|o| (o.place, &o.terms[..]) != (place, &[index][..])) {
                known.push(Occurrence { place, terms: vec![index], replaced, gain });
            }
        }
    }
}

fn pair_of_terms(
    place: Place,
    [(i, first), (j, second)]: [(usize, &Term); 2],
    found: &mut BTreeMap<Divisor, Vec<Occurrence>>,
) {
    let (mut shared, mut r, mut s) = (Vec::new(), Vec::new(), second.factors.clone());
    for factor in &first.factors {
        match s.iter().position(|other| other == factor) {
            Some(index) => shared.push(s.remove(index)),
            None => r.push(*factor),
        }
    }
    let (mut c, mut d) = (first.coefficient, second.coefficient);
    if s < r {
        (r, s, c, d) = (s, r, d, c);
    }
    let Some(inverse) = c.recip() else { return };
    let divisor = Divisor::Terms(r, s, d * inverse);
    let replaced = Term { coefficient: c, factors: shared };
    let with_divisor = multiplications(replaced.coefficient, replaced.factors.len() + 1);
    // A shared sum without factor is no gain by itself, and a whole node is the divisor already.
    let before = cost(first) + cost(second) + 1;
    if before > with_divisor {
        let gain = before - with_divisor;
        found.entry(divisor).or_default().push(Occurrence { place, terms: vec![i, j], replaced, gain });
    }
}

fn without_overlap(occurrences: Vec<Occurrence>) -> Vec<Occurrence> {
    let mut kept: Vec<Occurrence> = Vec::new();
    for occurrence in occurrences {
        let overlaps =
            |o: &Occurrence| o.place == occurrence.place && o.terms.iter().any(|t| occurrence.terms.contains(t));
        if !kept.iter().any(overlaps) {
            kept.push(occurrence);
        }
    }
    kept
}

impl Graph {
    /// The nodes and outputs that are sums and are needed.
    fn live_sums(&self) -> Vec<Place> {
        let uses = self.uses();
        let is_sum = |id: &usize| uses[*id] > 0 && matches!(self.nodes[*id].node, Node::Sum(_));
        let nodes = (0..self.nodes.len()).filter(is_sum).map(Place::Node);
        nodes.chain((0..self.outputs.len()).map(Place::Output)).collect()
    }
}

//! `c x² + c y² ± 2 c x y` becomes `c (x ± y)²`: fewer operations, and the difference is taken before the squares.

use super::Graph;
use crate::program::{Node, NodeId, Term};
use crate::scalar::Rational;

/// Rewrites every sum. Outputs are single terms at this stage.
pub(super) fn complete_squares(graph: &mut Graph) {
    for id in 0..graph.nodes.len() {
        if let Node::Sum(mut terms) = graph.nodes[id].node.clone() {
            let hint = graph.nodes[id].hint.clone();
            while let Some((square, used)) = find_square(graph, &terms, &hint, id) {
                terms =
                    terms.into_iter().enumerate().filter(|(i, _)| !used.contains(i)).map(|(_, term)| term).collect();
                terms.push(square);
            }
            graph.nodes[id].node = Node::Sum(terms);
        }
    }
}

/// The first complete square: its term, with the new node `x ± y`, and the three terms that it stands for.
fn find_square(graph: &mut Graph, terms: &[Term], hint: &str, id: NodeId) -> Option<(Term, [usize; 3])> {
    let square_of =
        |node: NodeId, c: Rational| terms.iter().position(|term| term.coefficient == c && term.factors == [node, node]);
    for (index, term) in terms.iter().enumerate() {
        let [x, y] = term.factors[..] else { continue };
        if x == y {
            continue;
        }
        let half = term.coefficient * Rational::new(1, 2)?;
        for (c, sign) in [(half, Rational::ONE), (-half, -Rational::ONE)] {
            if let (Some(first), Some(second)) = (square_of(x, c), square_of(y, c)) {
                let sum = vec![
                    Term { coefficient: Rational::ONE, factors: vec![x] },
                    Term { coefficient: sign, factors: vec![y] },
                ];
                // A root that is a multiple of a known node is that node: no sum of `p + q` and `p - q` is left.
                let (factor, root) = graph.sum(sum, format!("{hint}_root"), id);
                let square = Term { coefficient: c * factor * factor, factors: vec![root, root] };
                return Some((square, [index, first, second]));
            }
        }
    }
    None
}

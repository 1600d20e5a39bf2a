//! All plans of a lowering, up to a cap: every way at every point.

use ga_gen::alternatives::Plan;
use std::collections::VecDeque;

/// Runs a lowering by every plan, at most `cap` of them: the first ways everywhere, then each change of one point, then of
/// two. The lowering hands back the plan with what it was asked. Returns how many were run.
pub(crate) fn every_plan(cap: usize, mut run: impl FnMut(Plan) -> Plan) -> usize {
    // Each plan with the first point that its successors may change: so none comes twice.
    let mut pending = VecDeque::from([(Plan::default(), 0)]);
    let mut count = 0;
    while let Some((plan, free)) = pending.pop_front().filter(|_| count < cap) {
        let plan = run(plan);
        count += 1;
        for (point, choice) in plan.made().iter().enumerate().skip(free) {
            pending.extend((1..choice.ways.len()).map(|way| (plan.with(point, way), point + 1)));
        }
    }
    count
}

//! Where the particles of chains and nets are at the start.

use super::Roster;
use crate::algebra::g3::Vector;
use crate::scene::description::{Chain, ChainEnd, Net, NetFixed, NetPart};

/// Puts the particles between the two ends at equal distances, and links each to the next.
pub(super) fn chain(roster: &mut Roster, chain: &Chain) {
    let (from, to) = (Vector::from(chain.from_m.get_ref().0), Vector::from(chain.to_m.get_ref().0));
    let count = *chain.particles.get_ref();
    let is_fixed = |end: ChainEnd| chain.fixed.iter().any(|fixed| *fixed.get_ref() == end);
    let (first, last) = (is_fixed(ChainEnd::First), is_fixed(ChainEnd::Last));
    let begin = roster.len();
    for i in 0..count {
        let share = f64::from(i) / f64::from((count - 1).max(1));
        // The end itself, not what rounding makes of it.
        let at = if i + 1 == count { to } else { from + (to - from) * share };
        let fixed = (first && i == 0) || (last && i + 1 == count);
        roster.push(format!("{}.{i}", chain.name.get_ref()), at.into(), *chain.mass_kg.get_ref(), fixed);
    }
    roster.links.extend((begin + 1..roster.len()).map(|index| [index - 1, index]));
}

/// Puts the particles in their columns and rows, and links each to its neighbours.
///
/// Column c and row r are at `corner + c cos(f) C + r cos(g) R + ((c odd) sin(f) |C| + (r odd) sin(g) |R|) n`, with the
/// steps C and R, the folds f and g, and `n = C x R / |C x R|`: all links keep the lengths of their steps.
pub(super) fn net(roster: &mut Roster, net: &Net) {
    let (columns, rows) = (*net.columns.get_ref(), *net.rows.get_ref());
    let corner = Vector::from(net.corner_m.get_ref().0);
    let (column_step, row_step) = steps(net);
    let normal = normal(column_step, row_step).unwrap_or_default();
    let place = |c: u32, r: u32| {
        let (fold, row_fold) = (*net.fold_rad.get_ref(), *net.row_fold_rad.get_ref());
        let out =
            |number: u32, fold: f64, step: Vector<f64>| f64::from(number % 2) * fold.sin() * step.norm_sq().sqrt();
        let out_of_plane = out(c, fold, column_step) + out(r, row_fold, row_step);
        let along = column_step * (f64::from(c) * fold.cos()) + row_step * (f64::from(r) * row_fold.cos());
        // Without a fold the normal may not exist.
        if out_of_plane == 0.0 { corner + along } else { corner + along + normal * out_of_plane }
    };
    let begin = roster.len();
    let name = net.name.get_ref();
    for r in 0..rows {
        for c in 0..columns {
            let fixed = is_fixed(net, c, r);
            roster.push(format!("{name}.{c}.{r}"), place(c, r).into(), *net.mass_kg.get_ref(), fixed);
            let index = roster.len() - 1;
            if c > 0 {
                roster.links.push([index - 1, index]);
            }
            if r > 0 {
                roster.links.push([index - columns as usize, index]);
            }
        }
    }
    debug_assert_eq!(roster.len() - begin, columns as usize * rows as usize);
}

/// The steps from a column and a row to the next.
pub(crate) fn steps(net: &Net) -> (Vector<f64>, Vector<f64>) {
    (net.column_step_m.get_ref().0.into(), net.row_step_m.get_ref().0.into())
}

/// The unit vector to which folds stand out; none if the steps are parallel within rounding.
pub(crate) fn normal(column_step: Vector<f64>, row_step: Vector<f64>) -> Option<Vector<f64>> {
    // `a x b` is the dual of `a ^ b`: the same components in the order e23, e31, e12.
    let area = column_step ^ row_step;
    let across = Vector::new(area.e23, area.e31, area.e12);
    let (size_sq, edges_sq) = (across.norm_sq(), column_step.norm_sq() * row_step.norm_sq());
    (size_sq > PARALLEL_SQ * edges_sq).then(|| across / size_sq.sqrt())
}

/// Sine squared of the angle below which two steps are parallel. Each component of the area is off by at most 3 unit
/// roundoffs of a product of the lengths, so that a normal made of less than a million times that has no six digits.
const PARALLEL_SQ: f64 = 1e-18;

pub(crate) fn is_fixed(net: &Net, c: u32, r: u32) -> bool {
    let (last_column, last_row) = (net.columns.get_ref().saturating_sub(1), net.rows.get_ref().saturating_sub(1));
    net.fixed.iter().any(|fixed| match fixed.get_ref() {
        NetFixed::Cell(cell) => *cell == [c, r],
        NetFixed::Part(NetPart::Corners) => (c == 0 || c == last_column) && (r == 0 || r == last_row),
        NetFixed::Part(NetPart::FirstRow) => r == 0,
        NetFixed::Part(NetPart::LastRow) => r == last_row,
        NetFixed::Part(NetPart::FirstColumn) => c == 0,
        NetFixed::Part(NetPart::LastColumn) => c == last_column,
    })
}

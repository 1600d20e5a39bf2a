//! What to pick: the cheapest setting of each method that ends within an error.

use super::report::{CaseReport, duration};
use super::row::Row;
use crate::study::table::Table;

/// The errors that are asked for, m.
pub const TARGETS_M: [f64; 3] = [1e-3, 1e-6, 1e-9];

/// The cheapest settings of a method, for each error.
type Cells<'a> = [Option<&'a Row>; 3];

impl Row {
    /// Its time, or where nothing was timed its evaluations; infinite if it did not arrive.
    fn cost(&self) -> f64 {
        let cost = self.figures().map(|it| it.time.as_ref().map_or(it.rhs_evals as f64, |time| time.timing.median_ns));
        cost.unwrap_or(f64::INFINITY)
    }

    /// Does its interval reach down to that of the best?
    fn is_as_fast_as(&self, best: &Self) -> bool {
        let ratio = |row: &Self| row.figures().and_then(|figures| figures.time.as_ref()).map(|time| time.ratio);
        match (ratio(self), ratio(best)) {
            (Some(own), Some(best)) => own.low <= best.high,
            _ => std::ptr::eq(self, best),
        }
    }

    /// `210 µs, 312 (rtol 1e-6)`
    fn choice_text(&self) -> String {
        let Some(figures) = self.figures() else {
            return String::new();
        };
        let time = figures.time.as_ref().map_or(String::new(), |time| duration(time.timing.median_ns) + ", ");
        format!("{time}{} ({})", figures.rhs_evals, self.step())
    }
}

fn cheapest<'a>(rows: impl Iterator<Item = &'a Row>) -> Option<&'a Row> {
    rows.min_by(|a, b| a.cost().total_cmp(&b.cost()))
}

impl CaseReport {
    /// The cheapest row of a method that ends within an error.
    #[must_use]
    pub fn cheapest(&self, method: &str, error_m: f64) -> Option<&Row> {
        let within = |row: &&Row| row.figures().is_some_and(|figures| figures.error_m <= error_m);
        cheapest(self.curve_rows().filter(|row| row.label() == method).filter(within))
    }

    fn line(&self, method: String) -> (String, Cells<'_>) {
        let cells = TARGETS_M.map(|target| self.cheapest(&method, target));
        (method, cells)
    }

    /// One line a method, the cheapest for the middle error first; those that do not reach it by the largest.
    pub(super) fn choice(&self, bold: bool) -> Table {
        let mut lines: Vec<(String, Cells<'_>)> = self.methods().into_iter().map(|method| self.line(method)).collect();
        let cost = |cells: &Cells<'_>, index: usize| cells[index].map_or(f64::INFINITY, Row::cost);
        lines.sort_by(|(_, a), (_, b)| {
            cost(a, 1).total_cmp(&cost(b, 1)).then_with(|| cost(a, 0).total_cmp(&cost(b, 0)))
        });
        let best: Cells<'_> = std::array::from_fn(|index| cheapest(lines.iter().filter_map(|(_, cells)| cells[index])));
        let mut rows = vec![vec!["method".to_string()]];
        rows[0].extend(TARGETS_M.map(|target| format!("within {target:.0e} m")));
        for (method, cells) in lines {
            let mut row = vec![method];
            row.extend(cells.iter().zip(best).map(|(cell, best)| match (cell, best) {
                (Some(cell), Some(best)) if bold && cell.is_as_fast_as(best) => format!("**{}**", cell.choice_text()),
                (Some(cell), _) => cell.choice_text(),
                (None, _) => "-".into(),
            }));
            rows.push(row);
        }
        Table(rows)
    }
}

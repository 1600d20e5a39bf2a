//! The figures of the study of solvers as tables, as Markdown and as JSON.

use super::chart::{self, Curve};
use super::row::{Figures, Outcome, Purpose, Row};
use crate::study::table::Table;
use crate::study::{Provenance, StudyError, ratio_text, rounded, write_file};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The figures of one case.
#[derive(Clone, Debug, Serialize)]
pub struct CaseReport {
    /// Its name.
    pub name: &'static str,
    /// What moves.
    pub title: &'static str,
    /// The time at which errors are taken, s.
    pub end_s: f64,
    /// What errors are taken from.
    pub reference: String,
    /// How far that may be off, m.
    pub reference_uncertainty_m: f64,
    /// Samples of each time.
    pub rounds: usize,
    /// Setting by setting.
    pub rows: Vec<Row>,
}

/// The figures of the study.
#[derive(Clone, Debug, Serialize)]
pub struct SolverReport {
    /// Where they come from.
    pub provenance: Provenance,
    /// Case by case.
    pub cases: Vec<CaseReport>,
}

const LEGEND: &str = "\
Error: the largest distance of a particle from the reference at the end, m. Drift: the largest change of the energy over \
the largest kinetic energy; violation: the largest error of a length, m; both at 32 times of the run. Evaluations: of the \
right-hand side, of accelerations (splittings: verlet, yoshida), of predictions (xpbd: one a step). Time: of one run with \
its setup, median; spread is interquartile range over median. Ratio: to rk4 in the middle of its steps, the median of the \
ratios within a round with its 95 % interval, which for fewer than six rounds is their whole range.";

const READING: &str = "\
The tables name the cheapest setting of each method that was measured to end within an error: time, evaluations and the \
setting. Tolerances go by powers of ten and steps by powers of two, so that a finer search would gain up to that. A \
tolerance bounds the error of a step, not that at the end.";

const BOLD: &str = "Bold: the least time of a column, and what its interval does not tell from it.";

/// `12.3 µs`, `4.56 ms`
pub(super) fn duration(ns: f64) -> String {
    match ns {
        ns if ns < 1e6 => format!("{} µs", rounded(ns / 1e3)),
        ns if ns < 1e9 => format!("{} ms", rounded(ns / 1e6)),
        ns => format!("{} s", rounded(ns / 1e9)),
    }
}

impl Row {
    /// The method, and what distinguishes settings of one method.
    pub(super) fn label(&self) -> String {
        match self.setting.constraints {
            Some(constraints) if self.setting.method == "xpbd" => format!("xpbd, {constraints}"),
            _ => self.setting.method.into(),
        }
    }

    /// `rtol 1e-6`, `512 steps`
    pub(super) fn step(&self) -> String {
        match (self.setting.rtol, self.setting.steps) {
            (Some(rtol), _) => format!("rtol {rtol:.0e}"),
            (None, steps) => format!("{} steps", steps.unwrap_or_default()),
        }
    }
}

impl CaseReport {
    pub(super) fn curve_rows(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| row.setting.purpose == Purpose::Curve)
    }

    /// The methods' names in order of appearance.
    pub(super) fn methods(&self) -> Vec<String> {
        let mut labels: Vec<String> = self.curve_rows().map(Row::label).collect();
        labels.dedup();
        labels
    }

    /// All settings.
    fn details(&self, purpose: Purpose) -> Table {
        let heading = [
            "method",
            "setting",
            "constraints",
            "stabilisation",
            "error",
            "drift",
            "violation",
            "evaluations",
            "steps",
            "rejected",
            "time",
            "spread",
            "ratio",
        ];
        let mut rows = vec![heading.map(String::from).to_vec()];
        for row in self.rows.iter().filter(|row| row.setting.purpose == purpose) {
            let setting = &row.setting;
            let mut cells = vec![
                setting.method.to_string(),
                row.step(),
                setting.constraints.unwrap_or("").replace('_', " "),
                setting.stabilisation.unwrap_or("").into(),
            ];
            match &row.outcome {
                Outcome::Done(figures) => cells.extend(figure_cells(figures)),
                Outcome::Failed { reason } => {
                    cells.push(format!("failed: {reason}"));
                    cells.resize(heading.len(), String::new());
                }
            }
            rows.push(cells);
        }
        drop_empty_columns(&mut rows);
        Table(rows)
    }

    fn markdown(&self) -> String {
        let has_holdings = self.rows.iter().any(|row| row.setting.purpose == Purpose::Holding);
        let holdings = if has_holdings {
            let table = self.details(Purpose::Holding).markdown();
            format!("### Ways to hold the constraints, at one step\n\n{table}\n")
        } else {
            String::new()
        };
        format!(
            "## {}\n\n{}. Reference: {}. {} rounds of timing.\n\n{}\n{holdings}<details><summary>All settings</summary>\n\n{}\n</details>\n",
            self.name,
            self.title,
            self.reference,
            self.rounds,
            self.choice(true).markdown(),
            self.details(Purpose::Curve).markdown()
        )
    }

    /// The curves of its chart.
    fn curves(&self) -> Vec<Curve> {
        let points = |method: &str| {
            let rows = self.curve_rows().filter(|row| row.label() == method);
            rows.filter_map(Row::figures).map(|figures| (figures.rhs_evals as f64, figures.error_m)).collect()
        };
        self.methods().into_iter().map(|method| Curve { points: points(&method), name: method }).collect()
    }
}

fn figure_cells(figures: &Figures) -> Vec<String> {
    let mut cells = vec![
        format!("{:.1e}", figures.error_m),
        format!("{:.1e}", figures.energy_drift_rel),
        figures.violation_m.map_or(String::new(), |violation| format!("{violation:.1e}")),
        figures.rhs_evals.to_string(),
        figures.accepted.to_string(),
        figures.rejected.to_string(),
    ];
    cells.extend(figures.time.as_ref().map_or([String::new(), String::new(), String::new()], |time| {
        [duration(time.timing.median_ns), format!("{:.0} %", 100.0 * time.timing.spread), ratio_text(time.ratio)]
    }));
    cells
}

/// Columns with a heading alone say nothing.
fn drop_empty_columns(rows: &mut [Vec<String>]) {
    let columns = rows.first().map_or(0, Vec::len);
    for column in (0..columns).rev() {
        if rows.iter().skip(1).all(|row| row[column].is_empty()) {
            rows.iter_mut().for_each(|row| drop(row.remove(column)));
        }
    }
}

impl SolverReport {
    /// The figures for a terminal: what to pick.
    #[must_use]
    pub fn text(&self) -> String {
        let cases = self.cases.iter().map(|case| format!("{}\n{}\n", case.title, case.choice(false).text()));
        format!("{}{READING}\n\n{}\n", cases.collect::<String>(), self.provenance.text())
    }

    /// The figures as Markdown.
    #[must_use]
    pub fn markdown(&self) -> String {
        let cases: Vec<String> = self.cases.iter().map(CaseReport::markdown).collect();
        format!(
            "# Solvers: what an error costs\n\n{READING} {BOLD}\n\n![Error against evaluations](solvers.svg)\n\n{}\n{LEGEND}\n\n{}.\n",
            cases.join("\n"),
            self.provenance.text().replace('\n', "; "),
        )
    }

    /// The diagrams of work against precision.
    ///
    /// # Errors
    /// The chart cannot be drawn.
    pub fn chart(&self) -> Result<String, StudyError> {
        let panels: Vec<_> = self.cases.iter().map(|case| (case.name, case.curves())).collect();
        chart::work_precision(&panels)
    }

    /// Writes `solvers.json`, `solvers.md` and `solvers.svg`.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&self, out: &Path) -> Result<Vec<PathBuf>, StudyError> {
        let json = serde_json::to_string_pretty(self)? + "\n";
        Ok(vec![
            write_file(out, "solvers.json", &json)?,
            write_file(out, "solvers.md", &self.markdown())?,
            write_file(out, "solvers.svg", &self.chart()?)?,
        ])
    }
}

//! The figures of the study of formulations as tables, as Markdown and as JSON.

use super::case::{END_S, angle_between, reference};
use super::measure::{TARGETS_RAD, Timed};
use super::plain;
use super::row::{Figures, Row};
use super::sentence;
use super::traits::{Between, Traits, between, traits};
use crate::rigid::Form;
use crate::study::chart::{Bar, Group, ratios};
use crate::study::table::Table;
use crate::study::timing::Ratio;
use crate::study::{Provenance, StudyError, ratio_text, rounded, write_file};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// RK4 of a formulation over RK4 in quaternions.
#[derive(Clone, Debug, Serialize)]
pub struct OverQuaternion {
    /// The formulation.
    pub form: &'static str,
    /// Of the times of steps of 0.01 s.
    pub ratio: Ratio,
}

/// A ratio of times: free flight takes a ten-thousandth.
pub(super) fn ratio_cell(ratio: Ratio) -> String {
    if ratio.value < 0.01 { format!("{:.0e}", ratio.value) } else { rounded(ratio.value) }
}

/// The same with its interval.
fn interval_cell(ratio: Ratio) -> String {
    if ratio.value < 0.01 { ratio_cell(ratio) } else { ratio_text(ratio) }
}

/// The figures of the study.
#[derive(Clone, Debug, Serialize)]
pub struct FormulationReport {
    /// Where they come from.
    pub provenance: Provenance,
    /// The time at which errors are taken, s.
    pub end_s: f64,
    /// Samples of each time; none before times are measured.
    pub rounds: usize,
    /// The steps that are compared step by step.
    pub standard_steps: u32,
    /// A step of the plain RK4, ns.
    pub plain_step_ns: f64,
    /// Where it ends, from the reference, rad.
    pub plain_error_rad: f64,
    /// What to pick.
    pub verdict: String,
    /// Form by form.
    pub over_quaternion: Vec<OverQuaternion>,
    /// Form by form.
    pub traits: Vec<Traits>,
    /// Between two recorded poses.
    pub between: Between,
    /// Setting by setting.
    pub rows: Vec<Row>,
}

const CASE: &str = "\
A free body of moments 1, 2, 3 kg m², spun at 0.01, 1, 0.01 rad/s; 100 s, in which it turns over twice.";

const LEGEND: &str = "\
Error: the angle to the reference at 100 s (Taylor series in 40 decimal digits). Drift of energy: relative; of the norm: \
`|R|² - 1`, of a matrix the largest entry of `R^T R - 1`; the largest of 25 times. The length of the angular momentum is \
part of every state, and stays to the bit. Times are of a whole run with its setup, over those of 10,000 steps of RK4 that \
is written for this body alone on nalgebra's quaternion, in the same rounds: the median of the ratios with its 95 % \
interval. Lines: neither blank nor comments; the rotor's state and its conversions are in another file, that of the bodies, \
and the matrix's conversions of vectors are the quaternion's.";

impl FormulationReport {
    pub(super) fn new(provenance: Provenance, rows: Vec<Row>, timed: Timed) -> Result<Self, StudyError> {
        let over = Form::ALL.into_iter().zip(timed.over_quaternion);
        let mut report = Self {
            provenance,
            end_s: END_S,
            rounds: timed.rounds,
            standard_steps: timed.standard_steps,
            plain_step_ns: timed.plain_ns,
            plain_error_rad: angle_between(plain::run(timed.standard_steps), reference()),
            verdict: String::new(),
            over_quaternion: over.map(|(form, ratio)| OverQuaternion { form: form.name(), ratio }).collect(),
            traits: traits()?,
            between: between(),
            rows,
        };
        report.verdict = sentence::verdict(&report);
        Ok(report)
    }

    /// A method with standard steps, or without steps.
    #[must_use]
    pub fn standard(&self, method: &str, form: &str) -> Option<&Row> {
        self.standards().find(|row| row.setting.method == method && row.setting.form == form)
    }

    fn standards(&self) -> impl Iterator<Item = &Row> {
        let is_it = |steps: Option<u32>| steps.is_none_or(|steps| steps == self.standard_steps);
        self.rows.iter().filter(move |row| row.setting.tolerance.is_none() && is_it(row.setting.steps))
    }

    /// The cheapest of the timed rows that end within an error.
    #[must_use]
    pub fn cheapest(&self, error_rad: f64, among: impl Fn(&Row) -> bool) -> Option<&Row> {
        let within = |row: &&Row| row.figures().is_some_and(|figures| figures.error_rad <= error_rad) && among(row);
        let timed = self.rows.iter().filter(within).filter_map(|row| Some((row, row.ratio()?.value)));
        timed.min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(row, _)| row)
    }

    /// What is the formulation's, with RK4.
    fn form_table(&self) -> Table {
        let heading = [
            "form",
            "bytes",
            "lines",
            "of rhs",
            "RK4 step",
            "over quaternion",
            "error, rad",
            "norm",
            "flight off, m",
            "for",
        ];
        let mut rows = vec![heading.map(String::from).to_vec()];
        for (traits, over) in self.traits.iter().zip(&self.over_quaternion) {
            let row = self.standard("rk4", traits.form);
            let figure = |text: &dyn Fn(&Figures) -> String| row.and_then(Row::figures).map_or(String::new(), text);
            rows.push(vec![
                traits.form.into(),
                traits.bytes_per_body.to_string(),
                traits.lines_of_code.to_string(),
                traits.lines_of_rhs.to_string(),
                row.and_then(Row::ratio).map_or(String::new(), interval_cell),
                ratio_text(over.ratio),
                figure(&|it| format!("{:.1e}", it.error_rad)),
                figure(&|it| format!("{:.0e}", it.norm_drift)),
                format!("{:.0e}", traits.flight_error_m),
                traits.buys.into(),
            ]);
        }
        Table(rows)
    }

    /// Steps of 0.01 s.
    fn step_table(&self) -> Table {
        let heading = ["way", "ns a step", "over plain RK4", "error, rad", "energy", "norm", "evaluations"];
        let mut rows = vec![heading.map(String::from).to_vec()];
        for row in self.standards() {
            let Some(figures) = row.figures() else { continue };
            let steps = row.setting.steps.map_or(1.0, f64::from);
            let step_ns = figures.time.as_ref().map_or(String::new(), |time| rounded(time.timing.median_ns / steps));
            rows.push(vec![
                row.setting.way(),
                step_ns,
                row.ratio().map_or(String::new(), interval_cell),
                format!("{:.1e}", figures.error_rad),
                format!("{:.0e}", figures.energy_drift_rel),
                format!("{:.0e}", figures.norm_drift),
                figures.rhs_evals.to_string(),
            ]);
        }
        Table(rows)
    }

    /// The cheapest setting of each way for each error.
    fn cost_table(&self) -> Table {
        let mut ways: Vec<String> = self.rows.iter().map(|row| row.setting.way()).collect();
        ways.dedup();
        let mut rows = vec![vec!["way".to_string()]];
        rows[0].extend(TARGETS_RAD.map(|target| format!("within {target:.0e} rad")));
        for way in ways {
            let cell = |target| match self.cheapest(target, |row| row.setting.way() == way) {
                Some(row) => {
                    let ratio = row.ratio().map_or(String::new(), ratio_cell);
                    format!("{ratio} ({})", row.setting.step())
                }
                None => "-".into(),
            };
            let mut cells = vec![way.clone()];
            cells.extend(TARGETS_RAD.map(cell));
            rows.push(cells);
        }
        Table(rows)
    }

    fn between_text(&self) -> String {
        format!(
            "Half-way between two recorded poses of a body on a hinge at 1 m, 1 rad apart, the hinge's point is {:.0e} m off \
             on the motors' screw, and {:.2} m where position and orientation are interpolated each by itself.",
            self.between.screw_m, self.between.separate_m
        )
    }

    /// The figures for a terminal.
    #[must_use]
    pub fn text(&self) -> String {
        format!(
            "{CASE} Plain RK4: {} ns a step, {:.1e} rad off.\n\n{}\n{}\n{}\n{}\n{}\n\n{}\n",
            rounded(self.plain_step_ns),
            self.plain_error_rad,
            self.form_table().text(),
            self.step_table().text(),
            self.cost_table().text(),
            self.between_text(),
            self.verdict,
            self.provenance.text()
        )
    }

    /// The figures as Markdown.
    #[must_use]
    pub fn markdown(&self) -> String {
        format!(
            "# Formulations of rigid motion\n\n{}\n\n{CASE} Plain RK4: {} ns a step. {} rounds.\n\n\
             ## The formulations\n\n{}\n{}\n\n## A step of 0.01 s\n\n![Time of a step](formulations.svg)\n\n{}\n\
             ## The time for an error\n\nOver the plain RK4's 10,000 steps, which end {} rad off.\n\n{}\n{LEGEND}\n\n{}.\n",
            self.verdict,
            rounded(self.plain_step_ns),
            self.rounds,
            self.form_table().markdown(),
            self.between_text(),
            self.step_table().markdown(),
            format_args!("{:.1e}", self.plain_error_rad),
            self.cost_table().markdown(),
            self.provenance.text().replace('\n', "; "),
        )
    }

    /// Times of a step of 0.01 s, method by method.
    ///
    /// # Errors
    /// The chart cannot be drawn.
    pub fn chart(&self) -> Result<String, StudyError> {
        let forms = Form::ALL.map(Form::name);
        let mut groups: Vec<Group> = Vec::new();
        for row in self.standards().filter(|row| row.setting.steps.is_some()) {
            let (Some(ratio), Some(series)) = (row.ratio(), forms.iter().position(|form| *form == row.setting.form))
            else {
                continue;
            };
            let bar = Bar { series, value: ratio.value, low: ratio.low, high: ratio.high };
            match groups.iter_mut().find(|group| group.name == row.setting.method) {
                Some(group) => group.bars.push(bar),
                None => groups.push(Group { name: row.setting.method.into(), bars: vec![bar] }),
            }
        }
        ratios("Time of a step over a plain RK4 on nalgebra's quaternion", &forms, &groups)
    }

    /// Writes `formulations.json`, `formulations.md` and `formulations.svg`.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&self, out: &Path) -> Result<Vec<PathBuf>, StudyError> {
        let json = serde_json::to_string_pretty(self)? + "\n";
        Ok(vec![
            write_file(out, "formulations.json", &json)?,
            write_file(out, "formulations.md", &self.markdown())?,
            write_file(out, "formulations.svg", &self.chart()?)?,
        ])
    }
}

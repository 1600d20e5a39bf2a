//! The figures of the kernel study as a table, as Markdown, as JSON and as a chart.

use super::{Kernel, Role};
use crate::study::chart::{self, Bar, Group};
use crate::study::table::Table;
use crate::study::timing::{Ratio, Samples, Timing};
use crate::study::{Provenance, StudyError, ratio_text, rounded, write_file};
use serde::Serialize;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// The figures of one way.
#[derive(Clone, Debug, Serialize)]
pub struct WayRow {
    /// Which way.
    pub role: Role,
    /// The time of one call.
    #[serde(flatten)]
    pub timing: Timing,
    /// Time over that of the generated code in f64.
    pub time_ratio: Ratio,
    /// Bytes of the operands and the result of one call.
    pub bytes: usize,
    /// Bytes over those of the generated code in f64.
    pub bytes_ratio: f64,
    /// The largest relative difference of results from those of the generated code in f64.
    pub difference_rel: f64,
}

/// The figures of one kernel.
#[derive(Clone, Debug, Serialize)]
pub struct KernelRow {
    /// What it computes, in words.
    pub name: &'static str,
    /// The same as a formula.
    pub formula: &'static str,
    /// Inputs: calls in one pass.
    pub inputs: usize,
    /// The ways; the generated one first.
    pub ways: Vec<WayRow>,
}

/// The figures of the study.
#[derive(Clone, Debug, Serialize)]
pub struct StudyReport {
    /// Where they come from.
    pub provenance: Provenance,
    /// Repeats: samples of each time.
    pub rounds: usize,
    /// The time of taking one small block from the heap and giving it back: what a dynamic result costs at least.
    pub allocation: Timing,
    /// Kernel by kernel.
    pub kernels: Vec<KernelRow>,
}

impl KernelRow {
    pub(super) fn new(kernel: &Kernel, differences: &[f64], samples: &Samples) -> Self {
        let reference_bytes = kernel.ways.first().map_or(1, |way| way.bytes);
        let ways = kernel.ways.iter().zip(differences).enumerate().map(|(index, (way, difference))| WayRow {
            role: way.role,
            timing: samples.timing(index),
            time_ratio: samples.ratio(index, 0),
            bytes: way.bytes,
            bytes_ratio: way.bytes as f64 / reference_bytes as f64,
            difference_rel: *difference,
        });
        Self { name: kernel.name, formula: kernel.formula, inputs: kernel.calls(), ways: ways.collect() }
    }

    /// One way's figures.
    #[must_use]
    pub fn way(&self, role: Role) -> Option<&WayRow> {
        self.ways.iter().find(|way| way.role == role)
    }
}

const LEGEND: &str = "\
Times are nanoseconds a call: the median, the minimum in brackets; spread is interquartile range over median. Ratios are \
to the generated code in f64, median of the ratios within a round with its 95 % interval. Bytes are those of the operands \
and the result of one call, for the dynamic multivector handle and heap block. Difference: the largest of the results \
from those of the generated code in f64, relative to the largest number of a result. An interval covers the noise of one \
run; another build, which places the code differently, has moved single times by up to a quarter.";

/// What no table says.
const READING: &str = "\
The ratio to the dynamic multivector is smallest where both do the same arithmetic: a product of rotors is 16 products \
on either side, and what is left is one allocation and the finding of blades and signs. It is largest where the \
generated code knows more: the constant and derived coefficients of a point, the grades that cancel in a sandwich, the \
unit norm. The dynamic multivector keeps conformal objects in an orthonormal basis, where a motor has 12 coefficients \
in the place of 8.";

impl StudyReport {
    /// The headline: one line a kernel.
    fn summary(&self) -> Table {
        let heading =
            ["kernel", "dynamic / generated, time", "bytes generated", "dynamic", "ratio", "nalgebra / generated"];
        let mut rows = vec![heading.map(String::from).to_vec()];
        for kernel in &self.kernels {
            let (Some(generated), Some(dynamic)) = (kernel.way(Role::Generated), kernel.way(Role::Dynamic)) else {
                continue;
            };
            let hand = kernel.way(Role::HandWritten);
            rows.push(vec![
                kernel.name.into(),
                ratio_text(dynamic.time_ratio),
                generated.bytes.to_string(),
                dynamic.bytes.to_string(),
                rounded(dynamic.bytes_ratio),
                // nalgebra has no general multivector.
                hand.map_or(String::new(), |hand| ratio_text(hand.time_ratio)),
            ]);
        }
        Table(rows)
    }

    /// All figures: one line a way.
    fn details(&self) -> Table {
        let heading = ["kernel", "way", "ns a call", "spread", "time ratio", "bytes", "difference"];
        let mut rows = vec![heading.map(String::from).to_vec()];
        for kernel in &self.kernels {
            for (index, way) in kernel.ways.iter().enumerate() {
                rows.push(vec![
                    if index == 0 { kernel.name.into() } else { String::new() },
                    way.role.label().into(),
                    format!("{} ({})", rounded(way.timing.median_ns), rounded(way.timing.min_ns)),
                    format!("{:.0} %", 100.0 * way.timing.spread),
                    if index == 0 { "1".into() } else { ratio_text(way.time_ratio) },
                    way.bytes.to_string(),
                    if index == 0 { "0".into() } else { format!("{:.1e}", way.difference_rel) },
                ]);
            }
        }
        Table(rows)
    }

    fn repeats(&self) -> String {
        let inputs = self.kernels.first().map_or(0, |kernel| kernel.inputs);
        format!("{} rounds, all ways once in each, over {inputs} inputs", self.rounds)
    }

    fn allocation_text(&self) -> String {
        let Timing { median_ns, min_ns, .. } = &self.allocation;
        format!(
            "Taking a block from the heap and giving it back: {} ns ({}), once in every dynamic result.",
            rounded(*median_ns),
            rounded(*min_ns)
        )
    }

    /// The figures for a terminal.
    #[must_use]
    pub fn text(&self) -> String {
        format!(
            "{}\n{}\n{}\n{}\n\n{}\n{}\n",
            self.summary().text(),
            self.details().text(),
            self.allocation_text(),
            LEGEND,
            self.provenance.text(),
            self.repeats()
        )
    }

    /// The headline table alone.
    #[must_use]
    pub fn summary_text(&self) -> String {
        self.summary().text()
    }

    /// The figures as Markdown.
    #[must_use]
    pub fn markdown(&self) -> String {
        let formulas = self.kernels.iter().fold(String::new(), |mut text, kernel| {
            let _ = writeln!(text, "* {}: `{}`", kernel.name, kernel.formula);
            text
        });
        format!(
            "# Kernels: generated types against the dynamic multivector\n\n{}\n![Ratios](kernels.svg)\n\n{READING}\n\n{}\n{}\n\n{}\n\n{formulas}\n{}; {}.\n",
            self.summary().markdown(),
            self.details().markdown(),
            self.allocation_text(),
            LEGEND,
            self.provenance.text().replace('\n', "; "),
            self.repeats()
        )
    }

    /// Writes `kernels.json`, `kernels.md` and `kernels.svg`.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&self, out: &Path) -> Result<Vec<PathBuf>, StudyError> {
        let json = serde_json::to_string_pretty(self)? + "\n";
        Ok(vec![
            write_file(out, "kernels.json", &json)?,
            write_file(out, "kernels.md", &self.markdown())?,
            write_file(out, "kernels.svg", &self.chart()?)?,
        ])
    }

    /// The ratios as bars on a logarithmic axis.
    ///
    /// # Errors
    /// The chart cannot be drawn.
    pub fn chart(&self) -> Result<String, StudyError> {
        let series = ["dynamic, time", "dynamic, bytes", "nalgebra, time", "generated f32, time"];
        let groups = self.kernels.iter().map(|kernel| {
            let time = |role| kernel.way(role).map(|way| way.time_ratio);
            let bytes = kernel.way(Role::Dynamic).map(|way| way.bytes_ratio);
            let exact = |value| Ratio { value, low: value, high: value };
            let values = [time(Role::Dynamic), bytes.map(exact), time(Role::HandWritten), time(Role::GeneratedSingle)];
            let bars = values.into_iter().enumerate().filter_map(|(series, ratio)| {
                let ratio = ratio?;
                Some(Bar { series, value: ratio.value, low: ratio.low, high: ratio.high })
            });
            Group { name: kernel.name.into(), bars: bars.collect() }
        });
        let caption = "Ratio to the generated code in f64 (1 = the same, to the right: slower or larger)";
        chart::ratios(caption, &series, &groups.collect::<Vec<_>>())
    }
}

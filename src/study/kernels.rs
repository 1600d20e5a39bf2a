//! Generated types against the dynamic multivector and the traditional formulas, kernel by kernel.
//!
//! A [`Kernel`] holds one computation in several [`Way`]s over the same inputs. Results are compared when a kernel is
//! made, before anything is timed. The criterion bench and `ga-physics study kernels` both run these closures.

mod cases;
mod report;

pub use cases::kernels;
pub use report::{KernelRow, StudyReport, WayRow};

use super::timing::{self, Effort};
use super::{Provenance, StudyError};
use crate::algebra::dynamic::{Dynamic, Metric};
use serde::Serialize;
use std::hint::black_box;
use std::path::Path;
use std::rc::Rc;

/// Agreement to half of the digits: rounding of these well-conditioned inputs takes two or three digits, a wrong sign or
/// factor leaves none. sqrt(2^-52), and sqrt(2^-23) where inputs and results are single.
const LIMIT_DOUBLE: f64 = 1.490_116_119_384_765_6e-8;
/// See [`LIMIT_DOUBLE`].
const LIMIT_SINGLE: f64 = 3.452_669_830_012_439e-4;

/// The way in which a kernel is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Generated code, f64: what the others are compared with.
    Generated,
    /// Generated code, f32.
    GeneratedSingle,
    /// The dynamic multivector, f64.
    Dynamic,
    /// The traditional formula on nalgebra's types, f64.
    HandWritten,
}

impl Role {
    /// The heading of its column.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Generated => "generated f64",
            Self::GeneratedSingle => "generated f32",
            Self::Dynamic => "dynamic f64",
            Self::HandWritten => "nalgebra f64",
        }
    }

    fn limit(self) -> f64 {
        if self == Self::GeneratedSingle { LIMIT_SINGLE } else { LIMIT_DOUBLE }
    }
}

/// One way to compute a kernel, over all inputs.
pub struct Way {
    /// Which way.
    pub role: Role,
    /// Bytes of the operands and the result of one call, blocks on the heap included.
    pub bytes: usize,
    /// The results, in the numbers that all ways are compared in.
    results: Vec<Vec<f64>>,
    pass: Box<dyn Fn()>,
}

impl Way {
    /// One call on each input; each result goes through `black_box`.
    pub fn pass(&self) {
        (self.pass)();
    }

    fn new<I: 'static, R>(
        role: Role,
        inputs: Vec<I>,
        call: impl Fn(&I) -> R + 'static,
        numbers: impl Fn(&R) -> Vec<f64>,
        bytes: usize,
    ) -> Self {
        let results = inputs.iter().map(|input| numbers(&call(input))).collect();
        let pass = move || {
            for input in black_box(inputs.as_slice()) {
                black_box(call(input));
            }
        };
        Self { role, bytes, results, pass: Box::new(pass) }
    }

    fn generated<I: Copy + 'static, R>(
        inputs: &[I],
        call: impl Fn(&I) -> R + 'static,
        numbers: impl Fn(&R) -> Vec<f64>,
    ) -> Self {
        Self::new(Role::Generated, inputs.to_vec(), call, numbers, size_of::<I>() + size_of::<R>())
    }

    fn single<I, J: 'static, R>(
        inputs: &[I],
        convert: impl Fn(&I) -> J,
        call: impl Fn(&J) -> R + 'static,
        numbers: impl Fn(&R) -> Vec<f64>,
    ) -> Self {
        let inputs = inputs.iter().map(convert).collect();
        Self::new(Role::GeneratedSingle, inputs, call, numbers, size_of::<J>() + size_of::<R>())
    }

    fn hand_written<I, J: 'static, R>(
        inputs: &[I],
        convert: impl Fn(&I) -> J,
        call: impl Fn(&J) -> R + 'static,
        numbers: impl Fn(&R) -> Vec<f64>,
    ) -> Self {
        let inputs = inputs.iter().map(convert).collect();
        Self::new(Role::HandWritten, inputs, call, numbers, size_of::<J>() + size_of::<R>())
    }

    fn dynamic<I, M: Metric, R: Footprint, const N: usize>(
        inputs: &[I],
        convert: impl Fn(&I) -> [Dynamic<M, f64>; N],
        call: impl Fn(&[Dynamic<M, f64>; N]) -> R + 'static,
        numbers: impl Fn(&R) -> Vec<f64>,
    ) -> Self {
        let inputs: Vec<_> = inputs.iter().map(convert).collect();
        let bytes = |operands: &[Dynamic<M, f64>; N]| {
            operands.iter().map(Footprint::bytes).sum::<usize>() + call(operands).bytes()
        };
        let bytes = inputs.first().map_or(0, bytes);
        Self::new(Role::Dynamic, inputs, call, numbers, bytes)
    }
}

/// The bytes of a value, with what it owns.
trait Footprint {
    fn bytes(&self) -> usize;
}

impl<M: Metric> Footprint for Dynamic<M, f64> {
    fn bytes(&self) -> usize {
        size_of::<Self>() + self.heap_bytes()
    }
}

impl<M: Metric> Footprint for Option<Dynamic<M, f64>> {
    fn bytes(&self) -> usize {
        self.as_ref().map_or(size_of::<Self>(), Footprint::bytes)
    }
}

/// One computation in several ways.
pub struct Kernel {
    /// What it computes, in words.
    pub name: &'static str,
    /// The same as a formula.
    pub formula: &'static str,
    /// The ways; the generated one first.
    pub ways: Vec<Way>,
}

impl Kernel {
    fn new(name: &'static str, formula: &'static str) -> Self {
        Self { name, formula, ways: vec![] }
    }

    fn with(mut self, way: Way) -> Self {
        self.ways.push(way);
        self
    }

    /// Calls in one pass.
    #[must_use]
    pub fn calls(&self) -> usize {
        cases::INPUTS
    }

    /// The largest difference of a way's results from the generated ones, over the largest number of the result.
    #[must_use]
    pub fn difference(&self, way: &Way) -> f64 {
        let reference = self.ways.first().map(|way| way.results.as_slice()).unwrap_or_default();
        let same_count = reference.len() == way.results.len();
        let differences = reference.iter().zip(&way.results).map(|(expected, actual)| relative(expected, actual));
        if same_count { differences.fold(0.0, worse) } else { f64::INFINITY }
    }

    /// The differences of all ways.
    ///
    /// # Errors
    /// A way differs by more than rounding.
    pub fn check(&self) -> Result<Vec<f64>, StudyError> {
        let checked = self.ways.iter().map(|way| {
            let (difference, limit) = (self.difference(way), way.role.limit());
            if difference <= limit {
                return Ok(difference);
            }
            Err(StudyError::Disagreement { kernel: self.name, column: way.role.label(), difference, limit })
        });
        checked.collect()
    }
}

/// max |a - b| / max |a|; infinite where one is not finite or the lengths differ.
fn relative(expected: &[f64], actual: &[f64]) -> f64 {
    let scale = expected.iter().fold(0.0, |scale, x| worse(scale, x.abs()));
    let difference = expected.iter().zip(actual).fold(0.0, |worst, (a, b)| worse(worst, (a - b).abs()));
    let quotient = difference / scale;
    if quotient.is_finite() && expected.len() == actual.len() { quotient } else { f64::INFINITY }
}

/// The larger number; NaN is larger than all.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// Checks and times all kernels.
///
/// # Errors
/// Two ways disagree.
pub fn measure(effort: Effort, command: &str, progress: &mut dyn FnMut(&str)) -> Result<StudyReport, StudyError> {
    let mut rows = Vec::new();
    for kernel in kernels() {
        progress(kernel.name);
        let differences = kernel.check()?;
        let passes: Vec<_> = kernel.ways.iter().map(|way| || way.pass()).collect();
        let rivals: Vec<&dyn Fn()> = passes.iter().map(|pass| pass as &dyn Fn()).collect();
        let samples = timing::measure(&rivals, kernel.calls(), effort);
        rows.push(KernelRow::new(&kernel, &differences, &samples));
    }
    progress("allocation");
    let allocation = timing::measure(&[&allocate], cases::INPUTS, effort).timing(0);
    Ok(StudyReport { provenance: Provenance::gather(command), rounds: effort.rounds, allocation, kernels: rows })
}

/// As many shared blocks of a rotor's size as a pass makes results, each given back at once.
fn allocate() {
    for _ in 0..cases::INPUTS {
        black_box(Rc::<[f64]>::from(black_box([0.0; 4])));
    }
}

/// Checks and times all kernels, and writes `kernels.json`, `kernels.md` and `kernels.svg` into `out`.
///
/// # Errors
/// Two ways disagree, or a file cannot be written.
pub fn run(quick: bool, out: &Path, progress: &mut dyn FnMut(&str)) -> Result<StudyReport, StudyError> {
    let (effort, option) = if quick { (Effort::QUICK, " --quick") } else { (Effort::FULL, "") };
    let report = measure(effort, &format!("ga-physics study kernels{option}"), progress)?;
    report.write(out)?;
    Ok(report)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_ways_of_all_kernels_agree() {
        for kernel in kernels() {
            let differences = kernel.check().unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(differences.first(), Some(&0.0), "{}: the reference differs from itself", kernel.name);
            assert_eq!(differences.len(), 4, "{}", kernel.name);
            assert!(differences[1] > 0.0, "{}: single precision cannot be exact", kernel.name);
        }
    }

    #[test]
    fn a_wrong_way_is_seen() {
        let right = Way::new(Role::Generated, vec![1.0, 2.0], |x| *x, |x| vec![*x, 3.0], 8);
        let wrong = Way::new(Role::Dynamic, vec![1.0, 2.0], |x| *x, |x| vec![*x, 3.0 + 1e-3 * x], 8);
        let nan = Way::new(Role::Dynamic, vec![1.0, 2.0], |x| *x, |_| vec![f64::NAN, 3.0], 8);
        let short = Way::new(Role::Dynamic, vec![1.0, 2.0], |x| *x, |x| vec![*x], 8);
        let kernel = Kernel::new("test", "x").with(right);
        assert!((kernel.difference(&wrong) - 2e-3 / 3.0).abs() < 1e-12);
        assert_eq!(kernel.difference(&nan), f64::INFINITY);
        assert_eq!(kernel.difference(&short), f64::INFINITY);
        let error = kernel.with(wrong).check().expect_err("a wrong way");
        assert!(matches!(error, StudyError::Disagreement { column: "dynamic f64", .. }), "{error}");
    }
}

//! Generated types against the dynamic multivector and the traditional formulas, kernel by kernel.
//!
//! A [`Kernel`] holds one computation in several [`Way`]s over the same inputs. Results are compared before anything is
//! timed. `ga-physics study kernels` and the benches run the same closures; the benches add rivals ([`Way::rival`]) that
//! are no dependencies of the library.

mod flats;
pub mod inputs;
mod numbers;
mod products;
mod report;
mod rounds;
mod versors;

pub use flats::{line_meets_plane, ray_meets_plane};
pub use products::{
    conformal_on_point, conformal_times_conformal, even_product, even_product_split, general_product,
    general_product_split,
};
pub use report::{KernelRow, StudyReport, WayRow};
pub use rounds::{balls_overlap, circle_of_three_points, sphere_of_four_points};
pub use versors::{
    motor_on_point, motor_times_motor, pose_on_point, pose_times_pose, rotor_on_vector, rotor_times_rotor,
};

use super::timing::{self, Effort};
use super::{Provenance, StudyError};
use crate::algebra::dynamic::{Dynamic, Metric};
use serde::Serialize;
use std::cell::RefCell;
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
    /// Another library or formula, f64, by its name.
    Rival(&'static str),
    /// Another library or formula, f32, by its name.
    RivalSingle(&'static str),
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
            Self::Rival(name) | Self::RivalSingle(name) => name,
        }
    }

    fn limit(self) -> f64 {
        match self {
            Self::GeneratedSingle | Self::RivalSingle(_) => LIMIT_SINGLE,
            _ => LIMIT_DOUBLE,
        }
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
    /// One call on each input: a slice is read, a slice of results is written.
    pub fn pass(&self) {
        (self.pass)();
    }

    /// A rival from outside of the library: another crate, or the formula written out.
    pub fn rival<I: 'static, R: 'static>(
        role: Role,
        inputs: Vec<I>,
        call: impl Fn(&I) -> R + 'static,
        numbers: impl Fn(&R) -> Vec<f64>,
    ) -> Self {
        Self::new(role, inputs, call, numbers, size_of::<I>() + size_of::<R>())
    }

    fn new<I: 'static, R: 'static>(
        role: Role,
        inputs: Vec<I>,
        call: impl Fn(&I) -> R + 'static,
        numbers: impl Fn(&R) -> Vec<f64>,
        bytes: usize,
    ) -> Self {
        let mut values = Vec::new();
        fill(&inputs, &mut values, &call);
        let results = values.iter().map(numbers).collect();
        let values = RefCell::new(values);
        let pass = move || fill(black_box(&inputs), black_box(&mut values.borrow_mut()), &call);
        Self { role, bytes, results, pass: Box::new(pass) }
    }

    fn generated<I: Copy + 'static, R: 'static>(
        inputs: &[I],
        call: impl Fn(&I) -> R + 'static,
        numbers: impl Fn(&R) -> Vec<f64>,
    ) -> Self {
        Self::new(Role::Generated, inputs.to_vec(), call, numbers, size_of::<I>() + size_of::<R>())
    }

    fn single<I, J: 'static, R: 'static>(
        inputs: &[I],
        convert: impl Fn(&I) -> J,
        call: impl Fn(&J) -> R + 'static,
        numbers: impl Fn(&R) -> Vec<f64>,
    ) -> Self {
        let inputs = inputs.iter().map(convert).collect();
        Self::new(Role::GeneratedSingle, inputs, call, numbers, size_of::<J>() + size_of::<R>())
    }

    fn hand_written<I, J: 'static, R: 'static>(
        inputs: &[I],
        convert: impl Fn(&I) -> J,
        call: impl Fn(&J) -> R + 'static,
        numbers: impl Fn(&R) -> Vec<f64>,
    ) -> Self {
        let inputs = inputs.iter().map(convert).collect();
        Self::new(Role::HandWritten, inputs, call, numbers, size_of::<J>() + size_of::<R>())
    }

    fn dynamic<I, M: Metric, R: Footprint + 'static, const N: usize>(
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

/// The loop of every way: a slice in, a slice out. It is a function of its own, and the only one that calls the kernel, so that
/// all ways are compiled under the same conditions and what is counted can be read in the assembly.
#[inline(never)]
fn fill<I, R>(inputs: &[I], results: &mut Vec<R>, call: &impl Fn(&I) -> R) {
    results.clear();
    results.extend(inputs.iter().map(call));
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

impl Footprint for bool {
    fn bytes(&self) -> usize {
        size_of::<Self>()
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

    /// The kernel with one more way.
    #[must_use]
    pub fn with(mut self, way: Way) -> Self {
        self.ways.push(way);
        self
    }

    /// Calls in one pass.
    #[must_use]
    pub fn calls(&self) -> usize {
        inputs::INPUTS
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

/// All kernels, each made when it is called for.
pub const KERNELS: [fn() -> Kernel; 17] = [
    rotor_times_rotor,
    rotor_on_vector,
    motor_on_point,
    motor_times_motor,
    pose_on_point,
    pose_times_pose,
    sphere_of_four_points,
    circle_of_three_points,
    line_meets_plane,
    ray_meets_plane,
    balls_overlap,
    conformal_on_point,
    conformal_times_conformal,
    even_product,
    even_product_split,
    general_product,
    general_product_split,
];

/// All kernels.
#[must_use]
pub fn kernels() -> Vec<Kernel> {
    KERNELS.iter().map(|make| make()).collect()
}

/// Checks and times kernels.
///
/// # Errors
/// Two ways disagree.
pub fn measure(
    kernels: impl IntoIterator<Item = Kernel>,
    effort: Effort,
    command: &str,
    progress: &mut dyn FnMut(&str),
) -> Result<StudyReport, StudyError> {
    let mut rows = Vec::new();
    for kernel in kernels {
        progress(kernel.name);
        let differences = kernel.check()?;
        let passes: Vec<_> = kernel.ways.iter().map(|way| || way.pass()).collect();
        let rivals: Vec<&dyn Fn()> = passes.iter().map(|pass| pass as &dyn Fn()).collect();
        let samples = timing::measure(&rivals, kernel.calls(), effort);
        rows.push(KernelRow::new(&kernel, &differences, &samples));
    }
    progress("allocation");
    let allocation = timing::measure(&[&allocate], inputs::INPUTS, effort).timing(0);
    Ok(StudyReport { provenance: Provenance::gather(command), rounds: effort.rounds, allocation, kernels: rows })
}

/// As many shared blocks of a rotor's size as a pass makes results, each given back at once.
fn allocate() {
    for _ in 0..inputs::INPUTS {
        black_box(Rc::<[f64]>::from(black_box([0.0; 4])));
    }
}

/// Checks and times all kernels, and writes `kernels.json`, `kernels.md` and `kernels.svg` into `out`.
///
/// # Errors
/// Two ways disagree, or a file cannot be written.
pub fn run(quick: bool, out: &Path, progress: &mut dyn FnMut(&str)) -> Result<StudyReport, StudyError> {
    let (effort, option) = if quick { (Effort::QUICK, " --quick") } else { (Effort::FULL, "") };
    let report = measure(kernels(), effort, &format!("ga-physics study kernels{option}"), progress)?;
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
            assert!(differences.len() >= 3, "{}", kernel.name);
            let decides = kernel.name == "balls overlap";
            assert!(decides || differences[1] > 0.0, "{}: single precision cannot be exact", kernel.name);
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

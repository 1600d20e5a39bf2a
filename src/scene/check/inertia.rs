//! Which matrices are the inertia of a body.
//!
//! With the second moments `C = ∫ x xᵀ dm` the inertia is `I = tr(C) 1 - C`, so that
//! `C = tr(I)/2 1 - I`. Positive mass means that C is positive semidefinite; for the principal
//! moments this is the triangle inequality `I1 + I2 >= I3`, with equality for a lamina. I itself
//! must be positive definite, because the motion needs its inverse (a rod without thickness has
//! none).

use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use toml::Spanned;

use crate::scene::diagnostic::Diagnostic;
use crate::scene::values::Inertia;

/// What rounding may do to the eigenvalues of I or C, and to the symmetry of I, relative to tr(I).
///
/// Each number of the file is off by half an ulp, sums of them by as much again, and the symmetric
/// QR iteration is backward stable with an error of a few `n eps |I|`, n = 3: together less than 16
/// eps, doubled for safety. A larger value would let pass what the file really says (0.333333,
/// 0.333333, 0.666667 is not the lamina that was meant); a smaller one would refuse laminae whose
/// sum is off by rounding only, such as 0.1, 0.7, 0.8.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Symmetric QR needs two or three sweeps per eigenvalue; this many only stops a runaway.
const QR_SWEEPS: usize = 100;

/// What is wrong with an inertia, if anything.
pub(super) fn mistake(given: &Spanned<Inertia>) -> Option<Diagnostic> {
    let rows = given.get_ref().rows();
    if let Some(bad) = rows.into_iter().flatten().find(|x| !x.is_finite()) {
        return Some(super::not_finite("inertia_kg_m2", bad).at(given.span()));
    }
    let matrix = Matrix3::from(rows).transpose();
    asymmetry(&matrix).or_else(|| impossible(given.get_ref(), &matrix)).map(|diagnostic| diagnostic.at(given.span()))
}

/// The matrix scaled to a largest entry of 1, so that no sum overflows, and the scale.
fn scaled(matrix: &Matrix3<f64>) -> (Matrix3<f64>, f64) {
    let size = matrix.amax().max(f64::MIN_POSITIVE);
    (matrix / size, size)
}

/// What rounding may have done to a scaled matrix.
fn tolerance(scaled: &Matrix3<f64>) -> f64 {
    ROUNDING * scaled.diagonal().abs().sum()
}

fn asymmetry(matrix: &Matrix3<f64>) -> Option<Diagnostic> {
    let (scaled, _) = scaled(matrix);
    let difference = (scaled - scaled.transpose()).abs();
    let [i, j] = [[0, 1], [0, 2], [1, 2]].into_iter().find(|&[i, j]| difference[(i, j)] > tolerance(&scaled))?;
    let (upper, lower) = (matrix[(i, j)], matrix[(j, i)]);
    let (row, column) = (i + 1, j + 1);
    let message = format!(
        "`inertia_kg_m2` is not symmetric: row {row} column {column} is {upper:?}, \
         row {column} column {row} is {lower:?}"
    );
    Some(Diagnostic::new(message).help("an inertia is symmetric, with off-diagonals -∫xy dm"))
}

fn impossible(given: &Inertia, matrix: &Matrix3<f64>) -> Option<Diagnostic> {
    let (scaled, size) = scaled(matrix);
    let tolerance = tolerance(&scaled);
    // Given moments are judged by their own signs; an eigenvalue may be rounding in place of 0.
    let (mut moments, floor) = match given {
        Inertia::Principal(_) => (scaled.diagonal(), 0.0),
        Inertia::Matrix(_) => (eigenvalues(&scaled), tolerance),
    };
    moments.as_mut_slice().sort_by(f64::total_cmp);
    let [least, middle, most] = moments.into();
    if least.is_nan() || least <= floor {
        let least = least * size;
        let message = format!("an inertia must be positive; a principal moment here is {least:?}");
        let help = "the moments about all three axes must be greater than 0";
        return Some(Diagnostic::new(message).label("not positive").help(help));
    }
    let sum = least + middle;
    if most - sum <= tolerance {
        return None;
    }
    let [least, middle, most, sum] = [least, middle, most, sum].map(|moment| moment * size);
    let message = format!("no body has this inertia: {least:?} + {middle:?} is less than {most:?}");
    let help = format!("the largest moment is at most {sum:?}, which a flat body reaches");
    Some(Diagnostic::new(message).label("breaks the triangle inequality").help(help))
}

/// The eigenvalues of the symmetric part; NaN if the iteration does not end, which it does for
/// finite matrices of order 1.
fn eigenvalues(scaled: &Matrix3<f64>) -> Vector3<f64> {
    let symmetric = (scaled + scaled.transpose()) * 0.5;
    SymmetricEigen::try_new(symmetric, f64::EPSILON, QR_SWEEPS)
        .map_or_else(|| Vector3::repeat(f64::NAN), |eigen| eigen.eigenvalues)
}

//! Principal moments and axes of an inertia matrix: sorted, orthonormal, right-handed.
//!
//! The eigenvectors are nalgebra's (Householder, then implicit QR), which are good to several roundings of the matrix.
//! One more sweep of Jacobi's rotations, on the matrix in their frame with its entries from double-double sums, leaves
//! residuals of the roundings of the axes themselves, also where moments are equal or nearly so and the axes are not
//! determined: any that diagonalise will do there.
//!
//! Source: Golub and Van Loan, *Matrix computations*, 1996, 8.4 (Jacobi's rotation).

use crate::algebra::g3::Vector;
use crate::geometry::double_double::DoubleDouble;
use crate::geometry::mass_properties::MassError;
use nalgebra::{Matrix3, SymmetricEigen};

/// Principal moments of inertia and the axes they belong to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipalAxes {
    /// The moments, in the unit of the matrix, smallest first.
    pub moments: [f64; 3],
    /// Unit vectors along the principal axes, in the order of the moments, right-handed: `axes[0] x axes[1] = axes[2]`.
    pub axes: [Vector<f64>; 3],
}

/// An off-diagonal entry below this share of the largest entry is the rounding of a zero (each entry is known to about
/// an ulp of the largest: 2^-52, two of them here). Kept, it would turn the axes of a cube anywhere.
const OFF_DIAGONAL_ROUNDING: f64 = 2.0 * f64::EPSILON;

/// Principal moments and axes of a symmetric inertia matrix (only its lower half is read).
///
/// Equal moments leave the axes free within their plane; a diagonal matrix keeps its own axes, in the order of the
/// moments.
///
/// # Errors
/// [`MassError::InertiaNotFinite`].
pub fn principal_axes(inertia: [[f64; 3]; 3]) -> Result<PrincipalAxes, MassError> {
    if inertia.iter().flatten().any(|x| !x.is_finite()) {
        return Err(MassError::InertiaNotFinite);
    }
    let largest = inertia.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    let scale = if largest > 0.0 { largest } else { 1.0 };
    let matrix = Matrix3::from_fn(|i, j| {
        let entry = inertia[i.max(j)][i.min(j)] / scale;
        if i != j && entry.abs() <= OFF_DIAGONAL_ROUNDING { 0.0 } else { entry }
    });
    let mut axes = SymmetricEigen::new(matrix).eigenvectors;
    let moments = polished(&matrix, &mut axes);
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| moments[i].total_cmp(&moments[j]));
    let column = |i: usize| axes.column(i).into_owned();
    let (first, second) = (column(order[0]), column(order[1]));
    let axes = [first, second, first.cross(&second)];
    Ok(PrincipalAxes {
        moments: order.map(|i| moments[i] * scale),
        axes: axes.map(|v| Vector { e1: v.x, e2: v.y, e3: v.z }),
    })
}

/// Turns axes that nearly diagonalise a matrix until they do, and gives the moments about them.
fn polished(matrix: &Matrix3<f64>, axes: &mut Matrix3<f64>) -> [f64; 3] {
    let turned = in_frame(matrix, axes);
    let mut m = Matrix3::from_fn(|i, j| turned[i.max(j)][i.min(j)]);
    for (p, q) in [(0, 1), (1, 2), (2, 0)] {
        // The smaller root of t² + 2 theta t - 1 = 0. A zero needs no rotation; next to one theta is infinite, t is 0.
        let theta = (m[(q, q)] - m[(p, p)]) / (2.0 * m[(p, q)]);
        if m[(p, q)] == 0.0 {
            continue;
        }
        let t = libm::copysign(1.0 / (theta.abs() + libm::sqrt(theta * theta + 1.0)), theta);
        let c = 1.0 / libm::sqrt(t * t + 1.0);
        let mut rotation = Matrix3::identity();
        (rotation[(p, p)], rotation[(q, q)], rotation[(p, q)], rotation[(q, p)]) = (c, c, t * c, -t * c);
        m = rotation.transpose() * m * rotation;
        *axes *= rotation;
    }
    // Of a quotient that is stationary at the axes, so that their errors count squared.
    let turned = in_frame(matrix, axes);
    [0, 1, 2].map(|i| turned[i][i] / axes.column(i).norm_squared())
}

/// `axes^T matrix axes`, each entry rounded once; its lower half.
fn in_frame(matrix: &Matrix3<f64>, axes: &Matrix3<f64>) -> [[f64; 3]; 3] {
    let sum = |term: &dyn Fn(usize) -> DoubleDouble| term(0) + term(1) + term(2);
    let images = [0, 1, 2].map(|j| [0, 1, 2].map(|i| sum(&|k| DoubleDouble::product(matrix[(i, k)], axes[(k, j)]))));
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| sum(&|k| images[j][k] * axes[(k, i)]).hi))
}

//! Conversions of inputs to the types of each way, and of results to the numbers that all ways are compared in.

use crate::algebra::cga::{self, Translator};
use crate::algebra::dynamic::{Dynamic, Metric};
use crate::algebra::g3::{Rotor, Vector};
use crate::algebra::{Real, cga::Point};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};

pub(super) type Multi<M> = Dynamic<M, f64>;

// The orthonormal basis of the dynamic multivector: `ninf = e + ebar`, `no = (ebar - e) / 2`.
pub(super) const E1: u32 = 1;
pub(super) const E2: u32 = 1 << 1;
pub(super) const E3: u32 = 1 << 2;
pub(super) const E: u32 = 1 << 3;
pub(super) const EBAR: u32 = 1 << 4;

pub(super) fn coefficients<M: Metric, const N: usize>(x: &Multi<M>, blades: [u32; N]) -> Vec<f64> {
    blades.map(|blade| x.coefficient(blade)).to_vec()
}

/// All 32 coefficients of a conformal multivector.
pub(super) fn all(x: &Multi<cga::Algebra>) -> Vec<f64> {
    (0..32).map(|blade| x.coefficient(blade)).collect()
}

/// `e31 = -e13`.
pub(super) fn rotor_of<M: Metric>(x: &Multi<M>) -> Vec<f64> {
    vec![x.coefficient(0), x.coefficient(E2 | E3), -x.coefficient(E1 | E3), x.coefficient(E1 | E2)]
}

/// A motor holds `ninf` but not `no`: the coefficient of `b e` is that of `b ninf`.
pub(super) fn motor_of(x: &Multi<cga::Algebra>) -> Vec<f64> {
    [rotor_of(x), coefficients(x, [E1 | E, E2 | E, E3 | E, E1 | E2 | E3 | E])].concat()
}

/// `s = w (c + no + (c² - rho²)/2 ninf)`: `no = (ebar - e)/2`, so the weight is the difference of the coefficients of ebar and
/// e, and the coefficient of `ninf` half their sum.
pub(super) fn sphere_of(s: &Multi<cga::Algebra>) -> Vec<f64> {
    let weight = s.coefficient(EBAR) - s.coefficient(E);
    let centre = coefficients(s, [E1, E2, E3]).into_iter().map(|x| x / weight).collect::<Vec<_>>();
    let centre_sq: f64 = centre.iter().map(|x| x * x).sum();
    let rho_sq = centre_sq - (s.coefficient(E) + s.coefficient(EBAR)) / weight;
    [centre, vec![rho_sq]].concat()
}

/// A point of any weight: its Euclidean coefficients over the weight.
pub(super) fn point_of(x: &Multi<cga::Algebra>) -> Vec<f64> {
    let weight = x.coefficient(EBAR) - x.coefficient(E);
    coefficients(x, [E1, E2, E3]).into_iter().map(|x| x / weight).collect()
}

/// A truth value beside a 1, so that a relative difference exists.
pub(super) fn truth(value: bool) -> Vec<f64> {
    vec![1.0, f64::from(value)]
}

pub(super) fn numbers<A: Into<[T; N]>, T: Real, const N: usize>(value: A) -> Vec<f64> {
    value.into().map(Real::to_f64).to_vec()
}

pub(super) fn single(value: f64) -> f32 {
    Real::from_f64(value)
}

pub(super) fn translator(t: Vector) -> Translator {
    Translator::by(t)
}

/// The quaternion `w + xi + yj + zk` is the rotor `w - x e23 - y e31 - z e12`.
pub(super) fn quaternion(r: &Rotor) -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::new(r.s, -r.e23, -r.e31, -r.e12))
}

pub(super) fn vector(x: Vector) -> Vector3<f64> {
    Vector3::new(x.e1, x.e2, x.e3)
}

pub(super) fn position(x: Point) -> Vector3<f64> {
    Vector3::new(x.x, x.y, x.z)
}

pub(super) fn isometry((t, r): &(Vector, Rotor)) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::from(vector(*t)), quaternion(r))
}

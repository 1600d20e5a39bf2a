//! The body: moments 1, 2, 3, spun about its middle axis, which it leaves and turns over; and its attitude at the end.

use crate::algebra::cga::Point;
use crate::algebra::g3::{Bivector, Rotor, Vector};
use crate::rigid::{Bodies, Inertia, Setup};
use crate::study::StudyError;
use nalgebra::{Quaternion, UnitQuaternion};

/// When errors are taken, s: two turns over.
pub const END_S: f64 = 100.0;

/// Steps of 0.01 s: those with which the times of a step are compared.
pub(super) const STANDARD_STEPS: u32 = 10_000;

pub(super) const MOMENTS: [f64; 3] = [1.0, 2.0, 3.0];
pub(super) const OMEGA_BODY: [f64; 3] = [0.01, 1.0, 0.01];

/// The body at time 0, and what it is subject to: nothing.
///
/// # Errors
/// None: the inertia is one.
pub(super) fn body() -> Result<(Setup<f64>, Bodies<f64>), StudyError> {
    let diagonal = std::array::from_fn(|r| std::array::from_fn(|c| if r == c { MOMENTS[r] } else { 0.0 }));
    let inertia = Inertia::new(1.0, diagonal)?;
    let mut bodies = Bodies::default();
    let spin = inertia.momentum_of(Bivector::from(OMEGA_BODY));
    bodies.push(Point::origin(), Rotor::default(), Vector::default(), spin);
    Ok((Setup { inertias: vec![inertia], ..Setup::default() }, bodies))
}

/// The attitude at [`END_S`]: Euler's equations and `qdot = q omega / 2` from the numbers above, 0.01 as it is in binary, by
/// Taylor series of degree 30 with steps of 0.25 s in 40 decimal digits; with degree 34 and steps of 0.5 s it differs by
/// 1e-23.
#[must_use]
#[expect(clippy::excessive_precision, reason = "as it was computed")]
pub fn reference() -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::new(
        -0.01564624151485416038135,
        0.9654395742742694767098,
        -0.00007971609403975472696471,
        -0.2601569088010551290163,
    ))
}

/// How far a rotor is from the reference, rad.
pub(super) fn error_rad(rotor: Rotor<f64>) -> f64 {
    angle_between(rotor.into(), reference())
}

/// The angle of the rotation between two. From the arc tangent, not of the cosine, which is blind below 1e-8.
pub(super) fn angle_between(a: UnitQuaternion<f64>, b: UnitQuaternion<f64>) -> f64 {
    let between = a.inverse() * b;
    2.0 * between.imag().norm().atan2(between.w.abs())
}

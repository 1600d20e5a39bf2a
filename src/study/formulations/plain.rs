//! What one writes for one free body on nalgebra's quaternion, without forces, positions or other bodies: the unit of time.

use super::case::{END_S, MOMENTS, OMEGA_BODY};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// RK4 on `qdot = 1/2 q omega_body`, `omega_body = I^-1 (q* L q)`, then unit norm; the attitude at the end.
pub(super) fn run(steps: u32) -> UnitQuaternion<f64> {
    let inverse = Vector3::from(MOMENTS.map(f64::recip));
    let momentum = Vector3::from(MOMENTS).component_mul(&Vector3::from(OMEGA_BODY));
    let rate = |q: Quaternion<f64>| {
        let omega = UnitQuaternion::new_unchecked(q).inverse_transform_vector(&momentum).component_mul(&inverse);
        q * Quaternion::from_imag(omega) * 0.5
    };
    let h = END_S / f64::from(steps);
    let mut q = UnitQuaternion::identity();
    for _ in 0..steps {
        let start = q.into_inner();
        let k1 = rate(start);
        let k2 = rate(start + k1 * (0.5 * h));
        let k3 = rate(start + k2 * (0.5 * h));
        let k4 = rate(start + k3 * h);
        q = UnitQuaternion::new_normalize(start + (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0));
    }
    q
}

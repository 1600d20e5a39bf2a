//! Attitudes of free bodies by other means than the library's: nalgebra's quaternions, and a splitting or closed forms.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// The free body's Hamiltonian split into rotations about its three axes, each exact (McLachlan 1993, Reich 1994), composed
/// to order 6 (Yoshida 1990, solution A).
pub(crate) fn split(
    moments: [f64; 3],
    omega_body: [f64; 3],
    start: UnitQuaternion<f64>,
    duration: f64,
    steps: u32,
) -> UnitQuaternion<f64> {
    let mut momentum = Vector3::from_fn(|i, _| moments[i] * omega_body[i]);
    let mut attitude = start;
    let turn = |axis: usize, h: f64, momentum: &mut Vector3<f64>, attitude: &mut UnitQuaternion<f64>| {
        let mut rotation = Vector3::zeros();
        rotation[axis] = momentum[axis] / moments[axis] * h;
        let rotation = UnitQuaternion::from_scaled_axis(rotation);
        *attitude *= rotation;
        *momentum = rotation.inverse() * *momentum;
    };
    const OUTER: [f64; 3] = [0.784_513_610_477_560, 0.235_573_213_359_357, -1.177_679_984_178_87];
    let middle = 1.0 - 2.0 * OUTER.iter().sum::<f64>();
    let weights = [OUTER[0], OUTER[1], OUTER[2], middle, OUTER[2], OUTER[1], OUTER[0]];
    let h = duration / f64::from(steps);
    for _ in 0..steps {
        for weight in weights {
            for (axis, share) in [(0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5)] {
                turn(axis, h * weight * share, &mut momentum, &mut attitude);
            }
        }
    }
    attitude
}

/// A body with two equal moments, `(a, a, c)`: it turns about its momentum at `|L| / a` while its axis of symmetry turns in it
/// at `(1 - c/a) omega_3` (Landau, Lifshitz, *Mechanics*, §33).
pub(crate) fn symmetric(a: f64, c: f64, omega_body: [f64; 3], duration: f64) -> UnitQuaternion<f64> {
    let momentum = Vector3::new(a * omega_body[0], a * omega_body[1], c * omega_body[2]);
    let precession = UnitQuaternion::from_scaled_axis(momentum / a * duration);
    let own = UnitQuaternion::from_scaled_axis(Vector3::new(0.0, 0.0, (1.0 - c / a) * omega_body[2] * duration));
    precession * own
}

/// The quaternion `w + x i + y j + z k` is the rotor `w - x e23 - y e31 - z e12`.
pub(crate) fn quaternion(rotor: ga_physics::algebra::g3::Rotor<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(rotor.s, -rotor.e23, -rotor.e31, -rotor.e12))
}

//! ultraviolet 0.10 (f64 and f32), geometric_algebra 0.3 (f32 only) and wedged 0.1.1 (f64).

use ga_physics::algebra::cga::{Motor, Point};
use ga_physics::algebra::g3;
use ga_physics::study::kernels::{Kernel, Role, Way, inputs};
use geometric_algebra::ppga3d;
use geometric_algebra::{GeometricProduct, Transformation};
use ultraviolet::{DIsometry3, DRotor3, DVec3};
use wedged::algebra::{Even3, Vec3};
use wedged::subspace::Rotor3;

const ULTRAVIOLET: Role = Role::Rival("ultraviolet f64");
const GEOMETRIC_ALGEBRA: Role = Role::RivalSingle("geometric_algebra f32");
const WEDGED: Role = Role::Rival("wedged f64");

pub(crate) fn rotor_times_rotor(kernel: Kernel) -> Kernel {
    let inputs = inputs::rotor_pairs();
    let ours = inputs.iter().map(|(a, b)| (rotor(*a), rotor(*b))).collect();
    let single = inputs.iter().map(|(a, b)| (single_rotor(*a), single_rotor(*b))).collect();
    let even = inputs.iter().map(|(a, b)| (even(*a), even(*b))).collect();
    kernel
        .with(Way::rival(ULTRAVIOLET, ours, |(a, b)| *a * *b, |r: &DRotor3| rotor_numbers(*r)))
        .with(Way::rival(
            GEOMETRIC_ALGEBRA,
            single,
            |(a, b)| a.geometric_product(*b),
            |r: &ppga3d::Rotor| [r[0], r[1], r[2], r[3]].map(f64::from).to_vec(),
        ))
        .with(Way::rival(WEDGED, even, |(a, b)| *a * *b, |r: &Even3<f64>| r.as_slice().to_vec()))
}

pub(crate) fn rotor_on_vector(kernel: Kernel) -> Kernel {
    let inputs = inputs::rotors_and_vectors();
    let ours = inputs.iter().map(|(r, x)| (rotor(*r), DVec3::new(x.e1, x.e2, x.e3))).collect();
    let rotors =
        inputs.iter().map(|(r, x)| (Rotor3::from_inner_unchecked(even(*r)), Vec3::new(x.e1, x.e2, x.e3))).collect();
    kernel.with(Way::rival(ULTRAVIOLET, ours, |(r, x)| *r * *x, |x: &DVec3| vec![x.x, x.y, x.z])).with(Way::rival(
        WEDGED,
        rotors,
        |(r, x)| r.rot(*x),
        |x: &Vec3<f64>| x.as_slice().to_vec(),
    ))
}

pub(crate) fn motor_on_point(kernel: Kernel) -> Kernel {
    let inputs = inputs::poses_and_points();
    let ours = inputs.iter().map(|(pose, x)| (isometry(*pose), DVec3::new(x.x, x.y, x.z))).collect();
    let single = inputs.iter().map(|(pose, x)| (single_motor(*pose), single_point(*x))).collect();
    kernel.with(Way::rival(ULTRAVIOLET, ours, |(pose, x)| *pose * *x, |x: &DVec3| vec![x.x, x.y, x.z])).with(
        Way::rival(
            GEOMETRIC_ALGEBRA,
            single,
            |(motor, x)| motor.transformation(*x),
            |x: &ppga3d::Point| [x[1] / x[0], x[2] / x[0], x[3] / x[0]].map(f64::from).to_vec(),
        ),
    )
}

pub(crate) fn motor_times_motor(kernel: Kernel) -> Kernel {
    let ours = inputs::pose_pairs().into_iter().map(|pair| pair.map(isometry)).collect();
    kernel.with(Way::rival(
        ULTRAVIOLET,
        ours,
        |[a, b]: &[DIsometry3; 2]| *a * *b,
        |pose| {
            let t = pose.translation;
            let [s, e23, e31, e12]: [f64; 4] = std::array::from_fn(|i| rotor_numbers(pose.rotation)[i]);
            let motor = Motor::from_parts(g3::Vector::new(t.x, t.y, t.z), g3::Rotor::new(s, e23, e31, e12));
            <[f64; 8]>::from(motor).to_vec()
        },
    ))
}

/// Its arrays are `[x, y, z, w]` of the quaternion, and ours is the rotor `w - x e23 - y e31 - z e12`.
fn rotor(r: g3::Rotor) -> DRotor3 {
    DRotor3::from_quaternion_array([-r.e23, -r.e31, -r.e12, r.s])
}

fn rotor_numbers(r: DRotor3) -> Vec<f64> {
    let [x, y, z, w] = r.into_quaternion_array();
    vec![w, -x, -y, -z]
}

fn isometry((t, r): (g3::Vector, g3::Rotor)) -> DIsometry3 {
    DIsometry3::new(DVec3::new(t.e1, t.e2, t.e3), rotor(r))
}

fn even(r: g3::Rotor) -> Even3<f64> {
    Even3::new(r.s, r.e23, r.e31, r.e12)
}

#[expect(clippy::cast_possible_truncation, reason = "the crate is single precision")]
fn single(x: f64) -> f32 {
    x as f32
}

/// It stores `-e13`, which is `e31`.
fn single_rotor(r: g3::Rotor) -> ppga3d::Rotor {
    ppga3d::Rotor::new(single(r.s), single(r.e23), single(r.e31), single(r.e12))
}

fn single_point(x: Point) -> ppga3d::Point {
    ppga3d::Point::new(1.0, single(x.x), single(x.y), single(x.z))
}

fn single_motor((t, r): (g3::Vector, g3::Rotor)) -> ppga3d::Motor {
    let half = |x: f64| single(-0.5 * x);
    let translator = ppga3d::Translator::new(1.0, half(t.e1), half(t.e2), half(t.e3));
    translator.geometric_product(single_rotor(r))
}

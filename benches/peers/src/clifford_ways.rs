//! clifford 0.3, f64: the Euclidean rotor, the projective motor, the conformal sphere and the general multivector.
//!
//! Left out, because their results are wrong: centre and radius of its conformal circles, and where its conformal lines
//! and planes meet (0 of 2000 random ones right).

use clifford::algebra::Multivector as General;
use clifford::ops::{Transform, Versor};
use clifford::signature::Cl4_1_0;
use clifford::specialized::conformal::dim3::{RoundPoint, Sphere};
use clifford::specialized::euclidean::dim3::{Rotor, Vector};
use clifford::specialized::projective::dim3::{Motor, Point};
use clifford::wrappers::{Unit, Unitized};
use ga_physics::algebra::cga;
use ga_physics::algebra::dynamic::{Dynamic, ToDynamic};
use ga_physics::algebra::g3;
use ga_physics::study::kernels::{Kernel, Role, Way, inputs};

const CLIFFORD: Role = Role::Rival("clifford f64");
/// With its wrapper for unit elements, which drops terms.
const UNIT: Role = Role::Rival("clifford unit f64");

pub(crate) fn rotor_times_rotor(kernel: Kernel) -> Kernel {
    let inputs = inputs::rotor_pairs().into_iter().map(|(a, b)| (rotor(a), rotor(b)));
    let numbers = |r: &Rotor<f64>| vec![r.s(), r.rx(), -r.ry(), r.rz()];
    kernel.with(Way::rival(CLIFFORD, inputs.collect(), |(a, b)| *a * *b, numbers))
}

pub(crate) fn rotor_on_vector(kernel: Kernel) -> Kernel {
    let inputs: Vec<_> =
        inputs::rotors_and_vectors().into_iter().map(|(r, x)| (rotor(r), Vector::new(x.e1, x.e2, x.e3))).collect();
    let units = inputs.iter().map(|(r, x)| (Unit::new_unchecked(*r), *x)).collect();
    let numbers = |x: &Vector<f64>| vec![x.x(), x.y(), x.z()];
    kernel.with(Way::rival(CLIFFORD, inputs, |(r, x)| r.transform(x), numbers)).with(Way::rival(
        UNIT,
        units,
        |(r, x)| r.transform(x),
        numbers,
    ))
}

pub(crate) fn motor_on_point(kernel: Kernel) -> Kernel {
    let inputs: Vec<_> = inputs::poses_and_points()
        .into_iter()
        .map(|(pose, x)| (motor(pose), Point::from_cartesian(x.x, x.y, x.z)))
        .collect();
    let units = inputs.iter().map(|(m, x)| (Unitized::new_unchecked(*m), *x)).collect();
    let numbers = |x: &Point<f64>| vec![x.x() / x.w(), x.y() / x.w(), x.z() / x.w()];
    kernel.with(Way::rival(CLIFFORD, inputs, |(m, x)| m.transform(x), numbers)).with(Way::rival(
        UNIT,
        units,
        |(m, x)| m.transform(x),
        numbers,
    ))
}

pub(crate) fn motor_times_motor(kernel: Kernel) -> Kernel {
    let inputs = inputs::pose_pairs().into_iter().map(|pair| pair.map(motor));
    kernel.with(Way::rival(CLIFFORD, inputs.collect(), |[a, b]: &[Motor<f64>; 2]| a.compose(b), coefficients))
}

/// Centre and radius are its own functions; without a check it would be a little less.
pub(crate) fn sphere_of_four_points(kernel: Kernel) -> Kernel {
    let inputs =
        inputs::tetrahedra().into_iter().map(|points| points.map(|p| RoundPoint::from_euclidean(p.x, p.y, p.z)));
    let sphere = |[a, b, c, d]: &[RoundPoint<f64>; 4]| {
        let sphere = Sphere::from_four_points(a, b, c, d);
        (sphere.center(), sphere.radius())
    };
    kernel.with(Way::rival(CLIFFORD, inputs.collect(), sphere, |(centre, radius)| {
        centre.zip(*radius).map_or(vec![], |((x, y, z), radius)| vec![x, y, z, radius * radius])
    }))
}

/// Its general multivector, whose signs are found at run time.
pub(crate) fn general_product(kernel: Kernel) -> Kernel {
    let general = |m: cga::Multivector| {
        let dynamic: Dynamic<cga::Algebra, f64> = m.to_dynamic();
        let coefficients: Vec<f64> = (0..32).map(|blade| dynamic.coefficient(blade)).collect();
        General::<f64, Cl4_1_0>::from_coeffs(&coefficients)
    };
    let inputs = inputs::multivector_pairs().into_iter().map(|(a, b)| (general(a), general(b)));
    kernel.with(Way::rival(
        CLIFFORD,
        inputs.collect(),
        |(a, b)| a * b,
        |m| (0..32).map(|blade| m.get(clifford::basis::Blade::from_index(blade))).collect(),
    ))
}

/// `e13 = -e31`
fn rotor(r: g3::Rotor) -> Rotor<f64> {
    Rotor::new(r.s, r.e12, -r.e31, r.e23)
}

/// Made of its own translation and rotation, so that its conventions stay its own. The angle is that of the rotor.
fn motor((t, r): (g3::Vector, g3::Rotor)) -> Motor<f64> {
    let sine = (r.e23 * r.e23 + r.e31 * r.e31 + r.e12 * r.e12).sqrt();
    let axis = Vector::new(-r.e23 / sine, -r.e31 / sine, -r.e12 / sine);
    let rotation = Motor::from_axis_angle(&axis, 2.0 * sine.atan2(r.s));
    Motor::from_translation(t.e1, t.e2, t.e3).compose(&rotation)
}

/// Its motors act by the antiproduct: the blades of ours are the complements of its own.
fn coefficients(m: &Motor<f64>) -> Vec<f64> {
    vec![m.ps(), m.tx(), m.ry(), m.rz(), -m.rx(), m.ty(), -m.tz(), -m.s()]
}

//! Rotors and motors: products, and images of vectors and points.

use super::numbers::{
    E1, E2, E3, Multi, coefficients, isometry, motor_of, numbers, position, quaternion, rotor_of, single, translator,
    vector,
};
use super::{Kernel, Way, inputs};
use crate::algebra::Scalar;
use crate::algebra::cga::{self, Motor, Point};
use crate::algebra::dynamic::ToDynamic;
use crate::algebra::g3::{self, Rotor, Vector};
use nalgebra::Point3;

/// The product of two rotors.
#[must_use]
pub fn rotor_times_rotor() -> Kernel {
    fn product<T: Scalar>((a, b): &(Rotor<T>, Rotor<T>)) -> Rotor<T> {
        *a * *b
    }
    let inputs = inputs::rotor_pairs();
    Kernel::new("rotor * rotor", "R S")
        .with(Way::generated(&inputs, product, |r| numbers::<_, _, 4>(*r)))
        .with(Way::single(&inputs, |(a, b)| (a.map(single), b.map(single)), product, |r| numbers::<_, _, 4>(*r)))
        .with(Way::dynamic(
            &inputs,
            |(a, b)| [a.to_dynamic(), b.to_dynamic()],
            |[a, b]: &[Multi<g3::Algebra>; 2]| a * b,
            rotor_of,
        ))
        .with(Way::hand_written(
            &inputs,
            |(a, b)| (quaternion(a), quaternion(b)),
            |(a, b)| a * b,
            |q| vec![q.w, -q.i, -q.j, -q.k],
        ))
}

/// The image of a vector under a unit rotor.
#[must_use]
pub fn rotor_on_vector() -> Kernel {
    fn image<T: Scalar>((rotor, x): &(Rotor<T>, Vector<T>)) -> Vector<T> {
        rotor.apply(*x)
    }
    let inputs = inputs::rotors_and_vectors();
    Kernel::new("rotor on vector", "R x ~R")
        .with(Way::generated(&inputs, image, |x| numbers::<_, _, 3>(*x)))
        .with(Way::single(&inputs, |(a, b)| (a.map(single), b.map(single)), image, |x| numbers::<_, _, 3>(*x)))
        .with(Way::dynamic(
            &inputs,
            |(rotor, x)| [rotor.to_dynamic(), x.to_dynamic()],
            |[rotor, x]: &[Multi<g3::Algebra>; 2]| rotor.apply(x),
            |x| coefficients(x, [E1, E2, E3]),
        ))
        .with(Way::hand_written(
            &inputs,
            |(rotor, x)| (quaternion(rotor), vector(*x)),
            |(rotor, x)| rotor * x,
            |x| x.as_slice().to_vec(),
        ))
}

/// The image of a point under a unit motor.
#[must_use]
pub fn motor_on_point() -> Kernel {
    fn image<T: Scalar>((motor, x): &(Motor<T>, Point<T>)) -> Point<T> {
        motor.apply(*x)
    }
    let inputs = inputs::poses_and_points();
    let motors: Vec<_> = inputs.iter().map(|((t, r), x)| (translator(*t) * *r, *x)).collect();
    Kernel::new("motor on point", "M X ~M")
        .with(Way::generated(&motors, image, |x| numbers::<_, _, 3>(*x)))
        .with(Way::single(&motors, |(a, b)| (a.map(single), b.map(single)), image, |x| numbers::<_, _, 3>(*x)))
        .with(Way::dynamic(
            &motors,
            |(motor, x)| [motor.to_dynamic(), x.to_dynamic()],
            |[motor, x]: &[Multi<cga::Algebra>; 2]| motor.apply(x),
            |x| coefficients(x, [E1, E2, E3]),
        ))
        .with(Way::hand_written(
            &inputs,
            |(pose, x)| (isometry(pose), Point3::from(position(*x))),
            |(pose, x)| pose * x,
            |x| x.coords.as_slice().to_vec(),
        ))
}

/// The product of two unit motors.
#[must_use]
pub fn motor_times_motor() -> Kernel {
    fn product<T: Scalar>([a, b]: &[Motor<T>; 2]) -> Motor<T> {
        *a * *b
    }
    let inputs = inputs::pose_pairs();
    let motors: Vec<_> = inputs.iter().map(|poses| poses.map(|(t, r)| translator(t) * r)).collect();
    Kernel::new("motor * motor", "M N")
        .with(Way::generated(&motors, product, |m| numbers::<_, _, 8>(*m)))
        .with(Way::single(&motors, |pair| pair.map(|m| m.map(single)), product, |m| numbers::<_, _, 8>(*m)))
        .with(Way::dynamic(
            &motors,
            |pair| pair.map(|m| m.to_dynamic()),
            |[a, b]: &[Multi<cga::Algebra>; 2]| a * b,
            motor_of,
        ))
        .with(Way::hand_written(
            &inputs,
            |[a, b]| (isometry(a), isometry(b)),
            |(a, b)| a * b,
            |pose| {
                let (t, q) = (pose.translation.vector, pose.rotation);
                numbers::<_, _, 8>(translator(Vector::new(t.x, t.y, t.z)) * Rotor::new(q.w, -q.i, -q.j, -q.k))
            },
        ))
}

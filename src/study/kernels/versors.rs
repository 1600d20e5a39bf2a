//! Rotors and motors: products, and images of vectors and points.

use super::numbers::{
    E1, E2, E3, Multi, coefficients, isometry, motor_of, numbers, position, quaternion, rotor_of, single, translator,
    vector,
};
use super::{Kernel, Way, inputs};
use crate::algebra::cga::{self, Motor, Point, Pose};
use crate::algebra::dynamic::ToDynamic;
use crate::algebra::g3::{self, Rotor, Vector};
use crate::algebra::{Real, Scalar};
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

/// The image of a point under a unit motor of eight numbers.
#[must_use]
pub fn motor_on_point() -> Kernel {
    fn image<T: Scalar>((motor, x): &(Motor<T>, Point<T>)) -> Point<T> {
        motor.apply(*x)
    }
    let inputs: Vec<_> = inputs::poses_and_points().into_iter().map(|(pose, x)| (motor(pose), x)).collect();
    let kernel = Kernel::new("motor on point", "M X ~M")
        .with(Way::generated(&inputs, image, |x| numbers::<_, _, 3>(*x)))
        .with(Way::single(&inputs, |(a, b)| (a.map(single), b.map(single)), image, |x| numbers::<_, _, 3>(*x)));
    point_rivals(kernel)
}

/// The image of a point under a pose: a motor factored into translation and rotation, seven numbers.
#[must_use]
pub fn pose_on_point() -> Kernel {
    fn image<T: Scalar>((pose, x): &(Pose<T>, Point<T>)) -> Point<T> {
        pose.apply(*x)
    }
    let inputs: Vec<_> = inputs::poses_and_points().into_iter().map(|(parts, x)| (pose(parts), x)).collect();
    let kernel = Kernel::new("pose on point", "T R X ~R ~T")
        .with(Way::generated(&inputs, image, |x| numbers::<_, _, 3>(*x)))
        .with(Way::single(&inputs, |(a, b)| (a.map(single), b.map(single)), image, |x| numbers::<_, _, 3>(*x)));
    point_rivals(kernel)
}

fn point_rivals(kernel: Kernel) -> Kernel {
    let inputs = inputs::poses_and_points();
    kernel
        .with(Way::dynamic(
            &inputs,
            |(pose, x)| [motor(*pose).to_dynamic(), x.to_dynamic()],
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

/// The product of two unit motors of eight numbers.
#[must_use]
pub fn motor_times_motor() -> Kernel {
    fn product<T: Scalar>([a, b]: &[Motor<T>; 2]) -> Motor<T> {
        *a * *b
    }
    let inputs: Vec<_> = inputs::pose_pairs().into_iter().map(|pair| pair.map(motor)).collect();
    let kernel = Kernel::new("motor * motor", "M N")
        .with(Way::generated(&inputs, product, |m| numbers::<_, _, 8>(*m)))
        .with(Way::single(&inputs, |pair| pair.map(|m| m.map(single)), product, |m| numbers::<_, _, 8>(*m)));
    product_rivals(kernel)
}

/// The product of two poses of seven numbers.
#[must_use]
pub fn pose_times_pose() -> Kernel {
    fn product<T: Scalar>([a, b]: &[Pose<T>; 2]) -> Pose<T> {
        *a * *b
    }
    /// As a motor, which is what the others are compared as.
    fn motor_numbers<T: Real>(pose: &Pose<T>) -> Vec<f64> {
        let [x, y, z, s, e23, e31, e12] = <[T; 7]>::from(*pose).map(Real::to_f64);
        numbers::<_, _, 8>(motor((Vector::new(x, y, z), Rotor::new(s, e23, e31, e12))))
    }
    let inputs: Vec<_> = inputs::pose_pairs().into_iter().map(|pair| pair.map(pose)).collect();
    let kernel = Kernel::new("pose * pose", "T R U S")
        .with(Way::generated(&inputs, product, motor_numbers))
        .with(Way::single(&inputs, |pair| pair.map(|m| m.map(single)), product, motor_numbers));
    product_rivals(kernel)
}

fn product_rivals(kernel: Kernel) -> Kernel {
    let inputs = inputs::pose_pairs();
    kernel
        .with(Way::dynamic(
            &inputs,
            |pair| pair.map(|pose| motor(pose).to_dynamic()),
            |[a, b]: &[Multi<cga::Algebra>; 2]| a * b,
            motor_of,
        ))
        .with(Way::hand_written(
            &inputs,
            |[a, b]| (isometry(a), isometry(b)),
            |(a, b)| a * b,
            |pose| {
                let (t, q) = (pose.translation.vector, pose.rotation);
                numbers::<_, _, 8>(motor((Vector::new(t.x, t.y, t.z), Rotor::new(q.w, -q.i, -q.j, -q.k))))
            },
        ))
}

fn motor((t, r): (Vector, Rotor)) -> Motor {
    translator(t) * r
}

fn pose((t, r): (Vector, Rotor)) -> Pose {
    Pose::new(t.e1, t.e2, t.e3, r.s, r.e23, r.e31, r.e12)
}

//! The generated code that every scalar runs, from the library's algebras and from one declared here, outside of it.

use ga_physics::algebra::Scalar;
use ga_physics::algebra::cga::{Circle, Dilator, Line, Motor, Plane, Point, Pose, Sphere, Twist};
use ga_physics::algebra::g3::{self, Rotor, Vector};
use ga_physics::geometry::formulas;

/// The projective plane.
mod own {
    ga_physics::algebra! {
        pub algebra scalars_plane;
        basis e0 = 0, e1 = 1, e2 = 1;
        /// A line.
        type Line = [e1, e2, e0];
        /// A point.
        type Point = [e12, e20, e01];
        /// A motion.
        type Motor: unit + versor = [s, e12, e20, e01];
        /// A sum of a number and a point.
        type Even = [s, e12, e20, e01];
    }
}

/// Results by the name of their kernel.
pub(crate) type Results<T> = Vec<(&'static str, Vec<T>)>;

/// Kernels are called with this many numbers.
pub(crate) const INPUTS: usize = 15;

macro_rules! numbers {
    ($value:expr) => {
        Vec::from(<[T; _]>::from($value))
    };
}

/// Sums and products only: defined for all numbers. Versors are filled with any numbers, since the programs are
/// polynomials whether or not the versor is unit.
pub(crate) fn polynomials<T: Scalar>(x: &[T; INPUTS]) -> Results<T> {
    let at = |offset: usize| move |i: usize| x[(i + offset) % INPUTS];
    let (rotor, vector) = (Rotor::from_fn(at(0)), Vector::from_fn(at(4)));
    let (motor, sphere) = (Motor::from_fn(at(0)), Sphere::from_fn(at(8)));
    let [a, b, c, d] = [0, 3, 6, 9].map(|offset| Point::from_fn(at(offset)));
    vec![
        ("rotor.apply(vector)", numbers!(rotor.apply(vector))),
        ("vector * vector", numbers!(vector * Vector::from_fn(at(7)))),
        ("motor.apply(point)", numbers!(motor.apply(a))),
        ("pose.apply(point)", numbers!(Pose::from_fn(at(0)).apply(a))),
        ("motor * motor", numbers!(motor * Motor::from_fn(at(8)))),
        ("motor.apply(line)", numbers!(motor.apply(Line::from_fn(at(5))))),
        ("twist * motor", numbers!(Twist::from_fn(at(9)) * motor)),
        ("point | sphere", vec![a | sphere]),
        ("a ^ b ^ c ^ d", numbers!(a ^ b ^ c ^ d)),
        ("dual(circle)", numbers!(Circle::from_fn(at(2)).dual())),
        ("circumsphere_relative", numbers!(formulas::circumsphere_relative(a, b, c, d))),
        ("sum", numbers!(Line::from_fn(at(1)) + Line::from_fn(at(4)) * x[0])),
        ("multivector", numbers!(g3::Multivector::from_fn(at(0)) * g3::Multivector::from_fn(at(7)))),
        ("own motor.apply(line)", numbers!(own::Motor::from_fn(at(3)).apply(own::Line::from_fn(at(6))))),
    ]
}

/// Kernels with one division.
pub(crate) fn quotients<T: Scalar>(x: &[T; INPUTS]) -> Results<T> {
    let at = |offset: usize| move |i: usize| x[(i + offset) % INPUTS];
    let [a, b, c, d] = [0, 3, 6, 9].map(|offset| Point::from_fn(at(offset)));
    vec![
        ("circumsphere", numbers!(formulas::circumsphere(a, b, c, d))),
        ("reflect_in_sphere", numbers!(formulas::reflect_in_sphere(a, Sphere::from_fn(at(5))))),
        ("reflect_in_plane", numbers!(formulas::reflect_in_plane(a, Plane::from_fn(at(4))))),
        ("dilator.apply(point)", numbers!(Dilator::from_fn(at(3)).apply(a))),
        ("vector / number", numbers!(Vector::from_fn(at(2)) / x[0])),
    ]
}

/// Kernels with a root: lengths, for which no sum cancels.
pub(crate) fn roots<T: Scalar>(x: &[T; INPUTS]) -> Results<T> {
    let at = |offset: usize| move |i: usize| x[(i + offset) % INPUTS];
    vec![
        ("vector length", vec![Vector::from_fn(at(0)).norm_sq().sqrt()]),
        ("bivector length", vec![g3::Bivector::from_fn(at(3)).norm_sq().sqrt()]),
        ("rotor length", vec![Rotor::from_fn(at(6)).norm_sq().sqrt()]),
        ("root of a number", vec![(x[0] * x[0]).sqrt()]),
    ]
}

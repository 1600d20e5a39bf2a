//! The conventions, one by one, with numbers for which each sign could be wrong.

use super::{Random, Tested, add, components, cross, dot, length, point, position, scale, sub, vector};
use ga_physics::algebra::Real;
use ga_physics::algebra::cga::{self, Dilator, Even, Infinity, Motor, Point, Sphere, Translator};
use ga_physics::algebra::g3::{self, Bivector, Rotor, Vector};
use ga_physics::geometry::{inside_is_negative, line_through, plane_through, planes_meet};
use nalgebra::{Quaternion, Unit, UnitQuaternion, Vector3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Rounding of the few operations in each of these formulas, at coordinates of order 1.
const CLOSE: f64 = 1e-14;

fn near(a: [f64; 3], b: [f64; 3]) -> bool {
    length(sub(a, b)) < CLOSE
}

#[test]
fn points_have_minus_half_the_squared_distance_as_inner_product() {
    let (x, y) = (Point::new(1.0, 2.0, -3.0), Point::new(4.0, -2.0, 9.0));
    assert_eq!(x | y, -(9.0 + 16.0 + 144.0) / 2.0);
    assert_eq!(x.distance_sq_to(y), 169.0);
    assert_eq!(x | Infinity, -1.0);
    assert_eq!(Point::<f64>::origin() | Infinity, -1.0);
    assert_eq!(x | x, 0.0);
}

#[test]
fn the_dual_squares_to_minus_one_in_both_algebras() {
    // dual(1) = I, and I = -e123_no_ninf.
    let i = cga::Pseudoscalar::new(-1.0);
    assert_eq!(i * i, -1.0);
    let i3 = g3::Trivector::new(1.0);
    assert_eq!(i3 * i3, -1.0);
    let v = Vector::new(2.0, 3.0, 5.0);
    assert_eq!(<[f64; 3]>::from(v.dual()), [2.0, 3.0, 5.0], "the bivector v I3, in the order e23, e31, e12");
    assert_eq!(v.dual().dual(), -v);
    let m = cga::Multivector::from_fn(|blade| blade as f64);
    assert_eq!(m.dual().dual(), -m);
    assert_eq!(m.dual().undual(), m);
    assert_eq!(m.dual(), m * cga::Multivector::from(i), "I commutes with everything");
    assert_eq!(m.dual(), cga::Multivector::from(i) * m);
}

#[test]
fn spheres_are_positive_inside_and_the_reports_are_negative() {
    let sphere = Sphere::around(Point::new(1.0, 2.0, 3.0), 5.0);
    let inside = Point::new(1.0, 2.0, 5.0);
    assert_eq!(inside | sphere, (25.0 - 4.0) / 2.0);
    assert_eq!(Point::new(1.0, 2.0, 10.0) | sphere, (25.0 - 49.0) / 2.0);
    assert_eq!(sphere | Infinity, -1.0);
    let reports = inside_is_negative(sphere);
    assert_eq!(inside | reports, -(25.0 - 4.0) / 2.0);
    assert_eq!(Infinity | reports, 1.0);
    assert_eq!(sphere | sphere, 25.0, "s² = rho²");
}

#[test]
fn planes_are_positive_on_the_side_of_the_right_hand_normal() {
    let plane = plane_through(Point::new(0.0, 0.0, 2.0), Point::new(1.0, 0.0, 2.0), Point::new(0.0, 1.0, 2.0)).unwrap();
    assert_eq!(<[f64; 4]>::from(plane), [0.0, 0.0, 1.0, 2.0], "nu + delta ninf");
    assert_eq!(Point::new(7.0, 8.0, 5.0) | plane, 3.0);
    assert_eq!(plane.signed_distance(Point::new(7.0, 8.0, -5.0)), -7.0);
    let turned = plane_through(Point::new(0.0, 0.0, 2.0), Point::new(0.0, 1.0, 2.0), Point::new(1.0, 0.0, 2.0));
    assert_eq!(components(turned.unwrap().normal()), [0.0, 0.0, -1.0]);
    let mut random = Random(1);
    for _ in 0..100 {
        let [a, b, c] = [random.vector(), random.vector(), random.vector()];
        let normal = cross(sub(b, a), sub(c, a));
        let expected = scale(normal, 1.0 / length(normal));
        let found = plane_through(point::<f64>(a), point(b), point(c)).unwrap();
        // The sine of the corner at a amplifies rounding; corners below 0.01 are left out.
        if length(normal) > 0.01 * length(sub(b, a)) * length(sub(c, a)) {
            assert!(length(sub(components(found.normal()), expected)) < 100.0 * CLOSE, "{a:?} {b:?} {c:?}");
        }
    }
}

#[test]
fn rotors_turn_by_the_whole_angle_in_the_sense_of_their_plane() {
    let quarter = Rotor::exp(Bivector::new(0.0, 0.0, -FRAC_PI_2 / 2.0));
    assert!(near(components(quarter.apply(Vector::new(1.0, 0.0, 0.0))), [0.0, 1.0, 0.0]), "e1 to e2 in e12");
    let quarter = Rotor::exp(Bivector::new(-FRAC_PI_2 / 2.0, 0.0, 0.0));
    assert!(near(components(quarter.apply(Vector::new(0.0, 1.0, 0.0))), [0.0, 0.0, 1.0]), "e2 to e3 in e23");
    let quarter = Rotor::exp(Bivector::new(0.0, -FRAC_PI_2 / 2.0, 0.0));
    assert!(near(components(quarter.apply(Vector::new(0.0, 0.0, 1.0))), [1.0, 0.0, 0.0]), "e3 to e1 in e31");
    assert_eq!(Bivector::new(0.0, 0.0, 1.0) * Bivector::new(0.0, 0.0, 1.0), g3::Even::new(-1.0, 0.0, 0.0, 0.0));
}

#[test]
fn rotors_are_quaternions_with_the_bivector_part_negated() {
    let mut random = Random(2);
    for _ in 0..200 {
        let (axis, angle, v) = (random.direction(), TAU * random.signed(), random.vector());
        let theirs = UnitQuaternion::from_axis_angle(&Unit::new_normalize(Vector3::from(axis)), angle);
        let ours = Rotor::from_axis_angle(vector(scale(axis, 3.0)), angle).unwrap();
        let [w, x, y, z] = [theirs.w, theirs.i, theirs.j, theirs.k];
        let numbers = <[f64; 4]>::from(ours);
        for (found, expected) in numbers.iter().zip([w, -x, -y, -z]) {
            assert!((found - expected).abs() < CLOSE, "{numbers:?} {theirs:?}");
        }
        let image = theirs * Vector3::from(v);
        assert!(near(components(ours.apply(vector(v))), image.into()));
        // Products correspond in the same order.
        let second = Rotor::from_axis_angle(vector(v), 1.0).unwrap();
        let unit = Unit::new_normalize(Vector3::from(v));
        let both = UnitQuaternion::from_axis_angle(&unit, 1.0) * theirs;
        let product = <[f64; 4]>::from(second * ours);
        let expected: &Quaternion<f64> = both.quaternion();
        for (found, expected) in product.iter().zip([expected.w, -expected.i, -expected.j, -expected.k]) {
            assert!((found - expected).abs() < CLOSE);
        }
    }
}

#[test]
fn translators_move_and_motors_turn_first() {
    let t = Vector::new(1.0, -2.0, 4.0);
    let x = Point::new(10.0, 20.0, 30.0);
    assert_eq!(position(Translator::by(t).apply(x)), [11.0, 18.0, 34.0]);
    assert_eq!(Translator::by(t).displacement(), t);
    assert_eq!(Even::from(Translator::by(t)).e1_ninf, -0.5, "T = 1 - t ninf / 2");
    let quarter = Rotor::from_axis_angle(Vector::new(0.0, 0.0, 1.0), FRAC_PI_2).unwrap();
    let motor = Motor::from_parts(t, quarter);
    assert!(near(position(motor.apply(Point::new(1.0, 0.0, 0.0))), [1.0, -1.0, 4.0]), "T R: the rotation first");
    assert!(near(components(motor.translation()), [1.0, -2.0, 4.0]));
    assert!(near(position(motor.rev().apply(motor.apply(x))), position(x)));
    let other = quarter * Translator::by(t);
    assert!(near(position(other.apply(Point::new(1.0, 0.0, 0.0))), [2.0, 2.0, 4.0]), "R T: the translation first");
}

#[test]
fn motors_carry_planes_spheres_and_lines_with_their_points() {
    let mut random = Random(3);
    for _ in 0..100 {
        let rotor = Rotor::from_axis_angle(vector(random.direction()), 3.0 * random.signed()).unwrap();
        let motor = Motor::from_parts(vector(random.vector()), rotor);
        let [a, b, c, x] = [(); 4].map(|()| point::<f64>(random.vector()));
        let Ok(plane) = plane_through(a, b, c) else { continue };
        let moved = motor.apply(plane);
        assert!(((motor.apply(x) | moved) - (x | plane)).abs() < CLOSE);
        let sphere = Sphere::around(a, 2.0);
        assert!(((motor.apply(x) | motor.apply(sphere)) - (x | sphere)).abs() < CLOSE);
        let line = line_through(a, b).unwrap();
        let expected = line_through(motor.apply(a), motor.apply(b)).unwrap();
        let found = <[f64; 6]>::from(motor.apply(line));
        assert!(found.iter().zip(<[f64; 6]>::from(expected)).all(|(f, e)| (f - e).abs() < CLOSE));
    }
}

#[test]
fn dilators_scale_by_exp_of_minus_alpha() {
    // exp(alpha/2 e ebar) = cosh(alpha/2) + sinh(alpha/2) e ebar, and e ebar = -no_ninf.
    let alpha: f64 = 0.7;
    let dilator = Dilator::new((-alpha / 2.0).exp(), (alpha / 2.0).exp());
    let wedge = Even::from(dilator);
    let expected = [(alpha / 2.0).cosh(), -(alpha / 2.0).sinh()];
    assert!((wedge.s - expected[0]).abs() < CLOSE && (wedge.no_ninf - expected[1]).abs() < CLOSE);
    let x = Point::new(1.0, 2.0, -3.0);
    assert!(near(position(dilator.apply(x)), scale([1.0, 2.0, -3.0], (-alpha).exp())));
    let made = Dilator::by((-alpha).exp()).unwrap();
    assert!((made.p - dilator.p).abs() < CLOSE && (made.q - dilator.q).abs() < CLOSE);
    assert!((made.factor() - (-alpha).exp()).abs() < CLOSE);
    for factor in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(Dilator::by(factor), None, "{factor}");
    }
    let sphere = Dilator::by(3.0).unwrap().apply(Sphere::around(x, 2.0));
    assert!((sphere.rho_sq - 36.0).abs() < 36.0 * CLOSE && near(position(sphere.centre()), [3.0, 6.0, -9.0]));
}

#[test]
fn lines_hold_minus_their_direction_and_their_moment() {
    let (a, b) = ([1.0, 2.0, 3.0], [4.0, 6.0, 15.0]);
    let line = line_through(point::<f64>(a), point(b)).unwrap();
    assert_eq!([line.e1_no_ninf, line.e2_no_ninf, line.e3_no_ninf], [-3.0, -4.0, -12.0], "ei no ninf = -(no ei ninf)");
    assert_eq!([line.e23_ninf, line.e31_ninf, line.e12_ninf], cross(a, b));
    assert_eq!(line, point::<f64>(a) ^ point(b) ^ Infinity, "small integers: the blade itself is exact");
    assert_eq!(line.norm_sq(), -169.0, "<L ~L> = -L²");
}

#[test]
fn planes_meet_along_the_cross_product_of_their_normals() {
    let floor = plane_through(Point::new(0.0, 0.0, 2.0), Point::new(1.0, 0.0, 2.0), Point::new(0.0, 1.0, 2.0)).unwrap();
    let wall = plane_through(Point::new(3.0, 0.0, 0.0), Point::new(3.0, 1.0, 0.0), Point::new(3.0, 0.0, 1.0)).unwrap();
    // Normals e3 and e1: the line x = 3, z = 2 along e3 x e1 = e2.
    let expected = line_through(Point::new(3.0, 0.0, 2.0), Point::new(3.0, 1.0, 2.0)).unwrap();
    assert_eq!(planes_meet(floor, wall).unwrap(), expected);
    assert_eq!(planes_meet(wall, floor).unwrap(), -expected);
}

#[test]
fn omega_is_the_dual_of_the_axial_vector() {
    // v = x . Omega is omega x x with Omega = omega I3.
    let mut random = Random(4);
    for _ in 0..100 {
        let (omega, x) = (random.vector(), random.vector());
        let velocity = vector::<f64>(x) | vector(omega).dual();
        assert!(near(components(velocity), cross(omega, x)));
        let momentum = vector::<f64>(x) ^ velocity;
        let expected = add(scale(omega, dot(x, x)), scale(x, -dot(x, omega)));
        assert!(near(<[f64; 3]>::from(momentum), expected), "x ^ (x . Omega) is x x (omega x x)");
    }
}

/// `|exp(b e23) - (cos b + sin b e23)|`, relative in the bivector part, on a logarithmic grid.
fn worst_exp<T: Tested>() -> f64 {
    let mut worst = 0.0_f64;
    for step in -180..=0 {
        let b = T::from_f64(10f64.powf(f64::from(step) / 10.0));
        let x = b.to_f64();
        // Six terms: the seventh is below 2e-10 x^12, and x is at most 1; so compare with libm's sine from 0.1 on.
        let square = x * x;
        let series = 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0)));
        let expected = if x < 0.1 { series * x } else { x.sin() };
        let [s, e23, e31, e12] = <[T; 4]>::from(Rotor::exp(Bivector::new(b, T::zero(), T::zero()))).map(Real::to_f64);
        assert_eq!((e31, e12), (0.0, 0.0));
        worst = worst.max((e23 / expected - 1.0).abs()).max((s - x.cos()).abs());
    }
    worst / T::EPSILON.to_f64()
}

#[test]
fn exp_loses_nothing_at_any_small_angle() {
    let (double, single) = (worst_exp::<f64>(), worst_exp::<f32>());
    println!("exp: {double:.2} epsilons of f64, {single:.2} of f32");
    assert!(double <= 2.0 && single <= 2.0, "norm, sine, quotient and product: {double:.2}, {single:.2} epsilons");
}

#[test]
fn axes_of_any_length_but_zero_turn_the_same() {
    let expected = Rotor::from_axis_angle(Vector::new(1.0, 2.0, -3.0), 0.5).unwrap();
    for exponent in [-307, -200, -161, -1, 100, 200, 307] {
        let length = 10f64.powi(exponent);
        let found = Rotor::from_axis_angle(Vector::new(length, 2.0 * length, -3.0 * length), 0.5).unwrap();
        let apart = <[f64; 4]>::from(found).iter().zip(<[f64; 4]>::from(expected)).all(|(f, e)| (f - e).abs() < 1e-15);
        assert!(apart, "1e{exponent}: {found:?}");
    }
    for bad in [[0.0; 3], [f64::NAN, 0.0, 1.0], [0.0, f64::INFINITY, 1.0], [0.0, 1.0, f64::NAN]] {
        assert!(Rotor::from_axis_angle(vector(bad), 0.5).is_err(), "{bad:?}");
    }
    assert!(Rotor::from_axis_angle(vector([0.0, 1.0, 0.0]), f64::NAN).is_err());
    for scale in [0.0, 1e-160, 1e200, f64::NAN] {
        assert!(Rotor::normalise(g3::Even::new(scale, scale, 0.0, 0.0)).is_err(), "{scale:e}");
    }
    let unit = Rotor::normalise(g3::Even::new(3e-100, 0.0, 4e-100, 0.0)).unwrap();
    assert!((unit.s - 0.6).abs() < 1e-15 && (unit.e31 - 0.8).abs() < 1e-15);
}

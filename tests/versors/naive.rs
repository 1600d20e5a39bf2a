//! That the tests can fail: the textbook forms are wrong by far more than the bounds, on the same grids.

use crate::grids::{DIRECTIONS, half_angles, times};
use ga_physics::algebra::cga::{ConformalRotor, PointPair, Twist};
use ga_physics::algebra::g3::{Bivector, Rotor};
use std::f64::consts::FRAC_PI_2;

/// The angle from the scalar part alone, the plane from the bivector.
fn log_by_arc_cosine(r: Rotor<f64>) -> Bivector<f64> {
    let b = Bivector::new(r.e23, r.e31, r.e12);
    b * (r.s.acos() / b.norm_sq().sqrt())
}

#[test]
fn a_logarithm_by_the_arc_cosine_is_bad() {
    let mut worst = [0.0f64; 2];
    let mut not_a_number = 0;
    for p in half_angles(FRAC_PI_2 - 1e-3).into_iter().filter(|p| *p > 1e-300) {
        let b = Bivector::from(times(DIRECTIONS[3], p));
        let rotor = Rotor::exp(b);
        for (worst, log) in worst.iter_mut().zip([log_by_arc_cosine(rotor), rotor.log()]) {
            let error = (log - b).norm_sq().sqrt() / p;
            not_a_number += usize::from(error.is_nan());
            *worst = worst.max(error);
        }
    }
    assert!(worst[0] > 0.9 && worst[1] < 1e-15, "below 1e-8 the cosine is 1: {worst:?}");
    assert!(not_a_number > 100, "0/0 where the square underflows: {not_a_number}");
}

/// `(cos p - sin p / p) / p²`, the third function of the exponential of a motor, without its series.
fn third_function(p: f64) -> f64 {
    (p.cos() - p.sin() / p) / (p * p)
}

#[test]
fn the_third_function_of_motors_without_its_series_is_bad() {
    let exact = |p: f64| -1.0 / 3.0 + p * p / 30.0;
    let error = |p: f64| (third_function(p) / exact(p) - 1.0).abs();
    assert!(error(1e-2) > 1e-13 && error(1e-4) > 1e-10 && error(1e-7) > 1e-4);
    assert!(third_function(0.0).is_nan() && third_function(1e-170).is_nan());
    // What is used in its place has nothing to lose at these angles.
    for p in [0.0f64, 1e-170, 1e-7, 1e-4] {
        let twist = Twist::new(p, 0.0, 0.0, 1.0, 0.0, 0.0);
        let motor = ga_physics::algebra::cga::Motor::exp(twist);
        assert_eq!((motor.e1_ninf - 1.0 + p * p / 2.0).abs().max(2e-16), 2e-16);
        assert_eq!(motor.e123_ninf, p.sin());
    }
}

/// The two commuting planes of a bivector by the explicit split: with `B F / 2 = l_1 b_2 + l_2 b_1`,
/// `b_1 = (l_1 B - B F / 2) / (l_1 - l_2)`.
#[expect(clippy::eq_op, reason = "the outer square of a bivector is not zero, as that of a vector is")]
fn split_planes(b: PointPair<f64>) -> [PointPair<f64>; 2] {
    let (s, four) = (-b.norm_sq(), b ^ b);
    let distance = (s * s - four.norm_sq()).sqrt();
    let (l_1, l_2) = ((s + distance) / 2.0, (s - distance) / 2.0);
    let half = (b | four) / 2.0;
    [(b * l_1 - half) / (l_1 - l_2), (half - b * l_2) / (l_1 - l_2)]
}

#[test]
fn a_split_into_commuting_planes_is_bad() {
    let two = |a: f64, b: f64| PointPair { e12: a, e3_no: -b, e3_ninf: b / 2.0, ..PointPair::default() };
    // Right where the planes differ.
    let [first, second] = split_planes(two(0.3, 0.8));
    assert!((first.e12 - 0.3).abs() < 1e-15 && (second.e3_ninf - 0.4).abs() < 1e-15);
    // Equal angles, and a translation: 0/0.
    assert!(split_planes(two(0.5, 0.5))[0].e12.is_nan());
    assert!(split_planes(PointPair { e1_ninf: 1.0, ..PointPair::default() })[0].e1_ninf.is_nan());
    // Nearly equal ones, seen from a frame in which rounding shows: no digit is left.
    let mover =
        ConformalRotor::exp(PointPair { e1_no: 0.3, e2_ninf: 0.7, e23: 0.2, no_ninf: 0.1, ..PointPair::default() });
    let near = mover.unwrap().apply(two(0.5, 0.5 * (1.0 + 1e-15)));
    let [first, _] = split_planes(near);
    let square = -first.norm_sq();
    assert!(!((square + 0.25).abs() < 1e-3), "the square of a plane that turns by 0.5 is -0.25, found {square}");
    // The same bivector through the library.
    let log = ConformalRotor::exp(near).unwrap().log().unwrap();
    let error = <[f64; 10]>::from(log - near).into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    assert!(error < 4e-15, "{error:e}");
}

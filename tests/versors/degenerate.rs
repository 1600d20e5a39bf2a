//! Nothing that is finite gives a number that is none: zero, the ends of the range, opposite versors, broken ones.

use crate::grids::{DIRECTIONS, Random, half_angles, times};
use ga_physics::algebra::Real;
use ga_physics::algebra::cga::{ConformalRotor, Dilator, Motor, Point, PointPair, Twist};
use ga_physics::algebra::g3::{Bivector, Rotor, Vector};
use ga_physics::versor::{NotAConformalRotor, NotAMotor};

#[test]
fn zero_is_the_identity_and_back() {
    assert_eq!(Rotor::exp(Bivector::<f64>::default()), Rotor::default());
    assert_eq!(Rotor::<f64>::default().log(), Bivector::default());
    assert_eq!((-Rotor::<f64>::default()).log(), Bivector::new(-0.0, -0.0, -0.0));
    assert_eq!(Motor::exp(Twist::<f64>::default()), Motor::default());
    assert_eq!(Motor::<f64>::default().log(), Twist::default());
    assert_eq!(ConformalRotor::exp(PointPair::<f64>::default()).unwrap(), ConformalRotor::default());
    assert_eq!(ConformalRotor::<f64>::default().log().unwrap(), PointPair::default());
    assert_eq!((Dilator::exp(0.0), Dilator::<f64>::default().log()), (Dilator::default(), 0.0));
}

#[test]
fn tiny_numbers_pass_unchanged() {
    for x in [5e-324, 1e-310, 1e-300, 1e-200, 1e-160, 1e-30] {
        let b = Bivector::new(x, -x, 2.0 * x);
        assert_eq!(Rotor::exp(b), Rotor::new(1.0, x, -x, 2.0 * x));
        assert_eq!(Rotor::exp(b).log(), b);
        for w in [0.0, 1e-300, 1.0, 1e300] {
            let motor = Motor::exp(Twist::new(x, 0.0, 0.0, w, 0.0, w));
            assert_eq!((motor.s, motor.e23, motor.e1_ninf, motor.e3_ninf), (1.0, x, w, w));
            assert_eq!(motor.log(), Twist::new(x, 0.0, 0.0, w, 0.0, w));
            // Turn times slide, however small the one and large the other.
            assert!((motor.e123_ninf - x * w).abs() <= 4e-16 * (x * w), "{motor:?}");
        }
        let pair = PointPair::from_fn(|index| if index % 2 == 0 { x } else { -x });
        let log = ConformalRotor::exp(pair).unwrap().log().unwrap();
        // A dilation so small cannot be seen in p and q, which are 1.
        assert_eq!(log, PointPair { no_ninf: 0.0, ..pair });
    }
}

/// A versor that is random, or one that is nearly -1 or nearly a half turn, with a translation of any length.
#[test]
fn every_motor_comes_back() {
    let mut random = Random(11);
    let mut worst = 0.0f64;
    for case in 0..4000 {
        let length = 10.0f64.powi(case % 600 - 300);
        let near = 10.0f64.powi(-(case % 17));
        let b = times::<f64>(DIRECTIONS[(case % 6) as usize], random.signed() * near);
        let centre = [Rotor::default(), -Rotor::default(), Rotor::new(0.0, 0.6, 0.0, 0.8)][(case % 3) as usize];
        let rotor = centre * Rotor::exp(Bivector::from(b));
        let motor = Motor::from_parts(Vector::from_fn(|_| random.signed() * length), rotor);
        let sign = if motor.s < 0.0 { -1.0 } else { 1.0 };
        let again = <[f64; 8]>::from(Motor::exp(motor.log())).map(|x| x * sign);
        for (index, (x, y)) in <[f64; 8]>::from(motor).into_iter().zip(again).enumerate() {
            let error = (x - y).abs() / if index < 4 { 1.0 } else { length };
            assert!(error < 4e-15, "{error:e} {motor:?} {again:?}");
            worst = worst.max(error);
        }
    }
    println!("worst round trip of motors near 1, -1 and a half turn: {worst:e}");
}

#[test]
fn large_angles_stay_on_the_manifold() {
    for angle in [7.0, 1e3, 1e10, 1e154, 1e200, 1e300, 1.7e308] {
        let rotor = Rotor::exp(Bivector::new(angle, 0.0, 0.0));
        assert!((rotor.norm_sq() - 1.0).abs() < 1e-15, "{angle:e} {rotor:?}");
        let motor = Motor::exp(Twist::new(0.0, angle / 2.0, angle / 2.0, 1.0, 2.0, 3.0));
        assert!(motor.is_unit(4e-15), "{angle:e} {motor:?}");
    }
    let versor = ConformalRotor::exp(PointPair { e23: 1e100, e1_no: 1e90, ..PointPair::default() }).unwrap();
    assert!((versor.norm_sq() - 1.0).abs() < 1e-14, "{versor:?}");
    let too_large = PointPair { e23: 1e200, ..PointPair::default() };
    assert_eq!(ConformalRotor::exp(too_large), Err(NotAConformalRotor::OutOfRange));
}

#[test]
fn dilations_reach_the_ends_of_the_range() {
    for x in [1e-300, 1e-12, 0.3, 40.0, 300.0, 354.0] {
        for sign in [1.0, -1.0] {
            let (b, expected) = (x * sign, Dilator::exp(x * sign));
            let versor = ConformalRotor::exp(PointPair { no_ninf: b, ..PointPair::default() }).unwrap();
            // exp(x) errs by the rounding of x, x eps / 2, and by an ulp or two of the library.
            assert!((versor.p / expected.p - 1.0).abs() < 2e-15, "{b} {versor:?}");
            assert!((versor.q / expected.q - 1.0).abs() < 2e-15, "{b} {versor:?}");
            assert!((versor.log().unwrap().no_ninf - b).abs() <= 4e-16 * x.max(1.0), "{b}");
            assert!((expected.log() - b).abs() <= 4e-16 * x.max(1.0), "{b}");
        }
    }
    assert!(
        (Dilator::exp(700.0f64).log() - 700.0).abs() < 2e-13 && (Dilator::exp(-700.0f64).log() + 700.0).abs() < 2e-13
    );
    let beyond = PointPair { no_ninf: 711.0, ..PointPair::default() };
    assert_eq!(ConformalRotor::exp(beyond), Err(NotAConformalRotor::OutOfRange));
    let f32_versor = ConformalRotor::exp(PointPair { no_ninf: 43.0f32, e12: 0.5, ..PointPair::default() }).unwrap();
    assert!((f32_versor.log().unwrap().no_ninf - 43.0).abs() < 1e-5);
    assert_eq!(Dilator::by(4.0).unwrap().powf(0.5), Dilator::exp(2.0f64.ln() / 2.0));
}

#[test]
fn a_dilation_of_space_by_a_power_of_two_changes_no_bit() {
    let mut random = Random(12);
    for exponent in [-1000, -300, -7, 300, 1000] {
        for _ in 0..50 {
            let b = PointPair::from_fn(|_| random.signed() * 2.0);
            // Lengths grow by 2^k: what has ninf grows, what has no shrinks.
            let scaled = |b: PointPair<f64>| {
                let numbers = <[f64; 10]>::from(b);
                let (up, down) = (2.0f64.powi(exponent), 2.0f64.powi(-exponent));
                PointPair::from_fn(|index| numbers[index] * [1.0, down, up, 1.0][[0, 0, 0, 1, 1, 1, 2, 2, 2, 3][index]])
            };
            let (here, there) = (ConformalRotor::exp(b).unwrap(), ConformalRotor::exp(scaled(b)).unwrap());
            assert_eq!((here.p, here.q12, here.p31), (there.p, there.q12, there.p31));
            assert_eq!(scaled(here.log().unwrap()), there.log().unwrap());
        }
    }
}

#[test]
fn a_minus_sign_does_not_move_anything() {
    // -1, -T, -D and a screw after a full turn: the logarithm is that of the same motion.
    let t = Motor::from_parts(Vector::new(3.0, -1.0, 2.0), Rotor::default());
    assert_eq!((-t).log(), t.log());
    let nearly = Motor::from_parts(
        Vector::new(3.0, -1.0, 2.0),
        Rotor::exp(Bivector::new(std::f64::consts::PI - 1e-10, 0.0, 0.0)),
    );
    let half: Point = nearly.powf(0.5).apply(Point::new(0.0, 0.0, 0.0));
    assert!(half.distance_sq_to(Point::new(1.5, -0.5, 1.0)) < 1e-18, "half way, and not far away: {half:?}");
    let spiral =
        ConformalRotor::exp(PointPair { no_ninf: 0.4, e12: 0.3, e1_ninf: 2.0, ..PointPair::default() }).unwrap();
    assert_eq!((-spiral).log(), spiral.log());
}

#[test]
fn the_antipodal_map_has_no_logarithm_of_its_own() {
    // x -> -x / x²: a half turn in e12 and in the plane of e3 and e, or in any other such pair.
    let two = |a: f64, b: f64| PointPair { e12: a, e3_no: -b, e3_ninf: b / 2.0, ..PointPair::default() };
    let half = std::f64::consts::FRAC_PI_2;
    let antipodal = ConformalRotor { p: 0.0, q: 0.0, v123: 1.0, w123: 1.0, ..ConformalRotor::default() };
    let image: Point = antipodal.apply(Point::new(2.0, 0.0, 0.0));
    assert_eq!([image.x, image.y, image.z], [-0.5, 0.0, 0.0]);
    assert_eq!(antipodal.log(), Err(NotAConformalRotor::Antipodal));
    assert_eq!((-antipodal).powf(0.5), Err(NotAConformalRotor::Antipodal));
    // Near it the error grows with the inverse of the distance, and there is always an answer or the name of the case.
    for k in 1..=16 {
        let distance = 10.0f64.powi(-k);
        let b = two(half - distance, half - distance);
        match ConformalRotor::exp(b).unwrap().log() {
            Ok(log) => {
                let error = <[f64; 10]>::from(log - b).into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
                assert!(error < 2e-15 / distance, "{k}: {error:e}");
            }
            Err(error) => assert!(error == NotAConformalRotor::Antipodal && k > 14, "{k}: {error}"),
        }
    }
    // A half turn rounded to f64 misses it by 1e-16: a direction made of rounding is no answer.
    assert_eq!(ConformalRotor::exp(two(half, half)).unwrap().log(), Err(NotAConformalRotor::Antipodal));
    let mut random = Random(15);
    for _ in 0..50 {
        let turn = Rotor::exp(Bivector::from_fn(|_| random.signed()));
        let turned = turn * antipodal * turn.rev();
        assert_eq!(turned.log(), Err(NotAConformalRotor::Antipodal), "{turned:?}");
    }
}

#[test]
fn renormalisation_brings_back_what_drifted() {
    let mut random = Random(13);
    for case in 0..500 {
        let drift = 10.0f64.powi(-(case % 14) - 1);
        let length = 10.0f64.powi(case % 7);
        let rotor = Rotor::normalise(ga_physics::algebra::g3::Even::from_fn(|_| random.signed())).unwrap();
        let motor = Motor::from_parts(Vector::from_fn(|_| random.signed() * length), rotor);
        assert!(rotor.map(|x| x * (1.0 + random.signed() * drift)).renormalise().unwrap().is_unit(5e-16));
        let drifted = motor.map(|x| x * (1.0 + random.signed() * drift));
        let back = drifted.renormalise().unwrap();
        assert!(back.is_unit(1e-15 * length), "{back:?}");
        for (x, y) in <[f64; 8]>::from(motor).into_iter().zip(<[f64; 8]>::from(back)) {
            assert!((x - y).abs() <= 4.0 * (drift + 1e-15) * length, "{x} {y} {drift}");
        }
        // A general versor, with a dilation by 1e±6 among it.
        let dilation = Dilator::by(10.0f64.powi(case % 13 - 6)).unwrap();
        let versor = dilation * ConformalRotor::exp(PointPair::from_fn(|_| random.signed())).unwrap();
        let drifted = versor.map(|x| x * (1.0 + random.signed() * drift.min(1e-2)));
        let back = drifted.renormalise().unwrap();
        let product = back * back.rev();
        // Lengths have been scaled: v by 1/k, w by k.
        let (v, w) = (product.v1 * dilation.factor(), product.w123 / dilation.factor());
        let rest = [product.p - 1.0, product.q - 1.0, product.p23, product.p31, product.p12, v, w];
        assert!(rest.iter().all(|x| x.abs() < 1e-13), "{rest:?} {dilation:?}");
    }
}

#[test]
fn what_cannot_be_renormalised_has_a_name() {
    let motor = |s: f64, x: f64| Motor::from([s, 0.0, 0.0, 0.0, x, 0.0, 0.0, 0.0]);
    for s in [0.0, 1e-170, 1e200, f64::NAN, f64::INFINITY] {
        assert!(matches!(motor(s, 1.0).renormalise(), Err(NotAMotor::Rotation { .. })), "{s}");
        assert!(Rotor::new(s, 0.0, 0.0, 0.0).renormalise().is_err(), "{s}");
    }
    for x in [f64::NAN, f64::INFINITY] {
        assert_eq!(motor(1.0, x).renormalise(), Err(NotAMotor::Translation));
    }
    assert_eq!(motor(1e-3, 1e300).renormalise().unwrap().e1_ninf, 1e303);
    let versor = |p: f64, q: f64| ConformalRotor { p, q, ..ConformalRotor::default() };
    for (p, q) in [(0.0, 0.0), (1.0, -1.0), (1e-100, 1e-100), (1e100, 1e100)] {
        let error = versor(p, q).renormalise();
        assert!(matches!(error, Err(NotAConformalRotor::NotUnit { .. })), "{p} {q}: {error:?}");
        let error = versor(p, q).log();
        assert!(matches!(error, Err(NotAConformalRotor::NotUnit { .. })), "{p} {q}: {error:?}");
    }
    for x in [f64::NAN, f64::INFINITY] {
        assert_eq!(versor(x, 1.0).renormalise(), Err(NotAConformalRotor::OutOfRange));
        assert_eq!(versor(x, 1.0).log(), Err(NotAConformalRotor::OutOfRange));
        let b = PointPair { e1_no: x, ..PointPair::default() };
        assert_eq!(ConformalRotor::exp(b), Err(NotAConformalRotor::OutOfRange));
    }
    let message = versor(1.0, -1.0).renormalise().unwrap_err().to_string();
    assert!(message.contains("-1e0"), "{message}");
}

/// Bivectors with numbers of very different sizes: finite, or an error that says so.
fn nothing_is_lost<T: Real>(sizes: &[f64]) {
    let mut random = Random(14);
    let (mut found, mut refused) = (0, 0);
    for _ in 0..4000 {
        let b = PointPair::from_fn(|_| {
            let size = sizes[random.index(sizes.len())];
            T::from_f64(size * random.signed().signum())
        });
        let Ok(versor) = ConformalRotor::exp(b) else {
            refused += 1;
            continue;
        };
        found += 1;
        match versor.log() {
            Ok(log) => assert!(<[T; 10]>::from(log).iter().all(|x| x.is_finite())),
            // The numbers of the exponential are too large for its norm to be near 1, or for their squares.
            Err(error) => assert!(error != NotAConformalRotor::Antipodal, "{error}"),
        }
        let twist = Twist::new(b.e23, b.e31, b.e12, b.e1_ninf, b.e2_ninf, b.e3_ninf);
        let motor = Motor::exp(twist);
        assert!(<[T; 8]>::from(motor).iter().all(|x| x.is_finite()), "{twist:?}");
        assert!(<[T; 6]>::from(motor.log()).iter().all(|x| x.is_finite()), "{motor:?}");
    }
    assert!(found > 500, "{found} found, {refused} refused");
}

#[test]
fn numbers_of_very_different_sizes_give_no_nan() {
    nothing_is_lost::<f64>(&[0.0, 0.0, 1e-300, 1e-160, 1e-30, 1e-3, 1.0, 3.0, 10.0]);
    nothing_is_lost::<f64>(&[0.0, 0.0, 0.0, 1e-200, 1.0, 1e5, 1e40, 1e150]);
    nothing_is_lost::<f32>(&[0.0, 0.0, 1e-40, 1e-20, 1e-3, 1.0, 3.0, 10.0]);
}

#[test]
fn half_precision_of_a_grid_has_no_nan() {
    for p in half_angles(10.0) {
        for direction in DIRECTIONS {
            let [x, y, z] = times::<f32>(direction, p);
            let log = Motor::exp(Twist::new(x, y, z, z, x, y)).log();
            assert!(<[f32; 6]>::from(log).iter().all(|x| x.is_finite()), "{p} {direction:?}");
        }
    }
}

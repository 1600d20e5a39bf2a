//! What holds of every power and interpolation: ends, speed, the shorter way, composition.

use crate::grids::{DIRECTIONS, Random, half_angles, times};
use ga_physics::algebra::Real;
use ga_physics::algebra::cga::{ConformalRotor, Dilator, Motor, Point, PointPair, Translator, Twist};
use ga_physics::algebra::g3::{Bivector, Rotor, Vector};
use std::f64::consts::{FRAC_PI_2, PI};

/// The largest difference of two lists, as a part of a size.
fn apart<T: Real, const N: usize>(a: [T; N], b: [T; N]) -> f64 {
    let distances = a.into_iter().zip(b).map(|(x, y)| (x - y).to_f64().abs());
    distances.fold(0.0, |worst, d| if d > worst || d.is_nan() { d } else { worst })
}

fn random_rotor(random: &mut Random) -> Rotor<f64> {
    Rotor::normalise(ga_physics::algebra::g3::Even::from_fn(|_| random.signed())).unwrap()
}

fn random_motor(random: &mut Random) -> Motor<f64> {
    let rotor = random_rotor(random);
    Motor::from_parts(Vector::from_fn(|_| random.signed() * 10.0), rotor)
}

fn random_conformal(random: &mut Random) -> ConformalRotor<f64> {
    let exp = |random: &mut Random| ConformalRotor::exp(PointPair::from_fn(|_| random.signed())).unwrap();
    exp(random) * exp(random)
}

#[test]
fn the_half_power_squared_is_the_versor() {
    let mut random = Random(1);
    for _ in 0..500 {
        let rotor = random_rotor(&mut random);
        let half = rotor.powf(0.5);
        let sign = rotor.s.signum();
        assert!(apart::<f64, 4>((half * half).into(), rotor.map(|x| x * sign).into()) < 2e-15, "{rotor:?}");
        let motor = random_motor(&mut random);
        let half = motor.powf(0.5);
        let sign = motor.s.signum();
        assert!(apart::<f64, 8>((half * half).into(), motor.map(|x| x * sign).into()) < 2e-14, "{motor:?}");
        let third = motor.powf(1.0 / 3.0);
        assert!(apart::<f64, 8>((third * third * third).into(), motor.map(|x| x * sign).into()) < 3e-14, "{motor:?}");
        let versor = random_conformal(&mut random);
        let sign = (versor.p + versor.q).signum();
        let size = <[f64; 16]>::from(versor).into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        // A logarithm near a half turn in two planes at once is badly conditioned: `eps / d`.
        match versor.powf(0.5) {
            Ok(half) => {
                let error = apart::<f64, 16>((half * half).into(), versor.map(|x| x * sign).into()) / size;
                assert!(error < 1e-13, "{error:e} {versor:?}");
            }
            Err(error) => panic!("{error}: {versor:?}"),
        }
    }
}

#[test]
fn powers_add() {
    let mut random = Random(2);
    for _ in 0..200 {
        let (motor, a, b) = (random_motor(&mut random), random.signed() * 2.0, random.signed() * 2.0);
        let product = motor.powf(a) * motor.powf(b);
        assert!(apart::<f64, 8>(product.into(), motor.powf(a + b).into()) < 3e-13, "{motor:?} {a} {b}");
        let dilator = Dilator::by(random.signed().abs() + 0.01).unwrap();
        let product = dilator.powf(a) * dilator.powf(b);
        assert!((product.factor() / dilator.powf(a + b).factor() - 1.0).abs() < 1e-14);
    }
}

#[test]
fn interpolation_meets_both_ends_to_the_bit() {
    let mut random = Random(3);
    let mut flipped = 0;
    for _ in 0..300 {
        let (a, b) = (random_rotor(&mut random), random_rotor(&mut random));
        assert_eq!(a.interpolate(b, 0.0), a);
        let end = a.interpolate(b, 1.0);
        assert!(end == b || end == -b, "{end:?} {b:?}");
        flipped += usize::from(end == -b);
        let (a, b) = (random_motor(&mut random), random_motor(&mut random));
        assert_eq!(a.interpolate(b, 0.0), a);
        let end = a.interpolate(b, 1.0);
        assert!(end == b || end == -b, "{end:?} {b:?}");
        let (a, b) = (random_conformal(&mut random), random_conformal(&mut random));
        let size = 1e-15 * <[f64; 16]>::from(a).into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        assert!(apart::<f64, 16>(a.interpolate(b, 0.0).unwrap().into(), a.into()) <= size);
        let end = a.interpolate(b, 1.0).unwrap();
        assert!(
            apart::<f64, 16>(end.into(), b.into()).min(apart::<f64, 16>(end.into(), (-b).into())) <= 1e-14,
            "{end:?} {b:?}"
        );
    }
    assert!(flipped > 50 && flipped < 250, "both signs are met: {flipped}");
    let far = |x: f64| Motor::from_parts(Vector::new(x, 0.0, 1.0), Rotor::default());
    let (a, b) = (far(-1e307), far(1e307));
    assert_eq!((a.interpolate(b, 0.0), a.interpolate(b, 1.0), a.interpolate(b, 0.5)), (a, b, far(0.0)));
    let (a, b) = (Translator::new(-1e308, 3.0, 1e-300), Translator::new(1e308, 0.1, 7.0));
    assert_eq!((a.interpolate(b, 0.0), a.interpolate(b, 1.0)), (a, b));
    assert_eq!(a.interpolate(b, 0.5).x, 0.0);
    let (a, b) = (Dilator::by(1e-150).unwrap(), Dilator::by(3e150).unwrap());
    assert_eq!((a.interpolate(b, 0.0), a.interpolate(b, 1.0)), (a, b));
    assert!((a.interpolate(b, 0.5).factor() / 3.0f64.sqrt() - 1.0).abs() < 1e-13);
}

/// The second half of the way is measured from its end: with the wrong sign of it the path would jump to minus itself.
#[test]
fn interpolation_does_not_jump_half_way() {
    let mut random = Random(6);
    let (before, after) = (0.5, 0.5 + 1e-12);
    for _ in 0..100 {
        let (a, b) = (random_rotor(&mut random), random_rotor(&mut random));
        assert!(apart::<f64, 4>(a.interpolate(b, before).into(), a.interpolate(b, after).into()) < 1e-11);
        let (a, b) = (random_motor(&mut random), random_motor(&mut random));
        assert!(apart::<f64, 8>(a.interpolate(b, before).into(), a.interpolate(b, after).into()) < 1e-9);
        let (a, b) = (random_conformal(&mut random), random_conformal(&mut random));
        let [x, y] = [before, after].map(|t| a.interpolate(b, t).unwrap());
        assert!(apart::<f64, 16>(x.into(), y.into()) < 1e-9);
        let (a, b) = (Dilator::exp(random.signed()), -Dilator::exp(random.signed()));
        assert!(apart::<f64, 2>(a.interpolate(b, before).into(), a.interpolate(b, after).into()) < 1e-11);
    }
}

#[test]
fn interpolation_has_constant_speed() {
    let mut random = Random(4);
    for _ in 0..50 {
        let (a, b) = (random_motor(&mut random), random_motor(&mut random));
        let whole = (a.rev() * b).log();
        let steps = 16;
        for step in 0..steps {
            let at = |step: i32| a.interpolate(b, f64::from(step) / f64::from(steps));
            let part = (at(step).rev() * at(step + 1)).log() * f64::from(steps);
            assert!(apart::<f64, 6>(part.into(), whole.into()) < 1e-12, "{a:?} {b:?} {step}");
        }
        let (a, b) = (random_conformal(&mut random), random_conformal(&mut random));
        let whole = (a.rev() * b).log().unwrap();
        for step in 0..steps {
            let at = |step: i32| a.interpolate(b, f64::from(step) / f64::from(steps)).unwrap();
            let part = (at(step).rev() * at(step + 1)).log().unwrap() * f64::from(steps);
            assert!(apart::<f64, 10>(part.into(), whole.into()) < 1e-10, "{a:?} {b:?} {step}");
        }
    }
}

#[test]
fn a_screw_turns_and_slides_in_proportion() {
    // A quarter turn about the vertical axis through (2, 0), 3 up.
    let axis = Translator::by(Vector::new(2.0, 0.0, 0.0));
    let turn = Motor::exp(axis.apply(Twist::new(0.0, 0.0, -PI / 4.0, 0.0, 0.0, -1.5)));
    let found: Point = turn.apply(Point::new(5.0, 0.0, 1.0));
    assert!(found.distance_sq_to(Point::new(2.0, 3.0, 4.0)) < 1e-28, "{found:?}");
    let third: Point = Motor::default().interpolate(turn, 1.0 / 3.0).apply(Point::new(5.0, 0.0, 1.0));
    let expected = Point::new(2.0 + 3.0 * (PI / 6.0).cos(), 1.5, 2.0);
    assert!(third.distance_sq_to(expected) < 1e-28, "{third:?}");
}

#[test]
fn a_twist_moves_by_minus_half_of_it() {
    // Mdot = -1/2 V M: a speed of (1, 2, 3) for a second, then a spin of 0.4 rad/s from e1 to e2.
    let moved: Point = Motor::exp(Twist::new(0.0, 0.0, 0.0, 1.0, 2.0, 3.0) * -0.5).apply(Point::new(0.0, 0.0, 0.0));
    assert_eq!([moved.x, moved.y, moved.z], [1.0, 2.0, 3.0]);
    let turned = Rotor::exp(Bivector::new(0.0, 0.0, 0.4) * -0.5).apply(Vector::new(1.0, 0.0, 0.0));
    assert!((turned.e1 - 0.4f64.cos()).abs() < 1e-15 && (turned.e2 - 0.4f64.sin()).abs() < 1e-15);
    // And the derivative itself, by a central difference.
    let (v, h) = (Twist::new(0.3, -0.4, 0.8, 1.0, 0.5, -0.2), 1e-4);
    let at = |t: f64| <[f64; 8]>::from(Motor::exp(v * (-0.5 * t)));
    let (before, after, now) = (at(0.7 - h), at(0.7 + h), Motor::exp(v * (-0.5 * 0.7)));
    let product = <[f64; 16]>::from(v * now);
    let order = [0, 1, 2, 3, 7, 8, 9, 12];
    for (index, at) in order.into_iter().enumerate() {
        let derivative = (after[index] - before[index]) / (2.0 * h);
        assert!((derivative + product[at] / 2.0).abs() < 1e-8, "{index}");
    }
}

#[test]
fn the_shorter_arc_is_taken_on_both_sides_of_a_half_turn() {
    for k in 1..=15 {
        let excess = 10.0f64.powi(-k);
        for direction in DIRECTIONS {
            for (angle, expected) in [(PI + excess, excess - PI), (PI - excess, PI - excess)] {
                let to = Rotor::exp(Bivector::from(times::<f64>(direction, -angle / 2.0)));
                let quarter = Rotor::default().interpolate(to, 0.25);
                let wanted = Rotor::exp(Bivector::from(times::<f64>(direction, -expected / 8.0)));
                assert!(apart::<f64, 4>(quarter.into(), wanted.into()) < 1e-15, "{angle} {direction:?}");
                let arc = to.log().norm_sq().sqrt() * 2.0;
                assert!(arc <= PI * (1.0 + f64::EPSILON), "{arc}");
            }
        }
    }
    // Exactly half a turn has the sense of the rotor's own bivector.
    let half_turn = Rotor::new(0.0, 0.0, 0.0, -1.0);
    assert_eq!(half_turn.log(), Bivector::new(0.0, 0.0, -FRAC_PI_2));
    assert_eq!((-half_turn).log(), Bivector::new(0.0, 0.0, FRAC_PI_2));
    assert_eq!(Rotor::new(-0.0, 0.0, 0.0, -1.0).log(), half_turn.log());
}

#[test]
fn motors_embed_rotors_and_translators_and_conformal_rotors_embed_motors() {
    let mut random = Random(5);
    for scale in [1e-300, 1e-160, 1e-9, 1.0, 1e9, 1e160, 1e300] {
        for p in half_angles(FRAC_PI_2).into_iter().step_by(7) {
            let (b, w) = (times::<f64>(DIRECTIONS[3], p), [0; 3].map(|_| random.signed() * scale));
            let rotor = Rotor::exp(Bivector::from(b));
            let zero = Motor::exp(Twist::new(b[0], b[1], b[2], 0.0, 0.0, 0.0));
            assert_eq!((zero.rotor(), zero.translation()), (rotor, Vector::default()));
            let twist = Twist::new(b[0], b[1], b[2], w[0], w[1], w[2]);
            let (motor, versor) = (Motor::exp(twist), ConformalRotor::exp(PointPair::from(twist)).unwrap());
            assert!(apart([versor.p, versor.p23, versor.p31, versor.p12], rotor.into()) < 1e-15, "{twist:?}");
            assert!(apart([versor.q, versor.q23, versor.q31, versor.q12], rotor.into()) < 1e-15, "{twist:?}");
            let found = [versor.w1, versor.w2, versor.w3, versor.w123].map(|x| x / -2.0);
            let expected = [motor.e1_ninf, motor.e2_ninf, motor.e3_ninf, motor.e123_ninf];
            assert!(apart(found, expected) < 2e-15 * scale, "{twist:?}: {found:?} {expected:?}");
            assert_eq!([versor.v1, versor.v2, versor.v3, versor.v123], [0.0; 4]);
        }
        let t = Translator::new(scale, -scale / 3.0, 0.0);
        let motor = Motor::from_parts(t.displacement(), Rotor::default());
        assert_eq!((motor.log(), Motor::exp(t.log())), (t.log(), motor), "translations are exact");
        assert_eq!(t.powf(0.5).displacement().e1, scale / 2.0);
    }
}

//! Every formulation with every method gives the same motion: that of an independent reference, of closed forms, and of each
//! other.

use super::reference::{quaternion, split, symmetric};
use super::ways::{Case, Pace, Way, spinning, turned, ways};
use ga_physics::algebra::Real;
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::{Bivector, Rotor, Vector};
use ga_physics::rigid::{Attachment, Force};
use nalgebra::UnitQuaternion;

/// What a method may err by at h = 0.02 s and spins of 1 rad/s for 5 s, rad or m: the stage sum `h^p / p!` over 250 steps, up
/// to a factor of a few; rounding for order 8.
fn expected_error<T: Real>(way: &Way<T>) -> f64 {
    match way.order {
        4 => 1e-7,
        5 => 1e-9,
        _ => 1e-12,
    }
}

#[test]
fn the_tennis_racket_agrees_with_a_splitting() {
    let (moments, omega, duration) = ([1.0, 2.0, 3.0], [0.01, 1.0, 0.01], 5.0);
    let reference = split(moments, omega, UnitQuaternion::identity(), duration, 2000);
    let trust = reference.angle_to(&split(moments, omega, UnitQuaternion::identity(), duration, 1000));
    assert!(trust < 1e-12, "the reference itself is only good to {trust:e} rad");
    for way in ways() {
        let end = way.run(&spinning(1.0, moments, omega), Pace::Fixed(0.02), duration);
        let error = quaternion(end.rotor[0]).angle_to(&reference);
        println!("{}: {error:e} rad", way.name());
        assert!(error < expected_error(&way), "{}: {error:e} rad", way.name());
    }
}

#[test]
fn tops_of_two_and_of_three_equal_moments_follow_their_closed_forms() {
    let start = Rotor::from_axis_angle(Vector::new(1.0, -2.0, 0.5), 2.0).unwrap();
    for (a, c) in [(1.0, 1.8), (2.0, 0.5), (1.0, 1.0)] {
        let (omega, duration) = ([0.5, -0.3, 0.8], 4.0);
        let case = turned(1.0, [a, a, c], omega, start);
        let expected = quaternion(start) * symmetric(a, c, omega, duration);
        for way in ways() {
            let error = quaternion(way.run(&case, Pace::Fixed(0.02), duration).rotor[0]).angle_to(&expected);
            // The slender top nods at |L| / a, the flat one at up to twice the spin: h^5 grows thirtyfold.
            assert!(error < 30.0 * expected_error(&way), "{} with ({a}, {a}, {c}): {error:e} rad", way.name());
        }
    }
}

#[test]
fn steps_by_a_tolerance_end_within_a_multiple_of_it() {
    let (moments, omega, duration) = ([1.0, 2.0, 3.0], [0.2, 1.0, 0.3], 5.0);
    let reference = split(moments, omega, UnitQuaternion::identity(), duration, 2000);
    for way in ways().into_iter().filter(|way| way.adaptive) {
        for size in [1e-5, 1e-8] {
            let end = way.run(&spinning(1.0, moments, omega), Pace::Tolerance(size), duration);
            let error = quaternion(end.rotor[0]).angle_to(&reference);
            println!("{} at {size:e}: {error:e} rad", way.name());
            // A tolerance is of one step; some tens of them add up.
            assert!(error < 100.0 * size, "{} at {size:e}: {error:e} rad", way.name());
        }
    }
}

/// A body that spins, hangs on a damped spring by a corner, is dragged, pushed and turned.
fn busy<T: Real>() -> Case<T> {
    let mut case = spinning(2.0, [1.0, 2.0, 2.5], [0.4, 0.7, -0.3]);
    let number = T::from_f64;
    case.bodies.position[0] = Point::new(3.0, -1.0, 2.0);
    case.bodies.momentum[0] = Vector::new(0.3, 0.1, -0.2).map(number);
    case.setup.forces.gravity = Vector::new(0.0, 0.0, -1.0).map(number);
    let at_body = Vector::new(0.3, 0.2, 0.1).map(number);
    case.setup.forces.forces = vec![
        Force::Spring {
            a: Attachment::Body { body_idx: 0, at_body },
            b: Attachment::World(Point::new(3.0, -1.0, 3.0)),
            stiffness: number(4.0),
            damping: number(0.3),
            rest_length: number(0.2),
        },
        Force::LinearDrag { body_idx: 0, k: number(0.1), k_angular: number(0.05) },
        Force::AtPoint {
            body_idx: 0,
            at_body: -at_body,
            force_world: Vector::new(0.2, -0.1, 0.3).map(number),
            start_s: 0.0,
            end_s: f64::INFINITY,
        },
        Force::Torque {
            body_idx: 0,
            torque_world: Bivector::new(0.05, -0.1, 0.2).map(number),
            start_s: 0.0,
            end_s: f64::INFINITY,
        },
    ];
    case
}

#[test]
fn a_body_under_all_forces_moves_alike_in_every_formulation() {
    let duration = 3.0;
    let ways = ways::<f64>();
    let best = ways.iter().find(|way| (way.form, way.method) == ("rotor", "dop853")).unwrap();
    let reference = best.run(&busy(), Pace::Tolerance(1e-12), duration);
    for way in &ways {
        let end = way.run(&busy(), Pace::Fixed(0.02), duration);
        let turned = quaternion(end.rotor[0]).angle_to(&quaternion(reference.rotor[0]));
        let moved = end.position[0].distance_sq_to(reference.position[0]).sqrt();
        let pushed = (end.momentum[0] - reference.momentum[0]).norm_sq().sqrt();
        let spun = (end.angular_momentum[0] - reference.angular_momentum[0]).norm_sq().sqrt();
        println!("{}: {turned:e} rad, {moved:e} m, {pushed:e} kg m/s, {spun:e} kg m²/s", way.name());
        let error = turned.max(moved).max(pushed).max(spun);
        assert!(error < expected_error(way), "{}: {error:e}", way.name());
    }
}

#[test]
fn single_precision_keeps_its_digits() {
    let (moments, omega, duration) = ([1.0, 2.0, 3.0], [0.2, 1.0, 0.3], 4.0);
    let reference = split(moments, omega, UnitQuaternion::identity(), duration, 1000);
    for way in ways::<f32>() {
        let end = way.run(&spinning(1.0, moments, omega), Pace::Fixed(0.02), duration);
        let error = quaternion(end.rotor[0].map(Real::to_f64)).angle_to(&reference);
        // 200 steps, each rounded a few times by half of 1.2e-7.
        assert!(error < 2e-5, "{}: {error:e} rad", way.name());
        assert!(end.rotor[0].is_unit(8.0 * f32::EPSILON), "{}", way.name());
    }
}

#[test]
fn far_from_the_origin_nothing_changes_but_the_place() {
    // 1e8 m away an f64 position steps by 1.5e-8 m; each of the 200 steps rounds to half of
    // that, twice in the commutator-free method.
    const FAR_M: f64 = 1e8;
    const ROUNDING_M: f64 = 400.0 * 0.75e-8;
    let setting = |x: f64| {
        let mut case: Case<f64> = spinning(1.0, [1.0, 2.0, 3.0], [0.1, 0.2, 0.3]);
        case.bodies.position[0] = Point::new(x, 0.0, 0.0);
        case.bodies.momentum[0] = Vector::new(0.1, 0.0, 0.0);
        case
    };
    for way in ways() {
        let near = way.run(&setting(0.0), Pace::Fixed(0.05), 10.0);
        let far = way.run(&setting(FAR_M), Pace::Fixed(0.05), 10.0);
        assert_eq!(near.rotor[0], far.rotor[0], "{}", way.name());
        let moved = far.position[0].x - FAR_M;
        assert!((moved - near.position[0].x).abs() < ROUNDING_M, "{}: {moved}", way.name());
        assert!((moved - 1.0).abs() < ROUNDING_M, "{}: {moved}", way.name());
    }
    // In single precision a half a centimetre a step must add up all the same: steps are rounded, not places.
    for way in ways::<f32>() {
        let mut case: Case<f32> = spinning(1.0, [1.0, 2.0, 3.0], [0.1, 0.2, 0.3]);
        case.bodies.position[0] = Point::new(FAR_M, 0.0, 0.0);
        case.bodies.momentum[0] = Vector::new(0.1, 0.0, 0.0);
        let moved = way.run(&case, Pace::Fixed(0.05), 10.0).position[0].x - FAR_M;
        assert!((moved - 1.0).abs() < 1e-4, "{}: {moved}", way.name());
    }
}

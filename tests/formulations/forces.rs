//! Closed forms of motion under forces, for every formulation and method.

use super::reference::quaternion;
use super::ways::{Case, Pace, spinning, ways};
use ga_physics::algebra::g3::{Bivector, Vector};
use ga_physics::rigid::{Attachment, Force, totals};

/// Some hundred roundings of numbers of size 1 to 10.
const ROUNDED: f64 = 1e-13;

#[test]
fn free_bodies_keep_both_momenta_to_the_bit_and_nearly_their_energy() {
    let mut case: Case<f64> = spinning(2.0, [1.0, 2.0, 3.0], [0.5, 0.7, 0.3]);
    case.bodies.momentum[0] = Vector::new(1.0, -2.0, 0.5);
    let start = totals(&case.bodies, &case.setup.inertias, &case.setup.forces);
    for way in ways() {
        let end = way.run(&case, Pace::Fixed(0.02), 4.0);
        assert_eq!(end.momentum, case.bodies.momentum, "{}", way.name());
        assert_eq!(end.angular_momentum, case.bodies.angular_momentum, "{}", way.name());
        let energy = totals(&end, &case.setup.inertias, &case.setup.forces).kinetic;
        let drift = (energy - start.kinetic).abs() / start.kinetic;
        assert!(drift < 1e-8, "{}: energy drift {drift:e}", way.name());
    }
}

/// A body that spins and is thrown.
fn thrown(omega_body: [f64; 3]) -> Case<f64> {
    let mut case = spinning(2.0, [1.0, 2.0, 3.0], omega_body);
    case.bodies.momentum[0] = Vector::new(2.0, -1.0, 6.0);
    case.setup.forces.gravity = Vector::new(0.0, 0.0, -9.81);
    case
}

fn distance_from_parabola(case: &Case<f64>, end: &ga_physics::rigid::Bodies<f64>, t: f64) -> f64 {
    let velocity = case.bodies.momentum[0] / 2.0;
    let expected = case.bodies.position[0].moved(velocity * t + case.setup.forces.gravity * (0.5 * t * t));
    end.position[0].distance_sq_to(expected).sqrt()
}

#[test]
fn a_throw_is_a_parabola_whether_or_not_the_body_spins() {
    for way in ways().into_iter().filter(|way| way.form != "motor") {
        for omega in [[0.0; 3], [0.5, 1.5, -1.0]] {
            let case = thrown(omega);
            let error = distance_from_parabola(&case, &way.run(&case, Pace::Fixed(0.1), 1.0), 1.0);
            assert!(error < ROUNDED, "{}: {error:e} m", way.name());
        }
    }
}

#[test]
fn in_motors_a_throw_is_a_parabola_if_the_body_does_not_spin_else_to_the_order() {
    for way in ways().into_iter().filter(|way| way.form == "motor") {
        let still = thrown([0.0; 3]);
        let error = distance_from_parabola(&still, &way.run(&still, Pace::Fixed(0.1), 1.0), 1.0);
        assert!(error < ROUNDED, "{} without spin: {error:e} m", way.name());
        let case = thrown([0.5, 1.5, -1.0]);
        let steps = if way.order == 8 { [2.0, 4.0] } else { [8.0, 16.0] };
        let [coarse, fine] =
            steps.map(|steps| distance_from_parabola(&case, &way.run(&case, Pace::Fixed(1.0 / steps), 1.0), 1.0));
        println!("{}: {coarse:e} m, {fine:e} m", way.name());
        // It is not exact, which is what the form costs, and falls as the attitude's error does.
        assert!(coarse > 1e-11, "{}: {coarse:e} m", way.name());
        let order = (coarse / fine).log2();
        assert!(order > f64::from(way.order) - 0.5, "{}: observed order {order}", way.name());
    }
}

#[test]
fn a_torque_about_a_principal_axis_turns_by_half_its_acceleration_times_time_squared() {
    let mut case: Case<f64> = spinning(1.0, [1.0, 2.0, 3.0], [0.0; 3]);
    let torque_world = Bivector::new(0.0, 0.0, 0.6);
    case.setup.forces.forces = vec![Force::Torque { body_idx: 0, torque_world, start_s: 0.0, end_s: f64::INFINITY }];
    for way in ways() {
        let end = way.run(&case, Pace::Fixed(0.05), 2.0);
        let angle = quaternion(end.rotor[0]).scaled_axis();
        assert!((angle.z - 0.5 * 0.2 * 4.0).abs() < 1e-8, "{}: {angle:?}", way.name());
        assert!(angle.x.abs().max(angle.y.abs()) < ROUNDED, "{}: {angle:?}", way.name());
        assert!((end.angular_momentum[0].e12 - 1.2).abs() < ROUNDED, "{}", way.name());
    }
}

#[test]
fn a_push_off_centre_turns_by_the_right_hand_rule() {
    // Along +y at +x: about +z, e1 towards e2. Both momenta are what the impulse is, as long as the arm has not turned.
    let mut case: Case<f64> = spinning(1.0, [1.0; 3], [0.0; 3]);
    case.setup.forces.forces = vec![Force::AtPoint {
        body_idx: 0,
        at_body: Vector::new(0.1, 0.0, 0.0),
        force_world: Vector::new(0.0, 2.0, 0.0),
        start_s: 0.0,
        end_s: f64::INFINITY,
    }];
    for way in ways() {
        let end = way.run(&case, Pace::Fixed(0.01), 0.2);
        assert!((end.momentum[0].e2 - 0.4).abs() < ROUNDED, "{}", way.name());
        let spin = end.angular_momentum[0];
        // The arm turns by 0.1 * 2 * 0.2² / 2 rad, which takes 8e-6 of the torque at most.
        assert!(spin.e12 > 0.04 * (1.0 - 8e-6) && spin.e12 <= 0.04, "{}: {spin:?}", way.name());
        assert!(spin.e23.abs().max(spin.e31.abs()) < ROUNDED, "{}: {spin:?}", way.name());
    }
}

#[test]
fn drag_and_a_damped_spring_decay_as_their_closed_forms() {
    let (k, k_angular, t): (f64, f64, f64) = (0.6, 0.2, 2.0);
    let mut case: Case<f64> = spinning(2.0, [0.5; 3], [0.0, 0.0, 3.0]);
    case.bodies.momentum[0] = Vector::new(4.0, 0.0, 0.0);
    case.setup.forces.forces = vec![Force::LinearDrag { body_idx: 0, k, k_angular }];
    for way in ways() {
        let end = way.run(&case, Pace::Fixed(0.02), t);
        let speed = end.momentum[0].e1 / 2.0;
        assert!((speed - 2.0 * (-k / 2.0 * t).exp()).abs() < 1e-8, "{}: {speed}", way.name());
        let spin = end.angular_momentum[0].e12 / 0.5;
        assert!((spin - 3.0 * (-k_angular / 0.5 * t).exp()).abs() < 1e-8, "{}: {spin}", way.name());
    }
    // x'' = -(k/m) x - (c/m) x', from rest at 1 beyond the rest length.
    let (mass, stiffness, damping) = (2.0_f64, 8.0, 0.8);
    let mut case: Case<f64> = spinning(mass, [1.0; 3], [0.0; 3]);
    let (a, b) = (
        Attachment::Body { body_idx: 0, at_body: Vector::default() },
        Attachment::World(ga_physics::algebra::cga::Point::new(-3.0, 0.0, 0.0)),
    );
    case.setup.forces.forces = vec![Force::Spring { a, b, stiffness, damping, rest_length: 2.0 }];
    let rate = damping / (2.0 * mass);
    let frequency = (stiffness / mass - rate * rate).sqrt();
    let (sin, cos) = (frequency * t).sin_cos();
    let expected = (-rate * t).exp() * (cos + rate / frequency * sin) - 1.0;
    for way in ways() {
        let end = way.run(&case, Pace::Fixed(0.02), t);
        assert!((end.position[0].x - expected).abs() < 1e-7, "{}: {}", way.name(), end.position[0].x);
    }
}

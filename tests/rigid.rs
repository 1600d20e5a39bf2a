//! Laws of rigid motion in the rotor form: order, closed forms, conservation, frames, and that the misprinted equation
//! fails them.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use ga_physics::algebra::Real;
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::{Bivector, Rotor, Vector};
use ga_physics::ode::{OdeError, Rk4, RungeKutta};
use ga_physics::rigid::rotor::{self, Rates};
use ga_physics::rigid::{
    Attachment, Bodies, Force, Forces, Inertia, InertiaError, Joint, JointError, Method, Motion, MotionError, Setup,
    Solver, SolverError, Wrenches, totals,
};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

fn diagonal(moments: [f64; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|r| std::array::from_fn(|c| if r == c { moments[r] } else { 0.0 }))
}

/// One body at the origin with the given angular velocity in its own frame.
fn spinning(mass: f64, moments: [f64; 3], omega_body: [f64; 3]) -> (Bodies<f64>, Vec<Inertia<f64>>) {
    let inertia = Inertia::new(mass, diagonal(moments)).unwrap();
    let mut bodies = Bodies::default();
    let angular_momentum = inertia.momentum_of(Bivector::from(omega_body));
    bodies.push(Point::origin(), Rotor::default(), Vector::default(), angular_momentum);
    (bodies, vec![inertia])
}

/// RK4 and renormalisation.
fn motion<T: Real>(bodies: &Bodies<T>, inertias: &[Inertia<T>], forces: &Forces<T>, dt: f64) -> Motion<T> {
    let setup = Setup { inertias: inertias.to_vec(), forces: forces.clone(), joints: vec![] };
    Motion::new(setup, bodies, &Solver::fixed(Method::Rk4, dt)).unwrap()
}

fn run(bodies: &mut Bodies<f64>, inertias: &[Inertia<f64>], forces: &Forces<f64>, dt: f64, steps: u32) {
    let mut motion = motion(bodies, inertias, forces, dt);
    for step in 0..steps {
        motion.advance(bodies, f64::from(step) * dt, dt).unwrap();
    }
}

/// The quaternion `w + x i + y j + z k` is the rotor `w - x e23 - y e31 - z e12`.
fn quaternion(rotor: Rotor<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(rotor.s, -rotor.e23, -rotor.e31, -rotor.e12))
}

/// An independent reference: the free body's Hamiltonian split into rotations about its three axes, each exact
/// (McLachlan 1993, Reich 1994), composed to order 6 (Yoshida 1990, solution A), on nalgebra's quaternions.
fn split_reference(moments: [f64; 3], omega_body: [f64; 3], duration: f64, steps: u32) -> UnitQuaternion<f64> {
    let mut momentum = Vector3::from_fn(|i, _| moments[i] * omega_body[i]);
    let mut attitude = UnitQuaternion::identity();
    let turn = |axis: usize, h: f64, momentum: &mut Vector3<f64>, attitude: &mut UnitQuaternion<f64>| {
        let mut rotation = Vector3::zeros();
        rotation[axis] = momentum[axis] / moments[axis] * h;
        let rotation = UnitQuaternion::from_scaled_axis(rotation);
        *attitude *= rotation;
        *momentum = rotation.inverse() * *momentum;
    };
    const OUTER: [f64; 3] = [0.784_513_610_477_560, 0.235_573_213_359_357, -1.177_679_984_178_87];
    let middle = 1.0 - 2.0 * OUTER.iter().sum::<f64>();
    let weights = [OUTER[0], OUTER[1], OUTER[2], middle, OUTER[2], OUTER[1], OUTER[0]];
    let h = duration / f64::from(steps);
    for _ in 0..steps {
        for weight in weights {
            for (axis, share) in [(0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5)] {
                turn(axis, h * weight * share, &mut momentum, &mut attitude);
            }
        }
    }
    attitude
}

#[test]
fn the_tennis_racket_agrees_with_an_independent_reference() {
    let (moments, omega, duration) = ([1.0, 2.0, 3.0], [0.01, 1.0, 0.01], 100.0);
    let reference = split_reference(moments, omega, duration, 20_000);
    let coarser = split_reference(moments, omega, duration, 10_000);
    let trust = reference.angle_to(&coarser);
    assert!(trust < 1e-9, "the reference itself is only good to {trust:e} rad");
    let (mut bodies, inertias) = spinning(1.0, moments, omega);
    run(&mut bodies, &inertias, &Forces::default(), 0.01, 10_000);
    let error = quaternion(bodies.rotor[0]).angle_to(&reference);
    println!("attitude error {error:e} rad, reference good to {trust:e} rad");
    assert!(error < 1e-6, "attitude error {error:e} rad");
    assert!(error > trust, "the method cannot be better than the reference");
}

#[test]
fn the_observed_order_is_four() {
    let (moments, omega, duration) = ([1.0, 2.0, 2.5], [0.3, 0.2, 0.4], 4.0);
    let reference = split_reference(moments, omega, duration, 4000);
    let error = |steps: u32| {
        let (mut bodies, inertias) = spinning(1.0, moments, omega);
        run(&mut bodies, &inertias, &Forces::default(), duration / f64::from(steps), steps);
        quaternion(bodies.rotor[0]).angle_to(&reference)
    };
    // Steps small enough for one substep each.
    let errors = [100, 200, 400].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 4.0).abs() < 0.15, "observed order {order}, errors {errors:?}");
    }
}

#[test]
fn the_misprinted_equation_fails() {
    // The report prints Rdot = -1/2 Omega_body R. The same integrator, the same body:
    let (moments, omega, duration, steps) = ([1.0, 2.0, 2.5], [0.3, 0.2, 0.4], 4.0, 400_u32);
    let reference = split_reference(moments, omega, duration, 4000);
    let attitude = |misprint: bool| {
        let (mut bodies, inertias) = spinning(1.0, moments, omega);
        let mut rk4 = RungeKutta::<Rk4, _, f64>::new(bodies.clone(), Rates::zeros(1));
        let mut motion = |_: f64, state: &Bodies<f64>, rates: &mut Rates<f64>| {
            rotor::rhs(state, &inertias, &Wrenches::zeros(1), rates);
            if misprint {
                rates.rotor[0] = (state.omega_body(0, &inertias[0]) * state.rotor[0]) * -0.5;
            }
        };
        for _ in 0..steps {
            let Ok(()) = rk4.step(&mut bodies, 0.0, duration / f64::from(steps), &mut motion);
            rotor::renormalise(&mut bodies).unwrap();
        }
        quaternion(bodies.rotor[0]).angle_to(&reference)
    };
    assert!(attitude(false) < 1e-9);
    assert!(attitude(true) > 0.1, "the misprint should be seen");
}

#[test]
fn a_spin_about_a_principal_axis_is_a_uniform_rotation() {
    // About +z by the right-hand rule: e1 goes towards e2.
    let (mut bodies, inertias) = spinning(1.0, [1.0, 2.0, 3.0], [0.0, 0.0, 2.0]);
    run(&mut bodies, &inertias, &Forces::default(), 0.01, 50);
    let image = bodies.rotor[0].apply(Vector::new(1.0, 0.0, 0.0));
    let expected = Vector::new(1.0_f64.cos(), 1.0_f64.sin(), 0.0);
    // RK4 at 0.01 rad a half-step: 50 * (0.01)^5 / 120.
    assert!((image - expected).norm_sq().sqrt() < 1e-10, "{image:?}");
}

#[test]
fn free_motion_keeps_momentum_exactly_and_energy_nearly() {
    let (mut bodies, inertias) = spinning(2.0, [1.0, 2.0, 3.0], [0.5, 0.7, 0.3]);
    bodies.momentum[0] = Vector::new(1.0, -2.0, 0.5);
    let (p, l, start) =
        (bodies.momentum[0], bodies.angular_momentum[0], totals(&bodies, &inertias, &Forces::default()));
    run(&mut bodies, &inertias, &Forces::default(), 0.01, 1000);
    assert_eq!((bodies.momentum[0], bodies.angular_momentum[0]), (p, l));
    let drift = (totals(&bodies, &inertias, &Forces::default()).kinetic - start.kinetic).abs() / start.kinetic;
    assert!(drift < 1e-9, "energy drift {drift:e}");
    let expected = Point::new(5.0, -10.0, 2.5);
    assert!(bodies.position[0].distance_sq_to(expected).sqrt() < 1e-12);
}

#[test]
fn gravity_and_drag_follow_their_closed_forms() {
    let (mut bodies, inertias) = spinning(2.0, [0.5; 3], [0.0, 0.0, 3.0]);
    bodies.momentum[0] = Vector::new(4.0, 0.0, 0.0);
    let (k, k_angular, t) = (0.6, 0.2, 2.0);
    let forces = Forces { gravity: Vector::default(), forces: vec![Force::LinearDrag { body_idx: 0, k, k_angular }] };
    run(&mut bodies, &inertias, &forces, 0.005, 400);
    let speed = 2.0 * (-k / 2.0 * t).exp();
    assert!((bodies.momentum[0].e1 / 2.0 - speed).abs() < 1e-11);
    let spin = 3.0 * (-k_angular / 0.5 * t).exp();
    assert!((bodies.omega_world(0, &inertias[0]).e12 - spin).abs() < 1e-11);

    let (mut bodies, inertias) = spinning(2.0, [0.5; 3], [0.0; 3]);
    let forces = Forces { gravity: Vector::new(0.0, 0.0, -9.81), forces: vec![] };
    run(&mut bodies, &inertias, &forces, 0.1, 10);
    assert!((bodies.position[0].z + 0.5 * 9.81).abs() < 1e-13);
}

#[test]
fn a_force_at_a_point_turns_by_the_right_hand_rule_and_ends_on_time() {
    // A push along +y at +x turns about +z. It acts from 0.103 s to 0.287 s, which no step boundary meets.
    let (mut bodies, inertias) = spinning(1.0, [1.0; 3], [0.0; 3]);
    let push = Force::AtPoint {
        body_idx: 0,
        at_body: Vector::new(0.1, 0.0, 0.0),
        force_world: Vector::new(0.0, 2.0, 0.0),
        start_s: 0.103,
        end_s: 0.287,
    };
    let forces = Forces { gravity: Vector::default(), forces: vec![push] };
    run(&mut bodies, &inertias, &forces, 0.05, 10);
    let impulse = 2.0 * (0.287 - 0.103);
    assert!((bodies.momentum[0].e2 - impulse).abs() < 1e-14, "impulse {:?}", bodies.momentum[0]);
    let spin = bodies.omega_world(0, &inertias[0]);
    // The arm turns by at most 0.4 rad/s * 0.2 s, so the torque loses under 1 % of itself.
    assert!(spin.e12 > 0.99 * 0.1 * impulse && spin.e12 <= 0.1 * impulse, "spin {spin:?}");
    assert!(spin.e23.abs() < 1e-15 && spin.e31.abs() < 1e-15);
    // x(0.5) = impulse * (0.5 - 0.287) + 2 * 0.184² / 2
    let expected = impulse * (0.5 - 0.287) + 0.184 * 0.184;
    assert!((bodies.position[0].y - expected).abs() < 1e-14);
}

#[test]
fn f32_bodies_move_finely_far_from_the_origin() {
    // 1e6 m away an f32 position would step by 6 cm; a millimetre a step must add up.
    let inertia = Inertia::<f32>::new(1.0, diagonal([1.0, 2.0, 3.0])).unwrap();
    let mut bodies = Bodies::<f32>::default();
    let spin = inertia.momentum_of(Bivector::new(0.1, 0.2, 0.3));
    bodies.push(Point::new(1e6, 0.0, 0.0), Rotor::default(), Vector::new(0.1, 0.0, 0.0), spin);
    let mut motion = motion(&bodies, &[inertia], &Forces::default(), 0.01);
    for step in 0..1000 {
        motion.advance(&mut bodies, f64::from(step) * 0.01, 0.01).unwrap();
    }
    // 0.1 is rounded to f32, and so is each of the thousand products.
    assert!((bodies.position[0].x - 1e6 - 1.0).abs() < 1e-6, "{}", bodies.position[0].x - 1e6);
    assert!(bodies.rotor[0].is_unit(4.0 * f32::EPSILON));
}

#[test]
fn spins_that_a_step_cannot_follow_are_refused() {
    let advance = |spin: f64, method: Method| {
        let (mut bodies, inertias) = spinning(1.0, [1.0, 2.0, 3.0], [0.0, 0.0, spin]);
        let setup = Setup { inertias, ..Setup::default() };
        let mut motion = Motion::new(setup, &bodies, &Solver::fixed(method, 0.01)).unwrap();
        motion.advance(&mut bodies, 0.0, 0.01).map(|()| bodies)
    };
    assert!(advance(29.0, Method::Rk4).is_ok());
    let refused = advance(1e3, Method::Rk4);
    assert!(matches!(refused, Err(OdeError::System(MotionError::Spin { body_idx: 0, .. }))), "{refused:?}");
    // The exact motion follows any.
    let turned = advance(1e6, Method::Yoshida4).unwrap();
    let angle = 1e6_f64 * 0.01;
    let image = turned.rotor[0].apply(Vector::new(1.0, 0.0, 0.0));
    assert!((image - Vector::new(angle.cos(), angle.sin(), 0.0)).norm_sq().sqrt() < 1e-10, "{image:?}");
}

#[test]
fn bad_masses_and_inertias_are_named() {
    for mass in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(Inertia::<f64>::new(mass, diagonal([1.0; 3])), Err(InertiaError::Mass(_))));
    }
    let inertia = |moments| Inertia::<f64>::new(1.0, diagonal(moments));
    for moments in [[0.0, 1.0, 1.0], [-1.0, 1.0, 1.0]] {
        let refused = inertia(moments);
        assert!(matches!(refused, Err(InertiaError::Singular(_))), "{moments:?}: {refused:?}");
    }
    assert!(matches!(inertia([f64::NAN, 1.0, 1.0]), Err(InertiaError::NotSymmetric(_))));
    assert!(matches!(inertia([1.0, 1.0, 2.1]), Err(InertiaError::Triangle(_))));
    // Equality is a lamina, also where the sum is off by rounding.
    assert!(inertia([0.1, 0.7, 0.8]).is_ok() && inertia([1.0, 1.0, 2.0]).is_ok());
    let lopsided = Inertia::<f64>::new(1.0, [[1.0, 0.1, 0.0], [0.2, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert!(matches!(lopsided, Err(InertiaError::NotSymmetric(_))));
    // In f32 the inverse of this mass is out of range.
    assert!(matches!(Inertia::<f32>::new(1e-39, diagonal([1.0; 3])), Err(InertiaError::Mass(_))));
}

#[test]
fn principal_axes_make_the_inertia_diagonal() {
    let matrix = [[2.0, 0.3, -0.1], [0.3, 2.5, 0.2], [-0.1, 0.2, 3.0]];
    let inertia = Inertia::<f64>::new(1.0, matrix).unwrap();
    for axis in 0..3 {
        let mut unit = [0.0; 3];
        unit[axis] = 1.0;
        let along = inertia.principal.axes.apply(Bivector::from(unit));
        let off = inertia.momentum_of(along) - along * inertia.principal.moments[axis];
        assert!(off.norm_sq().sqrt() < 4e-15, "axis {axis}: {off:?}");
    }
}

#[test]
fn steps_by_a_tolerance_do_not_cross_the_end_of_a_force() {
    // Between the frames at 0.1 s, and on one: a step that went past is not gone on from.
    let tolerance = ga_physics::ode::Tolerance { rtol: 1e-10, atol: 1e-10 };
    for end_s in [0.25, 0.3] {
        let (mut bodies, inertias) = spinning(1.0, [1.0; 3], [0.0; 3]);
        let torque_world = Bivector::new(0.0, 0.0, 2.0);
        let push = Force::Torque { body_idx: 0, torque_world, start_s: 0.0, end_s };
        let setup = Setup { inertias, forces: Forces { forces: vec![push], ..Forces::default() }, joints: vec![] };
        let solver = Solver::adaptive(Method::Tsit5, tolerance);
        let mut motion = Motion::new(setup, &bodies, &solver).unwrap();
        (0..10).for_each(|frame| motion.advance(&mut bodies, f64::from(frame) * 0.1, 0.1).unwrap());
        assert!((bodies.angular_momentum[0].e12 - 2.0 * end_s).abs() < 1e-14, "{:?}", bodies.angular_momentum[0]);
    }
}

#[test]
fn a_tumbling_needle_is_no_fast_spin_and_a_split_one_is_told() {
    // |L| / I_min is 1e4 rad/s, but nothing of it is along the axis of the smallest moment.
    let advance = |method: Method| {
        let (mut bodies, inertias) = spinning(1.0, [1e-4, 1.0, 1.0], [0.0, 1.0, 0.0]);
        let setup = Setup { inertias, ..Setup::default() };
        let mut motion = Motion::new(setup, &bodies, &Solver::fixed(method, 0.01)).unwrap();
        (0..100).try_for_each(|step| motion.advance(&mut bodies, f64::from(step) * 0.01, 0.01)).map(|()| bodies)
    };
    let image = advance(Method::Rk4).unwrap().rotor[0].apply(Vector::new(1.0, 0.0, 0.0));
    // About +y by the right-hand rule: e1 goes towards -e3.
    assert!((image - Vector::new(1.0_f64.cos(), 0.0, -1.0_f64.sin())).norm_sq().sqrt() < 1e-9, "{image:?}");
    let refused = advance(Method::Splitting4);
    assert!(matches!(refused, Err(OdeError::System(MotionError::Spin { .. }))), "{refused:?}");
}

#[test]
fn a_body_that_goes_round_many_times_a_step_keeps_its_unit_rotor() {
    for moments in [[1.0, 1.0, 1.0], [1.0, 1.0, 1.0 + 1e-9], [1.0, 2.0, 2.5]] {
        let (mut bodies, inertias) = spinning(1.0, moments, [300.0, 500.0, 400.0]);
        let setup = Setup { inertias, ..Setup::default() };
        let mut motion = Motion::new(setup, &bodies, &Solver::fixed(Method::Verlet, 0.01)).unwrap();
        (0..2000).for_each(|step| motion.advance(&mut bodies, f64::from(step) * 0.01, 0.01).unwrap());
        assert!(bodies.rotor[0].is_unit(4.0 * f64::EPSILON), "{moments:?}: {:?}", bodies.rotor[0]);
    }
}

#[test]
fn steps_by_a_tolerance_are_as_many_beside_other_bodies_as_alone() {
    let (start, inertias, forces) = thrown();
    let setup = Setup { inertias, forces, joints: vec![] };
    let tolerance = ga_physics::ode::Tolerance { rtol: 1e-9, atol: 1e-9 };
    let by_tolerance = Solver::adaptive(Method::Dop853, tolerance);
    let steps = |lists: &[(Solver, Vec<usize>)]| {
        let (mut bodies, mut motion) = (start.clone(), Motion::mixed(setup.clone(), &start, lists).unwrap());
        (0..100).for_each(|frame| motion.advance(&mut bodies, f64::from(frame) * 0.01, 0.01).unwrap());
        motion.work().accepted
    };
    let flight = Solver::fixed(Method::FreeFlight, 0.01);
    let (alone, beside) = (steps(&[(by_tolerance, vec![1])]), steps(&[(by_tolerance, vec![1]), (flight, vec![0])]));
    assert_eq!(beside, alone + 100, "a hundred evaluations of the flight");
    assert!(alone < 60, "{alone} steps: one begins where the last ended, not at each frame");
}

/// Two bodies of unlike inertia, thrown and spinning, in gravity.
fn thrown() -> (Bodies<f64>, Vec<Inertia<f64>>, Forces<f64>) {
    let (mut bodies, mut inertias) = spinning(1.0, [1.0, 2.0, 2.5], [0.3, 2.0, 0.1]);
    let (second, inertia) = spinning(0.5, [0.3, 0.2, 0.4], [1.0, -0.2, 3.0]);
    bodies.push(Point::new(1.0, 2.0, 3.0), second.rotor[0], Vector::new(0.2, 0.1, 0.5), second.angular_momentum[0]);
    bodies.momentum[0] = Vector::new(-0.3, 0.4, 2.0);
    inertias.extend(inertia);
    (bodies, inertias, Forces { gravity: Vector::new(0.0, 0.0, -9.81), forces: vec![] })
}

fn distance(a: &Bodies<f64>, b: &Bodies<f64>) -> f64 {
    let body = |i: usize| {
        let turn = (a.rotor[i].rev() * b.rotor[i]).log().norm_sq().sqrt();
        let momenta = (a.momentum[i] - b.momentum[i]).norm_sq().sqrt()
            + (a.angular_momentum[i] - b.angular_momentum[i]).norm_sq().sqrt();
        a.position[i].distance_sq_to(b.position[i]).sqrt() + turn + momenta
    };
    (0..a.len()).map(body).sum()
}

#[test]
fn free_flight_is_where_small_steps_lead_to_and_can_be_tried_again() {
    let (start, inertias, forces) = thrown();
    let setup = Setup { inertias, forces, joints: vec![] };
    let mut flight = Motion::new(setup.clone(), &start, &Solver::fixed(Method::FreeFlight, 1.0)).unwrap();
    let mut steps = Motion::new(setup.clone(), &start, &Solver::fixed(Method::Splitting6, 0.002)).unwrap();
    let (mut flown, mut stepped) = (start.clone(), start.clone());
    for second in 0..3 {
        flight.advance(&mut flown, f64::from(second), 1.0).unwrap();
        steps.advance(&mut stepped, f64::from(second), 1.0).unwrap();
    }
    assert!(distance(&flown, &stepped) < 1e-10, "{:e}", distance(&flown, &stepped));
    // Spans from one state, as a search for impacts tries them: the last is as if it were the only one.
    let once = flown.clone();
    for span in [0.5, 0.25, 0.3] {
        flown.clone_from(&once);
        flight.advance(&mut flown, 3.0, span).unwrap();
    }
    steps.advance(&mut stepped, 3.0, 0.3).unwrap();
    assert!(distance(&flown, &stepped) < 1e-10);
    // A state that it does not know is a new start.
    flown.angular_momentum[0] = -flown.angular_momentum[0];
    stepped.clone_from(&flown);
    flight.advance(&mut flown, 3.3, 1.0).unwrap();
    steps.advance(&mut stepped, 3.3, 1.0).unwrap();
    assert!(distance(&flown, &stepped) < 1e-10);

    let push = Force::Torque { body_idx: 0, torque_world: Bivector::default(), start_s: 0.0, end_s: 1.0 };
    let setup = Setup { forces: Forces { forces: vec![push], ..setup.forces }, ..setup };
    let refused = Motion::new(setup, &start, &Solver::fixed(Method::FreeFlight, 1.0)).err();
    assert_eq!(refused, Some(SolverError::NotFree));
}

#[test]
fn bodies_solved_in_two_ways_move_as_if_alone_and_must_not_be_linked() {
    let (start, inertias, mut forces) = thrown();
    forces.forces.push(Force::LinearDrag { body_idx: 1, k: 0.1, k_angular: 0.01 });
    let setup = Setup { inertias, forces, joints: vec![] };
    let (first, second) = (Solver::fixed(Method::Yoshida4, 0.01), Solver::fixed(Method::Dop853, 0.02));
    let alone = |solver: &Solver| {
        let (mut bodies, mut motion) = (start.clone(), Motion::new(setup.clone(), &start, solver).unwrap());
        (0..10).for_each(|step| motion.advance(&mut bodies, f64::from(step) * 0.02, 0.02).unwrap());
        bodies
    };
    let mut motion = Motion::mixed(setup.clone(), &start, &[(first, vec![0]), (second, vec![1])]).unwrap();
    let mut bodies = start.clone();
    (0..10).for_each(|step| motion.advance(&mut bodies, f64::from(step) * 0.02, 0.02).unwrap());
    assert_eq!((bodies.rotor[0], bodies.position[0]), (alone(&first).rotor[0], alone(&first).position[0]));
    assert_eq!((bodies.rotor[1], bodies.position[1]), (alone(&second).rotor[1], alone(&second).position[1]));

    let end = |body_idx| Attachment::Body { body_idx, at_body: Vector::default() };
    let spring = Force::Spring { a: end(0), b: end(1), stiffness: 1.0, damping: 0.0, rest_length: 1.0 };
    let forces = Forces { forces: vec![spring], ..setup.forces };
    let linked = Motion::mixed(Setup { forces, ..setup }, &start, &[(first, vec![0]), (second, vec![1])]).err();
    assert_eq!(linked, Some(SolverError::Linked { a: 0, b: 1 }));
}

#[test]
fn bodies_that_do_not_exist_and_joints_that_do_not_meet_are_told_by_their_number() {
    let (start, inertias, forces) = thrown();
    let setup = Setup { inertias, forces, joints: vec![] };
    let solver = Solver::fixed(Method::Yoshida4, 0.01);
    let missing = Some(SolverError::NoSuchBody { body_idx: 7, bodies: 2 });
    let lists = |second| [(solver, vec![0]), (solver, vec![second])];
    assert_eq!(Motion::mixed(setup.clone(), &start, &lists(7)).err(), missing);
    let mut drawn = setup.clone();
    drawn.forces.forces.push(Force::LinearDrag { body_idx: 7, k: 0.1, k_angular: 0.0 });
    assert_eq!(Motion::new(drawn.clone(), &start, &solver).err(), missing);
    assert_eq!(Motion::mixed(drawn, &start, &lists(1)).err(), missing);
    let mut no_number = setup.clone();
    no_number.forces.forces.push(Force::LinearDrag { body_idx: 0, k: f64::NAN, k_angular: 0.0 });
    assert_eq!(Motion::new(no_number, &start, &solver).err(), Some(SolverError::ForceNotFinite { force: 0 }));

    let on = |body_idx| Attachment::Body { body_idx, at_body: Vector::default() };
    let moved = start.position[1].moved(Vector::new(1.0, 0.0, 0.0));
    let ends = [Attachment::World(start.position[0]), Attachment::World(moved)];
    let joints = (0..2).map(|body_idx| Joint::Ball { a: on(body_idx), b: ends[body_idx] }).collect();
    let apart = Motion::mixed(Setup { joints, ..setup.clone() }, &start, &lists(1)).err();
    assert!(matches!(apart, Some(SolverError::Joint(JointError::Apart { joint: 1, .. }))), "{apart:?}");
    let joints = vec![Joint::Ball { a: on(0), b: ends[0] }, Joint::Ball { a: on(1), b: on(7) }];
    let missing = Motion::mixed(Setup { joints, ..setup }, &start, &lists(1)).err();
    assert_eq!(missing, Some(SolverError::Joint(JointError::NoSuchBody { joint: 1, body_idx: 7, bodies: 2 })));
}

#[test]
fn springs_keep_energy_and_momenta_and_damped_ones_lose_energy_only() {
    let (mut start, inertias, _) = thrown();
    start.position[1] = Point::new(1.0, 0.5, 0.0);
    let end = |body_idx, at| Attachment::Body { body_idx, at_body: at };
    let (a, b) = (end(0, Vector::new(0.1, 0.2, 0.0)), end(1, Vector::new(0.0, -0.3, 0.1)));
    for damping in [0.0, 0.5] {
        let spring = Force::Spring { a, b, stiffness: 20.0, damping, rest_length: 0.7 };
        let setup = Setup {
            inertias: inertias.clone(),
            forces: Forces { forces: vec![spring], ..Forces::default() },
            joints: vec![],
        };
        let mut motion = Motion::new(setup, &start, &Solver::fixed(Method::Dop853, 0.01)).unwrap();
        let (mut bodies, before) = (start.clone(), motion.totals(&start));
        (0..200).for_each(|step| motion.advance(&mut bodies, f64::from(step) * 0.01, 0.01).unwrap());
        let after = motion.totals(&bodies);
        let change = after.energy() - before.energy();
        if damping == 0.0 {
            assert!(change.abs() < 1e-11, "{change:e}")
        } else {
            assert!(change < -0.01, "{change:e}")
        }
        assert!((after.momentum - before.momentum).norm_sq().sqrt() < 1e-13);
        assert!((after.angular_momentum - before.angular_momentum).norm_sq().sqrt() < 1e-12);
    }
}

//! Hard cases: sizes, masses and places far from one, change points, what is held in every direction.

use crate::cases::{Case, GRAVITY, distance, inertia_tensor, medley, turned, vector};
use crate::loops::{four_bar, link};
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::{Rotor, Vector};
use ga_physics::rigid::{Attachment, Bodies, Forces, Form, Inertia, Joint, Method, Motion, Setup, Solver, Steps};

fn moved(case: &Case, gravity: f64, method: Method, times: (f64, f64)) -> (Bodies<f64>, Motion<f64>) {
    moved_within(1e-12, case, gravity, method, times)
}

fn moved_within(
    violation: f64,
    case: &Case,
    gravity: f64,
    method: Method,
    (dt_s, time_s): (f64, f64),
) -> (Bodies<f64>, Motion<f64>) {
    let forces = Forces { gravity: vector([0.0, 0.0, -gravity]), forces: vec![] };
    let setup = Setup { inertias: case.inertias.clone(), forces, joints: case.joints.clone() };
    let solver = Solver { form: Form::Rotor, method, steps: Steps::Fixed { dt_s }, violation };
    let mut bodies = case.bodies.clone();
    let mut motion = Motion::new(setup, &bodies, &solver).unwrap();
    motion.advance(&mut bodies, 0.0, time_s).unwrap();
    (bodies, motion)
}

/// The same thing in other units of length and mass moves alike, to the bit where the units are powers of two.
#[test]
fn the_motion_knows_no_units() {
    let case = medley();
    for (length, mass) in [(2.0_f64.powi(-20), 2.0_f64.powi(-30)), (2.0_f64.powi(20), 2.0_f64.powi(30))] {
        let end = |end: Attachment<f64>| match end {
            Attachment::Body { body_idx, at_body } => Attachment::Body { body_idx, at_body: at_body * length },
            Attachment::World(point) => Attachment::World(Point::from(point.position() * length)),
        };
        let mut scaled = case.clone();
        for joint in &mut scaled.joints {
            *joint = match *joint {
                Joint::Ball { a, b } => Joint::Ball { a: end(a), b: end(b) },
                Joint::Hinge { a, b, axis_a, axis_b } => Joint::Hinge { a: end(a), b: end(b), axis_a, axis_b },
                Joint::Distance { a, b, length: l } => Joint::Distance { a: end(a), b: end(b), length: l * length },
            };
        }
        for (i, inertia) in scaled.inertias.iter_mut().enumerate() {
            let tensor = inertia.inertia_body.map(|row| row.map(|x| x * mass * length * length));
            *inertia = Inertia::new(inertia.mass * mass, tensor).unwrap();
            let bodies = &mut scaled.bodies;
            bodies.position[i] = Point::from(bodies.position[i].position() * length);
            bodies.momentum[i] = bodies.momentum[i] * (mass * length);
            bodies.angular_momentum[i] = bodies.angular_momentum[i] * (mass * length * length);
        }
        for method in [Method::Yoshida4, Method::Dop853] {
            let (plain, _) = moved(&case, GRAVITY, method, (0.01, 0.3));
            let (mut other, _) = moved(&scaled, GRAVITY * length, method, (0.01, 0.3));
            for position in &mut other.position {
                *position = Point::from(position.position() / length);
            }
            let error = distance(&plain, &other);
            println!("{} at {length:e} m, {mass:e} kg: {error:e}", method.name());
            assert!(error < 1e-12, "{} at {length:e} m, {mass:e} kg: {error:e}", method.name());
        }
    }
}

/// A thousand kilometres away positions are rounded to 1e-10 m, and nothing else is worse.
#[test]
fn far_from_the_origin_only_positions_are_rounded() {
    let case = medley();
    let away = vector([1e6, -7e5, 3e5]);
    let mut far = case.clone();
    far.bodies.position.iter_mut().for_each(|x| *x = x.moved(away));
    for joint in &mut far.joints {
        if let Joint::Ball { b: Attachment::World(point), .. } = joint {
            *point = point.moved(away);
        }
    }
    for method in [Method::Yoshida4, Method::Dop853] {
        let (near, _) = moved(&case, GRAVITY, method, (0.01, 0.5));
        let (mut there, mut motion) = moved(&far, GRAVITY, method, (0.01, 0.5));
        let violation_m = motion.worst_violation(&there).unwrap();
        there.position.iter_mut().for_each(|x| *x = x.moved(-away));
        let error = distance(&near, &there);
        println!("{}: {violation_m:e} m, off by {error:e} m", method.name());
        assert!(violation_m < 1e-9 && error < 1e-7, "{}: {violation_m:e} {error:e}", method.name());
        assert_eq!(motion.redirected(), 0);
    }
}

/// A needle a million times as long as it is thick, a link a thousand times as light as what hangs on it and as it.
#[test]
fn slender_and_light_bodies_are_held_like_others() {
    let mut case = Case::default();
    let needle = Inertia::new(1.0, inertia_tensor([1e-12, 0.08, 0.08], Rotor::default())).unwrap();
    let light = Inertia::new(1e-3, inertia_tensor([1e-5; 3], Rotor::default())).unwrap();
    let heavy = Inertia::new(1.0, inertia_tensor([0.01, 0.012, 0.015], Rotor::default())).unwrap();
    let a = case.body([0.5, 0.0, 0.0], Rotor::default(), needle);
    let b = case.body([1.1, 0.0, 0.0], Rotor::default(), light);
    let c = case.body([1.5, 0.0, 0.0], turned([1.0, 1.0, 0.0], 0.5), heavy);
    case.ball(a, None, [0.0; 3]);
    case.ball(b, Some(a), [1.0, 0.0, 0.0]);
    case.hinge(c, Some(b), [1.2, 0.0, 0.0], [0.0, 1.0, 0.2]);
    let energy = case.energy(&case.bodies);
    // The rates of such a needle are beyond Runge-Kutta methods: its momentum goes round in the body at 1e11 rad/s.
    let (reference, _) = moved(&case, GRAVITY, Method::Yoshida6, (1e-3, 0.4));
    let (end, mut motion) = moved(&case, GRAVITY, Method::Yoshida6, (2e-3, 0.4));
    let (violation_m, off) = (motion.worst_violation(&end).unwrap(), (case.energy(&end) - energy).abs());
    // What the needle turns about its long axis is not asked for: it does not show.
    let apart = (0..3).map(|i| end.position[i].distance_sq_to(reference.position[i]).sqrt()).fold(0.0, f64::max);
    println!("{violation_m:e} m, energy off by {off:e} J, {apart:e} m from half the step");
    assert!(violation_m < 1e-12 && off < 1e-6 && apart < 1e-7, "{violation_m:e} {off:e} {apart:e}");
}

/// Impulses that balance each other on a light body fling it away if its gradients have turned since they were found; and
/// its rows leave small pivots, that must not pass for redundant where the joints are held loosely.
#[test]
fn bodies_a_billion_times_as_light_as_their_neighbours_are_held() {
    for (name, masses) in [("heavy on light", [1e-9, 1.0, 1.0]), ("light between heavy", [1.0, 1e-9, 1.0])] {
        let mut case = Case::default();
        let mut last = None;
        for (i, mass) in masses.into_iter().enumerate() {
            let moments = [0.01, 0.02, 0.025].map(|moment| moment * mass);
            let inertia = Inertia::new(mass, inertia_tensor(moments, Rotor::default())).unwrap();
            let x = i as f64;
            let body = case.body([x + 0.5, 0.0, 0.0], turned([1.0, 0.0, 0.0], 0.3), inertia);
            case.hinge(body, last, [x, 0.0, 0.0], [0.0, 1.0, 0.1 * x]);
            last = Some(body);
        }
        let (reference, _) = moved(&case, GRAVITY, Method::Dop853, (5e-3, 0.8));
        for (violation, allowed_m) in [(1e-12, 1e-4), (1e-4, 1e-2)] {
            let (end, mut motion) = moved_within(violation, &case, GRAVITY, Method::Yoshida4, (5e-3, 0.8));
            let (apart_m, violation_m) = (distance(&end, &reference), motion.worst_violation(&end).unwrap());
            let off = case.energy(&end) - case.energy(&case.bodies);
            println!("{name}: {violation_m:e} m, {apart_m:e} m from Dop853, energy off by {off:e} J");
            assert!(apart_m < allowed_m && off.abs() < allowed_m, "{name}, {violation:e}: {apart_m:e} m, {off:e} J");
            assert_eq!((motion.redundant(), motion.redirected()), (0, 0), "{name}, {violation:e}");
        }
    }
}

/// A parallelogram of cranks passes through change points, where all four hinges are in line and the linkage may go on
/// either way: there a fourth row is redundant.
#[test]
fn a_parallelogram_passes_its_change_points() {
    let axis = vector([0.0, 1.0, 0.0]);
    let (crank, ground) = (vector([0.2, 0.0, 0.25]), vector([1.0, 0.0, 0.0]));
    let case = four_bar([Vector::default(), crank, crank + ground, ground], [axis; 4]);
    let energy = case.energy(&case.bodies);
    for method in [Method::Yoshida4, Method::Dop853] {
        let (end, mut motion) = moved(&case, GRAVITY, method, (4e-3, 1.5));
        let (violation_m, off) = (motion.worst_violation(&end).unwrap(), (case.energy(&end) - energy).abs());
        println!(
            "{}: {violation_m:e} m, energy off by {off:e} of {energy} J, redirected {}",
            method.name(),
            motion.redirected()
        );
        assert!(violation_m < 1e-9 && off < 0.05 * energy.abs(), "{}: {violation_m:e} {off:e}", method.name());
    }
}

/// A body on three balls cannot move, and does not; three rows are redundant.
#[test]
fn what_is_held_in_every_direction_stays() {
    let mut case = Case::default();
    let body = link(&mut case, Vector::default(), vector([1.0, 0.3, 0.2]));
    for point in [[0.0; 3], [1.0, 0.3, 0.2], [0.5, 0.5, 0.9]] {
        case.ball(body, None, point);
    }
    for method in [Method::Verlet, Method::Rk4] {
        let (end, mut motion) = moved(&case, GRAVITY, method, (0.01, 2.0));
        assert_eq!(motion.redundant(), 3);
        let (off, violation_m) = (distance(&end, &case.bodies), motion.worst_violation(&end).unwrap());
        println!("{}: {off:e} m, {violation_m:e} m, {:?}", method.name(), end.momentum[0]);
        assert!(off < 1e-12 && violation_m < 1e-12, "{off:e} {violation_m:e}");
        assert!(end.momentum[0].norm_sq().sqrt() < 1e-13, "{:?}", end.momentum[0]);
    }
}

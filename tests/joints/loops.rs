//! Chains, closed loops, and long runs.

use crate::cases::{Case, GRAVITY, distance, inertia_tensor, medley, rattle, run, single, turned, vector};
use ga_physics::algebra::Real;
use ga_physics::algebra::g3::{Rotor, Vector};
use ga_physics::ode::{Composition, Dop853, Run, Stepper};
use ga_physics::rigid::{Bodies, Forces, Form, Inertia, Joint, Method, Motion, Setup, Solver, Steps};

/// A slender box, its longest side along x.
fn rod(mass: f64, length: f64) -> Inertia<f64> {
    let [x, y, z] = [length, 0.1 * length, 0.05 * length].map(|side| mass * side * side / 12.0);
    Inertia::new(mass, inertia_tensor([y + z, x + z, x + y], Rotor::default())).unwrap()
}

/// A body between two points.
pub(crate) fn link(case: &mut Case, from: Vector<f64>, to: Vector<f64>) -> usize {
    let along = to - from;
    let length = along.norm_sq().sqrt();
    // Half of the way from x to the link, twice: `R = (along + x) x`, normalised.
    let x = vector([1.0, 0.0, 0.0]);
    let rotor = Rotor::normalise((along / length + x) * x).unwrap();
    case.body((from + along * 0.5).into(), rotor, rod(1.3 * length, length))
}

/// Hinges at four points, along four axes, the first and the last in the world.
pub(crate) fn four_bar(at: [Vector<f64>; 4], axes: [Vector<f64>; 4]) -> Case {
    let mut case = Case::default();
    let bodies = [0, 1, 2].map(|i| link(&mut case, at[i], at[i + 1]));
    for (i, other) in [None, Some(bodies[0]), Some(bodies[1]), None].into_iter().enumerate() {
        case.hinge(bodies[i.min(2)], other, at[i].into(), axes[i].into());
    }
    case.moving(bodies[0], [0.0; 3], (axes[0] * 6.0).into());
    case.settled()
}

/// A crank of 0.3 m, a coupler of 0.9 m, a rocker of 0.7 m, on a ground of 1 m; in a plane askew to all axes.
fn planar() -> Case {
    let plane = turned([0.3, 1.0, -0.5], 1.1);
    let crank = vector([0.3 * 0.7_f64.cos(), 0.0, 0.3 * 0.7_f64.sin()]);
    let ground = vector([1.0, 0.0, 0.0]);
    let span = ground - crank;
    let d = span.norm_sq().sqrt();
    let along = (0.9 * 0.9 - 0.7 * 0.7 + d * d) / (2.0 * d);
    let across = (0.9_f64 * 0.9 - along * along).sqrt();
    let unit = span / d;
    let knee = crank + unit * along + vector([-unit.e3, 0.0, unit.e1]) * across;
    let axis = plane.apply(vector([0.0, 1.0, 0.0]));
    four_bar([Vector::default(), crank, knee, ground].map(|x| plane.apply(x)), [axis; 4])
}

/// Bennett's linkage (1903): four hinges that are not parallel and nevertheless move. Opposite links are of equal length
/// and twist, `sin alpha / a = sin beta / b`, `tan(t1/2) tan(t2/2) = sin((beta + alpha)/2) / sin((beta - alpha)/2)`.
fn bennett() -> Case {
    let (a, alpha, beta) = (0.5_f64, 0.6_f64, 1.0_f64);
    let b = a * beta.sin() / alpha.sin();
    let first = 1.2_f64;
    let second = 2.0 * ((0.5 * (beta + alpha)).sin() / (0.5 * (beta - alpha)).sin() / (0.5 * first).tan()).atan();
    let (mut frame, mut at) = (Rotor::default(), Vector::default());
    let (mut points, mut axes) = (Vec::new(), Vec::new());
    for (angle, length, twist) in [(first, a, alpha), (second, b, beta), (-first, a, alpha), (-second, b, beta)] {
        points.push(at);
        axes.push(frame.apply(vector([0.0, 0.0, 1.0])));
        frame = frame * turned([0.0, 0.0, 1.0], angle);
        at += frame.apply(vector([length, 0.0, 0.0]));
        frame = frame * turned([1.0, 0.0, 0.0], twist);
    }
    assert!(at.norm_sq().sqrt() < 1e-14, "the loop is open by {at:?}");
    four_bar(points.try_into().unwrap(), axes.try_into().unwrap())
}

/// A planar loop has three rows too many, as has Bennett's in space.
#[test]
fn a_four_bar_moves_although_it_is_overdetermined() {
    for (name, case) in [("planar", planar()), ("Bennett's", bennett())] {
        let (mut stepper, mut world) = rattle(&case, Composition::Yoshida6, 4e-3);
        let energy = case.energy(&case.bodies);
        let (mut violation_m, mut off, mut moved) = (0.0_f64, 0.0_f64, 0.0_f64);
        for _ in 0..150 {
            stepper.step(&mut world).unwrap();
            violation_m = violation_m.max(world.held.worst_violation(stepper.state()).unwrap().1);
            off = off.max((case.energy(stepper.state()) - energy).abs());
            moved = moved.max(distance(stepper.state(), &case.bodies));
        }
        let stepped = distance(stepper.state(), &run::<Dop853>(&case, (4e-3, 150), true));
        println!("{name}: {violation_m:e} m, energy {off:e} of {energy} J, moved {moved} m, from Dop853 {stepped:e} m");
        assert_eq!((world.held.redundant(), world.redirected), (3, 0), "{name}");
        assert!(violation_m < 1e-12 && off < 1e-6 && moved > 0.3, "{name}: {violation_m:e} {off:e} {moved}");
        assert!(stepped < 1e-6, "{name}: {stepped:e}");
    }
}

/// How far the energy gets from that of the start, J, and the rows that were redundant.
fn off<T: Real>(
    (mut bodies, inertias, joints): (Bodies<T>, Vec<Inertia<T>>, Vec<Joint<T>>),
    (form, method): (Form, Method),
    (dt_s, steps): (f64, u32),
    violation: f64,
) -> (f64, usize) {
    let forces = Forces { gravity: vector([0.0, 0.0, -GRAVITY]).map(T::from_f64), forces: vec![] };
    let solver = Solver { form, method, steps: Steps::Fixed { dt_s }, violation };
    let mut motion = Motion::new(Setup { inertias, forces, joints }, &bodies, &solver).unwrap();
    let energy = motion.totals(&bodies).energy();
    let mut off = 0.0_f64;
    for step in 0..steps {
        motion.advance(&mut bodies, dt_s * f64::from(step), dt_s).unwrap();
        off = off.max((motion.totals(&bodies).energy() - energy).abs());
    }
    (off, motion.redundant())
}

/// Off their joints, redundant rows depend on each other up to the square of the violation only. Taken for independent by
/// as little as that, they would ask for arbitrary forces: half of the energy is gone within a tenth of a second.
#[test]
fn a_loop_that_is_held_loosely_keeps_its_energy() {
    for (name, case) in [("planar", planar()), ("Bennett's", bennett())] {
        let double = || (case.bodies.clone(), case.inertias.clone(), case.joints.clone());
        let rattle = (Form::Rotor, Method::Yoshida4);
        // Each projection gives or takes what a violation is of the energy; many of them add up at random.
        for violation in [1e-6, 1e-5, 1e-3] {
            let (off, redundant) = off(double(), rattle, (4e-3, 150), violation);
            println!("{name} within {violation:e}: {off:e} J");
            assert!(redundant == 3 && off < 30.0 * violation, "{name}, {violation:e}: {off:e} J, {redundant}");
        }
        for (form, method) in [rattle, (Form::Quaternion, Method::Rk4)] {
            let (off, redundant) = off(single(&case), (form, method), (2e-3, 200), 1e-12);
            println!("{name} in f32 by {}: {off:e} J", method.name());
            assert!(redundant == 3 && off < 1e-4, "{name} in f32 by {}: {off:e} J, {redundant}", method.name());
        }
    }
}

#[test]
fn a_chain_of_twenty_holds() {
    let mut case = Case::default();
    let mut last = None;
    for index in 0..20 {
        let x = f64::from(index) * 0.2;
        let body = link(&mut case, vector([x, 0.0, 0.0]), vector([x + 0.2, 0.0, 0.0]));
        case.ball(body, last, [x, 0.0, 0.0]);
        last = Some(body);
    }
    let energy = case.energy(&case.bodies);
    let (mut stepper, mut world) = rattle(&case, Composition::Yoshida4, 5e-3);
    for _ in 0..100 {
        stepper.step(&mut world).unwrap();
        let (joint, violation_m) = world.held.worst_violation(stepper.state()).unwrap();
        assert!(violation_m < 1e-12, "{joint}: {violation_m:e}");
    }
    let off = (case.energy(stepper.state()) - energy).abs();
    println!("energy off by {off:e} J, {} redirected", world.redirected);
    assert!(off < 1e-3 && world.redirected == 0, "{off:e}");
}

#[test]
fn a_minute_leaves_the_joints_held_and_the_energy_bounded() {
    let case = medley();
    let energy = case.energy(&case.bodies);
    let (mut stepper, mut world) = rattle(&case, Composition::Verlet, 0.01);
    let (mut violation_m, mut off) = (0.0_f64, 0.0_f64);
    for _ in 0..6000 {
        stepper.step(&mut world).unwrap();
        violation_m = violation_m.max(world.held.worst_violation(stepper.state()).unwrap().1);
        off = off.max((case.energy(stepper.state()) - energy).abs());
    }
    println!("{violation_m:e} m, energy within {off} J, {} redirected", world.redirected);
    // Bodies of 2 kg rise and fall by a metre. The motion is chaotic: what the energy is off by depends on every rounding.
    assert!(violation_m < 1e-12 && off < 0.5, "{violation_m:e} m, {off} J");
}

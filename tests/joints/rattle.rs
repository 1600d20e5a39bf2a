//! RATTLE on bodies: order, symmetry, energy.

use crate::cases::{Case, GRAVITY, after, distance, fly, inertia_tensor, medley, rattle_step, run, single, vector};
use ga_physics::algebra::g3::Rotor;
use ga_physics::ode::{Composition, Dop853};
use ga_physics::rigid::{Bodies, Forces, Form, Held, Inertia, Method, Motion, Setup, Solver, Steps, free};

#[test]
fn compositions_have_their_orders() {
    let case = medley();
    let reference = run::<Dop853>(&case, (0.005, 200), true);
    for (composition, coarse, tolerance) in
        [(Composition::Verlet, 80, 0.1), (Composition::Yoshida4, 160, 0.3), (Composition::Yoshida6, 80, 0.3)]
    {
        let [coarse, fine] = [coarse, 2 * coarse]
            .map(|steps| distance(&after(&case, composition, 1.0 / f64::from(steps), steps), &reference));
        let order = (coarse / fine).log2();
        println!("{composition:?} {coarse:e} {fine:e} {order}");
        assert!(
            (order - f64::from(composition.order())).abs() < tolerance,
            "{composition:?}: {coarse:e}, {fine:e}: {order}"
        );
    }
}

/// A step, a reversal of all momenta, and the same step lead back.
#[test]
fn a_step_is_symmetric() {
    let case = medley();
    for composition in [Composition::Verlet, Composition::Yoshida6] {
        let (mut bodies, mut world) = (case.bodies.clone(), case.world());
        let reverse = |bodies: &mut Bodies<f64>| {
            bodies.momentum.iter_mut().for_each(|p| *p = -*p);
            bodies.angular_momentum.iter_mut().for_each(|l| *l = -*l);
        };
        for _ in 0..10 {
            rattle_step(&mut world, &mut bodies, composition, 0.01);
        }
        let away = distance(&bodies, &case.bodies);
        reverse(&mut bodies);
        for _ in 0..10 {
            rattle_step(&mut world, &mut bodies, composition, 0.01);
        }
        let error = distance(&bodies, &case.bodies);
        println!("{composition:?}: {away} m away, back to {error:e} m");
        assert!(away > 0.1 && error < 1e-11, "{composition:?}: {error:e}");
        assert_eq!(world.redirected, 0);
    }
}

/// What RATTLE is for: free motion followed by a projection is on the joints too, but loses energy.
#[test]
fn projection_after_a_free_drift_is_worse() {
    let case = medley();
    let (h_s, steps) = (0.01, 500);
    let energy = case.energy(&case.bodies);
    let (mut bodies, mut world) = (case.bodies.clone(), case.world());
    let kick = |bodies: &mut Bodies<f64>| {
        for (momentum, inertia) in bodies.momentum.iter_mut().zip(&case.inertias) {
            *momentum += vector([0.0, 0.0, -GRAVITY]) * (inertia.mass * 0.5 * h_s);
        }
    };
    for _ in 0..steps {
        kick(&mut bodies);
        fly(&mut bodies, &case.inertias, h_s);
        kick(&mut bodies);
        world.held.project(&mut bodies).unwrap();
    }
    let lost = (case.energy(&bodies) - energy).abs();
    let kept = (case.energy(&after(&case, Composition::Verlet, h_s, steps)) - energy).abs();
    println!("projection is off by {lost} J, RATTLE by {kept} J");
    assert!(kept < 0.1 && lost > 10.0 * kept, "{lost} {kept}");
}

/// f32 rounds orientations to 6e-8: the joints hold to what that leaves of the arms, as long as one asks for.
#[test]
fn in_f32_the_joints_hold_to_the_rounding_of_the_arms() {
    let case = medley();
    let (mut bodies, inertias, joints) = single(&case);
    let mut held = Held::new(&joints, &bodies, &inertias, 1e-12).unwrap();
    let (h_s, mut violation_m, mut redirected) = (0.005_f32, 0.0_f64, 0);
    for _ in 0..1000 {
        for half in 0..2 {
            for (momentum, inertia) in bodies.momentum.iter_mut().zip(&inertias) {
                momentum.e3 -= 9.81 * inertia.mass * 0.5 * h_s;
            }
            if half == 0 {
                let straight = held.shake(&mut bodies, &inertias, f64::from(h_s), |bodies, inertias, h_s| {
                    for (i, inertia) in inertias.iter().enumerate() {
                        let moved = bodies.velocity(i, inertia).map(f64::from) * h_s;
                        bodies.position[i] = bodies.position[i].moved(moved);
                        bodies.rotor[i] = free::turn(inertia, bodies.rotor[i], bodies.angular_momentum[i], h_s);
                    }
                });
                redirected += u32::from(!straight.unwrap());
            }
        }
        held.project_velocities(&mut bodies).unwrap();
        violation_m = violation_m.max(held.worst_violation(&bodies).unwrap().1);
    }
    println!("{violation_m:e} m, {redirected} redirected");
    // Eight eps of the longest arm, 0.5 m.
    assert!(violation_m < 6e-7 && redirected == 0, "{violation_m:e} {redirected}");
}

/// A double pendulum that whips: bodies turn by 0.2 rad in a step of 0.01 s, and the impulses are still found along the
/// gradients at its start.
#[test]
fn long_steps_stay_along_the_gradients_at_their_start() {
    let inertia = Inertia::new(1.0, inertia_tensor([0.01, 0.02, 0.025], Rotor::default())).unwrap();
    let mut case = Case::default();
    let a = case.body([0.5, 0.0, 0.0], Rotor::default(), inertia);
    let b = case.body([1.5, 0.0, 0.0], Rotor::default(), inertia);
    case.hinge(a, None, [0.0; 3], [0.0, 1.0, 0.0]);
    case.hinge(b, Some(a), [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let forces = Forces { gravity: vector([0.0, 0.0, -GRAVITY]), forces: vec![] };
    let setup = Setup { inertias: case.inertias.clone(), forces, joints: case.joints.clone() };
    for (method, allowed) in [(Method::Verlet, 1.0), (Method::Yoshida4, 1.5), (Method::Yoshida6, 0.1)] {
        let solver = Solver { form: Form::Rotor, method, steps: Steps::Fixed { dt_s: 0.01 }, violation: 1e-12 };
        let mut bodies = case.bodies.clone();
        let mut motion = Motion::new(setup.clone(), &bodies, &solver).unwrap();
        let (mut fastest, mut off) = (0.0_f64, 0.0_f64);
        for step in 0..300 {
            motion.advance(&mut bodies, 0.01 * f64::from(step), 0.01).unwrap();
            fastest = fastest.max(bodies.omega_world(b, &inertia).norm_sq().sqrt());
            off = off.max((case.energy(&bodies) - case.energy(&case.bodies)).abs());
        }
        println!("{}: {fastest} rad/s, energy off by {off:e} J, {} redirected", method.name(), motion.redirected());
        assert!(fastest > 12.0 && motion.redirected() == 0, "{}: {fastest} {}", method.name(), motion.redirected());
        assert!(off < allowed, "{}: {off:e} J", method.name());
    }
}

//! Every force against its closed form.

use crate::cases::{adaptive, fixed, masses, particles, start, weight};
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::Vector;
use ga_physics::particle::{Force, Method, Setup};

fn one(force: Force<f64>, mass: f64) -> Setup<f64> {
    Setup { masses: masses(vec![mass], &[]), forces: vec![force], constraints: vec![] }
}

#[test]
fn a_projectile_falls_along_the_parabola() {
    let mut state = particles(&[[1.0, 2.0, 3.0]]);
    state.velocity[0] = Vector::new(4.0, 0.0, 5.0);
    let mut motion = start((state, one(weight(), 2.0)), &fixed(Method::Rk4, 0.1));
    motion.advance_to(1.5).unwrap();
    let at = motion.state().position[0];
    let expected = Point::new(7.0, 2.0, 3.0 + 7.5 - 0.5 * 9.81 * 2.25);
    assert!(at.distance_sq_to(expected).sqrt() < 1e-14, "{at}");
}

#[test]
fn drag_slows_as_theory_says() {
    let after = |force, mass: f64| {
        let mut state = particles(&[[0.0; 3]]);
        state.velocity[0] = Vector::new(3.0, 0.0, 4.0);
        let mut motion = start((state, one(force, mass)), &adaptive(Method::Dop853, 1e-12));
        motion.advance_to(2.0).unwrap();
        motion.state().velocity[0].norm_sq().sqrt()
    };
    // v = v0 exp(-k t / m) and 1/v = 1/v0 + k t / m.
    let linear = after(Force::LinearDrag { particle: None, k: 0.3 }, 2.0);
    let quadratic = after(Force::QuadraticDrag { particle: Some(0), k: 0.3 }, 2.0);
    assert!((linear / (5.0 * (-0.3_f64).exp()) - 1.0).abs() < 1e-11, "{linear}");
    assert!((quadratic * (1.0 / 5.0 + 0.3) - 1.0).abs() < 1e-11, "{quadratic}");
}

#[test]
fn a_damped_spring_rings_as_theory_says() {
    // Two masses on a spring: the reduced mass rings at sqrt(k/mu - (c/2mu)²).
    let mut state = particles(&[[0.0; 3], [1.5, 0.0, 0.0]]);
    let spring = Force::Spring { a: 0, b: 1, stiffness: 20.0, damping: 0.5, rest_length: 1.0 };
    let setup = Setup { masses: masses(vec![1.0, 3.0], &[]), forces: vec![spring], constraints: vec![] };
    state.velocity[1] = Vector::new(0.0, 0.0, 0.0);
    let mut motion = start((state, setup), &adaptive(Method::Dop853, 1e-13));
    let (mu, time_s): (f64, f64) = (0.75, 1.3);
    motion.advance_to(time_s).unwrap();
    let (decay, omega) = (0.5 / (2.0 * mu), (20.0 / mu - (0.5 / (2.0 * mu)).powi(2)).sqrt());
    let phase = omega * time_s;
    let stretch = 0.5 * (-decay * time_s).exp() * (phase.cos() + decay / omega * phase.sin());
    let [a, b] = [0, 1].map(|index| motion.state().position[index].x);
    assert!((b - a - 1.0 - stretch).abs() < 1e-11, "{}", b - a - 1.0 - stretch);
    // The centre of mass stays.
    assert!(((a + 3.0 * b) / 4.0 - 1.125).abs() < 1e-14);
}

#[test]
fn an_orbit_closes_and_keeps_energy_and_angular_momentum() {
    let eccentricity: f64 = 0.6;
    let mut state = particles(&[[1e6 + 1.0 - eccentricity, -2e6, 5e5]]);
    state.velocity[0] = Vector::new(0.0, ((1.0 + eccentricity) / (1.0 - eccentricity)).sqrt(), 0.0);
    let sun = Force::InverseSquareToPoint { point: Point::new(1e6, -2e6, 5e5), constant: 1.0, softening: 0.0 };
    // So far from the origin a coordinate resolves 2e-10 m: forces are still those of differences, and 14,000 drifts round.
    let solver = fixed(Method::Yoshida6, std::f64::consts::TAU / 2000.0);
    let mut motion = start((state.clone(), one(sun, 1.0)), &solver);
    motion.advance_to(std::f64::consts::TAU).unwrap();
    let error = motion.state().position[0].distance_sq_to(state.position[0]).sqrt();
    assert!(error < 2e-6, "{error:e}");
}

#[test]
fn two_bodies_circle_about_their_centre_of_mass() {
    // Masses 1 and 3 at distance 2: omega² = C (m1 + m2) / r³.
    let omega = (1.0_f64 * 4.0 / 8.0).sqrt();
    let mut state = particles(&[[-1.5, 0.0, 0.0], [0.5, 0.0, 0.0]]);
    state.velocity[0] = Vector::new(0.0, -1.5 * omega, 0.0);
    state.velocity[1] = Vector::new(0.0, 0.5 * omega, 0.0);
    let attraction = Force::InverseSquare { constant: 1.0, softening: 0.0 };
    let setup = Setup { masses: masses(vec![1.0, 3.0], &[]), forces: vec![attraction], constraints: vec![] };
    let mut motion = start((state.clone(), setup), &adaptive(Method::Dop853, 1e-13));
    let before = motion.totals();
    motion.advance_to(std::f64::consts::TAU / omega).unwrap();
    let after = motion.totals();
    for index in [0, 1] {
        let error = motion.state().position[index].distance_sq_to(state.position[index]).sqrt();
        assert!(error < 1e-10, "{error:e}");
    }
    assert!((after.energy() / before.energy() - 1.0).abs() < 1e-12);
    assert!(after.momentum.norm_sq().sqrt() < 1e-13);
    assert!((after.angular_momentum - before.angular_momentum).norm_sq().sqrt() < 1e-12);
}

#[test]
fn softening_keeps_a_head_on_meeting_finite() {
    let mut state = particles(&[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]);
    state.velocity[0] = Vector::default();
    let attraction = Force::InverseSquare { constant: 1.0, softening: 0.1 };
    let setup = Setup { masses: masses(vec![1.0, 1.0], &[]), forces: vec![attraction], constraints: vec![] };
    let mut motion = start((state, setup), &adaptive(Method::Dop853, 1e-11));
    let energy = motion.totals().energy();
    motion.advance_to(20.0).unwrap();
    assert!((motion.totals().energy() / energy - 1.0).abs() < 1e-7);
}

//! Pendulums: the period against the elliptic integral, the bad methods seen to be bad.

use crate::cases::{GRAVITY, adaptive, chain, distance, fixed, position_after, start};
use ga_physics::ode::{Adaptive, Crossing, Dop853, Event, Hit, Stepper, Tolerance, Watch};
use ga_physics::particle::{LinearSolver, Method, Particles, Rates, Solver, Stabilisation, System};

/// `T = 4 K(sin(amplitude/2)) sqrt(l/g)`, and `K(k) = pi / (2 agm(1, k'))` (Gauss 1799).
fn period(amplitude_rad: f64, length: f64) -> f64 {
    let (mut a, mut b) = (1.0_f64, (0.5 * amplitude_rad).cos());
    while (a - b).abs() > 1e-15 * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    2.0 * std::f64::consts::PI / a * (length / GRAVITY).sqrt()
}

#[test]
fn a_period_is_that_of_the_elliptic_integral() {
    for amplitude_rad in [0.01, 0.7, 1.5, 2.5, 3.0, 3.1] {
        let expected_s = period(amplitude_rad, 1.0);
        let (state, setup) = chain(1, amplitude_rad);
        let tolerance = Tolerance { rtol: 1e-13, atol: 1e-13 };
        let mut system = System::new(setup, &state, &adaptive(Method::Dop853, 1e-13)).unwrap();
        let mut stepper = Adaptive::<Dop853, _, _>::new(0.0, state.clone(), Rates::zeros(2), tolerance).unwrap();
        let below = Event::new(Crossing::Either, |_, state: &Particles<f64>| state.position[1].x);
        let (mut watch, mut out, mut times) = (Watch::new(0.0, [below]), state, Vec::new());
        let mut seen = |hit: Hit, _: &Particles<f64>| times.push(hit.time_s);
        stepper.advance_watching(&mut system, 0.9 * expected_s, &mut watch, &mut out, &mut seen).unwrap();
        // Half a period between them.
        let error = (2.0 * (times[1] - times[0]) / expected_s - 1.0).abs();
        assert!(times.len() == 2 && error < 1e-9, "{amplitude_rad} rad: {error:e}");
        println!("{amplitude_rad} rad: {error:e}");
    }
}

#[test]
fn every_exact_method_holds_the_length_and_finds_the_same_motion() {
    let time_s = 2.0;
    let reference = position_after(chain(2, 0.7), &adaptive(Method::Dop853, 1e-13), 2, time_s);
    let cases = [
        (fixed(Method::Rk4, 1e-3), 1e-9),
        (fixed(Method::CashKarp, 1e-2), 1e-8),
        (fixed(Method::Tsit5, 1e-2), 1e-8),
        (fixed(Method::Dop853, 1e-2), 1e-12),
        (fixed(Method::Verlet, 1e-4), 1e-6),
        (fixed(Method::Yoshida4, 1e-3), 1e-8),
        (fixed(Method::Yoshida6, 5e-3), 1e-8),
        (adaptive(Method::Rk4Doubling, 1e-10), 1e-8),
        (adaptive(Method::CashKarp, 1e-10), 1e-8),
        (adaptive(Method::Tsit5, 1e-10), 1e-8),
        (Solver { linear: LinearSolver::ConjugateGradients, ..fixed(Method::Rk4, 1e-3) }, 1e-9),
    ];
    for (solver, allowed) in cases {
        let mut motion = start(chain(2, 0.7), &solver);
        motion.advance_to(time_s).unwrap();
        let error = distance(motion.state().position[2], reference);
        assert!(error < allowed, "{:?}: {error:e}", solver.method);
        let (_, violation_m) = motion.worst_violation().unwrap();
        assert!(violation_m < 1e-12, "{:?}: {violation_m:e}", solver.method);
    }
}

/// Errata of the report's (24): without stabilisation the lengths drift, Baumgarte's terms bound the drift, projection ends it.
#[test]
fn what_is_not_stabilised_drifts() {
    let violation = |stabilisation| {
        let solver = Solver { stabilisation, ..fixed(Method::Rk4, 1.0 / 240.0) };
        let mut motion = start(chain(3, 1.5), &solver);
        let mut worst = 0.0_f64;
        for frame in 1..=100 {
            motion.advance_to(0.1 * f64::from(frame)).unwrap();
            worst = worst.max(motion.worst_violation().unwrap().1);
        }
        worst
    };
    let none = violation(Stabilisation::None);
    let baumgarte = violation(Stabilisation::Baumgarte { rate: 5.0 });
    let projection = violation(Stabilisation::Projection);
    assert!(none > 1e-5 && baumgarte < 0.1 * none && projection < 1e-12, "{none:e} {baumgarte:e} {projection:e}");
}

#[test]
fn a_symplectic_method_keeps_the_energy_of_a_long_swing_and_euler_does_not() {
    let drift = |solver: &Solver, seconds: u32| {
        let mut motion = start(chain(1, 1.0), solver);
        let energy = motion.totals().energy();
        let mut worst = 0.0_f64;
        for second in 1..=seconds {
            motion.advance_to(f64::from(second)).unwrap();
            worst = worst.max((motion.totals().energy() - energy).abs());
        }
        worst
    };
    let [verlet, yoshida] = [Method::Verlet, Method::Yoshida4].map(|method| drift(&fixed(method, 0.01), 200));
    let euler = drift(&fixed(Method::Euler, 0.01), 10);
    assert!(verlet < 2e-2 && yoshida < 1e-5 && euler > 1.0, "{verlet:e} {yoshida:e} {euler:e}");
}

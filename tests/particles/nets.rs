//! Nets: they snap taut without blowing up, redundant constraints are found and told.

use crate::cases::{chain, fixed, net, particles, start};
use ga_physics::particle::{Constraint, LinearSolver, Method, Solver};

#[test]
fn a_folded_net_snaps_taut_and_nothing_blows_up() {
    for (method, linear, violation) in [
        (Method::Verlet, LinearSolver::Direct, 1e-9),
        (Method::Verlet, LinearSolver::ConjugateGradients, 1e-9),
        (Method::Xpbd, LinearSolver::Direct, 1e-9),
        (Method::Xpbd, LinearSolver::Sweeps, 1e-2),
    ] {
        let solver = Solver { linear, violation, ..fixed(method, 1.0 / 240.0) };
        let mut motion = start(net(8, std::f64::consts::FRAC_PI_3), &solver);
        let energy = motion.totals().energy();
        for frame in 1..=30 {
            motion.advance_to(f64::from(frame) / 60.0).unwrap();
            let (_, violation_m) = motion.worst_violation().unwrap();
            assert!(violation_m <= 1.001 * violation * 0.1, "{method:?}: {violation_m:e}");
            let gained = motion.totals().energy() - energy;
            assert!(
                gained < 1e-2 * motion.totals().kinetic.abs().max(1e-3),
                "{method:?} {linear:?} frame {frame} gained {gained:e}"
            );
        }
    }
}

/// Errata of (24): a flat net with a straight top edge between two pins. Its rows are dependent at the start.
#[test]
fn a_flat_net_with_a_straight_edge_is_told_to_be_redundant_and_runs() {
    let solver = Solver { violation: 1e-6, ..fixed(Method::Verlet, 1.0 / 240.0) };
    let mut motion = start(net(5, 0.0), &solver);
    motion.advance_to(0.3).unwrap();
    assert!(motion.system().redundant() > 0);
    let (_, violation_m) = motion.worst_violation().unwrap();
    assert!(violation_m <= 1e-7, "{violation_m:e}");
    // The edge cannot sag, the rest swings down.
    let z = |index: usize| motion.state().position[index].z;
    assert!(z(2).abs() < 1e-2 && z(22) < -0.2, "{} {}", z(2), z(22));
}

#[test]
fn a_constraint_that_is_named_twice_changes_nothing() {
    let once = start(chain(3, 0.8), &fixed(Method::Rk4, 1e-2));
    let (state, mut setup) = chain(3, 0.8);
    setup.constraints.push(Constraint::Distance { a: 2, b: 1, length: 1.0 });
    let mut runs = [once, start((state, setup), &fixed(Method::Rk4, 1e-2))];
    for motion in &mut runs {
        motion.advance_to(1.0).unwrap();
    }
    assert_eq!(runs.each_ref().map(|motion| motion.system().redundant()), [0, 1]);
    let apart = |index: usize| runs[0].state().position[index].distance_sq_to(runs[1].state().position[index]);
    assert!((0..4).all(|index| apart(index) < 1e-20));
}

#[test]
fn what_nothing_moves_stays_to_the_bit() {
    for method in [Method::Rk4, Method::Dop853, Method::Verlet, Method::Yoshida6, Method::Xpbd] {
        let mut motion = start(chain(4, 1.2), &fixed(method, 1e-2));
        motion.advance_to(1.0).unwrap();
        assert_eq!(motion.state().position[0], particles(&[[0.0; 3]]).position[0], "{method:?}");
    }
}

//! What every joint must do, whatever the method.

use crate::cases::{medley, run};
use ga_physics::ode::{Dop853, Rk4};

/// Without projection, what is left of the joints is the error of the integrator: a wrong gradient or curvature would leave
/// an error that no step makes smaller.
#[test]
fn accelerations_keep_the_joints_to_the_order_of_the_method() {
    let case = medley();
    let violation = |steps: u32| {
        let mut world = case.world();
        let end = run::<Rk4>(&case, (0.2 / f64::from(steps), steps), false);
        world.held.worst_violation(&end).unwrap().1
    };
    let [coarse, fine] = [50, 100].map(violation);
    let order = (coarse / fine).log2();
    assert!((order - 4.0).abs() < 0.3, "violations {coarse:e}, {fine:e}: order {order}");
}

/// Joints do no work.
#[test]
fn energy_is_kept() {
    let case = medley();
    let end = run::<Dop853>(&case, (0.01, 100), false);
    let error = (case.energy(&end) / case.energy(&case.bodies) - 1.0).abs();
    assert!(error < 1e-11, "{error:e}");
}

//! RATTLE on bodies: order, symmetry, energy.

use crate::cases::{after, distance, medley, rattle_step, run};
use ga_physics::ode::{Composition, Dop853};

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
        let reverse = |bodies: &mut ga_physics::rigid::Bodies<f64>| {
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

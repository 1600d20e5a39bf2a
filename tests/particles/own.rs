//! Forces and constraints of one's own: their derivatives are those of the built-in ones.

use crate::cases::{GRAVITY, adaptive, chain, distance, fixed, masses, particles, position_after, start, weight};
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::Vector;
use ga_physics::particle::{
    Constraint, ConstraintFunction, Differentiable, Force, ForceLaw, Method, OwnConstraint, OwnForce, OwnPotential,
    Potential, Setup,
};

/// The distance of two particles, as one would write it.
struct Distance(f64);

impl ConstraintFunction for Distance {
    fn value<S: Differentiable>(&self, at: &[Point<S>]) -> S {
        at[0].distance_sq_to(at[1]).sqrt() - S::from(self.0)
    }
}

#[test]
fn a_constraint_of_ones_own_moves_as_the_built_in_one() {
    let built_in = position_after(chain(2, 0.7), &adaptive(Method::Dop853, 1e-12), 2, 1.5);
    let (state, mut setup) = chain(2, 0.7);
    setup.constraints = vec![
        Constraint::Own(OwnConstraint::new([0, 1], Distance(1.0))),
        Constraint::Own(OwnConstraint::new([1, 2], Distance(1.0))),
    ];
    for solver in [adaptive(Method::Dop853, 1e-12), fixed(Method::Yoshida6, 5e-3)] {
        let own = position_after((state.clone(), setup.clone()), &solver, 2, 1.5);
        assert!(distance(own, built_in) < 1e-7, "{:?}: {:e}", solver.method, distance(own, built_in));
    }
}

/// A uniform field and a spring to the origin.
struct Bowl;

impl Potential for Bowl {
    fn energy<S: Differentiable>(&self, at: &[Point<S>]) -> S {
        let Point { x, y, z } = at[0];
        (x * x + y * y + z * z) * S::ratio(2, 1) + z * S::from(GRAVITY)
    }
}

/// What turns a velocity about z without work.
struct Coriolis;

impl ForceLaw for Coriolis {
    fn force(&self, _t_s: f64, _at: &[Point<f64>], velocity: &[Vector<f64>], force: &mut [Vector<f64>]) {
        force[0] = Vector::new(2.0 * velocity[0].e2, -2.0 * velocity[0].e1, 0.0);
    }
}

#[test]
fn forces_of_ones_own_act_as_written() {
    let mut state = particles(&[[1.0, 0.0, 0.0]]);
    state.velocity[0] = Vector::new(0.0, 1.0, 0.0);
    let own = vec![Force::Potential(OwnPotential::new([0], Bowl)), Force::Law(OwnForce::new([0], Coriolis))];
    let setup = Setup { masses: masses(vec![1.0], &[]), forces: own, constraints: vec![] };
    let mut motion = start((state, setup), &adaptive(Method::Dop853, 1e-12));
    let energy = motion.totals().energy();
    motion.advance_to(3.0).unwrap();
    assert!((motion.totals().energy() - energy).abs() < 1e-10, "the potential is the force's, the other does no work");
    // Along z a forced oscillator of its own: z'' = -4 z - g.
    let z = -GRAVITY / 4.0 * (1.0 - (2.0_f64 * 3.0).cos());
    assert!((motion.state().position[0].z - z).abs() < 1e-10);
}

#[test]
fn a_bead_stays_on_a_surface_that_is_only_a_formula() {
    struct Torus;
    impl ConstraintFunction for Torus {
        fn value<S: Differentiable>(&self, at: &[Point<S>]) -> S {
            let Point { x, y, z } = at[0];
            let ring = (x * x + y * y).sqrt() - S::from(2.0);
            ring * ring + z * z - S::from(0.25)
        }
    }
    let constraints = vec![Constraint::Own(OwnConstraint::new([0], Torus))];
    let setup = Setup { masses: masses(vec![1.0], &[]), forces: vec![weight()], constraints };
    let mut state = particles(&[[2.0, 0.0, 0.5]]);
    state.velocity[0] = Vector::new(0.3, 1.0, 0.0);
    let mut motion = start((state, setup), &adaptive(Method::Dop853, 1e-10));
    let energy = motion.totals().energy();
    for frame in 1..=50 {
        motion.advance_to(0.1 * f64::from(frame)).unwrap();
        let Point { x, y, z } = motion.state().position[0];
        assert!((((x * x + y * y).sqrt() - 2.0).hypot(z) - 0.5).abs() < 1e-12);
    }
    assert!((motion.totals().energy() - energy).abs() < 1e-7);
}

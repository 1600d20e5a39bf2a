//! What cannot be simulated says so, by name.

use crate::cases::{adaptive, chain, fixed, masses, particles, start, weight};
use ga_physics::constraint::ProjectionError;
use ga_physics::ode::{OdeError, StepError, ToleranceError};
use ga_physics::particle::{
    Constraint, Force, LinearSolver, Method, Motion, MotionError, Setup, SetupError, Solver, SolverError,
};

#[test]
fn a_solver_that_cannot_be_used_is_refused() {
    let refused = |solver: &Solver| {
        let (state, setup) = chain(1, 0.5);
        Motion::new(setup, state, solver).err().unwrap()
    };
    assert_eq!(refused(&adaptive(Method::Verlet, 1e-6)), SolverError::NotAdaptive(Method::Verlet));
    assert!(matches!(
        refused(&adaptive(Method::Dop853, 1e-16)),
        SolverError::Tolerance(ToleranceError::Relative { .. })
    ));
    assert_eq!(refused(&fixed(Method::Rk4, -0.1)), SolverError::Step(StepError { step_s: -0.1 }));
    let sweeps = Solver { linear: LinearSolver::Sweeps, ..fixed(Method::Rk4, 0.1) };
    assert_eq!(refused(&sweeps), SolverError::NeedsMultipliers(Method::Rk4));
}

#[test]
fn constraints_that_contradict_each_other_end_the_run_by_name() {
    for method in [Method::Rk4, Method::Dop853, Method::Verlet, Method::Xpbd] {
        let (state, mut setup) = chain(2, 0.5);
        setup.constraints.push(Constraint::Distance { a: 0, b: 1, length: 1.1 });
        let mut motion = start((state, setup), &fixed(method, 1e-2));
        let error = motion.advance_to(1.0).unwrap_err();
        let OdeError::System(MotionError::Projection {
            source: ProjectionError::NotConverged { violation_m, .. }, ..
        }) = error
        else {
            panic!("{method:?}: {error}");
        };
        assert!(violation_m > 1e-2, "{violation_m}");
        assert!(motion.state().position.iter().all(|x| x.x.is_finite() && x.z.is_finite()));
    }
}

#[test]
fn a_meeting_without_softening_is_told_when_it_happens() {
    let attraction = Force::InverseSquare { constant: 1.0, softening: 0.0 };
    let setup = Setup { masses: masses(vec![1.0, 1.0], &[]), forces: vec![attraction], constraints: vec![] };
    let mut motion = start((particles(&[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]), setup), &adaptive(Method::Dop853, 1e-9));
    let error = motion.advance_to(10.0).unwrap_err();
    let OdeError::StepTooSmall { time_s, .. } = error else { panic!("{error}") };
    // Free fall of two masses of 1 from rest at distance 2: pi/2 sqrt(r³ / (2 C M)) with M = 2.
    let expected_s = std::f64::consts::FRAC_PI_2 * (8.0_f64 / 4.0).sqrt();
    assert!((time_s - expected_s).abs() < 1e-3, "{time_s} {expected_s}");
    assert_eq!(motion.time_s(), time_s);
    assert!(motion.state().position.iter().all(|x| x.x.is_finite()));
}

#[test]
fn steps_that_overflow_are_told() {
    let setup = Setup {
        masses: masses(vec![1e-9], &[]),
        forces: vec![weight(), Force::QuadraticDrag { particle: None, k: 1e6 }],
        constraints: vec![],
    };
    let mut state = particles(&[[0.0; 3]]);
    state.velocity[0].e1 = 10.0;
    let mut motion = start((state, setup), &fixed(Method::Rk4, 0.1));
    let error = motion.advance_to(100.0).unwrap_err();
    assert!(matches!(error, OdeError::NotFinite { .. }), "{error}");
}

#[test]
fn a_setup_that_is_not_sound_is_refused() {
    let refused = |spoil: &dyn Fn(&mut Setup<f64>, &mut ga_physics::particle::Particles<f64>)| {
        let (mut state, mut setup) = chain(2, 0.5);
        spoil(&mut setup, &mut state);
        match Motion::new(setup, state, &fixed(Method::Rk4, 0.1)).err() {
            Some(SolverError::Setup(error)) => error,
            other => panic!("{other:?}"),
        }
    };
    assert!(matches!(refused(&|setup, _| setup.masses.mass.truncate(1)), SetupError::Sizes { masses: 1, .. }));
    assert!(matches!(refused(&|setup, _| setup.masses.inv_mass[1] = -1.0), SetupError::Mass { particle: 1, .. }));
    assert!(matches!(refused(&|_, state| state.position[2].y = f64::NAN), SetupError::NotFinite { particle: 2 }));
    let drag = |setup: &mut Setup<f64>, _: &mut _| setup.forces.push(Force::LinearDrag { particle: Some(7), k: 1.0 });
    let expected = SetupError::NoSuchParticleOfForce { force: 1, particle: 7, particles: 3 };
    assert_eq!(refused(&drag), expected);
    let link = |a, b, length| {
        move |setup: &mut Setup<f64>, _: &mut _| {
            setup.constraints[1] = Constraint::Distance { a, b, length };
        }
    };
    assert_eq!(refused(&link(0, 3, 1.0)), SetupError::NoSuchParticle { constraint: 1, particle: 3, particles: 3 });
    assert_eq!(refused(&link(1, 1, 1.0)), SetupError::Distance { constraint: 1, length_m: 1.0 });
    assert_eq!(refused(&link(1, 2, 0.0)), SetupError::Distance { constraint: 1, length_m: 0.0 });
}

/// Methods that do not estimate their error do not see it grow.
#[test]
fn what_runs_away_is_told_by_every_method() {
    let all = [Method::Euler, Method::Rk4, Method::Verlet, Method::Yoshida4, Method::Yoshida6, Method::Xpbd];
    for method in all {
        let spring = Force::Spring { a: 0, b: 1, stiffness: 1e6, damping: 0.0, rest_length: 0.9 };
        let setup = Setup { masses: masses(vec![1.0, 1.0], &[0]), forces: vec![spring], constraints: vec![] };
        let state = particles(&[[0.0; 3], [0.0, 0.0, 1.0]]);
        let mut motion = start((state, setup), &fixed(method, 0.01));
        let failed = (1..=1000).find_map(|step| motion.advance_to(0.01 * f64::from(step)).err());
        assert!(matches!(failed, Some(OdeError::NotFinite { .. })), "{method:?}: {failed:?}");
    }
}

/// A run that ends within a step does not pay for what would come after.
#[test]
fn the_last_step_ends_with_the_run() {
    let mut motion = start(chain(1, 0.5), &fixed(Method::Tsit5, 0.2));
    motion.stop_at(0.3);
    motion.advance_to(0.3).unwrap();
    assert_eq!((motion.time_s(), motion.work().accepted), (0.3, 2));
}

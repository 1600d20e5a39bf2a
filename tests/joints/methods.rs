//! Every method in every formulation holds the same joints and finds the same motion.

use crate::cases::{GRAVITY, distance, medley, vector};
use ga_physics::ode::Tolerance;
use ga_physics::rigid::{Forces, Form, Method, Motion, Setup, Solver, SolverError, Steps};

#[test]
fn all_find_the_same_motion() {
    let case = medley();
    let forces = Forces { gravity: vector([0.0, 0.0, -GRAVITY]), forces: vec![] };
    let setup = Setup { inertias: case.inertias.clone(), forces, joints: case.joints.clone() };
    let end = |form: Form, method: Method, steps: Steps| {
        let mut bodies = case.bodies.clone();
        let mut motion = Motion::new(setup.clone(), &bodies, &Solver { form, method, steps, violation: 1e-12 })?;
        motion.advance(&mut bodies, 0.0, 0.4).unwrap();
        let violation_m = motion.worst_violation(&bodies).unwrap();
        assert!(violation_m < 1e-12, "{} in {}: {violation_m:e} m", method.name(), form.name());
        assert_eq!((motion.redundant(), motion.redirected()), (0, 0));
        Ok::<_, SolverError>(bodies)
    };
    let tight = Steps::Adaptive { tolerance: Tolerance { rtol: 1e-12, atol: 1e-12 } };
    let reference = end(Form::Rotor, Method::Dop853, tight).unwrap();
    let mut tried = 0;
    for form in Form::ALL {
        for method in Method::ALL.into_iter().filter(|method| method.fits(form) && *method != Method::FreeFlight) {
            let order_2 = matches!(method, Method::Verlet | Method::Splitting2);
            let adaptive = Steps::Adaptive { tolerance: Tolerance { rtol: 1e-8, atol: 1e-8 } };
            let steps = if method.is_adaptive() { adaptive } else { Steps::Fixed { dt_s: 4e-3 } };
            let bodies = match end(form, method, steps) {
                Ok(bodies) => bodies,
                Err(SolverError::ForStudies) => continue,
                Err(error) => panic!("{} in {}: {error}", method.name(), form.name()),
            };
            let error = distance(&bodies, &reference);
            println!("{} in {}: {error:e}", method.name(), form.name());
            assert!(error < if order_2 { 1e-3 } else { 1e-6 }, "{} in {}: {error:e}", method.name(), form.name());
            tried += 1;
        }
    }
    assert!(tried >= 18, "{tried}");
}

//! Orientations stay orientations, but for the matrix, which drifts by as much as theory says; lost ones are named.

use super::ways::{Case, Pace, spinning, ways};
use ga_physics::algebra::g3::{Even, Rotor};
use ga_physics::ode::{Rk4, RungeKutta};
use ga_physics::rigid::{Bodies, Formulation, OrientationLost, matrix, motor, quaternion, rotor};

#[test]
fn versors_are_unit_after_every_step() {
    let case: Case<f64> = spinning(1.0, [1.0, 2.0, 3.0], [1.0, 2.0, 1.5]);
    for way in ways().into_iter().filter(|way| way.form != "matrix") {
        let end = way.run(&case, Pace::Fixed(0.05), 10.0);
        assert!(end.rotor[0].is_unit(4.0 * f64::EPSILON), "{}", way.name());
    }
}

/// Steps a sphere's matrix n times by an angle of z = |omega| h each, and gives its drift.
fn matrix_drift(z: f64, steps: u32) -> f64 {
    let case: Case<f64> = spinning(1.0, [1.0; 3], [0.0, 0.0, 1.0]);
    let mut state = matrix::State::from_bodies(&case.bodies);
    let mut rk4 = RungeKutta::<Rk4, _, f64>::new(state.clone(), state.zero_rates());
    let mut system = case.system();
    for _ in 0..steps {
        matrix::advance(&mut state, &mut rk4, &mut system, 0.0, z).unwrap();
    }
    matrix::drift::<f64>(&state.orientation[0])
}

#[test]
fn a_matrix_shrinks_as_the_amplification_of_runge_and_kuttas_method_says() {
    // A turn by z is multiplied by `1 + iz - z²/2 - iz³/6 + z⁴/24`, of squared modulus `1 - z⁶/72 + z⁸/576`: so much of the
    // length of the columns in the plane of rotation is left after each step.
    for (z, steps) in [(0.1_f64, 1000), (0.3, 1000), (0.5, 3000)] {
        let kept = (1.0 - z.powi(6) / 72.0 + z.powi(8) / 576.0).powi(i32::try_from(steps).unwrap());
        let drift = matrix_drift(z, steps);
        println!("{z} rad a step, {steps} steps: R^T R - 1 is {drift:e}");
        // The rounding of each step counts 1e-16.
        assert!((drift - (1.0 - kept)).abs() < 1e-6 * drift, "{z} rad a step: {drift:e}, not {:e}", 1.0 - kept);
    }
    // The report's footnote 17: a few thousand steps of a fast spin distort the body thoroughly.
    assert!(matrix_drift(0.5, 3000) > 0.4);
}

#[test]
fn a_matrix_drifts_where_the_others_do_not_and_can_be_mended() {
    let case: Case<f64> = spinning(1.0, [1.0, 2.0, 3.0], [3.0, 20.0, 3.0]);
    let mut state = matrix::State::from_bodies(&case.bodies);
    let mut rk4 = RungeKutta::<Rk4, _, f64>::new(state.clone(), state.zero_rates());
    let mut system = case.system();
    let mut before = 0.0;
    for _ in 0..5 {
        for _ in 0..200 {
            matrix::advance(&mut state, &mut rk4, &mut system, 0.0, 0.01).unwrap();
        }
        let drift = matrix::drift::<f64>(&state.orientation[0]);
        assert!(drift > before, "{drift:e} after {before:e}");
        before = drift;
    }
    assert!(before > 1e-5, "{before:e}");
    // Bodies take the matrix over as it is; a run that goes on from them goes on drifting.
    let mut bodies = case.bodies;
    state.write_to(&mut bodies);
    assert_eq!(matrix::State::from_bodies(&bodies), state);
    assert!(bodies.rotor[0].is_unit(4.0 * f64::EPSILON));
    matrix::renormalise(&mut state).unwrap();
    assert!(matrix::drift::<f64>(&state.orientation[0]) < 8.0 * f64::EPSILON);
}

/// A state of two bodies that has drifted by a stage's amount.
fn drifted<F: Formulation<f64>>() -> F {
    let case: Case<f64> = spinning(1.0, [1.0, 2.0, 3.0], [0.4, 0.5, 0.6]);
    let mut bodies = case.bodies.clone();
    bodies.push(bodies.position[0], bodies.rotor[0], bodies.momentum[0], bodies.angular_momentum[0]);
    let inertias = vec![case.setup.inertias[0]; 2];
    let mut state = F::from_bodies(&bodies);
    let mut rates = state.zero_rates();
    state.rhs(&inertias, &ga_physics::rigid::Wrenches::zeros(2), &mut rates);
    state.add_scaled(&[(0.3, &rates)]);
    state
}

#[test]
fn renormalising_twice_is_renormalising_once() {
    fn check<F: Formulation<f64>>(name: &str, renormalise: impl Fn(&mut F) -> Result<(), OrientationLost>) {
        let numbers = |state: &F| {
            let mut bodies = Bodies::default();
            let none = (Default::default(), Rotor::default(), Default::default(), Default::default());
            (0..state.len()).for_each(|_| bodies.push(none.0, none.1, none.2, none.3));
            state.write_to(&mut bodies);
            let matrices = bodies.matrix.iter().flat_map(|matrix| matrix.iter().copied().collect::<Vec<f64>>());
            let rotors = bodies.rotor.iter().flat_map(|rotor| <[f64; 4]>::from(*rotor));
            let places = bodies.position.iter().flat_map(|position| <[f64; 3]>::from(*position));
            rotors.chain(places).chain(matrices).collect::<Vec<f64>>()
        };
        let mut state: F = drifted();
        renormalise(&mut state).unwrap();
        let once = numbers(&state);
        renormalise(&mut state).unwrap();
        let worst = once.iter().zip(numbers(&state)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // An ulp; some of the iterated singular values of the matrix.
        assert!(worst <= 8.0 * f64::EPSILON, "{name}: {worst:e}");
    }
    check::<quaternion::State<f64>>("quaternion", quaternion::renormalise);
    check::<Bodies<f64>>("rotor", rotor::renormalise);
    check::<motor::State<f64>>("motor", motor::renormalise);
    check::<matrix::State<f64>>("matrix", matrix::renormalise);
}

#[test]
fn a_motor_is_brought_back_in_both_parts_and_its_anchor_follows() {
    let mut state: motor::State<f64> = drifted();
    state.motor[0].e1_ninf += 0.25;
    state.motor[0].e123_ninf += 0.125;
    motor::renormalise(&mut state).unwrap();
    assert!(state.motor.iter().all(|motor| motor.is_unit(4.0 * f64::EPSILON)));
    let translation = state.motor[0].translation();
    assert_eq!((translation.e1, translation.e2, translation.e3), (0.0, 0.0, 0.0));
    assert_eq!(state.position(0), state.anchor[0]);
}

/// Numbers of the orientation's rate, of a turned and of a measured vector, in a state and in one of another norm.
fn of_any_norm<F: Formulation<f64>>(scale: impl Fn(&mut F), rate: impl Fn(&F::Rate) -> Vec<f64>) {
    const NORM: f64 = 1.25;
    let case: Case<f64> = spinning(1.0, [1.0, 2.0, 3.0], [0.4, 0.5, 0.6]);
    let inertia = &case.setup.inertias[0];
    let unit = F::from_bodies(&case.bodies);
    let mut other = unit.clone();
    scale(&mut other);
    let seen = |state: &F| {
        let mut rates = state.zero_rates();
        state.rhs(&case.setup.inertias, &ga_physics::rigid::Wrenches::zeros(1), &mut rates);
        let x = state.to_world(0, ga_physics::algebra::g3::Vector::new(1.0, 2.0, 3.0));
        let omega = state.omega_world(0, inertia);
        (rate(&rates), [<[f64; 3]>::from(x), omega.into()].concat())
    };
    let ((rate, turned), (other_rate, other_turned)) = (seen(&unit), seen(&other));
    let same = |a: &[f64], b: &[f64], factor: f64| a.iter().zip(b).all(|(a, b)| (a * factor - b).abs() < 1e-14);
    assert!(same(&rate, &other_rate, NORM), "{rate:?}, {other_rate:?}");
    assert!(same(&turned, &other_turned, 1.0), "{turned:?}, {other_turned:?}");
}

#[test]
fn an_orientation_of_any_norm_stands_for_one_rotation() {
    // So the stages of a step, which are not unit, see the right angular velocity and the right places.
    of_any_norm::<Bodies<f64>>(
        |state| state.rotor[0] = state.rotor[0].map(|x| x * 1.25),
        |rates| <[f64; 4]>::from(rates.rotor[0]).to_vec(),
    );
    of_any_norm::<quaternion::State<f64>>(
        |state| state.orientation[0] *= 1.25,
        |rates| rates.orientation[0].coords.iter().copied().collect(),
    );
    of_any_norm::<motor::State<f64>>(
        |state| state.motor[0] = state.motor[0].map(|x| x * 1.25),
        |rates| [<[f64; 4]>::from(rates.even[0]), rates.odd[0].into()].concat(),
    );
}

#[test]
fn a_lost_orientation_is_named_with_its_body() {
    fn lost<F: Formulation<f64>>(spoil: impl Fn(&mut F)) -> OrientationLost {
        let mut state: F = drifted();
        spoil(&mut state);
        state.renormalise().unwrap_err()
    }
    for size in [0.0, 1e-200, 1e200, f64::NAN] {
        let errors = [
            lost::<Bodies<f64>>(|state| state.rotor[1] = Rotor::new(size, 0.0, 0.0, 0.0)),
            lost::<quaternion::State<f64>>(|state| {
                state.orientation[1] = nalgebra::Quaternion::new(size, 0.0, 0.0, 0.0)
            }),
            lost::<motor::State<f64>>(|state| state.motor[1] = state.motor[1].map(|x| x * 0.0 + size)),
            lost::<matrix::State<f64>>(|state| {
                state.orientation[1] *= if size == 1e200 { f64::INFINITY } else { -size }
            }),
        ];
        for error in errors {
            assert_eq!(error.body_idx, 1);
            assert!(error.to_string().contains("body 1"), "{error}");
        }
    }
    assert!(Rotor::normalise(Even::new(0.0, 0.0, 0.0, 0.0)).is_err());
}

//! The frames of the report's equations, and that its misprints fail.

use super::reference::{quaternion, split};
use super::ways::{Case, diagonal, spinning};
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::{Bivector, Rotor, Vector};
use ga_physics::ode::{Rk4, RungeKutta};
use ga_physics::rigid::{Bodies, Formulation, Inertia, Wrenches, matrix, rotor};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

const MOMENTS: [f64; 3] = [1.0, 2.0, 2.5];
const OMEGA: [f64; 3] = [0.3, 0.2, 0.4];
const DURATION_S: f64 = 4.0;
const STEPS: u32 = 200;
/// Of RK4 with these steps, and what a misprint surely exceeds, rad.
const RIGHT: f64 = 1e-8;
const WRONG: f64 = 0.05;

fn reference() -> UnitQuaternion<f64> {
    split(MOMENTS, OMEGA, UnitQuaternion::identity(), DURATION_S, 2000)
}

/// Runs a formulation with rates that are changed after its own right-hand side.
fn run<F: Formulation<f64>>(case: &Case<f64>, change: impl Fn(&F, &Inertia<f64>, &mut F::Rate)) -> UnitQuaternion<f64>
where
    F::Rate: Clone,
{
    let mut state = F::from_bodies(&case.bodies);
    let mut rk4 = RungeKutta::<Rk4, F, f64>::new(state.clone(), state.zero_rates());
    let (inertias, wrenches) = (&case.setup.inertias, Wrenches::zeros(1));
    let mut system = |_: f64, state: &F, rates: &mut F::Rate| {
        state.rhs(inertias, &wrenches, rates);
        change(state, &inertias[0], rates);
    };
    for _ in 0..STEPS {
        let Ok(()) = rk4.step(&mut state, 0.0, DURATION_S / f64::from(STEPS), &mut system);
        state.renormalise().unwrap();
    }
    let mut bodies = case.bodies.clone();
    state.write_to(&mut bodies);
    quaternion(bodies.rotor[0])
}

#[test]
fn the_inertia_turns_with_the_body_from_both_sides() {
    // The report prints I(t) = R I_body: then omega_world = I_body^-1 R^T L, and Rdot = omega* R with that.
    let case = spinning(1.0, MOMENTS, OMEGA);
    let right = run::<matrix::State<f64>>(&case, |_, _, _| ());
    assert!(right.angle_to(&reference()) < RIGHT);
    let misprinted = run::<matrix::State<f64>>(&case, |state, _, rates| {
        let r = state.orientation[0];
        let inverse = Matrix3::from_diagonal(&Vector3::from(MOMENTS.map(|moment| 1.0 / moment)));
        rates.orientation[0] = (inverse * r.transpose() * state.angular_momentum[0]).cross_matrix() * r;
    });
    assert!(misprinted.angle_to(&reference()) > WRONG, "{}", misprinted.angle_to(&reference()));
}

#[test]
fn the_bodys_angular_velocity_stands_on_the_right_of_the_rotor() {
    // The report prints Rdot = -1/2 Omega_body R.
    let case = spinning(1.0, MOMENTS, OMEGA);
    let attitude = |change: fn(&Bodies<f64>, &Inertia<f64>, &mut rotor::Rates<f64>)| run::<Bodies<f64>>(&case, change);
    assert!(attitude(|_, _, _| ()).angle_to(&reference()) < RIGHT);
    let misprinted = attitude(|state, inertia, rates| {
        rates.rotor[0] = (state.omega_body(0, inertia) * state.rotor[0]) * -0.5;
    });
    assert!(misprinted.angle_to(&reference()) > WRONG, "{}", misprinted.angle_to(&reference()));
    // On the left stands the world's: the same rate.
    let world = attitude(|state, inertia, rates| {
        rates.rotor[0] = (state.omega_world(0, inertia) * state.rotor[0]) * -0.5;
    });
    assert!(world.angle_to(&reference()) < RIGHT);
}

/// Corners of a body without symmetry: mass, place relative to the centre of mass.
fn corners() -> Vec<(f64, Vector3<f64>)> {
    let raw = [(1.0, [1.0, 0.2, 0.0]), (2.0, [-0.5, 0.4, 0.3]), (1.5, [0.1, -0.8, 0.5]), (0.5, [0.3, 0.3, -1.0])];
    let mass: f64 = raw.iter().map(|(m, _)| m).sum();
    let centre = raw.iter().map(|(m, r)| Vector3::from(*r) * *m).sum::<Vector3<f64>>() / mass;
    raw.into_iter().map(|(m, r)| (m, Vector3::from(r) - centre)).collect()
}

#[test]
fn the_reports_inertia_of_bivectors_is_the_usual_one_in_another_basis() {
    // Equation (37), in the basis (e12, e13, e23).
    let report = corners().iter().fold(Matrix3::zeros(), |sum, (m, r)| {
        let (x, y, z) = (r.x, r.y, r.z);
        sum + Matrix3::new(x * x + y * y, y * z, -x * z, y * z, x * x + z * z, x * y, -x * z, x * y, y * y + z * z) * *m
    });
    let usual = corners()
        .iter()
        .fold(Matrix3::zeros(), |sum, (m, r)| sum + (Matrix3::identity() * r.norm_squared() - r * r.transpose()) * *m);
    // From (e23, e31, e12) to it: e12, -e31, e23.
    let change = Matrix3::new(0.0, 0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0);
    assert!((change.transpose() * report * change - usual).amax() < 1e-14);

    // The motion of its principal axes is known; with the matrix in the wrong basis it is another one.
    let mass: f64 = corners().iter().map(|(m, _)| m).sum();
    let axes = usual.symmetric_eigen();
    let mut eigenvectors = axes.eigenvectors;
    if eigenvectors.determinant() < 0.0 {
        eigenvectors.set_column(2, &(-eigenvectors.column(2)));
    }
    let principal = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(eigenvectors));
    let omega = Vector3::from(OMEGA);
    let omega_principal = principal.inverse() * omega;
    let reference =
        split(axes.eigenvalues.into(), omega_principal.into(), principal, DURATION_S, 2000) * principal.inverse();
    let momentum = Bivector::from(<[f64; 3]>::from(usual * omega));
    let attitude = |inertia: Matrix3<f64>| {
        let rows = std::array::from_fn(|row| std::array::from_fn(|column| inertia[(row, column)]));
        let mut case = spinning(mass, MOMENTS, OMEGA);
        case.setup.inertias = vec![Inertia::new(mass, rows).unwrap()];
        case.bodies = Bodies::default();
        case.bodies.push(Point::origin(), Rotor::default(), Vector::default(), momentum);
        run::<Bodies<f64>>(&case, |_, _, _| ())
    };
    let (right, wrong) = (attitude(usual).angle_to(&reference), attitude(report).angle_to(&reference));
    assert!(right < RIGHT, "{right:e}");
    assert!(wrong > WRONG, "{wrong:e}");
}

#[test]
fn every_formulation_shows_the_same_frames() {
    fn check<F: Formulation<f64>>(case: &Case<f64>) {
        let (inertia, bodies) = (&case.setup.inertias[0], &case.bodies);
        let state = F::from_bodies(bodies);
        let rotor = bodies.rotor[0];
        let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15);
        assert_eq!(state.len(), 1);
        assert_eq!(state.position(0), bodies.position[0]);
        let x = Vector::new(1.0, 2.0, 3.0);
        assert!(near(state.to_world(0, x).into(), rotor.apply(x).into()));
        assert!(near(state.omega_world(0, inertia).into(), rotor.apply(Bivector::from(OMEGA)).into()));
        assert!(near(state.velocity(0, inertia).into(), (bodies.momentum[0] / 2.0).into()));
        let mut back = bodies.clone();
        back.rotor[0] = Rotor::default();
        state.write_to(&mut back);
        assert!(quaternion(back.rotor[0]).angle_to(&quaternion(rotor)) < 1e-15);
    }
    let inertia = Inertia::new(2.0, diagonal(MOMENTS)).unwrap();
    let rotor = Rotor::from_axis_angle(Vector::new(1.0, -2.0, 0.5), 2.0).unwrap();
    let mut case = spinning(2.0, MOMENTS, OMEGA);
    case.bodies = Bodies::default();
    let spin = rotor.apply(inertia.momentum_of(Bivector::from(OMEGA)));
    case.bodies.push(Point::new(1.0, 2.0, 3.0), rotor, Vector::new(0.5, 0.25, -1.0), spin);
    check::<Bodies<f64>>(&case);
    check::<ga_physics::rigid::quaternion::State<f64>>(&case);
    check::<ga_physics::rigid::motor::State<f64>>(&case);
    check::<matrix::State<f64>>(&case);
}

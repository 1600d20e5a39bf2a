//! Projections of positions and velocities: they arrive, as fast as they should, and say so when they cannot.

use crate::systems::{Dice, Link, System, dot};
use ga_physics::constraint::{Configuration, Method, Multipliers, ProjectionError, Rows, SolveError, Stop};
use nalgebra::DVector;

/// Metres; positions of a few metres are rounded to some 1e-15.
const TOLERANCE_M: f64 = 1e-13;

/// A system that notes its stretch at every evaluation.
struct Watched(System, Vec<f64>);

impl Configuration<3> for Watched {
    fn evaluate(&mut self, rows: &mut Rows<3>) {
        self.0.fill(rows);
        self.1.push(self.0.stretch());
    }

    fn displace(&mut self, displacement: &[[f64; 3]]) {
        self.0.displace(displacement);
    }
}

fn methods(rows: usize) -> [Method; 2] {
    [Method::Direct, Method::ConjugateGradients(Stop::tight(rows))]
}

fn multipliers(system: &System, method: Method) -> Multipliers<3> {
    Multipliers::new(&system.rows(), system.inv_mass.as_slice(), method)
}

#[test]
fn shaken_systems_come_back() {
    let mut dice = Dice(5);
    let tree = System::tree(30, &mut dice);
    let ring = System::new(
        (0..12).map(|k| [f64::from(k).cos(), f64::from(k).sin(), 0.1 * f64::from(k)]).collect(),
        &[],
        &(0..12).map(|k| (k, (k + 1) % 12)).collect::<Vec<_>>(),
    );
    for rest in [System::chain(1), System::chain(20), System::net(6, 0.3), tree, ring] {
        for method in methods(rest.links.len()) {
            let mut system = rest.clone();
            let (mut rows, w) = (system.rows(), system.inv_mass.clone());
            system.shake(0.02, &mut dice);
            assert!(system.stretch() > 1e6 * TOLERANCE_M);
            let mut multipliers = multipliers(&system, method);
            let projected = multipliers.project(&mut rows, w.as_slice(), &mut system, TOLERANCE_M).unwrap();
            assert!(system.stretch() <= 2.0 * TOLERANCE_M, "{projected:?}");
            assert!(projected.evaluations < 16, "{projected:?}");
            for (k, w) in w.iter().enumerate() {
                assert!(*w > 0.0 || system.position[k] == rest.position[k], "a fixed particle moved");
            }
        }
    }
}

#[test]
fn newton_converges_quadratically_and_a_frozen_factor_linearly() {
    let mut system = System::chain(10);
    let w = system.inv_mass.clone();
    let mut rows = system.rows();
    let mut start = multipliers(&system, Method::Direct);
    start.freeze(&rows, w.as_slice()).unwrap();
    system.shake(0.01, &mut Dice(5));

    // A tolerance of nothing renews the factor at every step, until rounding stops it.
    let mut newton = Watched(system.clone(), Vec::new());
    let end = start.clone().project(&mut rows, w.as_slice(), &mut newton, 0.0);
    assert!(matches!(end, Ok(_) | Err(ProjectionError::NotConverged { violation_m: ..1e-14, .. })), "{end:?}");
    // The first step is with the old factor.
    let errors = &newton.1[1..4];
    for pair in errors.windows(2) {
        assert!(pair[1] < 5.0 * pair[0] * pair[0] + 1e-14, "{errors:?}");
    }
    assert!(errors[0] > 1e-5 && errors[2] < 1e-11, "{errors:?}");

    let mut frozen = Watched(system.clone(), Vec::new());
    start.project_along_frozen(&mut rows, w.as_slice(), &mut frozen, TOLERANCE_M, 0.0).unwrap();
    let ratios: Vec<f64> = frozen.1.windows(2).skip(1).map(|pair| pair[1] / pair[0]).collect();
    let reliable = &ratios[..3];
    assert!(reliable.iter().all(|ratio| (1e-3..0.3).contains(ratio)), "{ratios:?}");
}

#[test]
fn a_factor_that_serves_is_kept() {
    let mut system = System::net(6, 0.3);
    let (mut rows, w) = (system.rows(), system.inv_mass.clone());
    let mut multipliers = multipliers(&system, Method::Direct);
    multipliers.freeze(&rows, w.as_slice()).unwrap();
    system.shake(1e-4, &mut Dice(5));
    let projected = multipliers.project(&mut rows, w.as_slice(), &mut system, TOLERANCE_M).unwrap();
    assert_eq!(projected.factorisations, 0, "{projected:?}");
    system.shake(0.1, &mut Dice(6));
    let projected = multipliers.project(&mut rows, w.as_slice(), &mut system, TOLERANCE_M).unwrap();
    assert!(projected.factorisations > 0, "{projected:?}");
}

#[test]
fn along_frozen_gradients_the_displacement_is_an_impulse_of_the_constraints() {
    let mut system = System::chain(6);
    system.inv_mass[3] = 0.01;
    let (mut rows, w) = (system.rows(), system.inv_mass.clone());
    let mut multipliers = multipliers(&system, Method::Direct);
    multipliers.freeze(&rows, w.as_slice()).unwrap();
    let before = system.clone();
    system.shake(1e-3, &mut Dice(2));
    let shaken = system.position.clone();
    multipliers.project_along_frozen(&mut rows, w.as_slice(), &mut system, TOLERANCE_M, 0.0).unwrap();
    assert!(system.stretch() < 2.0 * TOLERANCE_M);
    for (k, shaken) in shaken.iter().enumerate() {
        for (axis, shaken) in shaken.iter().enumerate() {
            let moved = system.position[k][axis] - shaken;
            assert!((multipliers.displacement()[k][axis] - moved).abs() < 1e-15);
        }
    }
    // It is W J^T mu with the J of before: solve for mu by least squares and look at what is left.
    let displacement = DVector::from_iterator(21, multipliers.displacement().iter().flatten().copied());
    let span = before.dense_w() * before.dense_j(&before.rows()).transpose();
    let mu = span.clone().svd(true, true).solve(&displacement, 1e-12).unwrap();
    assert!((span * mu - &displacement).amax() < 1e-12 * displacement.amax().max(1e-3));
}

/// A pendulum's steps resemble each other: the last multipliers are a better beginning than none.
#[test]
fn the_last_multipliers_are_a_good_beginning() {
    let h = 1e-2;
    let evaluations = |warm: f64| {
        let mut system = System::chain(3);
        system.velocity.fill([0.0; 3]);
        let (mut rows, w) = (system.rows(), system.inv_mass.clone());
        let mut multipliers = multipliers(&system, Method::Direct);
        let mut evaluations = 0;
        for _ in 0..50 {
            multipliers.freeze(&rows, w.as_slice()).unwrap();
            for (k, v) in system.velocity.iter_mut().enumerate().skip(1) {
                v[1] -= h * 9.81;
                system.position[k] = std::array::from_fn(|axis| system.position[k][axis] + h * v[axis]);
            }
            let projected =
                multipliers.project_along_frozen(&mut rows, w.as_slice(), &mut system, 1e-10, warm).unwrap();
            assert!(projected.factorisations == 0 && system.stretch() < 2e-10);
            evaluations += projected.evaluations;
            for (v, by) in system.velocity.iter_mut().zip(multipliers.displacement()) {
                *v = std::array::from_fn(|axis| v[axis] + by[axis] / h);
            }
        }
        evaluations
    };
    let (warm, cold) = (evaluations(1.0), evaluations(0.0));
    assert!(warm < cold, "{warm} {cold}");
}

/// Where no displacement along the old gradients is on the constraints: a link turned by a right angle and more.
#[test]
fn too_long_a_step_leaves_the_frozen_gradients_and_says_so() {
    let mut system = System::chain(1);
    let (mut rows, w) = (system.rows(), system.inv_mass.clone());
    let mut multipliers = multipliers(&system, Method::Direct);
    multipliers.freeze(&rows, w.as_slice()).unwrap();
    let [x, y, z] = system.position[1];
    system.position[1] = [-2.0 * y, 2.0 * x, z];
    let projected = multipliers.project_along_frozen(&mut rows, w.as_slice(), &mut system, TOLERANCE_M, 0.0).unwrap();
    assert!(projected.factorisations > 0 && system.stretch() < 2.0 * TOLERANCE_M, "{projected:?}");
}

#[test]
fn velocities_lose_exactly_what_breaks_the_constraints() {
    for mut system in [System::chain(20), System::net(6, 0.3), System::net(6, 0.0), System::graph(8, 28, &mut Dice(1))]
    {
        system.inv_mass[2] = 1e-3;
        let (rows, w) = (system.rows(), system.inv_mass.clone());
        for method in methods(rows.len()) {
            let mut multipliers = multipliers(&system, method);
            multipliers.freeze(&rows, w.as_slice()).unwrap();
            let before = system.velocity.clone();
            let change = multipliers.velocity_change(w.as_slice(), |k| before[k]).unwrap();
            let after: Vec<[f64; 3]> =
                before.iter().zip(change).map(|(v, by)| std::array::from_fn(|k| v[k] + by[k])).collect();
            let mut speeds = vec![0.0; rows.len()];
            rows.times(|k| after[k], &mut speeds);
            assert!(speeds.iter().all(|speed| speed.abs() < 1e-10), "{speeds:?}");
            // Orthogonal in the norm of the kinetic energy: v m (v' - v) = |v' - v|² m, from the right side negative.
            let moving = (0..w.len()).filter(|k| w[*k] > 0.0);
            let work: f64 = moving.map(|k| dot(after[k], change[k]) / w[k]).sum();
            assert!(work.abs() < 1e-9, "{work:e}");
        }
    }
}

/// A straight chain between two pins cannot move sideways: its Jacobian is singular, and lateral errors are of second
/// order.
#[test]
fn at_a_singular_configuration_nothing_blows_up() {
    for (sideways, tolerance) in [(1e-3, 1e-9), (1e-2, 1e-9), (0.1, 1e-9)] {
        let mut system = System::straight(9, &[0, 9]);
        let (mut rows, w) = (system.rows(), system.inv_mass.clone());
        let rest = system.position.clone();
        system.shake(sideways, &mut Dice(3));
        let mut multipliers = multipliers(&system, Method::Direct);
        let outcome = multipliers.project(&mut rows, w.as_slice(), &mut system, tolerance);
        match outcome {
            Ok(projected) => assert!(projected.violation_m <= tolerance && projected.evaluations > 5),
            Err(ProjectionError::NotConverged { violation_m, .. }) => assert!(violation_m < sideways),
            Err(error) => panic!("{error}"),
        }
        for (x, rest) in system.position.iter().zip(rest) {
            let off: [f64; 3] = std::array::from_fn(|k| x[k] - rest[k]);
            assert!(dot(off, off).sqrt() < 10.0 * sideways, "{outcome:?}");
        }
    }
}

#[test]
fn pins_too_far_apart_are_refused_and_positions_stay_sane() {
    let mut system = System::straight(4, &[0, 4]);
    system.position[4] = system.position[4].map(|x| 1.1 * x);
    system.shake(0.01, &mut Dice(8));
    let (mut rows, w) = (system.rows(), system.inv_mass.clone());
    let before = system.stretch();
    let error = multipliers(&system, Method::Direct).project(&mut rows, w.as_slice(), &mut system, 1e-9).unwrap_err();
    let ProjectionError::NotConverged { violation_m, .. } = error else { panic!("{error}") };
    // 0.4 m are missing over four links.
    assert!((0.09..=before).contains(&violation_m), "{violation_m} m of {before} m");
    assert!(system.position.iter().flatten().all(|x| x.abs() < 10.0), "{:?}", system.position);
}

#[test]
fn contradicting_lengths_are_named() {
    let mut system = System::chain(5);
    let twin = system.links[2];
    system.links.push(Link { length: twin.length + 0.01, ..twin });
    let (mut rows, w) = (system.rows(), system.inv_mass.clone());
    let error = multipliers(&system, Method::Direct).project(&mut rows, w.as_slice(), &mut system, 1e-9).unwrap_err();
    assert!(matches!(error, ProjectionError::NotConverged { row: 2 | 5, .. }), "{error}");
    // Within the tolerance they do not contradict.
    let projected = multipliers(&system, Method::Direct).project(&mut rows, w.as_slice(), &mut system, 0.02).unwrap();
    assert!(projected.violation_m <= 0.02);
}

#[test]
fn rows_between_fixed_particles_hold_or_are_named() {
    let mut system = System::chain(3);
    system.inv_mass[1] = 0.0;
    system.shake(0.01, &mut Dice(4));
    let (mut rows, w) = (system.rows(), system.inv_mass.clone());
    multipliers(&system, Method::Direct).project(&mut rows, w.as_slice(), &mut system, TOLERANCE_M).unwrap();
    system.links[0].length += 0.5;
    let error = multipliers(&system, Method::Direct).project(&mut rows, w.as_slice(), &mut system, 1e-9).unwrap_err();
    assert!(matches!(error, ProjectionError::NotConverged { row: 0, .. }), "{error}");
}

#[test]
fn coincident_particles_and_broken_numbers_are_named() {
    let mut system = System::chain(3);
    let (mut rows, w) = (system.rows(), system.inv_mass.clone());
    system.position[2] = system.position[1];
    let error = multipliers(&system, Method::Direct).project(&mut rows, w.as_slice(), &mut system, 1e-9).unwrap_err();
    assert_eq!(error, ProjectionError::NoGradient { row: 1 });
    system.position[2][1] = f64::NAN;
    let error = multipliers(&system, Method::Direct).project(&mut rows, w.as_slice(), &mut system, 1e-9).unwrap_err();
    assert!(matches!(error, ProjectionError::Solve(SolveError::NotFinite { row: 1 | 2 })), "{error}");
}

#[test]
fn without_constraints_there_is_nothing_to_do() {
    let mut system = System::new(vec![[1.0; 3]; 2], &[], &[]);
    let (mut rows, w) = (system.rows(), system.inv_mass.clone());
    for method in methods(0) {
        let mut multipliers = multipliers(&system, method);
        let projected = multipliers.project(&mut rows, w.as_slice(), &mut system, 0.0).unwrap();
        assert_eq!((projected.evaluations, projected.violation_m), (1, 0.0));
        multipliers.freeze(&rows, w.as_slice()).unwrap();
        assert_eq!(multipliers.velocity_change(w.as_slice(), |_| [1.0; 3]).unwrap(), [[0.0; 3]; 2]);
    }
}

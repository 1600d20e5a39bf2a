//! Both solvers give the multipliers that dense algebra gives.

use crate::systems::{Dice, System};
use ga_physics::constraint::{ConjugateGradients, Direct, Rows, SolveError, Stop};
use nalgebra::DVector;

/// A right-hand side that redundant rows agree on: `A x` of some x.
fn consistent(system: &System, rows: &Rows<3>) -> Vec<f64> {
    let mut dice = Dice(11);
    let x = DVector::from_fn(rows.len(), |_, _| dice.roll());
    (system.dense(rows) * x).as_slice().to_vec()
}

/// The force-free acceleration `W J^T lambda`: unique, also where lambda is not.
fn response(system: &System, rows: &Rows<3>, lambda: &[f64]) -> DVector<f64> {
    system.dense_w() * system.dense_j(rows).transpose() * DVector::from_row_slice(lambda)
}

/// The same by the pseudo-inverse, from a singular value decomposition.
fn dense_response(system: &System, rows: &Rows<3>, b: &[f64]) -> DVector<f64> {
    let svd = system.dense(rows).svd(true, true);
    // Between the rounding of a singular value and those of the systems here.
    let cut = svd.singular_values.max() * 1e-12;
    let lambda = svd.solve(&DVector::from_row_slice(b), cut).unwrap();
    response(system, rows, lambda.as_slice())
}

fn systems() -> Vec<(&'static str, System)> {
    let mut dice = Dice(3);
    vec![
        ("one link", System::chain(1)),
        ("double pendulum", System::chain(2)),
        ("chain", System::chain(20)),
        ("straight chain", System::straight(20, &[0])),
        ("straight chain between pins", System::straight(9, &[0, 9])),
        ("net", System::net(6, 0.3)),
        ("flat net", System::net(6, 0.0)),
        ("tree", System::tree(30, &mut dice)),
        ("sparse graph", System::graph(20, 25, &mut dice)),
        // 3 n - 6 independent distances between 8 points: 18 of 28.
        ("all distances", System::graph(8, 28, &mut dice)),
    ]
}

#[test]
fn the_direct_solver_agrees_with_dense_algebra() {
    for (name, system) in systems() {
        let rows = system.rows();
        let b = consistent(&system, &rows);
        let mut solver = Direct::new(&rows, system.inv_mass.as_slice());
        solver.prepare(&rows, system.inv_mass.as_slice()).unwrap();
        let mut lambda = vec![0.0; rows.len()];
        solver.solve(&rows, system.inv_mass.as_slice(), &b, &mut lambda).unwrap();
        let dense = dense_response(&system, &rows, &b);
        let error = (response(&system, &rows, &lambda) - &dense).amax() / dense.amax();
        assert!(error < 1e-11, "{name}: {error:e}");
    }
}

#[test]
fn conjugate_gradients_agree_with_dense_algebra() {
    for (name, system) in systems() {
        let rows = system.rows();
        let b = consistent(&system, &rows);
        let stop = Stop::tight(rows.len());
        let w = system.inv_mass.as_slice();
        for mut solver in [ConjugateGradients::jacobi(&rows, stop), ConjugateGradients::incomplete(&rows, w, stop)] {
            solver.prepare(&rows, w).unwrap();
            let mut lambda = vec![0.0; rows.len()];
            let solved = solver.solve(&rows, w, &b, &mut lambda).unwrap();
            assert!(solved.converged, "{name}: {solved:?}");
            let dense = dense_response(&system, &rows, &b);
            let error = (response(&system, &rows, &lambda) - &dense).amax() / dense.amax();
            assert!(error < 1e-10, "{name}: {error:e}");
        }
    }
}

#[test]
fn redundant_rows_are_named_and_contradictions_refused() {
    let mut system = System::chain(5);
    system.links.push(system.links[2]);
    let rows = system.rows();
    let w = system.inv_mass.as_slice();
    let mut solver = Direct::new(&rows, w);
    solver.prepare(&rows, w).unwrap();
    assert_eq!(solver.rank(), 5);
    let [redundant] = *solver.redundant() else { panic!("{:?}", solver.redundant()) };
    assert!(redundant == 2 || redundant == 5);
    let mut b = vec![1.0, 2.0, 3.0, 4.0, 5.0, 3.0];
    let mut lambda = vec![0.0; 6];
    solver.solve(&rows, w, &b, &mut lambda).unwrap();
    b[5] = 3.001;
    let error = solver.solve(&rows, w, &b, &mut lambda).unwrap_err();
    assert!(matches!(error, SolveError::Contradiction { row: 2 | 5, excess } if (excess.abs() - 1e-3).abs() < 1e-12));
}

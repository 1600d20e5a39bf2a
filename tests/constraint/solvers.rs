//! Both solvers give the multipliers that dense algebra gives.

use crate::systems::{Dice, System};
use ga_physics::constraint::{ConjugateGradients, Direct, InverseMass, Method, Multipliers, Rows, SolveError, Stop};
use nalgebra::{DMatrix, DVector, SMatrix, SVector};

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
        assert_eq!(solver.rank(), dense_rank(&system, &rows), "{name}");
    }
}

fn dense_rank(system: &System, rows: &Rows<3>) -> usize {
    let svd = system.dense(rows).svd(false, false);
    svd.rank(svd.singular_values.max() * 1e-12)
}

#[test]
fn redundant_rows_are_told_from_independent_ones() {
    let mut dice = Dice(21);
    for trial in 0..60 {
        let n = 4 + trial % 9;
        let most = n * (n - 1) / 2;
        let links = (3 * n - 9 + dice.below(8)).min(most);
        let system = System::graph(n, links, &mut dice);
        let rows = system.rows();
        let mut solver = Direct::new(&rows, system.inv_mass.as_slice());
        solver.prepare(&rows, system.inv_mass.as_slice()).unwrap();
        assert_eq!(solver.rank(), dense_rank(&system, &rows), "{n} particles, {links} links");
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

/// One particle, three directions in a plane, two of them nearly the same: one of these two is the one to drop, whatever the
/// order of elimination. Slightly out of the plane the third dimension is no row's, until one asks anew.
#[test]
fn the_row_that_is_dropped_leaves_the_most_independent_ones() {
    for turn in 0..3 {
        let mut rows = Rows::<3>::new(2, [vec![0], vec![0], vec![0], vec![1]]);
        let directions = [[1.0, 0.0, 0.0], [1.0, 1e-4, 0.0], [0.0, 1.0, 0.0]];
        for (index, direction) in directions.into_iter().enumerate() {
            rows.row_mut((index + turn) % 3).gradients[0] = direction;
        }
        // A row of nothing that moves is redundant as well, and remains so.
        rows.row_mut(3).gradients[0] = [1.0, 0.0, 0.0];
        let w: &[f64] = &[1.0, 0.0];
        let mut solver = Direct::new(&rows, w);
        solver.prepare(&rows, w).unwrap();
        let mut dropped: Vec<usize> = solver.redundant().iter().map(|row| *row as usize).collect();
        dropped.sort_unstable();
        assert!(dropped.len() == 2 && dropped[1] == 3 && dropped[0] != (2 + turn) % 3, "turn {turn}: {dropped:?}");

        rows.row_mut(dropped[0]).gradients[0][2] = 1e-5;
        solver.prepare_alike(&rows, w).unwrap();
        assert_eq!(solver.rank(), 2);
        solver.prepare(&rows, w).unwrap();
        assert_eq!(solver.rank(), 3);
    }
}

/// A light chain with a heavy bob at rest: link i carries what hangs below it.
#[test]
fn mass_ratios_of_a_million_million_keep_their_digits() {
    let (links, g) = (12, 9.81);
    for ratio in [1.0, 1e4, 1e8, 1e12] {
        let mut system = System::straight(links, &[0]);
        system.velocity.fill([0.0; 3]);
        system.inv_mass[links] = 1.0 / ratio;
        // Gravity along the chain, which is straight and has links of 1 m.
        let rows = system.rows();
        let w = system.inv_mass.as_slice();
        let direction = [0.6, 0.48, 0.64];
        let mut b = vec![0.0; links];
        rows.times(|k| if w[k] == 0.0 { [0.0; 3] } else { direction.map(|x| -g * x) }, &mut b);
        let mut solver = Direct::new(&rows, w);
        solver.prepare(&rows, w).unwrap();
        let mut lambda = vec![0.0; links];
        let solved = solver.solve(&rows, w, &b, &mut lambda).unwrap();
        for (index, lambda) in lambda.iter().enumerate() {
            let below = (links - 1 - index) as f64 + ratio;
            // The force on b is `lambda (x_b - x_a)`, upwards: towards a.
            let error = (lambda + below * g) / (below * g);
            assert!(error.abs() < 1e-11, "ratio {ratio:e}, link {index}: {error:e}, {solved:?}");
        }
        assert_eq!(solver.rank(), links);
    }
}

#[test]
fn the_incomplete_factor_is_exact_on_chains_and_trees_and_helps_on_nets() {
    let stop = |system: &System| Stop { relative: 1e-9, ..Stop::tight(system.links.len()) };
    let iterations = |system: &System| {
        let (rows, w) = (system.rows(), system.inv_mass.as_slice());
        let b = consistent_sparse(system, &rows);
        let jacobi = ConjugateGradients::jacobi(&rows, stop(system));
        let incomplete = ConjugateGradients::incomplete(&rows, w, stop(system));
        [jacobi, incomplete].map(|mut solver| {
            solver.prepare(&rows, w).unwrap();
            let solved = solver.solve(&rows, w, &b, &mut vec![0.0; rows.len()]).unwrap();
            assert!(solved.converged, "{solved:?}");
            solved.iterations
        })
    };
    let [jacobi, incomplete] = iterations(&System::straight(200, &[0]));
    assert!(jacobi > 150 && incomplete <= 2, "{jacobi} {incomplete}");
    let [jacobi, incomplete] = iterations(&System::tree(200, &mut Dice(9)));
    assert!(jacobi > 20 && incomplete <= 2, "{jacobi} {incomplete}");
    let mut net = System::net(12, 0.3);
    net.shake(0.2, &mut Dice(9));
    let [jacobi, incomplete] = iterations(&net);
    assert!(jacobi > 2 * incomplete, "{jacobi} {incomplete}");
    // Whatever the order of the rows.
    let mut dice = Dice(10);
    for k in (1..net.links.len()).rev() {
        net.links.swap(k, dice.below(k + 1));
    }
    let [jacobi, incomplete] = iterations(&net);
    assert!(jacobi > 2 * incomplete, "{jacobi} {incomplete}");
}

fn consistent_sparse(system: &System, rows: &Rows<3>) -> Vec<f64> {
    let mut dice = Dice(11);
    let x: Vec<f64> = (0..rows.len()).map(|_| dice.roll()).collect();
    let (mut b, mut room) = (vec![0.0; rows.len()], vec![[0.0; 3]; rows.blocks()]);
    rows.normal_times(system.inv_mass.as_slice(), &x, &mut room, &mut b);
    b
}

#[test]
fn a_warm_start_saves_iterations_and_a_contradiction_does_not_converge() {
    let mut system = System::net(8, 0.3);
    system.shake(0.1, &mut Dice(1));
    let (rows, w) = (system.rows(), system.inv_mass.as_slice());
    let b = consistent(&system, &rows);
    let stop = Stop { relative: 1e-9, ..Stop::tight(rows.len()) };
    let mut solver = ConjugateGradients::incomplete(&rows, w, stop);
    solver.prepare(&rows, w).unwrap();
    let mut lambda = vec![0.0; rows.len()];
    let cold = solver.solve(&rows, w, &b, &mut lambda).unwrap();
    let again = solver.solve(&rows, w, &b, &mut lambda).unwrap();
    assert_eq!(again.iterations, 0);
    lambda.iter_mut().for_each(|x| *x *= 1.0 + 1e-5);
    let warm = solver.solve(&rows, w, &b, &mut lambda).unwrap();
    assert!(2 * warm.iterations < cold.iterations + 2, "{warm:?} {cold:?}");

    system.links.push(system.links[7]);
    let rows = system.rows();
    let w = system.inv_mass.as_slice();
    let mut b = consistent(&system, &rows);
    b[7] += 1.0;
    for mut solver in [ConjugateGradients::jacobi(&rows, stop), ConjugateGradients::incomplete(&rows, w, stop)] {
        solver.prepare(&rows, w).unwrap();
        let mut lambda = vec![0.0; rows.len()];
        let solved = solver.solve(&rows, w, &b, &mut lambda).unwrap();
        assert!(!solved.converged && lambda.iter().all(|x| x.is_finite()), "{solved:?}");
    }
}

/// Chains are O(n): no fill. A net's fill stays well under that of its natural band.
#[test]
fn the_order_keeps_the_factor_sparse() {
    let fill = |system: &System| Direct::new(&system.rows(), system.inv_mass.as_slice()).fill();
    assert_eq!(fill(&System::chain(100)), 99);
    let tree = System::tree(100, &mut Dice(1));
    let couplings = tree.dense(&tree.rows()).iter().filter(|x| **x != 0.0).count();
    // The best order of a tree has no fill; minimum degrees that are only approximate add a little.
    assert!((couplings..couplings * 21 / 20).contains(&(2 * fill(&tree) + 99)), "{} {couplings}", fill(&tree));
    let net = System::net(16, 0.3);
    assert!(fill(&net) < net.links.len() * 2 * 16 / 2, "{}", fill(&net));
}

#[test]
fn rows_of_nothing_that_moves_hold_or_are_refused() {
    let mut system = System::chain(3);
    system.inv_mass[1] = 0.0;
    let (rows, w) = (system.rows(), system.inv_mass.as_slice());
    let mut solver = Direct::new(&rows, w);
    solver.prepare(&rows, w).unwrap();
    assert_eq!(solver.redundant(), [0]);
    let mut lambda = vec![f64::NAN; 3];
    solver.solve(&rows, w, &[0.0, 1.0, 2.0], &mut lambda).unwrap();
    assert!(lambda[0] == 0.0 && lambda[1] != 0.0);
    let error = solver.solve(&rows, w, &[1e-3, 1.0, 2.0], &mut lambda).unwrap_err();
    assert_eq!(error, SolveError::Contradiction { row: 0, excess: 1e-3 });
    assert!(error.to_string().contains("constraint 0"));
}

#[test]
fn numbers_that_are_none_are_refused() {
    let system = System::chain(3);
    let (mut rows, w) = (system.rows(), system.inv_mass.clone());
    for method in [Method::Direct, Method::ConjugateGradients(Stop::tight(3))] {
        let mut solver = Multipliers::new(&rows, w.as_slice(), method);
        solver.freeze(&rows, w.as_slice()).unwrap();
        let error = solver.solve(w.as_slice(), &[0.0, f64::NAN, 0.0], &mut [0.0; 3]).unwrap_err();
        assert!(matches!(error, SolveError::NotFinite { .. }));
        system.fill(&mut rows);
        rows.row_mut(1).gradients[0] = [f64::INFINITY; 3];
        let error = solver.freeze(&rows, w.as_slice()).unwrap_err();
        assert!(matches!(error, SolveError::NotFinite { row: 1 | 2 }), "{error}");
        system.fill(&mut rows);
        solver.freeze(&rows, w.as_slice()).unwrap();
        solver.solve(w.as_slice(), &[1.0; 3], &mut [0.0; 3]).unwrap();
    }
}

/// Blocks of six coordinates with a full matrix each, as bodies have.
struct Bodies(Vec<SMatrix<f64, 6, 6>>);

impl InverseMass<6> for Bodies {
    fn accelerate(&self, block: usize, force: [f64; 6]) -> [f64; 6] {
        (self.0[block] * SVector::from(force)).into()
    }

    fn is_fixed(&self, block: usize) -> bool {
        self.0[block] == SMatrix::<f64, 6, 6>::zeros()
    }
}

#[test]
fn blocks_may_have_full_inverse_masses() {
    let mut dice = Dice(13);
    let (blocks, rows_wanted) = (7, 15);
    let mut masses = Vec::new();
    for block in 0..blocks {
        let root = SMatrix::<f64, 6, 6>::from_fn(|_, _| dice.roll());
        masses.push(if block == 0 { SMatrix::<f64, 6, 6>::zeros() } else { root * root.transpose() });
    }
    let bodies = Bodies(masses);
    let pattern: Vec<Vec<usize>> =
        (0..rows_wanted).map(|row| (0..=row % 3).map(|_| dice.below(blocks)).chain([1 + row % 6]).collect()).collect();
    let mut rows = Rows::<6>::new(blocks, pattern.iter().map(|row| row.iter().copied()));
    let mut j = DMatrix::<f64>::zeros(rows_wanted, 6 * blocks);
    for (index, blocks) in pattern.iter().enumerate() {
        for (entry, block) in blocks.iter().enumerate() {
            let gradient = std::array::from_fn(|_| dice.roll());
            rows.row_mut(index).gradients[entry] = gradient;
            (0..6).for_each(|k| j[(index, 6 * block + k)] += gradient[k]);
        }
    }
    let mut w = DMatrix::<f64>::zeros(6 * blocks, 6 * blocks);
    for (block, mass) in bodies.0.iter().enumerate() {
        w.view_mut((6 * block, 6 * block), (6, 6)).copy_from(mass);
    }
    let b = DVector::from_fn(rows_wanted, |_, _| dice.roll());
    let dense = (&j * w * j.transpose()).lu().solve(&b).unwrap();
    for method in [Method::Direct, Method::ConjugateGradients(Stop::tight(rows_wanted))] {
        let mut solver = Multipliers::new(&rows, &bodies, method);
        solver.freeze(&rows, &bodies).unwrap();
        let mut lambda = vec![0.0; rows_wanted];
        assert!(solver.solve(&bodies, b.as_slice(), &mut lambda).unwrap().converged);
        let error = (DVector::from_vec(lambda) - &dense).amax() / dense.amax();
        assert!(error < 1e-9, "{method:?}: {error:e}");
    }
}

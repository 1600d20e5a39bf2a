//! Particles, links and solvers that several tests use.

use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::Vector;
use ga_physics::ode::Tolerance;
use ga_physics::particle::{Constraint, Force, Masses, Method, Motion, Particles, Setup, Solver};

pub(crate) const GRAVITY: f64 = 9.81;

/// A state and what it is subject to.
pub(crate) type Case = (Particles<f64>, Setup<f64>);

pub(crate) fn masses(mass: Vec<f64>, fixed: &[usize]) -> Masses<f64> {
    let inverse = |(index, mass): (usize, &f64)| if fixed.contains(&index) { 0.0 } else { 1.0 / mass };
    Masses { inv_mass: mass.iter().enumerate().map(inverse).collect(), mass }
}

pub(crate) fn weight() -> Force<f64> {
    Force::Uniform { acceleration: Vector::new(0.0, 0.0, -GRAVITY) }
}

pub(crate) fn particles(at: &[[f64; 3]]) -> Particles<f64> {
    Particles { position: at.iter().map(|x| Point::from(*x)).collect(), velocity: vec![Vector::default(); at.len()] }
}

/// A straight chain of links of 1 m and 1 kg from the origin, its first particle fixed, at an angle from the vertical.
pub(crate) fn chain(links: u32, angle_rad: f64) -> Case {
    let (sin, cos) = angle_rad.sin_cos();
    let at: Vec<[f64; 3]> = (0..=links).map(|i| [f64::from(i) * sin, 0.0, -f64::from(i) * cos]).collect();
    let constraints = (0..links as usize).map(|i| Constraint::Distance { a: i, b: i + 1, length: 1.0 });
    let setup =
        Setup { masses: masses(vec![1.0; at.len()], &[0]), forces: vec![weight()], constraints: constraints.collect() };
    (particles(&at), setup)
}

/// A square net of links of 0.1 m, its columns folded like an accordion, held at two corners.
pub(crate) fn net(side: usize, fold_rad: f64) -> Case {
    let d = 0.1;
    let index = |column: usize, row: usize| row * side + column;
    let (mut at, mut constraints) = (Vec::new(), Vec::new());
    for row in 0..side {
        for column in 0..side {
            #[expect(clippy::cast_precision_loss, reason = "small")]
            let (x, y, up) = (column as f64 * d, row as f64 * d, (column % 2) as f64 * d);
            at.push([x * fold_rad.cos(), y, up * fold_rad.sin()]);
            let neighbours = [(column > 0).then(|| index(column - 1, row)), (row > 0).then(|| index(column, row - 1))];
            let link = |a| Constraint::Distance { a, b: index(column, row), length: d };
            constraints.extend(neighbours.into_iter().flatten().map(link));
        }
    }
    let setup = Setup { masses: masses(vec![0.01; at.len()], &[0, side - 1]), forces: vec![weight()], constraints };
    (particles(&at), setup)
}

pub(crate) fn fixed(method: Method, dt_s: f64) -> Solver {
    Solver { violation: 1e-13, ..Solver::fixed(method, dt_s) }
}

pub(crate) fn adaptive(method: Method, tolerance: f64) -> Solver {
    Solver { violation: 1e-13, ..Solver::adaptive(method, Tolerance { rtol: tolerance, atol: tolerance }) }
}

pub(crate) fn start((state, setup): Case, solver: &Solver) -> Motion<f64> {
    Motion::new(setup, state, solver).unwrap()
}

/// Where a particle is after a time.
pub(crate) fn position_after(case: Case, solver: &Solver, particle: usize, time_s: f64) -> Point<f64> {
    let mut motion = start(case, solver);
    motion.advance_to(time_s).unwrap();
    motion.state().position[particle]
}

pub(crate) fn distance(a: Point<f64>, b: Point<f64>) -> f64 {
    a.distance_sq_to(b).sqrt()
}

//! What is solved: a pendulum and an orbit with closed forms, and a net without.

use super::references;
use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;
use crate::ode::Tolerance;
use crate::particle::{
    Constraint, Force, LinearSolver, Masses, Method, Motion, Particles, Setup, Solver, SolverError, Stabilisation,
    Steps,
};
use crate::study::StudyError;

const GRAVITY: f64 = 9.81;
const PENDULUM_AMPLITUDE_RAD: f64 = 2.0;
const ECCENTRICITY: f64 = 0.6;
/// Particles of a side of the net, and the length of its links, m.
const SIDE: u32 = 8;
pub(super) const LINK_M: f64 = 0.1;
/// The columns are folded as in the scene `particle-net`: a straight edge between two fixed particles could not move.
const FOLD_RAD: f64 = 0.3;
/// What constraints are held to, relative to the shortest link: below every error that the study asks for.
const VIOLATION: f64 = 1e-12;
/// What sweeps are asked for: the `plan`'s, 1 % (`scene`). With short steps they hold more.
const VIOLATION_BY_SWEEPS: f64 = 1e-2;
/// Tolerances of a reference that is no closed form: one digit beyond the tightest of the study, and that.
const REFERENCE_RTOL: [f64; 2] = [1e-12, 1e-13];

/// One problem.
pub struct Case {
    /// Its name.
    pub name: &'static str,
    /// What moves, in a line.
    pub title: &'static str,
    /// Masses, forces, constraints.
    pub setup: Setup<f64>,
    /// Positions and velocities at time 0.
    pub start: Particles<f64>,
    /// When errors are taken, s. An end over a power of two is a step whose multiples are exact.
    pub end_s: f64,
    /// Pairs of particles with a link.
    pub links: Vec<[usize; 2]>,
    exact: Option<fn(f64) -> Point<f64>>,
}

/// Where the particles are at the end.
pub struct Reference {
    /// World, m.
    pub position: Vec<Point<f64>>,
    /// How far it may be off, m: 0 for a closed form, the difference of two solutions otherwise.
    pub uncertainty_m: f64,
    /// What it is.
    pub source: String,
}

/// A pendulum of 1 m held by a constraint, let go at 2 rad; a period and a half.
#[must_use]
pub fn pendulum() -> Case {
    fn exact(time_s: f64) -> Point<f64> {
        let (sin, cos) = references::pendulum(PENDULUM_AMPLITUDE_RAD, GRAVITY.sqrt(), time_s).sin_cos();
        Point::from([sin, 0.0, -cos])
    }
    let constraints = vec![Constraint::ToPoint { particle: 0, point: Point::from([0.0; 3]), length: 1.0 }];
    Case {
        name: "pendulum",
        title: "A pendulum of 1 m, a constraint, let go at 2 rad; 4 s, one and a half periods",
        setup: Setup { masses: masses(1, 1.0, &[]), forces: vec![weight()], constraints },
        start: at_rest(vec![exact(0.0)]),
        end_s: 4.0,
        links: vec![],
        exact: Some(exact),
    }
}

/// An orbit of eccentricity 0.6 round a fixed centre, from its pericentre; a little over three periods.
#[must_use]
pub fn kepler() -> Case {
    fn exact(time_s: f64) -> Point<f64> {
        let [x, y] = references::kepler(ECCENTRICITY, time_s);
        Point::from([x, y, 0.0])
    }
    let force = Force::InverseSquareToPoint { point: Point::from([0.0; 3]), constant: 1.0, softening: 0.0 };
    let mut start = at_rest(vec![exact(0.0)]);
    start.velocity[0] = Vector::new(0.0, ((1.0 + ECCENTRICITY) / (1.0 - ECCENTRICITY)).sqrt(), 0.0);
    Case {
        name: "kepler",
        title: "An orbit of eccentricity 0.6 and semi-major axis 1 m, no constraint; 20 s, 3.2 periods",
        setup: Setup { masses: masses(1, 1.0, &[]), forces: vec![force], constraints: vec![] },
        start,
        end_s: 20.0,
        links: vec![],
        exact: Some(exact),
    }
}

/// A folded net of 8 x 8 particles and 112 links, hung by two corners, falls from the horizontal.
#[must_use]
pub fn net() -> Case {
    let index = |column: u32, row: u32| (column * SIDE + row) as usize;
    let (mut position, mut links) = (Vec::new(), Vec::new());
    for column in 0..SIDE {
        for row in 0..SIDE {
            let (x, y) = (f64::from(column) * FOLD_RAD.cos(), f64::from(row));
            let z = f64::from(column % 2) * FOLD_RAD.sin();
            position.push(Point::from([x * LINK_M, y * LINK_M, z * LINK_M]));
            links.extend((row > 0).then(|| [index(column, row - 1), index(column, row)]));
            links.extend((column > 0).then(|| [index(column - 1, row), index(column, row)]));
        }
    }
    let fixed: Vec<usize> = [0, SIDE - 1].map(|column| index(column, 0)).to_vec();
    let constraints = links.iter().map(|&[a, b]| Constraint::Distance { a, b, length: LINK_M });
    let masses = masses(position.len(), 0.01, &fixed);
    Case {
        name: "net",
        title: "A folded net of 8 x 8 particles and 112 links of 0.1 m, hung by two corners, falls from the horizontal and \
                snaps taut; 1 s",
        setup: Setup { masses, forces: vec![weight()], constraints: constraints.collect() },
        start: at_rest(position),
        end_s: 1.0,
        links,
        exact: None,
    }
}

fn weight() -> Force<f64> {
    Force::Uniform { acceleration: Vector::new(0.0, 0.0, -GRAVITY) }
}

fn masses(count: usize, mass: f64, fixed: &[usize]) -> Masses<f64> {
    let inverse = |index: usize| if fixed.contains(&index) { 0.0 } else { 1.0 / mass };
    Masses { mass: vec![mass; count], inv_mass: (0..count).map(inverse).collect() }
}

fn at_rest(position: Vec<Point<f64>>) -> Particles<f64> {
    Particles { velocity: vec![Vector::default(); position.len()], position }
}

impl Case {
    /// Is anything held?
    #[must_use]
    pub fn is_held(&self) -> bool {
        !self.setup.constraints.is_empty()
    }

    /// A solver of the case: a method and its steps, projection, and the direct solver.
    #[must_use]
    pub fn solver(&self, method: Method, steps: Steps, linear: LinearSolver) -> Solver {
        let violation = if linear == LinearSolver::Sweeps { VIOLATION_BY_SWEEPS } else { VIOLATION };
        Solver { method, steps, linear, stabilisation: Stabilisation::Projection, violation, substeps: Some(1) }
    }

    /// Particles that are ready to move.
    ///
    /// # Errors
    /// A solver that cannot be used.
    pub fn motion(&self, solver: &Solver) -> Result<Motion<f64>, SolverError> {
        Motion::new(self.setup.clone(), self.start.clone(), solver)
    }

    /// The positions at the end: the closed form, or by DOP853, with two tolerances.
    ///
    /// # Errors
    /// The reference cannot be computed.
    pub fn reference(&self) -> Result<Reference, StudyError> {
        if let Some(exact) = self.exact {
            let position = vec![exact(self.end_s)];
            return Ok(Reference { position, uncertainty_m: 0.0, source: "the closed form".into() });
        }
        let [coarse, fine] = REFERENCE_RTOL;
        let (before, position) = (self.end_by(coarse)?, self.end_by(fine)?);
        let uncertainty_m = largest_distance(&before, &position);
        let source =
            format!("dop853 with rtol {fine:.0e}; it differs by {uncertainty_m:.1e} m from that with {coarse:.0e}");
        Ok(Reference { position, uncertainty_m, source })
    }

    fn end_by(&self, rtol: f64) -> Result<Vec<Point<f64>>, StudyError> {
        let steps = Steps::Adaptive { tolerance: Tolerance { rtol, atol: rtol } };
        let mut motion = self.motion(&self.solver(Method::Dop853, steps, LinearSolver::Direct))?;
        motion.advance_to(self.end_s)?;
        Ok(motion.state().position.clone())
    }
}

/// The largest distance of a particle from where it should be, m.
pub(super) fn largest_distance(a: &[Point<f64>], b: &[Point<f64>]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.distance_sq_to(*b)).fold(0.0, f64::max).sqrt()
}

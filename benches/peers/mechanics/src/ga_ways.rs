//! ga-physics: links as distance constraints, kept from both sides, by Runge-Kutta methods with projection or by RATTLE.

use crate::cases::{Case, Vector};
use crate::measure::{Engine, Way};
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3;
use ga_physics::ode::Tolerance;
use ga_physics::particle::{
    Constraint, Force, LinearSolver, Masses, Method, Motion, Particles, Setup, Solver, Stabilisation, Steps,
};

/// What projection leaves of pendulums and chains, of the length of a link: little above the rounding of coordinates.
const TIGHT: f64 = 1e-13;

/// What projection leaves of nets, of the length of a link.
const NET: f64 = 1e-9;

/// What sweeps are to leave of nets. Where a large one snaps taut they miss that by half as much again.
const LOOSE: f64 = 5e-3;

/// Of a Runge-Kutta method, relative and absolute.
const TOLERANCE: f64 = 1e-9;

/// A Runge-Kutta method with the step of the case.
pub fn fixed(name: &'static str, method: Method) -> Way {
    way(name, move |case| solver(method, Steps::Fixed { dt_s: case.dt_s }, LinearSolver::Direct, TIGHT))
}

/// A Runge-Kutta method that chooses its step.
pub fn adaptive(name: &'static str, method: Method) -> Way {
    let tolerance = Tolerance { rtol: TOLERANCE, atol: TOLERANCE };
    way(name, move |_| solver(method, Steps::Adaptive { tolerance }, LinearSolver::Direct, TIGHT))
}

/// Nets: RATTLE, order 2.
pub fn rattle() -> Way {
    net("ga-physics verlet (RATTLE)", Method::Verlet, LinearSolver::Direct, NET)
}

/// Nets: free flight, then Newton's method onto all links at once.
pub fn newton() -> Way {
    net("ga-physics xpbd, direct", Method::Xpbd, LinearSolver::Direct, NET)
}

/// Nets: sweeps link by link, in as many substeps as hold the violation at rest.
pub fn sweeps() -> Way {
    net("ga-physics xpbd, sweeps", Method::Xpbd, LinearSolver::Sweeps, LOOSE)
}

/// Twenty sweeps, whatever the size of the net and (up to 1) the violation that they leave.
pub fn sweeps_20() -> Way {
    way("ga-physics xpbd, 20 sweeps", |case| Solver {
        substeps: Some(20),
        ..solver(Method::Xpbd, Steps::Fixed { dt_s: case.dt_s }, LinearSolver::Sweeps, 1.0)
    })
}

fn net(name: &'static str, method: Method, linear: LinearSolver, violation: f64) -> Way {
    way(name, move |case| solver(method, Steps::Fixed { dt_s: case.dt_s }, linear, violation))
}

fn solver(method: Method, steps: Steps, linear: LinearSolver, violation: f64) -> Solver {
    Solver { method, steps, linear, stabilisation: Stabilisation::Projection, violation, substeps: None }
}

fn way(name: &'static str, solver: impl Fn(&Case) -> Solver + 'static) -> Way {
    Way::new(name, move |case| Ok(Box::new(Moving::new(case, &solver(case))?)))
}

struct Moving {
    motion: Motion<f64>,
    dt_s: f64,
    steps: u32,
}

impl Moving {
    fn new(case: &Case, solver: &Solver) -> Result<Self, String> {
        let mut start = Particles::default();
        case.position_m.iter().for_each(|&position| start.push(Point::from(position), g3::Vector::default()));
        let inv_mass = case.mass_kg.iter().zip(&case.fixed).map(|(mass, &fixed)| if fixed { 0.0 } else { 1.0 / mass });
        let rod = |link: &crate::cases::Link| Constraint::Distance { a: link.a, b: link.b, length: link.length_m };
        let setup = Setup {
            masses: Masses { mass: case.mass_kg.clone(), inv_mass: inv_mass.collect() },
            forces: vec![Force::Uniform { acceleration: case.gravity_m_s2.into() }],
            constraints: case.links.iter().map(rod).collect(),
        };
        let motion = Motion::new(setup, start, solver).map_err(|error| error.to_string())?;
        Ok(Self { motion, dt_s: case.dt_s, steps: 0 })
    }
}

impl Engine for Moving {
    fn step(&mut self) -> Result<(), String> {
        self.steps += 1;
        self.motion.advance_to(f64::from(self.steps) * self.dt_s).map_err(|error| error.to_string())
    }

    fn read(&self, position_m: &mut Vec<Vector>, velocity_m_s: &mut Vec<Vector>) {
        let state = self.motion.state();
        position_m.clear();
        position_m.extend(state.position.iter().map(|&position| Vector::from(position)));
        velocity_m_s.clear();
        velocity_m_s.extend(state.velocity.iter().map(|&velocity| Vector::from(velocity)));
    }
}

//! An orbit about a fixed centre with GM = 1 and semi-major axis 1, so that a period is 2 pi and the start the exact end.
//!
//! The state is (x, y, vx, vy). An orbit that starts (and so ends) at the pericentre shows its whole error in time as an
//! error of position; at the apocentre the particle is slower by (1 + e)/(1 - e), and its error smaller by the same factor.

use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};
use ga_physics::ode::{self, Adaptive, Embedded, Run, Stepper, Tolerance};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, Dopri5, SVector, System};
use std::f64::consts::TAU;

pub type State = [f64; 4];

/// An orbit, followed for some periods.
#[derive(Clone, Copy)]
pub struct Orbit {
    pub eccentricity: f64,
    pub periods: u32,
    pub from: Apsis,
}

/// Where an orbit starts.
#[derive(Clone, Copy)]
pub enum Apsis {
    Pericentre,
    Apocentre,
}

impl Orbit {
    pub fn start(self) -> State {
        let e = match self.from {
            Apsis::Pericentre => self.eccentricity,
            Apsis::Apocentre => -self.eccentricity,
        };
        [1.0 - e, 0.0, 0.0, ((1.0 + e) / (1.0 - e)).sqrt()]
    }

    pub fn duration(self) -> f64 {
        TAU * f64::from(self.periods)
    }

    /// Distance from the exact position.
    pub fn error(self, end: &State) -> f64 {
        let start = self.start();
        (end[0] - start[0]).hypot(end[1] - start[1])
    }
}

pub fn rate(y: &State) -> State {
    let r_sq = y[0] * y[0] + y[1] * y[1];
    let scale = -1.0 / (r_sq * r_sq.sqrt());
    [y[2], y[3], scale * y[0], scale * y[1]]
}

/// Where a solver ended, and how often it called the rate.
#[derive(Clone, Copy)]
pub struct Solved {
    pub end: State,
    pub evaluations: usize,
}

/// All, ours first.
pub fn solvers() -> Vec<Solver> {
    OURS.into_iter().chain(PEERS).collect()
}

/// A solver: orbit and tolerance (relative and absolute alike) to the end.
pub struct Solver {
    pub name: &'static str,
    pub solve: fn(Orbit, f64) -> Result<Solved, String>,
}

/// Ours.
pub const OURS: [Solver; 4] = [
    Solver { name: "ga-physics dop853", solve: ours::<ode::Dop853> },
    Solver { name: "ga-physics tsit5", solve: ours::<ode::Tsit5> },
    Solver { name: "ga-physics cash_karp", solve: ours::<ode::CashKarp> },
    Solver { name: "ga-physics rk4_doubling", solve: ours::<ode::Rk4Doubling> },
];

/// The solvers of the peers, each with its defaults but for the limit on the number of steps.
pub const PEERS: [Solver; 6] = [
    Solver { name: "ode_solvers dopri5", solve: ode_solvers_dopri5 },
    Solver { name: "ode_solvers dop853", solve: ode_solvers_dop853 },
    Solver { name: "differential-equations cash_karp", solve: differential_equations_cash_karp },
    Solver { name: "differential-equations dopri5", solve: differential_equations_dopri5 },
    Solver { name: "differential-equations dop853", solve: differential_equations_dop853 },
    Solver { name: "differential-equations rkv988e", solve: differential_equations_rkv988e },
];

struct Attraction;

impl System<f64, SVector<f64, 4>> for Attraction {
    fn system(&self, _t: f64, y: &SVector<f64, 4>, dy: &mut SVector<f64, 4>) {
        *dy = SVector::from(rate(&(*y).into()));
    }
}

impl ODE<f64, State> for Attraction {
    fn diff(&self, _t: f64, y: &State, dydt: &mut State) {
        *dydt = rate(y);
    }
}

/// Far above what any tolerance here needs.
const MOST_STEPS: u32 = 1_000_000;

fn ours<M: Embedded>(orbit: Orbit, tolerance: f64) -> Result<Solved, String> {
    let start = orbit.start();
    let stepper = Adaptive::<M, State, f64>::new(0.0, start, start, Tolerance { rtol: tolerance, atol: tolerance });
    let mut stepper = stepper.map_err(|error| error.to_string())?.with_max_steps(u64::from(MOST_STEPS));
    let mut system = |_t: f64, y: &State, dydt: &mut State| *dydt = rate(y);
    stepper.stop_at(orbit.duration());
    let mut end = start;
    stepper.advance_to(&mut system, orbit.duration(), &mut end).map_err(|error| error.to_string())?;
    Ok(Solved { end, evaluations: stepper.work().rhs_evals as usize })
}

/// The documented defaults of ode_solvers, with another limit on the steps and only the steps themselves as output.
macro_rules! ode_solvers_run {
    ($method:ident, $beta:expr, $least:expr, $most:expr, $orbit:expr, $tolerance:expr) => {{
        let (y, end) = (SVector::from($orbit.start()), $orbit.duration());
        let (t, sparse) = ($tolerance, OutputType::Sparse);
        let mut solver = $method::from_param(
            Attraction, 0.0, end, end, y, t, t, 0.9, $beta, $least, $most, end, 0.0, MOST_STEPS, 1000, sparse,
        );
        let stats = solver.integrate().map_err(|error| error.to_string())?;
        let last = solver.y_out().last().ok_or("no output")?;
        Ok(Solved { end: (*last).into(), evaluations: stats.num_eval as usize })
    }};
}

fn ode_solvers_dopri5(orbit: Orbit, tolerance: f64) -> Result<Solved, String> {
    ode_solvers_run!(Dopri5, 0.04, 0.2, 10.0, orbit, tolerance)
}

fn ode_solvers_dop853(orbit: Orbit, tolerance: f64) -> Result<Solved, String> {
    ode_solvers_run!(Dop853, 0.0, 0.333, 6.0, orbit, tolerance)
}

macro_rules! differential_equations_run {
    ($method:expr, $orbit:expr, $tolerance:expr) => {{
        let method = $method.rtol($tolerance).atol($tolerance).max_steps(MOST_STEPS as usize);
        let solution = IVP::ode(&Attraction, 0.0, $orbit.duration(), $orbit.start()).method(method).solve();
        let solution = solution.map_err(|error| format!("{error:?}"))?;
        Ok(Solved { end: *solution.y.last().ok_or("no output")?, evaluations: solution.evals.function })
    }};
}

fn differential_equations_cash_karp(orbit: Orbit, tolerance: f64) -> Result<Solved, String> {
    differential_equations_run!(ExplicitRungeKutta::cash_karp(), orbit, tolerance)
}

fn differential_equations_dopri5(orbit: Orbit, tolerance: f64) -> Result<Solved, String> {
    differential_equations_run!(ExplicitRungeKutta::dopri5(), orbit, tolerance)
}

fn differential_equations_dop853(orbit: Orbit, tolerance: f64) -> Result<Solved, String> {
    differential_equations_run!(ExplicitRungeKutta::dop853(), orbit, tolerance)
}

fn differential_equations_rkv988e(orbit: Orbit, tolerance: f64) -> Result<Solved, String> {
    differential_equations_run!(ExplicitRungeKutta::rkv988e(), orbit, tolerance)
}

/// The fewest evaluations with which a solver ends within `error`, over a ladder of tolerances (eight per decade, 1e-3 to
/// 1e-14), and the tolerance. None if none of them does.
pub fn fewest_evaluations(solver: &Solver, orbit: Orbit, error: f64) -> Option<(usize, f64)> {
    let ladder = (24..=112).map(|eighth| 10_f64.powf(-f64::from(eighth) / 8.0));
    let runs = ladder.filter_map(|tolerance| Some(((solver.solve)(orbit, tolerance).ok()?, tolerance)));
    let good = runs.filter(|(solved, _)| orbit.error(&solved.end) <= error);
    good.map(|(solved, tolerance)| (solved.evaluations, tolerance)).min_by_key(|&(evaluations, _)| evaluations)
}

//! Runs a case with every setting: errors, drift, violation, work; then times.
//!
//! A setting is run twice: once straight to its end, for its error and its work, and once with [`FRAMES`] stops, for
//! what a recording would show of energy and constraints. Only the first is timed. Fixed steps end at every stop;
//! methods that choose their steps are read between them, by their dense output.

use super::cases::{Case, Reference, largest_distance};
use crate::ode::{OdeError, Tolerance};
use crate::particle::{LinearSolver, Method, Motion, MotionError, Solver, Stabilisation, Steps};
use crate::study::StudyError;
use crate::study::timing::{self, Effort, Ratio, Timing};
use serde::Serialize;
use std::time::{Duration, Instant};

/// Stops of the run that is observed: a power of two, so that they are ends of steps.
const FRAMES: u32 = 32;

/// Which settings, and for how long they are timed.
#[derive(Clone, Copy, Debug)]
pub struct Scope {
    /// Numbers of steps, as exponents of 2.
    pub steps: Ladder,
    /// Tolerances, as exponents of 1/10.
    pub tolerances: Ladder,
    /// Time for the timing of a case.
    pub budget: Duration,
}

/// Exponents `first, first + stride, ..`, `count` of them.
#[derive(Clone, Copy, Debug)]
pub struct Ladder {
    /// The first.
    pub first: u32,
    /// From one to the next.
    pub stride: u32,
    /// How many.
    pub count: u32,
}

impl Ladder {
    /// The exponents.
    pub fn exponents(self) -> impl Iterator<Item = u32> {
        (0..self.count).map(move |i| self.first + i * self.stride)
    }
}

/// What a row is there for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Purpose {
    /// A point of a method's curve of work against precision.
    Curve,
    /// One of several ways to hold the constraints, at one step.
    Holding,
}

/// A solver as the study names it.
#[derive(Clone, Debug, Serialize)]
pub struct Setting {
    /// What it is there for.
    pub purpose: Purpose,
    /// The method, as scenes name it.
    pub method: &'static str,
    /// The number of steps, where it is fixed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<u32>,
    /// Their length, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dt_s: Option<f64>,
    /// The relative tolerance, where the method chooses its steps; the absolute one, in m and m/s, is the same number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rtol: Option<f64>,
    /// How constraint forces are found; none without constraints.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub constraints: Option<&'static str>,
    /// What keeps violations small; none for methods that project by themselves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stabilisation: Option<&'static str>,
    #[serde(skip)]
    pub(super) solver: Solver,
}

/// What a setting gave.
#[derive(Clone, Debug, Serialize)]
pub struct Figures {
    /// The largest distance of a particle from the reference at the end, m.
    pub error_m: f64,
    /// The largest change of the energy over the largest kinetic energy, at the frames.
    pub energy_drift_rel: f64,
    /// The largest violation of a constraint at the frames, m; none without constraints.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub violation_m: Option<f64>,
    /// Evaluations of the right-hand side; of accelerations, for splittings; substeps, for XPBD.
    pub rhs_evals: u64,
    /// Steps taken.
    pub accepted: u64,
    /// Steps tried and found too long.
    pub rejected: u64,
    /// What it took; none if the case was not timed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<Time>,
}

/// How long a run took, from the setup to the state at the end.
#[derive(Clone, Debug, Serialize)]
pub struct Time {
    /// Of one run.
    #[serde(flatten)]
    pub timing: Timing,
    /// Over RK4 in the middle of its steps, in the same rounds.
    pub ratio: Ratio,
}

/// How a run ended.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// At its end.
    Done(Figures),
    /// Before: the solver says why.
    Failed {
        /// In a sentence.
        reason: String,
    },
}

/// A setting and what it gave.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The setting.
    #[serde(flatten)]
    pub setting: Setting,
    /// What it gave.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// What one run took, to plan with.
    #[serde(skip)]
    pub(super) once: Duration,
}

impl Row {
    /// The figures of a run that arrived.
    #[must_use]
    pub fn figures(&self) -> Option<&Figures> {
        match &self.outcome {
            Outcome::Done(figures) => Some(figures),
            Outcome::Failed { .. } => None,
        }
    }
}

impl Setting {
    fn new(case: &Case, purpose: Purpose, solver: Solver) -> Self {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count below 2^32")]
        let (steps, dt_s, rtol) = match solver.steps {
            Steps::Fixed { dt_s } => (Some((case.end_s / dt_s).round() as u32), Some(dt_s), None),
            Steps::Adaptive { tolerance } => (None, None, Some(tolerance.rtol)),
        };
        let projects = solver.method.splits() || solver.method == Method::Xpbd;
        Self {
            purpose,
            method: solver.method.name(),
            steps,
            dt_s,
            rtol,
            constraints: case.is_held().then_some(match solver.linear {
                LinearSolver::Sweeps => "sweeps",
                LinearSolver::Direct => "direct",
                LinearSolver::ConjugateGradients => "conjugate_gradients",
            }),
            stabilisation: (case.is_held() && !projects).then_some(match solver.stabilisation {
                Stabilisation::None => "none",
                Stabilisation::Baumgarte { .. } => "baumgarte",
                Stabilisation::Projection => "projection",
            }),
            solver,
        }
    }
}

/// Every method with every step or tolerance of a scope, and the ways to hold constraints.
#[must_use]
pub fn settings(case: &Case, scope: &Scope) -> Vec<Setting> {
    let step_s = |exponent: u32| case.end_s / f64::from(1_u32 << exponent);
    let fixed = |exponent: u32| Steps::Fixed { dt_s: step_s(exponent) };
    let adaptive = |exponent: u32| {
        // The quotient is the nearest number to 1e-x; a power of 0.1 is not.
        let tolerance = 1.0 / 10_f64.powi(exponent.cast_signed());
        Steps::Adaptive { tolerance: Tolerance { rtol: tolerance, atol: tolerance } }
    };
    let mut solvers = Vec::new();
    for method in Method::ALL {
        // Position-based dynamics is for what is held; without it, it is Euler's method of another order of lines.
        let linears: &[LinearSolver] = match method {
            Method::Xpbd if !case.is_held() => &[],
            Method::Xpbd => &[LinearSolver::Sweeps, LinearSolver::Direct],
            _ => &[LinearSolver::Direct],
        };
        for linear in linears {
            let solver = |steps| case.solver(method, steps, *linear);
            if method.is_adaptive() {
                solvers.extend(scope.tolerances.exponents().map(|exponent| solver(adaptive(exponent))));
            } else {
                solvers.extend(scope.steps.exponents().map(|exponent| solver(fixed(exponent))));
            }
        }
    }
    let mut settings: Vec<_> = solvers.into_iter().map(|solver| Setting::new(case, Purpose::Curve, solver)).collect();
    if case.links.len() > 1 {
        let middle = step_s(scope.steps.first + scope.steps.stride * (scope.steps.count / 2));
        settings.extend(holdings(case, middle).map(|solver| Setting::new(case, Purpose::Holding, solver)));
    }
    settings
}

/// The ways to hold constraints, at one step.
fn holdings(case: &Case, dt_s: f64) -> impl Iterator<Item = Solver> {
    /// The rate times the step: violations decay within ten steps, as in scenes.
    const BAUMGARTE_STEPS: f64 = 0.1;
    let steps = Steps::Fixed { dt_s };
    let stabilisations =
        [Stabilisation::None, Stabilisation::Baumgarte { rate: BAUMGARTE_STEPS / dt_s }, Stabilisation::Projection];
    let linears = [LinearSolver::Direct, LinearSolver::ConjugateGradients];
    let by_rates = stabilisations.into_iter().flat_map(move |stabilisation| {
        linears.map(|linear| Solver { stabilisation, ..case.solver(Method::Rk4, steps, linear) })
    });
    by_rates.chain(linears.map(|linear| case.solver(Method::Verlet, steps, linear)))
}

/// Runs a setting, twice.
///
/// # Errors
/// The solver cannot be used.
pub fn run(case: &Case, setting: Setting, reference: &Reference) -> Result<Row, StudyError> {
    let mut straight = case.motion(&setting.solver)?;
    let mut observed = case.motion(&setting.solver)?;
    let start = Instant::now();
    let arrived = straight.advance_to(case.end_s);
    let once = start.elapsed();
    let figures = arrived.and_then(|()| {
        let (energy_drift_rel, violation_m) = observe(case, &mut observed)?;
        let work = straight.work();
        Ok(Figures {
            error_m: largest_distance(&straight.state().position, &reference.position),
            energy_drift_rel,
            violation_m,
            rhs_evals: work.rhs_evals,
            accepted: work.accepted,
            rejected: work.rejected,
            time: None,
        })
    });
    let outcome = match figures {
        Ok(figures) => Outcome::Done(figures),
        Err(error) => Outcome::Failed { reason: error.to_string() },
    };
    Ok(Row { setting, outcome, once })
}

/// Energy drift and the largest violation.
fn observe(case: &Case, motion: &mut Motion<f64>) -> Result<(f64, Option<f64>), OdeError<MotionError>> {
    let energy = motion.totals().energy();
    let (mut change, mut kinetic) = (0.0_f64, motion.totals().kinetic);
    let mut violation_m: Option<f64> = None;
    for frame in 1..=FRAMES {
        motion.advance_to(case.end_s * f64::from(frame) / f64::from(FRAMES))?;
        let totals = motion.totals();
        change = change.max((totals.energy() - energy).abs());
        kinetic = kinetic.max(totals.kinetic);
        let violation = motion.worst_violation().map(|(_, violation)| violation);
        violation_m = violation.map(|violation| violation_m.unwrap_or(0.0).max(violation));
    }
    Ok((change / kinetic, violation_m))
}

/// Times the rows that arrived, in as many rounds as a budget allows; their number.
pub fn time(case: &Case, rows: &mut [Row], budget: Duration) -> usize {
    /// So that the clock and the scheduler do not count; see [`Effort`].
    const SAMPLE: Duration = Duration::from_micros(300);
    /// Bounds of the rounds: a median, and more than anyone needs.
    const ROUNDS: (u32, u32) = (3, 101);
    let timed: Vec<usize> = (0..rows.len()).filter(|index| rows[*index].figures().is_some()).collect();
    let run = |index: usize| {
        // It has arrived before, and does so again.
        if let Ok(mut motion) = case.motion(&rows[index].setting.solver) {
            let _ = std::hint::black_box(motion.advance_to(case.end_s));
        }
    };
    let round: Duration = timed.iter().map(|index| rows[*index].once.max(SAMPLE)).sum();
    let fit = (budget.as_secs_f64() / round.as_secs_f64().max(1e-3)).min(f64::from(ROUNDS.1));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 101")]
    let rounds = (fit as u32).max(ROUNDS.0) as usize;
    let passes: Vec<_> = timed.iter().map(|index| move || run(*index)).collect();
    let rivals: Vec<&dyn Fn()> = passes.iter().map(|pass| pass as &dyn Fn()).collect();
    let samples = timing::measure(&rivals, 1, Effort { rounds, sample: SAMPLE });
    let reference = middle(rows).and_then(|row| timed.iter().position(|index| *index == row)).unwrap_or(0);
    let times: Vec<Time> = (0..timed.len())
        .map(|rival| Time { timing: samples.timing(rival), ratio: samples.ratio(rival, reference) })
        .collect();
    for (index, time) in timed.into_iter().zip(times) {
        if let Outcome::Done(figures) = &mut rows[index].outcome {
            figures.time = Some(time);
        }
    }
    rounds
}

/// RK4 in the middle of the steps with which it arrives: what others are compared with.
#[must_use]
pub fn middle(rows: &[Row]) -> Option<usize> {
    let is_rk4 = |row: &Row| row.setting.method == Method::Rk4.name() && row.setting.purpose == Purpose::Curve;
    let arrived: Vec<usize> =
        (0..rows.len()).filter(|index| is_rk4(&rows[*index]) && rows[*index].figures().is_some()).collect();
    arrived.get(arrived.len() / 2).copied()
}

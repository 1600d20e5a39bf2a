//! Runs a case with every setting: errors, drift, violation, work; then times.
//!
//! A setting is run twice: once straight to its end, for its error and its work, and once with [`FRAMES`] stops, for
//! what a recording would show of energy and constraints. Only the first is timed. Fixed steps end at every stop;
//! methods that choose their steps are read between them, by their dense output.

use super::cases::{Case, Reference, largest_distance};
use super::row::{Figures, Outcome, Purpose, Row, Setting, Time};
use crate::ode::{OdeError, Tolerance};
use crate::particle::{LinearSolver, Method, Motion, MotionError, Solver, Stabilisation, Steps};
use crate::study::StudyError;
use crate::study::timing::{self, Effort};
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
        // Position-based dynamics is for what is held; without it is Euler's method that moves by the new velocity.
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

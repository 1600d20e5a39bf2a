//! A setting of a solver, and what it gave.

use super::cases::Case;
use crate::particle::{LinearSolver, Method, Solver, Stabilisation, Steps};
use crate::study::timing::{Ratio, Timing};
use serde::Serialize;
use std::time::Duration;

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
    pub(super) fn new(case: &Case, purpose: Purpose, solver: Solver) -> Self {
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

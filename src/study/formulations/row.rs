//! A formulation with an integrator and its steps, and what it gave.

use super::case::END_S;
use crate::ode::Tolerance;
use crate::rigid::{Form, Method, Solver, Steps};
use crate::study::timing::{Ratio, Timing};
use serde::Serialize;
use std::time::Duration;

/// What is run.
#[derive(Clone, Debug, Serialize)]
pub struct Setting {
    /// The formulation.
    pub form: &'static str,
    /// The integrator, as scenes name it.
    pub method: &'static str,
    /// The number of steps, where it is fixed; none for free flight, which makes none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<u32>,
    /// The relative and absolute tolerance, where the method chooses its steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    #[serde(skip)]
    pub(super) solver: Solver,
}

impl Setting {
    /// Steps of one length.
    pub(super) fn fixed(form: Form, method: Method, steps: u32) -> Self {
        let solver = Solver::fixed(method, END_S / f64::from(steps)).in_form(form);
        let steps = (method != Method::FreeFlight).then_some(steps);
        Self { form: form.name(), method: method.name(), steps, tolerance: None, solver }
    }

    /// Steps by a tolerance.
    pub(super) fn adaptive(form: Form, method: Method, tolerance: f64) -> Self {
        let steps = Steps::Adaptive { tolerance: Tolerance { rtol: tolerance, atol: tolerance } };
        let solver = Solver { steps, ..Solver::fixed(method, 1.0).in_form(form) };
        Self { form: form.name(), method: method.name(), steps: None, tolerance: Some(tolerance), solver }
    }

    /// `rotor rk4`, `rotor tsit5 by tolerance`
    #[must_use]
    pub fn way(&self) -> String {
        let by = if self.tolerance.is_some() { " by tolerance" } else { "" };
        format!("{} {}{by}", self.form, self.method)
    }

    /// `1e-6`, `dt 0.01 s`
    pub(super) fn step(&self) -> String {
        match (self.tolerance, self.steps) {
            (Some(tolerance), _) => format!("{tolerance:.0e}"),
            (None, Some(steps)) => format!("dt {:.2e} s", END_S / f64::from(steps)),
            (None, None) => "no steps".into(),
        }
    }
}

/// What a run gave.
#[derive(Clone, Debug, Serialize)]
pub struct Figures {
    /// The angle to the reference at the end, rad.
    pub error_rad: f64,
    /// The largest change of the energy over the energy, at the frames.
    pub energy_drift_rel: f64,
    /// Likewise of the length of the angular momentum. Every formulation keeps it as a state of its own.
    pub momentum_drift_rel: f64,
    /// The largest `| |R|² - 1 |` at the frames; of a matrix the largest entry of `R^T R - 1`.
    pub norm_drift: f64,
    /// Evaluations of the right-hand side.
    pub rhs_evals: u64,
    /// Steps taken.
    pub accepted: u64,
    /// What it took, if it was timed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time: Option<Time>,
}

/// How long a run took, from the setup to the state at the end.
#[derive(Clone, Debug, Serialize)]
pub struct Time {
    /// Of one run.
    #[serde(flatten)]
    pub timing: Timing,
    /// Over the plain RK4 with 10,000 steps, in the same rounds.
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

    /// Over the plain RK4.
    #[must_use]
    pub fn ratio(&self) -> Option<Ratio> {
        self.figures().and_then(|figures| figures.time.as_ref()).map(|time| time.ratio)
    }
}

//! How the motion is solved.

use crate::particle;
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// How the motion is solved. `method` and what follows apply to particles; bodies are stepped by RK4 in rotor form.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Solver {
    /// The number type of everything but world positions, which are always f64.
    #[serde(default)]
    pub scalar: Scalar,
    /// The integrator of the particles. Without it the plan chooses one, and says why.
    #[schemars(with = "Option<Method>")]
    pub method: Option<Spanned<Method>>,
    /// The error that a step may make relative to a coordinate or velocity, dimensionless. With it a method that can
    /// chooses its steps; without it, and with `dt_s`, it makes steps of `dt_s`, as for a recording.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub rtol: Option<Spanned<f64>>,
    /// The error that a step may make where a coordinate or velocity is near zero, in m and m/s.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub atol: Option<Spanned<f64>>,
    /// How the constraint forces are solved for. Without it the plan chooses by the number of constraints.
    #[schemars(with = "Option<ConstraintSolver>")]
    pub constraints: Option<Spanned<ConstraintSolver>>,
    /// What keeps particles on their constraints against the errors of the steps.
    #[serde(default)]
    pub stabilisation: Stabilisation,
    /// The largest violation of a constraint that projection and `xpbd` leave, relative to the shortest length that is
    /// held. Default 1e-12, with sweeps 1e-2.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub violation: Option<Spanned<f64>>,
    /// Substeps a step of `xpbd`. At least 1. Default: with sweeps, as many as hold the violation at rest; else 1.
    #[schemars(with = "Option<u32>", range(min = 1))]
    pub substeps: Option<Spanned<u32>>,
}

/// A number type.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scalar {
    /// 64-bit floating point, about 16 digits.
    #[default]
    F64,
    /// 32-bit floating point, about 7 digits.
    F32,
}

/// An integrator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Euler's, order 1, steps of `dt_s`. To see how bad it is.
    Euler,
    /// The classical Runge-Kutta method, order 4, steps of `dt_s`.
    Rk4,
    /// The classical Runge-Kutta method; with `rtol` steps are chosen by comparing one with two halves.
    Rk4Doubling,
    /// Cash and Karp's Runge-Kutta pair, order 5(4); steps are chosen with `rtol`.
    CashKarp,
    /// Tsitouras' Runge-Kutta pair, order 5(4); steps are chosen with `rtol`.
    Tsit5,
    /// Dormand and Prince's Runge-Kutta method of order 8; steps are chosen with `rtol`.
    Dop853,
    /// Velocity Verlet, order 2, steps of `dt_s`; with constraints RATTLE. Keeps energy over long times.
    Verlet,
    /// Yoshida's composition of three Verlet steps, order 4, steps of `dt_s`.
    Yoshida4,
    /// Yoshida's composition of seven Verlet steps, order 6, steps of `dt_s`.
    Yoshida6,
    /// Extended position-based dynamics, order 1, steps of `dt_s`: for large nets, and where a net snaps taut.
    Xpbd,
}

impl Method {
    /// Whether it estimates its error, and so can choose its steps.
    #[must_use]
    pub fn is_adaptive(self) -> bool {
        self.of_particles().is_adaptive()
    }

    /// As it is written in a scene.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.of_particles().name()
    }

    /// The same for particles.
    #[must_use]
    pub fn of_particles(self) -> particle::Method {
        match self {
            Self::Euler => particle::Method::Euler,
            Self::Rk4 => particle::Method::Rk4,
            Self::Rk4Doubling => particle::Method::Rk4Doubling,
            Self::CashKarp => particle::Method::CashKarp,
            Self::Tsit5 => particle::Method::Tsit5,
            Self::Dop853 => particle::Method::Dop853,
            Self::Verlet => particle::Method::Verlet,
            Self::Yoshida4 => particle::Method::Yoshida4,
            Self::Yoshida6 => particle::Method::Yoshida6,
            Self::Xpbd => particle::Method::Xpbd,
        }
    }
}

/// How the constraint forces are solved for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ConstraintSolver {
    /// A sparse factorisation.
    Direct,
    /// Conjugate gradients, as in the report.
    ConjugateGradients,
    /// Not at all: link by link, again and again. For `xpbd`, which without it corrects all at once.
    Sweeps,
}

impl ConstraintSolver {
    /// As it is written in a scene.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Direct => "direct",
            Self::ConjugateGradients => "conjugate_gradients",
            Self::Sweeps => "sweeps",
        }
    }
}

/// What keeps particles on their constraints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Stabilisation {
    /// After each step positions and velocities are put back on the constraints.
    #[default]
    Projection,
    /// Baumgarte's: violations are damped as by a spring (report, section 2.1.2, after its source).
    Baumgarte,
    /// Nothing: errors grow.
    None,
}

impl Stabilisation {
    /// As it is written in a scene.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Projection => "projection",
            Self::Baumgarte => "baumgarte",
            Self::None => "none",
        }
    }
}

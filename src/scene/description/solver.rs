//! How the motion is solved.

use super::Formulation;
use crate::{particle, rigid};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// How the motion is solved.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Solver {
    /// The number type of everything but world positions, which are always f64.
    #[serde(default)]
    pub scalar: Scalar,
    /// The integrator. Without it the plan chooses one, and says why; so it does for what this one cannot move.
    #[schemars(with = "Option<Method>")]
    pub method: Option<Spanned<Method>>,
    /// The error that a step may make relative to a coordinate or velocity, dimensionless. With it a method that can
    /// chooses its steps; without it, and with `dt_s`, it makes steps of `dt_s`, as for a recording.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub rtol: Option<Spanned<f64>>,
    /// The error that a step may make where a coordinate or velocity is near zero, in m and m/s.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub atol: Option<Spanned<f64>>,
    /// How the forces that hold particles are solved for. Without it the plan chooses by the number of constraints.
    #[schemars(with = "Option<ConstraintSolver>")]
    pub constraints: Option<Spanned<ConstraintSolver>>,
    /// What keeps particles on their constraints against the errors of the steps.
    #[serde(default)]
    pub stabilisation: Stabilisation,
    /// The largest violation of a constraint that projection and `xpbd` leave, relative to the shortest length that is
    /// held; of a joint, relative to the smallest one. Default 1e-12, of joints 1e-13, with sweeps 1e-2.
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
    /// Euler's, order 1, steps of `dt_s`. To see how bad it is. For particles.
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
    /// Velocity Verlet, order 2, steps of `dt_s`; with constraints RATTLE. Keeps energy over long times. Bodies, in rotor
    /// form, turn exactly between its kicks.
    Verlet,
    /// Yoshida's composition of three Verlet steps, order 4, steps of `dt_s`.
    Yoshida4,
    /// Yoshida's composition of seven Verlet steps, order 6, steps of `dt_s`.
    Yoshida6,
    /// Extended position-based dynamics, order 1, steps of `dt_s`: for large nets, and where a net snaps taut. For
    /// particles.
    Xpbd,
    /// The exact motion without torque, by elliptic functions: no steps. For bodies in rotor form under uniform gravity.
    FreeFlight,
    /// Munthe-Kaas' Runge-Kutta method on the group, order 4, steps of `dt_s`. For bodies as rotor or motor.
    Rkmk4,
    /// A commutator-free method on the group, order 4, with an error estimate: steps are chosen with `rtol`. For bodies as
    /// rotor or motor.
    CommutatorFree,
    /// As `verlet`, with turns about the three principal axes in the place of the exact motion. For bodies in rotor form.
    Splitting2,
    /// As `yoshida4`, of `splitting2`.
    Splitting4,
    /// As `yoshida6`, of `splitting2`.
    Splitting6,
}

impl Method {
    /// As it is written in a scene.
    #[must_use]
    pub fn name(self) -> &'static str {
        let of_particles = self.of_particles().map(particle::Method::name);
        of_particles.or(self.of_bodies().map(rigid::Method::name)).unwrap_or_default()
    }

    /// The same for particles; none if it moves bodies only.
    #[must_use]
    pub fn of_particles(self) -> Option<particle::Method> {
        Some(match self {
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
            Self::FreeFlight
            | Self::Rkmk4
            | Self::CommutatorFree
            | Self::Splitting2
            | Self::Splitting4
            | Self::Splitting6 => return None,
        })
    }

    /// The same for bodies; none if it moves particles only.
    #[must_use]
    pub fn of_bodies(self) -> Option<rigid::Method> {
        Some(match self {
            Self::Euler | Self::Xpbd => return None,
            Self::Rk4 => rigid::Method::Rk4,
            Self::Rk4Doubling => rigid::Method::Rk4Doubling,
            Self::CashKarp => rigid::Method::CashKarp,
            Self::Tsit5 => rigid::Method::Tsit5,
            Self::Dop853 => rigid::Method::Dop853,
            Self::Verlet => rigid::Method::Verlet,
            Self::Yoshida4 => rigid::Method::Yoshida4,
            Self::Yoshida6 => rigid::Method::Yoshida6,
            Self::FreeFlight => rigid::Method::FreeFlight,
            Self::Rkmk4 => rigid::Method::Rkmk4,
            Self::CommutatorFree => rigid::Method::CommutatorFree,
            Self::Splitting2 => rigid::Method::Splitting2,
            Self::Splitting4 => rigid::Method::Splitting4,
            Self::Splitting6 => rigid::Method::Splitting6,
        })
    }

    /// Whether it moves bodies of a formulation.
    #[must_use]
    pub fn moves(self, formulation: Formulation) -> bool {
        self.of_bodies().is_some_and(|method| method.fits(formulation.form()))
    }

    /// Whether it estimates its error, and so can choose its steps.
    #[must_use]
    pub fn is_adaptive(self) -> bool {
        let of_particles = self.of_particles().is_some_and(particle::Method::is_adaptive);
        of_particles || self.of_bodies().is_some_and(rigid::Method::is_adaptive)
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

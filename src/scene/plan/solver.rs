//! Which solver the particles of a scene get, where the scene leaves it open.

use super::adapts;
use super::particles::Census;
use crate::ode::Tolerance;
use crate::particle::{self, LinearSolver, Steps};
use crate::scene::description::{ConstraintSolver, Method, Scalar, Scene, Stabilisation};
use serde::Serialize;

/// Tolerances where the scene gives none: three digits above the least of the scalar that error control can work with.
const RTOL_F64: f64 = 1e-9;
const RTOL_F32: f64 = 1e-5;
/// Below this relative tolerance DOP853 takes fewer evaluations than Tsit5: on a Kepler orbit of eccentricity 0.6, 1478
/// against 1773 for a final error of 1e-6, 2514 against 9670 for 1e-9.
const HIGH_ORDER_BELOW: f64 = 1e-6;
/// From so many constraints on, a step that solves for all forces at once takes longer than a frame of a display, and
/// the plan takes sweeps.
const SWEEPS_FROM: usize = 20_000;
/// Up to so many constraints the plan takes a method of high order, but not for nets: where those snap taut no high order
/// helps, and RATTLE goes on.
const HIGH_ORDER_UP_TO: usize = 64;
/// Up to so many constraints a sparse factorisation takes less than a second and less than a hundred megabytes.
const DIRECT_UP_TO: usize = 50_000;
/// Violations that are left where the scene says nothing, relative to the shortest length: what projection reaches from
/// anywhere, and what is just seen.
const VIOLATION: f64 = 1e-12;
const VIOLATION_BY_SWEEPS: f64 = 1e-2;
/// Of joints there are few, and projection goes to rounding.
const VIOLATION_OF_JOINTS: f64 = 1e-13;
/// In f32 velocities err by this in the time of a step: lengths are not better.
const VIOLATION_F32: f64 = 1e-6;

/// Baumgarte's rate times the step: violations decay within ten steps, far from the limit of stability of any method (2).
const BAUMGARTE_STEPS: f64 = 0.1;

/// How the motion of the particles is solved: what the scene says, and for the rest what the plan chooses.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SolverPlan {
    /// The integrator.
    pub method: Method,
    /// Why it.
    pub why: String,
    /// Relative tolerance, for methods that choose their steps.
    pub rtol: f64,
    /// Absolute tolerance, m and m/s, for methods that choose their steps.
    pub atol: f64,
    /// How the constraint forces are solved for.
    pub constraints: ConstraintSolver,
    /// What keeps particles on their constraints.
    pub stabilisation: Stabilisation,
    /// The violation that is left, relative to the shortest length that is held.
    pub violation: f64,
    /// Substeps a step of `xpbd`; none: as many as hold the violation at rest.
    pub substeps: Option<u32>,
    /// Steps are chosen by their error; else they are `dt_s`.
    pub adaptive: bool,
    #[serde(skip)]
    integrator: particle::Method,
}

impl SolverPlan {
    /// The solver of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        choose(scene, &Census::of(scene))
    }

    /// The same for particles, with the step of a scene, s.
    #[must_use]
    pub fn of_particles(&self, dt_s: f64) -> particle::Solver {
        let tolerance = Tolerance { rtol: self.rtol, atol: self.atol };
        particle::Solver {
            method: self.integrator,
            steps: if self.adaptive { Steps::Adaptive { tolerance } } else { Steps::Fixed { dt_s } },
            linear: match self.constraints {
                ConstraintSolver::Direct => LinearSolver::Direct,
                ConstraintSolver::ConjugateGradients => LinearSolver::ConjugateGradients,
                ConstraintSolver::Sweeps => LinearSolver::Sweeps,
            },
            stabilisation: match self.stabilisation {
                Stabilisation::Projection => particle::Stabilisation::Projection,
                Stabilisation::Baumgarte => particle::Stabilisation::Baumgarte { rate: BAUMGARTE_STEPS / dt_s },
                Stabilisation::None => particle::Stabilisation::None,
            },
            violation: self.violation,
            substeps: self.substeps.map(|substeps| substeps as usize),
        }
    }

    /// Is it of order 1 in forces that depend on the velocity?
    pub(super) fn splits(&self) -> bool {
        self.integrator.splits()
    }

    /// Evaluations of the forces a step; none if it depends on the motion.
    pub(super) fn evals_per_step(&self) -> Option<u64> {
        match self.method {
            Method::Euler | Method::Verlet => Some(1),
            Method::Rk4 => Some(4),
            Method::Yoshida4 => Some(3),
            Method::Yoshida6 => Some(7),
            Method::Xpbd => self.substeps.map(u64::from),
            _ if self.adaptive => None,
            Method::Rk4Doubling => Some(4),
            Method::CashKarp | Method::Tsit5 => Some(6),
            Method::Dop853 => Some(12),
            // These move no particles.
            Method::FreeFlight
            | Method::Rkmk4
            | Method::CommutatorFree
            | Method::Splitting2
            | Method::Splitting4
            | Method::Splitting6 => None,
        }
    }
}

/// The violation that is left where constraints or joints are solved for all at once.
pub(super) fn violation(scene: &Scene) -> f64 {
    let least = if scene.solver.scalar == Scalar::F32 { VIOLATION_F32 } else { VIOLATION };
    scene.solver.violation.as_ref().map_or(least, |violation| *violation.get_ref())
}

/// The violation of joints that is left.
pub(super) fn joint_violation(scene: &Scene) -> f64 {
    let least = if scene.solver.scalar == Scalar::F32 { VIOLATION_F32 } else { VIOLATION_OF_JOINTS };
    scene.solver.violation.as_ref().map_or(least, |violation| *violation.get_ref())
}

/// The relative tolerance of a scene.
pub(super) fn rtol(scene: &Scene) -> f64 {
    let default = if scene.solver.scalar == Scalar::F32 { RTOL_F32 } else { RTOL_F64 };
    scene.solver.rtol.as_ref().map_or(default, |rtol| *rtol.get_ref())
}

/// The relative and the absolute tolerance of a scene.
pub(super) fn tolerated(scene: &Scene) -> (f64, f64) {
    let rtol = rtol(scene);
    (rtol, scene.solver.atol.as_ref().map_or(rtol, |atol| *atol.get_ref()))
}

/// Whether a method of order 8 takes fewer evaluations for a tolerance than one of order 5.
pub(super) fn high_order_pays(rtol: f64) -> bool {
    rtol < HIGH_ORDER_BELOW
}

pub(super) fn choose(scene: &Scene, census: &Census) -> SolverPlan {
    let (rtol, atol) = tolerated(scene);
    let named = scene.solver.method.as_ref().map(|method| *method.get_ref());
    // One that moves bodies only counts for these.
    let named = named.and_then(|method| Some((method, method.of_particles()?)));
    let (method, integrator, why) = match named {
        Some((method, integrator)) => (method, integrator, "the scene names it".to_owned()),
        None => best(scene, census, rtol),
    };
    let constraints = scene.solver.constraints.as_ref().map(|by| *by.get_ref()).unwrap_or(match () {
        () if method == Method::Xpbd => ConstraintSolver::Sweeps,
        () if scene.net.is_empty() || census.constraints <= DIRECT_UP_TO => ConstraintSolver::Direct,
        () => ConstraintSolver::ConjugateGradients,
    });
    let swept = constraints == ConstraintSolver::Sweeps && scene.solver.violation.is_none();
    SolverPlan {
        method,
        integrator,
        why,
        rtol,
        atol,
        constraints,
        stabilisation: scene.solver.stabilisation,
        violation: if swept { VIOLATION_BY_SWEEPS } else { violation(scene) },
        substeps: scene.solver.substeps.as_ref().map(|substeps| *substeps.get_ref()),
        adaptive: method.is_adaptive() && adapts(scene),
    }
}

fn best(scene: &Scene, census: &Census, rtol: f64) -> (Method, particle::Method, String) {
    let n = census.constraints;
    if adapts(scene) {
        let (method, integrator, order) = match high_order_pays(rtol) {
            true => (Method::Dop853, particle::Method::Dop853, "high"),
            false => (Method::Tsit5, particle::Method::Tsit5, "low"),
        };
        return (method, integrator, format!("steps by error, and a tolerance at which a {order} order pays"));
    }
    // Chains and trees are factored in the time of a sweep, however long they are.
    let net = !scene.net.is_empty();
    if net && n >= SWEEPS_FROM {
        return (Method::Xpbd, particle::Method::Xpbd, format!("{n} constraints: fast rather than accurate"));
    }
    if net || n > HIGH_ORDER_UP_TO {
        let why = format!("steps of `dt_s` and {n} constraints: RATTLE bears it when they snap taut");
        return (Method::Verlet, particle::Method::Verlet, why);
    }
    if n > 0 || census.drags > 0 {
        let why = "steps of `dt_s`, and constraints or drag: a high order".to_owned();
        return (Method::Tsit5, particle::Method::Tsit5, why);
    }
    let why = "steps of `dt_s`, and forces that keep the energy: so does it".to_owned();
    (Method::Yoshida4, particle::Method::Yoshida4, why)
}

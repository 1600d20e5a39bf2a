//! How the bodies of a scene are moved: one solver for each formulation that moving bodies are written in.

use super::solver::{high_order_pays, joint_violation, rtol, tolerated};
use super::steps::wants_error_control;
use crate::algebra::cga::Point;
use crate::ode::Tolerance;
use crate::rigid::{self, Steps};
use crate::scene::bodies::Loads;
use crate::scene::description::{Formulation, Method, Scalar, Scene};
use serde::Serialize;

/// How the motion of the bodies of one formulation is solved: what the scene says, and for the rest what the plan chooses.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodySolverPlan {
    /// The formulation.
    pub formulation: Formulation,
    /// The bodies that move.
    pub bodies: usize,
    /// The integrator.
    pub method: Method,
    /// Why it.
    pub why: String,
    /// Relative tolerance, for methods that choose their steps.
    pub rtol: f64,
    /// Absolute tolerance, m and m/s, for methods that choose their steps.
    pub atol: f64,
    /// Steps are chosen by their error; else they are `dt_s`, or none.
    pub adaptive: bool,
    /// The violation of joints that is left, relative to the smallest joint.
    pub violation: f64,
    /// Joints.
    pub joints: usize,
    /// Degrees of freedom that the joints take, those that several take counted as often.
    pub joint_rows: usize,
    /// State of one body, bytes.
    pub state_bytes_per_body: usize,
    #[serde(skip)]
    integrator: rigid::Method,
}

/// The formulations of the bodies that move, each once.
#[must_use]
pub fn formulations(scene: &Scene) -> Vec<Formulation> {
    let used = |formulation: &Formulation| {
        scene.body.iter().any(|body| !body.fixed && scene.formulation_of(body) == *formulation)
    };
    Formulation::ALL.into_iter().filter(used).collect()
}

impl BodySolverPlan {
    /// The solvers of a scene, one for each formulation of moving bodies.
    #[must_use]
    pub fn of(scene: &Scene) -> Vec<Self> {
        formulations(scene).into_iter().map(|formulation| choose(scene, formulation)).collect()
    }

    /// Whether the motion is evaluated and not stepped.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.method == Method::FreeFlight
    }

    /// The same for bodies in motion, with the step of a scene.
    #[must_use]
    pub fn of_bodies(&self, dt_s: f64) -> rigid::Solver {
        let tolerance = Tolerance { rtol: self.rtol, atol: self.atol };
        rigid::Solver {
            form: self.formulation.form(),
            method: self.integrator,
            steps: if self.adaptive { Steps::Adaptive { tolerance } } else { Steps::Fixed { dt_s } },
            violation: self.violation,
        }
    }

    /// Evaluations of forces and equations of motion a step; none if the method chooses its steps.
    pub(super) fn evals_per_step(&self) -> Option<u64> {
        match self.method {
            _ if self.adaptive => None,
            Method::FreeFlight | Method::Euler | Method::Xpbd => Some(0),
            Method::Verlet | Method::Splitting2 => Some(1),
            Method::Yoshida4 | Method::Splitting4 => Some(3),
            Method::Yoshida6 | Method::Splitting6 => Some(7),
            Method::Rk4 | Method::Rk4Doubling | Method::Rkmk4 => Some(4),
            Method::CommutatorFree => Some(4),
            Method::CashKarp | Method::Tsit5 => Some(6),
            Method::Dop853 => Some(12),
        }
    }
}

/// State of one body, bytes: its position in f64 and numbers of the scalar, momenta for six of them.
pub(super) fn state_bytes(formulation: Formulation, scalar: Scalar) -> usize {
    let numbers = match formulation {
        Formulation::Matrix => 9 + 6,
        Formulation::Quaternion | Formulation::Rotor => 4 + 6,
        Formulation::Motor => 8 + 6,
    };
    let size = if scalar == Scalar::F32 { size_of::<f32>() } else { size_of::<f64>() };
    size_of::<Point<f64>>() + numbers * size
}

fn choose(scene: &Scene, formulation: Formulation) -> BodySolverPlan {
    let loads = Loads::of(scene, formulation);
    let named = scene.solver.method.as_ref().map(|method| *method.get_ref());
    let fits = |method: Method| method.of_bodies().filter(|of_bodies| of_bodies.fits(formulation.form()));
    let (method, integrator, why) = match named.and_then(|method| Some((method, fits(method)?))) {
        Some((method, integrator)) => (method, integrator, "the scene names it".to_owned()),
        None => {
            let (method, integrator, why) = best(scene, formulation, &loads);
            let other =
                named.map_or_else(String::new, |other| format!(" (`{}` is not for these bodies)", other.name()));
            (method, integrator, format!("{why}{other}"))
        }
    };
    let (rtol, atol) = tolerated(scene);
    BodySolverPlan {
        formulation,
        bodies: loads.bodies,
        method,
        why,
        rtol,
        atol,
        adaptive: method.is_adaptive() && wants_error_control(scene),
        violation: joint_violation(scene),
        joints: loads.joints,
        joint_rows: loads.joint_rows,
        state_bytes_per_body: state_bytes(formulation, scene.solver.scalar),
        integrator,
    }
}

/// What the plan chooses, and why.
fn best(scene: &Scene, formulation: Formulation, loads: &Loads) -> (Method, rigid::Method, &'static str) {
    let rotor = formulation == Formulation::Rotor;
    if rotor && loads.none() {
        let why = "no torque acts: the exact motion, without steps";
        return (Method::FreeFlight, rigid::Method::FreeFlight, why);
    }
    if wants_error_control(scene) {
        return match high_order_pays(rtol(scene)) {
            true => {
                (Method::Dop853, rigid::Method::Dop853, "steps by error, and a tolerance at which a high order pays")
            }
            false => (Method::Tsit5, rigid::Method::Tsit5, "steps by error, and a tolerance at which a low order pays"),
        };
    }
    if !rotor {
        return (Method::Rk4, rigid::Method::Rk4, "steps of `dt_s`, by the method that all formulations have");
    }
    if loads.dissipate() {
        let why = "steps of `dt_s`, and forces that depend on the velocity: a high order";
        return (Method::Tsit5, rigid::Method::Tsit5, why);
    }
    let why = "steps of `dt_s`: exact turns between kicks of forces and joints, which keep the energy";
    (Method::Yoshida4, rigid::Method::Yoshida4, why)
}

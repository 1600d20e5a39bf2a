//! How the bodies of a scene are moved: one solver for each formulation that moving bodies are written in.

use super::solver::{high_order_pays, joint_violation, rtol, tolerated};
use super::steps::wants_error_control;
use super::{Plan, joined_pairs, scalar_name};
use crate::algebra::cga::Point;
use crate::ode::Tolerance;
use crate::rigid::{self, Steps};
use crate::scene::bodies::Loads;
use crate::scene::description::{Body, Formulation, Method, Scalar, Scene, Shape};
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
            // The kick at the start of a step is evaluated anew, for something may have struck since.
            Method::Verlet | Method::Splitting2 => Some(2),
            Method::Yoshida4 | Method::Splitting4 => Some(4),
            Method::Yoshida6 | Method::Splitting6 => Some(8),
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
    if loads.dissipate() {
        let why = "steps of `dt_s`, and forces that depend on the velocity: a high order";
        return (Method::Tsit5, rigid::Method::Tsit5, why);
    }
    if loads.joints > 0 {
        // In the scenes of chains, loops, pendulums and tops RATTLE of order 4 takes two to five times the time, at 100 times the
        // error and more.
        let why = "steps of `dt_s`, and joints: a high order errs less than exact turns between kicks, in less time";
        return (Method::Tsit5, rigid::Method::Tsit5, why);
    }
    if !rotor {
        return (Method::Rk4, rigid::Method::Rk4, "steps of `dt_s`, by the method that all formulations have");
    }
    let why = "steps of `dt_s`: exact turns between kicks of forces, which keep the energy";
    (Method::Yoshida4, rigid::Method::Yoshida4, why)
}

impl Plan {
    pub(super) fn rigid_bodies(&mut self, scene: &Scene, loads: &Loads) {
        if scene.body.is_empty() {
            return self.leave_out("bodies", "the scene has no [[body]]");
        }
        let scalar = scalar_name(scene);
        for solver in self.body_solvers.clone() {
            self.moved(scene, scalar, &solver);
        }
        let (points, torques) = (loads.at_points, loads.torques);
        let how = format!("{points}, steps cut where they start and end");
        self.choose(points > 0, "forces at points", &how, "no [[force]] names one");
        let how = format!("{torques}, steps cut where they start and end");
        self.choose(torques > 0, "torques", &how, "no [[force]] `torque`");
        self.choose(loads.drags > 0, "drag on bodies", &format!("linear, {}", loads.drags), "no [[force]] names one");
        let how = format!("{}, {} with a damper", loads.springs, loads.dampers);
        self.choose(loads.springs > 0, "springs on bodies", &how, "no [[force]] `spring` names one");
        let violation = self.body_solvers.first().map_or(0.0, |solver| solver.violation);
        let how = format!("{}, {} rows, held to {violation:e} of the smallest", loads.joints, loads.joint_rows);
        self.choose(loads.joints > 0, "joints", &how, "the scene has no [[joint]]");
        self.collisions(scene);
    }

    /// How the bodies of one formulation are moved.
    fn moved(&mut self, scene: &Scene, scalar: &str, solver: &BodySolverPlan) {
        let count = if solver.bodies == 1 { "1 body".into() } else { format!("{} bodies", solver.bodies) };
        let form = match solver.formulation {
            Formulation::Matrix => "3x3 rotation matrix, not renormalised",
            Formulation::Quaternion => "unit quaternion",
            Formulation::Rotor => "G(3,0) rotor form",
            Formulation::Motor => "conformal motor form",
        };
        self.model("rigid motion", format!("{count}, {form}, {scalar} with f64 world positions"));
        let name = solver.method.name();
        self.model("solver of bodies", format!("`{name}`: {}", solver.why));
        if solver.adaptive {
            let how = format!("rtol {:e}, atol {:e}, the largest of all errors", solver.rtol, solver.atol);
            self.model("their steps", how);
        } else if scene.solver.rtol.is_some() {
            self.leave_out("tolerances of bodies", &format!("`{name}` does not control its error"));
        }
        if solver.is_exact() {
            let why = match self.collision_pairs {
                0 => "the motion is evaluated at each frame, however far apart",
                _ => "the motion is evaluated every `dt_s`, to look for collisions",
            };
            self.leave_out("steps of bodies", why);
        }
    }

    fn collisions(&mut self, scene: &Scene) {
        let planes = scene.body.iter().any(|body| matches!(body.shape, Some(Shape::Plane(_))));
        let pairs = self.collision_pairs;
        let how = format!(
            "{pairs} {}; {}balls, vertices in bodies, edges through facets",
            if pairs == 1 { "pair" } else { "pairs" },
            if planes { "half-spaces, " } else { "" }
        );
        self.choose(pairs > 0, "collisions", &how, "no two bodies with shapes of which one moves");
        let round = |body: &&Body| body.shape.as_ref().is_some_and(|shape| !shape.collides());
        let round = scene.body.iter().filter(round).count();
        if round > 0 {
            let why =
                format!("not modelled: balls, capsules, cylinders and cones, {round} here, pass through everything");
            self.leave_out("round shapes", &why);
        }
        if !joined_pairs(scene).is_empty() {
            self.leave_out("jointed pairs", "bodies that a joint links do not collide with one another");
        }
        self.leave_out("resting contact", "not modelled: bodies that stay in contact end the run");
    }
}

//! What a scene needs, before it is run: what will be modelled, what is left out and why, what it will cost.

mod bodies;
pub(crate) mod pairs;
mod particles;
mod solver;
mod steps;

pub use bodies::{BodySolverPlan, formulations};
pub use pairs::joined_pairs;
pub use solver::SolverPlan;
pub use steps::{DEFAULT_RECORD_HZ, Stepping, adapts, chooses_steps, interval_s, record_hz, steps};

use crate::particle::Particles;
use crate::scene::bodies::Loads;
use crate::scene::description::{Body, Formulation, Scalar, Scene};
use particles::Census;
use serde::Serialize;
use std::fmt;

/// One thing that is modelled.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Modelled {
    /// What.
    pub what: String,
    /// In which form.
    pub how: String,
}

/// One thing that is not.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// What.
    pub what: String,
    /// Why this scene does without.
    pub why: String,
}

/// The plan of a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plan {
    /// Bodies in all.
    pub bodies: usize,
    /// Bodies that move.
    pub moving_bodies: usize,
    /// Pairs of bodies that are tested for collision.
    pub collision_pairs: usize,
    /// Joints.
    pub joints: usize,
    /// Degrees of freedom that the joints take, those that several take counted as often.
    pub joint_rows: usize,
    /// How the motion of the bodies is solved, by formulation.
    pub body_solvers: Vec<BodySolverPlan>,
    /// Particles in all.
    pub particles: usize,
    /// Particles that move.
    pub moving_particles: usize,
    /// Constraints on particles; a line or circle is two.
    pub constraints: usize,
    /// How the motion of the particles is solved; null without particles.
    pub particle_solver: Option<SolverPlan>,
    /// Steps; where the method chooses them, the frames that it goes from and to.
    pub steps: u64,
    /// Who chooses the steps.
    pub stepping: Stepping,
    /// The length of all but the last step, s; where the method chooses them, the largest; null if there is none.
    pub dt_s: Option<f64>,
    /// The fastest spin at the start, rad/s.
    pub fastest_spin_rad_s: f64,
    /// State of one body, bytes.
    pub state_bytes_per_body: usize,
    /// State of one particle, bytes.
    pub state_bytes_per_particle: usize,
    /// Evaluations of the equations of motion of the bodies, without those of the search for impacts; null where the
    /// method chooses its steps.
    pub expected_rhs_evals: Option<u64>,
    /// Evaluations of the forces on the particles; null where the method chooses its steps.
    pub expected_particle_evals: Option<u64>,
    /// What will be modelled.
    pub modelled: Vec<Modelled>,
    /// What is left out.
    pub left_out: Vec<LeftOut>,
}

/// Plans a scene.
#[must_use]
pub fn plan(scene: &Scene) -> Plan {
    let moving: Vec<&Body> = scene.body.iter().filter(|body| !body.fixed).collect();
    let fastest_spin_rad_s = moving.iter().map(|body| spin(body)).fold(0.0, f64::max);
    let dt_s = scene.dt_s.as_ref().map(|dt| *dt.get_ref());
    let steps = steps(scene);
    let census = Census::of(scene);
    let loads = Loads::of_all(scene);
    let particle_solver = (census.particles > 0).then(|| solver::choose(scene, &census));
    let evals_per_step = particle_solver.as_ref().and_then(SolverPlan::evals_per_step);
    let body_solvers = BodySolverPlan::of(scene);
    let per_step = body_solvers.iter().map(BodySolverPlan::evals_per_step).sum::<Option<u64>>();
    let f64_scalar = scene.solver.scalar == Scalar::F64;
    let mut plan = Plan {
        bodies: scene.body.len(),
        moving_bodies: moving.len(),
        collision_pairs: pairs::collision_pairs(scene),
        joints: loads.joints,
        joint_rows: loads.joint_rows,
        particles: census.particles,
        moving_particles: census.moving,
        constraints: census.constraints,
        particle_solver,
        steps,
        stepping: steps::stepping(scene),
        dt_s,
        fastest_spin_rad_s,
        state_bytes_per_body: state_bytes_per_body(&body_solvers, scene.solver.scalar),
        state_bytes_per_particle: if f64_scalar {
            Particles::<f64>::bytes_per_particle()
        } else {
            Particles::<f32>::bytes_per_particle()
        },
        expected_rhs_evals: per_step.map(|evals| steps.saturating_mul(evals)),
        expected_particle_evals: evals_per_step.map(|evals| steps.saturating_mul(evals)),
        body_solvers,
        modelled: vec![],
        left_out: vec![],
    };
    plan.choose(scene.gravity_m_s2.get_ref().0 != [0.0; 3], "gravity", "uniform", "`gravity_m_s2` is zero");
    plan.rigid_bodies(scene, &loads);
    plan.particles(scene, &census);
    plan
}

/// Of all formulations in the scene the largest state of a body, bytes; of the default one where no body moves.
#[must_use]
pub fn state_bytes_per_body(solvers: &[BodySolverPlan], scalar: Scalar) -> usize {
    let largest = solvers.iter().map(|solver| solver.state_bytes_per_body).max();
    largest.unwrap_or_else(|| bodies::state_bytes(Formulation::Rotor, scalar))
}

fn scalar_name(scene: &Scene) -> &'static str {
    match scene.solver.scalar {
        Scalar::F64 => "f64",
        Scalar::F32 => "f32",
    }
}

fn spin(body: &Body) -> f64 {
    let given = body.omega_body_rad_s.as_ref().or(body.omega_world_rad_s.as_ref());
    given.map_or(0.0, |omega| omega.get_ref().0.iter().map(|x| x * x).sum::<f64>().sqrt())
}

impl Plan {
    fn model(&mut self, what: &str, how: String) {
        self.modelled.push(Modelled { what: what.into(), how });
    }

    fn leave_out(&mut self, what: &str, why: &str) {
        self.left_out.push(LeftOut { what: what.into(), why: why.into() });
    }

    fn choose(&mut self, needed: bool, what: &str, how: &str, why_not: &str) {
        if needed { self.model(what, how.into()) } else { self.leave_out(what, why_not) }
    }
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "modelled")?;
        for Modelled { what, how } in &self.modelled {
            writeln!(f, "  {what:<18} {how}")?;
        }
        writeln!(f, "left out")?;
        for LeftOut { what, why } in &self.left_out {
            writeln!(f, "  {what:<18} {why}")?;
        }
        writeln!(f, "cost")?;
        self.cost(f)
    }
}

impl Plan {
    fn cost(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let line = |f: &mut fmt::Formatter<'_>, what: &str, how: &str| write!(f, "\n  {what:<18} {how}");
        let with = |count: usize, moving: usize, bytes: usize| {
            format!("{count} ({moving} moving), {bytes} bytes of state each")
        };
        let between = format!("between {} frames", self.steps + 1);
        let steps = match (self.stepping, self.dt_s) {
            (Stepping::None, _) => format!("none: evaluated {between}"),
            (Stepping::Chosen, Some(dt_s)) => format!("chosen by the method, at most {dt_s} s, {between}"),
            (Stepping::Chosen, None) => format!("chosen by the method, {between}"),
            (Stepping::Fixed, dt_s) => {
                let dt_s = dt_s.unwrap_or_default();
                let stepped = self.body_solvers.iter().any(|solver| !solver.adaptive && !solver.is_exact())
                    || self.particle_solver.as_ref().is_some_and(|solver| !solver.adaptive);
                let what = if stepped { "of" } else { "states asked for, every" };
                format!("{} {what} {dt_s} s", self.steps)
            }
        };
        write!(f, "  {:<18} {steps}", "steps")?;
        if self.bodies > 0 {
            line(f, "bodies", &format!("{} ({} moving)", self.bodies, self.moving_bodies))?;
            for solver in &self.body_solvers {
                let (name, bytes) = (solver.formulation.name(), solver.state_bytes_per_body);
                line(f, &format!("bytes by {name}"), &format!("{bytes}, {} moving", solver.bodies))?;
            }
            match self.expected_rhs_evals {
                Some(0) => line(f, "rhs evaluations", "none")?,
                Some(evals) => line(f, "rhs evaluations", &format!("{evals} of all bodies, impacts apart"))?,
                None => line(f, "rhs evaluations", "as many as the tolerance asks for")?,
            }
        }
        if self.particles > 0 {
            line(f, "particles", &with(self.particles, self.moving_particles, self.state_bytes_per_particle))?;
        }
        match self.expected_particle_evals {
            Some(evals) => line(f, "force evaluations", &format!("{evals} of all particles"))?,
            None if self.particles > 0 => line(f, "force evaluations", "as many as the tolerance asks for")?,
            None => {}
        }
        Ok(())
    }
}

//! What a scene needs, before it is run: what will be modelled, what is left out and why, what it will cost.

mod particles;
mod solver;
mod steps;

pub use solver::SolverPlan;
pub use steps::{DEFAULT_RECORD_HZ, adapts, chooses_steps, interval_s, record_hz, steps};

use crate::particle::Particles;
use crate::rigid::Bodies;
use crate::scene::description::{Body, Force, Scalar, Scene, Shape};
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
    /// The length of all but the last step, s; where the method chooses them, the largest; null if there is none.
    pub dt_s: Option<f64>,
    /// The fastest spin at the start, rad/s.
    pub fastest_spin_rad_s: f64,
    /// State of one body, bytes.
    pub state_bytes_per_body: usize,
    /// State of one particle, bytes.
    pub state_bytes_per_particle: usize,
    /// Evaluations of the equations of motion of the bodies, without those of the search for impacts.
    pub expected_rhs_evals: u64,
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
    let particle_solver = (census.particles > 0).then(|| solver::choose(scene, &census));
    let evals_per_step = particle_solver.as_ref().and_then(SolverPlan::evals_per_step);
    let per_step = if scene.body.is_empty() { 0 } else { 7 };
    let f64_scalar = scene.solver.scalar == Scalar::F64;
    let mut plan = Plan {
        bodies: scene.body.len(),
        moving_bodies: moving.len(),
        collision_pairs: collision_pairs(scene),
        particles: census.particles,
        moving_particles: census.moving,
        constraints: census.constraints,
        particle_solver,
        steps,
        dt_s,
        fastest_spin_rad_s,
        state_bytes_per_body: if f64_scalar {
            Bodies::<f64>::bytes_per_body()
        } else {
            Bodies::<f32>::bytes_per_body()
        },
        state_bytes_per_particle: if f64_scalar {
            Particles::<f64>::bytes_per_particle()
        } else {
            Particles::<f32>::bytes_per_particle()
        },
        expected_rhs_evals: steps.saturating_mul(per_step),
        expected_particle_evals: evals_per_step.map(|evals| steps.saturating_mul(evals)),
        modelled: vec![],
        left_out: vec![],
    };
    plan.choose(scene.gravity_m_s2.get_ref().0 != [0.0; 3], "gravity", "uniform", "`gravity_m_s2` is zero");
    plan.rigid_bodies(scene);
    plan.particles(scene, &census);
    plan
}

/// Pairs of bodies with shapes of which one moves.
fn collision_pairs(scene: &Scene) -> usize {
    let shaped = |fixed: bool| scene.body.iter().filter(|body| body.shape.is_some() && body.fixed == fixed).count();
    let (fixed, moving) = (shaped(true), shaped(false));
    moving * fixed + moving * moving.saturating_sub(1) / 2
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
    fn rigid_bodies(&mut self, scene: &Scene) {
        if scene.body.is_empty() {
            return self.leave_out("bodies", "the scene has no [[body]]");
        }
        let scalar = scalar_name(scene);
        let how = format!("G(3,0) rotor form, RK4 with renormalisation, {scalar} with f64 world positions");
        self.model("rigid motion", how);
        let at_point = scene.force.iter().filter(|force| matches!(force, Force::AtPoint(_))).count();
        let how = format!("{at_point}, steps cut where they start and end");
        self.choose(at_point > 0, "forces at points", &how, "no [[force]] names one");
        let drag =
            scene.force.iter().filter(|force| matches!(force, Force::LinearDrag(drag) if drag.body.is_some())).count();
        self.choose(drag > 0, "drag on bodies", &format!("linear, {drag}"), "no [[force]] names one");
        let planes = scene.body.iter().any(|body| matches!(body.shape, Some(Shape::Plane(_))));
        let pairs = self.collision_pairs;
        let how = format!(
            "{pairs} {}; {}balls, vertices in bodies, edges through facets",
            if pairs == 1 { "pair" } else { "pairs" },
            if planes { "half-spaces, " } else { "" }
        );
        self.choose(pairs > 0, "collisions", &how, "no two bodies with shapes of which one moves");
        self.leave_out("resting contact", "not modelled: bodies that stay in contact end the run");
    }

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
        let steps = match (self.dt_s, self.chooses_steps()) {
            (Some(dt_s), false) => format!("{} of {dt_s} s", self.steps),
            (Some(dt_s), true) => format!("chosen by the method, at most {dt_s} s, between {} frames", self.steps + 1),
            (None, _) => format!("chosen by the method, between {} frames", self.steps + 1),
        };
        write!(f, "  {:<18} {steps}", "steps")?;
        if self.bodies > 0 {
            line(f, "bodies", &with(self.bodies, self.moving_bodies, self.state_bytes_per_body))?;
            line(f, "rhs evaluations", &format!("{} of all bodies, impacts apart", self.expected_rhs_evals))?;
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

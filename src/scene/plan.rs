//! What a scene needs, before it is run: what will be modelled, what is left out and why, what it will cost.

use crate::algebra::Real;
use crate::rigid::Bodies;
use crate::rigid::rotor::MAX_TURN_RAD;
use crate::scene::description::{Body, Force, Scalar, Scene, Shape};
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
    /// Pairs that are tested for collision.
    pub collision_pairs: usize,
    /// Steps.
    pub steps: u64,
    /// The length of all but the last step, s.
    pub dt_s: f64,
    /// The fastest spin at the start, rad/s: sets the substeps.
    pub fastest_spin_rad_s: f64,
    /// Substeps a step, at the spin of the start.
    pub substeps_per_step: u64,
    /// State of one body, bytes.
    pub state_bytes_per_body: usize,
    /// Evaluations of the equations of motion, without those of the search for impacts.
    pub expected_rhs_evals: u64,
    /// What will be modelled.
    pub modelled: Vec<Modelled>,
    /// What is left out.
    pub left_out: Vec<LeftOut>,
}

/// The number of steps: the last one is shorter where dt does not divide the duration. A remainder within rounding of
/// a whole step (a few ulp of the quotient) is none.
#[must_use]
pub fn steps(scene: &Scene) -> u64 {
    let quotient = scene.duration_s.get_ref() / scene.dt_s.get_ref();
    let whole = quotient.round();
    let exact = (quotient - whole).abs() <= 4.0 * f64::EPSILON * quotient;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked to be at most MAX_STEPS")]
    let count = if exact { whole } else { quotient.ceil() } as u64;
    count.max(1)
}

/// Plans a scene.
#[must_use]
pub fn plan(scene: &Scene) -> Plan {
    let moving: Vec<&Body> = scene.body.iter().filter(|body| !body.fixed).collect();
    let shaped = |body: &&Body| body.shape.is_some();
    let (shaped_all, shaped_moving) =
        (scene.body.iter().filter(shaped).count(), moving.iter().copied().filter(shaped).count());
    let fixed = shaped_all - shaped_moving;
    // Pairs of which one moves.
    let collision_pairs = shaped_moving * fixed + shaped_moving * shaped_moving.saturating_sub(1) / 2;
    let fastest_spin_rad_s = moving.iter().map(|body| spin(body)).fold(0.0, f64::max);
    let dt_s = *scene.dt_s.get_ref();
    let wanted = (fastest_spin_rad_s * dt_s / MAX_TURN_RAD).ceil().max(1.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and is a forecast only")]
    let substeps_per_step = wanted as u64;
    let steps = steps(scene);
    let mut plan = Plan {
        bodies: scene.body.len(),
        moving_bodies: moving.len(),
        collision_pairs,
        steps,
        dt_s,
        fastest_spin_rad_s,
        substeps_per_step,
        state_bytes_per_body: match scene.solver.scalar {
            Scalar::F64 => Bodies::<f64>::bytes_per_body(),
            Scalar::F32 => Bodies::<f32>::bytes_per_body(),
        },
        expected_rhs_evals: steps.saturating_mul(substeps_per_step).saturating_mul(4),
        modelled: vec![],
        left_out: vec![],
    };
    let scalar = match scene.solver.scalar {
        Scalar::F64 => scalar_name::<f64>(),
        Scalar::F32 => scalar_name::<f32>(),
    };
    plan.model(
        "rigid motion",
        format!("G(3,0) rotor form, RK4 with renormalisation, {scalar} with f64 world positions"),
    );
    plan.choose(scene.gravity_m_s2.get_ref().0 != [0.0; 3], "gravity", "uniform", "`gravity_m_s2` is zero");
    let at_point = scene.force.iter().filter(|force| matches!(force, Force::AtPoint(_))).count();
    plan.choose(
        at_point > 0,
        "forces at points",
        &format!("{at_point}, steps cut where they start and end"),
        "no [[force]] names one",
    );
    let drag = scene.force.len() - at_point;
    plan.choose(drag > 0, "drag", &format!("linear, {drag}"), "no [[force]] names one");
    let planes = scene.body.iter().any(|body| matches!(body.shape, Some(Shape::Plane(_))));
    let how = format!(
        "{collision_pairs} {}; {}balls, vertices in bodies, edges through facets",
        if collision_pairs == 1 { "pair" } else { "pairs" },
        if planes { "half-spaces, " } else { "" }
    );
    plan.choose(collision_pairs > 0, "collisions", &how, "no two bodies with shapes of which one moves");
    plan.leave_out("resting contact", "not modelled: bodies that stay in contact end the run");
    plan
}

fn scalar_name<T: Real>() -> &'static str {
    if size_of::<T>() == size_of::<f64>() { "f64" } else { "f32" }
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
        writeln!(
            f,
            "  {:<18} {} ({} moving), {} bytes of state each",
            "bodies", self.bodies, self.moving_bodies, self.state_bytes_per_body
        )?;
        let substeps = if self.substeps_per_step == 1 { "substep" } else { "substeps" };
        writeln!(
            f,
            "  {:<18} {} of {} s, {} {substeps} each at {:.3} rad/s",
            "steps", self.steps, self.dt_s, self.substeps_per_step, self.fastest_spin_rad_s
        )?;
        write!(f, "  {:<18} {} of all bodies, impacts apart", "rhs evaluations", self.expected_rhs_evals)
    }
}

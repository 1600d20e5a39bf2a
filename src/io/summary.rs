//! `summary.json`: the figures of a run.

use serde::Serialize;
use std::io::{self, Write};

/// The figures of a run. A drift is null where the scene does not conserve the quantity, or nothing moves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// The scene's name.
    pub scene: String,
    /// Bodies.
    pub bodies: usize,
    /// Particles.
    pub particles: usize,
    /// Steps made.
    pub steps: u64,
    /// Events.
    pub events: usize,
    /// Simulated time, s.
    pub sim_s: f64,
    /// Time that the simulation took, s, without reading and writing.
    pub wall_s: f64,
    /// Simulated over wall time.
    pub real_time_factor: f64,
    /// max|E - E0| / max(kinetic energy).
    pub energy_drift_rel: Option<f64>,
    /// max|P - P0| / max(sum |p_i|).
    pub momentum_drift_rel: Option<f64>,
    /// max|L - L0| / max(sum |L_i|), about the origin.
    pub angular_momentum_drift_rel: Option<f64>,
    /// The deepest overlap at an event, m.
    pub max_penetration_m: f64,
    /// The largest violation of a constraint or joint, m; null without either.
    pub max_violation_m: Option<f64>,
    /// How far an orientation was from a rotation at most: the largest entry of |R^T R - 1| of a matrix R, ||R|² - 1| of a
    /// rotor; null without bodies.
    pub max_distortion: Option<f64>,
    /// What the solution of the bodies' motion took; null without bodies.
    pub body_work: Option<BodyWork>,
    /// What the solution of the particles' motion took; null without particles.
    pub particle_work: Option<ParticleWork>,
    /// State of one body, bytes; of several formulations the largest.
    pub state_bytes_per_body: usize,
    /// State of one particle, bytes.
    pub state_bytes_per_particle: usize,
    /// FNV-1a of the final state, hexadecimal.
    pub state_hash: String,
    /// Why the run ended early; absent if it did not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub failure: Option<String>,
    /// What was set.
    pub settings: Settings,
}

/// What the solution of the bodies' motion took.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodyWork {
    /// Joints.
    pub joints: usize,
    /// Degrees of freedom that the joints take, those that several take counted as often.
    pub joint_rows: usize,
    /// Those of them that the others imply.
    pub redundant_rows: usize,
    /// The violation of joints that was asked for, m; null without joints.
    pub asked_violation_m: Option<f64>,
    /// Drifts in which joints turned too far for impulses along their directions at the start of a step: there they lose
    /// energy.
    pub redirected_drifts: u64,
    /// Evaluations of the equations of motion.
    pub rhs_evals: u64,
    /// Steps, those of the search for impacts included; of free flight, evaluations.
    pub accepted_steps: u64,
    /// Steps that were too inaccurate, and made again.
    pub rejected_steps: u64,
}

/// How the motion of the bodies of one formulation is solved.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodySettings {
    /// The formulation.
    pub formulation: String,
    /// How many bodies move in it.
    pub bodies: usize,
    /// The integrator.
    pub method: String,
    /// The longest step, s; null if there are none, or the method chooses them.
    pub step_s: Option<f64>,
    /// Relative tolerance; null if the method does not control its error.
    pub rtol: Option<f64>,
    /// Absolute tolerance, m and m/s; null if the method does not control its error.
    pub atol: Option<f64>,
    /// State of one body, bytes.
    pub state_bytes_per_body: usize,
}

/// What the solution of the particles' motion took.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParticleWork {
    /// Constraints; a line or circle is two.
    pub constraints: usize,
    /// Those of them that the others imply, as far as a factorisation found out.
    pub redundant_constraints: usize,
    /// The violation that was asked for, m.
    pub asked_violation_m: f64,
    /// Substeps a step of XPBD; null for other methods.
    pub substeps: Option<usize>,
    /// Evaluations of the forces.
    pub rhs_evals: u64,
    /// Steps.
    pub accepted_steps: u64,
    /// Steps that were too inaccurate, and made again.
    pub rejected_steps: u64,
}

/// How the motion of particles is solved.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParticleSettings {
    /// The integrator.
    pub method: String,
    /// Relative tolerance; null if the method does not control its error.
    pub rtol: Option<f64>,
    /// Absolute tolerance, m and m/s; null if the method does not control its error.
    pub atol: Option<f64>,
    /// How the constraint forces are solved for.
    pub constraints: String,
    /// What keeps particles on their constraints.
    pub stabilisation: String,
    /// The violation that is left, relative to the shortest length that is held.
    pub violation: f64,
    /// Substeps a step; null if the method has none, or chose them.
    pub substeps: Option<u32>,
}

/// What was set, and what followed from it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Settings {
    /// Duration asked for, s.
    pub duration_s: f64,
    /// Step, s; the largest where the method chooses them; null: none given.
    pub dt_s: Option<f64>,
    /// Frames a second of simulated time; null: every step.
    pub record_hz: Option<f64>,
    /// The formulation of rigid motion where a body says nothing else.
    pub formulation: String,
    /// The scalar.
    pub scalar: String,
    /// The solvers of bodies, one for each formulation in which bodies move.
    pub body_solvers: Vec<BodySettings>,
    /// The solver of particles; null without particles.
    pub particle_solver: Option<ParticleSettings>,
    /// Gravity, m/s².
    pub gravity_m_s2: [f64; 3],
    /// Restitution.
    pub restitution: f64,
    /// `--set` texts.
    pub overrides: Vec<String>,
}

/// Writes the summary, indented.
///
/// # Errors
/// The output fails.
pub fn write(out: &mut dyn Write, summary: &Summary) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, summary)?;
    writeln!(out)
}

//! The short table that a run prints at its end.

use crate::io::summary::{BodySettings, BodyWork, Summary};
use crate::rigid;
use std::path::Path;

/// The figures of a run, one a line, and what to open.
pub(super) fn table(summary: &Summary, out: &Path) -> String {
    let drift = |value: Option<f64>| value.map_or_else(|| "-".into(), |value| format!("{value:.1e}"));
    let metres = |value: f64| format!("{value:.1e} m");
    let with_bodies = summary.bodies > 0 || summary.particles == 0;
    let rows = [
        Some((
            "simulated",
            format!("{} s in {:.3} s, {:.0} times real time", summary.sim_s, summary.wall_s, summary.real_time_factor),
        )),
        with_bodies.then(|| ("bodies", summary.bodies.to_string())),
        (summary.particles > 0).then(|| ("particles", summary.particles.to_string())),
        Some(("steps", steps(summary))),
        with_bodies.then(|| ("events", summary.events.to_string())),
        Some(("energy drift", drift(summary.energy_drift_rel))),
        Some(("momentum drift", drift(summary.momentum_drift_rel))),
        Some(("ang. mom. drift", drift(summary.angular_momentum_drift_rel))),
        with_bodies.then(|| ("max penetration", metres(summary.max_penetration_m))),
        summary.body_work.as_ref().and_then(joints).map(|joints| ("joints", joints)),
        summary.max_violation_m.map(|violation| ("max violation", held(violation, summary))),
        distorted(summary).map(|distortion| ("max distortion", format!("{distortion:.1e}"))),
        Some(("state hash", summary.state_hash.clone())),
    ];
    let mut text: String = rows.iter().flatten().map(|(name, value)| format!("{name:<16} {value}\n")).collect();
    text += &format!("open             {}\n", out.join("run.html").display());
    text
}

/// The joints, where there are any, and what is to be known of them.
fn joints(work: &BodyWork) -> Option<String> {
    let redundant = match work.redundant_rows {
        0 => String::new(),
        rows => format!(", {rows} of them redundant"),
    };
    let redirected = match work.redirected_drifts {
        0 => String::new(),
        drifts => format!(", {drifts} drifts in which they turned too far and lost energy: take a smaller `dt_s`"),
    };
    (work.joints > 0).then(|| format!("{} with {} rows{redundant}{redirected}", work.joints, work.joint_rows))
}

/// The worst distortion, where an orientation can be distorted.
fn distorted(summary: &Summary) -> Option<f64> {
    let by_matrix = |solver: &BodySettings| solver.formulation == rigid::Form::Matrix.name();
    summary.max_distortion.filter(|_| summary.settings.body_solvers.iter().any(by_matrix))
}

/// The worst violation, and what was asked for where it is more.
fn held(violation_m: f64, summary: &Summary) -> String {
    // The violation is judged by another formula than the solver's, which rounds otherwise.
    let of_particles = summary.particle_work.as_ref().map(|work| work.asked_violation_m);
    let of_joints = summary.body_work.as_ref().and_then(|work| work.asked_violation_m);
    let asked_m = [of_particles, of_joints].into_iter().flatten().reduce(f64::max).unwrap_or(f64::INFINITY);
    let more =
        if violation_m > 1.1 * asked_m { format!(", more than the {asked_m:.1e} m asked for") } else { String::new() };
    format!("{violation_m:.1e} m{more}")
}

/// How many steps were made: of bodies, and of particles.
fn steps(summary: &Summary) -> String {
    let made = |accepted: u64, by: &str, rejected: u64, evals: u64| {
        format!("{accepted} by {by} ({rejected} rejected, {evals} evaluations)")
    };
    let bodies = summary.body_work.as_ref().map(|work| {
        let solvers = &summary.settings.body_solvers;
        // Each once, in the order of the formulations.
        let mut methods: Vec<&str> = Vec::new();
        for solver in solvers {
            if !methods.contains(&solver.method.as_str()) {
                methods.push(&solver.method);
            }
        }
        match methods[..] {
            [] => "none".to_owned(),
            ["free_flight"] => format!("none: free flight, evaluated {} times", work.accepted_steps),
            _ => made(work.accepted_steps, &methods.join(" and "), work.rejected_steps, work.rhs_evals),
        }
    });
    let particles = summary.particle_work.as_ref().zip(summary.settings.particle_solver.as_ref());
    let particles =
        particles.map(|(work, solver)| made(work.accepted_steps, &solver.method, work.rejected_steps, work.rhs_evals));
    match (bodies, particles) {
        (Some(bodies), Some(particles)) => format!("{bodies}, particles {particles}"),
        (bodies, particles) => bodies.or(particles).unwrap_or_else(|| summary.steps.to_string()),
    }
}

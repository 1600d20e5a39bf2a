//! Why a run ended early, with the names of its scene and a remedy.

use super::playback::Cast;
use crate::algebra::Real;
use crate::constraint::{ProjectionError, SolveError};
use crate::ode::OdeError;
use crate::particle::{Constraint, MotionError};
use crate::rigid;
use crate::simulation::{SimulationError, World};

/// Why a run ended, in the words of its scene.
pub(super) fn explain<T: Real>(error: &SimulationError, world: &World<T>, cast: &Cast) -> String {
    let names = &cast.bodies;
    match error {
        SimulationError::Particles(error) => {
            let constraints = world.particles().map_or(&[][..], |motion| &motion.system().setup().constraints);
            particles(error, constraints, &cast.particles)
        }
        SimulationError::StaysInContact { a, b, time_s } => format!(
            "bodies `{}` and `{}` stay in contact from {time_s:.6} s on: their bounces follow one another without end, and \
             resting contact is not modelled; end the run before (`duration_s`), or raise `contact.restitution` if it is below 1",
            names[*a], names[*b]
        ),
        SimulationError::OutOfRange { body_idx, time_s } => format!(
            "the motion of body `{}` left the range of the numbers at {time_s:.6} s: a force or drag is too stiff for the \
             step, or a velocity too large; take a smaller `dt_s`",
            names[*body_idx]
        ),
        SimulationError::Bodies(error) => bodies(error, &world.motion().setup().joints, names),
    }
}

fn bodies<T: Real>(error: &OdeError<rigid::MotionError>, joints: &[rigid::Joint<T>], names: &[String]) -> String {
    let row = |row: &usize| joints.get(*row).map_or_else(|| "a joint".into(), |joint| joined(joint, names));
    match error {
        OdeError::System(rigid::MotionError::Projection { time_s, source }) => match source {
            ProjectionError::NotConverged { row: worst, violation_m, .. } => format!(
                "at {time_s:.6} s {} cannot be held, {violation_m:.1e} m are left: it contradicts other joints, or the step \
                 is too long; take a smaller `dt_s`, or allow a larger `solver.violation`",
                row(worst)
            ),
            ProjectionError::NoGradient { row: which } => {
                format!("at {time_s:.6} s {} has no direction to act in: its ends are at one place", row(which))
            }
            ProjectionError::Solve(source) => solving(*time_s, source, row),
        },
        OdeError::System(rigid::MotionError::Multipliers { time_s, source }) => solving(*time_s, source, row),
        OdeError::StepTooSmall { time_s, step_s } => format!(
            "at {time_s:.6} s the tolerance asks for a step of {step_s:.1e} s: a spring or drag is very stiff, or a body very \
             slender; allow a larger `solver.rtol`, or give a `dt_s` and a method of fixed steps"
        ),
        OdeError::NotFinite { time_s, .. } => format!(
            "the bodies left the range of the numbers at {time_s:.6} s: a spring or drag is too stiff for the step; take a \
             smaller `dt_s`, or let the steps be chosen (`solver.rtol`)"
        ),
        OdeError::System(rigid::MotionError::Spin { body_idx, time_s, turn_rad, dt_s }) => format!(
            "body `{}` turns by {turn_rad:.1e} rad in a step of {dt_s} s at {time_s:.6} s, too far for the method; \
             take a smaller `dt_s`, or in the rotor form `solver.method = \"yoshida4\"`, which moves free bodies exactly",
            names[*body_idx]
        ),
        OdeError::System(rigid::MotionError::Orientation { time_s, source }) => {
            format!(
                "the orientation of body `{}` is lost at {time_s:.6} s; take a smaller `dt_s`",
                names[source.body_idx]
            )
        }
        _ => error.to_string(),
    }
}

/// A joint, by the bodies that it joins.
fn joined<T: Real>(joint: &rigid::Joint<T>, names: &[String]) -> String {
    let name = |body_idx: usize| names.get(body_idx).map_or_else(|| body_idx.to_string(), |name| format!("`{name}`"));
    let bodies: Vec<String> = joint.bodies().into_iter().flatten().map(name).collect();
    let what = match joint {
        rigid::Joint::Ball { .. } => "the ball joint of",
        rigid::Joint::Hinge { .. } => "the hinge of",
        rigid::Joint::Distance { .. } => "the distance of",
    };
    format!("{what} {}", bodies.join(" and "))
}

fn particles(error: &OdeError<MotionError>, constraints: &[Constraint], names: &[String]) -> String {
    let row = |row: &usize| constraints.get(*row).map_or_else(|| "a constraint".into(), |held| named(held, names));
    match error {
        OdeError::System(MotionError::Projection { time_s, source }) => match source {
            ProjectionError::NotConverged { row: worst, violation_m, .. } => format!(
                "at {time_s:.6} s {} cannot be held, {violation_m:.1e} m are left: it contradicts other constraints, or the \
                 step is too long; take a smaller `dt_s`, or `solver.method = \"xpbd\"` with `solver.constraints = \"direct\"`, \
                 which bears more",
                row(worst)
            ),
            ProjectionError::NoGradient { row: which } => {
                format!("at {time_s:.6} s {} has no direction to act in: its particles are at one place", row(which))
            }
            ProjectionError::Solve(source) => solving(*time_s, source, row),
        },
        OdeError::System(MotionError::Multipliers { time_s, source }) => solving(*time_s, source, row),
        OdeError::StepTooSmall { time_s, step_s } => format!(
            "at {time_s:.6} s the tolerance asks for a step of {step_s:.1e} s: particles meet, or a force runs away there; \
             soften the attraction (`softening_m`), or allow a larger `solver.rtol`"
        ),
        OdeError::NotFinite { time_s, .. } => format!(
            "the particles left the range of the numbers at {time_s:.6} s: a force or drag is too stiff for the step; take a \
             smaller `dt_s`, or let the steps be chosen (`solver.rtol`)"
        ),
        _ => error.to_string(),
    }
}

fn solving(time_s: f64, error: &SolveError, row: impl Fn(&usize) -> String) -> String {
    match error {
        SolveError::NotFinite { row: which } => {
            format!("at {time_s:.6} s {} left the range of the numbers; take a smaller `dt_s`", row(which))
        }
        SolveError::Contradiction { row: which, .. } => {
            format!("at {time_s:.6} s {} contradicts others; remove one of them", row(which))
        }
    }
}

/// A constraint, by the particles that it holds.
fn named(constraint: &Constraint, names: &[String]) -> String {
    let mut held = Vec::new();
    constraint.for_each_particle(|particle| {
        held.push(names.get(particle).map_or_else(|| particle.to_string(), |name| format!("`{name}`")));
    });
    let what = match constraint {
        Constraint::Distance { .. } => "the distance of",
        Constraint::ToPoint { .. } => "the distance to a point of",
        Constraint::On { .. } => "the surface under",
        Constraint::Own(_) => "the constraint of",
    };
    format!("{what} {}", held.join(" and "))
}

//! When states are asked for: after each step, or, where the method chooses its steps or needs none, at each frame.

use super::BodySolverPlan;
use super::pairs::collision_pairs;
use crate::scene::description::Scene;
use crate::scene::particles::count;
use serde::Serialize;

/// Frames a second where the steps are chosen by the method and the scene does not say: a screen shows no more.
pub const DEFAULT_RECORD_HZ: f64 = 60.0;

/// Whether steps are chosen by their error, by a method that can: there is a tolerance to choose them by, or no `dt_s` to
/// take in their place. A method with an error estimate and a `dt_s` but no `rtol` makes fixed steps, as for a recording.
pub(super) fn wants_error_control(scene: &Scene) -> bool {
    scene.solver.rtol.is_some() || scene.dt_s.is_none()
}

/// Whether the steps of particles are chosen by their error.
#[must_use]
pub fn adapts(scene: &Scene) -> bool {
    let method = scene.solver.method.as_ref().map(|method| *method.get_ref());
    // A method that moves bodies only leaves the choice for the particles to the plan.
    let can = method.filter(|method| method.of_particles().is_some()).is_none_or(|method| method.is_adaptive());
    can && wants_error_control(scene)
}

/// Who chooses the steps of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stepping {
    /// The scene, by `dt_s`.
    Fixed,
    /// The methods, by their errors.
    Chosen,
    /// Nobody: there are only bodies in free flight, which is known in closed form.
    None,
}

/// Who chooses the steps. Bodies that can collide are looked at every `dt_s`, whatever moves them.
pub(super) fn stepping(scene: &Scene) -> Stepping {
    let particles = count(scene) > 0.0;
    let bodies = BodySolverPlan::of(scene);
    let free = |solver: &BodySolverPlan| solver.is_exact() || solver.adaptive && scene.dt_s.is_none();
    let nothing_moves = !particles && bodies.is_empty();
    if nothing_moves || particles && !adapts(scene) || !bodies.iter().all(free) || collision_pairs(scene) > 0 {
        return Stepping::Fixed;
    }
    if particles || bodies.iter().any(|solver| solver.adaptive) { Stepping::Chosen } else { Stepping::None }
}

/// Whether nothing is stepped by `dt_s`.
#[must_use]
pub fn chooses_steps(scene: &Scene) -> bool {
    stepping(scene) != Stepping::Fixed
}

/// Frames a second; none if every step is one. Where nothing is stepped a `dt_s` says when states are known.
#[must_use]
pub fn record_hz(scene: &Scene) -> Option<f64> {
    let given = scene.record_hz.as_ref().map(|hz| *hz.get_ref());
    let by_default = match stepping(scene) {
        Stepping::Fixed => false,
        Stepping::Chosen => true,
        Stepping::None => scene.dt_s.is_none(),
    };
    given.or(by_default.then_some(DEFAULT_RECORD_HZ))
}

/// From a state that is asked for to the next, s: `dt_s`, or the time between frames.
#[must_use]
pub fn interval_s(scene: &Scene) -> f64 {
    let frame_s = record_hz(scene).map(|hz| 1.0 / hz);
    match (&scene.dt_s, frame_s) {
        (_, Some(frame_s)) if chooses_steps(scene) => frame_s,
        (Some(dt), _) => *dt.get_ref(),
        (None, _) => frame_s.unwrap_or(1.0 / DEFAULT_RECORD_HZ),
    }
}

/// How many times a state is asked for: the last interval is shorter where [`interval_s`] does not divide the duration.
/// A remainder within rounding of a whole one (a few ulp of the quotient) is none.
#[must_use]
pub fn steps(scene: &Scene) -> u64 {
    let quotient = scene.duration_s.get_ref() / interval_s(scene);
    let whole = quotient.round();
    let exact = (quotient - whole).abs() <= 4.0 * f64::EPSILON * quotient;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked to be at most MAX_STEPS")]
    let count = if exact { whole } else { quotient.ceil() } as u64;
    count.max(1)
}

//! When states are asked for: after each step, or, where the method chooses its steps, at each frame.

use crate::scene::description::Scene;

/// Frames a second where the steps are chosen by the method and the scene does not say: a screen shows no more.
pub const DEFAULT_RECORD_HZ: f64 = 60.0;

/// Whether the steps of particles are chosen by their error: there is a tolerance to choose them by, or no `dt_s` to take
/// in their place. A method with an error estimate and a `dt_s` but no `rtol` makes fixed steps, as for a recording.
#[must_use]
pub fn adapts(scene: &Scene) -> bool {
    let can = scene.solver.method.as_ref().is_none_or(|method| method.get_ref().is_adaptive());
    can && (scene.solver.rtol.is_some() || scene.dt_s.is_none())
}

/// Whether `dt_s` says nothing about when states are known: there are only particles, and their steps are chosen.
#[must_use]
pub fn chooses_steps(scene: &Scene) -> bool {
    scene.body.is_empty() && adapts(scene)
}

/// Frames a second; none if every step is one.
#[must_use]
pub fn record_hz(scene: &Scene) -> Option<f64> {
    let given = scene.record_hz.as_ref().map(|hz| *hz.get_ref());
    given.or(chooses_steps(scene).then_some(DEFAULT_RECORD_HZ))
}

/// From a state that is asked for to the next, s: `dt_s`, or the time between frames.
#[must_use]
pub fn interval_s(scene: &Scene) -> f64 {
    match &scene.dt_s {
        Some(dt) if !chooses_steps(scene) => *dt.get_ref(),
        _ => 1.0 / record_hz(scene).unwrap_or(DEFAULT_RECORD_HZ),
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

//! Mistakes in how the motion is solved: steps and tolerances.

use toml::Spanned;

use super::{Checker, MAX_STEPS};
use crate::ode::SMALLEST_RTOL_EPS;
use crate::scene::description::{ConstraintSolver, Method, Scalar, Scene};
use crate::scene::diagnostic::Diagnostic;
use crate::scene::particles;
use crate::scene::plan;
use crate::scene::read::Damage;

/// The most states that a run may record: a body's takes about 400 bytes in the record, the tables and the page
/// together, so this is 2 GB. A particle's takes half of that, and counts as one half.
const MAX_RECORDED: f64 = 5e6;

/// The least relative tolerance of a scalar.
fn least_rtol(scalar: Scalar) -> f64 {
    match scalar {
        Scalar::F64 => SMALLEST_RTOL_EPS * f64::EPSILON,
        Scalar::F32 => SMALLEST_RTOL_EPS * f64::from(f32::EPSILON),
    }
}

impl Checker {
    pub(super) fn solver(&mut self, scene: &Scene) {
        let solver = &scene.solver;
        if let Some(rtol) = &solver.rtol
            && let Some(value) = self.positive("rtol", rtol, "1e-8 is a fair start")
        {
            let (least, scalar) = match solver.scalar {
                Scalar::F64 => (least_rtol(Scalar::F64), "f64"),
                Scalar::F32 => (least_rtol(Scalar::F32), "f32"),
            };
            if value < least {
                // Rounded up, so that what the message names is enough.
                let digit = 10_f64.powf(least.log10().floor() - 1.0);
                let least = (least / digit).ceil() * digit;
                let message = format!("`rtol` = {value:?} is below what {scalar} can give, {least:.1e}");
                let diagnostic = Diagnostic::new(message).at(rtol.span()).label("below the rounding of a step");
                let finer = if scalar == "f32" { ", or set `scalar = \"f64\"`" } else { "" };
                self.report(diagnostic.help(format!("make it at least {least:.1e}{finer}")));
            } else if value >= 1.0 {
                let message = format!("`rtol` must be less than 1, not {value:?}");
                let diagnostic = Diagnostic::new(message).at(rtol.span());
                self.report(diagnostic.help("it is relative: 1e-8 is a fair start"));
            }
        }
        if let Some(atol) = &solver.atol {
            self.positive("atol", atol, "in m and m/s; where a coordinate is zero nothing else limits the error");
        }
        if let Some(violation) = &solver.violation
            && let Some(value) =
                self.positive("violation", violation, "it is relative to a length: 1e-6 is a fair start")
            && value >= 1.0
        {
            let diagnostic = Diagnostic::new(format!("`violation` must be less than 1, not {value:?}"));
            self.report(diagnostic.at(violation.span()).help("it is relative to a length: 1e-6 is a fair start"));
        }
        let swept = solver.constraints.as_ref().filter(|by| *by.get_ref() == ConstraintSolver::Sweeps);
        let xpbd = solver.method.as_ref().is_some_and(|method| *method.get_ref() == Method::Xpbd);
        if let Some(swept) = swept.filter(|_| !xpbd) {
            let diagnostic = Diagnostic::new("`sweeps` hold constraints one by one, which only `xpbd` can do");
            self.report(diagnostic.at(swept.span()).help("set `method = \"xpbd\"`, or choose `direct`"));
        }
        if let Some(substeps) = solver.substeps.as_ref().filter(|substeps| *substeps.get_ref() == 0) {
            let diagnostic = Diagnostic::new("`substeps` must be at least 1, not 0").at(substeps.span());
            self.report(diagnostic.help("20 is a fair start"));
        }
    }

    pub(super) fn times(&mut self, scene: &Scene, damage: &Damage) {
        let duration = self.positive("duration_s", &scene.duration_s, "how long the run lasts");
        let dt = match &scene.dt_s {
            Some(dt) => {
                self.positive("dt_s", dt, "the time step; 0.01 is a fair start").map(|value| (value, dt.span()))
            }
            None => {
                if !damage.of("dt_s", 0) {
                    self.missing_step(scene);
                }
                None
            }
        };
        if let Some(record_hz) = &scene.record_hz {
            let help = "frames per second; leave it out to record every step";
            self.positive("record_hz", record_hz, help);
        }
        let Some(duration) = duration else {
            return;
        };
        let Some((dt, span)) = dt else {
            if scene.dt_s.is_none() && plan::chooses_steps(scene) {
                self.recorded(scene, duration, f64::INFINITY);
            }
            return;
        };
        let steps = duration / dt;
        if dt > duration {
            let message = format!("`dt_s` = {dt:?} is longer than the run of {duration:?} s");
            let diagnostic = Diagnostic::new(message).at(span).label("longer than `duration_s`");
            self.report(diagnostic.help("make `dt_s` smaller or `duration_s` larger"));
        } else if steps > MAX_STEPS {
            let message = format!("the run would take {steps:.1e} steps, more than {MAX_STEPS:.0e}");
            let diagnostic = Diagnostic::new(message).at(span).label("too small for `duration_s`");
            let least = duration / MAX_STEPS;
            self.report(diagnostic.help(format!("use a `dt_s` of at least {least:?}")));
        } else {
            self.recorded(scene, duration, steps);
        }
    }

    /// A step may be left out where nothing is stepped by it.
    fn missing_step(&mut self, scene: &Scene) {
        if plan::chooses_steps(scene) {
            return;
        }
        const ADD: &str = "add `dt_s = ..` at the top, above the first [table]";
        let fixed =
            |method: &&Spanned<Method>| !method.get_ref().is_adaptive() && *method.get_ref() != Method::FreeFlight;
        let can_collide = plan::pairs::collision_pairs(scene) > 0;
        let nothing_moves = plan::formulations(scene).is_empty() && particles::count(scene) == 0.0;
        let method = scene.solver.method.as_ref().filter(fixed).filter(|_| !can_collide && !nothing_moves);
        if let Some(method) = method {
            let name = method.get_ref().name();
            let diagnostic = Diagnostic::new(format!("`{name}` makes steps of `dt_s`, and the scene has none"));
            let adaptive = Method::Tsit5.name();
            let help = format!("{ADD}, or use a method that chooses its steps, such as `{adaptive}`");
            return self.report(diagnostic.at(method.span()).help(help));
        }
        let help = if can_collide { format!("{ADD}: collisions are looked for every `dt_s`") } else { ADD.to_owned() };
        self.report(Diagnostic::new("the scene has no `dt_s`").help(help));
    }

    /// Frames are held in memory until the run ends.
    fn recorded(&mut self, scene: &Scene, duration: f64, steps: f64) {
        let hz = plan::record_hz(scene).unwrap_or(f64::INFINITY);
        #[expect(clippy::cast_precision_loss, reason = "a number of bodies")]
        let bodies = scene.body.len() as f64;
        let each = (bodies + particles::count(scene) / 2.0).max(1.0);
        // Where steps are chosen, there may be more frames than steps of `dt_s`.
        let chosen = plan::chooses_steps(scene) && hz.is_finite();
        let frames = if chosen { duration * hz } else { steps.min(duration * hz) };
        if frames * each > MAX_RECORDED {
            let place = scene.record_hz.as_ref().or(scene.dt_s.as_ref()).unwrap_or(&scene.duration_s);
            let (states, most) = (frames * each, MAX_RECORDED / each / duration);
            let message = format!("the run would record {states:.1e} states, more than {MAX_RECORDED:.0e}");
            let diagnostic = Diagnostic::new(message).at(Spanned::span(place)).label("too many to hold in memory");
            self.report(diagnostic.help(format!("set `record_hz` to at most {most:.3}")));
        }
    }
}

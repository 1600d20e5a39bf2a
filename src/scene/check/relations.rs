//! Mistakes between values: what a body lacks or has too much, and what forces act on.

use toml::Spanned;

use super::Checker;
use crate::scene::description::{Body, Force, Scene, Shape};
use crate::scene::diagnostic::Diagnostic;
use crate::scene::read::Damage;
use crate::scene::suggest;
use crate::scene::values::Numbers;

impl Checker {
    /// Whether a body has what it needs, and nothing that contradicts it.
    pub(super) fn completeness(&mut self, body: &Body) {
        let name = body.name.get_ref();
        let at_name = |message: String| Diagnostic::new(message).at(body.name.span());
        if body.fixed {
            self.fixed_body(body);
        } else if let Some(Shape::Plane(plane)) = &body.shape {
            let message = format!("`{name}` is a plane, and planes do not move");
            let diagnostic = Diagnostic::new(message).at(plane.normal.span());
            self.report(diagnostic.help("add `fixed = true`"));
        } else if body.mass_kg.is_none() {
            let diagnostic = at_name(format!("`{name}` has no mass")).label("this body");
            self.report(diagnostic.help("add `mass_kg = ..`, or `fixed = true` if it never moves"));
        }
        if body.shape.is_none() && (body.inertia_kg_m2.is_none() || body.fixed) {
            let message = format!("`{name}` has neither a shape nor an inertia");
            let (message, help) = if body.fixed {
                (format!("`{name}` is fixed and has no shape"), "add a shape, or remove the body")
            } else {
                (message, "add a shape, `shape.box.size_m = [1, 1, 1]`, or `inertia_kg_m2`")
            };
            self.report(at_name(message).label("this body").help(help));
        }
        if let Some(Shape::Plane(_)) = &body.shape {
            self.plane(body);
        }
    }

    fn fixed_body(&mut self, body: &Body) {
        let name = body.name.get_ref();
        let velocities = [
            ("velocity_m_s", Some(&body.velocity_m_s)),
            ("omega_world_rad_s", body.omega_world_rad_s.as_ref()),
            ("omega_body_rad_s", body.omega_body_rad_s.as_ref()),
        ];
        for (key, value) in velocities {
            if let Some(value) = value.filter(|v| *v.get_ref() != Numbers([0.0; 3])) {
                let message = format!("`{name}` is fixed and has a velocity");
                let diagnostic = Diagnostic::new(message).at(value.span());
                let diagnostic = diagnostic.label("must be zero for a fixed body");
                self.report(diagnostic.help(format!("remove `{key}` or `fixed = true`")));
            }
        }
    }

    fn plane(&mut self, body: &Body) {
        let name = body.name.get_ref();
        let scaled = Some(&body.scale).filter(|scale| *scale.get_ref() != 1.0);
        let superfluous = [
            ("mass_kg", body.mass_kg.as_ref().map(Spanned::span)),
            ("inertia_kg_m2", body.inertia_kg_m2.as_ref().map(Spanned::span)),
            ("scale", scaled.map(Spanned::span)),
        ];
        for (key, span) in superfluous {
            if let Some(span) = span {
                let message = format!("`{name}` is a plane and has no use for `{key}`");
                self.report(Diagnostic::new(message).at(span).help(format!("remove `{key}`")));
            }
        }
    }

    /// The values of a force.
    pub(super) fn force(&mut self, force: &Force, scene: &Scene) {
        match force {
            Force::AtPoint(force) => {
                self.finite("at_body_m", &force.at_body_m);
                self.finite("force_world_n", &force.force_world_n);
                let start = self.number("start_s", &force.start_s);
                // Without an end the force lasts to the end of the run.
                let (end, place) = match &force.end_s {
                    Some(end) => (self.number("end_s", end), end.span()),
                    None => (Some(*scene.duration_s.get_ref()), force.start_s.span()),
                };
                let (Some(start), Some(end)) = (start, end) else {
                    return;
                };
                if start >= end {
                    let message = format!("the force starts at {start:?} s, not before its end");
                    let diagnostic = Diagnostic::new(message).at(place);
                    let diagnostic = diagnostic.label(format!("it ends at {end:?} s"));
                    self.report(diagnostic.help("make `start_s` smaller than `end_s`"));
                }
            }
            Force::LinearDrag(drag) => {
                for (key, k) in [("k_kg_s", &drag.k_kg_s), ("k_angular_n_m_s", &drag.k_angular_n_m_s)] {
                    if self.number(key, k).is_some_and(|k| k < 0.0) {
                        let value = k.get_ref();
                        let message = format!("`{key}` must not be negative, not {value:?}");
                        let diagnostic = Diagnostic::new(message).at(k.span());
                        self.report(diagnostic.help("a negative drag would drive the motion"));
                    }
                }
            }
        }
    }

    /// What a force acts on.
    pub(super) fn force_body(&mut self, force: &Force, scene: &Scene, damage: &Damage) {
        let body = force.body();
        let name = body.get_ref();
        let at_body = |message: String| Diagnostic::new(message).at(body.span());
        match scene.body_idx(name).and_then(|idx| scene.body.get(idx)) {
            Some(body) if body.fixed => {
                let diagnostic = at_body(format!("the force acts on `{name}`, which is fixed"));
                self.report(diagnostic.help("remove the force, or `fixed = true` of the body"));
            }
            Some(_) => {}
            // The body may be the one whose name could not be read.
            None if damage.of_names(scene) => {}
            None => {
                let names = || scene.body.iter().map(|body| body.name.get_ref().as_str());
                let mut diagnostic = at_body(format!("no body is named `{name}`"));
                if let Some(near) = suggest::closest(name, names()) {
                    diagnostic = diagnostic.label(format!("did you mean `{near}`?"));
                }
                self.report(diagnostic.help(match scene.body.is_empty() {
                    true => "the scene has no bodies".to_owned(),
                    false => format!("the bodies are {}", suggest::list(names())),
                }));
            }
        }
    }
}

//! Mistakes between values: what a body lacks or has too much.

use toml::Spanned;

use super::Checker;
use crate::scene::description::{Body, Shape};
use crate::scene::diagnostic::Diagnostic;
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
}

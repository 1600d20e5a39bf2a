//! Mistakes in forces: their values, and what they act on.

use toml::Spanned;

use super::Checker;
use super::springs::is_of_bodies;
use crate::scene::description::{Force, LinearDrag, Scene};
use crate::scene::diagnostic::Diagnostic;
use crate::scene::particles::Roster;
use crate::scene::read::Damage;
use crate::scene::suggest;

impl Checker {
    /// The values of a force.
    pub(super) fn force(&mut self, force: &Force, scene: &Scene) {
        match force {
            Force::AtPoint(force) => {
                self.finite("at_body_m", &force.at_body_m);
                self.finite("force_world_n", &force.force_world_n);
                self.span_of_time("force", &force.start_s, force.end_s.as_ref(), scene);
            }
            Force::Torque(torque) => {
                self.finite("torque_world_n_m", &torque.torque_world_n_m);
                self.span_of_time("torque", &torque.start_s, torque.end_s.as_ref(), scene);
            }
            Force::LinearDrag(drag) => {
                const DRIVES: &str = "a negative drag would drive the motion";
                self.not_negative("k_kg_s", &drag.k_kg_s, DRIVES);
                self.not_negative("k_angular_n_m_s", &drag.k_angular_n_m_s, DRIVES);
                self.drag_target(drag);
            }
            Force::QuadraticDrag(drag) => {
                self.not_negative("k_kg_m", &drag.k_kg_m, "a negative drag would drive the motion");
            }
            Force::InverseSquare(force) => {
                self.number("constant_m3_kg_s2", &force.constant_m3_kg_s2);
                self.not_negative("softening_m", &force.softening_m, "it is a length; 0 for none");
            }
            Force::InverseSquareToPoint(force) => {
                self.finite("point_m", &force.point_m);
                self.number("constant_m3_s2", &force.constant_m3_s2);
                self.not_negative("softening_m", &force.softening_m, "it is a length; 0 for none");
            }
            Force::Spring(spring) => {
                self.not_negative(
                    "stiffness_n_m",
                    &spring.stiffness_n_m,
                    "a negative one would push apart without end",
                );
                self.not_negative("damping_n_s_m", &spring.damping_n_s_m, "a negative damping would drive the motion");
                if let Some(length) = &spring.rest_length_m {
                    self.not_negative("rest_length_m", length, "leave it out for the distance at the start");
                }
            }
        }
    }

    /// When a force acts.
    fn span_of_time(&mut self, what: &str, start: &Spanned<f64>, end: Option<&Spanned<f64>>, scene: &Scene) {
        // Without an end the force lasts to the end of the run.
        let (end, place) = match end {
            Some(end) => (self.number("end_s", end), end.span()),
            None => (Some(*scene.duration_s.get_ref()), start.span()),
        };
        let (Some(start), Some(end)) = (self.number("start_s", start), end) else {
            return;
        };
        if start >= end {
            let message = format!("the {what} starts at {start:?} s, not before its end");
            let diagnostic = Diagnostic::new(message).at(place).label(format!("it ends at {end:?} s"));
            self.report(diagnostic.help("make `start_s` smaller than `end_s`"));
        }
    }

    fn not_negative(&mut self, key: &str, value: &Spanned<f64>, help: &str) {
        if let Some(x) = self.number(key, value).filter(|x| *x < 0.0) {
            let diagnostic = Diagnostic::new(format!("`{key}` must not be negative, not {x:?}"));
            self.report(diagnostic.at(value.span()).help(help));
        }
    }

    fn drag_target(&mut self, drag: &LinearDrag) {
        if let (Some(_), Some(particle)) = (&drag.body, &drag.particle) {
            let diagnostic = Diagnostic::new("the drag names both a body and a particle").at(particle.span());
            self.report(diagnostic.help("keep one of them, and write a [[force]] for the other"));
        }
        let k = &drag.k_angular_n_m_s;
        if drag.body.is_none() && *k.get_ref() != 0.0 {
            let diagnostic = Diagnostic::new("particles do not turn: `k_angular_n_m_s` is for bodies").at(k.span());
            self.report(diagnostic.help("remove it, or name a `body`"));
        }
    }

    /// What forces act on.
    pub(super) fn force_targets(&mut self, scene: &Scene, roster: Option<&Roster>, damage: &Damage) {
        for force in &scene.force {
            match force {
                Force::AtPoint(force) => self.force_body(&force.body, scene, damage),
                Force::Torque(torque) => self.force_body(&torque.body, scene, damage),
                Force::Spring(spring) if is_of_bodies(spring, scene) => self.spring_of_bodies(spring, scene, damage),
                Force::LinearDrag(LinearDrag { body: Some(body), .. }) => self.force_body(body, scene, damage),
                _ => {}
            }
            let Some(roster) = roster.filter(|_| !damage.of_particles()) else {
                continue;
            };
            match force {
                Force::LinearDrag(drag) if drag.body.is_none() => {
                    let needs_body = roster.len() == 0 && !scene.body.is_empty();
                    self.dragged(drag.particle.as_ref(), &drag.k_kg_s, needs_body, roster);
                }
                Force::QuadraticDrag(drag) => self.dragged(drag.particle.as_ref(), &drag.k_kg_m, false, roster),
                Force::InverseSquare(force) => {
                    self.some_particles(&force.constant_m3_kg_s2, roster);
                    if *force.softening_m.get_ref() == 0.0 {
                        self.coincident(roster, "`inverse_square`");
                    }
                }
                Force::InverseSquareToPoint(force) => {
                    self.some_particles(&force.constant_m3_s2, roster);
                    let at_point = |index: &usize| {
                        !roster.fixed[*index] && <[f64; 3]>::from(roster.position[*index]) == force.point_m.get_ref().0
                    };
                    let found = (0..roster.len()).find(at_point);
                    if let Some(index) = found.filter(|_| *force.softening_m.get_ref() == 0.0) {
                        let name = &roster.names[index];
                        let message =
                            format!("`{name}` is at the point that attracts it, where the force has no direction");
                        let place = if force.point_m.span() == (0..0) {
                            &force.constant_m3_s2.span()
                        } else {
                            &force.point_m.span()
                        };
                        let diagnostic = Diagnostic::new(message).at(place.clone());
                        self.report(diagnostic.help("move one of them, or give the force a `softening_m`"));
                    }
                }
                Force::Spring(spring) if !is_of_bodies(spring, scene) => self.spring_of_particles(spring, roster),
                _ => {}
            }
        }
    }

    /// A drag acts on what it names, or on all particles; where there are none, one that could act on a body should name it.
    fn dragged(&mut self, particle: Option<&Spanned<String>>, k: &Spanned<f64>, needs_body: bool, roster: &Roster) {
        match particle {
            None if needs_body => {
                let diagnostic = Diagnostic::new("the drag names no body").at(k.span());
                self.report(
                    diagnostic.help("add `body = ..`; without it the drag acts on particles, and there are none"),
                );
            }
            None => self.some_particles(k, roster),
            Some(name) => {
                let fixed = |index: usize| roster.fixed[index];
                let all_fixed = self.particles_of(name, roster).is_some_and(|mut range| range.all(fixed));
                if all_fixed {
                    let message = format!("the force acts on `{}`, which is fixed", name.get_ref());
                    let diagnostic = Diagnostic::new(message).at(name.span());
                    self.report(diagnostic.help("remove the force, or `fixed` of the particle"));
                }
            }
        }
    }

    fn some_particles(&mut self, value: &Spanned<f64>, roster: &Roster) {
        if roster.fixed.iter().all(|fixed| *fixed) {
            let diagnostic = Diagnostic::new("the force acts on particles, and the scene has none that move");
            self.report(
                diagnostic.at(value.span()).help("add a [[particle]], [[chain]] or [[net]], or remove the force"),
            );
        }
    }

    /// What a force on a body acts on.
    fn force_body(&mut self, body: &Spanned<String>, scene: &Scene, damage: &Damage) {
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
            None => self.report(unknown_body(body, scene)),
        }
    }
}

/// Says that no body has this name, and which there are.
pub(super) fn unknown_body(body: &Spanned<String>, scene: &Scene) -> Diagnostic {
    let name = body.get_ref();
    let names = || scene.body.iter().map(|body| body.name.get_ref().as_str());
    let mut diagnostic = Diagnostic::new(format!("no body is named `{name}`")).at(body.span());
    if let Some(near) = suggest::closest(name, names()) {
        diagnostic = diagnostic.label(format!("did you mean `{near}`?"));
    }
    diagnostic.help(match scene.body.is_empty() {
        true => "the scene has no bodies".to_owned(),
        false => format!("the bodies are {}", suggest::list(names())),
    })
}

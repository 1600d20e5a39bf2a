//! Mistakes in springs: between particles, and on bodies.

use super::Checker;
use super::joints::is_particle;
use crate::scene::bodies::sprung;
use crate::scene::description::{Scene, Spring};
use crate::scene::diagnostic::Diagnostic;
use crate::scene::particles::{Roster, count};
use crate::scene::read::Damage;

/// Whether a spring is on bodies: it names one, or there is nothing else to name.
pub(super) fn is_of_bodies(spring: &Spring, scene: &Scene) -> bool {
    let names = [Some(&spring.a), spring.b.as_ref()];
    let named = names.into_iter().flatten().any(|name| scene.body_idx(name.get_ref()).is_some());
    named || !scene.body.is_empty() && count(scene) == 0.0
}

impl Checker {
    pub(super) fn spring_of_bodies(&mut self, spring: &Spring, scene: &Scene, damage: &Damage) {
        let before = self.found.len();
        let names = [Some(&spring.a), spring.b.as_ref()];
        let particle = names.into_iter().flatten().find(|name| is_particle(name.get_ref(), scene));
        if let Some(particle) = particle {
            let message = format!("the spring links a body and a particle, `{}`", particle.get_ref());
            let diagnostic = Diagnostic::new(message).at(particle.span());
            return self.report(
                diagnostic
                    .help("bodies and particles do not act on each other yet: make it a small body, a `shape.ball`"),
            );
        }
        spring.at_a_body_m.as_ref().map(|point| self.finite("at_a_body_m", point));
        let (at_b, to) = (spring.at_b_body_m.as_ref(), spring.to_m.as_ref());
        self.second_end("spring", &spring.a, spring.b.as_ref(), at_b, to);
        self.linked(("spring", "name two bodies or two particles"), (&spring.a, spring.b.as_ref()), scene, damage);
        if self.found.len() > before {
            return;
        }
        if let Some(sprung) = sprung(spring, scene) {
            let [first, second] = sprung.ends;
            self.has_direction(spring, first.at != second.at, "both ends of the spring are at one place");
        }
    }

    pub(super) fn spring_of_particles(&mut self, spring: &Spring, roster: &Roster) {
        let of_bodies = [
            ("at_a_body_m", spring.at_a_body_m.as_ref()),
            ("at_b_body_m", spring.at_b_body_m.as_ref()),
            ("to_m", spring.to_m.as_ref()),
        ];
        for (key, value) in of_bodies {
            if let Some(value) = value {
                let message = format!("`{key}` is for springs on bodies, and this one is on particles");
                let help = if key == "to_m" { "name a fixed particle `b` in its place" } else { "remove it" };
                self.report(Diagnostic::new(message).at(value.span()).help(help));
            }
        }
        let Some(b) = &spring.b else {
            if spring.to_m.is_none() && self.particles_of(&spring.a, roster).is_some() {
                let diagnostic = Diagnostic::new("the spring has one end only").at(spring.a.span());
                self.report(diagnostic.help("add `b = ..`, the name of another particle"));
            }
            return;
        };
        let Some([first, second]) = self.pair(&spring.a, b, roster) else {
            return;
        };
        let message = format!("`{}` and `{}` are at one place", spring.a.get_ref(), b.get_ref());
        self.has_direction(spring, roster.position[first] != roster.position[second], &message);
    }

    /// A spring between ends at one place has no direction, unless it pulls them together.
    fn has_direction(&mut self, spring: &Spring, apart: bool, message: &str) {
        let rest = spring.rest_length_m.as_ref().map_or(0.0, |rest| *rest.get_ref());
        if !apart && rest > 0.0 {
            let place = spring.b.as_ref().unwrap_or(&spring.a).span();
            let diagnostic = Diagnostic::new(format!("{message}: the spring has no direction")).at(place);
            self.report(diagnostic.help("move one of them, or set `rest_length_m = 0`"));
        }
    }
}

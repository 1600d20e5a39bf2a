//! Methods that fit nothing in the scene, or not what acts in it.

use super::Checker;
use crate::scene::bodies::Loads;
use crate::scene::description::{Formulation, Method, Scene};
use crate::scene::diagnostic::Diagnostic;
use crate::scene::{particles, plan};

impl Checker {
    /// A method counts for what it can move; there must be something.
    pub(super) fn method(&mut self, scene: &Scene) {
        let Some(named) = &scene.solver.method else {
            return;
        };
        let method = *named.get_ref();
        let name = method.name();
        let with_particles = particles::count(scene) > 0.0;
        let formulations = plan::formulations(scene);
        let moves_bodies = formulations.iter().any(|formulation| method.moves(*formulation));
        let nothing_moves = !with_particles && formulations.is_empty();
        if nothing_moves || moves_bodies || with_particles && method.of_particles().is_some() {
            if method == Method::FreeFlight && moves_bodies {
                self.free_flight(scene);
            }
            return;
        }
        let in_any: Vec<Formulation> = Formulation::ALL.into_iter().filter(|it| method.moves(*it)).collect();
        let (message, help) = if in_any.is_empty() {
            (
                format!("`{name}` moves particles, and the scene has none"),
                "leave `method` out, and the plan chooses one for the bodies".to_owned(),
            )
        } else if formulations.is_empty() {
            (
                format!("`{name}` moves bodies, and the scene has none that move"),
                "leave `method` out, and the plan chooses one for the particles".to_owned(),
            )
        } else {
            let list = |these: &[Formulation]| {
                these.iter().map(|it| format!("`{}`", it.name())).collect::<Vec<_>>().join(" or ")
            };
            (
                format!("`{name}` moves bodies by {}, and here they are by {}", list(&in_any), list(&formulations)),
                "change `formulation`, or name a method that moves them all, such as `rk4` or `tsit5`".to_owned(),
            )
        };
        self.report(Diagnostic::new(message).at(named.span()).help(help));
    }

    fn free_flight(&mut self, scene: &Scene) {
        let loads = Loads::of(scene, Formulation::Rotor);
        let Some(named) = scene.solver.method.as_ref().filter(|_| !loads.none()) else {
            return;
        };
        let diagnostic = Diagnostic::new(format!(
            "`free_flight` is the motion under gravity alone, and on the bodies act {}",
            loads.listed()
        ));
        self.report(diagnostic.at(named.span()).help("use `yoshida4`, which composes it with forces and joints"));
    }
}

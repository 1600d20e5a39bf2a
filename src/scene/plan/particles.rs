//! What the particles of a scene need.

use super::{Plan, scalar_name};
use crate::scene::description::{ConstraintSolver, Force, Method, Scene, Stabilisation};
use crate::scene::particles::{Held, Roster, held};

/// What there is to be simulated, counted.
pub(super) struct Census {
    pub(super) particles: usize,
    pub(super) moving: usize,
    pub(super) constraints: usize,
    /// Forces that depend on the velocity.
    pub(super) drags: usize,
    pub(super) springs: usize,
    pub(super) pairwise: usize,
    pub(super) centres: usize,
}

impl Census {
    pub(super) fn of(scene: &Scene) -> Self {
        let roster = Roster::of(scene);
        let links = roster.links.iter().filter(|link| roster.can_move(**link)).count();
        let held = scene.constraint.iter().flat_map(|constraint| held(constraint, &roster));
        let count = |is: fn(&Force) -> bool| scene.force.iter().filter(|force| is(force)).count();
        Self {
            particles: roster.len(),
            moving: roster.fixed.iter().filter(|fixed| !**fixed).count(),
            constraints: links + held.map(|held: Held| held.constraints().len()).sum::<usize>(),
            drags: count(|force| match force {
                Force::LinearDrag(drag) => drag.body.is_none(),
                Force::QuadraticDrag(_) => true,
                Force::Spring(spring) => *spring.damping_n_s_m.get_ref() > 0.0,
                _ => false,
            }),
            springs: count(|force| matches!(force, Force::Spring(_))),
            pairwise: count(|force| matches!(force, Force::InverseSquare(_))),
            centres: count(|force| matches!(force, Force::InverseSquareToPoint(_))),
        }
    }
}

impl Plan {
    pub(super) fn particles(&mut self, scene: &Scene, census: &Census) {
        let Some(solver) = self.particle_solver.clone() else {
            return self.leave_out("particles", "the scene has no [[particle]], [[chain]] or [[net]]");
        };
        let scalar = scalar_name(scene);
        let name = solver.method.name();
        self.model("particles", format!("{scalar} with f64 world positions"));
        self.model("solver", format!("`{name}`: {}", solver.why));
        let how = format!("rtol {:e}, atol {:e} m and m/s, the largest of all errors", solver.rtol, solver.atol);
        self.choose(solver.adaptive, "step control", &how, &format!("`{name}` makes steps of `dt_s`"));
        let stabilised = match solver.stabilisation {
            _ if solver.splits() => "held in each step by RATTLE",
            Stabilisation::Projection => "projected after each step",
            Stabilisation::Baumgarte => "damped by Baumgarte's terms",
            Stabilisation::None => "not stabilised",
        };
        let how = match solver.method {
            Method::Xpbd if solver.constraints == ConstraintSolver::Sweeps => {
                format!("{}, swept one by one, violation {:e}", census.constraints, solver.violation)
            }
            Method::Xpbd => format!("{}, corrected all at once, violation {:e}", census.constraints, solver.violation),
            _ => format!(
                "{}, multipliers by {}, {stabilised}, violation {:e}",
                census.constraints,
                solver.constraints.name().replace('_', " "),
                solver.violation
            ),
        };
        self.choose(census.constraints > 0, "constraints", &how, "nothing holds a particle");
        let pairs = census.particles * census.particles.saturating_sub(1) / 2;
        let how = format!("between all {pairs} pairs");
        self.choose(census.pairwise > 0, "attraction", &how, "no [[force]] `inverse_square`");
        if census.centres > 0 {
            self.model("attracting points", census.centres.to_string());
        }
        if census.springs > 0 {
            self.model("springs", census.springs.to_string());
        }
        let how = format!("{} that depend on the velocity", census.drags);
        self.choose(census.drags > 0, "drag on particles", &how, "no [[force]] names particles for it");
        if census.drags > 0 && solver.splits() {
            self.leave_out(
                "full order in drag",
                &format!("`{name}` is of order 1 in forces that depend on the velocity"),
            );
        }
        if !scene.body.is_empty() {
            self.leave_out("bodies and particles", "they do not act on each other yet");
        }
        self.leave_out("collisions of particles", "not modelled: particles pass through one another");
        if scene.solver.rtol.is_some() && !solver.adaptive {
            self.leave_out("tolerances", &format!("`{name}` does not control its error"));
        }
        if scene.solver.substeps.is_some() && solver.method != Method::Xpbd {
            self.leave_out("substeps", &format!("`{name}` has none"));
        }
    }
}

//! What a scene conserves: a drift is told of nothing else.

use crate::rigid::Attachment;
use crate::scene::Scene;
use crate::scene::build::{LinkKind, LinkLook};
use crate::scene::description::{Constraint, Force};
use crate::simulation::{EventKind, Record};

/// What the scene conserves: nothing from outside may change it.
pub(super) struct Conserved {
    pub(super) energy: bool,
    pub(super) momentum: bool,
    pub(super) angular_momentum: bool,
}

impl Conserved {
    /// Of a run of a scene; `links` are the joints and springs of its bodies.
    pub(super) fn of(scene: &Scene, links: &[LinkLook], record: &Record) -> Self {
        let impacts = || record.events.iter().filter(|event| event.kind == EventKind::Impact);
        let elastic = *scene.contact.restitution.get_ref() >= 1.0 || impacts().count() == 0;
        let fixed = |index: usize| scene.body[index].fixed;
        let struck_fixed = impacts().any(|event| fixed(event.a) || fixed(event.b));
        // Constraints and joints do no work; they pass momentum on to what is fixed.
        let potential = |force: &Force| match force {
            Force::InverseSquare(_) | Force::InverseSquareToPoint(_) => true,
            Force::Spring(spring) => *spring.damping_n_s_m.get_ref() == 0.0,
            Force::AtPoint(_) | Force::LinearDrag(_) | Force::QuadraticDrag(_) | Force::Torque(_) => false,
        };
        let mutual = |force: &Force| matches!(force, Force::InverseSquare(_) | Force::Spring(_));
        let anchored = scene.particle.iter().any(|particle| particle.fixed)
            || scene.chain.iter().any(|chain| !chain.fixed.is_empty())
            || scene.net.iter().any(|net| !net.fixed.is_empty())
            || scene.constraint.iter().any(|constraint| !matches!(constraint, Constraint::Distance(_)));
        let closed = !struck_fixed && !anchored && scene.gravity_m_s2.get_ref().0 == [0.0; 3];
        let isolated = closed && scene.force.iter().all(mutual) && links.iter().all(between_bodies);
        Self {
            energy: scene.force.iter().all(potential) && elastic,
            momentum: isolated,
            angular_momentum: isolated || closed && scene.force.iter().all(central) && links.iter().all(about_origin),
        }
    }
}

/// Whether a force is mutual, or towards the origin, about which angular momentum is taken; of springs see their ends.
fn central(force: &Force) -> bool {
    match force {
        Force::InverseSquareToPoint(force) => force.point_m.get_ref().0 == [0.0; 3],
        Force::InverseSquare(_) | Force::Spring(_) => true,
        _ => false,
    }
}

/// Whether both ends of a link are on bodies that move.
fn between_bodies(link: &LinkLook) -> bool {
    link.ends.iter().all(|end| matches!(end, Attachment::Body { .. }))
}

/// Whether what a link does to the world has no moment about the origin.
fn about_origin(link: &LinkLook) -> bool {
    let at_origin = |end: &Attachment<f64>| match end {
        Attachment::Body { .. } => true,
        Attachment::World(point) => <[f64; 3]>::from(*point) == [0.0; 3],
    };
    // The axis of a hinge passes on moments, wherever it is.
    between_bodies(link) || !matches!(link.kind, LinkKind::Hinge(_)) && link.ends.iter().all(at_origin)
}

//! What acts on the bodies of one formulation, counted: it decides which methods can move them.

use super::{joined, sprung};
use crate::scene::description::{Body, Force, Formulation, LinearDrag, Scene};

/// What there is of bodies of one formulation, and what acts on them besides uniform gravity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Loads {
    /// Bodies that move.
    pub(crate) bodies: usize,
    /// Forces at points.
    pub(crate) at_points: usize,
    /// Torques.
    pub(crate) torques: usize,
    /// Drags.
    pub(crate) drags: usize,
    /// Springs.
    pub(crate) springs: usize,
    /// Those of the springs that have a damper.
    pub(crate) dampers: usize,
    /// Joints.
    pub(crate) joints: usize,
    /// Degrees of freedom that the joints take, those that several take counted as often.
    pub(crate) joint_rows: usize,
}

impl Loads {
    /// Of the bodies that `wanted` picks.
    fn where_body(scene: &Scene, wanted: impl Fn(&Body) -> bool) -> Self {
        let wanted = |body_idx: usize| {
            let body = &scene.body[body_idx];
            !body.fixed && wanted(body)
        };
        let named = |name: &toml::Spanned<String>| scene.body_idx(name.get_ref()).is_some_and(wanted);
        let mut loads =
            Self { bodies: (0..scene.body.len()).filter(|body_idx| wanted(*body_idx)).count(), ..Self::default() };
        for force in &scene.force {
            match force {
                Force::AtPoint(force) => loads.at_points += usize::from(named(&force.body)),
                Force::Torque(torque) => loads.torques += usize::from(named(&torque.body)),
                Force::LinearDrag(LinearDrag { body: Some(body), .. }) => loads.drags += usize::from(named(body)),
                Force::Spring(spring) => {
                    let ends = sprung(spring, scene).map_or([None; 2], |sprung| sprung.ends.map(|end| end.moved_by()));
                    let pulls = ends.iter().flatten().any(|(body_idx, _)| wanted(*body_idx));
                    loads.springs += usize::from(pulls);
                    loads.dampers += usize::from(pulls && *spring.damping_n_s_m.get_ref() > 0.0);
                }
                _ => {}
            }
        }
        for joined in scene.joint.iter().filter_map(|joint| joined(joint, scene)) {
            if joined.ends().iter().filter_map(|end| end.moved_by()).any(|(body_idx, _)| wanted(body_idx)) {
                loads.joints += 1;
                loads.joint_rows += joined.rows();
            }
        }
        loads
    }

    /// Of all bodies.
    pub(crate) fn of_all(scene: &Scene) -> Self {
        Self::where_body(scene, |_| true)
    }

    /// Of the bodies of a formulation.
    pub(crate) fn of(scene: &Scene, formulation: Formulation) -> Self {
        Self::where_body(scene, |body| scene.formulation_of(body) == formulation)
    }

    /// Does nothing but gravity act? Then the motion is known in closed form.
    pub(crate) fn none(&self) -> bool {
        *self == Self { bodies: self.bodies, ..Self::default() }
    }

    /// What acts, in words.
    pub(crate) fn listed(&self) -> String {
        let kinds = [
            (self.at_points, "force at a point", "forces at points"),
            (self.torques, "torque", "torques"),
            (self.drags, "drag", "drags"),
            (self.springs, "spring", "springs"),
            (self.joints, "joint", "joints"),
        ];
        let some = kinds.iter().filter(|(count, ..)| *count > 0);
        let words = some.map(|(count, one, more)| format!("{count} {}", if *count == 1 { one } else { more }));
        words.collect::<Vec<_>>().join(", ")
    }

    /// Does a force depend on the velocity?
    pub(crate) fn dissipate(&self) -> bool {
        self.drags + self.dampers > 0
    }
}

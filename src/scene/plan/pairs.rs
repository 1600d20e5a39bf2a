//! Which bodies can collide.

use crate::scene::description::{Joint, Scene};
use std::collections::BTreeSet;

/// Pairs of bodies, in order, that a joint links directly: they do not collide.
#[must_use]
pub fn joined_pairs(scene: &Scene) -> BTreeSet<(usize, usize)> {
    let pair = |joint: &Joint| {
        let (a, b) = joint.names();
        let (a, b) = (scene.body_idx(a.get_ref())?, scene.body_idx(b?.get_ref())?);
        (a != b).then_some((a.min(b), a.max(b)))
    };
    scene.joint.iter().filter_map(pair).collect()
}

/// Whether the body at a place has a shape that collides.
pub(super) fn collides(scene: &Scene, body_idx: usize) -> bool {
    scene.body.get(body_idx).and_then(|body| body.shape.as_ref()).is_some_and(|shape| shape.collides())
}

/// Pairs of bodies with shapes that collide, of which one moves and that no joint links.
pub(crate) fn collision_pairs(scene: &Scene) -> usize {
    let shaped = |fixed: bool| {
        (0..scene.body.len()).filter(|idx| collides(scene, *idx) && scene.body[*idx].fixed == fixed).count()
    };
    let (fixed, moving) = (shaped(true), shaped(false));
    let movable = |(a, b): &&(usize, usize)| !(scene.body[*a].fixed && scene.body[*b].fixed);
    let linked = joined_pairs(scene);
    let linked = linked.iter().filter(movable).filter(|(a, b)| collides(scene, *a) && collides(scene, *b)).count();
    (moving * fixed + moving * moving.saturating_sub(1) / 2).saturating_sub(linked)
}

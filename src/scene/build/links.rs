//! Forces and joints on bodies.

use crate::algebra::Real;
use crate::algebra::g3::{Bivector, Vector};
use crate::rigid::{Attachment, Force, Forces, Joint};
use crate::scene::Numbers;
use crate::scene::bodies::{End, Joined, Pose, joined, sprung};
use crate::scene::description::{self, Scene};

fn vector<T: Real>(numbers: &toml::Spanned<Numbers<3>>) -> Vector<T> {
    Vector::from(numbers.get_ref().0).map(T::from_f64)
}

fn attachment<T: Real>(end: End) -> Attachment<T> {
    match end.on {
        Some((body_idx, at_body)) => Attachment::Body { body_idx, at_body: at_body.map(T::from_f64) },
        None => Attachment::World(end.at),
    }
}

/// Gravity and the forces on bodies.
pub(super) fn forces<T: Real>(scene: &Scene) -> Forces<T> {
    let forces = scene.force.iter().filter_map(|force| self::force(force, scene));
    Forces { gravity: vector(&scene.gravity_m_s2), forces: forces.collect() }
}

/// A force on a body; nothing for one on particles.
fn force<T: Real>(force: &description::Force, scene: &Scene) -> Option<Force<T>> {
    let number = |value: &toml::Spanned<f64>| *value.get_ref();
    let end = |value: &Option<toml::Spanned<f64>>| value.as_ref().map_or(f64::INFINITY, number);
    match force {
        description::Force::AtPoint(it) => Some(Force::AtPoint {
            body_idx: scene.body_idx(it.body.get_ref())?,
            at_body: vector(&it.at_body_m),
            force_world: vector(&it.force_world_n),
            start_s: number(&it.start_s),
            end_s: end(&it.end_s),
        }),
        description::Force::Torque(it) => Some(Force::Torque {
            body_idx: scene.body_idx(it.body.get_ref())?,
            torque_world: Bivector::from(it.torque_world_n_m.get_ref().0).map(T::from_f64),
            start_s: number(&it.start_s),
            end_s: end(&it.end_s),
        }),
        description::Force::LinearDrag(it) => Some(Force::LinearDrag {
            body_idx: scene.body_idx(it.body.as_ref()?.get_ref())?,
            k: T::from_f64(number(&it.k_kg_s)),
            k_angular: T::from_f64(number(&it.k_angular_n_m_s)),
        }),
        description::Force::Spring(it) => {
            let sprung = sprung(it, scene)?;
            let [a, b] = sprung.ends.map(attachment);
            Some(Force::Spring {
                a,
                b,
                stiffness: T::from_f64(number(&it.stiffness_n_m)),
                damping: T::from_f64(number(&it.damping_n_s_m)),
                rest_length: T::from_f64(sprung.rest_length),
            })
        }
        description::Force::QuadraticDrag(_)
        | description::Force::InverseSquare(_)
        | description::Force::InverseSquareToPoint(_) => None,
    }
}

/// The joints.
pub(super) fn joints<T: Real>(scene: &Scene) -> Vec<Joint<T>> {
    let joint = |joint| {
        Some(match joined(joint, scene)? {
            Joined::Ball { ends } => {
                let [a, b] = ends.map(attachment);
                Joint::Ball { a, b }
            }
            Joined::Hinge { ends, axes } => {
                let ([a, b], [axis_a, axis_b]) = (ends.map(attachment), axes.map(|axis| axis.map(T::from_f64)));
                Joint::Hinge { a, b, axis_a, axis_b }
            }
            Joined::Distance { ends, length } => {
                let [a, b] = ends.map(attachment);
                Joint::Distance { a, b, length }
            }
        })
    };
    scene.joint.iter().filter_map(joint).collect()
}

/// How a joint or spring between bodies looks: what is at its ends, a body that moves and a point of its frame, or a point of
/// the world, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkLook {
    /// What it is.
    pub kind: LinkKind,
    /// Its ends.
    pub ends: [Attachment<f64>; 2],
}

/// What links bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LinkKind {
    /// A ball joint.
    Ball,
    /// A hinge about a direction in the frame of its first end, unit.
    Hinge(Vector<f64>),
    /// A distance.
    Distance,
    /// A spring.
    Spring,
}

/// An end; one on a fixed body is one on the world.
fn seen(end: End) -> Attachment<f64> {
    if end.fixed { Attachment::World(end.at) } else { attachment(end) }
}

/// The axis of a hinge in the frame that its first end is seen in.
fn axis_seen(scene: &Scene, end: End, axis: Vector<f64>) -> Vector<f64> {
    let fixed = end.on.filter(|_| end.fixed).and_then(|(body_idx, _)| Pose::of(&scene.body[body_idx]));
    fixed.map_or(axis, |pose| pose.rotor.apply(axis))
}

/// All that links bodies, for the picture.
pub(super) fn looks(scene: &Scene) -> Vec<LinkLook> {
    let joint = |joint| {
        let joined = joined(joint, scene)?;
        let kind = match joined {
            Joined::Ball { .. } => LinkKind::Ball,
            Joined::Hinge { ends, axes } => LinkKind::Hinge(axis_seen(scene, ends[0], axes[0])),
            Joined::Distance { .. } => LinkKind::Distance,
        };
        Some(LinkLook { kind, ends: joined.ends().map(seen) })
    };
    let spring = |force: &description::Force| match force {
        description::Force::Spring(it) => {
            Some(LinkLook { kind: LinkKind::Spring, ends: sprung(it, scene)?.ends.map(seen) })
        }
        _ => None,
    };
    scene.joint.iter().filter_map(joint).chain(scene.force.iter().filter_map(spring)).collect()
}

//! Joints and springs of bodies: what is at their ends, and where it is at the start.
//!
//! An end on a fixed body is as good as one on the world.

use super::Pose;
use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;
use crate::scene::description::{Joint, Scene, Spring};
use crate::scene::values::Numbers;
use toml::Spanned;

/// One end of a joint or spring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct End {
    /// Where it is at the start, world.
    pub(crate) at: Point<f64>,
    /// The body that it is on, and the point of its frame; none: the world.
    pub(crate) on: Option<(usize, Vector<f64>)>,
    /// Whether that body is fixed.
    pub(crate) fixed: bool,
}

impl End {
    fn world(at: Point<f64>) -> Self {
        Self { at, on: None, fixed: true }
    }

    /// The body that moves it, and the point of its frame.
    pub(crate) fn moved_by(&self) -> Option<(usize, Vector<f64>)> {
        self.on.filter(|_| !self.fixed)
    }
}

/// What a joint holds.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Joined {
    /// Two points that are one.
    Ball { ends: [End; 2] },
    /// Two axes that are one, each in the frame of its end, unit.
    Hinge { ends: [End; 2], axes: [Vector<f64>; 2] },
    /// Two points at a distance.
    Distance { ends: [End; 2], length: f64 },
}

impl Joined {
    /// Its ends.
    pub(crate) fn ends(&self) -> [End; 2] {
        match *self {
            Self::Ball { ends } | Self::Hinge { ends, .. } | Self::Distance { ends, .. } => ends,
        }
    }

    /// How many degrees of freedom it takes.
    pub(crate) fn rows(&self) -> usize {
        match self {
            Self::Ball { .. } => 3,
            Self::Hinge { .. } => 5,
            Self::Distance { .. } => 1,
        }
    }
}

/// A spring on bodies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sprung {
    pub(crate) ends: [End; 2],
    /// m.
    pub(crate) rest_length: f64,
}

type Given<'a, T> = Option<&'a Spanned<T>>;

fn vector(given: Given<'_, Numbers<3>>) -> Vector<f64> {
    given.map_or_else(Vector::default, |numbers| numbers.get_ref().0.into())
}

/// The body of a name, if it is one, and its pose.
fn posed(scene: &Scene, name: &Spanned<String>) -> Option<(usize, bool, Pose)> {
    let body_idx = scene.body_idx(name.get_ref())?;
    let body = &scene.body[body_idx];
    Some((body_idx, body.fixed, Pose::of(body)?))
}

/// The end of a link at a place; without a name it is the world's.
fn at_place(scene: &Scene, name: Given<'_, String>, at: Point<f64>) -> Option<End> {
    let Some(name) = name else {
        return Some(End::world(at));
    };
    let (body_idx, fixed, pose) = posed(scene, name)?;
    Some(End { at, on: Some((body_idx, pose.to_body(at))), fixed })
}

/// The end of a link at a point of a body.
fn at_body(scene: &Scene, name: &Spanned<String>, point: Vector<f64>) -> Option<End> {
    let (body_idx, fixed, pose) = posed(scene, name)?;
    Some(End { at: pose.place(point), on: Some((body_idx, point)), fixed })
}

/// The second end of a distance or spring.
fn second(scene: &Scene, b: Given<'_, String>, at_b: Given<'_, Numbers<3>>, to: Given<'_, Numbers<3>>) -> Option<End> {
    match (b, to) {
        (Some(b), _) => at_body(scene, b, vector(at_b)),
        (None, Some(to)) => Some(End::world(to.get_ref().0.into())),
        (None, None) => None,
    }
}

fn apart(ends: [End; 2]) -> f64 {
    ends[0].at.distance_sq_to(ends[1].at).sqrt()
}

/// A direction of the world in the frame of an end.
fn in_frame(scene: &Scene, end: End, direction: Vector<f64>) -> Option<Vector<f64>> {
    match end.on {
        Some((body_idx, _)) => Some(Pose::of(&scene.body[body_idx])?.rotor.rev().apply(direction)),
        None => Some(direction),
    }
}

/// What a joint holds; nothing where a name is not known.
pub(crate) fn joined(joint: &Joint, scene: &Scene) -> Option<Joined> {
    match joint {
        Joint::Ball(it) => {
            let at = Point::from(it.point_m.get_ref().0);
            let ends = [at_place(scene, Some(&it.a), at)?, at_place(scene, it.b.as_ref(), at)?];
            Some(Joined::Ball { ends })
        }
        Joint::Hinge(it) => {
            let at = Point::from(it.point_m.get_ref().0);
            let ends = [at_place(scene, Some(&it.a), at)?, at_place(scene, it.b.as_ref(), at)?];
            let axis = Vector::from(it.axis.get_ref().0);
            let axis = axis / axis.norm_sq().sqrt();
            let axes = [in_frame(scene, ends[0], axis)?, in_frame(scene, ends[1], axis)?];
            Some(Joined::Hinge { ends, axes })
        }
        Joint::Distance(it) => {
            let first = at_body(scene, &it.a, vector(it.at_a_body_m.as_ref()))?;
            let ends = [first, second(scene, it.b.as_ref(), it.at_b_body_m.as_ref(), it.to_m.as_ref())?];
            let length = it.length_m.as_ref().map_or_else(|| apart(ends), |length| *length.get_ref());
            Some(Joined::Distance { ends, length })
        }
    }
}

/// What a spring on bodies pulls at; nothing for one between particles, or where a name is not known.
pub(crate) fn sprung(spring: &Spring, scene: &Scene) -> Option<Sprung> {
    let first = at_body(scene, &spring.a, vector(spring.at_a_body_m.as_ref()))?;
    let ends = [first, second(scene, spring.b.as_ref(), spring.at_b_body_m.as_ref(), spring.to_m.as_ref())?];
    let rest_length = spring.rest_length_m.as_ref().map_or_else(|| apart(ends), |length| *length.get_ref());
    Some(Sprung { ends, rest_length })
}

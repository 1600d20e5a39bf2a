//! Joints between two bodies, or a body and the world: what is held, and what must be true of it at the start.
//!
//! | joint | rows | holds |
//! |---|---|---|
//! | [`Ball`](Joint::Ball) | 3 | a point of a at a point of b |
//! | [`Hinge`](Joint::Hinge) | 5 | the same, and an axis of a along an axis of b, in its sense |
//! | [`Distance`](Joint::Distance) | 1 | a point of a at a distance from a point of b |
//!
//! Joints hold exactly, by multipliers ([`Held`](super::Held)); they have no friction, no limits, no motors.

use super::Attachment;
use crate::algebra::Real;
use crate::algebra::g3::Vector;
use thiserror::Error;

/// What is held. Either end may be in the world, not both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Joint<T> {
    /// Two points coincide: three rotations remain.
    Ball {
        /// One point.
        a: Attachment<T>,
        /// The other.
        b: Attachment<T>,
    },
    /// Two points coincide, and two axes: a rotation about the axis remains.
    Hinge {
        /// One point.
        a: Attachment<T>,
        /// The other.
        b: Attachment<T>,
        /// The axis in the frame of a (of the world, if a is there), of any length but zero.
        axis_a: Vector<T>,
        /// The axis in the frame of b, in the same sense.
        axis_b: Vector<T>,
    },
    /// Two points keep their distance: a massless rod between two balls.
    Distance {
        /// One point.
        a: Attachment<T>,
        /// The other.
        b: Attachment<T>,
        /// Positive, m.
        length: f64,
    },
}

impl<T: Real> Joint<T> {
    /// Its ends, a and b.
    #[must_use]
    pub fn ends(&self) -> [Attachment<T>; 2] {
        match *self {
            Self::Ball { a, b } | Self::Hinge { a, b, .. } | Self::Distance { a, b, .. } => [a, b],
        }
    }

    /// The bodies that it holds together; none at an end in the world.
    #[must_use]
    pub fn bodies(&self) -> [Option<usize>; 2] {
        self.ends().map(|end| end.body_idx())
    }
}

/// What is wrong with a joint.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum JointError {
    /// Arrays of different lengths.
    #[error("{bodies} bodies, {inertias} inertias: give one each a body")]
    Sizes {
        /// Bodies.
        bodies: usize,
        /// Inertias.
        inertias: usize,
    },
    /// A body that does not exist.
    #[error("joint {joint} is on body {body_idx}, but there are {bodies}")]
    NoSuchBody {
        /// Which.
        joint: usize,
        /// Its body.
        body_idx: usize,
        /// Their number.
        bodies: usize,
    },
    /// Both ends on one body.
    #[error("joint {joint} joins body {body_idx} to itself: choose two bodies, or leave one end in the world")]
    SameBody {
        /// Which.
        joint: usize,
        /// The body.
        body_idx: usize,
    },
    /// Nothing to hold.
    #[error("joint {joint} is between two ends that nothing moves: remove it, or make one of its bodies movable")]
    Immovable {
        /// Which.
        joint: usize,
    },
    /// A point or axis that is none.
    #[error("joint {joint}: a point or an axis of it, or where its bodies are, is not finite")]
    NotFinite {
        /// Which.
        joint: usize,
    },
    /// An axis without direction.
    #[error("joint {joint}: an axis of its hinge is zero; give the direction that both bodies turn about")]
    ZeroAxis {
        /// Which.
        joint: usize,
    },
    /// A distance that is not positive.
    #[error("joint {joint} holds a distance of {length_m:e} m: a distance is positive; for 0 take a ball joint")]
    Length {
        /// Which.
        joint: usize,
        /// m.
        length_m: f64,
    },
    /// Ends that do not meet, or not at the distance.
    #[error(
        "joint {joint}: its ends are off by {gap_m:e} m at the start, where {allowed_m:e} m are allowed: move the bodies \
         or the points so that they fit"
    )]
    Apart {
        /// Which.
        joint: usize,
        /// How far the two points are from where they should be, m.
        gap_m: f64,
        /// What passes for rounding, m.
        allowed_m: f64,
    },
    /// Axes that are not parallel, or against each other.
    #[error(
        "joint {joint}: the axes of its hinge differ by {angle_rad:e} rad at the start: turn the bodies, or one of the \
         axes (at pi they are opposite: reverse one)"
    )]
    AxesApart {
        /// Which.
        joint: usize,
        /// Between the two, 0 to pi.
        angle_rad: f64,
    },
}

impl JointError {
    /// The same of a joint that has another index.
    pub(super) fn renumbered(mut self, index_of: impl FnOnce(usize) -> usize) -> Self {
        match &mut self {
            Self::Sizes { .. } => {}
            Self::NoSuchBody { joint, .. }
            | Self::SameBody { joint, .. }
            | Self::Immovable { joint }
            | Self::NotFinite { joint }
            | Self::ZeroAxis { joint }
            | Self::Length { joint, .. }
            | Self::Apart { joint, .. }
            | Self::AxesApart { joint, .. } => *joint = index_of(*joint),
        }
        self
    }
}

/// Checks what does not depend on where the bodies are. `movable` says of a body whether anything moves it.
pub(super) fn check<T: Real>(joint: usize, what: &Joint<T>, movable: &[bool]) -> Result<(), JointError> {
    let bodies = movable.len();
    if let Some(body_idx) = what.bodies().into_iter().flatten().find(|body_idx| *body_idx >= bodies) {
        return Err(JointError::NoSuchBody { joint, body_idx, bodies });
    }
    if let [Attachment::Body { body_idx, .. }, Attachment::Body { body_idx: other, .. }] = what.ends()
        && body_idx == other
    {
        return Err(JointError::SameBody { joint, body_idx });
    }
    if !what.bodies().into_iter().flatten().any(|body_idx| movable[body_idx]) {
        return Err(JointError::Immovable { joint });
    }
    let finite = |x: [f64; 3]| x.iter().all(|x| x.is_finite());
    let vector = |x: Vector<T>| finite(x.map(Real::to_f64).into());
    let sound = what.ends().iter().all(|end| match end {
        Attachment::Body { at_body, .. } => vector(*at_body),
        Attachment::World(point) => finite((*point).into()),
    });
    if !sound {
        return Err(JointError::NotFinite { joint });
    }
    match *what {
        Joint::Ball { .. } => Ok(()),
        Joint::Distance { length: length_m, .. } if !(length_m > 0.0 && length_m.is_finite()) => {
            Err(JointError::Length { joint, length_m })
        }
        Joint::Distance { .. } => Ok(()),
        Joint::Hinge { axis_a, axis_b, .. } if !(vector(axis_a) && vector(axis_b)) => {
            Err(JointError::NotFinite { joint })
        }
        Joint::Hinge { axis_a, axis_b, .. } if [axis_a, axis_b].contains(&Vector::default()) => {
            Err(JointError::ZeroAxis { joint })
        }
        Joint::Hinge { .. } => Ok(()),
    }
}

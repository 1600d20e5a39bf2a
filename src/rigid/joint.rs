//! Joints: what bodies are held together by.

use super::Attachment;
use crate::algebra::Real;
use crate::algebra::g3::Vector;

/// A joint between two points, one of them at least on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Joint<T> {
    /// The two points coincide: 3 constraints.
    Ball {
        /// The first end.
        a: Attachment<T>,
        /// The second end.
        b: Attachment<T>,
    },
    /// The two points and the two axes coincide: 5 constraints.
    Hinge {
        /// The first end.
        a: Attachment<T>,
        /// The second end.
        b: Attachment<T>,
        /// The axis in the frame of the first body (of the world, if the end is there), unit.
        axis_a: Vector<T>,
        /// The axis in the frame of the second body (of the world, if the end is there), unit.
        axis_b: Vector<T>,
    },
    /// The two points keep their distance: 1 constraint.
    Distance {
        /// The first end.
        a: Attachment<T>,
        /// The second end.
        b: Attachment<T>,
        /// m.
        length: f64,
    },
}

impl<T: Real> Joint<T> {
    /// The bodies that it holds together; none at an end in the world.
    #[must_use]
    pub fn bodies(&self) -> [Option<usize>; 2] {
        match self {
            Self::Ball { a, b } | Self::Hinge { a, b, .. } | Self::Distance { a, b, .. } => {
                [a.body_idx(), b.body_idx()]
            }
        }
    }
}

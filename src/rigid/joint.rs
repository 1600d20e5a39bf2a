//! Joints: what bodies are held together by.

use super::Attachment;
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

//! The bodies of a scene as numbers: where they are and how they move at the start, and what links them.
//!
//! Values are taken as the file has them, sound or not: the check works from this, too.

mod links;
mod loads;
mod pose;

pub(crate) use links::{End, Joined, joined, sprung};
pub(crate) use loads::Loads;
pub(crate) use pose::{Pose, rotor};

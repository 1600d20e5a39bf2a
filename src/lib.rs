//! ga-physics.
#![cfg_attr(not(feature = "std"), no_std)]
extern crate alloc;
extern crate self as ga_physics;

pub mod algebra;
pub mod geometry;
#[cfg(feature = "cli")]
pub mod io;
#[cfg(feature = "cli")]
pub mod scene;

//! ga-physics.
#![cfg_attr(not(feature = "std"), no_std)]
extern crate alloc;
extern crate self as ga_physics;

pub mod algebra;

pub use ga_macros::{__algebra_with_base, algebra};

pub mod geometry;
#[cfg(feature = "physics")]
pub mod ode;
#[cfg(feature = "physics")]
pub mod rigid;
pub mod versor;
#[cfg(feature = "cli")]
pub mod io;
#[cfg(feature = "cli")]
pub mod scene;

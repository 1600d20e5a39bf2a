//! ga-physics.
#![cfg_attr(not(feature = "std"), no_std)]
extern crate alloc;
extern crate self as ga_physics;

pub mod algebra;

pub use ga_macros::{__algebra_with_base, algebra};

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "physics")]
pub mod collision;
pub mod geometry;
#[cfg(feature = "cli")]
pub mod io;
#[cfg(feature = "physics")]
pub mod ode;
#[cfg(feature = "physics")]
pub mod rigid;
#[cfg(feature = "cli")]
pub mod scene;
#[cfg(feature = "physics")]
pub mod simulation;
pub mod versor;

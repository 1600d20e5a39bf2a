//! The integrators: orders of convergence and of dense output, order conditions in exact arithmetic, step control,
//! events, counters, symplectic motion.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod conditions;
mod control;
mod dense;
mod events;
mod limits;
mod motion;
mod orders;
mod problems;

//! Bodies held by joints: the laws of their motion, closed forms, independent references, and what must not be held.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod cases;
mod hard;
mod laws;
mod loops;
mod methods;
mod mistakes;
mod pendulums;
mod rattle;

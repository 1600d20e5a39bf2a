//! Particles under forces and constraints: closed forms, orders, conservation, and what must not be held.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod cases;
mod forces;
mod mistakes;
mod nets;
mod orders;
mod own;
mod pendulums;

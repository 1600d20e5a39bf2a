//! Multipliers of constraints: both solvers against dense algebra, singular systems, projections, allocation.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
#![allow(clippy::cast_precision_loss, reason = "counts of tests are small")]

mod memory;
mod projection;
mod solvers;
mod systems;

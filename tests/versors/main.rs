//! Exponentials, logarithms, powers, interpolation and renormalisation of versors.
//!
//! `cargo test --test versors worst_errors -- --nocapture` prints the table of worst errors.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod accuracy;
mod conformal;
mod degenerate;
// The library's own double-double numbers, which it does not make public.
#[path = "../../src/geometry/double_double.rs"]
mod double_double;
mod grids;
mod laws;
mod naive;
mod reference;

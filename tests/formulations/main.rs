//! One law suite for all formulations of rigid motion and all methods that integrate them: agreement with an independent
//! reference and with closed forms, order, conservation, frames, far from the origin, single precision, drift.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod agreement;
mod drift;
mod forces;
mod frames;
mod group;
mod orders;
mod reference;
mod ways;

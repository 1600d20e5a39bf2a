//! The loop: step, detect, find the time of impact, respond, record. It does no input or output.
//!
//! Two buffers hold the state: the good one, in which no bodies overlap, and a trial one that a step is tried in
//! (report, Fig. 11). If the trial overlaps, the step is cut at the last instant before, the impulses are applied there,
//! and the rest of the step goes on from that.

mod event;
mod record;
mod run_ahead;
mod world;

pub use event::{Event, EventKind};
pub use record::{BodySample, Drifts, EnergySample, Frame, ParticleSample, Record, state_hash};
pub use run_ahead::{Next, RunAhead};
pub use world::{Setup, SimulationError, World};

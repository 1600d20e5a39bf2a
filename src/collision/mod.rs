//! Which bodies collide, where, when, and what the collision does to them. It knows no scene.
//!
//! The order is the report's (Fig. 7): bounding balls, then vertices within bodies, then edges through facets. Tests run
//! in the frame of one of the two bodies, on coordinates relative to its centre of mass.

mod bounds;
mod contact;
mod narrow_phase;
mod polyhedron;
mod response;
mod time_of_impact;

pub use bounds::balls_overlap;
pub use contact::Contact;
pub use narrow_phase::{Collider, NarrowPhase, Reach, Scenery};
pub use polyhedron::{Polyhedron, PolyhedronError};
pub use response::{Impulse, resolve, resolve_jointed};
pub use time_of_impact::{Bracket, first_overlap};

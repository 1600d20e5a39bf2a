//! What happened at one instant.

use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;
use crate::collision::Contact;
use crate::rigid::Bodies;

/// The kind of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// Two bodies struck one another.
    Impact,
    /// Two bodies stay in contact: their impacts follow one another without end.
    ContactPersists,
}

impl EventKind {
    /// The name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Impact => "impact",
            Self::ContactPersists => "contact_persists",
        }
    }
}

/// An event, in f64 and world coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// When, s.
    pub time_s: f64,
    /// What.
    pub kind: EventKind,
    /// First body.
    pub a: usize,
    /// Second body.
    pub b: usize,
    /// Where, m.
    pub point: Point<f64>,
    /// Unit normal from a to b.
    pub normal: Vector<f64>,
    /// Signed gap, m; negative on overlap.
    pub separation: f64,
    /// The impulse, N s: `+j n` on b.
    pub impulse: f64,
}

impl Event {
    /// The event of a contact.
    #[must_use]
    pub fn new<T: Real>(time_s: f64, kind: EventKind, contact: &Contact<T>, bodies: &Bodies<T>, impulse: T) -> Self {
        Self {
            time_s,
            kind,
            a: contact.a,
            b: contact.b,
            point: contact.point(bodies),
            normal: contact.normal.map(Real::to_f64),
            separation: contact.separation.to_f64(),
            impulse: impulse.to_f64(),
        }
    }
}

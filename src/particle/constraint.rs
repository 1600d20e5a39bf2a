//! Constraints on particles, in conformal form.
//!
//! ```text
//! distance of two particles   X1 . X2 + d²/2 = 0        report (26); bilinear
//! distance to a point         X . P + d²/2 = 0          report (25)
//! on a plane or sphere        X . S = 0                 S a vector of G(4,1)
//! on a line or circle         X ^ M = 0                 two of the kind before: M = undual(S1 ^ S2)
//! ```
//!
//! `X . P + d²/2 = X . S` for the sphere `S = P - d²/2 ninf` of radius d about P: all but the first are one formula.

use super::OwnConstraint;
use crate::algebra::cga::{Point, Round};

/// What is held.
#[derive(Clone, Debug)]
pub enum Constraint {
    /// Two particles keep their distance, m.
    Distance {
        /// First particle.
        a: usize,
        /// Second particle.
        b: usize,
        /// Positive.
        length: f64,
    },
    /// A particle keeps its distance to a point of the world, m.
    ToPoint {
        /// The particle.
        particle: usize,
        /// World.
        point: Point<f64>,
        /// Positive.
        length: f64,
    },
    /// A particle stays where `X . S = 0`: on a plane or a sphere of any weight.
    On {
        /// The particle.
        particle: usize,
        /// A point near the surface. Far from the origin `X . S` would lose the digits of x².
        anchor: Point<f64>,
        /// S in the frame that has the anchor as its origin.
        surface: Round<f64>,
    },
    /// One's own.
    Own(OwnConstraint),
}

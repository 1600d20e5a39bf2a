//! The forces of the report's Table 2, springs, and forces of one's own.

use super::{OwnForce, OwnPotential};
use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;

/// A force on particles. Fixed particles feel none.
#[derive(Clone, Debug)]
pub enum Force<T> {
    /// `F = C m1 m2 r / (r² + s²)^(3/2)` between every two particles, attractive for C > 0; `C m1 m2 / r²` without
    /// softening (Table 2, row 1). All pairs are evaluated: the cost is n².
    InverseSquare {
        /// C, m³/(kg s²).
        constant: T,
        /// Softening length s, m (Plummer 1911); 0 for none.
        softening: T,
    },
    /// `F = D m r / (r² + s²)^(3/2)` towards a point (row 2).
    InverseSquareToPoint {
        /// World.
        point: Point<f64>,
        /// D, m³/s².
        constant: T,
        /// Softening length s, m.
        softening: T,
    },
    /// `F = m g` (row 3).
    Uniform {
        /// g, m/s².
        acceleration: Vector<T>,
    },
    /// `F = -k v` (row 4), on one particle or on all.
    LinearDrag {
        /// Which; all if none is named.
        particle: Option<usize>,
        /// k, kg/s.
        k: T,
    },
    /// `F = -k |v| v` (row 5, with the misprint corrected), on one particle or on all.
    QuadraticDrag {
        /// Which; all if none is named.
        particle: Option<usize>,
        /// k, kg/m.
        k: T,
    },
    /// `F = -(k (r - l) + c rdot)` along the line of two particles.
    Spring {
        /// First particle.
        a: usize,
        /// Second particle.
        b: usize,
        /// k, N/m.
        stiffness: T,
        /// c, N s/m.
        damping: T,
        /// l, m.
        rest_length: T,
    },
    /// The negative gradient of a potential of one's own.
    Potential(OwnPotential),
    /// A law of one's own.
    Law(OwnForce),
}

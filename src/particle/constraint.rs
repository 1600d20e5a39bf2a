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

use super::own::Scratch;
use super::{OwnConstraint, Particles};
use crate::algebra::Real;
use crate::algebra::cga::{Point, Round};
use crate::algebra::g3::Vector;

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

impl Constraint {
    /// The particles that it holds.
    pub fn for_each_particle(&self, mut with: impl FnMut(usize)) {
        match self {
            Self::Distance { a, b, .. } => [*a, *b].into_iter().for_each(with),
            Self::ToPoint { particle, .. } | Self::On { particle, .. } => with(*particle),
            Self::Own(own) => own.particles().iter().copied().for_each(with),
        }
    }

    /// C. A distance gives `(d² - r²)/2`, m²; a surface what its normalisation gives: m for a unit plane, m² for a
    /// sphere of weight 1.
    pub(super) fn value(&self, position: &[Point<f64>], scratch: &mut Scratch) -> f64 {
        match self {
            Self::Distance { a, b, length } => to_point(position[*a], position[*b], *length),
            Self::ToPoint { particle, point, length } => to_point(position[*particle], *point, *length),
            Self::On { particle, anchor, surface } => relative(position[*particle], *anchor) | *surface,
            Self::Own(own) => own.value(position, scratch),
        }
    }

    /// `dC/dx`, particle by particle, in the order of [`Constraint::for_each_particle`].
    pub(super) fn gradient(
        &self,
        position: &[Point<f64>],
        scratch: &mut Scratch,
        mut with: impl FnMut(usize, Vector<f64>),
    ) {
        match self {
            Self::Distance { a, b, .. } => {
                let to_b = position[*a].displacement_to(position[*b]);
                with(*a, to_b);
                with(*b, -to_b);
            }
            Self::ToPoint { particle, point, .. } => with(*particle, position[*particle].displacement_to(*point)),
            Self::On { particle, anchor, surface } => {
                // X = no + x + x²/2 ninf moves by e_i + x_i ninf: the gradient is the Euclidean part of S - (weight) X.
                let x = anchor.displacement_to(position[*particle]);
                with(*particle, Vector::new(surface.e1, surface.e2, surface.e3) - x * surface.no);
            }
            Self::Own(own) => own.gradient(position, scratch, with),
        }
    }

    /// `Jdot v`, the part of `d²C/dt²` that is there without acceleration.
    pub(super) fn curvature<T: Real>(&self, state: &Particles<T>, scratch: &mut Scratch) -> f64 {
        let velocity = |index: usize| state.velocity[index].map(Real::to_f64);
        match self {
            Self::Distance { a, b, .. } => -(velocity(*b) - velocity(*a)).norm_sq(),
            Self::ToPoint { particle, .. } => -velocity(*particle).norm_sq(),
            Self::On { particle, surface, .. } => -surface.no * velocity(*particle).norm_sq(),
            Self::Own(own) => own.curvature(state, scratch),
        }
    }

    /// How far from being held: m. The length that is too much or missing, or the distance to the surface to first
    /// order, `|C| / |dC/dx|`.
    pub(super) fn violation(&self, position: &[Point<f64>], scratch: &mut Scratch) -> f64 {
        let off = |from: Point<f64>, to: Point<f64>, length: f64| (from.distance_sq_to(to).sqrt() - length).abs();
        match self {
            Self::Distance { a, b, length } => off(position[*a], position[*b], *length),
            Self::ToPoint { particle, point, length } => off(position[*particle], *point, *length),
            Self::On { .. } | Self::Own(_) => {
                let mut slope_sq = 0.0;
                self.gradient(position, scratch, |_, gradient| slope_sq += gradient.norm_sq());
                let value = self.value(position, scratch).abs();
                if value == 0.0 { 0.0 } else { value / slope_sq.sqrt() }
            }
        }
    }
}

/// `X . P + d²/2`, with the difference first.
fn to_point(x: Point<f64>, p: Point<f64>, length: f64) -> f64 {
    (x | p) + length * length / 2.0
}

fn relative(x: Point<f64>, anchor: Point<f64>) -> Point<f64> {
    anchor.displacement_to(x).into()
}

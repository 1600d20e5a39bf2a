//! Constraints that are not links: surfaces, which are met exactly, and functions of one's own, by a Newton step.
//!
//! ```text
//! surface   C = X . S, g = s - w x the gradient, w the weight, x from the anchor       x += tau g
//!           C + tau g² - w tau² g²/2 = 0:  tau = -2 C / (g² (1 + sqrt(1 + 2 w C/g²))),  g² + 2 w C = S²
//! own       x_i -= w_i g_i C / sum_j w_j |g_j|²
//! ```
//!
//! XPBD moves one particle along g; on it `X . S` is quadratic, so that the way to 0 is known. It ends at the point of the
//! sphere or plane that is nearest.

use super::{Particles, Xpbd};
use crate::algebra::Real;
use crate::algebra::cga::{Point, Round};
use crate::algebra::g3::Vector;

/// A particle and its surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Held {
    pub(super) particle: u32,
    anchor: Point<f64>,
    /// In the frame that has the anchor as its origin.
    surface: Round<f64>,
    /// `sqrt(S²)`: the length of the normal of a plane, weight times radius of a sphere.
    size: f64,
}

impl Held {
    pub(super) fn to_point(particle: usize, centre: Point<f64>, radius: f64) -> Self {
        let surface = Round { no: 1.0, ninf: -0.5 * radius * radius, ..Round::default() };
        Self { particle: index(particle), anchor: centre, surface, size: radius }
    }

    /// None for what has no points, or no more than one.
    pub(super) fn on(particle: usize, anchor: Point<f64>, surface: Round<f64>) -> Option<Self> {
        let Round { e1, e2, e3, no, ninf } = surface;
        let square = Vector::new(e1, e2, e3).norm_sq() - 2.0 * no * ninf;
        let size = square.sqrt();
        (square > 0.0 && size.is_finite()).then_some(Self { particle: index(particle), anchor, surface, size })
    }

    /// C and g.
    fn value(&self, x: Point<f64>) -> (f64, Vector<f64>) {
        let Round { e1, e2, e3, no, ninf } = self.surface;
        let (s, x) = (Vector::new(e1, e2, e3), self.anchor.displacement_to(x));
        ((s | x) - ninf - 0.5 * no * x.norm_sq(), s - x * no)
    }

    /// What leads to the nearest point of the surface; nothing from the centre of a sphere, which has no nearest.
    fn correction(&self, x: Point<f64>) -> Vector<f64> {
        let (c, g) = self.value(x);
        let slope = g.norm_sq().sqrt();
        if slope > 0.0 { g * (-2.0 * c / (slope * (slope + self.size))) } else { Vector::default() }
    }

    /// The distance from the surface, m, and by the radius.
    pub(super) fn violation(&self, x: Point<f64>) -> (f64, f64) {
        let (c, g) = self.value(x);
        let off = 2.0 * c.abs() / (g.norm_sq().sqrt() + self.size);
        (off, off * self.surface.no.abs() / self.size)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "more particles than 32 bits count are refused")]
fn index(particle: usize) -> u32 {
    particle as u32
}

impl<T: Real> Xpbd<T> {
    /// Corrects all that are not links.
    pub(super) fn hold(&mut self, position: &mut [Point<f64>], inv_mass: &[T]) {
        for held in &self.surfaces {
            let particle = held.particle as usize;
            if inv_mass[particle] != T::zero() {
                position[particle] = position[particle].moved(held.correction(position[particle]));
            }
        }
        for own in &self.own {
            let c = own.value(position, &mut self.scratch);
            self.gradients.clear();
            own.gradient(position, &mut self.scratch, |particle, g| self.gradients.push((particle, g)));
            let weight = |particle: usize| inv_mass[particle].to_f64();
            let response: f64 = self.gradients.iter().map(|(particle, g)| weight(*particle) * g.norm_sq()).sum();
            if response > 0.0 {
                for (particle, g) in &self.gradients {
                    position[*particle] = position[*particle].moved(*g * (-c * weight(*particle) / response));
                }
            }
        }
    }

    /// Of a constraint of one's own, to first order: `|C| / |dC/dx|`, m.
    pub(super) fn own_violations(&mut self, particles: &Particles<T>) -> f64 {
        let mut worst: f64 = 0.0;
        for own in &self.own {
            let c = own.value(&particles.position, &mut self.scratch);
            let mut slope_sq = 0.0;
            own.gradient(&particles.position, &mut self.scratch, |_, g| slope_sq += g.norm_sq());
            if c != 0.0 {
                worst = worst.max(c.abs() / slope_sq.sqrt());
            }
        }
        worst
    }
}

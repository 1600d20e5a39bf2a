//! How far constraints are from being met.

use super::{Particles, Xpbd};
use crate::algebra::Real;
use crate::algebra::cga::Point;

/// The largest violations.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Violation {
    /// Of a length, of a distance to a surface, or of a constraint of one's own (`|C| / |dC/dx|`), m.
    pub absolute_m: f64,
    /// Of a length by the length, or of a distance to a sphere by its radius.
    pub relative: f64,
}

impl Violation {
    /// Infinite for what is no number, so that a state that was lost is never the smaller one.
    fn add(&mut self, absolute_m: f64, relative: f64) {
        let larger = |old: f64, new: f64| if new.is_nan() { f64::INFINITY } else { old.max(new) };
        self.absolute_m = larger(self.absolute_m, absolute_m);
        self.relative = larger(self.relative, relative);
    }
}

impl<T: Real> Xpbd<T> {
    /// The largest violations over all constraints; infinite if a position is no number.
    pub fn max_violation(&mut self, particles: &Particles<T>) -> Violation {
        let mut worst = self.of_links_and_surfaces(&particles.position);
        let own = self.own_violations(particles);
        worst.add(own, 0.0);
        worst
    }

    pub(super) fn exceeds(&self, position: &[Point<f64>], relative: f64) -> bool {
        relative.is_finite() && self.of_links_and_surfaces(position).relative > relative
    }

    fn of_links_and_surfaces(&self, position: &[Point<f64>]) -> Violation {
        let mut worst = Violation::default();
        for (start, link) in
            self.links.parts().flat_map(|(start, part)| part.links.iter().map(move |link| (start, link)))
        {
            let (a, b) = (position[start + link.a as usize], position[start + link.b as usize]);
            let length = link.length_sq.sqrt();
            let off = (a.distance_sq_to(b).sqrt() - length).abs();
            worst.add(off, off / length);
        }
        for held in &self.surfaces {
            let (absolute_m, relative) = held.violation(position[held.particle as usize]);
            worst.add(absolute_m, relative);
        }
        worst
    }
}

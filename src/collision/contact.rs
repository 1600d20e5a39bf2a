//! A contact between two bodies.

use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::{Bivector, Vector};
use crate::rigid::{Bodies, Inertia};

/// Approach speeds below this many epsilons of the speeds at the contact are rounding: a point's velocity is a sum of six
/// products, each off by a few roundings of terms no larger than the speeds.
const APPROACH_EPSILONS: f64 = 16.0;

/// A point at which two bodies touch. Directions and arms are world-oriented; arms are relative to the centres of mass,
/// so that they keep their digits far from the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<T> {
    /// First body.
    pub a: usize,
    /// Second body.
    pub b: usize,
    /// From the centre of mass of `a` to the contact, m.
    pub arm_a: Vector<T>,
    /// From the centre of mass of `b` to the contact, m.
    pub arm_b: Vector<T>,
    /// Unit normal from `a` to `b`.
    pub normal: Vector<T>,
    /// Signed gap along the normal, m; negative on overlap.
    pub separation: T,
}

impl<T: Real> Contact<T> {
    /// The contact in the world, m.
    #[must_use]
    pub fn point(&self, bodies: &Bodies<T>) -> Point<f64> {
        let (body_idx, arm) =
            if self.arm_a.norm_sq() <= self.arm_b.norm_sq() { (self.a, self.arm_a) } else { (self.b, self.arm_b) };
        bodies.position[body_idx].moved(arm.map(Real::to_f64))
    }

    /// The rounding of the approach speed, m/s: slower than this, bodies are not told from such as part.
    #[must_use]
    pub fn speed_rounding(&self, bodies: &Bodies<T>, inertias: &[Inertia<T>]) -> T {
        let speed = |body_idx: usize, arm: Vector<T>| {
            let inertia = &inertias[body_idx];
            let spin = bodies.omega_body(body_idx, inertia).norm_sq() * arm.norm_sq();
            bodies.velocity(body_idx, inertia).norm_sq().sqrt() + spin.sqrt()
        };
        T::from_f64(APPROACH_EPSILONS) * T::EPSILON * (speed(self.a, self.arm_a) + speed(self.b, self.arm_b))
    }

    /// Do the bodies approach here, by more than rounding?
    #[must_use]
    pub fn approaches(&self, bodies: &Bodies<T>, inertias: &[Inertia<T>]) -> bool {
        self.approach_speed(bodies, inertias) > self.speed_rounding(bodies, inertias)
    }

    /// The same contact with its longer arm taken anew from where the bodies are: both arms then end in one point, and an
    /// impulse leaves the angular momentum as it is. The shorter arm has kept more digits: a plane's may be long.
    #[must_use]
    pub fn anchored(self, bodies: &Bodies<T>) -> Self {
        let between = bodies.position[self.a].displacement_to(bodies.position[self.b]).map(T::from_f64);
        if self.arm_a.norm_sq() <= self.arm_b.norm_sq() {
            Self { arm_b: self.arm_a - between, ..self }
        } else {
            Self { arm_a: self.arm_b + between, ..self }
        }
    }

    /// `n . (v_a - v_b)` at the contact, m/s: positive when the bodies approach.
    #[must_use]
    pub fn approach_speed(&self, bodies: &Bodies<T>, inertias: &[Inertia<T>]) -> T {
        let at = |body_idx: usize, arm: Vector<T>| {
            let inertia = &inertias[body_idx];
            let omega: Bivector<T> = bodies.omega_world(body_idx, inertia);
            // v = x . Omega
            bodies.velocity(body_idx, inertia) + (arm | omega)
        };
        self.normal | (at(self.a, self.arm_a) - at(self.b, self.arm_b))
    }
}

//! Free flight: bodies under uniform gravity alone, whose motion is known in closed form.
//!
//! ```text
//! x = x0 + v0 t + g t²/2     p = p0 + m g t     L = L0     R: the exact free motion
//! ```
//!
//! No steps: a state is computed from the one at the start, or after the last impact, however long ago that was, and errs no
//! more than that of the first second.

use super::free::FreeMotion;
use super::stepping::Advance;
use super::{Bodies, MotionError, System};
use crate::algebra::Real;
use crate::algebra::g3::Vector;
use crate::ode::{OdeError, State, Work};
use alloc::vec::Vec;

/// Where the bodies started from, and the ends of the last span: a caller goes on from one of these, or has changed something.
struct Anchor<T> {
    start: Bodies<T>,
    motions: Vec<FreeMotion>,
    before: (f64, Bodies<T>),
    after: (f64, Bodies<T>),
}

impl<T: Real> Anchor<T> {
    fn new(system: &System<T>, bodies: &Bodies<T>) -> Self {
        let inertias = system.setup.inertias.iter().enumerate();
        let motion = |(index, inertia): (usize, &_)| {
            FreeMotion::new(inertia, bodies.rotor[index], bodies.angular_momentum[index])
        };
        let motions = inertias.map(motion).collect();
        Self { start: bodies.clone(), motions, before: (0.0, bodies.clone()), after: (0.0, bodies.clone()) }
    }

    /// How long after the start a state is; none if it is not one of those known.
    fn elapsed_s(&self, bodies: &Bodies<T>) -> Option<f64> {
        [&self.after, &self.before].into_iter().find(|(_, known)| known == bodies).map(|(elapsed_s, _)| *elapsed_s)
    }
}

/// The exact motion of bodies that nothing but uniform gravity acts on.
pub(super) struct Flight<T> {
    anchor: Option<Anchor<T>>,
    work: Work,
}

impl<T: Real> Flight<T> {
    pub(super) fn new() -> Self {
        Self { anchor: None, work: Work::default() }
    }
}

impl<T: Real> Advance<T> for Flight<T> {
    fn advance(
        &mut self,
        system: &mut System<T>,
        bodies: &mut Bodies<T>,
        _t_s: f64,
        span_s: f64,
    ) -> Result<(), OdeError<MotionError>> {
        let known = self.anchor.take().and_then(|anchor| anchor.elapsed_s(bodies).map(|elapsed_s| (anchor, elapsed_s)));
        let (mut anchor, from_s) = known.unwrap_or_else(|| (Anchor::new(system, bodies), 0.0));
        let elapsed_s = from_s + span_s;
        anchor.before.0 = from_s;
        anchor.before.1.assign(bodies);
        fly(system, &anchor, elapsed_s, bodies);
        anchor.after.0 = elapsed_s;
        anchor.after.1.assign(bodies);
        self.anchor = Some(anchor);
        self.work.rhs_evals += 1;
        self.work.accepted += 1;
        Ok(())
    }

    fn work(&self) -> Work {
        self.work
    }
}

fn fly<T: Real>(system: &System<T>, anchor: &Anchor<T>, t_s: f64, bodies: &mut Bodies<T>) {
    let gravity = system.setup.forces.gravity.map(Real::to_f64);
    let start = &anchor.start;
    for (index, inertia) in system.setup.inertias.iter().enumerate().filter(|(_, inertia)| !inertia.is_immovable()) {
        let (mass, inv_mass) = (inertia.mass.to_f64(), inertia.inv_mass.to_f64());
        let momentum: Vector<f64> = start.momentum[index].map(Real::to_f64);
        let moved = momentum * (inv_mass * t_s) + gravity * (0.5 * t_s * t_s);
        bodies.position[index] = start.position[index].moved(moved);
        bodies.momentum[index] = (momentum + gravity * (mass * t_s)).map(T::from_f64);
        bodies.rotor[index] = anchor.motions[index].at(t_s);
    }
}

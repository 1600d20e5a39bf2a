//! All bodies, and the step that takes them past their collisions.

use super::{Event, EventKind};
use crate::algebra::Real;
use crate::collision::{self, Collider, Contact, NarrowPhase, Reach, Scenery};
use crate::ode::{OdeError, State};
use crate::particle;
use crate::rigid::{Bodies, Motion, MotionError, Totals};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use thiserror::Error;

/// The time of an impact is found to this fraction of the step. Bodies that close at v then overlap by at most
/// `v dt 1e-11`, around the rounding of f64 coordinates; a coarser one would show in the energy, a finer one nowhere.
const IMPACT_WIDTH: f64 = 1e-11;

/// Bodies stay in contact when this many impacts of theirs in a row came without their having got apart in between, by
/// more than what counts as touching: `speed * time since the last < slack`. Such bounces are made of rounding. One more
/// than a few can be chance; a sequence that goes on is the end of all sequences with a restitution below 1.
const PERSISTING_IMPACTS: usize = 64;

/// Why a run ends early.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SimulationError {
    /// The particles cannot go on.
    #[error(transparent)]
    Particles(#[from] OdeError<particle::MotionError>),
    /// The bodies cannot go on.
    #[error(transparent)]
    Bodies(#[from] OdeError<MotionError>),
    /// A momentum or position left the range of the numbers.
    #[error("the motion of body {body_idx} left the range of the numbers at {time_s} s")]
    OutOfRange {
        /// Which body.
        body_idx: usize,
        /// When.
        time_s: f64,
    },
    /// Bounces without end. Resting contact is not modelled.
    #[error("bodies {a} and {b} stay in contact from {time_s} s on")]
    StaysInContact {
        /// First body.
        a: usize,
        /// Second body.
        b: usize,
        /// When.
        time_s: f64,
    },
}

/// What a simulation of bodies is made of, beside their motion.
#[derive(Clone, Debug, Default)]
pub struct Setup<T> {
    /// The state at the start.
    pub bodies: Bodies<T>,
    /// Shapes for collisions, one entry a body.
    pub colliders: Vec<Collider<T>>,
    /// Restitution of every impact.
    pub restitution: T,
}

/// A running simulation.
pub struct World<T: Real> {
    setup: Setup<T>,
    motion: Motion<T>,
    /// Bodies and particles do not act on each other.
    particles: Option<particle::Motion<T>>,
    trial: Bodies<T>,
    narrow_phase: NarrowPhase<T>,
    /// Pairs that could collide: both have a shape, one of them moves, and no joint holds them together.
    pairs: Vec<(usize, usize)>,
    contacts: Vec<Contact<T>>,
    /// For each pair: when it last struck, and how many times in a row without getting apart in between.
    impacts: BTreeMap<(usize, usize), (f64, usize)>,
    time_s: f64,
}

impl<T: Real> World<T> {
    /// A simulation at time 0. `motion` is that of the bodies of the setup.
    #[must_use]
    pub fn new(setup: Setup<T>, motion: Motion<T>) -> Self {
        let shaped = |index: &usize| !matches!(setup.colliders[*index], Collider::None);
        let moves = |index: usize| !motion.inertias()[index].is_immovable();
        let indices: Vec<usize> = (0..setup.bodies.len()).filter(shaped).collect();
        let pairs = indices.iter().flat_map(|a| indices.iter().map(move |b| (*a, *b)));
        let pairs = pairs.filter(|(a, b)| a < b && (moves(*a) || moves(*b)) && !joined(&motion, *a, *b)).collect();
        Self {
            particles: None,
            trial: setup.bodies.clone(),
            narrow_phase: NarrowPhase::default(),
            pairs,
            contacts: Vec::new(),
            impacts: BTreeMap::new(),
            time_s: 0.0,
            motion,
            setup,
        }
    }

    /// The same with particles, which start at time 0 as well.
    #[must_use]
    pub fn with_particles(self, particles: particle::Motion<T>) -> Self {
        Self { particles: Some(particles), ..self }
    }

    /// The time, s.
    #[must_use]
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// The particles, if there are any.
    #[must_use]
    pub fn particles(&self) -> Option<&particle::Motion<T>> {
        self.particles.as_ref()
    }

    /// The worst violation of a constraint, m; none without constraints.
    pub fn worst_violation(&mut self) -> Option<f64> {
        let of_particles = self.particles.as_mut().and_then(|particles| Some(particles.worst_violation()?.1));
        let of_joints = self.motion.worst_violation(&self.setup.bodies);
        [of_particles, of_joints].into_iter().flatten().reduce(f64::max)
    }

    /// The state.
    #[must_use]
    pub fn bodies(&self) -> &Bodies<T> {
        &self.setup.bodies
    }

    /// How they move: masses, forces, joints, and what it has cost, the search for impacts included.
    #[must_use]
    pub fn motion(&self) -> &Motion<T> {
        &self.motion
    }

    /// Energy and momenta.
    #[must_use]
    pub fn totals(&self) -> Totals {
        let mut sums = self.motion.totals(&self.setup.bodies);
        sums += self.particles.as_ref().map(particle::Motion::totals).unwrap_or_default();
        sums
    }

    /// The pairs that overlap in the state as it is, and how deep, m: for a scene at its start, there must be none.
    pub fn overlaps(&mut self) -> Vec<(usize, usize, T)> {
        let Setup { bodies, colliders, .. } = &self.setup;
        let all = Scenery { bodies, inertias: self.motion.inertias(), colliders };
        let found = self.pairs.iter().filter_map(|pair| Some((pair.0, pair.1, self.narrow_phase.overlap(all, *pair)?)));
        found.collect()
    }

    /// The contacts of the trial state.
    fn detect(&mut self, reach: Reach) {
        let inertias = self.motion.inertias();
        let all = Scenery { bodies: &self.trial, inertias, colliders: &self.setup.colliders };
        self.contacts.clear();
        for pair in &self.pairs {
            self.narrow_phase.contacts(all, *pair, reach, &mut self.contacts);
        }
    }

    /// Do bodies collide in the trial state? Those that overlap by no more than touching, and part already, do not: they
    /// are on their way out of the last impact.
    fn collides(&mut self) -> bool {
        self.detect(Reach::Overlapping);
        let inertias = self.motion.inertias();
        let all = Scenery { bodies: &self.trial, inertias, colliders: &self.setup.colliders };
        let collides = |contact: &Contact<T>| {
            -contact.separation > all.slack(contact.a, contact.b) || contact.approaches(all.bodies, inertias)
        };
        self.contacts.iter().any(collides)
    }

    /// Advances the trial state from the good one.
    fn try_advance(&mut self, dt_s: f64) -> Result<(), OdeError<MotionError>> {
        self.trial.assign(&self.setup.bodies);
        self.motion.advance(&mut self.trial, self.time_s, dt_s)
    }

    fn accept(&mut self, time_s: f64) {
        core::mem::swap(&mut self.setup.bodies, &mut self.trial);
        self.time_s = time_s;
    }

    /// Advances to a time, past all collisions on the way; what happened is appended to `events`.
    ///
    /// # Errors
    /// Contact that persists, motion that cannot be continued. The state is then the last good one.
    pub fn advance_to(&mut self, end_s: f64, events: &mut Vec<Event>) -> Result<(), SimulationError> {
        let Some(particles) = &mut self.particles else {
            return self.advance_bodies_to(end_s, events);
        };
        let moved = particles.advance_to(end_s);
        let reached_s = particles.time_s().min(end_s).max(self.time_s);
        if reached_s > self.time_s {
            self.advance_bodies_to(reached_s, events)?;
        }
        Ok(moved?)
    }

    fn advance_bodies_to(&mut self, end_s: f64, events: &mut Vec<Event>) -> Result<(), SimulationError> {
        let step_s = end_s - self.time_s;
        loop {
            let rest_s = end_s - self.time_s;
            self.try_advance(rest_s)?;
            self.check_range(end_s)?;
            if !self.collides() {
                self.accept(end_s);
                return Ok(());
            }
            self.impact(rest_s, IMPACT_WIDTH * step_s / rest_s, events)?;
        }
    }

    /// No state that is not finite may become the good one.
    fn check_range(&self, time_s: f64) -> Result<(), SimulationError> {
        let (bodies, inertias) = (&self.trial, self.motion.inertias());
        // Squares, because energies are made of them.
        let finite = |body_idx: usize| {
            let inertia = &inertias[body_idx];
            let squares = bodies.velocity(body_idx, inertia).norm_sq()
                + bodies.momentum[body_idx].norm_sq()
                + bodies.angular_momentum[body_idx].norm_sq()
                + bodies.omega_body(body_idx, inertia).norm_sq();
            let orientation: [T; 4] = bodies.rotor[body_idx].into();
            bodies.position[body_idx].position().norm_sq().is_finite()
                && squares.is_finite()
                && orientation.iter().all(|x| x.is_finite())
        };
        match (0..bodies.len()).find(|body_idx| !finite(*body_idx)) {
            Some(body_idx) => Err(SimulationError::OutOfRange { body_idx, time_s }),
            None => Ok(()),
        }
    }

    /// Takes note of an impact, contacts with their approach speeds; fails if its pair does not get apart any more.
    fn refuse_persisting(
        &mut self,
        approaches: &[(usize, usize, T)],
        events: &mut Vec<Event>,
    ) -> Result<(), SimulationError> {
        for (a, b, speed) in approaches {
            let all =
                Scenery { bodies: &self.trial, inertias: self.motion.inertias(), colliders: &self.setup.colliders };
            let slack = all.slack(*a, *b).to_f64();
            let (last_s, count) = self.impacts.entry((*a, *b)).or_insert((f64::NEG_INFINITY, 0));
            let apart = speed.to_f64() * (self.time_s - *last_s) >= slack;
            (*last_s, *count) = (self.time_s, if apart { 0 } else { *count + 1 });
            if *count >= PERSISTING_IMPACTS {
                self.note_persisting(*a, *b, events);
                return Err(SimulationError::StaysInContact { a: *a, b: *b, time_s: self.time_s });
            }
        }
        Ok(())
    }

    fn note_persisting(&self, a: usize, b: usize, events: &mut Vec<Event>) {
        let contact = self.contacts.iter().find(|contact| (contact.a, contact.b) == (a, b));
        events.extend(contact.map(|contact| {
            Event::new(self.time_s, EventKind::ContactPersists, contact, &self.setup.bodies, T::zero())
        }));
    }

    /// Goes to the first impact within the span and applies its impulses.
    fn impact(&mut self, span_s: f64, width: f64, events: &mut Vec<Event>) -> Result<(), SimulationError> {
        let bracket = collision::first_overlap(width.min(1.0), |fraction| {
            self.try_advance(fraction * span_s)?;
            Ok::<bool, OdeError<MotionError>>(self.collides())
        })?;
        // Features are read where the bodies overlap, impulses applied where they are still apart. If nothing approaches
        // there yet by more than rounding, the bodies go on to where it does.
        self.try_advance(bracket.overlapping * span_s)?;
        self.detect(Reach::Simultaneous);
        self.try_advance(bracket.separated * span_s)?;
        let apart = self.contacts.iter().map(|contact| contact.anchored(&self.trial));
        let apart_approaches = apart.clone().any(|contact| contact.approaches(&self.trial, self.motion.inertias()));
        if apart_approaches {
            self.contacts = apart.collect();
            self.accept(self.time_s + bracket.separated * span_s);
        } else {
            self.try_advance(bracket.overlapping * span_s)?;
            self.accept(self.time_s + bracket.overlapping * span_s);
        }
        let approaches = self.approaches();
        let Setup { bodies, restitution, .. } = &mut self.setup;
        let impulses = if self.motion.setup().joints.is_empty() {
            collision::resolve(&self.contacts, bodies, self.motion.inertias(), *restitution)
        } else {
            collision::resolve_jointed(&self.contacts, bodies, &mut self.motion, *restitution, self.time_s)
                .map_err(OdeError::System)?
        };
        let bodies = &self.setup.bodies;
        let impact = |impulse: &collision::Impulse<T>| {
            Event::new(self.time_s, EventKind::Impact, &impulse.contact, bodies, impulse.magnitude)
        };
        events.extend(impulses.iter().map(impact));
        self.refuse_persisting(&approaches, events)
    }

    /// The pairs in contact, each once, with the fastest approach at any of their contacts.
    fn approaches(&self) -> Vec<(usize, usize, T)> {
        let (bodies, inertias) = (&self.setup.bodies, self.motion.inertias());
        let mut fastest: BTreeMap<(usize, usize), T> = BTreeMap::new();
        for contact in &self.contacts {
            let speed = contact.approach_speed(bodies, inertias);
            let known = fastest.entry((contact.a, contact.b)).or_insert(T::zero());
            *known = known.max(speed);
        }
        // Where none approaches, all are to blame: an impact that leads nowhere must count, or it would come for ever.
        let any = fastest.values().any(|speed| *speed > T::zero());
        fastest
            .into_iter()
            .filter(|(_, speed)| !any || *speed > T::zero())
            .map(|((a, b), speed)| (a, b, speed))
            .collect()
    }
}

/// Whether a joint holds two bodies together: they overlap where it is, and do not collide.
fn joined<T: Real>(motion: &Motion<T>, a: usize, b: usize) -> bool {
    let joins = |[first, second]: [Option<usize>; 2]| [(first, second), (second, first)].contains(&(Some(a), Some(b)));
    motion.setup().joints.iter().any(|joint| joins(joint.bodies()))
}

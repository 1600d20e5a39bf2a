//! All bodies, and the step that takes them past their collisions.

use super::{Event, EventKind};
use crate::algebra::Real;
use crate::collision::{self, Collider, Contact, NarrowPhase, Reach};
use crate::rigid::rotor::{AdvanceError, Integrator};
use crate::rigid::{Bodies, Forces, Inertia, Totals, totals};
use alloc::vec::Vec;
use thiserror::Error;

/// The time of an impact is found to this fraction of the step. Bodies that close at v then overlap by at most
/// `v dt 1e-11`, around the rounding of f64 coordinates; a coarser one would show in the energy, a finer one nowhere.
const IMPACT_WIDTH: f64 = 1e-11;

/// More impacts than this within one step are a sequence that does not end: each takes a fixed share of what is left
/// of the sequence's time, at a restitution of 0.98 the thousandth all but 2e-9 of it.
const MAX_IMPACTS_PER_STEP: usize = 1000;

/// Why a run ends early.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum SimulationError {
    /// The motion cannot be continued.
    #[error(transparent)]
    Advance(#[from] AdvanceError),
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

/// What a simulation is made of. Every list has one entry a body.
#[derive(Clone, Debug)]
pub struct Setup<T> {
    /// The state at the start.
    pub bodies: Bodies<T>,
    /// Masses and inertias.
    pub inertias: Vec<Inertia<T>>,
    /// Shapes for collisions.
    pub colliders: Vec<Collider<T>>,
    /// Gravity and other forces.
    pub forces: Forces<T>,
    /// Restitution of every impact.
    pub restitution: T,
}

/// A running simulation.
#[derive(Clone, Debug)]
pub struct World<T: Real> {
    setup: Setup<T>,
    trial: Bodies<T>,
    integrator: Integrator<T>,
    narrow_phase: NarrowPhase<T>,
    /// Pairs that could collide: both have a shape, and one of them moves.
    pairs: Vec<(usize, usize)>,
    contacts: Vec<Contact<T>>,
    time_s: f64,
    substeps: u64,
}

impl<T: Real> World<T> {
    /// A simulation at time 0.
    #[must_use]
    pub fn new(setup: Setup<T>) -> Self {
        let shaped = |index: &usize| !matches!(setup.colliders[*index], Collider::None);
        let moves = |index: usize| setup.inertias[index].inv_mass > T::zero();
        let indices: Vec<usize> = (0..setup.bodies.len()).filter(shaped).collect();
        let pairs = indices.iter().flat_map(|a| indices.iter().map(move |b| (*a, *b)));
        let pairs = pairs.filter(|(a, b)| a < b && (moves(*a) || moves(*b))).collect();
        Self {
            trial: setup.bodies.clone(),
            integrator: Integrator::new(&setup.bodies),
            narrow_phase: NarrowPhase::default(),
            pairs,
            contacts: Vec::new(),
            time_s: 0.0,
            substeps: 0,
            setup,
        }
    }

    /// The time, s.
    #[must_use]
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// The state.
    #[must_use]
    pub fn bodies(&self) -> &Bodies<T> {
        &self.setup.bodies
    }

    /// Masses and inertias.
    #[must_use]
    pub fn inertias(&self) -> &[Inertia<T>] {
        &self.setup.inertias
    }

    /// The substeps of the integrator so far, those of the search for impacts included.
    #[must_use]
    pub fn substeps(&self) -> u64 {
        self.substeps
    }

    /// Energy and momenta.
    #[must_use]
    pub fn totals(&self) -> Totals {
        totals(&self.setup.bodies, &self.setup.inertias, self.setup.forces.gravity)
    }

    /// The contacts of the state as it is: for a scene at its start, there must be none.
    pub fn overlaps(&mut self) -> &[Contact<T>] {
        self.trial.clone_from(&self.setup.bodies);
        self.detect(Reach::Overlapping);
        &self.contacts
    }

    /// Contacts of the trial state.
    fn detect(&mut self, reach: Reach) -> bool {
        self.contacts.clear();
        for (a, b) in &self.pairs {
            self.narrow_phase.contacts(&self.trial, &self.setup.colliders, *a, *b, reach, &mut self.contacts);
        }
        !self.contacts.is_empty()
    }

    /// Advances the trial state from the good one.
    fn try_advance(&mut self, dt_s: f64) -> Result<(), AdvanceError> {
        self.trial.clone_from(&self.setup.bodies);
        let Setup { inertias, forces, .. } = &self.setup;
        let substeps = self.integrator.advance(&mut self.trial, inertias, forces, self.time_s, dt_s)?;
        self.substeps += substeps as u64;
        Ok(())
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
        let step_s = end_s - self.time_s;
        for _ in 0..MAX_IMPACTS_PER_STEP {
            let rest_s = end_s - self.time_s;
            self.try_advance(rest_s)?;
            if !self.detect(Reach::Overlapping) {
                self.accept(end_s);
                return Ok(());
            }
            if !self.impact(rest_s, IMPACT_WIDTH * step_s / rest_s, events)? {
                break;
            }
        }
        Err(self.persisting_contact(events))
    }

    /// Goes to the first impact within the span and applies its impulses; says whether there were any.
    fn impact(&mut self, span_s: f64, width: f64, events: &mut Vec<Event>) -> Result<bool, SimulationError> {
        let bracket = collision::first_overlap(width.min(1.0), |fraction| {
            self.try_advance(fraction * span_s)?;
            Ok::<bool, AdvanceError>(self.detect(Reach::Overlapping))
        })?;
        // Features are read where the bodies overlap, impulses applied where they are still apart.
        self.try_advance(bracket.overlapping * span_s)?;
        self.detect(Reach::Simultaneous);
        self.try_advance(bracket.separated * span_s)?;
        self.accept(self.time_s + bracket.separated * span_s);
        let Setup { bodies, inertias, restitution, .. } = &mut self.setup;
        self.contacts.iter_mut().for_each(|contact| *contact = contact.anchored(bodies));
        let impulses = collision::resolve(&self.contacts, bodies, inertias, *restitution);
        let bodies = &self.setup.bodies;
        let impact = |impulse: &collision::Impulse<T>| {
            Event::new(self.time_s, EventKind::Impact, &impulse.contact, bodies, impulse.magnitude)
        };
        events.extend(impulses.iter().map(impact));
        Ok(!impulses.is_empty())
    }

    fn persisting_contact(&self, events: &mut Vec<Event>) -> SimulationError {
        let (mut a, mut b) = (0, 0);
        if let Some(contact) = self.contacts.first() {
            (a, b) = (contact.a, contact.b);
            events.push(Event::new(self.time_s, EventKind::ContactPersists, contact, &self.setup.bodies, T::zero()));
        }
        SimulationError::StaysInContact { a, b, time_s: self.time_s }
    }
}

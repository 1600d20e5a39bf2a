//! The equations of motion of particles under forces and constraints, for every stepper.
//!
//! ```text
//! vdot = a + W Jᵀ lambda,   J W Jᵀ lambda = -Jdot v - J a        (report, 24), W = 1/m
//! ```
//!
//! Baumgarte's method adds `-2 k dC/dt - k² C` on the right. Projection takes positions and velocities back onto the
//! constraints after each step. Verlet's method becomes RATTLE (Andersen 1983): its drift holds `C = 0` by multipliers along
//! the gradients at its start.

use super::check::check;
use super::fast::Fast;
use super::held::Held;
use super::own::Scratch;
use super::{Constraint, Force, Masses, Method, Particles, Rates, SetupError, Solver, Stabilisation, Totals, totals};
use crate::algebra::Real;
use crate::algebra::g3::Vector;
use crate::constraint::{ProjectionError, SolveError};
use crate::ode::{self, State};
use alloc::vec::Vec;
use thiserror::Error;

/// Why the motion cannot go on. Rows are indices of constraints.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum MotionError {
    /// The constraint forces cannot be found.
    #[error("at {time_s} s: {source}")]
    Multipliers {
        /// When.
        time_s: f64,
        /// Why.
        source: SolveError,
    },
    /// The particles cannot be brought back onto their constraints.
    #[error("at {time_s} s: {source}")]
    Projection {
        /// When.
        time_s: f64,
        /// Why.
        source: ProjectionError,
    },
}

/// A drift in which links turn too far for forces along their directions at its start is made in twice as many parts, up to
/// this many. Then it goes on along later directions, which loses energy: shorter parts would hardly lose less, and a net
/// that snaps taut would take minutes a second.
const MAX_PARTS: u32 = 4;

/// What particles are subject to.
#[derive(Clone, Debug, Default)]
pub struct Setup<T> {
    /// Masses; fixed particles have an inverse mass of 0.
    pub masses: Masses<T>,
    /// Forces.
    pub forces: Vec<Force<T>>,
    /// Constraints.
    pub constraints: Vec<Constraint>,
}

/// Particles, forces and constraints as a right-hand side.
#[derive(Clone, Debug)]
pub struct System<T: Real> {
    pub(super) setup: Setup<T>,
    pub(super) held: Held,
    pub(super) fast: Option<Fast<T>>,
    pub(super) acceleration: Vec<Vector<T>>,
    stabilisation: Stabilisation,
    /// The start of a drift.
    before: Particles<T>,
    redirected: u64,
    scratch: Scratch,
}

impl<T: Real> System<T> {
    /// The system of a setup, solved as said.
    ///
    /// # Errors
    /// Particles, forces or constraints that are not sound.
    pub fn new(setup: Setup<T>, start: &Particles<T>, solver: &Solver) -> Result<Self, SetupError> {
        check(&setup, start)?;
        let fast = (solver.method == Method::Xpbd).then(|| Fast::new(&setup, start, solver)).transpose()?;
        Ok(Self {
            held: Held::new(&setup, start, solver),
            fast,
            acceleration: Vec::new(),
            stabilisation: solver.stabilisation,
            before: start.clone(),
            redirected: 0,
            scratch: Scratch::default(),
            setup,
        })
    }

    /// Masses, forces, constraints.
    #[must_use]
    pub fn setup(&self) -> &Setup<T> {
        &self.setup
    }

    /// The most constraints that were found redundant at a time; their multipliers are 0.
    #[must_use]
    pub fn redundant(&self) -> usize {
        self.held.redundant()
    }

    /// Substeps a step of XPBD; none for other methods.
    #[must_use]
    pub fn substeps(&self) -> Option<usize> {
        self.fast.as_ref().map(|fast| fast.substeps)
    }

    /// The violation that was asked for, m.
    #[must_use]
    pub fn asked_violation_m(&self) -> f64 {
        self.held.violation_m()
    }

    /// Steps of Verlet's method, and of compositions of it, in which links turned too far for RATTLE: they went on along the
    /// links' later directions, which loses energy, but holds.
    #[must_use]
    pub fn redirected(&self) -> u64 {
        self.redirected
    }

    /// The worst violation of a constraint, m, and which; none without constraints.
    pub fn worst_violation(&mut self, state: &Particles<T>) -> Option<(usize, f64)> {
        let Self { setup, scratch, .. } = self;
        let violations = setup.constraints.iter().map(|constraint| constraint.violation(&state.position, scratch));
        violations.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Energy and momenta.
    #[must_use]
    pub fn totals(&self, state: &Particles<T>) -> Totals {
        totals(state, &self.setup.masses, &self.setup.forces)
    }

    /// Accelerations by forces alone.
    pub(super) fn free(&mut self, t_s: f64, state: &Particles<T>, acceleration: &mut [Vector<T>]) {
        acceleration.fill(Vector::default());
        for force in &self.setup.forces {
            force.accelerate(t_s, state, &self.setup.masses, acceleration, &mut self.scratch);
        }
        for (acceleration, inv_mass) in acceleration.iter_mut().zip(&self.setup.masses.inv_mass) {
            if *inv_mass == T::zero() {
                *acceleration = Vector::default();
            }
        }
    }
}

impl<T: Real> ode::System<Particles<T>, T> for System<T> {
    type Error = MotionError;

    fn rate(&mut self, t_s: f64, state: &Particles<T>, rate: &mut Rates<T>) -> Result<(), MotionError> {
        rate.velocity.copy_from_slice(&state.velocity);
        self.free(t_s, state, &mut rate.acceleration);
        if self.held.is_empty() {
            return Ok(());
        }
        let baumgarte = match self.stabilisation {
            Stabilisation::Baumgarte { rate } => rate,
            Stabilisation::None | Stabilisation::Projection => 0.0,
        };
        match self.held.constrain(&self.setup.constraints, state, &mut rate.acceleration, baumgarte) {
            Ok(()) => Ok(()),
            // A trial that left the range of the numbers: the stepper takes a shorter one, or says so.
            Err(SolveError::NotFinite { .. }) => {
                rate.acceleration.fill(Vector::from([T::zero() / T::zero(); 3]));
                Ok(())
            }
            Err(source) => Err(MotionError::Multipliers { time_s: t_s, source }),
        }
    }

    fn settle(&mut self, t_s: f64, state: &mut Particles<T>) -> Result<bool, MotionError> {
        if self.held.is_empty() || self.stabilisation != Stabilisation::Projection {
            return Ok(false);
        }
        let projected = self.held.project(&self.setup.constraints, state);
        projected.map_err(|source| MotionError::Projection { time_s: t_s, source })?;
        Ok(true)
    }
}

impl<T: Real> ode::Mechanics<Particles<T>, T> for System<T> {
    type Error = MotionError;
    type Acceleration = Vec<Vector<T>>;

    fn acceleration(&mut self, t_s: f64, state: &Particles<T>, out: &mut Vec<Vector<T>>) -> Result<(), MotionError> {
        self.free(t_s, state, out);
        Ok(())
    }

    fn kick(&mut self, state: &mut Particles<T>, h_s: T, acceleration: &Vec<Vector<T>>) {
        for (velocity, acceleration) in state.velocity.iter_mut().zip(acceleration) {
            *velocity += *acceleration * h_s;
        }
    }

    fn drift(&mut self, t_s: f64, state: &mut Particles<T>, h_s: T) -> Result<(), MotionError> {
        if self.held.is_empty() {
            move_by(state, h_s);
            return Ok(());
        }
        self.before.assign(state);
        let mut parts = 1_u32;
        loop {
            let part_s = h_s.to_f64() / f64::from(parts);
            let (held, constraints) = (&mut self.held, &self.setup.constraints);
            let mut straight = true;
            let done = (0..parts).try_for_each(|_| {
                // Nothing is gained by what follows a part that will be made again.
                if straight || parts == MAX_PARTS {
                    straight &= held.shake(constraints, state, part_s)?;
                }
                Ok(())
            });
            if parts == MAX_PARTS || (straight && done.is_ok()) {
                self.redirected += u64::from(!straight);
                return done.map_err(|source| MotionError::Projection { time_s: t_s, source });
            }
            parts *= 2;
            state.assign(&self.before);
        }
    }

    fn settle(&mut self, t_s: f64, state: &mut Particles<T>, _h_s: T) -> Result<(), MotionError> {
        if self.held.is_empty() {
            return Ok(());
        }
        let projected = self.held.project_velocities(&self.setup.constraints, state);
        projected.map_err(|source| MotionError::Multipliers { time_s: t_s, source })
    }
}

/// `x += h v`
pub(super) fn move_by<T: Real>(state: &mut Particles<T>, h_s: T) {
    for (position, velocity) in state.position.iter_mut().zip(&state.velocity) {
        *position = position.moved((*velocity * h_s).map(Real::to_f64));
    }
}

//! The equations of motion of bodies under forces and joints, for every formulation and stepper.
//!
//! Runge-Kutta methods see them as rates. Compositions see kicks, `p += h F, L += h tau`, and between them drifts, the free
//! motion of all bodies: exact, or split into rotations about the principal axes.

use super::{
    Bodies, Force, Forces, Formulation, Held, Inertia, Joint, JointError, MotionError, Solver, SolverError, Wrenches,
    axis_splitting, free, joint,
};
use crate::algebra::Real;
use crate::algebra::g3::{Bivector, Rotor, Vector};
use crate::constraint::SolveError;
use crate::ode::{self, State};
use alloc::vec;
use alloc::vec::Vec;

/// A drift in which joints turn too far for impulses along their directions at its start is made in twice as many parts, up
/// to this many; then it goes on along later directions. As for particles.
const MAX_PARTS: u32 = 4;

/// What bodies are subject to.
#[derive(Clone, Debug, Default)]
pub struct Setup<T> {
    /// One entry a body.
    pub inertias: Vec<Inertia<T>>,
    /// Gravity and other forces.
    pub forces: Forces<T>,
    /// Joints.
    pub joints: Vec<Joint<T>>,
}

impl<T: Real> Setup<T> {
    /// Whether there are the bodies that forces, joints and lists of bodies name, and forces are numbers.
    pub(super) fn check(&self, bodies: usize, mut listed: impl Iterator<Item = usize>) -> Result<(), SolverError> {
        let inertias = self.inertias.len();
        if bodies != inertias {
            return Err(JointError::Sizes { bodies, inertias }.into());
        }
        let movable: Vec<bool> = self.inertias.iter().map(|inertia| !inertia.is_immovable()).collect();
        self.joints.iter().enumerate().try_for_each(|(index, joint)| joint::check(index, joint, &movable))?;
        let missing = |body_idx: &usize| *body_idx >= bodies;
        let mut forced = self.forces.forces.iter().flat_map(Force::bodies).flatten();
        if let Some(body_idx) = forced.find(missing).or_else(|| listed.find(missing)) {
            return Err(SolverError::NoSuchBody { body_idx, bodies });
        }
        match self.forces.forces.iter().position(|force| !force.is_finite()) {
            Some(force) => Err(SolverError::ForceNotFinite { force }),
            None => Ok(()),
        }
    }

    /// The index among all joints of one of those that some bodies have, which are solved alike.
    pub(super) fn joint_of(&self, bodies: &[usize], own: usize) -> usize {
        let movable = |body_idx: &usize| !self.inertias[*body_idx].is_immovable();
        let is_own = |joint: &Joint<T>| {
            joint.bodies().into_iter().flatten().filter(movable).any(|body_idx| bodies.contains(&body_idx))
        };
        let all = self.joints.iter().enumerate().filter(|(_, joint)| is_own(joint));
        all.map(|(index, _)| index).nth(own).unwrap_or(own)
    }

    /// What some of the bodies are subject to: the others are immovable, and have no forces and joints.
    pub(super) fn of(&self, own: &[usize]) -> Result<Self, SolverError> {
        if own.len() == self.inertias.len() {
            return Ok(self.clone());
        }
        let mut setup = Self { inertias: vec![Inertia::immovable(); self.inertias.len()], ..Self::default() };
        for body_idx in own {
            setup.inertias[*body_idx] = self.inertias[*body_idx];
        }
        setup.forces.gravity = self.forces.gravity;
        // What has all its ends among other bodies is left out; an end in a fixed body is one of the world.
        let links = |ends: [Option<usize>; 2]| {
            let mut movable = ends.into_iter().flatten().filter(|index| !self.inertias[*index].is_immovable());
            let (first, second) = (movable.next(), movable.next());
            match (first.map(|index| own.contains(&index)), second.map(|index| own.contains(&index))) {
                (Some(true), None | Some(true)) => Ok(true),
                (None, _) | (Some(false), None | Some(false)) => Ok(false),
                _ => Err(SolverError::Linked { a: first.unwrap_or(0), b: second.unwrap_or(0) }),
            }
        };
        for force in &self.forces.forces {
            if links(force.bodies())? {
                setup.forces.forces.push(*force);
            }
        }
        for joint in &self.joints {
            if links(joint.bodies())? {
                setup.joints.push(*joint);
            }
        }
        Ok(setup)
    }
}

/// The orientation of a free body after a time, from its inertia, orientation and angular momentum.
pub(super) type Turn<T> = fn(&Inertia<T>, Rotor<T>, Bivector<T>, f64) -> Rotor<T>;

/// Bodies' masses, forces and joints as a right-hand side.
#[derive(Clone, Debug)]
pub struct System<T: Real> {
    pub(super) setup: Setup<T>,
    /// Indices of the forces that act in the present span.
    acting: Vec<usize>,
    wrenches: Wrenches<T>,
    pub(super) held: Held<T>,
    turn: Turn<T>,
    /// The bodies of another formulation, to be projected; the start of a drift.
    before: Bodies<T>,
    redirected: u64,
}

impl<T: Real> System<T> {
    /// The system of a setup, to be solved as said. Those forces act that act at time 0.
    ///
    /// # Errors
    /// A joint that is not sound, or not held at the start.
    pub fn new(setup: Setup<T>, start: &Bodies<T>, solver: &Solver) -> Result<Self, JointError> {
        let held = Held::new(&setup.joints, start, &setup.inertias, solver.violation)?;
        let wrenches = Wrenches::zeros(setup.inertias.len());
        let turn = if solver.method.splits() { axis_splitting::turn } else { free::turn };
        let mut system = Self { setup, acting: Vec::new(), wrenches, held, turn, before: start.clone(), redirected: 0 };
        system.select(0.0, 0.0);
        Ok(system)
    }

    /// Masses, forces, joints.
    #[must_use]
    pub fn setup(&self) -> &Setup<T> {
        &self.setup
    }

    /// Drifts in which joints turned too far for impulses along their directions at the start: they went on along later
    /// directions, which loses energy, but holds.
    #[must_use]
    pub fn redirected(&self) -> u64 {
        self.redirected
    }

    /// Lets those forces act that act in a span; none must switch within it. Whether they are others than before.
    pub fn select(&mut self, from_s: f64, to_s: f64) -> bool {
        let forces = self.setup.forces.forces.iter().enumerate();
        let acting = forces.filter(|(_, force)| force.acts_in(from_s, to_s)).map(|(index, _)| index);
        if acting.clone().eq(self.acting.iter().copied()) {
            return false;
        }
        self.acting.clear();
        self.acting.extend(acting);
        true
    }

    /// What the forces, without joints, do in a state.
    pub fn wrenches(&self, state: &impl Formulation<T>, wrenches: &mut Wrenches<T>) {
        self.setup.forces.wrenches(&self.acting, state, &self.setup.inertias, wrenches);
    }
}

impl<T: Real, F: Formulation<T>> ode::System<F, T> for System<T> {
    type Error = MotionError;

    fn rate(&mut self, t_s: f64, state: &F, rate: &mut F::Rate) -> Result<(), MotionError> {
        let Self { setup, acting, wrenches, held, .. } = self;
        setup.forces.wrenches(acting, state, &setup.inertias, wrenches);
        match held.constrain(state, &setup.inertias, wrenches) {
            Ok(()) => {}
            // A trial that left the range of the numbers: the stepper takes a shorter one, or says so.
            Err(SolveError::NotFinite { .. }) => wrenches.force.fill(Vector::from([T::zero() / T::zero(); 3])),
            Err(source) => return Err(MotionError::Multipliers { time_s: t_s, source }),
        }
        state.rhs(&setup.inertias, wrenches, rate);
        Ok(())
    }

    fn settle(&mut self, t_s: f64, state: &mut F) -> Result<bool, MotionError> {
        let settled = state.renormalise().map_err(|source| MotionError::Orientation { time_s: t_s, source })?;
        if self.held.is_empty() {
            return Ok(settled);
        }
        state.write_to(&mut self.before);
        let projected = self.held.project(&mut self.before);
        projected.map_err(|source| MotionError::Projection { time_s: t_s, source })?;
        state.read_from(&self.before);
        Ok(true)
    }
}

impl<T: Real> ode::Mechanics<Bodies<T>, T> for System<T> {
    type Error = MotionError;
    type Acceleration = Wrenches<T>;

    fn acceleration(&mut self, _t_s: f64, state: &Bodies<T>, out: &mut Wrenches<T>) -> Result<(), MotionError> {
        self.wrenches(state, out);
        Ok(())
    }

    fn kick(&mut self, state: &mut Bodies<T>, h_s: T, wrenches: &Wrenches<T>) {
        for (momentum, force) in state.momentum.iter_mut().zip(&wrenches.force) {
            *momentum += *force * h_s;
        }
        for (momentum, torque) in state.angular_momentum.iter_mut().zip(&wrenches.torque) {
            *momentum += *torque * h_s;
        }
    }

    fn drift(&mut self, t_s: f64, state: &mut Bodies<T>, h_s: T) -> Result<(), MotionError> {
        let (turn, h_s) = (self.turn, h_s.to_f64());
        let Self { setup: Setup { inertias, .. }, held, .. } = self;
        if held.is_empty() {
            drift(turn, state, inertias, h_s);
            return Ok(());
        }
        self.before.assign(state);
        let mut parts = 1_u32;
        loop {
            let mut straight = true;
            let done = (0..parts).try_for_each(|_| {
                // Nothing is gained by what follows a part that will be made again.
                if straight || parts == MAX_PARTS {
                    let free =
                        |bodies: &mut Bodies<T>, inertias: &[Inertia<T>], h_s| drift(turn, bodies, inertias, h_s);
                    straight &= held.shake(state, inertias, h_s / f64::from(parts), free)?;
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

    fn settle(&mut self, t_s: f64, state: &mut Bodies<T>, _h_s: T) -> Result<(), MotionError> {
        let projected = self.held.project_velocities(state);
        projected.map_err(|source| MotionError::Multipliers { time_s: t_s, source })
    }
}

/// The free motion of all bodies over a time, s.
pub(super) fn drift<T: Real>(turn: Turn<T>, bodies: &mut Bodies<T>, inertias: &[Inertia<T>], h_s: f64) {
    for (body_idx, inertia) in inertias.iter().enumerate().filter(|(_, inertia)| !inertia.is_immovable()) {
        let velocity = (bodies.momentum[body_idx] * inertia.inv_mass).map(Real::to_f64);
        bodies.position[body_idx] = bodies.position[body_idx].moved(velocity * h_s);
        let rotor = &mut bodies.rotor[body_idx];
        *rotor = turn(inertia, *rotor, bodies.angular_momentum[body_idx], h_s);
    }
}

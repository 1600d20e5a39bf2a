//! Bodies held by joints: the joints' forces for every stepper, projections, and the drift of RATTLE.
//!
//! ```text
//! C(q) = 0,   J = dC/dq,   q'' = W (Q + J^T lambda)   =>   J W J^T lambda = -Jdot q' - J W Q      (report, 24; D = 6)
//! Q = (F, tau + <Omega L>_2)      Euler's equations along the principal axes: I Omega' = tau + <Omega L>_2
//! ```
//!
//! In mechanics without bivectors `<Omega L>_2` is `-omega x L`.
//!
//! Redundant rows (a planar four-bar of hinges has three) are found and get no force; see [`Held::redundant`].
//! In errors the row of a constraint is the index of a joint.

use super::joint::check;
use super::jointed::{Masses, Poses, equal_masses, evaluate, place, unprojected, unsolved};
use super::link::{D, Link, Pose, Twist, join, part};
use super::{Bodies, Formulation, Inertia, Joint, JointError, Wrenches};
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::Rotor;
use crate::constraint::{InverseMass, Method, Multipliers, ProjectionError, Rows, SolveError};
use alloc::vec;
use alloc::vec::Vec;

/// What projection cannot get below: the rounding of positions, in units of eps times the largest coordinate, as for
/// particles.
const POSITION_EPS: f64 = 4.0;

/// The same of arms and axes: every number of a rotor is rounded, by half an eps, when it is stored, and a point at the
/// arm r then errs by up to `2 |dR| |r|`, 2 eps; two ends, and the rounding of the arithmetic as much again.
const ARM_EPS: f64 = 8.0;

/// What passes for rounding at the start, in the same units: arms and points that a scene computes from each other have
/// been through a handful of operations more than a projection leaves.
const START_FACTOR: f64 = 16.0;

/// Axes that differ by more are never taken for parallel, however small the joint: a tenth of a degree.
const MOST_ANGLE_RAD: f64 = 2e-3;

/// Joints as rows, their multipliers, and room for both.
#[derive(Clone, Debug)]
pub struct Held<T> {
    pub(super) links: Vec<Link>,
    pub(super) rows: Rows<D>,
    pub(super) multipliers: Option<Multipliers<D>>,
    pub(super) masses: Masses,
    /// From the principal axes of a body to its own.
    pub(super) principal: Vec<Rotor<f64>>,
    /// Where the bodies are; `start` at the beginning of a drift.
    pub(super) poses: Vec<Pose>,
    pub(super) start: Vec<Pose>,
    twists: Vec<Twist>,
    lambda: Vec<f64>,
    right_side: Vec<f64>,
    pub(super) room: Vec<[f64; D]>,
    pub(super) before: Bodies<T>,
    /// Where the rows were evaluated and the multipliers frozen; empty if elsewhere.
    pub(super) frozen_at: (Vec<Point<f64>>, Vec<Rotor<T>>),
    violation_m: f64,
    smallest_m: f64,
    longest_arm_m: f64,
    /// The step of the last drift, s; 0 for none.
    pub(super) last_h_s: f64,
    redundant: usize,
}

impl<T: Real> Held<T> {
    /// Joints between bodies that are on them. `violation` is what projection is asked for, relative to the smallest joint:
    /// to the root mean square distance of its bodies' mass from its point, or to the length of a distance.
    ///
    /// # Errors
    /// A joint that holds nothing or cannot hold, or whose ends are apart at the start by more than rounding, or more than
    /// the violation.
    pub fn new(
        joints: &[Joint<T>],
        bodies: &Bodies<T>,
        inertias: &[Inertia<T>],
        violation: f64,
    ) -> Result<Self, JointError> {
        if bodies.len() != inertias.len() {
            return Err(JointError::Sizes { bodies: bodies.len(), inertias: inertias.len() });
        }
        let movable: Vec<bool> = inertias.iter().map(|inertia| inertia.inv_mass > T::zero()).collect();
        joints.iter().enumerate().try_for_each(|(index, joint)| check(index, joint, &movable))?;
        let principal: Vec<Rotor<f64>> = inertias.iter().map(|inertia| inertia.principal.axes).collect();
        let (mut links, mut count) = (Vec::new(), 0);
        for joint in joints {
            let link = Link::new(joint, count, &principal, inertias);
            count += link.rows();
            links.push(link);
        }
        let pattern = links.iter().flat_map(|link| (0..link.rows()).map(|_| link.bodies()));
        let rows = Rows::new(bodies.len(), pattern);
        let masses = Masses::new(inertias);
        let smallest_m = links.iter().map(Link::length_m).reduce(f64::min).unwrap_or(1.0);
        let arms = links.iter().flat_map(|link| [link.a.arm, link.b.arm]);
        let multipliers = (!rows.is_empty()).then(|| {
            let mut multipliers = Multipliers::new(&rows, &masses, Method::Direct);
            multipliers.measure_by(equal_masses(&links, inertias));
            multipliers
        });
        let mut held = Self {
            multipliers,
            lambda: vec![0.0; rows.len()],
            right_side: vec![0.0; rows.len()],
            room: vec![[0.0; D]; bodies.len()],
            poses: Vec::with_capacity(bodies.len()),
            start: Vec::with_capacity(bodies.len()),
            twists: vec![Twist::default(); bodies.len()],
            before: bodies.clone(),
            frozen_at: (Vec::with_capacity(bodies.len()), Vec::with_capacity(bodies.len())),
            violation_m: violation * smallest_m,
            smallest_m,
            longest_arm_m: arms.fold(0.0, |most, arm| most.max(arm.norm_sq())).sqrt(),
            last_h_s: 0.0,
            redundant: 0,
            links,
            rows,
            masses,
            principal,
        };
        held.meet(bodies)?;
        // Which rows are redundant shows where the joints hold: here, and after every step.
        held.freeze(bodies).map_err(|_| JointError::NotFinite { joint: 0 })?;
        Ok(held)
    }

    /// Whether the ends meet.
    fn meet(&mut self, bodies: &Bodies<T>) -> Result<(), JointError> {
        place(bodies, &self.principal, &mut self.poses);
        let allowed_m = self.violation_m.max(START_FACTOR * self.rounding_m(bodies));
        for (joint, link) in self.links.iter().enumerate() {
            let off = link.violation(&self.poses);
            // The size of a joint may be less than the rounding of its position.
            let allowed_rad = (allowed_m / link.size_m).min(MOST_ANGLE_RAD);
            if !(off.gap_m + off.angle_rad).is_finite() {
                return Err(JointError::NotFinite { joint });
            }
            if !(off.gap_m <= allowed_m) {
                return Err(JointError::Apart { joint, gap_m: off.gap_m, allowed_m });
            }
            if !(off.angle_rad <= allowed_rad) {
                return Err(JointError::AxesApart { joint, angle_rad: off.angle_rad });
            }
        }
        Ok(())
    }

    /// Are there no joints?
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.links.is_empty()
    }

    /// The most rows that were found redundant at a time: combinations of others. They get no force.
    #[must_use]
    pub fn redundant(&self) -> usize {
        self.redundant
    }

    /// The violation that is asked for, m; rounding far from the origin may leave more.
    #[must_use]
    pub fn asked_violation_m(&self) -> f64 {
        self.violation_m
    }

    /// The worst joint and its violation, m; none without joints. That of a ball or hinge is the gap between its points, or
    /// the angle between the axes of the hinge times its size (the root mean square distance of its bodies' mass from its
    /// point), if that is more.
    pub fn worst_violation(&mut self, bodies: &Bodies<T>) -> Option<(usize, f64)> {
        place(bodies, &self.principal, &mut self.poses);
        let violations = self.links.iter().map(|link| link.violation_m(&self.poses));
        violations.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// What rounding leaves of positions and arms, m.
    fn rounding_m(&self, bodies: &Bodies<T>) -> f64 {
        let farthest =
            bodies.position.iter().fold(0.0, |most: f64, p| most.max(p.x.abs()).max(p.y.abs()).max(p.z.abs()));
        POSITION_EPS * f64::EPSILON * farthest + ARM_EPS * T::EPSILON.to_f64() * self.longest_arm_m
    }

    pub(super) fn tolerance_m(&self, bodies: &Bodies<T>) -> f64 {
        self.violation_m.max(self.rounding_m(bodies))
    }

    /// Evaluates the rows where the bodies are and factors `J W J^T`, unless they were there last.
    pub(super) fn freeze(&mut self, bodies: &Bodies<T>) -> Result<(), SolveError> {
        place(bodies, &self.principal, &mut self.poses);
        if self.frozen_at.0 == bodies.position && self.frozen_at.1 == bodies.rotor {
            return Ok(());
        }
        self.frozen_at.0.clear();
        evaluate(&self.links, &self.poses, &mut self.rows);
        let off = self.tolerance_m(bodies) / self.smallest_m;
        let Some(multipliers) = &mut self.multipliers else {
            return Ok(());
        };
        // Off the joints by as much as is allowed, redundant rows depend on each other nearly.
        multipliers.assume_off(off);
        let frozen = multipliers.freeze(&self.rows, &self.masses);
        frozen.map_err(|error| unsolved(&self.links, error))?;
        self.redundant = self.redundant.max(multipliers.redundant().len());
        self.frozen_at.0.extend_from_slice(&bodies.position);
        self.frozen_at.1.clone_from(&bodies.rotor);
        Ok(())
    }

    /// Adds the forces and torques of the joints to those of the forces: such that the joints keep being held. For
    /// Runge-Kutta methods, with a projection after each step.
    ///
    /// # Errors
    /// A state that is not finite.
    pub fn constrain<F: Formulation<T>>(
        &mut self,
        state: &F,
        inertias: &[Inertia<T>],
        wrenches: &mut Wrenches<T>,
    ) -> Result<(), SolveError> {
        if self.is_empty() {
            return Ok(());
        }
        self.frozen_at.0.clear();
        self.follow(state, inertias);
        for link in &self.links {
            link.evaluate(&self.poses, &mut self.rows);
            link.curve(&self.poses, &self.twists, &mut self.rows);
        }
        for (body_idx, (room, pose)) in self.room.iter_mut().zip(&self.poses).enumerate() {
            let force = wrenches.force[body_idx].map(Real::to_f64);
            let torque = pose.plane_to_body(wrenches.torque[body_idx].map(Real::to_f64));
            let omega = pose.plane_to_body(self.twists[body_idx].omega);
            let whole = self.masses.accelerate(body_idx, join(force, torque + self.masses.gyroscopic(body_idx, omega)));
            *room = whole;
        }
        self.balance()?;
        for (body_idx, (room, pose)) in self.room.iter().zip(&self.poses).enumerate() {
            if !self.masses.is_fixed(body_idx) {
                let (force, torque) = part(*room);
                wrenches.force[body_idx] += force.map(T::from_f64);
                wrenches.torque[body_idx] += pose.plane_to_world(torque).map(T::from_f64);
            }
        }
        Ok(())
    }

    /// Where a state is and how it moves.
    fn follow<F: Formulation<T>>(&mut self, state: &F, inertias: &[Inertia<T>]) {
        self.poses.clear();
        for (body_idx, inertia) in inertias.iter().enumerate() {
            let axes = Pose::axes_of(self.principal[body_idx], |axis| {
                state.to_world(body_idx, axis.map(T::from_f64)).map(Real::to_f64)
            });
            self.poses.push(Pose { position: state.position(body_idx), axes });
            self.twists[body_idx] = Twist {
                velocity: state.velocity(body_idx, inertia).map(Real::to_f64),
                omega: state.omega_world(body_idx, inertia).map(Real::to_f64),
            };
        }
    }

    /// From free accelerations the forces of the joints, body by body, in `room`.
    fn balance(&mut self) -> Result<(), SolveError> {
        let Self { multipliers: Some(multipliers), rows, right_side, lambda, room, masses, links, .. } = self else {
            return Ok(());
        };
        // Within a step the joints are off by its error.
        let frozen = multipliers.freeze_alike(rows, &*masses);
        frozen.map_err(|error| unsolved(links, error))?;
        rows.times(|body_idx| room[body_idx], right_side);
        for (b, curvature) in right_side.iter_mut().zip(rows.curvatures()) {
            *b = -(*b + curvature);
        }
        // Of what is not finite the solution is not either, from the first row on.
        if let Some(row) = right_side.iter().position(|b| !b.is_finite()) {
            return Err(unsolved(links, SolveError::NotFinite { row }));
        }
        let solved = multipliers.solve_leaving(&*masses, right_side, lambda);
        room.fill([0.0; D]);
        rows.transposed_times(lambda, |body_idx, force| {
            for (sum, force) in room[body_idx].iter_mut().zip(force) {
                *sum += force;
            }
        });
        solved.map_err(|error| unsolved(links, error))
    }

    /// Positions and orientations onto the joints, then momenta.
    ///
    /// # Errors
    /// See [`ProjectionError`]; the bodies are then where the violation was least.
    pub fn project(&mut self, bodies: &mut Bodies<T>) -> Result<(), ProjectionError> {
        let tolerance_m = self.tolerance_m(bodies);
        self.frozen_at.0.clear();
        let Self { multipliers: Some(multipliers), rows, masses, links, principal, poses, .. } = self else {
            return Ok(());
        };
        let mut configuration = Poses { links, principal, bodies, poses };
        let projected = multipliers.project(rows, &*masses, &mut configuration, tolerance_m);
        projected.map_err(|error| unprojected(&self.links, error))?;
        Ok(self.project_velocities(bodies)?)
    }

    /// Momenta such that the joints stay held: the nearest in the norm of the kinetic energy. Also what an impact leaves,
    /// with the impulses of the joints.
    ///
    /// # Errors
    /// A state that is not finite.
    pub fn project_velocities(&mut self, bodies: &mut Bodies<T>) -> Result<(), SolveError> {
        if self.is_empty() {
            return Ok(());
        }
        self.freeze(bodies)?;
        let Self { multipliers: Some(multipliers), masses, poses, .. } = self else {
            return Ok(());
        };
        let velocity = |body_idx: usize| masses.twist(body_idx, bodies, &poses[body_idx]);
        match multipliers.velocity_change(&*masses, velocity) {
            Ok(changes) => {
                for (body_idx, change) in changes.iter().enumerate() {
                    masses.push(body_idx, bodies, &poses[body_idx], *change);
                }
                Ok(())
            }
            Err(error) => Err(unsolved(&self.links, error)),
        }
    }
}

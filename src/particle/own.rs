//! Forces and constraints of one's own, without derivatives: those come from dual numbers.
//!
//! ```
//! use ga_physics::algebra::cga::Point;
//! use ga_physics::particle::{Constraint, ConstraintFunction, Differentiable, OwnConstraint};
//!
//! /// A bead on the paraboloid z = (x² + y²) / 2.
//! struct Bowl;
//! impl ConstraintFunction for Bowl {
//!     fn value<S: Differentiable>(&self, at: &[Point<S>]) -> S {
//!         let Point { x, y, z } = at[0];
//!         (x * x + y * y) * S::ratio(1, 2) - z
//!     }
//! }
//! let bead = Constraint::Own(OwnConstraint::new([0], Bowl));
//! # let _ = bead;
//! ```

use super::Particles;
use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;
use crate::algebra::{Real, Scalar};
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;
use num_dual::{Dual2_64, Dual64, DualNum};

/// A number with which a function can be differentiated: arithmetic, roots, `sin`, `exp` and the like; `S::from(0.5)` is a
/// constant.
pub trait Differentiable: Scalar + DualNum<Primitive = f64> {}

impl<S: Scalar + DualNum<Primitive = f64>> Differentiable for S {}

/// The function C of a constraint `C(x) = 0`.
pub trait ConstraintFunction: Send + Sync + 'static {
    /// C at the positions of the particles that the constraint names, in their order, m. Near 0 its gradient must not be
    /// 0; let it be a length or a length times a length, so that tolerances mean something.
    fn value<S: Differentiable>(&self, at: &[Point<S>]) -> S;
}

/// The function V of a force `F = -dV/dx`.
pub trait Potential: Send + Sync + 'static {
    /// V, J, at the positions of the particles that the force names, in their order.
    fn energy<S: Differentiable>(&self, at: &[Point<S>]) -> S;
}

/// A force that need not have a potential: friction, thrust, wind.
pub trait ForceLaw: Send + Sync + 'static {
    /// The force on each of the particles that it names, N, at a time, s, positions, m, and velocities, m/s.
    fn force(&self, t_s: f64, at: &[Point<f64>], velocity: &[Vector<f64>], force: &mut [Vector<f64>]);
}

/// A function of positions with its derivatives: what the generic traits become, so that many kinds go into one list.
trait Derivatives: Send + Sync {
    fn value(&self, at: &[Point<f64>]) -> f64;
    fn slope(&self, at: &[Point<Dual64>]) -> f64;
    fn curvature(&self, at: &[Point<Dual2_64>]) -> f64;
}

struct ConstraintDerivatives<F>(F);
struct PotentialDerivatives<F>(F);

macro_rules! derivatives {
    ($wrapper:ident, $function:ident, $method:ident) => {
        impl<F: $function> Derivatives for $wrapper<F> {
            fn value(&self, at: &[Point<f64>]) -> f64 {
                self.0.$method(at)
            }
            fn slope(&self, at: &[Point<Dual64>]) -> f64 {
                self.0.$method(at).eps
            }
            fn curvature(&self, at: &[Point<Dual2_64>]) -> f64 {
                self.0.$method(at).v2
            }
        }
    };
}

derivatives!(ConstraintDerivatives, ConstraintFunction, value);
derivatives!(PotentialDerivatives, Potential, energy);

/// Space for the arguments of functions, kept from one evaluation to the next.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    at: Vec<Point<f64>>,
    first: Vec<Point<Dual64>>,
    second: Vec<Point<Dual2_64>>,
    velocity: Vec<Vector<f64>>,
    force: Vec<Vector<f64>>,
}

/// A function with the particles that it is of.
#[derive(Clone)]
struct Bound {
    particles: Arc<[usize]>,
    function: Arc<dyn Derivatives>,
}

impl Bound {
    fn value(&self, position: &[Point<f64>], scratch: &mut Scratch) -> f64 {
        scratch.at.clear();
        scratch.at.extend(self.particles.iter().map(|particle| position[*particle]));
        self.function.value(&scratch.at)
    }

    /// Calls `with` for each particle and the gradient by its position.
    fn gradient(&self, position: &[Point<f64>], scratch: &mut Scratch, mut with: impl FnMut(usize, Vector<f64>)) {
        scratch.first.clear();
        scratch.first.extend(self.particles.iter().map(|particle| position[*particle].map(Dual64::from)));
        for (index, particle) in self.particles.iter().enumerate() {
            let rest = scratch.first[index];
            let slopes = core::array::from_fn(|axis| {
                let mut moving = <[Dual64; 3]>::from(rest);
                moving[axis].eps = 1.0;
                scratch.first[index] = moving.into();
                self.function.slope(&scratch.first)
            });
            scratch.first[index] = rest;
            with(*particle, Vector::from(slopes));
        }
    }

    /// `d²C/dt²` along straight motions: `Jdot xdot`.
    fn curvature<T: Real>(&self, state: &Particles<T>, scratch: &mut Scratch) -> f64 {
        scratch.second.clear();
        scratch.second.extend(self.particles.iter().map(|particle| {
            let (x, v) = (<[f64; 3]>::from(state.position[*particle]), <[T; 3]>::from(state.velocity[*particle]));
            Point::from(core::array::from_fn(|axis| Dual2_64::new(x[axis], v[axis].to_f64(), 0.0)))
        }));
        self.function.curvature(&scratch.second)
    }
}

/// A constraint of one's own on certain particles.
#[derive(Clone)]
pub struct OwnConstraint(Bound);

impl OwnConstraint {
    /// Holds `C = 0` for these particles, in the order in which the function takes them.
    pub fn new(particles: impl Into<Vec<usize>>, function: impl ConstraintFunction) -> Self {
        Self(Bound { particles: particles.into().into(), function: Arc::new(ConstraintDerivatives(function)) })
    }

    /// The particles that it names.
    #[must_use]
    pub fn particles(&self) -> &[usize] {
        &self.0.particles
    }

    /// C.
    pub(super) fn value(&self, position: &[Point<f64>], scratch: &mut Scratch) -> f64 {
        self.0.value(position, scratch)
    }

    /// `dC/dx`, particle by particle, in the order of [`OwnConstraint::particles`].
    pub(super) fn gradient(
        &self,
        position: &[Point<f64>],
        scratch: &mut Scratch,
        with: impl FnMut(usize, Vector<f64>),
    ) {
        self.0.gradient(position, scratch, with);
    }

    /// `Jdot xdot`.
    pub(super) fn curvature<T: Real>(&self, state: &Particles<T>, scratch: &mut Scratch) -> f64 {
        self.0.curvature(state, scratch)
    }
}

/// A force of one's own, given by its potential.
#[derive(Clone)]
pub struct OwnPotential(Bound);

impl OwnPotential {
    /// The force `-dV/dx` on these particles, in the order in which the function takes them.
    pub fn new(particles: impl Into<Vec<usize>>, function: impl Potential) -> Self {
        Self(Bound { particles: particles.into().into(), function: Arc::new(PotentialDerivatives(function)) })
    }

    /// The particles that it names.
    #[must_use]
    pub fn particles(&self) -> &[usize] {
        &self.0.particles
    }

    /// V, J.
    pub(super) fn energy(&self, position: &[Point<f64>], scratch: &mut Scratch) -> f64 {
        self.0.value(position, scratch)
    }

    /// `-dV/dx`, N.
    pub(super) fn force(
        &self,
        position: &[Point<f64>],
        scratch: &mut Scratch,
        mut with: impl FnMut(usize, Vector<f64>),
    ) {
        self.0.gradient(position, scratch, |particle, slope| with(particle, -slope));
    }
}

/// A force of one's own, given by its law.
#[derive(Clone)]
pub struct OwnForce {
    particles: Arc<[usize]>,
    law: Arc<dyn ForceLaw>,
}

impl OwnForce {
    /// A law for these particles, in the order in which it takes them.
    pub fn new(particles: impl Into<Vec<usize>>, law: impl ForceLaw) -> Self {
        Self { particles: particles.into().into(), law: Arc::new(law) }
    }

    /// The particles that it names.
    #[must_use]
    pub fn particles(&self) -> &[usize] {
        &self.particles
    }

    /// The force on each of its particles, N.
    pub(super) fn force<T: Real>(
        &self,
        t_s: f64,
        state: &Particles<T>,
        scratch: &mut Scratch,
        mut with: impl FnMut(usize, Vector<f64>),
    ) {
        let Scratch { at, velocity, force, .. } = scratch;
        at.clear();
        at.extend(self.particles.iter().map(|particle| state.position[*particle]));
        velocity.clear();
        velocity.extend(self.particles.iter().map(|particle| state.velocity[*particle].map(Real::to_f64)));
        force.clear();
        force.resize(self.particles.len(), Vector::default());
        self.law.force(t_s, at, velocity, force);
        self.particles.iter().zip(force.iter()).for_each(|(particle, force)| with(*particle, *force));
    }
}

macro_rules! debug_as_particles {
    ($($name:ident)*) => {$(
        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_tuple(stringify!($name)).field(&self.particles()).finish()
            }
        }
    )*};
}

debug_as_particles!(OwnConstraint OwnPotential OwnForce);

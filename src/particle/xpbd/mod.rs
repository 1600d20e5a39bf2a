//! Substepped extended position-based dynamics, XPBD: the fast mode, for large nets and chains.
//!
//! ```text
//! for each substep h:   x* = 2 x - x_old + h² a                        prediction; a from gravity or a closure
//!                       x  = x* + w_i dC/dx_i lambda, constraint by constraint, lambda = -C / sum_i w_i |dC/dx_i|²
//!                       v  = (x - x_old) / h
//! ```
//!
//! One Gauss-Seidel sweep a substep: Macklin, Storey, Lu, Terdiman, Chentanez, Jeschke and Müller, "Small steps in
//! physics simulation" (SCA 2019), algorithm 1, with compliance 0, for which XPBD (Macklin, Müller and Chentanez, MIG
//! 2016, eq. 18) forgets its multipliers. Substeps beat sweeps: the error of a sweep falls as h².
//!
//! **Static stretch.** At rest the sweep must lift each particle by the `g h²` that it was predicted to fall. So a link
//! under tension T is corrected, each substep, by `(w_a + w_b) T h²`: by `2 k g h²` if it carries k particles of one mass,
//! `k g h²` if its other end is fixed. The neighbours that come after it undo part of that; no more than `2 k g h²` is left.
//! [`Xpbd::substeps`] turns it round.
//!
//! **Shocks.** A net that snaps taut has a few links that move by `v h`, which falls only as h. They are swept again:
//! groups of 8 links with one that was stretched by more than 0.4 of the asked violation, up to
//! 16 times.
//!
//! **Order.** Blocks of 4096 consecutive particles, which stay in the cache while their links are swept; then the
//! links between neighbouring blocks; then the rest. Each part by colours (greedy), so that consecutive links share no
//! particle and their divisions overlap. A sweep in the order of the particles is *unstable* for a net that hangs by two
//! corners: it drives waves along, while colours have no direction. Feature `parallel` spreads the blocks over threads;
//! the order of the operations on a particle, and so every bit, stays the same.
//!
//! What it does not do: keep the energy (it loses some, of first order in h), and hold a taut, flat net better than its
//! stretch by load. For that there are the solvers with multipliers.

mod load;
mod order;
mod store;
mod surface;
mod sweep;
mod violation;

use super::own::Scratch;
use super::{Constraint, OwnConstraint, Particles};
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;
use alloc::vec;
use alloc::vec::Vec;
use order::{Link, Plan};
use surface::Held;
use thiserror::Error;
pub use violation::Violation;

/// Particles of a block: 96 KB of positions, and as much of velocities, in the second-level cache.
const BLOCK: usize = 4096;
/// Links that are swept again together.
const GROUP: usize = 8;
/// Groups are swept again while one of their links is stretched by more than this part of the asked violation. At 0.7
/// instead of 0.4, a 32 x 32 net that snaps taut misses its 1e-2 in one step of thirty; at 0.2 it costs a half more.
const AGAIN: f64 = 0.4;
/// Sweeps over such groups, at most, a substep. With 8 nets of 100 x 100 miss their 1e-2 in one step of 180.
const ROUNDS: usize = 16;
/// More sweeps, at most, at the end of a step that is still over the asked violation.
const SETTLING: usize = 24;
/// Lengths whose fourth power, times an inverse mass, is neither infinite nor 0.
const LENGTHS_M: core::ops::RangeInclusive<f64> = 1e-60..=1e60;

/// Why particles and constraints cannot be simulated.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum XpbdError {
    /// Arrays of different lengths.
    #[error("{inv_masses} inverse masses for {particles} particles: give one each")]
    Sizes {
        /// Their number.
        particles: usize,
        /// Their number.
        inv_masses: usize,
    },
    /// More particles than 32 bits count.
    #[error("{particles} particles are more than {}", u32::MAX)]
    TooMany {
        /// Their number.
        particles: usize,
    },
    /// An inverse mass that is none.
    #[error("the inverse mass {inv_mass:e} of particle {particle} is not a number >= 0")]
    InverseMass {
        /// Which.
        particle: usize,
        /// 1/kg.
        inv_mass: f64,
    },
    /// A constraint on a particle that does not exist.
    #[error("constraint {constraint} is on particle {particle}, but there are {particles}")]
    NoSuchParticle {
        /// Which.
        constraint: usize,
        /// Its particle.
        particle: usize,
        /// Their number.
        particles: usize,
    },
    /// A distance of a particle to itself.
    #[error("constraint {constraint} holds particle {particle} at a distance from itself: name two particles")]
    SameParticle {
        /// Which.
        constraint: usize,
        /// Its particle.
        particle: usize,
    },
    /// A length out of range.
    #[error("the length {length_m:e} m of constraint {constraint} is not within 1e-60 .. 1e60")]
    Length {
        /// Which.
        constraint: usize,
        /// m.
        length_m: f64,
    },
    /// A surface without points.
    #[error("constraint {constraint} is on neither a plane nor a real sphere: its square must be positive")]
    Surface {
        /// Which.
        constraint: usize,
    },
}

/// How to make a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Substeps {
    /// The step, s.
    pub dt_s: f64,
    /// The number of substeps that it is divided into, as from [`Xpbd::substeps`]; 0 counts as 1.
    pub count: usize,
    /// The relative violation that is asked for: where a link exceeds 0.4 of it, more sweeps are made. With
    /// infinity there is exactly one sweep a substep.
    pub violation: f64,
}

impl Substeps {
    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
    fn h_s(&self) -> f64 {
        self.dt_s / self.count.max(1) as f64
    }
}

/// Constraints, in the order in which they are swept.
///
/// 16.5 bytes a distance in all; beside it, a state of 56 bytes a particle in f64. In f32 the last positions need 24 bytes
/// a particle of their own, and forces by a closure need one more vector a particle.
#[derive(Clone, Debug)]
pub struct Xpbd<T> {
    particles: usize,
    fixed: usize,
    links: Plan,
    surfaces: Vec<Held>,
    own: Vec<OwnConstraint>,
    scratch: Scratch,
    gradients: Vec<(usize, Vector<f64>)>,
    load: load::Load,
    /// The last positions, if velocities of type T cannot hold them.
    last: Vec<Point<f64>>,
    acceleration: Vec<Vector<T>>,
}

impl<T: Real> Xpbd<T> {
    /// Orders the constraints. A distance between two fixed particles is left out.
    ///
    /// # Errors
    /// Says which particle or constraint has what wrong.
    pub fn new(particles: &Particles<T>, inv_mass: &[T], constraints: &[Constraint]) -> Result<Self, XpbdError> {
        let n = particles.len();
        check_masses(n, inv_mass)?;
        let (mut links, mut surfaces, mut own) = (Vec::new(), Vec::new(), Vec::new());
        for (constraint, held) in constraints.iter().enumerate() {
            check_particles(constraint, held, n)?;
            match held {
                Constraint::Distance { a, b, length } => {
                    if inv_mass[*a] != T::zero() || inv_mass[*b] != T::zero() {
                        links.push(Link::new(*a, *b, checked_length(constraint, *length)?));
                    }
                }
                Constraint::ToPoint { particle, point, length } => {
                    surfaces.push(Held::to_point(*particle, *point, checked_length(constraint, *length)?));
                }
                Constraint::On { particle, anchor, surface } => {
                    let on = Held::on(*particle, *anchor, *surface).ok_or(XpbdError::Surface { constraint })?;
                    surfaces.push(on);
                }
                Constraint::Own(function) => own.push(function.clone()),
            }
        }
        surfaces.shrink_to_fit();
        let load = load::Load::new(inv_mass, &links, &surfaces);
        Ok(Self {
            particles: n,
            fixed: fixed(inv_mass),
            links: Plan::new(n, links),
            surfaces,
            own,
            scratch: Scratch::default(),
            gradients: Vec::new(),
            load,
            last: if store::holds_positions::<T>() { Vec::new() } else { vec![Point::default(); n] },
            acceleration: Vec::new(),
        })
    }

    /// The number of substeps of a step of `dt_s` that keeps the relative violation, for bodies that hang or sit in a
    /// uniform acceleration, m/s².
    ///
    /// From what each link carries: of a component that hangs from something, the mass beyond each cut between particles
    /// that are equally many links away from where it hangs, spread evenly over the links through the cut. The initial motion does not enter. At least 1.
    #[must_use]
    pub fn substeps(&self, dt_s: f64, acceleration_m_s2: f64, violation: f64) -> usize {
        self.load.substeps(dt_s, acceleration_m_s2, violation)
    }

    /// Makes a step under a uniform acceleration, m/s².
    ///
    /// Inverse masses are those of construction; a particle of inverse mass 0 stays where it is, to the bit, and gets the
    /// velocity 0.
    ///
    /// # Panics
    /// If there are not as many particles, or not as many fixed ones, as at construction.
    pub fn step(&mut self, particles: &mut Particles<T>, inv_mass: &[T], substeps: &Substeps, gravity: Vector<f64>) {
        self.check(particles, inv_mass);
        let h_s = substeps.h_s();
        self.begin(particles, inv_mass, h_s, None);
        for substep in 0..substeps.count.max(1) {
            let last = substep + 1 == substeps.count.max(1);
            self.substep(particles, inv_mass, h_s, gravity, substeps.violation, last);
        }
        self.finish(particles, inv_mass, h_s);
    }

    /// Makes a step under forces of one's own: a closure that is given the time since the start of the step, s, and the
    /// state at the start of each substep, and sets the acceleration of every particle, m/s², gravity included. The
    /// accelerations are zero when it is called.
    ///
    /// # Errors
    /// The closure's. The particles are then where that substep started.
    ///
    /// # Panics
    /// As [`Xpbd::step`].
    pub fn step_with<E>(
        &mut self,
        particles: &mut Particles<T>,
        inv_mass: &[T],
        substeps: &Substeps,
        mut forces: impl FnMut(f64, &Particles<T>, &mut [Vector<T>]) -> Result<(), E>,
    ) -> Result<(), E> {
        self.check(particles, inv_mass);
        let (h_s, count) = (substeps.h_s(), substeps.count.max(1));
        let mut acceleration = core::mem::take(&mut self.acceleration);
        let mut outcome = Ok(());
        for substep in 0..count {
            acceleration.clear();
            acceleration.resize(self.particles, Vector::default());
            #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
            let t_s = substep as f64 * h_s;
            outcome = forces(t_s, particles, &mut acceleration);
            if outcome.is_err() {
                break;
            }
            self.begin(particles, inv_mass, h_s, Some(&acceleration));
            self.substep(particles, inv_mass, h_s, Vector::default(), substeps.violation, substep + 1 == count);
            self.finish(particles, inv_mass, h_s);
        }
        self.acceleration = acceleration;
        outcome
    }

    fn check(&self, particles: &Particles<T>, inv_mass: &[T]) {
        let n = self.particles;
        assert!(
            particles.position.len() == n && particles.velocity.len() == n && inv_mass.len() == n,
            "XPBD was made for {n} particles"
        );
        assert!(fixed(inv_mass) == self.fixed, "XPBD was made for {} fixed particles", self.fixed);
    }
}

fn fixed<T: Real>(inv_mass: &[T]) -> usize {
    inv_mass.iter().filter(|w| **w == T::zero()).count()
}

fn check_masses<T: Real>(particles: usize, inv_mass: &[T]) -> Result<(), XpbdError> {
    if inv_mass.len() != particles {
        return Err(XpbdError::Sizes { particles, inv_masses: inv_mass.len() });
    }
    if u32::try_from(particles).is_err() {
        return Err(XpbdError::TooMany { particles });
    }
    let wrong = inv_mass.iter().position(|w| !(*w >= T::zero() && w.is_finite()));
    wrong.map_or(Ok(()), |particle| Err(XpbdError::InverseMass { particle, inv_mass: inv_mass[particle].to_f64() }))
}

fn check_particles(constraint: usize, held: &Constraint, particles: usize) -> Result<(), XpbdError> {
    let two;
    let named: &[usize] = match held {
        Constraint::Distance { a, b, .. } if a == b => {
            return Err(XpbdError::SameParticle { constraint, particle: *a });
        }
        Constraint::Distance { a, b, .. } => {
            two = [*a, *b];
            &two
        }
        Constraint::ToPoint { particle, .. } | Constraint::On { particle, .. } => core::slice::from_ref(particle),
        Constraint::Own(own) => own.particles(),
    };
    match named.iter().find(|particle| **particle >= particles) {
        Some(particle) => Err(XpbdError::NoSuchParticle { constraint, particle: *particle, particles }),
        None => Ok(()),
    }
}

fn checked_length(constraint: usize, length_m: f64) -> Result<f64, XpbdError> {
    if LENGTHS_M.contains(&length_m) { Ok(length_m) } else { Err(XpbdError::Length { constraint, length_m }) }
}

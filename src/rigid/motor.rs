//! The conformal motor formulation of rigid motion: position and orientation as one versor `M = T R` of eight numbers.
//!
//! # The equations
//!
//! `Mdot = -1/2 V_world M = -1/2 M V_body`, with the twists `V_world = Omega_world + v_0 ^ ninf`, `v_0 = xdot - x . Omega`,
//! and `V_body = ~M V_world M = Omega_body + (~R xdot R) ^ ninf`. The body's has no lever arm x, which costs digits, and
//! `Omega_body` is what the inertia gives. Rotating xdot into the body is not needed either: with `M = T R`,
//! `M (~R xdot R) ninf = T xdot R ninf = xdot ninf R`, for translators leave what holds ninf. So
//!
//! ```text
//! Mdot = -1/2 (M Omega_body + xdot ninf R)     pdot = F     Ldot = tau     Omega_body = I^-1 (~R L R)     xdot = p / m
//! ```
//!
//! A motor is `M = r + m ninf`, with r even and m odd in G(3,0) (`m = -1/2 t r`), since ninf commutes with what is even
//! there. So all products are of G(3,0):
//!
//! ```text
//! rdot = -1/2 r Omega_body     mdot = -1/2 (m Omega_body + xdot r)
//! ```
//!
//! # The state
//!
//! Motors are relative to an anchor, a world point in f64 for each body: as coefficients of a world motor positions would be
//! rounded to `eps |x|`, and those of f32 motors to that of f32. [`renormalise`] moves the anchor to the centre of mass, so
//! that m holds the way of one step and is rounded like the steps of the other formulations.
//!
//! # What it buys, and what it costs
//!
//! One object is the pose: it acts on points, composes, and has a logarithm, so between two states the body follows a
//! screw. Within a step position and orientation are one unknown, and err together: a Runge-Kutta step of a body that spins
//! and flies makes an error of order `|v| h (|Omega| h)^4` in the position, where the other formulations, which integrate
//! xdot by itself, are exact.

use super::rotor::{Worst, turned};
use super::sums::{add_scaled, assign};
use super::{Bodies, Formulation, Inertia, MotionError, OrientationLost, System, Wrenches};
use crate::algebra::Real;
use crate::algebra::cga::{Motor, Point};
use crate::algebra::g3::{Bivector, Even, Odd, Rotor, Vector};
use crate::ode::{self, Controlled, Rk4, RungeKutta, Tolerance};
use alloc::vec;
use alloc::vec::Vec;

/// The states of all bodies. Every array has one entry a body.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct State<T> {
    /// What the motor is relative to: world, m.
    pub anchor: Vec<Point<f64>>,
    /// Pose, body to world, relative to the anchor: first the rotation, then the translation.
    pub motor: Vec<Motor<T>>,
    /// Momentum, kg m/s.
    pub momentum: Vec<Vector<T>>,
    /// Angular momentum about the centre of mass, world, kg m²/s.
    pub angular_momentum: Vec<Bivector<T>>,
}

/// The rate of change of every array of [`State`]. Anchors stay where they are.
#[derive(Clone, Debug, Default)]
pub struct Rates<T> {
    /// rdot of `M = r + m ninf`, 1/s.
    pub even: Vec<Even<T>>,
    /// mdot, m/s.
    pub odd: Vec<Odd<T>>,
    /// Force, N.
    pub momentum: Vec<Vector<T>>,
    /// Torque about the centre of mass, N m.
    pub angular_momentum: Vec<Bivector<T>>,
}

/// The equations of motion, for every body.
pub fn rhs<T: Real>(state: &State<T>, inertias: &[Inertia<T>], wrenches: &Wrenches<T>, rates: &mut Rates<T>) {
    let (minus_half, n) = (T::ratio(-1, 2), inertias.len());
    let (motor, momentum) = (&state.motor[..n], &state.momentum[..n]);
    let angular_momentum = &state.angular_momentum[..n];
    let (rdot, mdot) = (&mut rates.even[..n], &mut rates.odd[..n]);
    for (i, inertia) in inertias.iter().enumerate() {
        let (r, m) = parts(motor[i]);
        let (l, norm_sq) = (angular_momentum[i], Even::from(r).norm_sq());
        // ~R L R, of a stage that is no unit motor: see the rotor form. Its square norm is divided out with the half.
        let momentum_body = r.rev().apply(l) + l * (norm_sq - T::one());
        let omega_body = inertia.velocity_of(momentum_body) * (minus_half / norm_sq);
        let velocity = momentum[i] * (inertia.inv_mass * minus_half);
        rdot[i] = r * omega_body;
        mdot[i] = m * omega_body + velocity * r;
    }
    rates.momentum.copy_from_slice(&wrenches.force);
    rates.angular_momentum.copy_from_slice(&wrenches.torque);
}

/// r and m of `M = r + m ninf`.
#[inline]
pub(super) fn parts<T: Real>(motor: Motor<T>) -> (Rotor<T>, Odd<T>) {
    (motor.rotor(), Odd::new(motor.e1_ninf, motor.e2_ninf, motor.e3_ninf, motor.e123_ninf))
}

/// `r + m ninf`.
#[inline]
pub(super) fn joined<T: Real>(r: Rotor<T>, m: Odd<T>) -> Motor<T> {
    Motor::from([r.s, r.e23, r.e31, r.e12, m.e1, m.e2, m.e3, m.e123])
}

/// The translation of a motor, whatever its norm, `-2 m ~r / (r ~r)`.
#[inline]
fn translation<T: Real>(r: Rotor<T>, m: Odd<T>) -> Vector<T> {
    let t = m * r.rev();
    Vector::new(t.e1, t.e2, t.e3) * (T::ratio(-2, 1) / Even::from(r).norm_sq())
}

/// Brings every motor back to unit norm, both parts of `M ~M = 1`, and its anchor to the centre of mass.
///
/// # Errors
/// A motor whose numbers overflowed, or whose rotor vanished.
pub fn renormalise<T: Real>(state: &mut State<T>) -> Result<(), OrientationLost> {
    for (body_idx, motor) in state.motor.iter_mut().enumerate() {
        let lost = OrientationLost { body_idx, reason: "its motor has no norm or is not finite" };
        let (r, m) = parts(*motor);
        let rotor = r.renormalise().map_err(|_| lost)?;
        // The vector part of -2 m ~r / |r|² is the nearest translation; its trivector part is the other half of M ~M.
        let moved = translation(r, m);
        if !(moved.e1.is_finite() && moved.e2.is_finite() && moved.e3.is_finite()) {
            return Err(lost);
        }
        state.anchor[body_idx] = state.anchor[body_idx].moved(moved.map(Real::to_f64));
        *motor = joined(rotor, Odd::default());
    }
    Ok(())
}

/// One step of classical RK4, then [`renormalise`].
///
/// # Errors
/// A motor whose numbers overflowed or vanished; those of the system.
pub fn advance<T: Real>(
    state: &mut State<T>,
    rk4: &mut RungeKutta<Rk4, State<T>, T>,
    system: &mut System<T>,
    t_s: f64,
    h_s: f64,
) -> Result<(), MotionError> {
    rk4.step(state, t_s, h_s, system)?;
    renormalise(state).map_err(|source| MotionError::Orientation { time_s: t_s + h_s, source })
}

impl<T: Real> Formulation<T> for State<T> {
    /// After a step the anchor is another one, and so are the rates there.
    const INTERPOLATES: bool = false;

    fn from_bodies(bodies: &Bodies<T>) -> Self {
        let mut state = Self::default();
        state.read_from(bodies);
        state
    }

    fn read_from(&mut self, bodies: &Bodies<T>) {
        self.anchor.clone_from(&bodies.position);
        self.motor.clear();
        self.motor.extend(bodies.rotor.iter().map(|rotor| joined(*rotor, Odd::default())));
        self.momentum.clone_from(&bodies.momentum);
        self.angular_momentum.clone_from(&bodies.angular_momentum);
    }

    fn write_to(&self, bodies: &mut Bodies<T>) {
        for (body_idx, motor) in self.motor.iter().enumerate() {
            bodies.position[body_idx] = self.position(body_idx);
            bodies.rotor[body_idx] = motor.rotor();
        }
        bodies.momentum.clone_from(&self.momentum);
        bodies.angular_momentum.clone_from(&self.angular_momentum);
    }

    fn zero_rates(&self) -> Rates<T> {
        let n = self.motor.len();
        Rates {
            even: vec![Even::default(); n],
            odd: vec![Odd::default(); n],
            momentum: vec![Vector::default(); n],
            angular_momentum: vec![Bivector::default(); n],
        }
    }

    fn len(&self) -> usize {
        self.motor.len()
    }

    #[inline]
    fn position(&self, body_idx: usize) -> Point<f64> {
        let (r, m) = parts(self.motor[body_idx]);
        self.anchor[body_idx].moved(translation(r, m).map(Real::to_f64))
    }

    #[inline]
    fn to_world(&self, body_idx: usize, x_body: Vector<T>) -> Vector<T> {
        turned(self.motor[body_idx].rotor(), x_body)
    }

    #[inline]
    fn velocity(&self, body_idx: usize, inertia: &Inertia<T>) -> Vector<T> {
        self.momentum[body_idx] * inertia.inv_mass
    }

    #[inline]
    fn omega_world(&self, body_idx: usize, inertia: &Inertia<T>) -> Bivector<T> {
        let rotor = self.motor[body_idx].rotor();
        turned(rotor, inertia.velocity_of(turned(rotor.rev(), self.angular_momentum[body_idx])))
    }

    fn rhs(&self, inertias: &[Inertia<T>], wrenches: &Wrenches<T>, rates: &mut Rates<T>) {
        rhs(self, inertias, wrenches, rates);
    }

    fn renormalise(&mut self) -> Result<bool, OrientationLost> {
        renormalise(self).map(|()| true)
    }
}

impl<T: Real> ode::State<T> for State<T> {
    type Rate = Rates<T>;

    fn assign(&mut self, other: &Self) {
        assign(&mut self.anchor, &other.anchor);
        assign(&mut self.motor, &other.motor);
        assign(&mut self.momentum, &other.momentum);
        assign(&mut self.angular_momentum, &other.angular_momentum);
    }

    fn add_scaled(&mut self, terms: &[(T, &Rates<T>)]) {
        // A stage may leave the unit motors; `renormalise` brings the step back.
        let turned = |motor: &mut Motor<T>, by: Even<T>| {
            let (r, m) = parts(*motor);
            *motor = joined(Rotor::new(r.s + by.s, r.e23 + by.e23, r.e31 + by.e31, r.e12 + by.e12), m);
        };
        let moved = |motor: &mut Motor<T>, by: Odd<T>| {
            let (r, m) = parts(*motor);
            *motor = joined(r, m + by);
        };
        add_scaled(&mut self.motor, terms, |rates| &rates.even, |k, h| k * h, turned);
        add_scaled(&mut self.motor, terms, |rates| &rates.odd, |k, h| k * h, moved);
        add_scaled(&mut self.momentum, terms, |rates| &rates.momentum, |k, h| k * h, |p, by| *p += by);
        add_scaled(&mut self.angular_momentum, terms, |rates| &rates.angular_momentum, |k, h| k * h, |l, by| *l += by);
    }
}

/// `sum h_i k_i` for one body.
struct Change<T> {
    even: Even<T>,
    odd: Odd<T>,
    momentum: Vector<T>,
    angular_momentum: Bivector<T>,
}

impl<T: Real> Change<T> {
    #[inline]
    fn new(terms: &[(T, &Rates<T>)], body_idx: usize) -> Self {
        let none = Self {
            even: Even::default(),
            odd: Odd::default(),
            momentum: Vector::default(),
            angular_momentum: Bivector::default(),
        };
        terms.iter().fold(none, |sum, (h, rates)| Self {
            even: sum.even + rates.even[body_idx] * *h,
            odd: sum.odd + rates.odd[body_idx] * *h,
            momentum: sum.momentum + rates.momentum[body_idx] * *h,
            angular_momentum: sum.angular_momentum + rates.angular_momentum[body_idx] * *h,
        })
    }
}

impl<T: Real> Controlled<T> for State<T> {
    /// Number by number: rotors, translations in m by what m moves them, momenta. Positions count as in the other
    /// formulations: those of the world.
    fn error_ratio(&self, next: &Self, terms: &[(T, &Rates<T>)], tolerance: Tolerance<T>) -> T {
        let mut worst = Worst::new(tolerance);
        for body_idx in 0..self.motor.len() {
            let error = Change::new(terms, body_idx);
            let (r, _) = parts(self.motor[body_idx]);
            let x = |at: &Self| at.position(body_idx).position().map(T::from_f64).into();
            worst.take::<3>(translation(r, error.odd).into(), x(self), x(next));
            let four = |at: &Self| Even::from(at.motor[body_idx].rotor()).into();
            worst.take::<4>(error.even.into(), four(self), four(next));
            worst.take::<3>(error.momentum.into(), self.momentum[body_idx].into(), next.momentum[body_idx].into());
            let spin = |at: &Self| at.angular_momentum[body_idx].into();
            worst.take::<3>(error.angular_momentum.into(), spin(self), spin(next));
        }
        worst.ratio()
    }
}

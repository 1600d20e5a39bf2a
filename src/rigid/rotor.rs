//! The G(3,0) rotor formulation of rigid motion (report, equations 35 and 36, with the frames corrected):
//!
//! ```text
//! xdot = p / m     Rdot = -1/2 R Omega_body     pdot = F     Ldot = tau = r ^ F     Omega_body = I^-1 (~R L R)
//! ```
//!
//! Its state is [`Bodies`]. L and p are exact where no force acts.

use super::sums::{add_scaled, assign};
use super::{Bodies, Formulation, Inertia, MotionError, OrientationLost, System, Wrenches};
use crate::algebra::cga::Point;
use crate::algebra::g3::{Bivector, Even, Rotor, Vector};
use crate::algebra::{Apply, Real};
use crate::ode::{Controlled, Rk4, RungeKutta, State, Tolerance};
use alloc::vec;
use alloc::vec::Vec;
use core::ops::{Add, Div, Sub};

/// The rate of change of every array of [`Bodies`].
#[derive(Clone, Debug, Default)]
pub struct Rates<T> {
    /// xdot, m/s.
    pub position: Vec<Vector<T>>,
    /// Rdot, as four numbers, 1/s.
    pub rotor: Vec<Even<T>>,
    /// Force, N.
    pub momentum: Vec<Vector<T>>,
    /// Torque about the centre of mass, N m.
    pub angular_momentum: Vec<Bivector<T>>,
}

impl<T: Real> Rates<T> {
    /// Zero rates of `n` bodies.
    #[must_use]
    pub fn zeros(n: usize) -> Self {
        Self {
            position: vec![Vector::default(); n],
            rotor: vec![Even::default(); n],
            momentum: vec![Vector::default(); n],
            angular_momentum: vec![Bivector::default(); n],
        }
    }
}

/// The equations of motion, for every body.
pub fn rhs<T: Real>(bodies: &Bodies<T>, inertias: &[Inertia<T>], wrenches: &Wrenches<T>, rates: &mut Rates<T>) {
    let (minus_half, n) = (T::ratio(-1, 2), inertias.len());
    let (rotor, momentum) = (&bodies.rotor[..n], &bodies.momentum[..n]);
    let angular_momentum = &bodies.angular_momentum[..n];
    let (xdot, rdot) = (&mut rates.position[..n], &mut rates.rotor[..n]);
    for (i, inertia) in inertias.iter().enumerate() {
        let (r, l) = (rotor[i], angular_momentum[i]);
        let norm_sq = Even::from(r).norm_sq();
        // ~R L R, of a stage that is no unit rotor: see `turned`. Its square norm is divided out with the half.
        let momentum_body = r.rev().apply(l) + l * (norm_sq - T::one());
        xdot[i] = momentum[i] * inertia.inv_mass;
        rdot[i] = r * (inertia.velocity_of(momentum_body) * (minus_half / norm_sq));
    }
    rates.momentum.copy_from_slice(&wrenches.force);
    rates.angular_momentum.copy_from_slice(&wrenches.torque);
}

/// `R x ~R / (R ~R)`: the rotation that a rotor stands for, whatever its norm, of a vector or bivector.
///
/// The stages of a Runge-Kutta step are off the unit rotors by `(h Omega)²/16`, and [`Rotor::apply`] takes a rotor for a unit one:
/// it returns `R x ~R - (R ~R - 1) x`. Both would be of the order of the method, but with that RK4 errs 86 times as much
/// after 100 s of the tennis racket, at 0.01 rad a step. As it is, rates of R and of a multiple of it are of one rotation, and
/// bringing rotors back to unit norm changes nothing of the motion.
#[inline]
pub(super) fn turned<T: Real, X>(rotor: Rotor<T>, x: X) -> X
where
    X: Copy + Add<Output = X> + Sub<Output = X> + Div<T, Output = X>,
    Rotor<T>: Apply<X, Output = X>,
{
    x + (rotor.apply(x) - x) / Even::from(rotor).norm_sq()
}

/// Brings every rotor back to unit norm.
///
/// # Errors
/// A rotor whose numbers overflowed or vanished.
pub fn renormalise<T: Real>(bodies: &mut Bodies<T>) -> Result<(), OrientationLost> {
    for (body_idx, rotor) in bodies.rotor.iter_mut().enumerate() {
        let lost = |_| OrientationLost { body_idx, reason: "its rotor has no norm" };
        *rotor = rotor.renormalise().map_err(lost)?;
    }
    Ok(())
}

/// One step of classical RK4, then [`renormalise`].
///
/// # Errors
/// A rotor whose numbers overflowed or vanished.
pub fn advance<T: Real>(
    bodies: &mut Bodies<T>,
    rk4: &mut RungeKutta<Rk4, Bodies<T>, T>,
    system: &mut System<T>,
    t_s: f64,
    h_s: f64,
) -> Result<(), MotionError> {
    rk4.step(bodies, t_s, h_s, system)?;
    renormalise(bodies).map_err(|source| MotionError::Orientation { time_s: t_s + h_s, source })
}

impl<T: Real> Formulation<T> for Bodies<T> {
    fn from_bodies(bodies: &Self) -> Self {
        bodies.clone()
    }

    fn read_from(&mut self, bodies: &Self) {
        self.assign(bodies);
    }

    fn write_to(&self, bodies: &mut Self) {
        bodies.assign(self);
    }

    fn zero_rates(&self) -> Rates<T> {
        Rates::zeros(self.len())
    }

    fn len(&self) -> usize {
        self.position.len()
    }

    #[inline]
    fn position(&self, body_idx: usize) -> Point<f64> {
        self.position[body_idx]
    }

    #[inline]
    fn to_world(&self, body_idx: usize, x_body: Vector<T>) -> Vector<T> {
        turned(self.rotor[body_idx], x_body)
    }

    #[inline]
    fn velocity(&self, body_idx: usize, inertia: &Inertia<T>) -> Vector<T> {
        Self::velocity(self, body_idx, inertia)
    }

    #[inline]
    fn omega_world(&self, body_idx: usize, inertia: &Inertia<T>) -> Bivector<T> {
        let rotor = self.rotor[body_idx];
        turned(rotor, inertia.velocity_of(turned(rotor.rev(), self.angular_momentum[body_idx])))
    }

    fn rhs(&self, inertias: &[Inertia<T>], wrenches: &Wrenches<T>, rates: &mut Rates<T>) {
        rhs(self, inertias, wrenches, rates);
    }

    fn renormalise(&mut self) -> Result<bool, OrientationLost> {
        renormalise(self).map(|()| true)
    }
}

impl<T: Real> State<T> for Bodies<T> {
    type Rate = Rates<T>;

    fn assign(&mut self, other: &Self) {
        assign(&mut self.position, &other.position);
        assign(&mut self.rotor, &other.rotor);
        assign(&mut self.momentum, &other.momentum);
        assign(&mut self.angular_momentum, &other.angular_momentum);
        // Nearly always there are none.
        if !(self.matrix.is_empty() && other.matrix.is_empty()) {
            assign(&mut self.matrix, &other.matrix);
        }
    }

    fn add_scaled(&mut self, terms: &[(T, &Rates<T>)]) {
        let moved = |x: &mut Point<f64>, by: Vector<T>| *x = x.moved(by.map(Real::to_f64));
        add_scaled(&mut self.position, terms, |rates| &rates.position, |k, h| k * h, moved);
        // A stage may leave the unit rotors; `renormalise` brings the step back.
        let turned = |r: &mut Rotor<T>, by: Even<T>| {
            *r = Rotor::new(r.s + by.s, r.e23 + by.e23, r.e31 + by.e31, r.e12 + by.e12);
        };
        add_scaled(&mut self.rotor, terms, |rates| &rates.rotor, |k, h| k * h, turned);
        add_scaled(&mut self.momentum, terms, |rates| &rates.momentum, |k, h| k * h, |p, by| *p += by);
        add_scaled(&mut self.angular_momentum, terms, |rates| &rates.angular_momentum, |k, h| k * h, |l, by| *l += by);
    }
}

/// `sum h_i k_i` for one body.
struct Change<T> {
    position: Vector<T>,
    rotor: Even<T>,
    momentum: Vector<T>,
    angular_momentum: Bivector<T>,
}

impl<T: Real> Change<T> {
    #[inline]
    fn new(terms: &[(T, &Rates<T>)], body_idx: usize) -> Self {
        let zero = Self {
            position: Vector::default(),
            rotor: Even::default(),
            momentum: Vector::default(),
            angular_momentum: Bivector::default(),
        };
        terms.iter().fold(zero, |sum, (h, rates)| Self {
            position: sum.position + rates.position[body_idx] * *h,
            rotor: sum.rotor + rates.rotor[body_idx] * *h,
            momentum: sum.momentum + rates.momentum[body_idx] * *h,
            angular_momentum: sum.angular_momentum + rates.angular_momentum[body_idx] * *h,
        })
    }
}

impl<T: Real> Controlled<T> for Bodies<T> {
    /// Number by number: positions in m, rotors, momenta.
    fn error_ratio(&self, next: &Self, terms: &[(T, &Rates<T>)], tolerance: Tolerance<T>) -> T {
        let mut worst = Worst::new(tolerance);
        for body_idx in 0..self.position.len() {
            let error = Change::new(terms, body_idx);
            let x = |at: &Self| at.position[body_idx].position().map(T::from_f64);
            worst.take::<3>(error.position.into(), x(self).into(), x(next).into());
            worst.take::<4>(error.rotor.into(), self.rotor[body_idx].into(), next.rotor[body_idx].into());
            worst.take::<3>(error.momentum.into(), self.momentum[body_idx].into(), next.momentum[body_idx].into());
            let spin = |at: &Self| at.angular_momentum[body_idx].into();
            worst.take::<3>(error.angular_momentum.into(), spin(self), spin(next));
        }
        worst.ratio()
    }
}

/// The largest error in units of what is allowed.
pub(super) struct Worst<T> {
    tolerance: Tolerance<T>,
    worst: T,
    sum: T,
}

impl<T: Real> Worst<T> {
    pub(super) fn new(tolerance: Tolerance<T>) -> Self {
        Self { tolerance, worst: T::zero(), sum: T::zero() }
    }

    /// Takes account of numbers with errors, before and after a step.
    #[inline]
    pub(super) fn take<const N: usize>(&mut self, error: [T; N], before: [T; N], after: [T; N]) {
        for (error, (before, after)) in error.into_iter().zip(before.into_iter().zip(after)) {
            let allowed = self.tolerance.atol + self.tolerance.rtol * before.abs().max(after.abs());
            let ratio = if error == T::zero() { T::zero() } else { error.abs() / allowed };
            self.worst = self.worst.max(ratio);
            self.sum = self.sum + ratio;
        }
    }

    /// A maximum forgets what is no number, a sum does not.
    pub(super) fn ratio(&self) -> T {
        if self.sum.is_finite() { self.worst } else { self.sum }
    }
}

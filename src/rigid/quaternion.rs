//! The traditional formulation of rigid motion, with a unit quaternion for the orientation and axial vectors, on nalgebra's
//! types (Baraff 1997, *An introduction to physically based modeling*, unconstrained rigid body dynamics):
//!
//! ```text
//! xdot = p / m     qdot = 1/2 q omega_body     pdot = F     Ldot = tau = r x F     omega_body = I^-1 (q* L q)
//! ```
//!
//! Sibling of [`super::rotor`], with the same functions: `q = w + x i + y j + z k` is the rotor `w - x e23 - y e31 - z e12`,
//! and an axial vector has the components of its bivector (e23, e31, e12), so states convert without rounding.

use super::rotor::Worst;
use super::sums::{add_scaled, assign};
use super::{Bodies, Formulation, Inertia, MotionError, OrientationLost, System, Wrenches};
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::{Bivector, Rotor, Vector};
use crate::ode::{self, Controlled, Rk4, RungeKutta, Tolerance};
use alloc::vec;
use alloc::vec::Vec;
use nalgebra::{Matrix3, Point3, Quaternion, RealField, Unit, Vector3};

/// The states of all bodies. Every array has one entry a body.
#[derive(Clone, Debug, PartialEq)]
pub struct State<T: Real> {
    /// Centre of mass, world, m.
    pub position: Vec<Point3<f64>>,
    /// Orientation, body to world; of unit norm after [`renormalise`].
    pub orientation: Vec<Quaternion<T::Field>>,
    /// Momentum, kg m/s.
    pub momentum: Vec<Vector3<T::Field>>,
    /// Angular momentum about the centre of mass, world, kg m²/s.
    pub angular_momentum: Vec<Vector3<T::Field>>,
}

/// The rate of change of every array of [`State`].
#[derive(Clone, Debug)]
pub struct Rates<T: Real> {
    /// xdot, m/s.
    pub position: Vec<Vector3<T::Field>>,
    /// qdot, 1/s.
    pub orientation: Vec<Quaternion<T::Field>>,
    /// Force, N.
    pub momentum: Vec<Vector3<T::Field>>,
    /// Torque about the centre of mass, N m.
    pub angular_momentum: Vec<Vector3<T::Field>>,
}

/// The equations of motion, for every body.
pub fn rhs<T: Real>(state: &State<T>, inertias: &[Inertia<T>], wrenches: &Wrenches<T>, rates: &mut Rates<T>) {
    let (half, one, n) = (T::ratio(1, 2).to_field(), T::one().to_field(), inertias.len());
    let (orientation, momentum) = (&state.orientation[..n], &state.momentum[..n]);
    let angular_momentum = &state.angular_momentum[..n];
    let (xdot, qdot) = (&mut rates.position[..n], &mut rates.orientation[..n]);
    for (i, inertia) in inertias.iter().enumerate() {
        let q = orientation[i];
        let (l, norm_sq) = (angular_momentum[i], q.norm_squared());
        // q* L q, of a stage that is no unit quaternion: see `turned`. Its square norm is divided out with the half.
        let momentum_body = Unit::new_unchecked(q).inverse_transform_vector(&l) + l * (norm_sq - one);
        let omega_body = inverse(inertia) * momentum_body * (half / norm_sq);
        xdot[i] = momentum[i] * inertia.inv_mass.to_field();
        // The product with a quaternion that has no real part.
        let imaginary = omega_body * q.w + q.imag().cross(&omega_body);
        qdot[i] = Quaternion::from_parts(-q.imag().dot(&omega_body), imaginary);
    }
    fill(&mut rates.momentum, wrenches.force.iter().map(|force| vector(*force)));
    fill(&mut rates.angular_momentum, wrenches.torque.iter().map(|torque| axial(*torque)));
}

/// `q x q* / |q|²`: the rotation that a quaternion stands for, whatever its norm. nalgebra's formula for unit quaternions gives
/// `q x q* - (|q|² - 1) x`, with which the stages of a Runge-Kutta step err: see the rotor form.
#[inline]
fn turned<F: RealField + Copy>(q: Quaternion<F>, x: Vector3<F>) -> Vector3<F> {
    x + (Unit::new_unchecked(q) * x - x) / q.norm_squared()
}

/// Brings every quaternion back to unit norm.
///
/// # Errors
/// A quaternion whose numbers overflowed or vanished.
pub fn renormalise<T: Real>(state: &mut State<T>) -> Result<(), OrientationLost> {
    for (body_idx, q) in state.orientation.iter_mut().enumerate() {
        let norm_sq = T::from_field(q.norm_squared());
        let scale = T::one() / norm_sq.sqrt();
        // The smallest normal number times epsilon is the smallest number of all: below it digits are lost.
        if !(scale.is_finite() && norm_sq.is_finite() && norm_sq * T::EPSILON > T::zero()) {
            return Err(OrientationLost { body_idx, reason: "its quaternion has no norm" });
        }
        *q *= scale.to_field();
    }
    Ok(())
}

/// One step of classical RK4, then [`renormalise`].
///
/// # Errors
/// A quaternion whose numbers overflowed or vanished; those of the system.
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

/// The inverse inertia in the body frame; symmetric, so that rows are columns.
#[inline]
pub(super) fn inverse<T: Real>(inertia: &Inertia<T>) -> Matrix3<T::Field> {
    inertia.inv_inertia_body.map(|row| row.map(Real::to_field)).into()
}

/// A vector for nalgebra.
#[inline]
pub(super) fn vector<T: Real>(v: Vector<T>) -> Vector3<T::Field> {
    Vector3::new(v.e1.to_field(), v.e2.to_field(), v.e3.to_field())
}

/// The axial vector of a bivector.
#[inline]
pub(super) fn axial<T: Real>(b: Bivector<T>) -> Vector3<T::Field> {
    Vector3::new(b.e23.to_field(), b.e31.to_field(), b.e12.to_field())
}

/// The numbers of a vector.
#[inline]
pub(super) fn numbers<T: Real>(v: &Vector3<T::Field>) -> [T; 3] {
    [T::from_field(v.x), T::from_field(v.y), T::from_field(v.z)]
}

impl<T: Real> Formulation<T> for State<T> {
    fn from_bodies(bodies: &Bodies<T>) -> Self {
        let (position, orientation) = (Vec::new(), Vec::new());
        let mut state = Self { position, orientation, momentum: Vec::new(), angular_momentum: Vec::new() };
        state.read_from(bodies);
        state
    }

    fn read_from(&mut self, bodies: &Bodies<T>) {
        let orientation = |r: &Rotor<T>| {
            Quaternion::new(r.s.to_field(), (-r.e23).to_field(), (-r.e31).to_field(), (-r.e12).to_field())
        };
        fill(&mut self.position, bodies.position.iter().map(|x| Point3::from(*x)));
        fill(&mut self.orientation, bodies.rotor.iter().map(orientation));
        fill(&mut self.momentum, bodies.momentum.iter().map(|p| vector(*p)));
        fill(&mut self.angular_momentum, bodies.angular_momentum.iter().map(|l| axial(*l)));
    }

    fn write_to(&self, bodies: &mut Bodies<T>) {
        let rotor = |q: &Quaternion<T::Field>| {
            let [x, y, z, w] = [q.i, q.j, q.k, q.w].map(T::from_field);
            Rotor::new(w, -x, -y, -z)
        };
        fill(&mut bodies.position, self.position.iter().map(|x| Point::from(*x)));
        fill(&mut bodies.rotor, self.orientation.iter().map(rotor));
        fill(&mut bodies.momentum, self.momentum.iter().map(|p| numbers::<T>(p).into()));
        fill(&mut bodies.angular_momentum, self.angular_momentum.iter().map(|l| numbers::<T>(l).into()));
    }

    fn zero_rates(&self) -> Rates<T> {
        let (n, zero) = (self.position.len(), Vector3::zeros());
        Rates {
            position: vec![zero; n],
            orientation: vec![Quaternion::from_imag(zero); n],
            momentum: vec![zero; n],
            angular_momentum: vec![zero; n],
        }
    }

    fn len(&self) -> usize {
        self.position.len()
    }

    #[inline]
    fn position(&self, body_idx: usize) -> Point<f64> {
        self.position[body_idx].into()
    }

    #[inline]
    fn to_world(&self, body_idx: usize, x_body: Vector<T>) -> Vector<T> {
        numbers::<T>(&turned(self.orientation[body_idx], vector(x_body))).into()
    }

    #[inline]
    fn velocity(&self, body_idx: usize, inertia: &Inertia<T>) -> Vector<T> {
        numbers::<T>(&(self.momentum[body_idx] * inertia.inv_mass.to_field())).into()
    }

    #[inline]
    fn omega_world(&self, body_idx: usize, inertia: &Inertia<T>) -> Bivector<T> {
        let q = self.orientation[body_idx];
        let omega_body = inverse(inertia) * turned(q.conjugate(), self.angular_momentum[body_idx]);
        numbers::<T>(&turned(q, omega_body)).into()
    }

    fn rhs(&self, inertias: &[Inertia<T>], wrenches: &Wrenches<T>, rates: &mut Rates<T>) {
        rhs(self, inertias, wrenches, rates);
    }

    fn renormalise(&mut self) -> Result<bool, OrientationLost> {
        renormalise(self).map(|()| true)
    }
}

/// The same vector with other entries, in the storage that it has.
pub(super) fn fill<A>(array: &mut Vec<A>, entries: impl Iterator<Item = A>) {
    array.clear();
    array.extend(entries);
}

impl<T: Real> ode::State<T> for State<T> {
    type Rate = Rates<T>;

    fn assign(&mut self, other: &Self) {
        assign(&mut self.position, &other.position);
        assign(&mut self.orientation, &other.orientation);
        assign(&mut self.momentum, &other.momentum);
        assign(&mut self.angular_momentum, &other.angular_momentum);
    }

    fn add_scaled(&mut self, terms: &[(T, &Rates<T>)]) {
        let times = |k: Vector3<T::Field>, h: T| k * h.to_field();
        let moved = |x: &mut Point3<f64>, by| *x += Vector3::from(numbers::<T>(&by).map(Real::to_f64));
        add_scaled(&mut self.position, terms, |rates| &rates.position, times, moved);
        // A stage may leave the unit quaternions; `renormalise` brings the step back.
        let turned = |k: Quaternion<T::Field>, h: T| k * h.to_field();
        add_scaled(&mut self.orientation, terms, |rates| &rates.orientation, turned, |y, by| *y += by);
        add_scaled(&mut self.momentum, terms, |rates| &rates.momentum, times, |y, by| *y += by);
        add_scaled(&mut self.angular_momentum, terms, |rates| &rates.angular_momentum, times, |y, by| *y += by);
    }
}

/// `sum h_i k_i` for one body.
struct Change<T: Real> {
    position: Vector3<T::Field>,
    orientation: Quaternion<T::Field>,
    momentum: Vector3<T::Field>,
    angular_momentum: Vector3<T::Field>,
}

impl<T: Real> Change<T> {
    #[inline]
    fn new(terms: &[(T, &Rates<T>)], body_idx: usize) -> Self {
        let zero = Vector3::zeros();
        let orientation = Quaternion::from_imag(zero);
        let none = Self { position: zero, orientation, momentum: zero, angular_momentum: zero };
        terms.iter().map(|(h, rates)| (h.to_field(), rates)).fold(none, |sum, (h, rates)| Self {
            position: sum.position + rates.position[body_idx] * h,
            orientation: sum.orientation + rates.orientation[body_idx] * h,
            momentum: sum.momentum + rates.momentum[body_idx] * h,
            angular_momentum: sum.angular_momentum + rates.angular_momentum[body_idx] * h,
        })
    }
}

impl<T: Real> Controlled<T> for State<T> {
    /// Number by number: positions in m, quaternions, momenta.
    fn error_ratio(&self, next: &Self, terms: &[(T, &Rates<T>)], tolerance: Tolerance<T>) -> T {
        let mut worst = Worst::new(tolerance);
        let four = |q: &Quaternion<T::Field>| [q.i, q.j, q.k, q.w].map(T::from_field);
        for body_idx in 0..self.position.len() {
            let error = Change::new(terms, body_idx);
            let x = |at: &Self| <[f64; 3]>::from(at.position[body_idx]).map(T::from_f64);
            worst.take(numbers(&error.position), x(self), x(next));
            let q = |at: &Self| four(&at.orientation[body_idx]);
            worst.take(four(&error.orientation), q(self), q(next));
            let p = |at: &Self| numbers(&at.momentum[body_idx]);
            worst.take(numbers(&error.momentum), p(self), p(next));
            let l = |at: &Self| numbers(&at.angular_momentum[body_idx]);
            worst.take(numbers(&error.angular_momentum), l(self), l(next));
        }
        worst.ratio()
    }
}

//! The rotation matrix formulation of rigid motion (report, equations 27 to 34, with (31) corrected to `R I R^T`):
//!
//! ```text
//! xdot = p / m     Rdot = omega* R = R omega_body*     pdot = F     Ldot = tau = r x F     omega_body = I^-1 R^T L
//! ```
//!
//! with `omega*` the matrix of the cross product (32). Nine numbers hold three degrees of freedom, and nothing in the
//! equation pulls the other six back: the columns lose their length and their right angles step by step, and the body is
//! distorted with them (the report's footnote 17). This is here to be seen: [`advance`] leaves the matrix as it comes out.
//! [`renormalise`] makes it the nearest rotation; no run calls it, the study does.
//!
//! Sibling of [`super::quaternion`] and [`super::rotor`], with the same functions. It shares its vectors with the former.

use super::quaternion::{axial, fill, inverse, numbers, vector};
use super::rotor::Worst;
use super::sums::{add_scaled, assign};
use super::{Bodies, Formulation, Inertia, MotionError, OrientationLost, System, Wrenches};
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::{Bivector, Rotor, Vector};
use crate::ode::{self, Controlled, Rk4, RungeKutta, Tolerance};
use alloc::vec;
use alloc::vec::Vec;
use nalgebra::{Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};

/// The states of all bodies. Every array has one entry a body.
#[derive(Clone, Debug, PartialEq)]
pub struct State<T: Real> {
    /// Centre of mass, world, m.
    pub position: Vec<Point3<f64>>,
    /// Orientation, body to world: the columns are the body's axes in the world. A rotation only as long as nothing drifts.
    pub orientation: Vec<Matrix3<T::Field>>,
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
    /// Rdot, 1/s.
    pub orientation: Vec<Matrix3<T::Field>>,
    /// Force, N.
    pub momentum: Vec<Vector3<T::Field>>,
    /// Torque about the centre of mass, N m.
    pub angular_momentum: Vec<Vector3<T::Field>>,
}

/// The equations of motion, for every body.
pub fn rhs<T: Real>(state: &State<T>, inertias: &[Inertia<T>], wrenches: &Wrenches<T>, rates: &mut Rates<T>) {
    let n = inertias.len();
    let (orientation, momentum) = (&state.orientation[..n], &state.momentum[..n]);
    let angular_momentum = &state.angular_momentum[..n];
    let (xdot, rdot) = (&mut rates.position[..n], &mut rates.orientation[..n]);
    for (i, inertia) in inertias.iter().enumerate() {
        let r = orientation[i];
        let w = inverse(inertia) * r.tr_mul(&angular_momentum[i]);
        let (x, y, z) = (r.column(0), r.column(1), r.column(2));
        xdot[i] = momentum[i] * inertia.inv_mass.to_field();
        // R omega_body*, without the products with its zeros.
        rdot[i] = Matrix3::from_columns(&[y * w.z - z * w.y, z * w.x - x * w.z, x * w.y - y * w.x]);
    }
    fill(&mut rates.momentum, wrenches.force.iter().map(|force| vector(*force)));
    fill(&mut rates.angular_momentum, wrenches.torque.iter().map(|torque| axial(*torque)));
}

/// `I^-1 R^T L`, rad/s.
#[inline]
fn omega_body<T: Real>(state: &State<T>, body_idx: usize, inertia: &Inertia<T>) -> Vector3<T::Field> {
    inverse(inertia) * state.orientation[body_idx].tr_mul(&state.angular_momentum[body_idx])
}

/// Brings every matrix to the nearest rotation.
///
/// # Errors
/// A matrix that has come so far that there is none: singular, mirrored, or not finite.
pub fn renormalise<T: Real>(state: &mut State<T>) -> Result<(), OrientationLost> {
    for (body_idx, r) in state.orientation.iter_mut().enumerate() {
        let lost = OrientationLost { body_idx, reason: "its matrix is singular, mirrored or not finite" };
        *r = nearest_rotation::<T>(r).ok_or(lost)?;
    }
    Ok(())
}

/// Sweeps of a singular value decomposition of 3 x 3 numbers: a handful converge.
const MAX_SWEEPS: usize = 100;

/// The rotation with the least sum of squared differences of its entries (the orthogonal factor of the polar
/// decomposition); none where the determinant is not positive.
fn nearest_rotation<T: Real>(r: &Matrix3<T::Field>) -> Option<Matrix3<T::Field>> {
    let determinant = T::from_field(r.determinant());
    if !(determinant > T::zero() && r.iter().all(|x| T::from_field(*x).is_finite())) {
        return None;
    }
    let factors = r.try_svd(true, true, T::EPSILON.to_field(), MAX_SWEEPS)?;
    Some(factors.u? * factors.v_t?)
}

/// How far a matrix is from a rotation: the largest entry of `R^T R - 1`.
#[must_use]
pub fn drift<T: Real>(r: &Matrix3<T::Field>) -> T {
    T::from_field((r.tr_mul(r) - Matrix3::identity()).amax())
}

/// One step of classical RK4, and nothing else.
///
/// # Errors
/// Those of the system.
pub fn advance<T: Real>(
    state: &mut State<T>,
    rk4: &mut RungeKutta<Rk4, State<T>, T>,
    system: &mut System<T>,
    t_s: f64,
    h_s: f64,
) -> Result<(), MotionError> {
    rk4.step(state, t_s, h_s, system)
}

impl<T: Real> Formulation<T> for State<T> {
    fn from_bodies(bodies: &Bodies<T>) -> Self {
        let (position, orientation) = (Vec::new(), Vec::new());
        let mut state = Self { position, orientation, momentum: Vec::new(), angular_momentum: Vec::new() };
        state.read_from(bodies);
        state
    }

    /// The matrices of a run so far, distorted as they are, or those of the rotors.
    fn read_from(&mut self, bodies: &Bodies<T>) {
        if bodies.matrix.len() == bodies.len() {
            fill(&mut self.orientation, bodies.matrix.iter().map(|r| r.map(Real::to_field)));
        } else {
            fill(&mut self.orientation, bodies.rotor.iter().map(|rotor| matrix_of(*rotor)));
        }
        fill(&mut self.position, bodies.position.iter().map(|x| Point3::from(*x)));
        fill(&mut self.momentum, bodies.momentum.iter().map(|p| vector(*p)));
        fill(&mut self.angular_momentum, bodies.angular_momentum.iter().map(|l| axial(*l)));
    }

    fn write_to(&self, bodies: &mut Bodies<T>) {
        fill(&mut bodies.matrix, self.orientation.iter().map(|r| r.map(T::from_field)));
        fill(&mut bodies.position, self.position.iter().map(|x| Point::from(*x)));
        fill(&mut bodies.momentum, self.momentum.iter().map(|p| numbers::<T>(p).into()));
        fill(&mut bodies.angular_momentum, self.angular_momentum.iter().map(|l| numbers::<T>(l).into()));
        for (rotor, r) in bodies.rotor.iter_mut().zip(&self.orientation) {
            // `renormalise` of the trait has refused what has no nearest rotation.
            if let Some(r) = nearest_rotation::<T>(r) {
                *rotor = rotor_of(r);
            }
        }
    }

    fn zero_rates(&self) -> Rates<T> {
        let (n, zero) = (self.position.len(), Vector3::zeros());
        Rates {
            position: vec![zero; n],
            orientation: vec![Matrix3::zeros(); n],
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
        numbers::<T>(&(self.orientation[body_idx] * vector(x_body))).into()
    }

    #[inline]
    fn velocity(&self, body_idx: usize, inertia: &Inertia<T>) -> Vector<T> {
        numbers::<T>(&(self.momentum[body_idx] * inertia.inv_mass.to_field())).into()
    }

    #[inline]
    fn omega_world(&self, body_idx: usize, inertia: &Inertia<T>) -> Bivector<T> {
        numbers::<T>(&(self.orientation[body_idx] * omega_body(self, body_idx, inertia))).into()
    }

    fn rhs(&self, inertias: &[Inertia<T>], wrenches: &Wrenches<T>, rates: &mut Rates<T>) {
        rhs(self, inertias, wrenches, rates);
    }

    /// Changes nothing: the drift is to be seen.
    ///
    /// # Errors
    /// A matrix that has drifted so far that no rotation is the nearest.
    fn renormalise(&mut self) -> Result<bool, OrientationLost> {
        let positive = |r: &Matrix3<T::Field>| T::from_field(r.determinant()) > T::zero();
        match self.orientation.iter().position(|r| !positive(r)) {
            Some(body_idx) => {
                Err(OrientationLost { body_idx, reason: "its matrix is singular, mirrored or not finite" })
            }
            None => Ok(false),
        }
    }
}

/// The columns are the images of the axes.
fn matrix_of<T: Real>(rotor: Rotor<T>) -> Matrix3<T::Field> {
    let axis = |i: usize| vector(rotor.apply(Vector::from(core::array::from_fn(|j| T::ratio(i32::from(i == j), 1)))));
    Matrix3::from_columns(&[axis(0), axis(1), axis(2)])
}

/// Of both rotors of a rotation, nalgebra's choice.
fn rotor_of<T: Real>(rotation: Matrix3<T::Field>) -> Rotor<T> {
    let q = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation));
    let [x, y, z, w] = [q.i, q.j, q.k, q.w].map(T::from_field);
    Rotor::new(w, -x, -y, -z)
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
        let turned = |k: Matrix3<T::Field>, h: T| k * h.to_field();
        add_scaled(&mut self.orientation, terms, |rates| &rates.orientation, turned, |y, by| *y += by);
        add_scaled(&mut self.momentum, terms, |rates| &rates.momentum, times, |y, by| *y += by);
        add_scaled(&mut self.angular_momentum, terms, |rates| &rates.angular_momentum, times, |y, by| *y += by);
    }
}

/// `sum h_i k_i` for one body.
struct Change<T: Real> {
    position: Vector3<T::Field>,
    orientation: Matrix3<T::Field>,
    momentum: Vector3<T::Field>,
    angular_momentum: Vector3<T::Field>,
}

impl<T: Real> Change<T> {
    #[inline]
    fn new(terms: &[(T, &Rates<T>)], body_idx: usize) -> Self {
        let zero = Vector3::zeros();
        let none = Self { position: zero, orientation: Matrix3::zeros(), momentum: zero, angular_momentum: zero };
        terms.iter().map(|(h, rates)| (h.to_field(), rates)).fold(none, |sum, (h, rates)| Self {
            position: sum.position + rates.position[body_idx] * h,
            orientation: sum.orientation + rates.orientation[body_idx] * h,
            momentum: sum.momentum + rates.momentum[body_idx] * h,
            angular_momentum: sum.angular_momentum + rates.angular_momentum[body_idx] * h,
        })
    }
}

impl<T: Real> Controlled<T> for State<T> {
    /// Number by number: positions in m, matrices, momenta.
    fn error_ratio(&self, next: &Self, terms: &[(T, &Rates<T>)], tolerance: Tolerance<T>) -> T {
        let mut worst = Worst::new(tolerance);
        for body_idx in 0..self.position.len() {
            let error = Change::new(terms, body_idx);
            let x = |at: &Self| <[f64; 3]>::from(at.position[body_idx]).map(T::from_f64);
            worst.take(numbers(&error.position), x(self), x(next));
            for column in 0..3 {
                let entries = |r: &Matrix3<T::Field>| numbers::<T>(&r.column(column).into());
                let (before, after) = (&self.orientation[body_idx], &next.orientation[body_idx]);
                worst.take(entries(&error.orientation), entries(before), entries(after));
            }
            let p = |at: &Self| numbers(&at.momentum[body_idx]);
            worst.take(numbers(&error.momentum), p(self), p(next));
            let l = |at: &Self| numbers(&at.angular_momentum[body_idx]);
            worst.take(numbers(&error.angular_momentum), l(self), l(next));
        }
        worst.ratio()
    }
}

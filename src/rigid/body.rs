//! The state of all bodies as a structure of arrays, and what stays constant: masses and inertias.
//!
//! World positions are f64, everything relative is `T`. The body frame has the axes of the shape; its origin is the
//! centre of mass. Bivector components (e23, e31, e12) read like those of the axial vector, so the inertia matrix is
//! the usual one of vector mechanics (the report's equation 37 is in another basis).

use crate::algebra::Real;
use crate::algebra::cga::{Motor, Point};
use crate::algebra::g3::{Bivector, Rotor, Vector};
use crate::ode::State;
use alloc::vec::Vec;
use thiserror::Error;

/// Why a body cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum BodyError {
    /// Not positive or not finite.
    #[error("mass {0} kg: a mass is positive and finite; make the body `fixed` to hold it in place")]
    Mass(f64),
    /// No inverse within rounding.
    #[error("the inertia {0:?} kg m² has no inverse: a body needs three positive principal moments")]
    SingularInertia([[f64; 3]; 3]),
}

/// Mass and inertia of a body, inverted once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertia<T> {
    /// Mass, kg; 0 for an immovable body, which has no use for it.
    pub mass: T,
    /// 1 / mass; 0 means immovable.
    pub inv_mass: T,
    /// Inertia about the centre of mass in the body frame, kg m².
    pub inertia_body: [[T; 3]; 3],
    /// Its inverse; 0 means that nothing turns the body.
    pub inv_inertia_body: [[T; 3]; 3],
}

impl<T: Real> Inertia<T> {
    /// From mass and inertia in f64; the inverse is formed in f64 as well.
    ///
    /// # Errors
    /// A mass that is not positive, an inertia without inverse.
    pub fn new(mass_kg: f64, inertia_kg_m2: [[f64; 3]; 3]) -> Result<Self, BodyError> {
        if !(mass_kg > 0.0 && mass_kg.is_finite()) {
            return Err(BodyError::Mass(mass_kg));
        }
        let matrix = nalgebra::Matrix3::from_fn(|row, column| inertia_kg_m2[row][column]);
        let inverse = matrix.cholesky().map(|factor| factor.inverse());
        let inverse = inverse.filter(|inverse| inverse.iter().all(|x| x.is_finite()));
        let inverse = inverse.ok_or(BodyError::SingularInertia(inertia_kg_m2))?;
        let cast =
            |f: &dyn Fn(usize, usize) -> f64| core::array::from_fn(|r| core::array::from_fn(|c| T::from_f64(f(r, c))));
        Ok(Self {
            mass: T::from_f64(mass_kg),
            inv_mass: T::from_f64(1.0 / mass_kg),
            inertia_body: cast(&|r, c| inertia_kg_m2[r][c]),
            inv_inertia_body: cast(&|r, c| inverse[(r, c)]),
        })
    }

    /// A body that nothing moves.
    #[must_use]
    pub fn immovable() -> Self {
        let zero = [[T::zero(); 3]; 3];
        Self { mass: T::zero(), inv_mass: T::zero(), inertia_body: zero, inv_inertia_body: zero }
    }

    /// `L_body` from `Omega_body`.
    #[inline]
    #[must_use]
    pub fn momentum_of(&self, omega_body: Bivector<T>) -> Bivector<T> {
        map(&self.inertia_body, omega_body)
    }

    /// `Omega_body` from `L_body`.
    #[inline]
    #[must_use]
    pub fn velocity_of(&self, momentum_body: Bivector<T>) -> Bivector<T> {
        map(&self.inv_inertia_body, momentum_body)
    }
}

#[inline]
fn map<T: Real>(m: &[[T; 3]; 3], b: Bivector<T>) -> Bivector<T> {
    let row = |r: &[T; 3]| r[0] * b.e23 + r[1] * b.e31 + r[2] * b.e12;
    Bivector::new(row(&m[0]), row(&m[1]), row(&m[2]))
}

/// The states of all bodies. Every array has one entry a body.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Bodies<T> {
    /// Centre of mass, world, m.
    pub position: Vec<Point<f64>>,
    /// Orientation, body to world.
    pub rotor: Vec<Rotor<T>>,
    /// Momentum, kg m/s.
    pub momentum: Vec<Vector<T>>,
    /// Angular momentum about the centre of mass, world, kg m²/s.
    pub angular_momentum: Vec<Bivector<T>>,
}

impl<T: Real> Bodies<T> {
    /// The number of bodies.
    #[must_use]
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Are there none?
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Bytes of state a body.
    #[must_use]
    pub fn bytes_per_body() -> usize {
        size_of::<Point<f64>>() + size_of::<Rotor<T>>() + size_of::<Vector<T>>() + size_of::<Bivector<T>>()
    }

    /// Adds a body.
    pub fn push(&mut self, position: Point<f64>, rotor: Rotor<T>, momentum: Vector<T>, angular_momentum: Bivector<T>) {
        self.position.push(position);
        self.rotor.push(rotor);
        self.momentum.push(momentum);
        self.angular_momentum.push(angular_momentum);
    }

    /// `Omega_world = R (I^-1 (~R L R)) ~R`, rad/s.
    #[must_use]
    pub fn omega_world(&self, body_idx: usize, inertia: &Inertia<T>) -> Bivector<T> {
        self.rotor[body_idx].apply(self.omega_body(body_idx, inertia))
    }

    /// `Omega_body = I^-1 (~R L R)`, rad/s.
    #[inline]
    #[must_use]
    pub fn omega_body(&self, body_idx: usize, inertia: &Inertia<T>) -> Bivector<T> {
        inertia.velocity_of(self.rotor[body_idx].rev().apply(self.angular_momentum[body_idx]))
    }

    /// Velocity of the centre of mass, m/s.
    #[must_use]
    pub fn velocity(&self, body_idx: usize, inertia: &Inertia<T>) -> Vector<T> {
        self.momentum[body_idx] * inertia.inv_mass
    }

    /// The motor that takes the frame of body `b` to that of body `a`; the difference of positions is taken in f64.
    #[must_use]
    pub fn relative_pose(&self, a: usize, b: usize) -> Motor<T> {
        let to_a = self.rotor[a].rev();
        let between = self.position[a].displacement_to(self.position[b]).map(T::from_f64);
        Motor::from_parts(to_a.apply(between), to_a * self.rotor[b])
    }
}

/// The rate of change of every array of [`Bodies`].
#[derive(Clone, Debug, Default)]
pub struct Rates<T> {
    /// xdot, m/s.
    pub position: Vec<Vector<T>>,
    /// Rdot, as four numbers, 1/s.
    pub rotor: Vec<crate::algebra::g3::Even<T>>,
    /// Force, N.
    pub momentum: Vec<Vector<T>>,
    /// Torque about the centre of mass, N m.
    pub angular_momentum: Vec<Bivector<T>>,
}

impl<T: Real> Rates<T> {
    /// Zero rates of `n` bodies.
    #[must_use]
    pub fn zeros(n: usize) -> Self {
        use alloc::vec;
        Self {
            position: vec![Vector::default(); n],
            rotor: vec![crate::algebra::g3::Even::default(); n],
            momentum: vec![Vector::default(); n],
            angular_momentum: vec![Bivector::default(); n],
        }
    }
}

impl<T: Real> State<T> for Bodies<T> {
    type Rate = Rates<T>;

    fn assign(&mut self, other: &Self) {
        self.position.clone_from(&other.position);
        self.rotor.clone_from(&other.rotor);
        self.momentum.clone_from(&other.momentum);
        self.angular_momentum.clone_from(&other.angular_momentum);
    }

    fn add_scaled(&mut self, terms: &[(T, &Rates<T>)]) {
        for body_idx in 0..self.len() {
            let moved = sum(terms, |rates| rates.position[body_idx]);
            self.position[body_idx] = self.position[body_idx].moved(moved.map(Real::to_f64));
            // A stage may leave the unit rotors; `renormalise` brings the step back.
            let turned = sum(terms, |rates| rates.rotor[body_idx]);
            let rotor = &mut self.rotor[body_idx];
            rotor.s = rotor.s + turned.s;
            rotor.e23 = rotor.e23 + turned.e23;
            rotor.e31 = rotor.e31 + turned.e31;
            rotor.e12 = rotor.e12 + turned.e12;
            self.momentum[body_idx] += sum(terms, |rates| rates.momentum[body_idx]);
            self.angular_momentum[body_idx] += sum(terms, |rates| rates.angular_momentum[body_idx]);
        }
    }
}

/// `sum h_i k_i` of one part of the rates.
#[inline]
fn sum<T, K>(terms: &[(T, &Rates<T>)], part: impl Fn(&Rates<T>) -> K) -> K
where
    T: Real,
    K: Default + core::ops::Add<Output = K> + core::ops::Mul<T, Output = K>,
{
    terms.iter().fold(K::default(), |sum, (h, rates)| sum + part(rates) * *h)
}

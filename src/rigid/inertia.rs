//! Mass and inertia of a body, checked and inverted once.
//!
//! The inertia is about the centre of mass, in the body frame. With the second moments `C = ∫ x xᵀ dm` it is
//! `tr(C) 1 - C`, and positive mass means that C is positive semidefinite: for the principal moments the triangle
//! inequality `I1 + I2 >= I3`, with equality for a lamina. The motion needs an inverse besides, so all three are positive.
//!
//! Bivector components (e23, e31, e12) read like those of the axial vector, so the matrix is the usual one of vector
//! mechanics (the report's equation 37 is in another basis).

use crate::algebra::Real;
use crate::algebra::g3::{Bivector, Rotor};
use crate::geometry::mass_properties::principal_axes;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion};
use thiserror::Error;

/// Why a body cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum InertiaError {
    /// Not positive or not finite.
    #[error(
        "mass {0:?} kg: a mass is positive and finite, also its inverse and in the scalar that is computed with; make the body `fixed` to hold it in place"
    )]
    Mass(f64),
    /// A number that is not finite, or rows and columns that differ.
    #[error("the inertia {0:?} kg m² is not symmetric and finite; its off-diagonals are -∫xy dm")]
    NotSymmetric([[f64; 3]; 3]),
    /// No inverse within rounding.
    #[error("the inertia {0:?} kg m² has no inverse: a body needs three positive principal moments")]
    Singular([[f64; 3]; 3]),
    /// No distribution of mass has it.
    #[error(
        "principal moments {0:?} kg m²: no body has them, the two smaller ones must add up to the largest at least; \
         equality is a lamina"
    )]
    Triangle([f64; 3]),
}

/// What rounding may do to moments and to the symmetry of the matrix, relative to its largest entry: half an ulp of each
/// number given, as much again for sums of them, a few `n eps |I|` (n = 3) of the backward stable eigenvalues; together less
/// than 16 eps, doubled for safety.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Principal moments, and the frame in which the inertia is diagonal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Principal {
    /// kg m², smallest first.
    pub moments: [f64; 3],
    /// From the principal frame to the body frame.
    pub axes: Rotor<f64>,
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
    /// Principal moments and axes; an immovable body has moments of 0.
    pub principal: Principal,
}

impl<T: Real> Inertia<T> {
    /// From mass and inertia in f64; inverse and axes are found in f64 as well.
    ///
    /// # Errors
    /// See [`InertiaError`].
    pub fn new(mass_kg: f64, inertia_kg_m2: [[f64; 3]; 3]) -> Result<Self, InertiaError> {
        let (mass, inv_mass) = (T::from_f64(mass_kg), T::from_f64(1.0 / mass_kg));
        if !(mass > T::zero() && mass.is_finite() && inv_mass > T::zero() && inv_mass.is_finite()) {
            return Err(InertiaError::Mass(mass_kg));
        }
        let principal = principal(inertia_kg_m2)?;
        let matrix = Matrix3::from_fn(|row, column| inertia_kg_m2[row][column]);
        let inverse = matrix.cholesky().map(|factor| factor.inverse());
        let inverse = inverse.filter(|inverse| inverse.iter().all(|x| T::from_f64(*x).is_finite()));
        let inverse = inverse.filter(|_| principal.moments.iter().all(|x| T::from_f64(*x).is_finite()));
        let inverse = inverse.ok_or(InertiaError::Singular(inertia_kg_m2))?;
        let cast =
            |f: &dyn Fn(usize, usize) -> f64| core::array::from_fn(|r| core::array::from_fn(|c| T::from_f64(f(r, c))));
        Ok(Self {
            mass,
            inv_mass,
            inertia_body: cast(&|r, c| inertia_kg_m2[r][c]),
            inv_inertia_body: cast(&|r, c| inverse[(r, c)]),
            principal,
        })
    }

    /// A body that nothing moves.
    #[must_use]
    pub fn immovable() -> Self {
        let zero = [[T::zero(); 3]; 3];
        let principal = Principal { moments: [0.0; 3], axes: Rotor::default() };
        Self { mass: T::zero(), inv_mass: T::zero(), inertia_body: zero, inv_inertia_body: zero, principal }
    }

    /// Whether nothing moves the body.
    #[inline]
    #[must_use]
    pub fn is_immovable(&self) -> bool {
        self.inv_mass == T::zero()
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

fn principal(inertia: [[f64; 3]; 3]) -> Result<Principal, InertiaError> {
    let largest = inertia.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let differs = |i: usize, j: usize| (inertia[i][j] - inertia[j][i]).abs() > ROUNDING * largest;
    let found = principal_axes(inertia).ok().filter(|_| !(differs(0, 1) || differs(0, 2) || differs(1, 2)));
    let found = found.ok_or(InertiaError::NotSymmetric(inertia))?;
    let [least, middle, most] = found.moments;
    // An eigenvalue that is all rounding is none; moments that are given are judged by their signs.
    let given = [(0, 1), (0, 2), (1, 2)].iter().all(|(i, j)| inertia[*i][*j] == 0.0);
    let floor = if given { 0.0 } else { ROUNDING * largest };
    if !(least > floor) {
        return Err(InertiaError::Singular(inertia));
    }
    if least + middle < most * (1.0 - ROUNDING) {
        return Err(InertiaError::Triangle(found.moments));
    }
    let columns = Matrix3::from_columns(&found.axes.map(Into::into));
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(columns));
    Ok(Principal { moments: found.moments, axes: turn.into() })
}

//! Jointed bodies as what a projection moves; their masses; what their joints are called in errors.
//!
//! Coordinates as for the rows of joints: the displacement in the world, the rotation vector along the principal axes.

use super::link::{D, Link, Pose, join, part};
use super::{Bodies, Inertia};
use crate::algebra::Real;
use crate::algebra::g3::{Bivector, Rotor, Vector};
use crate::constraint::{Configuration, InverseMass, ProjectionError, Rows, SolveError};
use alloc::vec;
use alloc::vec::Vec;

/// Masses and principal moments; 0 is immovable.
#[derive(Clone, Debug, Default)]
pub(super) struct Masses {
    mass: Vec<[f64; D]>,
    inv_mass: Vec<[f64; D]>,
}

impl Masses {
    pub(super) fn new<T: Real>(inertias: &[Inertia<T>]) -> Self {
        let mut masses = Self::default();
        for inertia in inertias {
            let mass = inertia.mass.to_f64();
            let moments = inertia.principal.moments;
            let movable = inertia.inv_mass > T::zero();
            let mass = if movable { join(Vector::from([mass; 3]), Bivector::from(moments)) } else { [0.0; D] };
            masses.mass.push(mass);
            masses.inv_mass.push(mass.map(|x| if x > 0.0 { 1.0 / x } else { 0.0 }));
        }
        masses
    }

    /// `<Omega L>_2`, along the principal axes.
    pub(super) fn gyroscopic(&self, body_idx: usize, omega: Bivector<f64>) -> Bivector<f64> {
        let [_, _, _, first, second, third] = self.mass[body_idx];
        let momentum = Bivector::new(first * omega.e23, second * omega.e31, third * omega.e12);
        let product = omega * momentum;
        Bivector::new(product.e23, product.e31, product.e12)
    }

    /// Velocities from momenta.
    pub(super) fn twist<T: Real>(&self, body_idx: usize, bodies: &Bodies<T>, pose: &Pose) -> [f64; D] {
        let (p, l) = (bodies.momentum[body_idx], bodies.angular_momentum[body_idx]);
        self.accelerate(body_idx, join(p.map(Real::to_f64), pose.plane_to_body(l.map(Real::to_f64))))
    }

    /// Adds a change of velocities, times the masses, to the momenta.
    pub(super) fn push<T: Real>(&self, body_idx: usize, bodies: &mut Bodies<T>, pose: &Pose, change: [f64; D]) {
        let (p, l) = part(core::array::from_fn(|i| self.mass[body_idx][i] * change[i]));
        bodies.momentum[body_idx] += p.map(T::from_f64);
        bodies.angular_momentum[body_idx] += pose.plane_to_world(l).map(T::from_f64);
    }
}

impl InverseMass<D> for Masses {
    #[inline]
    fn accelerate(&self, block: usize, force: [f64; D]) -> [f64; D] {
        core::array::from_fn(|i| force[i] * self.inv_mass[block][i])
    }

    fn is_fixed(&self, block: usize) -> bool {
        self.inv_mass[block] == [0.0; D]
    }
}

/// Inverse masses as if all bodies weighed 1 kg, at the farthest of their joints: a measure of bodies in which the rows of a
/// light or slender one are like those of others.
pub(super) fn equal_masses<T: Real>(links: &[Link], inertias: &[Inertia<T>]) -> Vec<[f64; D]> {
    let mut sizes_m = vec![0.0_f64; inertias.len()];
    for end in links.iter().flat_map(|link| [&link.a, &link.b]) {
        if let (Some(body_idx), Some(size_m)) = (end.body_idx, end.size_m(inertias)) {
            sizes_m[body_idx] = sizes_m[body_idx].max(size_m);
        }
    }
    let inverse = |size_m: f64| if size_m > 0.0 { size_m.powi(-2) } else { 0.0 };
    let each = sizes_m.into_iter().map(inverse);
    each.map(|turn| join(Vector::from([1.0; 3]), Bivector::from([turn; 3]))).collect()
}

/// Where the bodies are.
pub(super) fn place<T: Real>(bodies: &Bodies<T>, principal: &[Rotor<f64>], poses: &mut Vec<Pose>) {
    poses.clear();
    let each = bodies.position.iter().zip(&bodies.rotor).zip(principal);
    poses.extend(each.map(|((position, rotor), principal)| Pose::new(*position, *rotor, *principal)));
}

pub(super) fn evaluate(links: &[Link], poses: &[Pose], rows: &mut Rows<D>) {
    for link in links {
        link.evaluate(poses, rows);
    }
}

/// The worst joint, by its first row.
pub(super) fn worst(links: &[Link], poses: &[Pose]) -> Result<(usize, f64), ProjectionError> {
    let mut worst = (0, 0.0);
    for link in links {
        let violation_m = link.violation_m(poses);
        if !violation_m.is_finite() {
            return Err(SolveError::NotFinite { row: link.first_row }.into());
        }
        if violation_m > worst.1 {
            worst = (link.first_row, violation_m);
        }
    }
    Ok(worst)
}

/// The poses as what a projection moves.
pub(super) struct Poses<'a, T> {
    pub(super) links: &'a [Link],
    pub(super) principal: &'a [Rotor<f64>],
    pub(super) bodies: &'a mut Bodies<T>,
    pub(super) poses: &'a mut Vec<Pose>,
}

impl<T: Real> Configuration<D> for Poses<'_, T> {
    fn evaluate(&mut self, rows: &mut Rows<D>) {
        place(self.bodies, self.principal, self.poses);
        evaluate(self.links, self.poses, rows);
    }

    fn displace(&mut self, displacement: &[[f64; D]]) {
        for (body_idx, by) in displacement.iter().enumerate().filter(|(_, by)| **by != [0.0; D]) {
            let (moved, turned) = part(*by);
            self.bodies.displace(body_idx, moved, self.principal[body_idx].apply(turned));
        }
    }

    fn worst_violation(&self, _rows: &Rows<D>) -> Result<(usize, f64), ProjectionError> {
        worst(self.links, self.poses)
    }
}

/// Of a row, the joint.
fn joint_of(links: &[Link], row: usize) -> usize {
    links.partition_point(|link| link.first_row <= row).saturating_sub(1)
}

/// The same error, with the joint in place of the row.
pub(super) fn unsolved(links: &[Link], error: SolveError) -> SolveError {
    match error {
        SolveError::NotFinite { row } => SolveError::NotFinite { row: joint_of(links, row) },
        SolveError::Contradiction { row, excess } => SolveError::Contradiction { row: joint_of(links, row), excess },
    }
}

pub(super) fn unprojected(links: &[Link], error: ProjectionError) -> ProjectionError {
    match error {
        ProjectionError::NotConverged { row, violation_m, evaluations } => {
            ProjectionError::NotConverged { row: joint_of(links, row), violation_m, evaluations }
        }
        ProjectionError::NoGradient { row } => ProjectionError::NoGradient { row: joint_of(links, row) },
        ProjectionError::Solve(error) => ProjectionError::Solve(unsolved(links, error)),
    }
}

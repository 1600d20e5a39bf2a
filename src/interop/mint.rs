//! mint: `Vector3`, `Point3`, `Quaternion`, through which glam and most other mathematics crates are reached.

use crate::algebra::cga::Point;
use crate::algebra::g3::{Rotor, Vector};
use crate::algebra::{Real, Scalar, support};
use mint::{IntoMint, Point3, Quaternion, Vector3};

/// A quaternion that is no rotation: its norm is not 1.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the quaternion has norm squared {norm_sq}, not 1: normalise it first, or read it as Even and use Rotor::normalise"
)]
pub struct NotUnit {
    /// The sum of the squares of its numbers, as found.
    pub norm_sq: f64,
}

impl<T> From<Vector<T>> for Vector3<T> {
    #[inline]
    fn from(v: Vector<T>) -> Self {
        Self { x: v.e1, y: v.e2, z: v.e3 }
    }
}

impl<T> From<Vector3<T>> for Vector<T> {
    #[inline]
    fn from(v: Vector3<T>) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

impl<T> IntoMint for Vector<T> {
    type MintType = Vector3<T>;
}

impl<T> From<Point<T>> for Point3<T> {
    #[inline]
    fn from(point: Point<T>) -> Self {
        Self { x: point.x, y: point.y, z: point.z }
    }
}

impl<T> From<Point3<T>> for Point<T> {
    #[inline]
    fn from(point: Point3<T>) -> Self {
        Self::new(point.x, point.y, point.z)
    }
}

impl<T> IntoMint for Point<T> {
    type MintType = Point3<T>;
}

impl<T: Scalar> From<Rotor<T>> for Quaternion<T> {
    /// `w - x e23 - y e31 - z e12` as `w + x i + y j + z k`.
    #[inline]
    fn from(rotor: Rotor<T>) -> Self {
        Self { s: rotor.s, v: Vector3 { x: -rotor.e23, y: -rotor.e31, z: -rotor.e12 } }
    }
}

impl<T: Real> TryFrom<Quaternion<T>> for Rotor<T> {
    type Error = NotUnit;

    /// `w + x i + y j + z k` as `w - x e23 - y e31 - z e12`, with the bits that it has: it is checked, not normalised.
    ///
    /// # Errors
    /// A norm squared off from 1 by more than the square root of epsilon, as far as a rotor may drift.
    fn try_from(quaternion: Quaternion<T>) -> Result<Self, NotUnit> {
        let Vector3 { x, y, z } = quaternion.v;
        let rotor = Self::new(quaternion.s, -x, -y, -z);
        let norm_sq = rotor.norm_sq();
        let numbers = <[T; 4]>::from(rotor);
        if support::is_unit(&numbers, &numbers, norm_sq, &[]) {
            Ok(rotor)
        } else {
            Err(NotUnit { norm_sq: norm_sq.to_f64() })
        }
    }
}

impl<T: Scalar> IntoMint for Rotor<T> {
    type MintType = Quaternion<T>;
}

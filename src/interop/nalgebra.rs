//! nalgebra: `Vector3`, `Point3`, `UnitQuaternion`, `Isometry3`.
//!
//! From unit types to unit types, so that nothing needs a check; numbers keep their bits, but for the translation of a
//! motor, which is stored multiplied into the rotor; that of a pose is not.

use crate::algebra::Scalar;
use crate::algebra::cga::{Motor, Point, Pose};
use crate::algebra::g3::{Rotor, Vector};
use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};

impl<T: nalgebra::Scalar> From<Vector<T>> for Vector3<T> {
    #[inline]
    fn from(v: Vector<T>) -> Self {
        Self::new(v.e1, v.e2, v.e3)
    }
}

impl<T: nalgebra::Scalar> From<Vector3<T>> for Vector<T> {
    #[inline]
    fn from(v: Vector3<T>) -> Self {
        <[T; 3]>::from(v).into()
    }
}

impl<T: nalgebra::Scalar> From<Point<T>> for Point3<T> {
    #[inline]
    fn from(point: Point<T>) -> Self {
        Self::new(point.x, point.y, point.z)
    }
}

impl<T: nalgebra::Scalar> From<Point3<T>> for Point<T> {
    #[inline]
    fn from(point: Point3<T>) -> Self {
        <[T; 3]>::from(point.coords).into()
    }
}

impl<T: Scalar + nalgebra::Scalar> From<Rotor<T>> for UnitQuaternion<T> {
    /// `w - x e23 - y e31 - z e12` as `w + x i + y j + z k`.
    #[inline]
    fn from(rotor: Rotor<T>) -> Self {
        Self::new_unchecked(Quaternion::new(rotor.s, -rotor.e23, -rotor.e31, -rotor.e12))
    }
}

impl<T: Scalar + nalgebra::Scalar> From<UnitQuaternion<T>> for Rotor<T> {
    /// `w + x i + y j + z k` as `w - x e23 - y e31 - z e12`.
    #[inline]
    fn from(quaternion: UnitQuaternion<T>) -> Self {
        let [x, y, z, w] = <[T; 4]>::from(quaternion.into_inner().coords);
        Self::new(w, -x, -y, -z)
    }
}

impl<T: Scalar + nalgebra::Scalar> From<Motor<T>> for Isometry3<T> {
    /// The parts of `M = T R`.
    #[inline]
    fn from(motor: Motor<T>) -> Self {
        let translation = Translation3 { vector: motor.translation().into() };
        Self { rotation: motor.rotor().into(), translation }
    }
}

impl<T: Scalar + nalgebra::Scalar> From<Isometry3<T>> for Motor<T> {
    /// First the rotation, then the translation: `M = T R`.
    #[inline]
    fn from(isometry: Isometry3<T>) -> Self {
        Self::from_parts(isometry.translation.vector.into(), isometry.rotation.into())
    }
}

impl<T: Scalar + nalgebra::Scalar> From<Pose<T>> for Isometry3<T> {
    /// The parts of `T R`, with their bits.
    #[inline]
    fn from(pose: Pose<T>) -> Self {
        let rotor = Rotor::new(pose.s, pose.e23, pose.e31, pose.e12);
        Self { rotation: rotor.into(), translation: Translation3 { vector: Vector3::new(pose.x, pose.y, pose.z) } }
    }
}

impl<T: Scalar + nalgebra::Scalar> From<Isometry3<T>> for Pose<T> {
    /// First the rotation, then the translation, with their bits.
    #[inline]
    fn from(isometry: Isometry3<T>) -> Self {
        let ([x, y, z], rotor) = (isometry.translation.vector.into(), Rotor::from(isometry.rotation));
        Self { x, y, z, s: rotor.s, e23: rotor.e23, e31: rotor.e31, e12: rotor.e12 }
    }
}

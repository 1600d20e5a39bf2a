//! nalgebra's types: round trips, and the same action on points and vectors.

use crate::rotors;
use ga_physics::algebra::cga::{Motor, Point, Pose};
use ga_physics::algebra::g3::{Rotor, Vector};
use ga_physics::nalgebra::{Isometry3, Point3, Quaternion, UnitQuaternion, Vector3};

/// Two matrix-free rotations of a vector differ by some roundings of its length.
const ROUNDINGS: f64 = 16.0 * f64::EPSILON;

#[test]
fn vectors_points_and_rotors_keep_their_bits() {
    for numbers in [[1.0, -2.0, 0.1], [f64::MAX, f64::MIN_POSITIVE / 4.0, -0.0], [f64::INFINITY, 1e-300, f64::NAN]] {
        let bits = |v: [f64; 3]| v.map(f64::to_bits);
        let vector = Vector3::from(Vector::from(numbers));
        assert_eq!(bits(vector.into()), bits(numbers));
        assert_eq!(bits(Vector::from(vector).into()), bits(numbers));
        let point = Point3::from(Point::from(numbers));
        assert_eq!(bits(point.coords.into()), bits(numbers));
        assert_eq!(bits(Point::from(point).into()), bits(numbers));
    }
    for rotor in rotors() {
        let back = Rotor::from(UnitQuaternion::from(rotor));
        assert_eq!(<[f64; 4]>::from(back).map(f64::to_bits), <[f64; 4]>::from(rotor).map(f64::to_bits));
    }
}

#[test]
fn a_quaternion_and_its_rotor_turn_alike() {
    let quarter = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), core::f64::consts::FRAC_PI_2);
    let turned = Rotor::from(quarter).apply(Vector::new(1.0, 0.0, 0.0));
    assert!((turned.e2 - 1.0).abs() < ROUNDINGS, "x goes to y, not to -y: {turned}");
    for rotor in rotors() {
        let quaternion = UnitQuaternion::from(rotor);
        assert!((quaternion.norm() - 1.0).abs() < ROUNDINGS);
        for v in [[1.0, 2.0, 3.0], [-4.0, 0.0, 1e-5]].map(Vector::from) {
            let (ours, theirs) = (Vector3::from(rotor.apply(v)), quaternion * Vector3::from(v));
            assert!((ours - theirs).norm() <= ROUNDINGS * theirs.norm(), "{ours} {theirs}");
        }
        // Products as well: the map is an isomorphism, not a mirror of one.
        for other in rotors() {
            let product = UnitQuaternion::from(rotor * other);
            let difference: Quaternion<f64> =
                product.into_inner() - (quaternion * UnitQuaternion::from(other)).into_inner();
            assert!(difference.norm() < ROUNDINGS);
        }
    }
}

#[test]
fn an_isometry_and_its_motor_move_alike() {
    for (index, rotor) in rotors().into_iter().enumerate() {
        let size = [1.0, 1e-6, 1e6][index % 3];
        let motor = Motor::from_parts(Vector::new(3.0 * size, -size, 0.5 * size), rotor);
        let isometry = Isometry3::from(motor);
        let point = Point::new(1.0, -2.0, 0.25);
        let (ours, theirs) = (Point3::from(motor.apply(point)), isometry * Point3::from(point));
        assert!((ours - theirs).norm() <= ROUNDINGS * (theirs.coords.norm() + size), "{ours} {theirs}");
        let back = Motor::from(isometry);
        assert_eq!(back.rotor(), motor.rotor());
        let lost = Vector3::from(back.translation()) - isometry.translation.vector;
        assert!(lost.norm() <= ROUNDINGS * isometry.translation.vector.norm());
        assert!(back.is_unit(ROUNDINGS * size.max(1.0)));
        // A pose is stored as an isometry is.
        let pose = Pose::from(isometry);
        assert_eq!(Isometry3::from(pose), isometry);
        let posed = Point3::from(pose.apply(point));
        assert!((posed - theirs).norm() <= ROUNDINGS * (theirs.coords.norm() + size), "{posed} {theirs}");
    }
}

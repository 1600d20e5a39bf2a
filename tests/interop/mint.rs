//! mint, and glam through it.

use crate::rotors;
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::{Rotor, Vector};
use ga_physics::interop::NotUnit;
use mint::{IntoMint, Point3, Quaternion, Vector3};

#[test]
fn round_trips_keep_every_bit() {
    let v = Vector::new(1.0f32, -0.0, f32::MIN_POSITIVE / 2.0);
    assert_eq!(Vector::from(Vector3::from(v)), v);
    assert!(Vector::from(Vector3::from(v)).e2.is_sign_negative());
    let point = Point::new(1.0, 2.0, 1e300);
    assert_eq!(Point::from(Point3::from(point)), point);
    for rotor in rotors() {
        assert_eq!(Rotor::try_from(Quaternion::from(rotor)), Ok(rotor));
    }
    fn through<M: IntoMint>(value: M) -> M::MintType {
        value.into()
    }
    assert_eq!(through(Vector::new(1.0, 2.0, 3.0)), [1.0, 2.0, 3.0].into());
}

#[test]
fn glam_turns_alike() {
    let arrow = glam::DVec3::new(1.0, -2.0, 0.5);
    for rotor in rotors() {
        let quaternion = glam::DQuat::from(Quaternion::from(rotor));
        let ours = glam::DVec3::from(Vector3::from(rotor.apply(Vector::from(Vector3::from(arrow)))));
        assert!((ours - quaternion * arrow).length() < 1e-14, "{ours} {}", quaternion * arrow);
    }
    // glam computes in f32 for most of its users.
    let turn = glam::Quat::from_euler(glam::EulerRot::XYZ, 0.1, -2.0, 3.0);
    let rotor = Rotor::try_from(Quaternion::from(turn)).unwrap();
    assert_eq!(glam::Quat::from(Quaternion::from(rotor)), turn);
}

#[test]
fn a_quaternion_that_is_no_rotation_is_refused() {
    let refused = |s: f64, x: f64| Rotor::try_from(Quaternion { s, v: [x, 0.0, 0.0].into() }).unwrap_err();
    assert_eq!(refused(1.0, 1.0), NotUnit { norm_sq: 2.0 });
    assert_eq!(refused(0.0, 0.0), NotUnit { norm_sq: 0.0 });
    assert!(refused(f64::NAN, 0.0).norm_sq.is_nan());
    assert!(refused(f64::INFINITY, 0.0).norm_sq.is_infinite());
    assert_eq!(refused(1e200, 0.0).norm_sq, f64::INFINITY);
    assert!(refused(0.866, 0.5).to_string().contains("normalise"));
    // A sixth of a turn, cos = 0.866..: three digits are enough for f32, and not for f64.
    let sixth = |s: f32| Rotor::try_from(Quaternion { s, v: [0.5, 0.0, 0.0].into() });
    assert!(sixth(0.866).is_ok() && sixth(0.867).is_err());
    assert!(Rotor::try_from(Quaternion { s: 0.866_025_404, v: [0.5, 0.0, 0.0].into() }).is_ok());
}

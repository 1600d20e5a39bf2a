//! serde: by name in JSON, in order in a binary format; unit types are checked on the way in.

use crate::{boosts, pga, rotors};
use ga_physics::algebra::cga::{Dilator, Infinity, Motor, Multivector, Plane, Point, Pose, Sphere, Translator};
use ga_physics::algebra::g3::{Even, Rotor, Vector};
use serde::{Deserialize, Serialize, de::DeserializeOwned};

/// Both formats give the value back, number by number.
fn round_trips<V: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug>(value: V) {
    let text = serde_json::to_string(&value).unwrap();
    assert_eq!(serde_json::from_str::<V>(&text).unwrap(), value, "{text}");
    let bytes = postcard::to_allocvec(&value).unwrap();
    assert_eq!(postcard::from_bytes::<V>(&bytes).unwrap(), value);
}

#[test]
fn a_value_is_a_struct_with_the_names_of_its_fields() {
    let text = serde_json::to_string(&Even::new(1.0, 2.0, 3.0, -0.5)).unwrap();
    assert_eq!(text, r#"{"s":1.0,"e23":2.0,"e31":3.0,"e12":-0.5}"#);
    let point: Point = serde_json::from_str(r#"{"z": 3, "x": 1, "y": 2}"#).unwrap();
    assert_eq!(point, Point::new(1.0, 2.0, 3.0));
    let sphere: Sphere<f32> = serde_json::from_str("[1, 2, 3, 4]").unwrap();
    assert_eq!(sphere, Sphere::new(1.0, 2.0, 3.0, 4.0));
    assert_eq!(serde_json::to_string(&pga::Derived::new(2.0)).unwrap(), r#"{"type":2.0}"#);
    assert_eq!(postcard::to_allocvec(&Vector::new(1.0f64, 2.0, 3.0)).unwrap().len(), 24, "no names in a binary format");
}

#[test]
fn values_come_back_with_their_bits() {
    for rotor in rotors() {
        round_trips(rotor);
        round_trips(Motor::from_parts(Vector::new(1e9, -0.1, 1e-9), rotor));
    }
    round_trips(Motor::from_parts(
        Vector::new(1e30f32, 3.0, 1e-30),
        Rotor::from_axis_angle(Vector::new(1.0, 2.0, 3.0), 2.0).unwrap(),
    ));
    round_trips(Translator::by(Vector::new(1e200, 1.0, 0.1)));
    round_trips(Dilator::by(1e300).unwrap());
    round_trips(Translator::by(Vector::new(1e9, 2.0, 3.0)) * Dilator::by(1e9f64).unwrap());
    round_trips(Pose::new(1e30, 1.0, -0.1, 0.6, 0.0, -0.8, 0.0));
    round_trips(Plane::new(0.6, 0.0, -0.8, 1e12));
    round_trips(Multivector::from_fn(|i| 1.0 / (i + 1) as f64));
    round_trips(Point::new(f64::MAX, f64::MIN_POSITIVE / 8.0, -0.1));
    round_trips(Infinity);
    round_trips((pga::Infinity, pga::Point::new(0.1f32, 0.2), pga::Line::new(1, 2, 3)));
    let far = (20.0f64.cosh(), 20.0f64.sinh());
    round_trips(boosts::Boost::new(far.0, far.1));
    // Inside of a user's own struct, as a user writes it.
    #[derive(Serialize, Deserialize, PartialEq, Debug)]
    struct Anchored {
        orientation: Rotor,
        position: Point,
        anchors: Vec<Vector<f32>>,
    }
    let anchors = vec![Vector::new(1.0, 2.0, 3.0); 3];
    round_trips(Anchored { orientation: rotors()[8], position: Point::new(1.0, 2.0, 3.0), anchors });
}

#[test]
fn a_versor_that_drifted_is_still_read() {
    let step = Rotor::<f32>::from_axis_angle(Vector::new(1.0, 2.0, 3.0), 0.01).unwrap();
    let drifted = (0..1000).fold(step, |rotor, _| rotor * step);
    assert!(!drifted.is_unit(f32::EPSILON), "the test needs a rotor off by more than a rounding");
    round_trips(drifted);
}

fn refusal<V: DeserializeOwned + core::fmt::Debug>(text: &str) -> String {
    serde_json::from_str::<V>(text).unwrap_err().to_string()
}

#[test]
fn a_unit_type_that_is_not_unit_is_refused() {
    for numbers in ["[1, 1, 0, 0]", "[0, 0, 0, 0]", "[0.7071, 0, 0, 0.7071]", "[1e200, 0, 0, 0]", "[2, 0, 0, 0]"] {
        assert!(refusal::<Rotor>(numbers).contains("this Rotor is not unit"), "{numbers}");
        assert!(serde_json::from_str::<Even>(numbers).is_ok(), "Even takes any number, to be normalised");
    }
    // A rotation that is off, in a motor that moves far; and parts that do not belong together.
    assert!(refusal::<Motor>("[1.0001, 0, 0, 0, 1e9, 0, 0, 0]").contains("not unit"));
    assert!(refusal::<Motor>("[1, 0, 0, 0, 0, 0, 0, 0.5]").contains("not unit"));
    assert!(refusal::<Motor>("[0.6, 0, 0, 0.8, 0, 0, 1e9, 0]").contains("not unit"));
    assert!(refusal::<Pose>("[1e9, 0, 0, 1.0001, 0, 0, 0]").contains("this Pose is not unit"));
    assert!(refusal::<Dilator>("[3, 0.5]").contains("this Dilator is not unit"));
    assert!(refusal::<Plane>("[1, 1, 1, 0]").contains("this Plane is not unit"));
    assert!(refusal::<pga::Turn>("[0.5, 0.5]").contains("this Turn is not unit"));
    assert!(refusal::<boosts::Boost>("[1e6, 1e5]").contains("this Boost is not unit"));
    let nan = postcard::to_allocvec(&[f64::NAN, 0.0, 0.0, 0.0]).unwrap();
    assert!(postcard::from_bytes::<Rotor>(&nan).is_err());
}

#[test]
fn numbers_that_do_not_fit_the_type_are_refused() {
    assert!(refusal::<Vector>(r#"{"e1": 1, "e2": 2}"#).contains("missing field `e3`"));
    assert!(
        refusal::<Vector>(r#"{"e1": 1, "e2": 2, "e3": 3, "e4": 4}"#).contains("unknown field `e4`, expected one of")
    );
    assert!(refusal::<Vector>(r#"{"e1": 1, "e2": 2, "e2": 2, "e3": 3}"#).contains("duplicate field `e2`"));
    assert!(refusal::<Vector>("[1, 2]").contains("invalid length 2, expected Vector with 3 numbers"));
    assert!(refusal::<Vector>("[1, 2, 3, 4]").contains("trailing characters"));
    assert!(refusal::<Vector>(r#"{"e1": "1", "e2": 2, "e3": 3}"#).contains("invalid type"));
    assert!(refusal::<Vector>("7").contains("expected Vector with 3 numbers"));
    assert!(refusal::<Vector<f64>>(r#"{"e1": null, "e2": 2, "e3": 3}"#).contains("invalid type: null"));
}

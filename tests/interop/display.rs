//! How values read.

use crate::pga;
use ga_physics::algebra::cga::{Infinity, Motor, Point, Sphere, Translator};
use ga_physics::algebra::g3::{Bivector, Even, Rotor, Vector};

#[test]
fn a_multivector_reads_as_a_sum_of_blades() {
    assert_eq!(Even::new(1.0, 2.0, -3.0, 0.5).to_string(), "1 + 2 e23 - 3 e31 + 0.5 e12");
    assert_eq!(Bivector::new(-1.0, 0.0, 2.0).to_string(), "-1 e23 + 2 e12", "what is zero is left out");
    assert_eq!(Vector::new(0.0, -0.0, 0.0).to_string(), "0");
    assert_eq!(Rotor::<f32>::default().to_string(), "1");
    assert_eq!(Vector::new(f64::NAN, f64::NEG_INFINITY, 1e-3).to_string(), "NaN e1 - inf e2 + 0.001 e3");
}

#[test]
fn what_is_constant_is_part_of_the_text() {
    assert_eq!(Infinity.to_string(), "ninf");
    assert_eq!(pga::Translator::new(0.0, 0.0).to_string(), "1");
    assert_eq!(pga::Infinity.to_string(), "e0");
    assert_eq!(pga::Translator::new(0.5, 0.0).to_string(), "1 + 0.5 e01");
}

#[test]
fn types_with_derived_coefficients_name_their_numbers() {
    assert_eq!(Point::new(1.0, -2.0, 0.0).to_string(), "x = 1, y = -2, z = 0");
    assert_eq!(Sphere::new(1.0, 2.0, 3.0, -4.0).to_string(), "x = 1, y = 2, z = 3, rho_sq = -4");
    assert_eq!(Translator::by(Vector::new(2.0, 0.0, -4.0)).to_string(), "x = 2, y = 0, z = -4");
    assert_eq!(pga::Derived::new(3.0).to_string(), "type = 3");
}

#[test]
fn a_precision_holds_for_every_number() {
    let motor = Motor::from_parts(Vector::new(1.0, 0.0, 0.0), Rotor::exp(Bivector::new(0.0, 0.0, -0.5)));
    assert_eq!(format!("{motor:.3}"), "0.878 - 0.479 e12 - 0.439 e1_ninf + 0.240 e2_ninf");
    assert_eq!(format!("{:.1}", Point::new(1.0, 2.0, 3.0)), "x = 1.0, y = 2.0, z = 3.0");
}

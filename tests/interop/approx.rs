//! approx: coefficient by coefficient.

use crate::pga;
use approx::{
    assert_abs_diff_eq, assert_abs_diff_ne, assert_relative_eq, assert_relative_ne, assert_ulps_eq, assert_ulps_ne,
};
use ga_physics::algebra::cga::{Motor, Point};
use ga_physics::algebra::g3::{Rotor, Vector};

#[test]
fn every_coefficient_counts() {
    let point = Point::new(1.0, 2.0, 3e6);
    assert_abs_diff_eq!(point, Point::new(1.0 + 1e-9, 2.0, 3e6), epsilon = 2e-9);
    assert_relative_eq!(point, Point::new(1.0, 2.0, 3e6 + 1.0), max_relative = 1e-6);
    assert_ulps_eq!(point, Point::new(1.0, 2.0, 3e6 * (1.0 + f64::EPSILON)), max_ulps = 2);
    for index in 0..3 {
        let mut numbers = <[f64; 3]>::from(point);
        numbers[index] *= 1.001;
        let other = Point::from(numbers);
        assert_abs_diff_ne!(point, other, epsilon = 1e-4);
        assert_relative_ne!(point, other, max_relative = 1e-4);
        assert_ulps_ne!(point, other);
    }
    assert_relative_ne!(Vector::new(f64::NAN, 0.0, 0.0), Vector::new(f64::NAN, 0.0, 0.0));
}

#[test]
fn types_of_any_algebra_compare() {
    let turn = Rotor::from_axis_angle(Vector::new(0.0, 0.0, 1.0), 0.5).unwrap();
    let motor = Motor::from_parts(Vector::new(1.0, 2.0, 3.0), turn);
    assert_relative_eq!(motor * motor.rev(), Motor::default(), epsilon = 1e-15);
    assert_relative_ne!(turn, -turn, epsilon = 0.1);
    assert_relative_eq!(pga::Motor::new(1.0f32, 0.0, 0.5, 0.25), pga::Motor::new(1.0, 0.0, 0.5, 0.25));
}

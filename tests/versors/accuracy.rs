//! The table of worst errors: exponentials and logarithms against the series in double-double numbers, round trips.

use crate::conformal::{conformal, similarities};
use crate::grids::{DIRECTIONS, half_angles, times};
use crate::reference::{self, difference, largest, power_of_two, round, wide};
use ga_physics::algebra::Real;
use ga_physics::algebra::cga::{Even, Motor, PointPair, Twist};
use ga_physics::algebra::g3::{Bivector, Rotor};
use std::f64::consts::FRAC_PI_2;

/// One line of the table.
pub(crate) struct Line {
    what: &'static str,
    /// The worst error, in eps of the scalar.
    worst: f64,
    /// Where.
    at: String,
    bound: f64,
}

impl Line {
    pub(crate) fn new(what: &'static str, bound: f64) -> Self {
        Self { what, worst: 0.0, at: String::new(), bound }
    }

    pub(crate) fn add<T: Real>(&mut self, error: f64, at: impl FnOnce() -> String) {
        let error = error / T::EPSILON.to_f64();
        assert!(error.is_finite(), "{} at {}", self.what, at());
        if error > self.worst {
            (self.worst, self.at) = (error, at());
        }
    }
}

/// The first four numbers of an even multivector, and those with ninf of a motor.
fn motor_blocks<T: Copy>(e: Even<T>) -> ([T; 4], [T; 4]) {
    ([e.s, e.e23, e.e31, e.e12], [e.e1_ninf, e.e2_ninf, e.e3_ninf, e.e123_ninf])
}

fn max<T: Real>(numbers: &[T]) -> f64 {
    numbers.iter().fold(0.0, |largest, x| x.to_f64().abs().max(largest))
}

/// Below this the halvings of the reference lose digits.
const REFERENCE_FLOOR: f64 = 1e-300;

pub(crate) fn rotors<T: Real>() -> Vec<Line> {
    let mut exp = Line::new("Rotor::exp, half angle to pi", 4.0);
    let mut log = Line::new("Rotor::log, of b", 4.0);
    let mut round_trip = Line::new("exp log R - R", 4.0);
    for direction in DIRECTIONS {
        for p in half_angles(3.2) {
            let b = Bivector::from(times::<T>(direction, p));
            let exact = reference::exp(PointPair::from(b));
            let exact = motor_blocks(exact).0;
            let at = || format!("{p:e} {direction:?}");
            let found = <[T; 4]>::from(Rotor::exp(b));
            exp.add::<T>(difference(&found, &exact, 1.0), at);
            let rotor = Rotor::from(exact.map(round::<T>));
            let back = rotor.log();
            if p <= FRAC_PI_2 - 1e-7 && max(&<[T; 3]>::from(b)) > REFERENCE_FLOOR {
                let numbers = <[T; 3]>::from(b).map(wide);
                log.add::<T>(difference(&<[T; 3]>::from(back), &numbers, largest(&numbers)), at);
            }
            let sign = if rotor.s < T::zero() { -T::one() } else { T::one() };
            let again = <[T; 4]>::from(Rotor::exp(back)).map(|x| wide(x * sign));
            round_trip.add::<T>(difference(&<[T; 4]>::from(rotor), &again, 1.0), at);
        }
    }
    vec![exp, log, round_trip]
}

pub(crate) fn motors<T: Real>() -> Vec<Line> {
    let mut exp = Line::new("Motor::exp, half angle to pi, of each half", 6.0);
    let mut log_b = Line::new("Motor::log, bivector, of it", 4.0);
    let mut log_w = Line::new("Motor::log, vector, of it", 6.0);
    let mut round_trip = Line::new("exp log M - M, of each half", 6.0);
    let is_f64 = T::EPSILON.to_f64() < 1e-10;
    let lengths: &[i32] = if is_f64 { &[0, -990, -500, 60, 990] } else { &[0, -120, 60, 120] };
    for (index, direction) in DIRECTIONS.into_iter().enumerate() {
        // The reference is slow: of the angles that hardly turn, a few.
        let (tiny, others): (Vec<_>, Vec<_>) = half_angles(3.2).into_iter().partition(|p| *p < 1e-20);
        for p in tiny.into_iter().step_by(12).chain(others) {
            for other in [index, (index + 2) % 6] {
                let b = times::<T>(direction, p);
                let w = times::<T>(DIRECTIONS[other], 0.7);
                let unit = Twist::new(b[0], b[1], b[2], w[0], w[1], w[2]);
                let (rotation, translation) = motor_blocks(reference::exp(PointPair::from(unit)));
                // The second half is linear in w: a power of two scales both exactly.
                for length in lengths {
                    let scale = T::from_f64(power_of_two(*length));
                    let w = w.map(|x| x * scale);
                    let size = max(&w);
                    let at = || format!("{p:e} {direction:?} {w:?}");
                    let translation = translation.map(|x| x * scale.to_f64());
                    let found = <[T; 8]>::from(Motor::exp(Twist::new(b[0], b[1], b[2], w[0], w[1], w[2])));
                    exp.add::<T>(difference(&found[..4], &rotation, 1.0), at);
                    exp.add::<T>(difference(&found[4..], &translation, size), at);
                    let [s, e23, e31, e12] = rotation.map(round::<T>);
                    let [x, y, z, c] = translation.map(round::<T>);
                    let motor = Motor::from([s, e23, e31, e12, x, y, z, c]);
                    let back = <[T; 6]>::from(motor.log());
                    if p <= FRAC_PI_2 - 1e-7 {
                        if max(&b) > REFERENCE_FLOOR {
                            log_b.add::<T>(difference(&back[..3], &b.map(wide), max(&b)), at);
                        }
                        log_w.add::<T>(difference(&back[3..], &w.map(wide), size), at);
                    }
                    let sign = if s < T::zero() { -T::one() } else { T::one() };
                    let again = <[T; 8]>::from(Motor::exp(Twist::from(back))).map(|x| wide(x * sign));
                    let motor = <[T; 8]>::from(motor);
                    round_trip.add::<T>(difference(&motor[..4], &again[..4], 1.0), at);
                    round_trip.add::<T>(difference(&motor[4..], &again[4..], size), at);
                }
            }
        }
    }
    vec![exp, log_b, log_w, round_trip]
}

#[test]
fn worst_errors() {
    let mut failed = Vec::new();
    println!("\nerrors are in eps: 2.2e-16 for f64, 1.2e-7 for f32");
    println!("{:<54} {:>6} {:>6}  where", "", "worst", "bound");
    for (scalar, lines) in [
        ("f64", [rotors::<f64>(), motors::<f64>(), conformal::<f64>(), similarities::<f64>()]),
        ("f32", [rotors::<f32>(), motors::<f32>(), conformal::<f32>(), similarities::<f32>()]),
    ] {
        for line in lines.into_iter().flatten() {
            println!("{scalar} {:<50} {:>6.1} {:>6}  {}", line.what, line.worst, line.bound, line.at);
            if line.worst > line.bound {
                failed.push(format!("{scalar} {}: {} eps at {}", line.what, line.worst, line.at));
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

//! What double-double numbers are for: references that are good beyond all digits of f64.

use crate::Random;
use crate::exact::{Exact, rational};
use crate::laws::Tested;
use ga_physics::algebra::g3::{Rotor, Vector};
use ga_physics::algebra::twofloat::TwoFloat;
use ga_physics::algebra::{DoubleDouble, Scalar};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};

/// A part in 1e28: a hundred of their epsilons for results of a dozen operations.
const LIMIT: f64 = 1e-28;

fn value(number: DoubleDouble) -> BigRational {
    number.values().remove(0)
}

fn error(number: DoubleDouble, exact: &BigRational) -> f64 {
    (value(number) - exact).abs().to_f64().unwrap()
}

/// q²/|q|² of an integer quaternion, unit to the last digit of the scalar.
fn unit_rotor<T: Scalar>([w, x, y, z]: [i32; 4]) -> Rotor<T> {
    let norm = w * w + x * x + y * y + z * z;
    Rotor::new(
        T::ratio(w * w - x * x - y * y - z * z, norm),
        T::ratio(2 * w * x, norm),
        T::ratio(2 * w * y, norm),
        T::ratio(2 * w * z, norm),
    )
}

#[test]
fn a_rotation_agrees_with_rationals_and_turns_back() {
    let mut random = Random(4);
    for power in [-90, 0, 90] {
        for _ in 0..100 {
            let quaternion = [(); 4].map(|()| 1 + random.integer(50).abs());
            let numbers = [(); 3].map(|()| random.signed() * 2_f64.powi(power));
            let size = 2_f64.powi(power);
            let (rotor, vector) =
                (unit_rotor::<DoubleDouble>(quaternion), Vector::from(numbers.map(DoubleDouble::from)));
            let turned: [DoubleDouble; 3] = rotor.apply(vector).into();
            let exact = unit_rotor::<Exact>(quaternion).apply(Vector::from(numbers.map(Exact::of)));
            for (turned, exact) in turned.into_iter().zip(<[Exact; 3]>::from(exact)) {
                let error = error(turned, exact.0) / size;
                assert!(error < LIMIT, "turned: {error:e}");
            }
            let back: [DoubleDouble; 3] = rotor.rev().apply(rotor.apply(vector)).into();
            for (back, number) in back.into_iter().zip(numbers) {
                let error = error(back, &rational(number)) / size;
                assert!(error < LIMIT, "turned back: {error:e}");
            }
        }
    }
}

/// Largest relative error of a quotient of random numbers with full low parts.
fn worst_quotient(quotient: fn(DoubleDouble, DoubleDouble) -> DoubleDouble) -> f64 {
    let mut random = Random(5);
    let mut number = || {
        let hi = (1.0 + random.signed().abs()) * 2_f64.powi(random.integer(300));
        DoubleDouble(TwoFloat::new_add(hi, hi * random.signed() * f64::EPSILON / 2.0))
    };
    let errors = (0..2000).map(|_| {
        let (a, b) = (number(), number());
        let exact = value(a) / value(b);
        error(quotient(a, b), &exact) / exact.abs().to_f64().unwrap()
    });
    errors.fold(0.0, f64::max)
}

#[test]
fn the_quotient_is_good_to_the_bound_of_the_paper() {
    // 15 u² + 56 u³, u = 2^-53.
    let bound = 15.0 * 2_f64.powi(-106) * (1.0 + 1e-14);
    let worst = worst_quotient(|a, b| a / b);
    assert!(worst <= bound && worst > 0.0, "{worst:e}");
}

/// The reason why [`DoubleDouble`] divides by itself. When this fails, `twofloat` has mended its quotient.
#[test]
fn the_quotient_of_the_crate_beneath_is_no_better_than_f64() {
    let worst = worst_quotient(|a, b| DoubleDouble(a.0 / b.0));
    assert!(worst > 1e-17, "{worst:e}: the quotient of TwoFloat could be used now");
}

//! Intervals enclose the exact result always, and are no wider than rounding makes them.

use crate::Random;
use crate::exact::{Exact, rational};
use crate::kernels::{INPUTS, polynomials};
use ga_physics::algebra::{Interval, NotAnInterval, Scalar};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

const INFINITY: f64 = f64::INFINITY;

fn interval(inf: f64, sup: f64) -> Interval {
    Interval::new(inf, sup).unwrap()
}

fn encloses(interval: Interval, exact: &BigRational) -> bool {
    // Ends at infinity bound nothing.
    let above = interval.inf().is_infinite() || &rational(interval.inf()) <= exact;
    above && (interval.sup().is_infinite() || exact <= &rational(interval.sup()))
}

/// Numbers from the smallest to the largest, and zeros.
fn nasty(random: &mut Random) -> f64 {
    match random.bits() % 6 {
        0 => 0.0,
        1 => f64::from_bits(1 + random.bits() % 9) * f64::from(random.integer(1)),
        2 => f64::MAX * random.signed(),
        3 => f64::from(random.integer(4)),
        _ => random.signed() * 2_f64.powi(random.integer(1000)),
    }
}

/// An interval with the number in it; four of nine have it alone, some have no bound.
fn around(random: &mut Random, x: f64) -> Interval {
    let mut reach = || if random.bits().is_multiple_of(3) { x.abs() * random.signed().abs() } else { 0.0 };
    interval(x - reach(), x + reach())
}

#[test]
fn every_operation_encloses_its_exact_result() {
    let mut random = Random(6);
    for _ in 0..2000 {
        let (x, y) = (nasty(&mut random), nasty(&mut random));
        let (a, b) = (around(&mut random, x), around(&mut random, y));
        let (p, q) = (rational(x), rational(y));
        let results = [("+", a + b, &p + &q), ("-", a - b, &p - &q), ("*", a * b, &p * &q), ("neg", -a, -&p)];
        for (name, result, exact) in results {
            assert!(result.inf() <= result.sup() && encloses(result, &exact), "{a:?} {name} {b:?} = {result:?}");
        }
        if !q.is_zero() {
            assert!(encloses(a / b, &(&p / &q)), "{a:?} / {b:?} = {:?}", a / b);
        }
        if !p.is_negative() {
            let root = a.sqrt();
            let square = |x: f64| rational(x) * rational(x);
            assert!(
                root.inf() >= 0.0 && square(root.inf()) <= p && (root.sup() == INFINITY || p <= square(root.sup()))
            );
        }
    }
}

#[test]
fn generated_code_encloses_its_exact_results() {
    let mut random = Random(7);
    // Few, because exact numbers of ten thousand bits are slow.
    for _ in 0..6 {
        let numbers = [(); INPUTS].map(|()| nasty(&mut random));
        let intervals = numbers.map(|x| around(&mut random, x));
        let exact = polynomials(&numbers.map(Exact::of));
        for ((name, results), (_, exact)) in polynomials(&intervals).into_iter().zip(exact) {
            for (result, exact) in results.into_iter().zip(exact) {
                assert!(encloses(result, exact.0), "{name}: {result:?} of {intervals:?}");
            }
        }
    }
}

#[test]
fn points_give_results_of_at_most_two_ulp() {
    let mut random = Random(8);
    for _ in 0..2000 {
        let (x, y) = (1.0 + random.signed().abs(), random.signed() * 2_f64.powi(random.integer(200)));
        let (a, b) = (interval(x, x), interval(y, y));
        let ulps = |result: Interval| {
            let ulp = |end: f64| end.abs().next_up() - end.abs();
            result.width() / ulp(result.inf()).max(ulp(result.sup()))
        };
        assert!(ulps(a + b) <= 1.0 && ulps(a - b) <= 1.0);
        assert!(ulps(a * b) <= 2.0 && ulps(b / a) <= 2.0 && ulps(a.sqrt()) <= 2.0);
    }
}

#[test]
fn exact_sums_and_products_with_zero_stay_points() {
    let point = |x: f64| interval(x, x);
    assert_eq!(point(1.5) + point(0.25), point(1.75));
    assert_eq!(point(0.1) - point(0.1), point(0.0));
    assert_eq!(point(0.0) * interval(-INFINITY, 3.0), point(0.0));
    assert_eq!(point(0.0) / interval(1.0, INFINITY), point(0.0));
    assert_eq!(point(0.0).sqrt(), point(0.0));
    // An error of half the smallest number would not be exact: here none is made.
    assert_eq!(point(5e-324) + point(5e-324), point(1e-323));
}

#[test]
fn ends_at_infinity_and_zero_divisors() {
    let whole = Interval::WHOLE;
    let positive = interval(1.0, INFINITY);
    assert_eq!((positive + positive).sup(), INFINITY);
    assert_eq!((positive - positive), whole);
    assert!((positive * positive).inf() < 1.0 && (positive * positive).inf() > 0.999);
    // All positive numbers are quotients; rounding outward puts the end at, or just below, 0.
    let quotient = positive / positive;
    assert!(quotient.inf() <= 0.0 && quotient.inf() > -1e-300 && quotient.sup() == INFINITY);
    for divisor in [interval(0.0, 0.0), interval(-1.0, 1.0), interval(0.0, 1.0), interval(-1.0, 0.0), whole] {
        assert_eq!(interval(1.0, 2.0) / divisor, whole);
    }
    // Overflow loses the bound on one side only.
    let huge = interval(f64::MAX, f64::MAX);
    assert_eq!((huge + huge, huge * huge), (interval(f64::MAX, INFINITY), interval(f64::MAX, INFINITY)));
    let tiny = interval(5e-324, 5e-324);
    assert!((tiny * tiny).contains(0.0) && (tiny * tiny).sup() == 5e-324);
    assert_eq!(interval(-4.0, -1.0).sqrt(), whole);
    assert_eq!(interval(-4.0, 0.0).sqrt(), interval(0.0, 0.0));
}

#[test]
fn a_constant_without_a_float_is_enclosed() {
    for (p, q) in [(1, 3), (-2, 7), (1, 10), (i32::MAX, 3 << 20), (i32::MIN, 7), (1, i32::MIN + 1)] {
        let constant = Interval::ratio(p, q);
        assert!(encloses(constant, Exact::ratio(p, q).0) && constant.width() > 0.0, "{p}/{q}");
    }
    assert_eq!(Interval::ratio(i32::MIN, i32::MIN), interval(1.0, 1.0));
}

#[test]
fn what_is_no_interval_is_refused() {
    for (inf, sup) in [(1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::NAN), (INFINITY, INFINITY), (-INFINITY, -INFINITY)] {
        let refused: NotAnInterval = Interval::new(inf, sup).unwrap_err();
        assert_eq!((refused.inf.to_bits(), refused.sup.to_bits()), (inf.to_bits(), sup.to_bits()));
    }
    assert_eq!(interval(-INFINITY, INFINITY), Interval::WHOLE);
    assert!(!Interval::WHOLE.contains(f64::NAN) && Interval::WHOLE.contains(f64::MIN));
}

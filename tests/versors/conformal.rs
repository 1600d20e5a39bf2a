//! Accuracy of general conformal rotors.

use crate::accuracy::Line;
use crate::double_double::DoubleDouble;
use crate::grids::Random;
use crate::reference::{self, difference, largest, power_of_two, round, wide};
use ga_physics::algebra::Real;
use ga_physics::algebra::cga::{ConformalRotor, Even, PointPair, Translator};
use ga_physics::algebra::g3::Vector;
use std::f64::consts::{FRAC_PI_2, PI};

/// Bivectors of G(4,1) by kind, with a name.
fn bivectors() -> Vec<(String, PointPair<f64>)> {
    let mut found = Vec::new();
    let mut random = Random(7);
    for decade in -12..=0 {
        for _ in 0..40 {
            let scale = 10.0f64.powi(decade) * 1.2;
            found.push((format!("general 1e{decade}"), PointPair::from_fn(|_| random.signed() * scale)));
        }
    }
    // Two rotations, in e12 and in the plane of e3 and e = ninf/2 - no, by angles that are equal or nearly.
    let two = |a: f64, b: f64| PointPair { e12: a, e3_no: -b, e3_ninf: b / 2.0, ..PointPair::default() };
    for angle in [1e-9, 1e-4, 0.01, 0.3, 0.49, 0.51, 0.7, 0.9, 1.2, 1.4, 1.5, 1.56] {
        for k in [1, 2, 3, 5, 8, 9, 12, 15, 16, 20] {
            found.push((format!("isoclinic {angle}"), two(angle, angle * (1.0 + 10.0f64.powi(-k)))));
            found.push((format!("isoclinic {angle}"), two(angle, -angle * (1.0 + 10.0f64.powi(-k)))));
            found.push((format!("unequal {angle}"), two(angle, 10.0f64.powi(-k))));
        }
        for other in [0.0, 0.1, 0.2, 0.3, 0.5, 0.6, 0.8, 1.0, 1.3, 1.5] {
            found.push((format!("two planes {angle} {other}"), two(angle, other)));
        }
    }
    // Nilpotent: translations and transversions; with a commuting rotation: screws.
    for length in [1e-300, 1e-9, 1e-3, 0.5, 3.0] {
        for angle in [0.0, 1e-300, 1e-9, 1e-3, 0.3, 1.0, 1.5] {
            found.push((
                format!("screw {length} {angle}"),
                PointPair { e1_ninf: length, e23: angle, ..PointPair::default() },
            ));
            found.push((
                format!("screw at no {length} {angle}"),
                PointPair { e1_no: length, e23: angle, ..PointPair::default() },
            ));
            found.push((
                format!("turn about a far axis {length} {angle}"),
                PointPair { e1_ninf: length, e12: angle, ..PointPair::default() },
            ));
        }
    }
    // Dilations and spirals, about the origin and about a point at a distance.
    for dilation in [1e-12, 1e-6, 1e-3, 0.1, 0.4, 0.9, 1.5, 3.0] {
        for angle in [0.0, 1e-9, 1e-3, 0.2, 0.8, 1.5, FRAC_PI_2, 1.6, 3.0, PI] {
            let b = PointPair { no_ninf: dilation, e12: angle, ..PointPair::default() };
            found.push((format!("spiral {dilation} {angle}"), b));
            for distance in [1e-6, 1.0, 30.0] {
                let moved = Translator::by(Vector::new(distance, -distance / 2.0, distance / 3.0)).apply(b);
                found.push((format!("spiral {dilation} {angle} at {distance}"), moved));
            }
        }
    }
    // All of them once more, seen from a frame in which nothing is aligned.
    let mover = PointPair::from([0.3, -0.2, 0.4, 0.1, 0.3, -0.2, 0.5, 0.1, -0.4, 0.2]);
    let mover = ConformalRotor::exp(mover).unwrap();
    let moved: Vec<_> = found.iter().map(|(name, b)| (format!("moved {name}"), mover.apply(*b))).collect();
    found.extend(moved);
    for _ in 0..40 {
        found.push(("general 3".into(), PointPair::from_fn(|_| random.signed() * 3.0)));
    }
    found
}

/// The half angles p of the rotations of a bivector, from the squares of its planes: one beside a boost or a translation,
/// two otherwise.
#[expect(clippy::eq_op, reason = "the outer square of a bivector is not zero, as that of a vector is")]
fn angles(b: PointPair<f64>) -> (f64, f64) {
    let (s, f2) = (-b.norm_sq(), (b ^ b).norm_sq());
    let distance = (s * s - f2).max(0.0).sqrt();
    let angle = |square: f64| (-square).max(0.0).sqrt();
    (angle((s - distance) / 2.0), angle((s + distance) / 2.0))
}

/// How much the exponential moves when every number of the bivector is rounded, in eps of the scalar: what no method can
/// avoid. Measured by relative changes of 2^-30.
fn sensitivity(b: PointPair<f64>, exact: &[DoubleDouble; 16]) -> f64 {
    let part = power_of_two(-30);
    let mut random = Random(21);
    let changes = (0..2).map(|_| {
        let changed = b.map(|x| x * (1.0 + part * random.signed().signum()));
        let changed = <[DoubleDouble; 16]>::from(reference::exp(changed));
        changed.iter().zip(exact).map(|(x, y)| (*x - *y).hi.abs()).fold(0.0, f64::max) / part
    });
    changes.fold(0.0, f64::max)
}

pub(crate) fn conformal<T: Real>() -> Vec<Line> {
    let mut exp = Line::new("ConformalRotor::exp, aligned, of V", 6.0);
    let mut exp_any = Line::new("ConformalRotor::exp, any frame, per condition", 8.0);
    let mut log = Line::new("ConformalRotor::log, of 1 + b, per condition", 6.0);
    let mut round_trip = Line::new("exp log V - V, aligned, of V, per condition", 14.0);
    let mut round_trip_any = Line::new("exp log V - V, any frame, per condition", 14.0);
    for (name, b) in bivectors() {
        let b = b.map(T::from_f64);
        let at = || format!("{name} {b:?}");
        let exact = <[_; 16]>::from(reference::exp(b));
        let size = largest(&exact);
        let aligned = !name.starts_with("moved") && !name.starts_with("general") && !name.ends_with("at 30");
        // The reference is slow: where nothing is far away, the condition is near 1 and left out.
        let any = size + if aligned { 0.0 } else { sensitivity(b.map(Real::to_f64), &exact) };
        let error = difference(&<[T; 16]>::from(Even::from(ConformalRotor::exp(b).unwrap())), &exact, 1.0);
        let exact = split(Even::from(exact));
        let size = size.max(largest(&<[_; 16]>::from(exact)));
        let versor = exact.map(round::<T>);
        let back = versor.log().unwrap();
        let (p_1, p_2) = angles(b.map(Real::to_f64));
        // Two planes: the logarithm is lost where both turn by pi. One plane: nowhere.
        let condition = if p_2 > 1e-7 { (p_1.min(PI - p_1) + p_2.min(PI - p_2)).sin().abs().min(1.0) } else { 1.0 };
        let sign = if versor.p + versor.q < T::zero() { -T::one() } else { T::one() };
        let again = <[T; 16]>::from(ConformalRotor::exp(back).unwrap());
        let again = again.map(|x| wide(x * sign));
        let back_error = difference(&<[T; 16]>::from(versor), &again, 1.0) * condition;
        if !aligned {
            exp_any.add::<T>(error / any, at);
            round_trip_any.add::<T>(back_error / any, at);
        } else {
            exp.add::<T>(error / size, at);
            round_trip.add::<T>(back_error / size, at);
            let numbers = <[T; 10]>::from(b).map(wide);
            if p_1 < FRAC_PI_2 - 1e-6 && p_2 < FRAC_PI_2 - 1e-6 {
                let error = difference(&<[T; 10]>::from(back), &numbers, 1.0 + largest(&numbers));
                log.add::<T>(error * condition, at);
            }
        }
    }
    vec![exp, exp_any, log, round_trip, round_trip_any]
}

/// Spirals about the origin and elsewhere: each of the blocks p, q, w to its own size.
pub(crate) fn similarities<T: Real>() -> Vec<Line> {
    let mut exp = Line::new("exp of a spiral, each block of its own size", 6.0);
    let mut round_trip = Line::new("exp log V - V of a spiral, each block", 30.0);
    for dilation in [-12.0, -5.0, -1.0, -1e-3, 1e-9, 0.1, 1.0, 3.0, 12.0] {
        for angle in [0.0, 1e-9, 0.3, 1.5] {
            for distance in [0.0, 1e-6, 1.0, 1e3] {
                let b = PointPair { no_ninf: dilation, e12: angle, e23: angle / 3.0, ..PointPair::default() };
                let b = Translator::by(Vector::new(distance, -distance / 2.0, distance / 3.0)).apply(b);
                let b = b.map(T::from_f64);
                let at = || format!("{b:?}");
                let exact = split(reference::exp(b));
                let found = ConformalRotor::exp(b).unwrap();
                let versor = exact.map(round::<T>);
                let again = ConformalRotor::exp(versor.log().unwrap()).unwrap();
                let again = if versor.p + versor.q < T::zero() { -again } else { again };
                let (exact, found, again) = (blocks(exact), blocks(found), blocks(again));
                // The logarithm of a dilation by e^±24 errs by eps of its 12, which is a part of p and q.
                for block in 0..3 {
                    let size = largest(&exact[block]).max(f64::MIN_POSITIVE);
                    exp.add::<T>(difference(&found[block], &exact[block], size), at);
                    round_trip.add::<T>(difference(&again[block], &exact[block], size), at);
                }
            }
        }
    }
    vec![exp, round_trip]
}

fn blocks<T: Copy>(v: ConformalRotor<T>) -> [[T; 4]; 3] {
    [[v.p, v.p23, v.p31, v.p12], [v.q, v.q23, v.q31, v.q12], [v.w1, v.w2, v.w3, v.w123]]
}

/// An even multivector stored split on the null pair.
pub(crate) fn split<T: ga_physics::algebra::Scalar>(e: Even<T>) -> ConformalRotor<T> {
    let two = T::ratio(-2, 1);
    ConformalRotor {
        p: e.s + e.no_ninf,
        q: e.s - e.no_ninf,
        p23: e.e23 + e.e23_no_ninf,
        q23: e.e23 - e.e23_no_ninf,
        p31: e.e31 + e.e31_no_ninf,
        q31: e.e31 - e.e31_no_ninf,
        p12: e.e12 + e.e12_no_ninf,
        q12: e.e12 - e.e12_no_ninf,
        v1: e.e1_no,
        v2: e.e2_no,
        v3: e.e3_no,
        v123: e.e123_no,
        w1: e.e1_ninf * two,
        w2: e.e2_ninf * two,
        w3: e.e3_ninf * two,
        w123: e.e123_ninf * two,
    }
}

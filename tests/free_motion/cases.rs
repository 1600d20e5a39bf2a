//! The named cases, each against its closed form or the reference, and the passages between them.

use super::{EPS, Spun, angle, energy};
use ga_physics::algebra::g3::{Bivector, Rotor};
use ga_physics::rigid::Inertia;
use ga_physics::rigid::free::{self, Case, FreeMotion};

fn tilted() -> Rotor<f64> {
    Rotor::exp(Bivector::new(0.3, -0.2, 0.5))
}

/// Precession about L at `|L| / I`, rotation about the axis of symmetry at `(1/I_axis - 1/I) L_axis`.
#[test]
fn a_symmetric_body_is_two_rotations() {
    // The axis of symmetry, and moments of a disc, a rod, and a body almost a sphere.
    for (axis, along, across) in [(2, 2.0, 1.0), (0, 1e-3, 1.0), (1, 1.0, 3.0), (2, 1.0, 1.0 + 1e-6), (0, 1e6, 7e5)] {
        let mut moments = [across; 3];
        moments[axis] = along;
        for across_only in [false, true] {
            let mut omega = [0.3, -0.5, 0.7];
            if across_only {
                omega[axis] = 0.0;
            }
            let rotor = if across_only { Rotor::default() } else { tilted() };
            two_rotations(&Spun::new(moments, omega, rotor), axis, along, across);
        }
    }
}

fn two_rotations(spun: &Spun, axis: usize, along: f64, across: f64) {
    let motion = spun.motion();
    assert_eq!(motion.case(), Case::Symmetric);
    let in_body: [f64; 3] = spun.rotor.rev().apply(spun.momentum).into();
    let mut own = [0.0; 3];
    own[axis] = in_body[axis] * ((across - along) / (along * across));
    for t in [0.0, 0.01, 1.0, -1.0, 10.0, 300.0] {
        let expected =
            Rotor::exp(spun.momentum * (-0.5 * t / across)) * spun.rotor * Rotor::exp(Bivector::from(own) * (-0.5 * t));
        let bound = 16.0 * EPS * (1.0 + t.abs() * spun.rate());
        for found in [motion.at(t), spun.turn(spun.rotor, t)] {
            let error = angle(expected, found);
            assert!(error < bound, "{:?} at {t}: {error:e} of {bound:e}", spun.moments);
        }
    }
}

#[test]
fn still_bodies_stay() {
    let spun = Spun::new([1.0, 2.0, 3.0], [0.0; 3], tilted());
    assert_eq!(spun.motion().case(), Case::Still);
    assert_eq!((spun.motion().at(1e9), spun.turn(spun.rotor, 1e9)), (spun.rotor, spun.rotor));
    let held = Inertia::<f64>::immovable();
    let push = Bivector::new(1.0, 2.0, 3.0);
    assert_eq!(FreeMotion::new(&held, spun.rotor, push).case(), Case::Still);
    assert_eq!(free::turn(&held, spun.rotor, push, 1.0), spun.rotor);
}

#[test]
fn spheres_and_single_axes_turn_uniformly() {
    let cases = [
        ([2.0; 3], [0.3, -0.5, 0.7], Case::Spherical),
        ([1.0, 2.0, 3.0], [0.7, 0.0, 0.0], Case::SingleAxis),
        ([1.0, 2.0, 3.0], [0.0, -0.7, 0.0], Case::SingleAxis),
        ([1.0, 2.0, 3.0], [0.0, 0.0, 0.7], Case::SingleAxis),
        ([3.0, 1.0, 2.0], [0.0, 0.0, 0.7], Case::SingleAxis),
    ];
    for (moments, omega, case) in cases {
        let spun = Spun::new(moments, omega, tilted());
        let motion = spun.motion();
        assert_eq!(motion.case(), case, "{moments:?} {omega:?}");
        for t in [0.01, -1.0, 10.0, 1000.0] {
            let expected = spun.rotor * Rotor::exp(Bivector::from(omega) * (-0.5 * t));
            let bound = 16.0 * EPS * (1.0 + t.abs());
            let errors = [angle(expected, motion.at(t)), angle(expected, spun.turn(spun.rotor, t))];
            assert!(errors.iter().all(|error| *error < bound), "{moments:?} {omega:?} at {t}: {errors:?}");
        }
    }
}

/// On the middle axis to rounding it stays; 1e-8 off, it leaves, when the reference says.
#[test]
fn the_middle_axis_holds_only_what_is_on_it() {
    let spun = Spun::new([1.0, 2.0, 3.0], [0.0, 1.0, 0.0], tilted());
    let uniform = spun.rotor * Rotor::exp(Bivector::new(0.0, -100.0, 0.0));
    let (at, turned) = (angle(uniform, spun.motion().at(200.0)), angle(uniform, spun.turns(2000, 0.1)));
    assert!(at < 1e-13 && turned < 1e-11, "{at:e} {turned:e}");
    for (off, identity) in [(1e-8, true), (1e-8, false), (1e-12, true), (1e-14, true)] {
        let rotor = if identity { Rotor::default() } else { tilted() };
        let spun = Spun::new([1.0, 2.0, 3.0], [off, 1.0, -0.3 * off], rotor);
        let mut exact = spun.reference();
        let motion = spun.motion();
        let mut flipped = false;
        for step in 1..=80 {
            exact.advance(1.0);
            let t = f64::from(step);
            let error = exact.angle_to(motion.at(t));
            // What is off the axis is known to eps of the momentum; what that does grows till the flip, then lasts.
            let bound = if identity { 1e-13 } else { 8.0 * EPS / off * t };
            assert!(error < bound, "{off:e} off, at {t}: {error:e} of {bound:e}");
            let in_body = motion.at::<f64>(t).rev().apply(spun.momentum);
            flipped |= in_body.e31 < -1.99;
        }
        assert!(flipped, "{off:e} off: it did not flip");
    }
}

/// On the separatrix: `tanh` and `sech`, from the middle axis to its opposite.
#[test]
fn the_separatrix_is_hyperbolic() {
    // a1 u3² = a3 u1² with moments 1, 2, 2.5: a1 = 1/10, a3 = 1/2.
    let moments = [1.0, 2.0, 2.5];
    let (a1, a3) = (0.5 - 0.4, 0.5_f64);
    let direction = [0.6 * (a1 / a3).sqrt(), 0.2, 0.6];
    let omega = std::array::from_fn(|i| direction[i] / moments[i]);
    let spun = Spun::new(moments, omega, Rotor::default());
    assert_eq!(spun.motion().case(), Case::Separatrix);
    let length = spun.momentum.norm_sq().sqrt();
    let lambda = length * (a1 * a3).sqrt();
    let start = (spun.momentum.e31 / length).atanh();
    for t in [0.0, 1.0, -3.0, 10.0, 40.0, -200.0] {
        let in_body = spun.motion().at::<f64>(t).rev().apply(spun.momentum) * (1.0 / length);
        let expected = (start + lambda * t).tanh();
        assert!((in_body.e31 - expected).abs() < 32.0 * EPS, "at {t}: {} {expected}", in_body.e31);
    }
    let mut exact = spun.reference();
    exact.advance(12.0);
    let error = exact.angle_to(spun.motion().at(12.0));
    assert!(error < 1e-12, "{error:e}");
}

/// Ever nearer to the separatrix, from either side. The part `d` of the difference is known to eps/d, and moves the time
/// of the flip, and all after it, by as much.
#[test]
fn nearer_and_nearer_to_the_separatrix() {
    let moments = [1.0, 2.0, 3.0];
    let (a1, a3) = (1.0_f64 / 6.0, 0.5_f64);
    for exponent in (1..=15).step_by(2) {
        for sign in [1.0, -1.0] {
            let distance = sign * 10.0_f64.powi(-exponent);
            let direction = [0.5 * (a1 / a3).sqrt(), 0.3, 0.5 * (1.0 + distance)];
            let spun = Spun::new(moments, std::array::from_fn(|i| direction[i] / moments[i]), Rotor::default());
            let motion = spun.motion();
            let start = energy(&spun.body, spun.rotor, spun.momentum);
            let mut exact = spun.reference();
            for step in 1..=4 {
                exact.advance(15.0);
                let t = 15.0 * f64::from(step);
                let error = exact.angle_to(motion.at(t));
                let bound = 16.0 * EPS * (1.0 / distance.abs() + t) * t;
                assert!(error < bound, "{distance:e} at {t}: {error:e} of {bound:e}");
                let drift = energy(&spun.body, motion.at(t), spun.momentum) / start - 1.0;
                assert!(drift.abs() < 16.0 * EPS, "{distance:e} at {t}: energy {drift:e}");
            }
        }
    }
}

/// `I1 + I2 = I3` is like any other body.
#[test]
fn a_lamina_follows_the_reference() {
    for omega in [[0.3, 0.2, 0.4], [0.3, -0.4, 0.1], [-0.05, 0.6, 0.02]] {
        let spun = Spun::new([1.0, 2.0, 3.0], omega, tilted());
        let mut exact = spun.reference();
        exact.advance(20.0);
        let error = exact.angle_to(spun.motion().at(20.0));
        assert!(error < 1e-13, "{omega:?}: {error:e}");
    }
}

/// The inertia need not be diagonal.
#[test]
fn any_axes_will_do() {
    let axes = Rotor::exp(Bivector::new(0.4, -0.7, 0.2));
    let principal = Spun::new([1.0, 2.0, 2.7], [0.3, 0.2, 0.4], Rotor::default());
    let columns: [Bivector<f64>; 3] = std::array::from_fn(|i| {
        let mut unit = [0.0; 3];
        unit[i] = 1.0;
        axes.apply(Bivector::from(unit))
    });
    let matrix = std::array::from_fn(|r| {
        std::array::from_fn(|c| {
            (0..3)
                .map(|i| {
                    let column: [f64; 3] = columns[i].into();
                    principal.moments[i] * column[r] * column[c]
                })
                .sum()
        })
    });
    let body = Inertia::<f64>::new(1.0, matrix).unwrap();
    // The body frame is turned against the principal one, so the same motion has another rotor.
    let start = principal.rotor * axes.rev();
    for t in [0.02, 5.0] {
        let expected = principal.motion().at::<f64>(t) * axes.rev();
        let errors = [
            angle(expected, FreeMotion::new(&body, start, principal.momentum).at(t)),
            angle(expected, free::turn(&body, start, principal.momentum, t)),
        ];
        // Moments and axes are eigenvalues and eigenvectors.
        assert!(errors.iter().all(|error| *error < 1e-14), "{errors:?}");
    }
}

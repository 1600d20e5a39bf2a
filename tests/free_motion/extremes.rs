//! The far ends of every range: no NaN, unit rotors, and the error that rounding leaves.

use super::{EPS, Spun, angle, inertia};
use ga_physics::algebra::Real;
use ga_physics::algebra::g3::{Bivector, Rotor};
use ga_physics::rigid::free::{self, FreeMotion};

const MOMENTS: [[f64; 3]; 8] = [
    [1.0, 2.0, 3.0],
    [1.0, 1.0, 1.0],
    [1.0, 1.0, 1.0 + 1e-6],
    [1.0, 1.0 + 1e-15, 1.0 + 3e-15],
    [1.0, 1e6, 1e6],
    [1.0, 1e6, 1e6 + 1.0],
    [1.0, 1.0, 2.0],
    [1e-6, 1.0, 1.0 + 5e-7],
];

const DIRECTIONS: [[f64; 3]; 9] = [
    [0.6, 0.5, 0.4],
    [0.0, 1.0, 0.0],
    [1e-9, 1.0, 1e-9],
    [1e-200, 1.0, 0.0],
    [1.0, 1e-12, 1e-300],
    [0.0, 1e-8, 1.0],
    [-0.0, -1.0, 1e-5],
    [0.5, 0.5, 0.5],
    [0.577_350_269_189_625_8, 0.0, 1.0],
];

fn every_state_is_a_rotor<T: Real>(sizes: &[f64], spins: &[f64]) {
    for moments in MOMENTS {
        for size in sizes {
            let body = inertia::<T>(moments.map(|x| x * size));
            for direction in DIRECTIONS {
                for spin in spins {
                    let momentum = Bivector::from(direction.map(|x| T::from_f64(x * spin * size)));
                    let start = Rotor::<T>::exp(Bivector::new(T::ratio(1, 3), T::ratio(-1, 5), T::ratio(1, 2)));
                    let motion = FreeMotion::new(&body, start, momentum);
                    for t in [0.0, 1e-300, 1e-9, 0.01, -1.0, 1e3, 1e9, 1e300, -f64::MAX] {
                        for found in [motion.at(t), free::turn(&body, start, momentum, t)] {
                            let norm: f64 = found.norm_sq().to_f64();
                            let off = (norm - 1.0).abs();
                            let bound = 16.0 * T::EPSILON.to_f64();
                            let what = motion.case();
                            assert!(
                                off < bound,
                                "{moments:?} * {size:e} {direction:?} * {spin:e} at {t:e}, {what:?}: {off:e}"
                            );
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn every_state_of_f64_is_a_rotor() {
    every_state_is_a_rotor::<f64>(&[1.0, 1e-100, 1e100], &[1.0, 1e-12, 1e6, 1e-190, 1e200]);
}

#[test]
fn every_state_of_f32_is_a_rotor() {
    every_state_is_a_rotor::<f32>(&[1.0, 1e-12, 1e12], &[1.0, 1e-12, 1e6]);
}

/// Spins of 1e-12 and of 1e6 rad/s are the same motion in other units of time.
#[test]
fn the_unit_of_time_does_not_matter() {
    for moments in [[1.0, 2.0, 3.0], [1.0, 1.0, 1.0 + 1e-6], [1.0, 1e6, 1e6 + 0.5]] {
        let omega = [0.3, 0.8, 0.2];
        let plain = Spun::new(moments, omega, Rotor::default());
        // Powers of two: nothing is rounded differently.
        for scale in [2.0_f64.powi(-40), 2.0_f64.powi(20)] {
            let fast = Spun::new(moments, omega.map(|x| x * scale), Rotor::default());
            for t in [0.02, 3.0, 500.0] {
                assert_eq!(plain.motion().at::<f64>(t), fast.motion().at::<f64>(t / scale));
                assert_eq!(plain.turn(plain.rotor, t), fast.turn(fast.rotor, t / scale));
            }
        }
    }
}

/// Shapes at the ends, for some turns, against the reference.
#[test]
fn extreme_shapes_follow_the_reference() {
    for moments in [[1.0, 1.0, 1.0 + 1e-6], [1.0, 1.0 + 1e-6, 1.0 + 3e-6], [1.0, 1e6, 1e6 + 0.5], [1.0, 1e6, 1e6]] {
        for direction in [[0.6, 0.5, 0.4], [1e-3, 0.9, 0.2], [0.9, 0.3, 1e-3]] {
            let omega = std::array::from_fn(|i| direction[i] / moments[i]);
            let spun = Spun::new(moments, omega, Rotor::default());
            let mut exact = spun.reference();
            for t in [4.0, 12.0] {
                exact.advance(if t == 4.0 { 4.0 } else { 8.0 });
                let errors = [exact.angle_to(spun.motion().at(t)), exact.angle_to(spun.turns(100, t / 100.0))];
                let bound = 16.0 * EPS * (1.0 + t);
                assert!(
                    errors[0] < bound && errors[1] < 4.0 * bound,
                    "{moments:?} {direction:?} {t}: {errors:?} {bound:e}"
                );
            }
        }
    }
}

/// A phase of 1e9 rad has an error of 1e9 eps, and no more.
#[test]
fn a_long_time_costs_the_rounding_of_the_phase() {
    for (moments, omega) in
        [([1.0, 2.0, 3.0], [0.3, 0.1, 0.9]), ([1.0, 2.0, 3.0], [0.9, 0.2, 0.1]), ([1.0, 1.0, 2.0], [0.5, 0.3, 0.2])]
    {
        let spun = Spun::new(moments, omega, Rotor::default());
        let motion = spun.motion();
        // Half the time, and on from there: two phases that are rounded on their own.
        let half = motion.at::<f64>(0.5e9);
        let found = FreeMotion::new(&spun.body, half, spun.momentum).at::<f64>(0.5e9);
        let error = angle(found, motion.at(1e9));
        let bound = 16.0 * EPS * 1e9 * spun.rate();
        println!("{moments:?} {omega:?}: {error:.1e} of {bound:.1e}");
        assert!(error < bound, "{error:e} of {bound:e}");
    }
}

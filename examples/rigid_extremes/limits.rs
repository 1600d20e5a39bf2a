//! The exact motion at its limits, against the reference.

use super::reference::Top;
use super::{energy, inertia};
use ga_physics::algebra::Real;
use ga_physics::algebra::g3::{Bivector, Rotor};
use ga_physics::rigid::free::{self, FreeMotion};

/// Moments 1, 2, 3, from a general direction at a part d off the separatrix.
pub(crate) fn separatrix() {
    println!("\n## Near the separatrix: moments 1, 2, 3, |L| = 1, 100 s\n");
    println!(
        "d is the difference of `a1 u3²` and `a3 u1²` by either. An error of eps of the input is one of eps/d of d, and of \
         the times of flips. `one ulp` is what the last bit of one input number does to the reference.\n"
    );
    println!(
        "| d | case | prepared, rad | by 0.01 s | by 1 s | one ulp | energy, prepared | energy, by 0.01 s |\n|---|---|---|---|---|---|---|---|"
    );
    let moments = [1.0, 2.0, 3.0];
    let body = inertia::<f64>(moments);
    for exponent in [2, 3, 4, 6, 8, 10, 12, 14, 15] {
        for sign in [1.0, -1.0] {
            let d = sign * 10.0_f64.powi(-exponent);
            let momentum = |ulps: f64| {
                let third = 0.6 * (1.0 + d).sqrt() * (1.0 + ulps * f64::EPSILON);
                let direction = [0.6 / 3.0_f64.sqrt(), 0.4, third];
                Bivector::from(direction)
            };
            let reference = |ulps: f64| {
                let mut exact = Top::new(moments, Rotor::default(), momentum(ulps).into());
                exact.advance(100.0);
                exact
            };
            let (exact, momentum) = (reference(0.0), momentum(0.0));
            let motion = FreeMotion::new(&body, Rotor::default(), momentum);
            let walk = |steps: u32| {
                let h = 100.0 / f64::from(steps);
                (0..steps).fold(Rotor::default(), |rotor, _| free::turn(&body, rotor, momentum, h))
            };
            let (at, fine, coarse) = (motion.at::<f64>(100.0), walk(10_000), walk(100));
            let start = energy(&body, Rotor::default(), momentum);
            let drift = |rotor| (energy(&body, rotor, momentum) / start - 1.0).abs();
            println!(
                "| {d:.0e} | {:?} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} |",
                motion.case(),
                exact.angle_to(at),
                exact.angle_to(fine),
                exact.angle_to(coarse),
                exact.angle_to(reference(1.0).rotor()),
                drift(at),
                drift(fine)
            );
        }
    }
}

/// Shapes, spins and scalars: the error by the phase, in eps of the scalar.
pub(crate) fn shapes_and_spins() {
    println!("\n## Shapes, spins, scalars\n");
    println!(
        "Over 30 rad of `|L| t / I1`, prepared and in 300 steps; the attitude error in eps of the scalar, and the largest \
         error of the energy on the way, for f32 in its own rounding.\n"
    );
    println!(
        "| moments | spin, rad/s | scalar | prepared, eps | 300 steps, eps | energy, prepared | energy, steps |\n|---|---|---|---|---|---|---|"
    );
    let shapes = [
        ("1 : 2 : 3", [1.0, 2.0, 3.0]),
        ("1 : 1 : 1+1e-6", [1.0, 1.0, 1.0 + 1e-6]),
        ("1 : 1+1e-6 : 1+3e-6", [1.0, 1.0 + 1e-6, 1.0 + 3e-6]),
        ("1 : 1e6 : 1e6", [1.0, 1e6, 1e6]),
        ("1e-6 : 1 : 1", [1e-6, 1.0, 1.0]),
        ("1 : 1e6 : 1e6+0.5", [1.0, 1e6, 1e6 + 0.5]),
    ];
    for (name, moments) in shapes {
        for spin in [1e-12, 1.0, 1e6] {
            of_scalar::<f64>(name, "f64", moments, spin);
            of_scalar::<f32>(name, "f32", moments, spin);
        }
    }
}

fn of_scalar<T: Real>(name: &str, scalar: &str, moments: [f64; 3], spin: f64) {
    let body = inertia::<T>(moments);
    let start = Rotor::<T>::exp(Bivector::new(T::ratio(1, 3), T::ratio(-1, 5), T::ratio(1, 2)));
    let momentum = Bivector::from([0.5, 0.7, 0.4].map(|x| T::from_f64(x * spin * moments[0])));
    let (wide, wide_start) = (momentum.map(Real::to_f64), start.map(Real::to_f64));
    let mut exact = Top::new(moments, wide_start, wide.into());
    let duration = 30.0 * moments[0] / wide.norm_sq().sqrt();
    exact.advance(duration);
    let motion = FreeMotion::new(&body, start, momentum);
    let before = energy(&body, start, momentum);
    let (mut rotor, mut worst) = (start, [0.0_f64; 2]);
    for step in 1..=300_u32 {
        rotor = free::turn(&body, rotor, momentum, duration / 300.0);
        let at = motion.at::<T>(duration * f64::from(step) / 300.0);
        for (worst, rotor) in worst.iter_mut().zip([at, rotor]) {
            *worst = worst.max((energy(&body, rotor, momentum) / before - 1.0).abs());
        }
    }
    let error = |rotor: Rotor<T>| {
        // The length of an f32 rotor is off by its own rounding, which is no error of the attitude.
        let rotor = rotor.map(Real::to_f64).renormalise().unwrap();
        exact.angle_to(rotor) / T::EPSILON.to_f64()
    };
    println!(
        "| {name} | {spin:.0e} | {scalar} | {:.1} | {:.1} | {:.1e} | {:.1e} |",
        error(motion.at(duration)),
        error(rotor),
        worst[0],
        worst[1]
    );
}

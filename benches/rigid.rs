//! Rigid bodies.
//!
//! ```sh
//! cargo bench --bench rigid --no-default-features --features physics
//! ```
//!
//! `free motion` is a step of a body that nothing turns, of moments 1, 2, 3, spun about its middle axis:
//! RK4 on a quaternion by nalgebra, with renormalisation, is what the others are held against. Every step starts from the
//! end of the one before, but for `at`, which has no steps and is asked for the attitude at their ends.
#![allow(missing_docs, reason = "the macro's main function has no place for them")]
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use criterion::{Criterion, criterion_group, criterion_main};
use ga_physics::algebra::g3::{Bivector, Rotor};
use ga_physics::ode::Composition;
use ga_physics::rigid::free::{self, FreeMotion};
use ga_physics::rigid::{Inertia, axis_splitting};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use std::hint::black_box;

const MOMENTS: [f64; 3] = [1.0, 2.0, 3.0];
const OMEGA_BODY: [f64; 3] = [0.01, 1.0, 0.01];
const DT_S: f64 = 0.01;

fn body() -> (Inertia<f64>, Bivector<f64>) {
    let diagonal = std::array::from_fn(|r| std::array::from_fn(|c| if r == c { MOMENTS[r] } else { 0.0 }));
    let inertia = Inertia::new(1.0, diagonal).unwrap();
    (inertia, inertia.momentum_of(Bivector::from(OMEGA_BODY)))
}

/// `qdot = 1/2 q omega_body`, `omega_body = I^-1 (~q L q)`, as one writes it with nalgebra.
fn rk4(q: UnitQuaternion<f64>, momentum: Vector3<f64>, inv: Vector3<f64>, h: f64) -> UnitQuaternion<f64> {
    let rate = |q: Quaternion<f64>| {
        let omega = UnitQuaternion::new_unchecked(q).inverse_transform_vector(&momentum).component_mul(&inv);
        q * Quaternion::from_imag(omega) * 0.5
    };
    let start = q.into_inner();
    let k1 = rate(start);
    let k2 = rate(start + k1 * (0.5 * h));
    let k3 = rate(start + k2 * (0.5 * h));
    let k4 = rate(start + k3 * h);
    UnitQuaternion::new_normalize(start + (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0))
}

fn free_motion(c: &mut Criterion) {
    let mut group = c.benchmark_group("free motion");
    let (inertia, momentum) = body();
    let world = Vector3::new(momentum.e23, momentum.e31, momentum.e12);
    let inv = Vector3::from(MOMENTS.map(f64::recip));
    let mut q = UnitQuaternion::identity();
    group.bench_function("rk4 by nalgebra", |b| {
        b.iter(|| {
            q = rk4(black_box(q), world, inv, DT_S);
            q
        });
    });
    let mut turns = |name: &str, h: f64, turn: &dyn Fn(Rotor<f64>, f64) -> Rotor<f64>| {
        let mut rotor = Rotor::default();
        group.bench_function(name, |b| {
            b.iter(|| {
                rotor = turn(black_box(rotor), h);
                rotor
            });
        });
    };
    turns("turn", DT_S, &|rotor, h| free::turn(&inertia, rotor, momentum, h));
    turns("turn by 1 s", 1.0, &|rotor, h| free::turn(&inertia, rotor, momentum, h));
    for (name, composition) in [
        ("splitting2", Composition::Verlet),
        ("splitting4", Composition::Yoshida4),
        ("splitting6", Composition::Yoshida6),
    ] {
        turns(name, DT_S, &|rotor, h| {
            composition.weights().iter().fold(rotor, |rotor, w| axis_splitting::turn(&inertia, rotor, momentum, w * h))
        });
    }
    let motion = FreeMotion::new(&inertia, Rotor::default(), momentum);
    let mut t = 0.0;
    group.bench_function("at", |b| {
        b.iter(|| {
            t += DT_S;
            motion.at::<f64>(black_box(t))
        });
    });
    // Far from the separatrix, where the series is the other one.
    let spun = inertia.momentum_of(Bivector::new(0.3, 0.2, 1.0));
    let far = FreeMotion::new(&inertia, Rotor::default(), spun);
    group.bench_function("at, far from the separatrix", |b| {
        b.iter(|| {
            t += DT_S;
            far.at::<f64>(black_box(t))
        });
    });
    group.bench_function("prepare", |b| b.iter(|| FreeMotion::new(&inertia, Rotor::default(), black_box(momentum))));
    group.bench_function("prepare, far from the separatrix", |b| {
        b.iter(|| FreeMotion::new(&inertia, Rotor::default(), black_box(spun)));
    });
    group.finish();
}

criterion_group!(benches, free_motion);
criterion_main!(benches);

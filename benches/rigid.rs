//! Rigid bodies: the exact free motion, and a step of every formulation.
//!
//! ```sh
//! cargo bench --bench rigid --no-default-features --features study
//! ```
//!
//! `free motion` is a step of a body that nothing turns, of moments 1, 2, 3, spun about its middle axis:
//! RK4 on a quaternion by nalgebra, with renormalisation, is what the others are held against: with L in the world, and
//! with Euler's equations for omega, which is cheaper. Every step starts from the end of the one before, but for `at`,
//! which has no steps and is asked for the attitude at their ends.
//!
//! `formulations` steps such bodies, which also fly, by RK4 with `rotor::advance` and its siblings, and by the methods on
//! groups: one body, and a hundred that lie one after the other in the arrays.
#![allow(missing_docs, reason = "the macro's main function has no place for them")]
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use criterion::{Bencher, Criterion, Throughput, criterion_group, criterion_main};
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::{Bivector, Rotor, Vector};
use ga_physics::ode::lie::{CommutatorFree4, LieMethod, LieRungeKutta, LieState, Rkmk4};
use ga_physics::ode::{Composition, Rk4, RungeKutta};
use ga_physics::rigid::free::{self, FreeMotion};
use ga_physics::rigid::{
    Bodies, Formulation, Inertia, Method, Setup, Solver, System, axis_splitting, matrix, motor, quaternion, rotor,
};
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

/// The same with Euler's equations for omega in the body.
fn rk4_euler(
    q: Quaternion<f64>,
    omega: Vector3<f64>,
    moments: Vector3<f64>,
    h: f64,
) -> (Quaternion<f64>, Vector3<f64>) {
    let inv = moments.map(f64::recip);
    let rate = |q: Quaternion<f64>, omega: Vector3<f64>| {
        let torque = moments.component_mul(&omega).cross(&omega);
        (q * Quaternion::from_imag(omega) * 0.5, torque.component_mul(&inv))
    };
    let (q1, w1) = rate(q, omega);
    let (q2, w2) = rate(q + q1 * (0.5 * h), omega + w1 * (0.5 * h));
    let (q3, w3) = rate(q + q2 * (0.5 * h), omega + w2 * (0.5 * h));
    let (q4, w4) = rate(q + q3 * h, omega + w3 * h);
    let q = (q + (q1 + (q2 + q3) * 2.0 + q4) * (h / 6.0)).normalize();
    (q, omega + (w1 + (w2 + w3) * 2.0 + w4) * (h / 6.0))
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
    let (mut q, mut omega) = (Quaternion::identity(), Vector3::from(OMEGA_BODY));
    group.bench_function("rk4 by nalgebra, with omega", |b| {
        b.iter(|| {
            (q, omega) = rk4_euler(black_box(q), omega, black_box(Vector3::from(MOMENTS)), DT_S);
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

fn setting(count: usize) -> (Bodies<f64>, System<f64>) {
    let (inertia, spin) = body();
    let mut bodies = Bodies::default();
    for _ in 0..count {
        bodies.push(Point::origin(), Rotor::default(), Vector::new(0.1, 0.2, 0.3), spin);
    }
    let setup = Setup { inertias: vec![inertia; count], ..Setup::default() };
    let system = System::new(setup, &bodies, &Solver::fixed(Method::Rk4, DT_S)).unwrap();
    (bodies, system)
}

fn formulations(criterion: &mut Criterion) {
    for count in [1, 100] {
        let mut group = criterion.benchmark_group(format!("formulations, {count} bodies"));
        group.throughput(Throughput::Elements(count as u64));
        macro_rules! formulation {
            ($module:ident, $state:ty) => {
                group.bench_function(concat!(stringify!($module), " rk4"), |bencher| {
                    let (bodies, mut system) = setting(count);
                    let mut state = <$state>::from_bodies(&bodies);
                    let mut rk4 = RungeKutta::<Rk4, $state, f64>::new(state.clone(), state.zero_rates());
                    bencher.iter(|| $module::advance(&mut state, &mut rk4, &mut system, 0.0, black_box(DT_S)).unwrap());
                });
            };
        }
        formulation!(matrix, matrix::State<f64>);
        formulation!(quaternion, quaternion::State<f64>);
        formulation!(rotor, Bodies<f64>);
        formulation!(motor, motor::State<f64>);
        group.bench_function("rotor rkmk4", |bencher| on_group::<Rkmk4, Bodies<f64>>(bencher, count));
        group.bench_function("motor rkmk4", |bencher| on_group::<Rkmk4, motor::State<f64>>(bencher, count));
        group.bench_function("rotor commutator_free", |bencher| {
            on_group::<CommutatorFree4, Bodies<f64>>(bencher, count)
        });
        group.bench_function("motor commutator_free", |bencher| {
            on_group::<CommutatorFree4, motor::State<f64>>(bencher, count);
        });
        group.finish();
    }
}

/// A step by exponentials, then the same renormalisation.
fn on_group<M: LieMethod, F: Formulation<f64> + LieState<f64>>(bencher: &mut Bencher<'_>, count: usize)
where
    F::Rate: Clone,
{
    let (bodies, mut system) = setting(count);
    let mut state = F::from_bodies(&bodies);
    let mut method = LieRungeKutta::<M, F, f64>::new(state.clone(), state.zero_rates());
    bencher.iter(|| {
        method.step(&mut state, 0.0, black_box(DT_S), &mut system).unwrap();
        state.renormalise().unwrap()
    });
}

criterion_group!(benches, free_motion, formulations);
criterion_main!(benches);

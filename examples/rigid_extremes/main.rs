//! How far the motion of a single body can be trusted: a table for each of its limits.
//!
//! ```sh
//! cargo run --release --no-default-features --features physics --example rigid_extremes
//! ```
//!
//! References are Taylor series in double-double numbers, and for the heavy top a quadrature of theory: those of the tests.
#![allow(clippy::unwrap_used, reason = "an example may panic")]

#[path = "../../tests/heavy_top/body.rs"]
mod body;
mod limits;
mod million;
#[path = "../../tests/free_motion/reference.rs"]
mod reference;
#[path = "../../tests/heavy_top/theory.rs"]
mod theory;
mod top;

use ga_physics::algebra::Real;
use ga_physics::algebra::g3::{Bivector, Rotor};
use ga_physics::ode::Composition;
use ga_physics::rigid::free::{self, FreeMotion};
use ga_physics::rigid::{Inertia, axis_splitting};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use reference::Top;

fn main() {
    racket();
    million::table();
    limits::separatrix();
    limits::shapes_and_spins();
    top::frequencies();
    top::energy();
}

fn inertia<T: Real>(moments: [f64; 3]) -> Inertia<T> {
    let diagonal = std::array::from_fn(|r| std::array::from_fn(|c| if r == c { moments[r] } else { 0.0 }));
    Inertia::new(1.0, diagonal).unwrap()
}

/// `2E`, of the rotation that the rotor stands for.
fn energy<T: Real>(body: &Inertia<T>, rotor: Rotor<T>, momentum: Bivector<T>) -> f64 {
    let rotor = rotor.map(Real::to_f64).renormalise().unwrap();
    let in_body: [f64; 3] = rotor.rev().apply(momentum.map(Real::to_f64)).into();
    in_body.iter().zip(body.principal.moments).map(|(l, i)| l * l / i).sum()
}

/// The body of the tennis racket: 100 s, by every way there is.
fn racket() {
    let moments = [1.0, 2.0, 3.0];
    let body = inertia::<f64>(moments);
    let momentum = body.momentum_of(Bivector::new(0.01, 1.0, 0.01));
    let mut exact = Top::new(moments, Rotor::default(), momentum.into());
    exact.advance(100.0);
    let start = energy(&body, Rotor::default(), momentum);
    println!("## Moments 1, 2, 3, omega (0.01, 1, 0.01) rad/s, 100 s\n");
    println!("| method | step, s | attitude error, rad | energy error |\n|---|---|---|---|");
    let row = |name: &str, dt: f64, end: Rotor<f64>| {
        let drift = (energy(&body, end, momentum) / start - 1.0).abs();
        println!("| {name} | {dt} | {:.1e} | {drift:.1e} |", exact.angle_to(end));
    };
    row("RK4 on q, L in the world, nalgebra", 0.01, rk4(momentum, moments, 100.0, 10_000));
    row("RK4 on q and omega, nalgebra", 0.01, rk4_euler(momentum, moments, 100.0, 10_000));
    for (name, composition) in [
        ("splitting2", Composition::Verlet),
        ("splitting4", Composition::Yoshida4),
        ("splitting6", Composition::Yoshida6),
    ] {
        let weights = composition.weights();
        let step = |rotor, _| weights.iter().fold(rotor, |r, w| axis_splitting::turn(&body, r, momentum, w * 0.01));
        row(name, 0.01, (0..10_000).fold(Rotor::default(), step));
    }
    for dt in [1e-4, 0.01, 0.1, 1.0, 10.0] {
        let steps = (100.0_f64 / dt).round();
        let mut rotor = Rotor::default();
        let mut done = 0.0;
        while done < steps {
            rotor = free::turn(&body, rotor, momentum, dt);
            done += 1.0;
        }
        row("exact, step by step", dt, rotor);
    }
    row("exact, prepared once", 100.0, FreeMotion::new(&body, Rotor::default(), momentum).at(100.0));
    for (axis, tilt) in ["1", "2", "3"].iter().zip([[5e-17, 0.0, 0.0], [0.0, 5e-17, 0.0], [0.0, 0.0, 5e-17]]) {
        let start = Rotor::new(1.0, tilt[0], tilt[1], tilt[2]);
        let mut moved = Top::new(moments, start, momentum.into());
        moved.advance(100.0);
        println!("| the start turned by 1e-16 rad about axis {axis} | | {:.1e} | |", exact.angle_to(moved.rotor()));
    }
}

fn rk4(momentum: Bivector<f64>, moments: [f64; 3], duration: f64, steps: u32) -> Rotor<f64> {
    let momentum = Vector3::new(momentum.e23, momentum.e31, momentum.e12);
    let inv = Vector3::from(moments.map(f64::recip));
    let h = duration / f64::from(steps);
    let rate = |q: Quaternion<f64>| {
        let omega = UnitQuaternion::new_unchecked(q).inverse_transform_vector(&momentum).component_mul(&inv);
        q * Quaternion::from_imag(omega) * 0.5
    };
    let mut q = Quaternion::identity();
    for _ in 0..steps {
        let k1 = rate(q);
        let k2 = rate(q + k1 * (0.5 * h));
        let k3 = rate(q + k2 * (0.5 * h));
        let k4 = rate(q + k3 * h);
        q = (q + (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0)).normalize();
    }
    Rotor::new(q.w, -q.i, -q.j, -q.k)
}

/// The same with Euler's equations for omega in the body.
fn rk4_euler(momentum: Bivector<f64>, moments: [f64; 3], duration: f64, steps: u32) -> Rotor<f64> {
    let moments = Vector3::from(moments);
    let h = duration / f64::from(steps);
    let rate = |q: Quaternion<f64>, omega: Vector3<f64>| {
        let torque = moments.component_mul(&omega).cross(&omega);
        (q * Quaternion::from_imag(omega) * 0.5, torque.component_div(&moments))
    };
    let mut q = Quaternion::identity();
    let mut omega = Vector3::new(momentum.e23, momentum.e31, momentum.e12).component_div(&moments);
    for _ in 0..steps {
        let (q1, w1) = rate(q, omega);
        let (q2, w2) = rate(q + q1 * (0.5 * h), omega + w1 * (0.5 * h));
        let (q3, w3) = rate(q + q2 * (0.5 * h), omega + w2 * (0.5 * h));
        let (q4, w4) = rate(q + q3 * h, omega + w3 * h);
        q = (q + (q1 + (q2 + q3) * 2.0 + q4) * (h / 6.0)).normalize();
        omega += (w1 + (w2 + w3) * 2.0 + w4) * (h / 6.0);
    }
    Rotor::new(q.w, -q.i, -q.j, -q.k)
}

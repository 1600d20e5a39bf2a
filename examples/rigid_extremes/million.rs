//! A million steps: how the errors of energy, momentum and rotor norm grow.

use super::{energy, inertia};
use ga_physics::algebra::Real;
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::{Bivector, Rotor, Vector};
use ga_physics::rigid::{Bodies, Forces, Method, Motion, Setup, Solver};

const STEPS: u32 = 1_000_000;
const DT_S: f64 = 0.01;

pub(crate) fn table() {
    println!("\n## A million steps of 0.01 s\n");
    println!(
        "Through `Motion`. The largest error of the energy up to a number of steps; growth is the power of the number of \
         steps by which it went on from 10⁴ to 10⁶: 0 bounded, 1/2 a walk of roundings, 1 a drift.\n"
    );
    println!(
        "| body, omega, rad/s | scalar | method | 10² | 10⁴ | 10⁶ | growth | L | norm |\n|---|---|---|---|---|---|---|---|---|"
    );
    let cases: [(&str, [f64; 3], [f64; 3]); 4] = [
        ("1:2:3, (0.01, 1, 0.01)", [1.0, 2.0, 3.0], [0.01, 1.0, 0.01]),
        ("1:2:3, (0.5, 0.7, 0.3)", [1.0, 2.0, 3.0], [0.5, 0.7, 0.3]),
        ("1:1:1+1e-6, (0.3, 0.8, 0.2)", [1.0, 1.0, 1.0 + 1e-6], [0.3, 0.8, 0.2]),
        ("1:1e6:1e6, (1, 0.3, 0.2)", [1.0, 1e6, 1e6], [1.0, 0.3, 0.2]),
    ];
    for (name, moments, omega) in cases {
        for method in [Method::FreeFlight, Method::Verlet, Method::Yoshida6, Method::Splitting4, Method::Rk4] {
            run::<f64>(name, "f64", moments, omega, method);
        }
        run::<f32>(name, "f32", moments, omega, Method::FreeFlight);
        run::<f32>(name, "f32", moments, omega, Method::Verlet);
    }
}

fn run<T: Real>(name: &str, scalar: &str, moments: [f64; 3], omega: [f64; 3], method: Method) {
    let body = inertia::<T>(moments);
    let momentum = body.momentum_of(Bivector::from(omega.map(T::from_f64)));
    let mut bodies = Bodies::<T>::default();
    bodies.push(Point::origin(), Rotor::default(), Vector::default(), momentum);
    let setup = Setup { inertias: vec![body], forces: Forces::default(), joints: vec![] };
    let mut motion = Motion::new(setup, &bodies, &Solver::fixed(method, DT_S)).unwrap();
    let start = energy(&body, Rotor::default(), momentum);
    let (mut worst, mut kept, mut norm) = (0.0_f64, Vec::new(), 0.0_f64);
    for step in 1..=STEPS {
        if let Err(error) = motion.advance(&mut bodies, f64::from(step - 1) * DT_S, DT_S) {
            println!("| {name} | {scalar} | {} | {error} | | | | | |", method.name());
            return;
        }
        worst = worst.max((energy(&body, bodies.rotor[0], bodies.angular_momentum[0]) / start - 1.0).abs());
        norm = norm.max((bodies.rotor[0].map(Real::to_f64).norm_sq() - 1.0).abs());
        if [100, 10_000, STEPS].contains(&step) {
            kept.push(worst);
        }
    }
    let growth = (kept[2] / kept[1]).log10() / 2.0;
    let lost = (bodies.angular_momentum[0] - momentum).map(Real::to_f64).norm_sq().sqrt();
    let lost = lost / momentum.map(Real::to_f64).norm_sq().sqrt();
    println!(
        "| {name} | {scalar} | {} | {:.1e} | {:.1e} | {:.1e} | {growth:.2} | {lost:.0e} | {norm:.1e} |",
        method.name(),
        kept[0],
        kept[1],
        kept[2]
    );
}

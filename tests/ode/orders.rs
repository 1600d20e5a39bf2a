//! The observed order of every method, on problems with known solutions: two steps h and h/2, where the errors are far
//! above rounding. An order that is too high would be as wrong as one that is too low.

use crate::problems::{Kepler, bell, bell_solution, distance};
use ga_physics::ode::{
    CashKarp, Composition, Controlled, Dop853, Euler, Fixed, Rk4, Rk4Doubling, Run, Stepper, Symplectic, System,
    Tableau, Tsit5,
};

const TOLERANCE: f64 = 0.1;

/// The end of a run of n steps.
fn run<M: Tableau, const N: usize, Y: System<[f64; N], f64>>(mut system: Y, y: [f64; N], end: f64, n: u32) -> [f64; N]
where
    Y::Error: std::fmt::Debug,
    [f64; N]: Controlled<f64, Rate = [f64; N]>,
{
    let mut stepper = Fixed::<M, _, _>::new(0.0, y, [0.0; N], end / f64::from(n)).unwrap();
    for _ in 0..n {
        stepper.step(&mut system).unwrap();
    }
    *stepper.state()
}

fn check(name: &str, order: u32, errors: [f64; 2]) {
    let observed = (errors[0] / errors[1]).log2();
    println!("{name}: {observed:.3} {errors:?}");
    assert!((observed - f64::from(order)).abs() < TOLERANCE, "{name}: observed order {observed:.3}, errors {errors:?}");
}

fn method<M: Tableau>(name: &str, harmonic: u32, kepler: u32, nonlinear: u32) {
    let oscillator = |_: f64, y: &[f64; 2], rate: &mut [f64; 2]| *rate = [y[1], -y[0]];
    let errors = [1, 2]
        .map(|k| distance(&run::<M, 2, _>(oscillator, [1.0, 0.0], 2.0, k * harmonic), &[2_f64.cos(), -2_f64.sin()]));
    check(&format!("{name}, oscillator"), M::ORDER, errors);
    let exact = Kepler::solution(0.2, 2.0);
    let errors =
        [1, 2].map(|k| distance(&run::<M, 4, _>(Kepler::default(), Kepler::start(0.2), 2.0, k * kepler), &exact));
    check(&format!("{name}, Kepler"), M::ORDER, errors);
    let errors =
        [1, 2].map(|k| distance(&run::<M, 1, _>(bell, bell_solution(0.0), 1.0, k * nonlinear), &bell_solution(1.0)));
    check(&format!("{name}, bell"), M::ORDER, errors);
}

#[test]
fn runge_kutta_methods_have_their_order() {
    method::<Euler>("Euler", 2000, 4000, 2000);
    method::<Rk4>("RK4", 100, 200, 200);
    method::<Rk4Doubling>("RK4 doubling", 40, 100, 36);
    method::<CashKarp>("Cash-Karp", 40, 100, 36);
    method::<Tsit5>("Tsit5", 40, 100, 36);
    method::<Dop853>("DOP853", 8, 18, 8);
}

fn composition(composition: Composition, n: u32) {
    let end = |n: u32| {
        let mut stepper =
            Symplectic::<_, f64, _>::new(composition, 0.0, Kepler::start(0.2), [0.0; 2], 2.0 / f64::from(n)).unwrap();
        for _ in 0..n {
            stepper.step(&mut Kepler::default()).unwrap();
        }
        *stepper.state()
    };
    let exact = Kepler::solution(0.2, 2.0);
    check(&format!("{composition:?}"), composition.order(), [1, 2].map(|k| distance(&end(k * n), &exact)));
}

#[test]
fn compositions_have_their_order() {
    composition(Composition::Verlet, 500);
    composition(Composition::Yoshida4, 200);
    composition(Composition::Yoshida6, 100);
}

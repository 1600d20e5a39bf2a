//! The three-axis splitting and its compositions.

use super::{Numbers, Spun, angle, energy};
use ga_physics::algebra::g3::Rotor;
use ga_physics::ode::Composition;
use ga_physics::rigid::axis_splitting;

fn step(spun: &Spun, composition: Composition, rotor: Rotor<f64>, h_s: f64) -> Rotor<f64> {
    let parts = composition.weights().iter();
    parts.fold(rotor, |rotor, part| axis_splitting::turn(&spun.body, rotor, spun.momentum, part * h_s))
}

#[test]
fn the_observed_orders_are_those_of_the_compositions() {
    let spun = Spun::new([1.0, 2.0, 2.9], [0.3, 0.2, 0.4], Numbers(5).rotor());
    let exact = spun.motion().at::<f64>(10.0);
    // Steps as long as round-off allows.
    for (composition, coarse) in [(Composition::Verlet, 200), (Composition::Yoshida4, 100), (Composition::Yoshida6, 20)]
    {
        let error = |steps: u32| {
            let h_s = 10.0 / f64::from(steps);
            angle(exact, (0..steps).fold(spun.rotor, |rotor, _| step(&spun, composition, rotor, h_s)))
        };
        let order = (error(coarse) / error(2 * coarse)).log2();
        assert!((order - f64::from(composition.order())).abs() < 0.2, "{composition:?}: {order}");
    }
}

/// Symmetric, so back is back; and its energy swings without leaving.
#[test]
fn it_goes_back_and_its_energy_swings() {
    let mut numbers = Numbers(6);
    for _ in 0..50 {
        let spun = numbers.spun();
        let h_s = 0.5 * numbers.next() / spun.rate();
        let there = axis_splitting::turn(&spun.body, spun.rotor, spun.momentum, h_s);
        let back = axis_splitting::turn(&spun.body, there, spun.momentum, -h_s);
        assert!(angle(back, spun.rotor) < 1e-14);
        assert!((there.norm_sq() - 1.0).abs() < 1e-15);
    }
    let spun = Spun::new([1.0, 2.0, 2.9], [0.3, 0.2, 0.4], Rotor::default());
    let start = energy(&spun.body, spun.rotor, spun.momentum);
    let mut rotor = spun.rotor;
    let mut worst_of = |steps: u32| {
        let mut worst = 0.0_f64;
        for _ in 0..steps {
            rotor = axis_splitting::turn(&spun.body, rotor, spun.momentum, 0.1);
            worst = worst.max((energy(&spun.body, rotor, spun.momentum) / start - 1.0).abs());
        }
        worst
    };
    let (first, all) = (worst_of(1000), worst_of(10_000));
    assert!(first > 1e-6 && first < 1e-4 && all < 1.01 * first, "{first:e} {all:e}");
}

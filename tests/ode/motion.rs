//! Symplectic methods over long times: the energy errs by a bounded amount, where that of a Runge-Kutta method of the
//! same cost drifts.

use crate::problems::{Kepler, distance};
use ga_physics::ode::{Composition, Fixed, Mechanics, OdeError, Rk4, Run, Stepper, Symplectic};
use std::f64::consts::TAU;

/// The largest error of the energy, relative, in each of ten parts of a run.
fn energy_errors<P: Stepper<Kepler, State = [f64; 4]>>(mut stepper: P, periods: u32, steps_per_period: u32) -> [f64; 10]
where
    P::Error: std::fmt::Debug,
{
    let (mut kepler, start) = (Kepler::default(), Kepler::energy(*stepper.state()));
    std::array::from_fn(|_| {
        let mut worst = 0.0_f64;
        for _ in 0..periods / 10 * steps_per_period {
            stepper.step(&mut kepler).unwrap();
            worst = worst.max((Kepler::energy(*stepper.state()) / start - 1.0).abs());
        }
        worst
    })
}

fn symplectic(composition: Composition, periods: u32, steps: u32) -> [f64; 10] {
    let start = Kepler::start(0.3);
    let stepper = Symplectic::<_, f64, _>::new(composition, 0.0, start, [0.0; 2], TAU / f64::from(steps)).unwrap();
    energy_errors(stepper, periods, steps)
}

#[test]
fn energy_errs_by_a_bounded_amount() {
    for (composition, steps, most) in
        [(Composition::Verlet, 60, 1e-2), (Composition::Yoshida4, 60, 2e-3), (Composition::Yoshida6, 60, 1e-5)]
    {
        let errors = symplectic(composition, 1000, steps);
        println!("{composition:?}: {errors:?}");
        let (first, last) = (errors[0], errors[9]);
        assert!(last < most, "{composition:?}: {errors:?}");
        assert!(last < 1.05 * first, "the energy of {composition:?} drifts: {errors:?}");
    }
    // RK4 at the same cost as Yoshida 4 loses energy for good.
    let rk4 =
        energy_errors(Fixed::<Rk4, _, f64>::new(0.0, Kepler::start(0.3), [0.0; 4], TAU / 45.0).unwrap(), 1000, 45);
    println!("RK4: {rk4:?}");
    assert!(rk4[9] > 5.0 * rk4[0], "{rk4:?}");
}

/// A symmetric method run backwards retraces its steps.
#[test]
fn compositions_are_symmetric() {
    for composition in [Composition::Verlet, Composition::Yoshida4, Composition::Yoshida6] {
        let run = |start: [f64; 4]| {
            let mut stepper = Symplectic::<_, f64, _>::new(composition, 0.0, start, [0.0; 2], 0.1).unwrap();
            (0..50).for_each(|_| stepper.step(&mut Kepler::default()).unwrap());
            let [x, y, vx, vy] = *stepper.state();
            [x, y, -vx, -vy]
        };
        let back = run(run(Kepler::start(0.3)));
        assert!(distance(&back, &Kepler::start(0.3)) < 1e-12, "{composition:?}: {back:?}");
    }
}

#[test]
fn one_evaluation_a_substep() {
    for (composition, substeps) in [(Composition::Verlet, 1), (Composition::Yoshida4, 3), (Composition::Yoshida6, 7)] {
        let mut kepler = Kepler::default();
        let mut stepper = Symplectic::<_, f64, _>::new(composition, 0.0, Kepler::start(0.3), [0.0; 2], 0.1).unwrap();
        (0..10).for_each(|_| stepper.step(&mut kepler).unwrap());
        assert_eq!(
            (kepler.evals, stepper.work().rhs_evals, stepper.work().accepted),
            (1 + 10 * substeps, 1 + 10 * substeps, 10)
        );
        assert_eq!(composition.weights().len() as u64, substeps);
        assert!((composition.weights().iter().sum::<f64>() - 1.0).abs() < 1e-15);
    }
}

/// Falls, until the acceleration cannot be had.
struct Fall {
    fails_from_s: f64,
}

impl Mechanics<[f64; 2], f64> for Fall {
    type Error = f64;
    type Acceleration = f64;

    fn acceleration(&mut self, t_s: f64, _: &[f64; 2], out: &mut f64) -> Result<(), f64> {
        *out = -9.81;
        if t_s < self.fails_from_s { Ok(()) } else { Err(t_s) }
    }

    fn kick(&mut self, state: &mut [f64; 2], h_s: f64, acceleration: &f64) {
        state[1] += h_s * acceleration;
    }

    fn drift(&mut self, _: f64, state: &mut [f64; 2], h_s: f64) -> Result<(), f64> {
        state[0] += h_s * state[1];
        Ok(())
    }
}

#[test]
fn a_step_that_fails_leaves_the_state_before_it() {
    let mut fall = Fall { fails_from_s: 0.45 };
    let mut stepper = Symplectic::<_, f64, _>::new(Composition::Yoshida4, 0.0, [0.0, 0.0], 0.0, 0.1).unwrap();
    let mut out = [0.0; 2];
    let failed = stepper.advance_to(&mut fall, 1.0, &mut out);
    assert!(matches!(failed, Err(OdeError::System(t)) if t > 0.45), "{failed:?}");
    let (t, state) = (stepper.time_s(), *stepper.state());
    assert!(t < 0.45 && (state[0] + 0.5 * 9.81 * t * t).abs() < 1e-14, "{state:?} at {t}");
    // What was wrong is over: it goes on from there.
    fall.fails_from_s = f64::INFINITY;
    stepper.advance_to(&mut fall, 1.0, &mut out).unwrap();
    assert!((out[0] + 0.5 * 9.81).abs() < 1e-14, "{out:?}");
}

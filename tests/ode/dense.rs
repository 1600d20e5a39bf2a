//! The state at any time, whatever steps were taken: orders of dense output, output at a frame rate, stops.

use crate::problems::{Kepler, distance};
use ga_physics::ode::{
    Adaptive, CashKarp, Composition, Crossing, Dop853, Embedded, Euler, Event, Fixed, OdeError, Rk4, Rk4Doubling, Run,
    Stepper, Symplectic, Tableau, Tolerance, Tsit5, Watch,
};
use std::cell::Cell;
use std::convert::Infallible;
use std::f64::consts::PI;

const E: f64 = 0.3;

/// The error in the middle of the first step of a length, from which an order is seen.
fn error_within<P: Stepper<Kepler, State = [f64; 4]>>(mut stepper: P, h: f64) -> f64
where
    P::Error: std::fmt::Debug,
{
    let (mut out, mut kepler) = ([0.0; 4], Kepler::default());
    stepper.step(&mut kepler).unwrap();
    assert_eq!((stepper.start_s(), stepper.time_s()), (0.0, h));
    stepper.interpolate(&mut kepler, 0.4 * h, &mut out).unwrap();
    distance(&out, &Kepler::solution(E, 0.4 * h))
}

/// Within one step the error of output of order q falls like `h^(q + 1)`.
fn check(name: &str, order: u32, errors: [f64; 2]) {
    let observed = (errors[0] / errors[1]).log2() - 1.0;
    println!("{name}: {observed:.3} {errors:?}");
    assert!(
        (observed - f64::from(order)).abs() < 0.15,
        "dense output of {name}: observed order {observed:.3}, errors {errors:?}"
    );
}

#[test]
fn output_within_a_step_has_its_order() {
    fn fixed<M: Tableau>(name: &str, order: u32, h: f64) {
        check(
            name,
            order,
            [h, 0.5 * h].map(|h| error_within(Fixed::<M, _, f64>::new(0.0, Kepler::start(E), [0.0; 4], h).unwrap(), h)),
        );
    }
    fixed::<Euler>("Euler", 1, 0.01);
    fixed::<Rk4>("RK4", 3, 0.01);
    fixed::<Rk4Doubling>("RK4 doubling", 4, 0.02);
    fixed::<CashKarp>("Cash-Karp", 3, 0.01);
    fixed::<Tsit5>("Tsit5", 4, 0.02);
    fixed::<Dop853>("DOP853", 7, 0.08);
    for (composition, h) in [(Composition::Verlet, 0.01), (Composition::Yoshida4, 0.01), (Composition::Yoshida6, 0.04)]
    {
        let start = |h| Symplectic::<_, f64, _>::new(composition, 0.0, Kepler::start(E), [0.0; 2], h).unwrap();
        check(&format!("{composition:?}"), composition.order(), [h, 0.5 * h].map(|h| error_within(start(h), h)));
    }
}

/// The steps, and so the end, are the same however often output is asked for; all output is as good as the tolerance
/// says.
#[test]
fn output_at_a_frame_rate_changes_nothing() {
    fn run<M: Embedded>(frames: u32) -> ([f64; 4], f64, u64) {
        let tolerance = Tolerance { rtol: 1e-9, atol: 1e-9 };
        let mut stepper = Adaptive::<M, _, _>::new(0.0, Kepler::start(E), [0.0; 4], tolerance).unwrap();
        let (mut out, mut kepler, mut worst) = ([0.0; 4], Kepler::default(), 0.0_f64);
        for frame in 1..=frames {
            let t = 10.0 * f64::from(frame) / f64::from(frames);
            stepper.advance_to(&mut kepler, t, &mut out).unwrap();
            worst = worst.max(distance(&out, &Kepler::solution(E, t)));
        }
        let work = stepper.work();
        assert_eq!(work.rhs_evals, kepler.evals);
        (out, worst, work.accepted)
    }
    fn check<M: Embedded>(name: &str) {
        let (once, often) = (run::<M>(1), run::<M>(1000));
        assert_eq!((once.0, once.2), (often.0, often.2), "{name}");
        assert!(often.1 < 1e-6, "{name}: {:e}", often.1);
    }
    check::<Rk4Doubling>("RK4 doubling");
    check::<CashKarp>("Cash-Karp");
    check::<Tsit5>("Tsit5");
    check::<Dop853>("DOP853");
}

/// A push that ends at t = 1 is integrated exactly where no step goes past its end, and the rate is asked for anew
/// there.
#[test]
fn no_step_goes_past_a_stop() {
    let force = Cell::new(3.0);
    let mut push = |_: f64, _: &[f64; 1], rate: &mut [f64; 1]| *rate = [force.get()];
    let mut stepper = Adaptive::<Dop853, _, _>::new(0.0, [0.0], [0.0], Tolerance { rtol: 1e-9, atol: 1e-9 }).unwrap();
    let mut out = [0.0_f64];
    stepper.stop_at(1.0);
    stepper.advance_to(&mut push, 1.0, &mut out).unwrap();
    assert_eq!(stepper.time_s(), 1.0);
    force.set(0.0);
    stepper.restart(1.0, &out);
    stepper.stop_at(f64::INFINITY);
    stepper.advance_to(&mut push, 2.0, &mut out).unwrap();
    assert!(stepper.time_s() >= 2.0);
    assert!((out[0] - 3.0).abs() < 1e-14, "{out:?}");
    // Equal steps: the one before the stop is shorter.
    let mut stepper = Fixed::<Rk4, _, _>::new(0.0, [0.0_f64], [0.0], 0.3).unwrap();
    let mut clock = |t: f64, _: &[f64; 1], rate: &mut [f64; 1]| *rate = [3.0 * t * t];
    stepper.stop_at(1.0);
    stepper.advance_to(&mut clock, 1.0, &mut out).unwrap();
    assert!(stepper.time_s() == 1.0 && (out[0] - 1.0).abs() < 1e-14, "{out:?}");
    // At the stop there is no step to make.
    assert_eq!(stepper.step(&mut clock), Err(OdeError::Stopped { stop_s: 1.0 }));
}

#[test]
fn time_does_not_run_backwards() {
    let mut kepler = Kepler::default();
    let mut stepper = Fixed::<Rk4, _, f64>::new(0.0, Kepler::start(E), [0.0; 4], 0.25).unwrap();
    let mut out = [0.0; 4];
    stepper.advance_to(&mut kepler, 0.6, &mut out).unwrap();
    assert_eq!(stepper.advance_to(&mut kepler, 0.55, &mut out), Ok(()));
    assert_eq!(stepper.advance_to(&mut kepler, 0.4, &mut out), Err(OdeError::Past { asked_s: 0.4, from_s: 0.5 }));
    // Equal steps end where a product says, not a sum.
    let mut stepper = Fixed::<Euler, _, f64>::new(0.0, [0.0], [0.0], 0.1).unwrap();
    let mut still = |_: f64, _: &[f64; 1], rate: &mut [f64; 1]| *rate = [1.0];
    stepper.advance_to(&mut still, 1000.0, &mut [0.0]).unwrap();
    assert_eq!(stepper.time_s(), 1000.0);
}

/// The method is chosen at run time; all come to the same place, and see the same events.
#[test]
fn steppers_are_interchangeable() {
    type Any = Box<dyn Stepper<Kepler, State = [f64; 4], Error = Infallible>>;
    fn fixed<M: Tableau + 'static>() -> Any {
        Box::new(Fixed::<M, _, f64>::new(0.0, Kepler::start(E), [0.0; 4], 0.01).unwrap())
    }
    fn adaptive<M: Embedded + 'static>() -> Any {
        let tolerance = Tolerance { rtol: 1e-8, atol: 1e-8 };
        Box::new(Adaptive::<M, _, _>::new(0.0, Kepler::start(E), [0.0; 4], tolerance).unwrap())
    }
    fn symplectic(composition: Composition) -> Any {
        Box::new(Symplectic::<_, f64, _>::new(composition, 0.0, Kepler::start(E), [0.0; 2], 0.01).unwrap())
    }
    let all = [
        fixed::<Rk4>(),
        adaptive::<Rk4Doubling>(),
        adaptive::<CashKarp>(),
        adaptive::<Tsit5>(),
        adaptive::<Dop853>(),
        symplectic(Composition::Yoshida4),
        symplectic(Composition::Yoshida6),
    ];
    for (index, mut stepper) in all.into_iter().enumerate() {
        let (mut kepler, mut out) = (Kepler::default(), [0.0; 4]);
        let mut watch = Watch::new(0.0, [Event::new(Crossing::Either, |_, y: &[f64; 4]| y[1]).terminal()]);
        let hit = stepper.advance_watching(&mut kepler, 5.0, &mut watch, &mut out, &mut |_, _| ()).unwrap().unwrap();
        assert!((hit.time_s - PI).abs() < 1e-6, "{index}: {hit:?}");
        stepper.advance_to(&mut kepler, 5.0, &mut out).unwrap();
        assert!(distance(&out, &Kepler::solution(E, 5.0)) < 1e-6, "{index}: {out:?}");
    }
}

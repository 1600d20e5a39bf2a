//! Step control: errors follow the tolerance, work is counted, what cannot be integrated is a typed error with a
//! remedy.

use crate::problems::{Kepler, distance};
use ga_physics::nalgebra::SVector;
use ga_physics::ode::{
    Adaptive, CashKarp, Controlled, Dop853, Embedded, Fixed, OdeError, Rk4, Rk4Doubling, Run, State, Stepper, System,
    Tolerance, ToleranceError, Tsit5, Work,
};
use std::f64::consts::TAU;

/// A run to exactly the end: its error and what it cost.
fn kepler<M: Embedded>(eccentricity: f64, periods: f64, tolerance: f64) -> (f64, Work) {
    let tolerance = Tolerance { rtol: tolerance, atol: tolerance };
    let mut stepper = Adaptive::<M, _, _>::new(0.0, Kepler::start(eccentricity), [0.0; 4], tolerance).unwrap();
    let (mut system, mut out) = (Kepler::default(), [0.0; 4]);
    stepper.stop_at(periods * TAU);
    stepper.advance_to(&mut system, periods * TAU, &mut out).unwrap();
    assert_eq!(system.evals, stepper.work().rhs_evals);
    let [x, y, ..] = Kepler::start(eccentricity);
    ((out[0] - x).hypot(out[1] - y), stepper.work())
}

#[test]
fn errors_follow_the_tolerance() {
    fn check<M: Embedded>(name: &str) {
        let mut before = f64::INFINITY;
        for tolerance in [1e-5, 1e-7, 1e-9, 1e-11] {
            let error = kepler::<M>(0.6, 1.0, tolerance).0;
            // An orbit gathers the errors of its steps.
            assert!(error < 1000.0 * tolerance && error < before, "{name}: {error:e} at {tolerance:e}");
            before = error;
        }
    }
    check::<Rk4Doubling>("RK4 doubling");
    check::<CashKarp>("Cash-Karp");
    check::<Tsit5>("Tsit5");
    check::<Dop853>("DOP853");
}

/// The evaluations for an error, between the tolerances next to it.
fn evals_for<M: Embedded>(error: f64) -> f64 {
    let mut before: Option<(f64, f64)> = None;
    for step in 8..56 {
        let (found, work) = kepler::<M>(0.6, 3.0, 10_f64.powf(-0.25 * f64::from(step)));
        let now = (found.ln(), (work.rhs_evals as f64).ln());
        if found <= error {
            let (from, evals) = before.unwrap();
            return (evals + (now.1 - evals) * (error.ln() - from) / (now.0 - from)).exp();
        }
        before = Some(now);
    }
    panic!("no tolerance gives {error:e}");
}

/// What an eighth order is for: three orbits of eccentricity 0.6.
#[test]
fn dop853_needs_far_fewer_evaluations_than_cash_karp() {
    for (error, most) in [(1e-6, 0.55), (1e-9, 0.25)] {
        let (eighth, fifth) = (evals_for::<Dop853>(error), evals_for::<CashKarp>(error));
        println!("{error:e}: {eighth:.0} and {fifth:.0}");
        assert!(eighth < most * fifth, "{error:e}: {eighth:.0} and {fifth:.0} evaluations");
    }
}

/// An orbit of eccentricity 0.9: the steps on the way to the near point shrink by the same factor again and again,
/// which the controller foresees. Without its trend a quarter of the steps fail.
#[test]
fn few_steps_fail_on_an_eccentric_orbit() {
    let (error, work) = kepler::<Dop853>(0.9, 10.0, 1e-12);
    println!("{error:e}, {work:?}");
    assert!(error < 1e-8 && work.rhs_evals < 17_000 && work.rejected * 20 < work.accepted, "{error:e}, {work:?}");
}

#[test]
fn a_tolerance_below_the_numbers_is_refused_with_the_least() {
    let double = Tolerance { rtol: 1e-15, atol: 0.0 };
    let refused = Adaptive::<Tsit5, _, _>::new(0.0, [1.0], [0.0], double).unwrap_err();
    assert_eq!(refused, ToleranceError::Relative { rtol: 1e-15, least: 10.0 * f64::EPSILON });
    assert!(refused.to_string().contains("2.22"), "{refused}");
    let single = Tolerance { rtol: 1e-7_f32, atol: 0.0 };
    assert!(Adaptive::<Tsit5, _, _>::new(0.0, [1.0_f32], [0.0], single).is_err());
    for atol in [-1e-9, f64::NAN, f64::INFINITY] {
        let refused = Tolerance { rtol: 1e-6, atol }.check();
        assert!(matches!(refused, Err(ToleranceError::Absolute { .. })), "{refused:?}");
    }
    assert!(Tolerance { rtol: f64::NAN, atol: 0.0 }.check().is_err());
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Fixed::<Rk4, _, f64>::new(0.0, [1.0], [0.0], step).is_err());
    }
}

fn error_of<Y: System<[f64; 1], f64>>(system: &mut Y, y: f64, until: f64) -> (OdeError<Y::Error>, f64, [f64; 1])
where
    Y::Error: std::fmt::Debug,
{
    let tolerance = Tolerance { rtol: 1e-8, atol: 1e-8 };
    let mut stepper = Adaptive::<Dop853, _, _>::new(0.0, [y], [0.0], tolerance).unwrap().with_max_steps(10_000);
    let error = stepper.advance_to(system, until, &mut [0.0]).unwrap_err();
    (error, stepper.time_s(), *stepper.state())
}

/// `y' = y²` from 1 is infinite at t = 1: the steps shrink until they do not move the time.
#[test]
fn a_solution_that_runs_away_is_an_error_at_its_time() {
    let (error, time, [y]) = error_of(&mut |_: f64, [y]: &[f64; 1], rate: &mut [f64; 1]| *rate = [y * y], 1.0, 2.0);
    assert!(matches!(error, OdeError::StepTooSmall { time_s, step_s } if time_s == time && step_s < 1e-15), "{error}");
    assert!((time - 1.0).abs() < 1e-6 && y.is_finite() && y > 1e6, "{error}: {time}, {y}");
    assert!(error.to_string().contains("larger error"), "{error}");
}

/// A rate that is not a number beyond t = 1/2 rejects steps until one ends before.
#[test]
fn not_a_number_rejects_a_step() {
    let mut system = |t: f64, _: &[f64; 1], rate: &mut [f64; 1]| *rate = [if t < 0.5 { 1.0 } else { f64::NAN }];
    let (error, time, [y]) = error_of(&mut system, 0.0, 2.0);
    assert!(matches!(error, OdeError::StepTooSmall { .. }), "{error}");
    assert!((0.49..0.5).contains(&time) && (y - time).abs() < 1e-12, "{error}: {time}, {y}");
    // With steps of one length it cannot be stepped around.
    let mut stepper = Fixed::<Rk4, _, _>::new(0.0, [0.0], [0.0], 0.2).unwrap();
    let error = stepper.advance_to(&mut system, 2.0, &mut [0.0]).unwrap_err();
    assert!(matches!(error, OdeError::NotFinite { time_s, step_s: 0.2 } if (time_s - 0.6).abs() < 1e-15), "{error}");
    assert!((stepper.time_s() - 0.4).abs() < 1e-15 && (stepper.state()[0] - 0.4).abs() < 1e-15);
}

/// A stiff decay holds the tolerance at any cost; the number of steps does not.
#[test]
fn steps_without_end_are_an_error() {
    let mut stiff = |_: f64, [y]: &[f64; 1], rate: &mut [f64; 1]| *rate = [-1e7 * (y - 1.0)];
    let (error, time, _) = error_of(&mut stiff, 0.0, 1.0);
    assert!(
        matches!(error, OdeError::TooManySteps { steps: 10_000, to_s: 1.0, time_s, .. } if time_s == time),
        "{error}"
    );
}

/// A system with an error of its own, and a state that is put back onto a circle.
struct Circle {
    fails_from_s: f64,
    evals: u64,
}

impl System<[f64; 2], f64> for Circle {
    type Error = &'static str;

    fn rate(&mut self, t_s: f64, [x, y]: &[f64; 2], rate: &mut [f64; 2]) -> Result<(), &'static str> {
        self.evals += 1;
        *rate = [-y, *x];
        if t_s < self.fails_from_s { Ok(()) } else { Err("lost") }
    }

    fn settle(&mut self, _: f64, state: &mut [f64; 2]) -> Result<bool, &'static str> {
        let length = state[0].hypot(state[1]);
        *state = state.map(|x| x / length);
        Ok(true)
    }
}

#[test]
fn an_error_of_the_system_leaves_the_last_good_step() {
    let mut circle = Circle { fails_from_s: 5.0, evals: 0 };
    let mut stepper =
        Adaptive::<Tsit5, _, _>::new(0.0, [1.0, 0.0], [0.0; 2], Tolerance { rtol: 1e-4, atol: 1e-4 }).unwrap();
    let mut out = [0.0; 2];
    assert_eq!(stepper.advance_to(&mut circle, 10.0, &mut out), Err(OdeError::System("lost")));
    let (t, state) = (stepper.time_s(), *stepper.state());
    assert!(t < 5.0 && distance(&state, &[t.cos(), t.sin()]) < 1e-2, "{state:?} at {t}");
    circle.fails_from_s = f64::INFINITY;
    stepper.advance_to(&mut circle, 10.0, &mut out).unwrap();
    assert!(distance(&out, &[10_f64.cos(), 10_f64.sin()]) < 1e-2, "{out:?}");
}

/// Also at a coarse tolerance, also between the ends of steps, the state is where it must be; the rate at a state that
/// was moved is asked for anew.
#[test]
fn settled_states_stay_on_their_circle() {
    let mut circle = Circle { fails_from_s: f64::INFINITY, evals: 0 };
    let mut stepper =
        Adaptive::<Tsit5, _, _>::new(0.0, [1.0, 0.0], [0.0; 2], Tolerance { rtol: 1e-3, atol: 1e-3 }).unwrap();
    let mut out = [0.0; 2];
    for frame in 1..100 {
        stepper.advance_to(&mut circle, 0.1 * f64::from(frame), &mut out).unwrap();
        assert!((out[0].hypot(out[1]) - 1.0).abs() < 4e-16, "{out:?}");
    }
    let work = stepper.work();
    assert_eq!(work.rhs_evals, circle.evals);
    // Six of each try, one more after each step, two at the start.
    assert_eq!(work.rhs_evals, 7 * work.accepted + 6 * work.rejected + 2);
}

/// Single precision holds a tolerance that it can hold.
#[test]
fn f32_reaches_its_tolerance() {
    let mut oscillator = |_: f64, y: &[f32; 2], rate: &mut [f32; 2]| *rate = [y[1], -y[0]];
    let mut stepper =
        Adaptive::<Dop853, _, _>::new(0.0, [1.0_f32, 0.0], [0.0; 2], Tolerance { rtol: 2e-6, atol: 2e-6 }).unwrap();
    let mut out = [0.0; 2];
    stepper.advance_to(&mut oscillator, 10.0, &mut out).unwrap();
    assert!((f64::from(out[0]) - 10_f64.cos()).abs() < 1e-5, "{out:?}");
}

/// Numbers of any scale and a start at rest: the first step is found, also where all is zero or immense.
#[test]
fn a_first_step_is_found_at_every_scale() {
    for scale in [1e-200, 1e-30, 1.0, 1e30, 1e150] {
        let mut rising = |t: f64, _: &[f64; 1], rate: &mut [f64; 1]| *rate = [scale * t];
        let tolerance = Tolerance { rtol: 1e-8, atol: 1e-8 * scale };
        let mut stepper = Adaptive::<CashKarp, _, _>::new(0.0, [0.0], [0.0], tolerance).unwrap();
        let mut out = [0.0];
        stepper.advance_to(&mut rising, 2.0, &mut out).unwrap();
        assert!((out[0] / scale - 2.0).abs() < 1e-7, "{scale:e}: {out:?}");
        assert!(stepper.work().accepted < 60, "{scale:e}: {:?}", stepper.work());
    }
    // Nothing ever moves.
    let mut still = |_: f64, _: &[f64; 1], rate: &mut [f64; 1]| *rate = [0.0];
    let mut stepper = Adaptive::<Dop853, _, _>::new(0.0, [0.0], [0.0], Tolerance { rtol: 1e-8, atol: 0.0 }).unwrap();
    stepper.advance_to(&mut still, 1e6, &mut [0.0]).unwrap();
    assert!(stepper.work().accepted < 60);
}

/// Arrays, vectors and nalgebra's vectors do the same arithmetic.
#[test]
fn kinds_of_state_agree() {
    fn end<S: Controlled<f64, Rate = S> + State<f64> + Clone + AsRef<[f64]>>(
        start: S,
        rate: impl FnMut(f64, &S, &mut S),
    ) -> Vec<f64> {
        let mut stepper =
            Adaptive::<Dop853, _, _>::new(0.0, start.clone(), start.clone(), Tolerance { rtol: 1e-10, atol: 1e-10 })
                .unwrap();
        let (mut out, mut rate) = (start, rate);
        stepper.advance_to(&mut rate, 3.0, &mut out).unwrap();
        out.as_ref().to_vec()
    }
    const N: usize = 11;
    let start: [f64; N] = std::array::from_fn(|i| 1.0 + 0.1 * i as f64);
    fn coupled(y: &[f64], rate: &mut [f64]) {
        for i in 0..N {
            rate[i] = (y[(i + 1) % N] - y[i]).sin();
        }
    }
    let array = end(start, |_, y, rate| coupled(y, rate));
    let vector = end(start.to_vec(), |_, y, rate| coupled(y, rate));
    assert_eq!(array, vector);
    let mut stepper = Adaptive::<Dop853, _, _>::new(
        0.0,
        SVector::<f64, N>::from(start),
        SVector::<f64, N>::from(start),
        Tolerance { rtol: 1e-10, atol: 1e-10 },
    )
    .unwrap();
    let mut out = *stepper.state();
    let mut rate = |_: f64, y: &SVector<f64, N>, rate: &mut SVector<f64, N>| {
        coupled(y.as_slice(), rate.as_mut_slice());
    };
    stepper.advance_to(&mut rate, 3.0, &mut out).unwrap();
    assert_eq!(array, out.as_slice());
}

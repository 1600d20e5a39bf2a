//! What no step can do is told, and ends.

use ga_physics::ode::{Adaptive, CashKarp, Controlled, OdeError, State, Stepper, Tolerance};

/// A number that no step gets right: by this much too wrong, however short the step.
#[derive(Clone)]
struct Never {
    y: f64,
    ratio: f64,
}

impl State<f64> for Never {
    type Rate = f64;

    fn assign(&mut self, other: &Self) {
        self.clone_from(other);
    }

    fn add_scaled(&mut self, terms: &[(f64, &f64)]) {
        self.y += terms.iter().map(|(h, k)| h * *k).sum::<f64>();
    }
}

impl Controlled<f64> for Never {
    fn error_ratio(&self, _: &Self, _: &[(f64, &f64)], _: Tolerance<f64>) -> f64 {
        self.ratio
    }
}

/// The shortest steps of a time far from 0 are few units of its rounding: nine tenths of two of them are two of them.
#[test]
fn a_step_that_never_gets_good_ends_the_run() {
    for ratio in [1.0 + 1e-9, 1.1, 2.0, f64::NAN] {
        for start_s in [0.0, 1.0, 526.2456447187476] {
            let (state, tolerance) = (Never { y: 0.0, ratio }, Tolerance { rtol: 1e-3, atol: 1e-3 });
            let mut stepper = Adaptive::<CashKarp, _, f64>::new(start_s, state.clone(), 0.0, tolerance).unwrap();
            let (mut end, mut calls) = (state, 0_u32);
            let mut rate = |_: f64, _: &Never, rate: &mut f64| {
                *rate = 1.0;
                calls += 1;
                assert!(calls < 100_000, "ratio {ratio} at {start_s} s: the same step again and again");
            };
            let error = stepper.advance_to(&mut rate, start_s + 10.0, &mut end).unwrap_err();
            assert!(matches!(error, OdeError::StepTooSmall { time_s, .. } if time_s == start_s), "{error}");
        }
    }
}

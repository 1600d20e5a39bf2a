//! Events, and the roots they are located by.

use crate::problems::Kepler;
use ga_physics::ode::root::{Sample, find};
use ga_physics::ode::{
    Adaptive, CashKarp, Crossing, Dop853, Event, Fixed, Hit, OdeError, Rk4, Run, Stepper, Tolerance, Watch,
};
use proptest::prelude::*;
use std::convert::Infallible;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn oscillator(_: f64, y: &[f64; 2], rate: &mut [f64; 2]) {
    *rate = [y[1], -y[0]];
}

fn tight() -> Tolerance<f64> {
    Tolerance { rtol: 3e-14, atol: 1e-15 }
}

/// The times of all events until t = 20 of an oscillator `cos t`.
fn crossings(crossing: Crossing) -> Vec<Hit> {
    let mut stepper = Adaptive::<Dop853, _, _>::new(0.0, [1.0, 0.0], [0.0; 2], tight()).unwrap();
    let mut watch = Watch::new(0.0, [Event::new(crossing, |_, y: &[f64; 2]| y[0])]);
    let mut hits = vec![];
    let end = stepper
        .advance_watching(&mut oscillator, 20.0, &mut watch, &mut [0.0; 2], &mut |hit, _| hits.push(hit))
        .unwrap();
    assert_eq!(end, None);
    hits
}

#[test]
fn events_are_exact_to_1e_12_and_have_a_direction() {
    let check = |hits: &[Hit], first: f64, distance: f64, rising: &dyn Fn(usize) -> bool, count: usize| {
        assert_eq!(hits.len(), count);
        for (index, hit) in hits.iter().enumerate() {
            let exact = first + index as f64 * distance;
            assert!((hit.time_s / exact - 1.0).abs() < 1e-12, "{hit:?}: {exact}");
            assert_eq!((hit.event, hit.rising), (0, rising(index)));
        }
    };
    check(&crossings(Crossing::Either), FRAC_PI_2, PI, &|index| index % 2 == 1, 6);
    check(&crossings(Crossing::Rising), 3.0 * FRAC_PI_2, TAU, &|_| true, 3);
    check(&crossings(Crossing::Falling), FRAC_PI_2, TAU, &|_| false, 3);
}

/// Near points of an orbit of eccentricity 0.9: the steps there are small, elsewhere large.
#[test]
fn near_points_of_an_orbit_are_a_period_apart() {
    let mut stepper = Adaptive::<Dop853, _, _>::new(0.0, Kepler::start(0.9), [0.0; 4], tight()).unwrap();
    let radial = |_: f64, [x, y, vx, vy]: &[f64; 4]| x * vx + y * vy;
    let mut watch = Watch::new(0.0, [Event::new(Crossing::Rising, radial), Event::new(Crossing::Falling, radial)]);
    let mut hits = vec![];
    stepper
        .advance_watching(&mut Kepler::default(), 20.0, &mut watch, &mut [0.0; 4], &mut |hit, _| hits.push(hit))
        .unwrap();
    let found: Vec<_> = hits.iter().map(|hit| (hit.event, hit.time_s / PI)).collect();
    assert_eq!(found.iter().map(|hit| hit.0).collect::<Vec<_>>(), [1, 0, 1, 0, 1, 0]);
    for (index, (_, half_periods)) in found.iter().enumerate() {
        // The period itself is known to the error of the orbit.
        assert!((half_periods / (index + 1) as f64 - 1.0).abs() < 1e-11, "{found:?}");
    }
}

/// A ball that bounces with restitution 1/2: impacts at times known in closed form.
#[test]
fn a_bouncing_ball_goes_on_from_each_impact() {
    const G: f64 = 9.81;
    let mut fall = |_: f64, y: &[f64; 2], rate: &mut [f64; 2]| *rate = [y[1], -G];
    let mut stepper =
        Adaptive::<CashKarp, _, _>::new(0.0, [1.0, 0.0], [0.0; 2], Tolerance { rtol: 1e-10, atol: 1e-10 }).unwrap();
    let mut watch = Watch::new(0.0, [Event::new(Crossing::Falling, |_, y: &[f64; 2]| y[0]).terminal()]);
    let mut state = [0.0; 2];
    let (mut exact, mut speed) = ((2.0 / G).sqrt(), (2.0 * G).sqrt());
    for _ in 0..10 {
        let hit = stepper.advance_watching(&mut fall, 100.0, &mut watch, &mut state, &mut |_, _| ()).unwrap().unwrap();
        assert!((hit.time_s / exact - 1.0).abs() < 1e-12, "{hit:?}: {exact}");
        assert!((state[1] / -speed - 1.0).abs() < 1e-12 && state[0].abs() < 1e-13, "{state:?}");
        state = [0.0, -0.5 * state[1]];
        stepper.restart(hit.time_s, &state);
        watch.restart(hit.time_s);
        speed *= 0.5;
        exact += 2.0 * speed / G;
    }
}

#[test]
fn an_event_that_ends_the_run_is_not_found_again() {
    let mut stepper = Fixed::<Rk4, _, _>::new(0.0, [1.0, 0.0], [0.0; 2], 0.5).unwrap();
    let mut watch = Watch::new(
        0.0,
        [
            Event::new(Crossing::Either, |_, y: &[f64; 2]| y[0]).terminal(),
            Event::new(Crossing::Rising, |t, _: &[f64; 2]| t - 1.6).terminal(),
        ],
    );
    let (mut out, mut found) = ([0.0; 2], vec![]);
    while let Some(hit) = stepper.advance_watching(&mut oscillator, 8.0, &mut watch, &mut out, &mut |_, _| ()).unwrap()
    {
        found.push(hit.event);
        if hit.event == 0 {
            assert!(out[0].abs() < 1e-15, "{out:?}");
        } else {
            assert!((hit.time_s - 1.6).abs() < 1e-15);
        }
    }
    assert_eq!(found, [0, 1, 0, 0]);
}

#[test]
fn an_event_without_a_value_is_an_error() {
    let mut stepper = Fixed::<Rk4, _, _>::new(0.0, [1.0, 0.0], [0.0; 2], 0.5).unwrap();
    let mut watch = Watch::new(0.0, [Event::new(Crossing::Either, |_, y: &[f64; 2]| y[0].sqrt())]);
    let failed = stepper.advance_watching(&mut oscillator, 8.0, &mut watch, &mut [0.0; 2], &mut |_, _| ());
    assert!(
        matches!(failed, Err(OdeError::EventNotANumber { event: 0, time_s }) if time_s > FRAC_PI_2 && time_s < 2.0),
        "{failed:?}"
    );
}

/// The root, and how often the function was asked.
fn solve(f: impl Fn(f64) -> f64, a: f64, b: f64) -> (f64, u32) {
    let mut calls = 0;
    let count = |x: f64| {
        calls += 1;
        Ok::<_, Infallible>(f(x))
    };
    let Ok(root) = find(count, Sample { x: a, f: f(a) }, Sample { x: b, f: f(b) });
    (root.x, calls)
}

/// Hard cases of the paper's table: steep, flat, with poles beyond the bracket, multiple roots.
#[test]
fn hard_roots_are_found_within_few_calls() {
    let near = |(found, calls): (f64, u32), root: f64, most: u32| {
        assert!((found - root).abs() <= 4.0 * f64::EPSILON * root.abs().max(1e-300), "{found} is not {root}");
        assert!(calls <= most, "{calls} calls to {root}");
    };
    near(solve(|x| x.sin() - 0.5 * x, FRAC_PI_2, PI), 1.895_494_267_033_981, 12);
    near(solve(|x| (-x).exp() - 1e-10, 0.0, 100.0), 1e10_f64.ln(), 50);
    near(solve(|x| x * x - 1e20, 0.0, 1e30), 1e10, 140);
    near(solve(|x| x.powi(19) - 0.2_f64.powi(19), 0.0, 5.0), 0.2, 80);
    near(solve(|x| 1.0 / x - 1e6, 1e-8, 1.0), 1e-6, 80);
    // A step: no better than bisection can be.
    near(solve(|x| if x < 0.3 { -1.0 } else { 1.0 }, 0.0, 1.0), 0.3, 160);
    // A triple root is known to no better than the cube root of what the value resolves; the sign is right all the
    // same.
    assert!((solve(|x| (x - 0.7).powi(3), 0.0, 1.0).0 - 0.7).abs() < 1e-15);
}

proptest! {
    /// The sign changes within a few spacings of what is returned, whatever the function.
    #[test]
    fn a_root_is_where_the_sign_changes(c in proptest::array::uniform4(-3.0..3.0_f64), a in -5.0..5.0_f64, width in 1e-9..10.0_f64) {
        let f = |x: f64| c[0] + x * (c[1] + x * (c[2] + x * c[3])) + (7.0 * x).sin();
        let b = a + width;
        prop_assume!(f(a) * f(b) < 0.0);
        let (root, calls) = solve(f, a, b);
        let margin = 8.0 * f64::EPSILON * a.abs().max(b.abs());
        prop_assert!(root >= a && root <= b);
        prop_assert!(f(root) == 0.0 || f(root - margin) * f(root + margin) <= 0.0 || margin > width, "{root}: {} {}", f(root - margin), f(root + margin));
        prop_assert!(calls <= 60, "{calls} calls");
    }
}

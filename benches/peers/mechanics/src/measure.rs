//! What a run is judged by: length violation, energy drift, CPU time. The same code for all peers.
//!
//! A run is watched once, untimed, with its state read after every step; then all peers are timed in turn, in rounds, with
//! nothing in the clock but their steps.

use crate::cases::{Case, Vector, distance};
use cpu_time::ThreadTime;
use std::time::Duration;

/// An engine in which a case has been built.
pub trait Engine {
    /// Advances by the step of the case, or says why it cannot.
    fn step(&mut self) -> Result<(), String>;
    fn read(&self, position_m: &mut Vec<Vector>, velocity_m_s: &mut Vec<Vector>);
}

type Build = dyn Fn(&Case) -> Result<Box<dyn Engine>, String>;

/// A way to run a case.
pub struct Way {
    pub name: &'static str,
    build: Box<Build>,
}

impl Way {
    pub fn new(name: &'static str, build: impl Fn(&Case) -> Result<Box<dyn Engine>, String> + 'static) -> Self {
        Self { name, build: Box::new(build) }
    }
}

/// The errors of a run.
#[derive(Clone, Default)]
pub struct Watched {
    /// max (length / start length - 1) over links and steps: what a rope forbids.
    pub stretch: f64,
    /// max |length / start length - 1|: what a rod forbids.
    pub violation: f64,
    /// max |E - E0| / max kinetic energy.
    pub energy_drift: f64,
    /// Of the last particle, at the end.
    pub last_m: Vector,
    /// Why the run did not begin, or ended early.
    pub failure: Option<String>,
}

pub fn watch(case: &Case, way: &Way) -> Watched {
    let mut watched = Watched::default();
    let mut engine = match (way.build)(case) {
        Ok(engine) => engine,
        Err(error) => return Watched { failure: Some(error), ..watched },
    };
    let (mut position, mut velocity) = (Vec::new(), Vec::new());
    engine.read(&mut position, &mut velocity);
    let (start_j, mut drift_j, mut kinetic_j) = (energy_j(case, &position, &velocity).1, 0.0_f64, 0.0_f64);
    for step in 0..case.steps {
        if let Err(error) = engine.step() {
            watched.failure = Some(format!("ended at {:.3} s: {error}", step as f64 * case.dt_s));
            break;
        }
        engine.read(&mut position, &mut velocity);
        let (kinetic, total) = energy_j(case, &position, &velocity);
        if !total.is_finite() {
            watched.failure = Some(format!("ended at {:.3} s: not finite", (step + 1) as f64 * case.dt_s));
            break;
        }
        drift_j = drift_j.max((total - start_j).abs());
        kinetic_j = kinetic_j.max(kinetic);
        for link in &case.links {
            let strain = distance(position[link.a], position[link.b]) / link.length_m - 1.0;
            watched.stretch = watched.stretch.max(strain);
            watched.violation = watched.violation.max(strain.abs());
        }
    }
    watched.energy_drift = drift_j / kinetic_j;
    watched.last_m = position.last().copied().unwrap_or_default();
    watched
}

/// Kinetic and total energy.
fn energy_j(case: &Case, position_m: &[Vector], velocity_m_s: &[Vector]) -> (f64, f64) {
    let dot = |a: Vector, b: Vector| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (mut kinetic, mut potential) = (0.0, 0.0);
    for i in (0..case.mass_kg.len()).filter(|&i| !case.fixed[i]) {
        kinetic += case.mass_kg[i] * dot(velocity_m_s[i], velocity_m_s[i]) / 2.0;
        potential -= case.mass_kg[i] * dot(case.gravity_m_s2, position_m[i]);
    }
    (kinetic, kinetic + potential)
}

/// CPU seconds of the steps of one run, in a fresh engine.
pub fn time_run(case: &Case, way: &Way) -> f64 {
    let Ok(mut engine) = (way.build)(case) else {
        return f64::NAN;
    };
    let clock = ThreadTime::now();
    for _ in 0..case.steps {
        if engine.step().is_err() {
            break;
        }
    }
    clock.elapsed().as_secs_f64()
}

/// CPU seconds of one call, the mean over as many calls as fill the least time of a sample.
pub fn time_call(mut call: impl FnMut()) -> f64 {
    let clock = ThreadTime::now();
    let mut calls = 0;
    while clock.elapsed() < LEAST_SAMPLE {
        call();
        calls += 1;
    }
    clock.elapsed().as_secs_f64() / f64::from(calls)
}

/// Far above the cost of reading the clock of a thread (some 0.3 us).
const LEAST_SAMPLE: Duration = Duration::from_millis(5);

/// The samples of several ways, taken in rounds: in each round every way once, in an order that turns.
pub struct Rounds {
    samples: Vec<Vec<f64>>,
}

/// Median and the ends of the middle half.
#[derive(Clone, Copy)]
pub struct Spread {
    pub low: f64,
    pub median: f64,
    pub high: f64,
}

impl Rounds {
    /// Takes the samples; `sample(i)` measures way `i` once.
    pub fn take(ways: usize, rounds: usize, mut sample: impl FnMut(usize) -> f64) -> Self {
        let mut samples = vec![Vec::with_capacity(rounds); ways];
        for round in 0..rounds {
            for turn in 0..ways {
                let way = (turn + round) % ways;
                samples[way].push(sample(way));
            }
        }
        Self { samples }
    }

    pub fn time(&self, way: usize) -> Spread {
        spread(self.samples[way].clone())
    }

    /// Time of one way over that of another, within each round.
    pub fn ratio(&self, way: usize, base: usize) -> Spread {
        spread(self.samples[way].iter().zip(&self.samples[base]).map(|(a, b)| a / b).collect())
    }
}

fn spread(mut values: Vec<f64>) -> Spread {
    values.sort_by(f64::total_cmp);
    let at = |quarter: usize| values[(values.len() - 1) * quarter / 4];
    Spread { low: at(1), median: at(2), high: at(3) }
}

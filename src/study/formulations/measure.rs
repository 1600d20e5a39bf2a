//! Runs every way with every setting, then times those that anyone asks for.
//!
//! A setting is run twice: once straight to its end, for its error and its work, and once with [`FRAMES`] stops, for its
//! drifts. Only the first is timed.

use super::case::{END_S, STANDARD_STEPS, body, error_rad};
use super::plain;
use super::row::{Figures, Outcome, Row, Setting, Time};
use crate::algebra::g3::Even;
use crate::ode::OdeError;
use crate::rigid::{Bodies, Form, Method, Motion, MotionError, matrix};
use crate::study::StudyError;
use crate::study::timing::{self, Effort, Ratio};
use std::time::{Duration, Instant};

/// The errors that are asked for, rad.
pub(super) const TARGETS_RAD: [f64; 4] = [1e-3, 1e-6, 1e-9, 1e-12];

/// Stops of the run that is observed; they divide the steps of every setting.
const FRAMES: u32 = 25;

/// Which settings, and for how long they are timed.
#[derive(Clone, Copy, Debug)]
pub struct Scope {
    /// Steps are 100 times powers of this.
    pub step_factor: u32,
    /// How many powers, from the zeroth.
    pub step_count: u32,
    /// The steps that are compared step by step, the plain RK4's too; a multiple of 100.
    pub standard_steps: u32,
    /// Tolerances are powers of a tenth: from one to the next.
    pub tolerance_stride: u32,
    /// Time for all times.
    pub budget: Duration,
}

impl Scope {
    /// Seconds.
    pub const QUICK: Self = Self {
        step_factor: 8,
        step_count: 4,
        standard_steps: STANDARD_STEPS,
        tolerance_stride: 3,
        budget: Duration::from_secs(5),
    };
    /// A minute and a half.
    pub const FULL: Self = Self {
        step_factor: 2,
        step_count: 12,
        standard_steps: STANDARD_STEPS,
        tolerance_stride: 1,
        budget: Duration::from_secs(80),
    };
}

/// From this power of a tenth to that; below, steps are made of rounding.
const TOLERANCES: std::ops::RangeInclusive<u32> = 3..=13;

/// All settings of a scope.
fn settings(scope: &Scope) -> Vec<Setting> {
    let mut settings = Vec::new();
    let mut steps: Vec<u32> = (0..scope.step_count).map(|power| 100 * scope.step_factor.pow(power)).collect();
    steps.push(scope.standard_steps);
    steps.sort_unstable();
    steps.dedup();
    for form in Form::ALL {
        for method in Method::ALL.into_iter().filter(|method| is_compared(*method) && method.fits(form)) {
            let steps: &[u32] = if method == Method::FreeFlight { &[scope.standard_steps] } else { &steps };
            settings.extend(steps.iter().map(|steps| Setting::fixed(form, method, *steps)));
            if method.is_adaptive() {
                let powers = TOLERANCES.step_by(scope.tolerance_stride as usize);
                let tolerances = powers.map(|power| 1.0 / 10_f64.powi(power.cast_signed()));
                settings.extend(tolerances.map(|tolerance| Setting::adaptive(form, method, tolerance)));
            }
        }
    }
    settings
}

/// Without forces a composition of exact free motions is one of them, whatever its order; and step doubling and Cash and
/// Karp's method are what they are for particles.
fn is_compared(method: Method) -> bool {
    !matches!(method, Method::Yoshida4 | Method::Yoshida6 | Method::Rk4Doubling | Method::CashKarp)
}

/// The figures of every setting, without times.
///
/// # Errors
/// A solver cannot be used.
pub fn examine(scope: &Scope) -> Result<Vec<Row>, StudyError> {
    settings(scope).into_iter().map(run_setting).collect()
}

/// The motion of a setting, at its start.
fn start(setting: &Setting) -> Result<(Motion<f64>, Bodies<f64>), StudyError> {
    let (setup, bodies) = body()?;
    Ok((Motion::new(setup, &bodies, &setting.solver)?, bodies))
}

/// The figures of a formulation with a method and a number of steps, a multiple of 25.
///
/// # Errors
/// A solver cannot be used.
pub fn run_fixed(form: Form, method: Method, steps: u32) -> Result<Row, StudyError> {
    run_setting(Setting::fixed(form, method, steps))
}

fn run_setting(setting: Setting) -> Result<Row, StudyError> {
    let begin = Instant::now();
    let (mut straight, mut bodies) = start(&setting)?;
    let arrived = straight.advance(&mut bodies, 0.0, END_S);
    let once = begin.elapsed();
    let work = straight.work();
    let figures = match arrived {
        Ok(()) => observe(&setting)?.map(|drifts| Figures {
            error_rad: error_rad(bodies.rotor[0]),
            energy_drift_rel: drifts[0],
            momentum_drift_rel: drifts[1],
            norm_drift: drifts[2],
            rhs_evals: work.rhs_evals,
            accepted: work.accepted,
            time: None,
        }),
        Err(error) => Err(error),
    };
    let outcome = match figures {
        Ok(figures) => Outcome::Done(figures),
        Err(error) => Outcome::Failed { reason: error.to_string() },
    };
    Ok(Row { setting, outcome, once })
}

/// Drifts of energy, angular momentum and norm.
fn observe(setting: &Setting) -> Result<Result<[f64; 3], OdeError<MotionError>>, StudyError> {
    let (mut motion, mut bodies) = start(setting)?;
    let energy = motion.totals(&bodies).energy();
    let length = |bodies: &Bodies<f64>| bodies.angular_momentum[0].norm_sq().sqrt();
    let momentum = length(&bodies);
    let mut drifts = [0.0_f64; 3];
    let frame_s = END_S / f64::from(FRAMES);
    for frame in 0..FRAMES {
        if let Err(error) = motion.advance(&mut bodies, f64::from(frame) * frame_s, frame_s) {
            return Ok(Err(error));
        }
        let energy_drift = (motion.totals(&bodies).energy() - energy).abs() / energy;
        let norm_drift = match bodies.matrix.first() {
            Some(matrix) => matrix::drift::<f64>(matrix),
            None => (Even::from(bodies.rotor[0]).norm_sq() - 1.0).abs(),
        };
        let now = [energy_drift, (length(&bodies) - momentum).abs() / momentum, norm_drift];
        drifts.iter_mut().zip(now).for_each(|(drift, now)| *drift = drift.max(now));
    }
    Ok(Ok(drifts))
}

/// The settings that are timed: the standard steps, and of each way the least work for each error.
fn asked_for(rows: &[Row], standard_steps: u32) -> Vec<usize> {
    let is_standard =
        |row: &Row| row.setting.tolerance.is_none() && row.setting.steps.is_none_or(|n| n == standard_steps);
    let mut asked: Vec<usize> = (0..rows.len()).filter(|index| is_standard(&rows[*index])).collect();
    let mut ways: Vec<String> = rows.iter().map(|row| row.setting.way()).collect();
    ways.sort();
    ways.dedup();
    for (way, target) in ways.iter().flat_map(|way| TARGETS_RAD.map(|target| (way, target))) {
        let within = |index: &usize| {
            let row = &rows[*index];
            row.setting.way() == *way && row.figures().is_some_and(|figures| figures.error_rad <= target)
        };
        let work =
            |index: &usize| rows[*index].figures().map_or(u64::MAX, |figures| figures.rhs_evals + figures.accepted);
        asked.extend((0..rows.len()).filter(within).min_by_key(work));
    }
    asked.sort_unstable();
    asked.dedup();
    asked.retain(|index| rows[*index].figures().is_some());
    asked
}

/// What the times of formulations are compared by, beside those of single rows.
pub(super) struct Timed {
    /// As in the scope.
    pub(super) standard_steps: u32,
    /// Rounds of timing.
    pub(super) rounds: usize,
    /// RK4 with standard steps in each formulation over that in quaternions, in the order of [`Form::ALL`].
    pub(super) over_quaternion: Vec<Ratio>,
    /// The plain RK4, a step, ns.
    pub(super) plain_ns: f64,
}

/// Times rows, in as many rounds as a budget allows.
pub(super) fn time(rows: &mut [Row], scope: &Scope) -> Timed {
    let Scope { standard_steps, budget, .. } = *scope;
    /// So that the clock and the scheduler do not count; see [`Effort`].
    const SAMPLE: Duration = Duration::from_micros(300);
    /// Bounds of the rounds: one at all, and more than anyone needs.
    const ROUNDS: (u32, u32) = (1, 101);
    let asked = asked_for(rows, standard_steps);
    let again = |index: usize| {
        // It has arrived before, and does so again.
        if let Ok((mut motion, mut bodies)) = start(&rows[index].setting) {
            let _ = std::hint::black_box(motion.advance(&mut bodies, 0.0, END_S));
        }
    };
    let round: Duration = asked.iter().map(|index| rows[*index].once.max(SAMPLE)).sum();
    let fit = (budget.as_secs_f64() / round.as_secs_f64().max(1e-3)).min(f64::from(ROUNDS.1));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 101")]
    let rounds = (fit as u32).max(ROUNDS.0) as usize;
    let by_hand = || {
        std::hint::black_box(plain::run(standard_steps));
    };
    let passes: Vec<_> = asked.iter().map(|index| move || again(*index)).collect();
    let mut rivals: Vec<&dyn Fn()> = passes.iter().map(|pass| pass as &dyn Fn()).collect();
    rivals.push(&by_hand);
    let (samples, plain) = (timing::measure(&rivals, 1, Effort { rounds, sample: SAMPLE }), asked.len());
    let standard = |form: Form| {
        let is_it = |index: &usize| {
            let setting = &rows[*index].setting;
            setting.form == form.name() && setting.method == Method::Rk4.name() && setting.steps == Some(standard_steps)
        };
        asked.iter().position(is_it).unwrap_or(plain)
    };
    let over_quaternion =
        Form::ALL.into_iter().map(|form| samples.ratio(standard(form), standard(Form::Quaternion))).collect();
    let plain_ns = samples.timing(plain).median_ns / f64::from(standard_steps);
    for (rival, index) in asked.into_iter().enumerate() {
        if let Outcome::Done(figures) = &mut rows[index].outcome {
            figures.time = Some(Time { timing: samples.timing(rival), ratio: samples.ratio(rival, plain) });
        }
    }
    Timed { standard_steps, rounds, over_quaternion, plain_ns }
}

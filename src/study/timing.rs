//! The timer of the study: interleaved repetitions, so that a change of the machine's pace meets all rivals alike.
//!
//! In each round every rival is timed once, in an order that turns from round to round; a sample is as many passes as
//! fill a fixed time. The minimum is what the code can do, the median what it did, and the interquartile range how much
//! the machine disturbed it. A ratio is the median of the ratios within a round. Its uncertainty is the interval between two
//! order statistics that covers the true median with probability 0.95, whatever the distribution (Conover, *Practical
//! Nonparametric Statistics*, 3.2): for n rounds, ranks n/2 -+ 0.98 sqrt(n).

use serde::Serialize;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Half the width of the 95 % interval of the median, in ranks, over sqrt(n): 1.96 standard deviations of a binomial
/// count, each sqrt(n)/2.
const RANKS_PER_ROOT: f64 = 0.98;

/// How long to measure.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Rounds; each times every rival once.
    pub rounds: usize,
    /// The least duration of one sample: far above the clock's resolution (some 30 ns), far below the time slice of a
    /// scheduler, so that most samples are undisturbed.
    pub sample: Duration,
}

impl Effort {
    /// Seconds for a study of a few kernels.
    pub const QUICK: Self = Self { rounds: 25, sample: Duration::from_micros(300) };
    /// Enough that the interval of a ratio is a few per cent on a busy machine.
    pub const FULL: Self = Self { rounds: 201, sample: Duration::from_micros(1000) };
}

/// The time of one call.
#[derive(Clone, Debug, Serialize)]
pub struct Timing {
    /// The smallest sample, in nanoseconds a call.
    pub min_ns: f64,
    /// The median, in nanoseconds a call.
    pub median_ns: f64,
    /// Interquartile range over median.
    pub spread: f64,
}

/// How many times longer one rival takes than another.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Ratio {
    /// Median of the ratios within a round.
    pub value: f64,
    /// Lower end of its 95 % interval.
    pub low: f64,
    /// Upper end of its 95 % interval.
    pub high: f64,
}

/// The samples of all rivals, round by round.
pub struct Samples {
    /// Nanoseconds a call: `[rival][round]`.
    calls_ns: Vec<Vec<f64>>,
}

/// Times the rivals; each closure makes one pass of `calls` calls.
pub fn measure(rivals: &[&dyn Fn()], calls: usize, effort: Effort) -> Samples {
    let passes: Vec<u32> = rivals.iter().map(|pass| passes_in(pass, effort.sample)).collect();
    let mut calls_ns = vec![Vec::with_capacity(effort.rounds); rivals.len()];
    for round in 0..effort.rounds {
        for turn in 0..rivals.len() {
            let index = (round + turn) % rivals.len();
            let seconds = duration_of(rivals[index], passes[index]).as_secs_f64();
            calls_ns[index].push(1e9 * seconds / (f64::from(passes[index]) * calls as f64));
        }
    }
    Samples { calls_ns }
}

fn duration_of(pass: &dyn Fn(), passes: u32) -> Duration {
    let start = Instant::now();
    for _ in 0..passes {
        black_box(pass)();
    }
    start.elapsed()
}

/// Passes that fill a sample; finding out also warms caches and branch predictors up.
fn passes_in(pass: &dyn Fn(), sample: Duration) -> u32 {
    /// No pass is so short that more of them would be needed; the bound ends the search on a broken clock.
    const LIMIT: u32 = 1 << 20;
    let mut passes = 1;
    while passes < LIMIT && duration_of(pass, passes) < sample {
        passes *= 2;
    }
    passes
}

impl Samples {
    /// The time of one rival.
    #[must_use]
    pub fn timing(&self, rival: usize) -> Timing {
        let sorted = sorted(self.calls_ns.get(rival).cloned().unwrap_or_default());
        let median = quantile(&sorted, 0.5);
        let spread = (quantile(&sorted, 0.75) - quantile(&sorted, 0.25)) / median;
        Timing { min_ns: quantile(&sorted, 0.0), median_ns: median, spread }
    }

    /// How many times longer `rival` takes than `reference`.
    #[must_use]
    pub fn ratio(&self, rival: usize, reference: usize) -> Ratio {
        let pairs =
            self.calls_ns.get(rival).into_iter().flatten().zip(self.calls_ns.get(reference).into_iter().flatten());
        let sorted = sorted(pairs.map(|(a, b)| a / b).collect());
        let half_width = RANKS_PER_ROOT / (sorted.len() as f64).sqrt();
        Ratio {
            value: quantile(&sorted, 0.5),
            low: quantile(&sorted, 0.5 - half_width),
            high: quantile(&sorted, 0.5 + half_width),
        }
    }
}

fn sorted(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    values
}

/// The quantile between the nearest ranks; the ends beyond 0 and 1. An empty list has no quantile, and gives 0.
fn quantile(sorted: &[f64], fraction: f64) -> f64 {
    let last = sorted.len().saturating_sub(1);
    let rank = fraction.clamp(0.0, 1.0) * last as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a rank within the list")]
    let below = rank.floor() as usize;
    let at = |index: usize| sorted.get(index.min(last)).copied().unwrap_or(0.0);
    at(below) + (at(below + 1) - at(below)) * rank.fract()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_a_known_list() {
        let list: Vec<f64> = (0..=100).map(f64::from).collect();
        assert_eq!(quantile(&list, 0.5), 50.0);
        assert_eq!(quantile(&list, 0.25), 25.0);
        assert_eq!(quantile(&[1.0, 2.0], 0.5), 1.5);
        assert_eq!(quantile(&[], 0.5), 0.0);
    }

    #[test]
    fn a_ratio_is_taken_within_rounds() {
        // The machine is twice as slow in the second round: the ratio does not notice.
        let samples = Samples { calls_ns: vec![vec![10.0, 20.0, 10.0], vec![2.0, 4.0, 2.0]] };
        let ratio = samples.ratio(0, 1);
        assert_eq!((ratio.value, ratio.low, ratio.high), (5.0, 5.0, 5.0));
        assert_eq!(samples.timing(1).min_ns, 2.0);
    }

    #[test]
    fn the_interval_covers_the_median_of_a_skewed_sample() {
        let list: Vec<f64> = (1..=101).map(|i| f64::from(i * i)).collect();
        let samples = Samples { calls_ns: vec![list, vec![1.0; 101]] };
        let ratio = samples.ratio(0, 1);
        assert_eq!(ratio.value, f64::from(51 * 51));
        // 0.98 sqrt(101) = 9.85 ranks to each side.
        assert!(ratio.low > f64::from(40 * 40) && ratio.low < f64::from(42 * 42), "{}", ratio.low);
        assert!(ratio.high > f64::from(60 * 60) && ratio.high < f64::from(62 * 62), "{}", ratio.high);
    }

    #[test]
    fn a_measured_ratio_lies_in_its_interval() {
        let work = |n: u64| {
            move || {
                black_box((0..black_box(n)).fold(0_u64, |sum, i| black_box(sum ^ i)));
            }
        };
        let (short, long) = (work(2_000), work(20_000));
        let samples = measure(&[&short, &long], 1, Effort::QUICK);
        let ratio = samples.ratio(1, 0);
        // How large it is depends on what else the machine does; that is no matter for a test.
        assert!(ratio.value > 0.0 && ratio.low <= ratio.value && ratio.value <= ratio.high, "{ratio:?}");
    }
}

//! How long the next step is.
//!
//! The report's rule (equation 59), `h (allowed / error)^(1/5)`, with what it lacks: a factor of safety, bounds, and a
//! memory. A controller that also sees how the error changed (PI; Gustafsson 1991, Hairer, Wanner 1996, IV.2) does not
//! overshoot where the solution becomes harder step by step:
//!
//! ```text
//! h_next = h * safety * ratio^(-alpha) * ratio_before^beta      ratio = error / allowed, k = q + 1
//! ```

/// Of the step that would just pass. Nine in ten of the next steps then do (Hairer, Nørsett, Wanner 1993, II.4).
const SAFETY: f64 = 0.9;

/// The least factor in one step. A smaller one would trust an estimate that is far outside of its range.
const SHRINK: f64 = 0.2;

/// The largest factor in one step, for the same reason.
const GROW: f64 = 6.0;

/// alpha = `PROPORTIONAL / k + ...`
const BETA: f64 = 0.0;

/// A better step than this is not remembered as better: it says little of the next (the bound of Hairer's codes).
const BEST_REMEMBERED: f64 = 1e-4;

/// Chooses steps from errors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Controller {
    /// 1 / k
    inv_k: f64,
    before: f64,
    rejected: bool,
}

impl Controller {
    pub(super) fn new(error_order: u32) -> Self {
        Self { inv_k: 1.0 / (f64::from(error_order) + 1.0), before: BEST_REMEMBERED, rejected: false }
    }

    /// The factor to the next step after one with an error ratio of at most 1.
    #[inline]
    pub(super) fn accepted(&mut self, ratio: f64) -> f64 {
        let beta = BETA * self.inv_k;
        let alpha = self.inv_k - 0.75 * beta;
        let ratio = ratio.max(f64::MIN_POSITIVE);
        let factor = SAFETY * libm::pow(ratio, -alpha) * if beta == 0.0 { 1.0 } else { libm::pow(self.before, beta) };
        self.before = ratio.max(BEST_REMEMBERED);
        // A step that has just failed says that a larger one would.
        let most = if self.rejected { 1.0 } else { GROW };
        self.rejected = false;
        factor.clamp(SHRINK, most)
    }

    /// The factor to the next try after a step with too large an error, or with one that is no number.
    pub(super) fn rejected(&mut self, ratio: f64) -> f64 {
        self.rejected = true;
        if ratio.is_finite() { (SAFETY * libm::pow(ratio, -self.inv_k)).clamp(SHRINK, 1.0) } else { SHRINK }
    }
}

/// One ratio of the estimates of a method. Two, of a higher and a lower order, are joined as in DOP853,
/// `high² / sqrt(high² + 0.01 low²)`: where h is small, low is much the larger, and the whole falls faster than high.
#[inline(always)]
pub(super) fn joined<const N: usize>(ratios: [f64; N]) -> f64 {
    match ratios[..] {
        [high, low] if high != 0.0 => high * high / (high * high + 0.01 * low * low).sqrt(),
        [ratio, ..] => ratio,
        [] => 0.0,
    }
}

/// The part of its own size by which the first step may change a state, in Euler's guess.
const FIRST_CHANGE: f64 = 0.01;

/// The guess of the first step from the rate at the start, as a ratio to the tolerance, where nothing moves
/// (Hairer, Nørsett, Wanner 1993, II.4).
const STILL_STEP_S: f64 = 1e-6;

/// Euler's guess: `rate` is the error ratio of a step of 1 s that was wrong by all of its change.
///
/// The size of the state, in units of what is allowed, is taken for 1 / rtol: that of a state too small for this is
/// atol / rtol, below which its size does not matter.
pub(super) fn first_guess(rate: f64, rtol: f64) -> f64 {
    let guess = FIRST_CHANGE / (rtol * rate);
    if rate > 0.0 && guess.is_finite() && guess > 0.0 { guess } else { STILL_STEP_S }
}

/// The first step from that guess and from the change of the rate over it, per second (Hairer, Nørsett, Wanner 1993, II.4).
pub(super) fn first_step(guess: f64, rate: f64, change: f64, order: u32) -> f64 {
    let largest = rate.max(change);
    let step = if largest <= 1e-15 {
        (guess * 1e-3).max(STILL_STEP_S)
    } else {
        libm::pow(FIRST_CHANGE / largest, 1.0 / (f64::from(order) + 1.0))
    };
    step.min(100.0 * guess)
}

//! Why an integration ends early.

use thiserror::Error;

/// Why a step, or a run of steps, cannot be made. The state is then that of the last good step.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum OdeError<E> {
    /// The system itself cannot go on.
    #[error(transparent)]
    System(E),
    /// The step, that of the tolerance or a given one, is too small to move the time.
    #[error(
        "at {time_s} s the step has come down to {step_s:e} s, below the resolution of the time: the solution runs away, jumps, \
         or is not a number there; if it does none of that, allow a larger error or take a larger step"
    )]
    StepTooSmall {
        /// Where the last good step ended.
        time_s: f64,
        /// The step that failed.
        step_s: f64,
    },
    /// A step from the time at which steps shall stop.
    #[error(
        "no step goes past {stop_s} s: it is the time of `stop_at`; set a later one, and `restart` if the system jumps there"
    )]
    Stopped {
        /// The stop.
        stop_s: f64,
    },
    /// More steps than allowed.
    #[error(
        "{steps} steps have led from {from_s} s only to {time_s} s on the way to {to_s} s: allow more steps, a larger error, or \
         a larger step"
    )]
    TooManySteps {
        /// The steps made.
        steps: u64,
        /// Where they began.
        from_s: f64,
        /// Where they led.
        time_s: f64,
        /// Where they should have led.
        to_s: f64,
    },
    /// A time before the last step.
    #[error("{asked_s} s has passed: the last step began at {from_s} s; ask for times in order")]
    Past {
        /// The time asked for.
        asked_s: f64,
        /// The earliest that can be.
        from_s: f64,
    },
    /// A step of given size led to a rate that is not a number.
    #[error(
        "the solution left the range of the numbers in the step of {step_s:e} s to {time_s} s: take a smaller step"
    )]
    NotFinite {
        /// The end of the step.
        time_s: f64,
        /// The step.
        step_s: f64,
    },
    /// An event without a value.
    #[error("the function of event {event} is not a number at {time_s} s")]
    EventNotANumber {
        /// The event.
        event: usize,
        /// When.
        time_s: f64,
    },
}

/// Not a step to go by.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("a step of {step_s} s: it must be positive and finite")]
pub struct StepError {
    /// The step asked for.
    pub step_s: f64,
}

impl StepError {
    pub(crate) fn check(step_s: f64) -> Result<f64, Self> {
        if step_s > 0.0 && step_s.is_finite() { Ok(step_s) } else { Err(Self { step_s }) }
    }
}

//! Events: the times at which a function of the state passes through zero.
//!
//! The function is sampled along the dense output of every step; a change of sign is located with
//! [`root::find`](super::root). An event is as exact as the dense output there. Two crossings within an eighth of a
//! step may be missed.

use super::root::{self, Sample};
use super::{OdeError, Stepper};
use alloc::boxed::Box;
use alloc::vec::Vec;

/// Samples within a step: a function that turns round within an eighth of it is not followed by the steps either.
const SAMPLES: u32 = 8;

/// Which way the function passes through zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Both.
    Either,
}

/// An event that happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Its index among those watched for.
    pub event: usize,
    /// When, s.
    pub time_s: f64,
    /// The function passed from negative to positive.
    pub rising: bool,
}

/// The function whose zeros are events.
type Value<'a, S> = dyn FnMut(f64, &S) -> f64 + 'a;

/// What to watch for.
pub struct Event<'a, S> {
    value: Box<Value<'a, S>>,
    crossing: Crossing,
    terminal: bool,
}

impl<'a, S> Event<'a, S> {
    /// Where a function of time and state passes through zero.
    pub fn new(crossing: Crossing, value: impl FnMut(f64, &S) -> f64 + 'a) -> Self {
        Self { value: Box::new(value), crossing, terminal: false }
    }

    /// It ends the run.
    #[must_use]
    pub fn terminal(mut self) -> Self {
        self.terminal = true;
        self
    }
}

/// Watches for events along a run; remembers up to where, and on which side of zero each function was.
pub struct Watch<'a, S> {
    events: Vec<Event<'a, S>>,
    /// Up to where it has looked.
    at_s: f64,
    /// Positive or not, since the last sample that was not zero; none before.
    sides: Vec<Option<bool>>,
    values: Vec<f64>,
    next: Vec<f64>,
    primed: bool,
}

impl<'a, S> Watch<'a, S> {
    /// Watches from a time on. A function that is zero there has no side yet, so leaving zero is no event.
    pub fn new(from_s: f64, events: impl IntoIterator<Item = Event<'a, S>>) -> Self {
        let events: Vec<_> = events.into_iter().collect();
        let n = events.len();
        Self {
            events,
            at_s: from_s,
            sides: alloc::vec![None; n],
            values: alloc::vec![0.0; n],
            next: alloc::vec![0.0; n],
            primed: false,
        }
    }

    /// Forgets the sides, for a state that was changed at this time.
    pub fn restart(&mut self, from_s: f64) {
        (self.at_s, self.primed) = (from_s, false);
    }

    /// Looks along the last step, up to a time at most. The first event that ends the run, with the state there in
    /// `out`.
    pub(super) fn scan<Y: ?Sized, P: Stepper<Y, State = S> + ?Sized>(
        &mut self,
        stepper: &mut P,
        system: &mut Y,
        to_s: f64,
        out: &mut S,
        seen: &mut dyn FnMut(Hit, &S),
    ) -> Result<Option<Hit>, OdeError<P::Error>> {
        let (from_s, end_s) = (stepper.start_s(), stepper.time_s());
        if !self.primed || self.at_s < from_s {
            self.at_s = self.at_s.max(from_s);
            stepper.interpolate(system, self.at_s, out)?;
            self.evaluate(self.at_s, out)?;
            core::mem::swap(&mut self.values, &mut self.next);
            self.sides.fill(None);
            self.keep_sides();
            self.primed = true;
        }
        for index in 1..=SAMPLES {
            let sample_s = if index == SAMPLES {
                end_s
            } else {
                from_s + (end_s - from_s) * f64::from(index) / f64::from(SAMPLES)
            };
            let sample_s = sample_s.min(to_s);
            if sample_s <= self.at_s {
                continue;
            }
            if let Some(hit) = self.advance(stepper, system, sample_s, out, seen)? {
                return Ok(Some(hit));
            }
        }
        Ok(None)
    }

    /// From the last sample to the next.
    fn advance<Y: ?Sized, P: Stepper<Y, State = S> + ?Sized>(
        &mut self,
        stepper: &mut P,
        system: &mut Y,
        sample_s: f64,
        out: &mut S,
        seen: &mut dyn FnMut(Hit, &S),
    ) -> Result<Option<Hit>, OdeError<P::Error>> {
        loop {
            stepper.interpolate(system, sample_s, out)?;
            self.evaluate(sample_s, out)?;
            let Some(hit) = self.earliest(stepper, system, sample_s, out)? else { break };
            stepper.interpolate(system, hit.time_s, out)?;
            self.evaluate(hit.time_s, out)?;
            core::mem::swap(&mut self.values, &mut self.next);
            self.at_s = hit.time_s;
            self.sides[hit.event] = Some(hit.rising);
            if self.events[hit.event].terminal {
                return Ok(Some(hit));
            }
            seen(hit, out);
        }
        core::mem::swap(&mut self.values, &mut self.next);
        self.at_s = sample_s;
        self.keep_sides();
        Ok(None)
    }

    /// The first of the events between the last sample and this one, whose values stand in `next`.
    fn earliest<Y: ?Sized, P: Stepper<Y, State = S> + ?Sized>(
        &mut self,
        stepper: &mut P,
        system: &mut Y,
        sample_s: f64,
        out: &mut S,
    ) -> Result<Option<Hit>, OdeError<P::Error>> {
        let mut first: Option<Hit> = None;
        for index in 0..self.events.len() {
            let (start, end) =
                (Sample { x: self.at_s, f: self.values[index] }, Sample { x: sample_s, f: self.next[index] });
            let Some(rising) = self.crosses(index, start.f, end.f) else { continue };
            let value = &mut self.events[index].value;
            let found = root::find(
                |t_s| {
                    stepper.interpolate(system, t_s, out)?;
                    not_nan(value(t_s, out), index, t_s)
                },
                start,
                end,
            )?;
            if first.is_none_or(|hit| found.x < hit.time_s) {
                first = Some(Hit { event: index, time_s: found.x, rising });
            }
        }
        Ok(first)
    }

    /// Whether an event lies between two values, and which way it goes.
    fn crosses(&self, index: usize, start: f64, end: f64) -> Option<bool> {
        let positive = self.sides[index]?;
        let crossed = if positive { end <= 0.0 } else { end >= 0.0 };
        // After a hit the value may still be on the old side by rounding: there is no bracket then.
        let bracket = start == 0.0 || end == 0.0 || (start > 0.0) != (end > 0.0);
        let wanted = match self.events[index].crossing {
            Crossing::Rising => !positive,
            Crossing::Falling => positive,
            Crossing::Either => true,
        };
        (crossed && bracket && wanted).then_some(!positive)
    }

    fn evaluate<E>(&mut self, t_s: f64, state: &S) -> Result<(), OdeError<E>> {
        for (index, (event, next)) in self.events.iter_mut().zip(&mut self.next).enumerate() {
            *next = not_nan((event.value)(t_s, state), index, t_s)?;
        }
        Ok(())
    }

    fn keep_sides(&mut self) {
        for (side, value) in self.sides.iter_mut().zip(&self.values) {
            if *value != 0.0 {
                *side = Some(*value > 0.0);
            }
        }
    }
}

fn not_nan<E>(value: f64, event: usize, time_s: f64) -> Result<f64, OdeError<E>> {
    if value.is_nan() { Err(OdeError::EventNotANumber { event, time_s }) } else { Ok(value) }
}

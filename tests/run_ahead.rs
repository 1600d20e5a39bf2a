//! Frames that are made ahead of their use: the same ones, in order, no more of them than asked, and a clean end.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use ga_physics::simulation::{Next, RunAhead};
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

fn ahead(frames: usize) -> NonZeroUsize {
    NonZeroUsize::new(frames).unwrap()
}

fn count_to(last: usize) -> impl FnMut(usize) -> Option<usize> + Send + 'static {
    let mut frames = 0..last;
    move |_| frames.next()
}

#[test]
fn all_frames_come_in_order() {
    for size in [1, 2, 7, 1000] {
        assert!(RunAhead::start(ahead(size), count_to(100)).eq(0..100));
    }
}

#[test]
fn the_producer_stops_where_the_buffer_is_full_and_is_told_how_full_it_is() {
    let (made, fullest) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicUsize::new(0)));
    let (counter, level) = (Arc::clone(&made), Arc::clone(&fullest));
    let mut run = RunAhead::start(ahead(3), move |waiting| {
        level.fetch_max(waiting, Ordering::SeqCst);
        Some(counter.fetch_add(1, Ordering::SeqCst))
    });
    for taken in 0..50 {
        assert_eq!(run.next(), Some(taken));
        assert!(made.load(Ordering::SeqCst) <= taken + 1 + 3 + 1, "one is taken, three wait, one is in work");
    }
    while run.waiting() < 3 {
        std::thread::yield_now();
    }
    assert_eq!(made.load(Ordering::SeqCst), 50 + 3);
    assert_eq!(fullest.load(Ordering::SeqCst), 2);
}

#[test]
fn a_display_that_polls_tells_late_from_ended() {
    let (open, gate) = std::sync::mpsc::channel::<()>();
    let run = RunAhead::start(ahead(2), move |_| gate.recv().ok());
    assert_eq!(run.poll(), Next::NotYet);
    open.send(()).unwrap();
    while run.waiting() == 0 {
        std::thread::yield_now();
    }
    assert_eq!(run.poll(), Next::Frame(()));
    drop(open);
    loop {
        match run.poll() {
            Next::NotYet => std::thread::yield_now(),
            next => break assert_eq!(next, Next::End),
        }
    }
}

#[test]
fn what_was_made_before_a_panic_is_not_lost() {
    let mut frames = 0..3;
    let made: Vec<i32> = RunAhead::start(ahead(8), move |_| Some(frames.next().unwrap())).collect();
    assert_eq!(made, [0, 1, 2]);
}

#[test]
fn dropping_it_ends_a_producer_that_never_would() {
    let made = Arc::new(AtomicUsize::new(0));
    let counter = Arc::clone(&made);
    let run = RunAhead::start(ahead(2), move |_| Some(counter.fetch_add(1, Ordering::SeqCst)));
    drop(run);
    let after = made.load(Ordering::SeqCst);
    std::thread::yield_now();
    assert_eq!(made.load(Ordering::SeqCst), after);
    assert!(after <= 3);
}

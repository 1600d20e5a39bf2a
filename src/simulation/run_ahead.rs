//! A simulation that runs ahead of its display, through a buffer of frames (report, section B.3.3).
//!
//! A display wants a frame at a fixed rate; a simulation with error control needs now less, now more time for one. The
//! buffer takes the difference: the simulation runs in a thread of its own and stops when the buffer is full. How full it
//! is may decide how accurately the next frame is computed: the producer is told.
//!
//! ```
//! use ga_physics::algebra::{cga::Point, g3::Vector};
//! use ga_physics::particle::{Force, Masses, Method, Motion, Particles, Setup, Solver};
//! use ga_physics::simulation::RunAhead;
//! use std::num::NonZeroUsize;
//!
//! let setup = Setup {
//!     masses: Masses { mass: vec![1.0], inv_mass: vec![1.0] },
//!     forces: vec![Force::Uniform { acceleration: Vector::new(0.0, 0.0, -10.0) }],
//!     constraints: vec![],
//! };
//! let start = Particles { position: vec![Point::origin()], velocity: vec![Vector::default()] };
//! let mut motion = Motion::new(setup, start, &Solver::fixed(Method::Rk4, 0.01))?;
//! let mut times = (1..=60).map(|frame| f64::from(frame) / 60.0);
//! let frames = RunAhead::start(NonZeroUsize::MIN.saturating_add(7), move |_waiting| {
//!     motion.advance_to(times.next()?).ok()?;
//!     Some(motion.state().position[0].z)
//! });
//! let shown: Vec<f64> = frames.collect();
//! assert!(shown.len() == 60 && (shown[59] + 5.0).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::collections::VecDeque;
use std::num::NonZeroUsize;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

/// What the display finds when it looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next<F> {
    /// The next frame, in order.
    Frame(F),
    /// The simulation is behind: show the last one again.
    NotYet,
    /// There are no more.
    End,
}

struct Shared<F> {
    frames: VecDeque<F>,
    /// The producer has nothing more, or the display has gone.
    ended: bool,
}

struct Buffer<F> {
    shared: Mutex<Shared<F>>,
    /// Something was added, taken or ended.
    changed: Condvar,
}

impl<F> Buffer<F> {
    /// A producer that panicked leaves the frames that it made; they are good.
    fn lock(&self) -> MutexGuard<'_, Shared<F>> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'a>(&self, guard: MutexGuard<'a, Shared<F>>) -> MutexGuard<'a, Shared<F>> {
        self.changed.wait(guard).unwrap_or_else(PoisonError::into_inner)
    }
}

/// Says the end whatever ends the producer, a panic included.
struct EndOnDrop<F>(Arc<Buffer<F>>);

impl<F> Drop for EndOnDrop<F> {
    fn drop(&mut self) {
        self.0.lock().ended = true;
        self.0.changed.notify_all();
    }
}

/// Frames that are made ahead of their use. Dropping it stops the producer after the frame in work.
pub struct RunAhead<F> {
    buffer: Arc<Buffer<F>>,
    worker: Option<JoinHandle<()>>,
}

impl<F: Send + 'static> RunAhead<F> {
    /// Starts to produce. `produce` gets the number of frames that wait, from 0 (the display waits) to `ahead - 1`, and
    /// returns the next frame, or nothing at the end. Let a frame that can fail be a `Result` and return nothing after
    /// an error.
    pub fn start(ahead: NonZeroUsize, mut produce: impl FnMut(usize) -> Option<F> + Send + 'static) -> Self {
        let shared = Shared { frames: VecDeque::with_capacity(ahead.get()), ended: false };
        let buffer = Arc::new(Buffer { shared: Mutex::new(shared), changed: Condvar::new() });
        let end = EndOnDrop(Arc::clone(&buffer));
        let worker = std::thread::spawn(move || {
            let buffer = &end.0;
            loop {
                let mut shared = buffer.lock();
                while !shared.ended && shared.frames.len() >= ahead.get() {
                    shared = buffer.wait(shared);
                }
                let (ended, waiting) = (shared.ended, shared.frames.len());
                drop(shared);
                let Some(frame) = (!ended).then(|| produce(waiting)).flatten() else {
                    return;
                };
                buffer.lock().frames.push_back(frame);
                buffer.changed.notify_all();
            }
        });
        Self { buffer, worker: Some(worker) }
    }

    /// What is there now, without waiting: for a display that must not stall.
    pub fn poll(&self) -> Next<F> {
        let mut shared = self.buffer.lock();
        match shared.frames.pop_front() {
            Some(frame) => {
                self.buffer.changed.notify_all();
                Next::Frame(frame)
            }
            None if shared.ended => Next::End,
            None => Next::NotYet,
        }
    }

    /// The frames that wait.
    #[must_use]
    pub fn waiting(&self) -> usize {
        self.buffer.lock().frames.len()
    }
}

/// Waits for every frame: for a recording at a fixed rate, which must not miss one.
impl<F: Send + 'static> Iterator for RunAhead<F> {
    type Item = F;

    fn next(&mut self) -> Option<F> {
        let mut shared = self.buffer.lock();
        loop {
            if let Some(frame) = shared.frames.pop_front() {
                self.buffer.changed.notify_all();
                return Some(frame);
            }
            if shared.ended {
                return None;
            }
            shared = self.buffer.wait(shared);
        }
    }
}

impl<F> Drop for RunAhead<F> {
    fn drop(&mut self) {
        self.buffer.lock().ended = true;
        self.buffer.changed.notify_all();
        if let Some(worker) = self.worker.take() {
            // A panic of the producer was its own; there is nobody left to tell.
            let _ = worker.join();
        }
    }
}

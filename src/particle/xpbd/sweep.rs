//! Prediction and Gauss-Seidel sweeps.
//!
//! The correction of a link with u = |x_a - x_b|² / l² is
//!
//! ```text
//! x_a -= w_a k (x_a - x_b)    x_b += w_b k (x_a - x_b)    k (w_a + w_b) = 1 - 1/sqrt(u)
//! 1 - 1/sqrt(u) ~ e (e + 4) / (e² + 8 u),  e = u - 1
//! ```
//!
//! the quotient from Halley's step for the root, which starts at 1: one division, no root. Its relative error is
//! `e²/4` for a stretch e (2.5e-5 at 1 %); a link of length 0 gets -3 in the place of minus infinity. Jakobsen's
//! `(u - 1)/(u + 1)` ("Advanced character physics", 2001) is the first Newton step: error e/2, and a fifth less time.

use super::order::{Link, Part, Plan};
use super::store::Last;
use super::{AGAIN, BLOCK, GROUP, Particles, ROUNDS, SETTLING, Xpbd, store};
use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;

/// Particles from which on work is spread over threads: below, starting them costs more than a sweep.
#[cfg(feature = "parallel")]
const PARALLEL: usize = 4 * BLOCK;

/// `x -> 2 x - x_old + h² a`
fn predict<T: Real>(position: &mut [Point<f64>], last: &mut [impl Last], inv_mass: &[T], fall: Vector<f64>) {
    for ((x, last), w) in position.iter_mut().zip(last).zip(inv_mass) {
        if *w != T::zero() {
            let (now, old) = (*x, last.get());
            *x = Point::new(
                now.x + ((now.x - old.x) + fall.e1),
                now.y + ((now.y - old.y) + fall.e2),
                now.z + ((now.z - old.z) + fall.e3),
            );
            last.set(now);
        }
    }
}

/// Corrects a link. Was it stretched by more than `strain`?
#[inline(always)]
fn correct<T: Real>(position: &mut [Point<f64>], inv_mass: &[T], link: &Link, strain: f64) -> bool {
    let (a, b) = (link.a as usize, link.b as usize);
    let (p, q) = (position[a], position[b]);
    let (w_a, w_b) = (inv_mass[a].to_f64(), inv_mass[b].to_f64());
    let (x, y, z) = (p.x - q.x, p.y - q.y, p.z - q.z);
    let s = x * x + y * y + z * z;
    let (e, l4) = (s - link.length_sq, 4.0 * link.length_sq);
    let (over, under) = (e * (e + l4), e * e + (s + s) * l4);
    let k = over / (under * (w_a + w_b));
    let (k_a, k_b) = (k * w_a, k * w_b);
    position[a] = Point::new(p.x - k_a * x, p.y - k_a * y, p.z - k_a * z);
    position[b] = Point::new(q.x + k_b * x, q.y + k_b * y, q.z + k_b * z);
    over.abs() > strain * under
}

/// Two particles in one place have no direction: they are set apart along e1.
#[cold]
fn separate<T: Real>(position: &mut [Point<f64>], inv_mass: &[T], link: &Link) {
    let (a, b) = (link.a as usize, link.b as usize);
    let (w_a, w_b) = (inv_mass[a].to_f64(), inv_mass[b].to_f64());
    let step = link.length_sq.sqrt() / (w_a + w_b);
    position[a].x += w_a * step;
    position[b].x -= w_b * step;
}

impl Part {
    /// Sweeps all links, and keeps which groups were stretched by more than `strain`.
    fn sweep<T: Real>(&mut self, position: &mut [Point<f64>], inv_mass: &[T], strain: f64) {
        // One length for both: the compiler then checks each index once.
        let inv_mass = &inv_mass[..position.len()];
        self.again.clear();
        for (group, links) in (0..).zip(self.links.chunks(GROUP)) {
            let mut stretched = false;
            for link in links {
                stretched |= correct(position, inv_mass, link, strain);
            }
            if stretched {
                self.again.push(group);
            }
        }
    }

    /// Sweeps the groups that were kept, and keeps those that are still stretched.
    fn sweep_again<T: Real>(&mut self, position: &mut [Point<f64>], inv_mass: &[T], strain: f64) {
        let inv_mass = &inv_mass[..position.len()];
        let links = &self.links;
        self.again.retain(|group| {
            let mut stretched = false;
            for link in links.iter().skip(*group as usize * GROUP).take(GROUP) {
                if position[link.a as usize] == position[link.b as usize] {
                    separate(position, inv_mass, link);
                }
                stretched |= correct(position, inv_mass, link, strain);
            }
            stretched
        });
    }
}

/// Does `work` for each part and its window. In any order: windows are disjoint.
fn each<T: Real>(
    parts: &mut [Part],
    window: usize,
    position: &mut [Point<f64>],
    inv_mass: &[T],
    work: impl Fn(&mut Part, &mut [Point<f64>], &[T]) + Send + Sync,
) {
    #[cfg(feature = "parallel")]
    if position.len() >= PARALLEL {
        use rayon::prelude::*;
        let windows = position.par_chunks_mut(window).zip(inv_mass.par_chunks(window));
        parts.par_iter_mut().zip(windows).for_each(|(part, (position, inv_mass))| work(part, position, inv_mass));
        return;
    }
    let windows = position.chunks_mut(window).zip(inv_mass.chunks(window));
    parts.iter_mut().zip(windows).for_each(|(part, (position, inv_mass))| work(part, position, inv_mass));
}

/// Predicts, block by block, and sweeps the links within each block while it is in the cache.
fn predict_and_sweep<T: Real>(
    inner: &mut [Part],
    position: &mut [Point<f64>],
    last: &mut [impl Last],
    inv_mass: &[T],
    fall: Vector<f64>,
    strain: f64,
) {
    #[cfg(feature = "parallel")]
    if position.len() >= PARALLEL {
        use rayon::prelude::*;
        let windows = position.par_chunks_mut(BLOCK).zip(last.par_chunks_mut(BLOCK)).zip(inv_mass.par_chunks(BLOCK));
        inner.par_iter_mut().zip(windows).for_each(|(part, ((position, last), inv_mass))| {
            predict(position, last, inv_mass, fall);
            part.sweep(position, inv_mass, strain);
        });
        return;
    }
    let windows = position.chunks_mut(BLOCK).zip(last.chunks_mut(BLOCK)).zip(inv_mass.chunks(BLOCK));
    for (part, ((position, last), inv_mass)) in inner.iter_mut().zip(windows) {
        predict(position, last, inv_mass, fall);
        part.sweep(position, inv_mass, strain);
    }
}

impl Plan {
    /// All but what lies within blocks.
    fn sweep_across<T: Real>(&mut self, position: &mut [Point<f64>], inv_mass: &[T], strain: f64) {
        let sweep = |part: &mut Part, x: &mut [Point<f64>], w: &[T]| part.sweep(x, w, strain);
        self.across(position, inv_mass, sweep);
    }

    fn across<T: Real>(
        &mut self,
        position: &mut [Point<f64>],
        inv_mass: &[T],
        work: impl Fn(&mut Part, &mut [Point<f64>], &[T]) + Send + Sync,
    ) {
        each(&mut self.even, 2 * BLOCK, position, inv_mass, &work);
        let odd = BLOCK.min(position.len());
        each(&mut self.odd, 2 * BLOCK, &mut position[odd..], &inv_mass[odd..], &work);
        work(&mut self.rest, position, inv_mass);
    }

    fn sweep_all<T: Real>(&mut self, position: &mut [Point<f64>], inv_mass: &[T], strain: f64) {
        each(&mut self.inner, BLOCK, position, inv_mass, |part, x, w| part.sweep(x, w, strain));
        self.sweep_across(position, inv_mass, strain);
    }

    fn sweep_again<T: Real>(&mut self, position: &mut [Point<f64>], inv_mass: &[T], strain: f64) {
        for _ in 0..ROUNDS {
            if !self.any_again() {
                return;
            }
            let sweep = |part: &mut Part, x: &mut [Point<f64>], w: &[T]| part.sweep_again(x, w, strain);
            each(&mut self.inner, BLOCK, position, inv_mass, sweep);
            self.across(position, inv_mass, sweep);
        }
    }

    fn any_again(&self) -> bool {
        self.inner.iter().chain(&self.even).chain(&self.odd).chain([&self.rest]).any(|part| !part.again.is_empty())
    }
}

impl<T: Real> Xpbd<T> {
    /// A substep, positions only. After the last one of a step, links that are still over the violation are settled.
    pub(super) fn substep(
        &mut self,
        particles: &mut Particles<T>,
        inv_mass: &[T],
        h_s: f64,
        gravity: Vector<f64>,
        violation: f64,
        settle: bool,
    ) {
        let (fall, strain) = (gravity * (h_s * h_s), AGAIN * violation);
        let Particles { position, velocity } = particles;
        if store::holds_positions::<T>() {
            predict_and_sweep(&mut self.links.inner, position, velocity, inv_mass, fall, strain);
        } else {
            predict_and_sweep(&mut self.links.inner, position, &mut self.last, inv_mass, fall, strain);
        }
        self.links.sweep_across(position, inv_mass, strain);
        self.links.sweep_again(position, inv_mass, strain);
        self.hold(position, inv_mass);
        for _ in 0..if settle { SETTLING } else { 0 } {
            if !self.exceeds(position, violation) {
                return;
            }
            self.links.sweep_all(position, inv_mass, strain);
            self.links.sweep_again(position, inv_mass, strain);
            self.hold(position, inv_mass);
        }
    }
}

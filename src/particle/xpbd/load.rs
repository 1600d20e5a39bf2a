//! The loads of links at rest, and the substeps that they ask for.
//!
//! ```text
//! link at rest        stretch when it comes to be corrected    (w_a + w_b) T h² / l         w inverse masses, T tension
//! cut of a component  T = |a| M / N                            N links from level i - 1 to i, M the mass from level i on
//! ```
//!
//! The level of a particle is the number of links on the shortest way to one that is fixed or on a surface: every cut
//! between levels carries what lies beyond it. Exact for a chain and for a net that hangs by a row; for a net that hangs
//! by corners the mean over the cut (the links nearest to a corner of n² particles carry `n²/4` particles each).
//! A load that comes at once stretches twice as far as the same load at rest ([`OVERSHOOT`]).
//!
//! Two conditions, with the violation e that is asked for:
//!
//! * nearly all links stay below the strain at which they are swept again: all but one in [`FEW`];
//! * the others stay within [`REACH`] e, from which the sweeps that follow bring them under e.
//!
//! Components that hang from nothing have no load at rest.

use super::AGAIN;
use super::order::Link;
use super::surface::Held;
use crate::algebra::Real;
use alloc::vec;
use alloc::vec::Vec;

/// A mass that is let go on a spring swings to twice its stretch at rest.
const OVERSHOOT: f64 = 2.0;
/// One link in this many may be swept again at rest. They are few, so that the sweeps over them cost little.
const FEW: usize = 32;
/// The sweeps over the links around a corner take this, for nets of 32 x 32, 64 x 64 and 100 x 100 that snap taut, to
/// below 1. At 2.4 the last one misses the violation that was asked for.
const REACH: f64 = 1.7;

/// What the links carry: stretch of a sweep by `|a| h²`, 1/m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Load {
    /// Of the link that carries most.
    largest: f64,
    /// Only one link in [`FEW`] carries more.
    usual: f64,
}

/// Links of a particle.
struct Neighbours {
    starts: Vec<usize>,
    others: Vec<u32>,
}

impl Neighbours {
    fn new(particles: usize, links: &[Link]) -> Self {
        let mut starts = vec![0; particles + 1];
        for end in links.iter().flat_map(|link| [link.a, link.b]) {
            starts[end as usize + 1] += 1;
        }
        for index in 0..particles {
            starts[index + 1] += starts[index];
        }
        let (mut next, mut others) = (starts.clone(), vec![0; 2 * links.len()]);
        for (from, to) in links.iter().flat_map(|link| [(link.a, link.b), (link.b, link.a)]) {
            others[next[from as usize]] = to;
            next[from as usize] += 1;
        }
        Self { starts, others }
    }

    fn of(&self, particle: usize) -> impl Iterator<Item = usize> {
        self.others[self.starts[particle]..self.starts[particle + 1]].iter().map(|other| *other as usize)
    }
}

/// A particle that no way leads to.
const UNREACHED: u32 = u32::MAX;

impl Load {
    pub(super) fn new<T: Real>(inv_mass: &[T], links: &[Link], surfaces: &[Held]) -> Self {
        let particles = inv_mass.len();
        let neighbours = Neighbours::new(particles, links);
        let mut held: Vec<bool> = inv_mass.iter().map(|w| *w == T::zero()).collect();
        surfaces.iter().for_each(|surface| held[surface.particle as usize] = true);
        let level = levels(&neighbours, &held);
        let component = components(&neighbours, &held);
        let cuts = Cuts::new(inv_mass, links, &level, &component);
        let mut loads: Vec<f64> = links.iter().map(|link| cuts.load(inv_mass, link, &level, &component)).collect();
        loads.sort_by(|a, b| b.total_cmp(a));
        let at = |index: usize| loads.get(index).copied().unwrap_or(0.0);
        Self { largest: at(0), usual: at(loads.len() / FEW) }
    }

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cast saturates; the number is >= 0")]
    pub(super) fn substeps(&self, dt_s: f64, acceleration_m_s2: f64, violation: f64) -> usize {
        let load = (self.usual / AGAIN).max(self.largest / REACH);
        let h_sq = violation / (OVERSHOOT * load * acceleration_m_s2.abs());
        (dt_s.abs() / h_sq.sqrt()).ceil().max(1.0) as usize
    }
}

/// The links from each particle to the nearest that is held.
fn levels(neighbours: &Neighbours, held: &[bool]) -> Vec<u32> {
    let mut level = vec![UNREACHED; held.len()];
    let mut queue: Vec<usize> = (0..held.len()).filter(|particle| held[*particle]).collect();
    queue.iter().for_each(|particle| level[*particle] = 0);
    let mut next = 0;
    while let Some(particle) = queue.get(next).copied() {
        next += 1;
        for other in neighbours.of(particle) {
            if level[other] == UNREACHED {
                level[other] = level[particle] + 1;
                queue.push(other);
            }
        }
    }
    level
}

/// A number for each set of particles that hang together without those that are held: these pass no load on.
fn components(neighbours: &Neighbours, held: &[bool]) -> Vec<usize> {
    let (mut component, mut stack) = (vec![usize::MAX; held.len()], Vec::new());
    for start in (0..held.len()).filter(|start| !held[*start]) {
        stack.push(start);
        while let Some(particle) = stack.pop() {
            if component[particle] == usize::MAX {
                component[particle] = start;
                stack.extend(neighbours.of(particle).filter(|other| !held[*other]));
            }
        }
    }
    component
}

/// Of each cut, by component and level: links that cross it, and mass beyond it.
struct Cuts {
    starts: Vec<usize>,
    links: Vec<u32>,
    mass_beyond: Vec<f64>,
}

impl Cuts {
    fn new<T: Real>(inv_mass: &[T], links: &[Link], level: &[u32], component: &[usize]) -> Self {
        let mut depth = vec![0; level.len()];
        for particle in (0..level.len()).filter(|p| component[*p] != usize::MAX && level[*p] != UNREACHED) {
            let deepest: &mut usize = &mut depth[component[particle]];
            *deepest = (*deepest).max(level[particle] as usize + 1);
        }
        let mut starts = vec![0; level.len() + 1];
        for index in 0..depth.len() {
            starts[index + 1] = starts[index] + depth[index];
        }
        let total = starts[depth.len()];
        let mut cuts = Self { starts, links: vec![0; total], mass_beyond: vec![0.0; total] };
        for (particle, w) in inv_mass.iter().enumerate() {
            if let Some(cut) = cuts.of(particle, level, component) {
                cuts.mass_beyond[cut] += 1.0 / w.to_f64();
            }
        }
        for index in 0..level.len() {
            let (start, end) = (cuts.starts[index], cuts.starts[index + 1]);
            (start..end).rev().skip(1).for_each(|cut| cuts.mass_beyond[cut] += cuts.mass_beyond[cut + 1]);
        }
        for link in links {
            if let Some(cut) = cuts.crossed(link, level, component) {
                cuts.links[cut] += 1;
            }
        }
        cuts
    }

    fn of(&self, particle: usize, level: &[u32], component: &[usize]) -> Option<usize> {
        let reached = component[particle] != usize::MAX && level[particle] != UNREACHED;
        reached.then(|| self.starts[component[particle]] + level[particle] as usize)
    }

    /// The cut on whose sides the ends of a link are, if they are on two.
    fn crossed(&self, link: &Link, level: &[u32], component: &[usize]) -> Option<usize> {
        let (a, b) = (link.a as usize, link.b as usize);
        match level[a].cmp(&level[b]) {
            core::cmp::Ordering::Less => self.of(b, level, component),
            core::cmp::Ordering::Equal => None,
            core::cmp::Ordering::Greater => self.of(a, level, component),
        }
    }

    fn load<T: Real>(&self, inv_mass: &[T], link: &Link, level: &[u32], component: &[usize]) -> f64 {
        self.crossed(link, level, component).map_or(0.0, |cut| {
            let weights = inv_mass[link.a as usize].to_f64() + inv_mass[link.b as usize].to_f64();
            weights * self.mass_beyond[cut] / (f64::from(self.links[cut]) * link.length_sq.sqrt())
        })
    }
}

//! Who the particles of a scene are: those named one by one, and those of chains and nets, in one list.
//!
//! Order: `[[particle]]`, then `[[chain]]`, then `[[net]]`, each in file order; a net row by row. Values are taken as the
//! file has them, sound or not: the check works from this list, too.

mod held;
mod layout;

pub(crate) use held::{Held, held};
pub(crate) use layout::{is_fixed, normal, steps};

use std::collections::HashMap;
use std::ops::Range;

use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;
use crate::scene::description::Scene;

/// The most particles of a scene. Their names, state and record take about 1 kB each: this is a gigabyte.
pub(crate) const MAX_PARTICLES: f64 = 1e6;

/// All particles. Every list but `links` and `groups` has one entry a particle.
#[derive(Clone, Debug, Default)]
pub(crate) struct Roster {
    pub(crate) names: Vec<String>,
    pub(crate) position: Vec<Point<f64>>,
    pub(crate) velocity: Vec<Vector<f64>>,
    /// kg; 0 for a fixed particle without one.
    pub(crate) mass: Vec<f64>,
    pub(crate) fixed: Vec<bool>,
    /// The links of chains and nets, those between fixed particles included.
    pub(crate) links: Vec<[usize; 2]>,
    pub(crate) groups: Vec<Group>,
    /// By the names of particles and groups.
    known: HashMap<String, Range<usize>>,
    /// Groups, and the names of them or their particles that were taken before.
    pub(crate) taken: Vec<(usize, String)>,
}

/// A `[[particle]]`, `[[chain]]` or `[[net]]`.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    pub(crate) name: String,
    /// Its particles.
    pub(crate) range: Range<usize>,
    /// The place of its name, and of what says where it is, in the text.
    pub(crate) named_at: Range<usize>,
    pub(crate) placed_at: Range<usize>,
    /// Whether it is a chain or net.
    pub(crate) many: bool,
}

/// How many particles a scene has, without counting them out.
pub(crate) fn count(scene: &Scene) -> f64 {
    let nets = scene.net.iter().map(|net| f64::from(*net.columns.get_ref()) * f64::from(*net.rows.get_ref()));
    let chains = scene.chain.iter().map(|chain| f64::from(*chain.particles.get_ref()));
    #[expect(clippy::cast_precision_loss, reason = "as many as a file has tables")]
    let single = scene.particle.len() as f64;
    single + chains.sum::<f64>() + nets.sum::<f64>()
}

impl Roster {
    /// Lists the particles. There must be at most [`MAX_PARTICLES`].
    pub(crate) fn of(scene: &Scene) -> Self {
        let mut roster = Self::default();
        for particle in &scene.particle {
            let begin = roster.names.len();
            let mass = particle.mass_kg.as_ref().map_or(0.0, |mass| *mass.get_ref());
            roster.push(particle.name.get_ref().clone(), particle.position_m.get_ref().0, mass, particle.fixed);
            roster.velocity[begin] = particle.velocity_m_s.get_ref().0.into();
            roster.close(begin, particle.name.get_ref(), particle.name.span(), particle.position_m.span(), false);
        }
        for chain in &scene.chain {
            let begin = roster.names.len();
            layout::chain(&mut roster, chain);
            roster.close(begin, chain.name.get_ref(), chain.name.span(), chain.from_m.span(), true);
        }
        for net in &scene.net {
            let begin = roster.names.len();
            layout::net(&mut roster, net);
            roster.close(begin, net.name.get_ref(), net.name.span(), net.corner_m.span(), true);
        }
        roster
    }

    pub(crate) fn len(&self) -> usize {
        self.names.len()
    }

    fn push(&mut self, name: String, position: [f64; 3], mass: f64, fixed: bool) {
        self.names.push(name);
        self.position.push(position.into());
        self.velocity.push(Vector::default());
        self.mass.push(mass);
        self.fixed.push(fixed);
    }

    /// Makes the particles since `begin` a group.
    fn close(&mut self, begin: usize, name: &str, named_at: Range<usize>, placed_at: Range<usize>, many: bool) {
        let range = begin..self.names.len();
        let mut taken = self.known.insert(name.to_owned(), range.clone()).map(|_| name.to_owned());
        if many {
            for index in range.clone() {
                let name = &self.names[index];
                let known = self.known.insert(name.clone(), index..index + 1);
                taken = taken.or(known.map(|_| name.clone()));
            }
        }
        self.taken.extend(taken.map(|name| (self.groups.len(), name)));
        self.groups.push(Group { name: name.to_owned(), range, named_at, placed_at, many });
    }

    /// The particles that a name stands for: one, or all of a chain or net.
    pub(crate) fn all(&self, name: &str) -> Option<Range<usize>> {
        self.known.get(name).cloned()
    }

    /// The one particle of a name.
    pub(crate) fn one(&self, name: &str) -> Option<usize> {
        self.all(name).filter(|range| range.len() == 1).map(|range| range.start)
    }

    /// The group of a particle.
    pub(crate) fn group_of(&self, index: usize) -> &Group {
        let after = self.groups.partition_point(|group| group.range.end <= index);
        &self.groups[after]
    }

    /// Whether a link between two particles can hold anything.
    pub(crate) fn can_move(&self, [a, b]: [usize; 2]) -> bool {
        !(self.fixed[a] && self.fixed[b])
    }
}

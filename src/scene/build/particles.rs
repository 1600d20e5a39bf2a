//! From a checked scene to particles that can be simulated, and how they are drawn.

use std::ops::Range;

use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::Vector;
use crate::particle::{Constraint, Force, Masses, Motion, Particles, Setup, Solver, SolverError};
use crate::scene::Diagnostic;
use crate::scene::description::{self, Scene};
use crate::scene::particles::{Held, Roster, held};

/// Particles that are ready to run. `state`, `mass`, `fixed` and `names` have one entry a particle.
#[derive(Clone, Debug)]
pub struct ParticleSetup<T> {
    /// Positions and velocities at the start.
    pub state: Particles<T>,
    /// Masses, kg; 0 for a fixed particle that attracts nothing.
    pub mass: Vec<T>,
    /// Which never move.
    pub fixed: Vec<bool>,
    /// Forces, gravity among them.
    pub forces: Vec<Force<T>>,
    /// Constraints, of particles that are not all fixed.
    pub constraints: Vec<Constraint>,
    /// Names.
    pub names: Vec<String>,
    /// How they are drawn.
    pub look: ParticleLook,
}

impl<T: Real> ParticleSetup<T> {
    /// The particles, ready to move; where the solver chooses its steps, by none longer than this, s.
    ///
    /// # Errors
    /// A solver that cannot be used.
    pub fn motion(self, solver: &Solver, max_step_s: Option<f64>) -> Result<Motion<T>, SolverError> {
        let inverse = |(mass, fixed): (&T, &bool)| if *fixed { T::zero() } else { T::one() / *mass };
        let inv_mass = self.mass.iter().zip(&self.fixed).map(inverse).collect();
        let masses = Masses { mass: self.mass, inv_mass };
        let setup = Setup { masses, forces: self.forces, constraints: self.constraints };
        Motion::with_max_step(setup, self.state, solver, max_step_s)
    }
}

/// What is drawn besides the particles themselves.
#[derive(Clone, Debug, Default)]
pub struct ParticleLook {
    /// Names of `[[particle]]`, `[[chain]]` and `[[net]]`, with their particles.
    pub groups: Vec<(String, Range<usize>)>,
    /// Pairs of particles that keep their distance.
    pub links: Vec<[usize; 2]>,
    /// Pairs of particles with a spring between them.
    pub springs: Vec<[usize; 2]>,
    /// Particles that keep their distance to a point.
    pub tethers: Vec<(usize, Point<f64>)>,
    /// Points that attract.
    pub centres: Vec<Point<f64>>,
    /// What particles stay on.
    pub guides: Vec<Guide>,
}

/// What a particle stays on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Guide {
    /// A plane through a point, with a unit normal.
    Plane(Point<f64>, Vector<f64>),
    /// A sphere: centre and radius, m.
    Sphere(Point<f64>, f64),
    /// A line through a point, with a unit direction.
    Line(Point<f64>, Vector<f64>),
    /// A circle: centre, radius, m, and unit normal.
    Circle(Point<f64>, f64, Vector<f64>),
}

/// Builds the particles of a scene; nothing if it has none.
pub(super) fn build<T: Real>(scene: &Scene) -> Result<Option<ParticleSetup<T>>, Diagnostic> {
    let roster = Roster::of(scene);
    if roster.len() == 0 {
        return Ok(None);
    }
    let all: Vec<Held> = scene.constraint.iter().flat_map(|constraint| held(constraint, &roster)).collect();
    let look = look(scene, &roster, &all);
    let mut constraints: Vec<Constraint> = roster
        .links
        .iter()
        .filter(|link| roster.can_move(**link))
        .map(|&[a, b]| Constraint::Distance {
            a,
            b,
            length: roster.position[a].distance_sq_to(roster.position[b]).sqrt(),
        })
        .collect();
    constraints.extend(all.iter().flat_map(Held::constraints));
    let forces = forces(scene, &roster)?;
    for group in &roster.groups {
        if let Some(mass) = roster.mass[group.range.clone()].first() {
            number::<T>(*mass, group.named_at.clone())?;
        }
    }
    let Roster { names, position, velocity, mass, fixed, .. } = roster;
    let velocity = velocity.into_iter().map(|velocity| velocity.map(T::from_f64)).collect();
    let mass = mass.into_iter().map(T::from_f64).collect();
    let state = Particles { position, velocity };
    Ok(Some(ParticleSetup { state, mass, fixed, forces, constraints, names, look }))
}

/// The number in the scalar of the run, if that has one of its size.
fn number<T: Real>(value: f64, place: Range<usize>) -> Result<T, Diagnostic> {
    let number = T::from_f64(value);
    let (same, back) = (value == 0.0, number.to_f64());
    if back.is_finite() && (same || back != 0.0) {
        return Ok(number);
    }
    let message = format!("{value:?} is out of the range of the scalar f32");
    Err(Diagnostic::new(message).at(place).help("set `solver.scalar = \"f64\"`, or use other units"))
}

fn forces<T: Real>(scene: &Scene, roster: &Roster) -> Result<Vec<Force<T>>, Diagnostic> {
    let value = |given: &toml::Spanned<f64>| number::<T>(*given.get_ref(), given.span());
    let dragged = |name: Option<&toml::Spanned<String>>| -> Vec<Option<usize>> {
        match name {
            Some(name) => {
                let named = roster.all(name.get_ref()).unwrap_or_default();
                named.filter(|index| !roster.fixed[*index]).map(Some).collect()
            }
            None => vec![None],
        }
    };
    let mut forces = vec![];
    let gravity = scene.gravity_m_s2.get_ref().0;
    if gravity != [0.0; 3] {
        forces.push(Force::Uniform { acceleration: Vector::from(gravity).map(T::from_f64) });
    }
    for force in &scene.force {
        match force {
            description::Force::AtPoint(_) | description::Force::Torque(_) => {}
            description::Force::LinearDrag(drag) if drag.body.is_some() => {}
            description::Force::LinearDrag(drag) => {
                let k = value(&drag.k_kg_s)?;
                let on = dragged(drag.particle.as_ref()).into_iter();
                forces.extend(on.map(|particle| Force::LinearDrag { particle, k }));
            }
            description::Force::QuadraticDrag(drag) => {
                let k = value(&drag.k_kg_m)?;
                let on = dragged(drag.particle.as_ref()).into_iter();
                forces.extend(on.map(|particle| Force::QuadraticDrag { particle, k }));
            }
            description::Force::InverseSquare(force) => forces.push(Force::InverseSquare {
                constant: value(&force.constant_m3_kg_s2)?,
                softening: value(&force.softening_m)?,
            }),
            description::Force::InverseSquareToPoint(force) => forces.push(Force::InverseSquareToPoint {
                point: force.point_m.get_ref().0.into(),
                constant: value(&force.constant_m3_s2)?,
                softening: value(&force.softening_m)?,
            }),
            description::Force::Spring(spring) => {
                let Some([a, b]) = ends(spring, roster) else { continue };
                let apart = roster.position[a].distance_sq_to(roster.position[b]).sqrt();
                forces.push(Force::Spring {
                    a,
                    b,
                    stiffness: value(&spring.stiffness_n_m)?,
                    damping: value(&spring.damping_n_s_m)?,
                    rest_length: spring.rest_length_m.as_ref().map_or(Ok(T::from_f64(apart)), value)?,
                });
            }
        }
    }
    Ok(forces)
}

fn ends(spring: &description::Spring, roster: &Roster) -> Option<[usize; 2]> {
    Some([roster.one(spring.a.get_ref())?, roster.one(spring.b.as_ref()?.get_ref())?])
}

fn look(scene: &Scene, roster: &Roster, all: &[Held]) -> ParticleLook {
    let mut look = ParticleLook {
        groups: roster.groups.iter().map(|group| (group.name.clone(), group.range.clone())).collect(),
        links: roster.links.clone(),
        ..ParticleLook::default()
    };
    let mut guide = |guide: Guide| {
        // Many particles on one surface: it is drawn once.
        if look.guides.last() != Some(&guide) {
            look.guides.push(guide);
        }
    };
    for held in all {
        match *held {
            Held::Pair { a, b, .. } => look.links.push([a, b]),
            Held::ToPoint { particle, point, .. } => look.tethers.push((particle, point)),
            Held::Plane { point, normal, .. } => guide(Guide::Plane(point, normal)),
            Held::Sphere { centre, radius, .. } => guide(Guide::Sphere(centre, radius)),
            Held::Line { point, direction, .. } => guide(Guide::Line(point, direction)),
            Held::Circle { centre, radius, normal, .. } => guide(Guide::Circle(centre, radius, normal)),
        }
    }
    for force in &scene.force {
        match force {
            description::Force::Spring(spring) => look.springs.extend(ends(spring, roster)),
            description::Force::InverseSquareToPoint(force) => look.centres.push(force.point_m.get_ref().0.into()),
            _ => {}
        }
    }
    look
}

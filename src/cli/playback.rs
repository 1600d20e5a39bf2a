//! From what was recorded to what the page shows.

use crate::algebra::Real;
use crate::algebra::g3::Vector;
use crate::io::html::{self, ParticlesView, Playback};
use crate::rigid::Attachment;
use crate::scene::Scene;
use crate::scene::build::{Guide, LinkKind, LinkLook, Look, ParticleLook, ParticleSetup};
use crate::simulation::{BodySample, Event, Frame, Record};

/// Who is in a run, and how they look.
#[derive(Clone, Debug, Default)]
pub(super) struct Cast {
    /// Names of the bodies.
    pub(super) bodies: Vec<String>,
    /// Names of the particles.
    pub(super) particles: Vec<String>,
    looks: Vec<Look>,
    links: Vec<LinkLook>,
    particle_look: ParticleLook,
    fixed: Vec<bool>,
    mass: Vec<f64>,
}

impl Cast {
    pub(super) fn of<T: Real>(
        scene: &Scene,
        looks: Vec<Look>,
        links: Vec<LinkLook>,
        particles: Option<&ParticleSetup<T>>,
    ) -> Self {
        let cast = Self {
            bodies: scene.body.iter().map(|body| body.name.get_ref().clone()).collect(),
            looks,
            links,
            ..Self::default()
        };
        let Some(setup) = particles else {
            return cast;
        };
        Self {
            particles: setup.names.clone(),
            particle_look: setup.look.clone(),
            fixed: setup.fixed.clone(),
            mass: setup.mass.iter().map(|mass| mass.to_f64()).collect(),
            ..cast
        }
    }

    /// Joints and springs between bodies.
    pub(super) fn links(&self) -> &[LinkLook] {
        &self.links
    }

    /// All names: bodies, then particles.
    pub(super) fn names(&self) -> Vec<String> {
        self.bodies.iter().chain(&self.particles).cloned().collect()
    }
}

pub(super) fn playback<'a>(scene: &'a str, cast: &Cast, record: &Record) -> Playback<'a> {
    let pose = |body: &BodySample| {
        let ([x, y, z], [s, e23, e31, e12]) = (<[f64; 3]>::from(body.position), <[f64; 4]>::from(body.rotor));
        [x, y, z, s, e23, e31, e12]
    };
    let energy = |sample: &crate::simulation::EnergySample| html::EnergySample {
        time_s: sample.time_s,
        kinetic_j: sample.totals.kinetic,
        potential_j: sample.totals.potential,
        total_j: sample.totals.energy(),
    };
    Playback {
        scene,
        bodies: bodies(cast, record),
        times_s: record.frames.iter().map(|frame| frame.time_s).collect(),
        poses: record.frames.iter().map(|frame| frame.bodies.iter().map(pose).collect()).collect(),
        stretched: stretched(record),
        links: cast.links.iter().map(link).collect(),
        particles: particles(cast, record),
        marks: record.events.iter().map(|event| mark(event, &cast.bodies)).collect(),
        energy: record.energies.iter().map(energy).collect(),
    }
}

fn bodies(cast: &Cast, record: &Record) -> Vec<html::BodyView> {
    let at_rest = |index: usize| {
        let first = record.frames.first();
        first.is_some_and(|first| record.frames.iter().all(|frame| frame.bodies[index] == first.bodies[index]))
    };
    let shape = |look: &Look| match look {
        Look::Mesh(mesh) => html::Shape::Mesh {
            vertices: mesh.vertices.iter().map(|vertex| <[f64; 3]>::from(*vertex)).collect(),
            triangles: mesh.triangles.clone(),
        },
        Look::Plane(normal) => html::Shape::Plane { normal: <[f64; 3]>::from(*normal) },
        Look::Revolution(profile) => html::Shape::Revolution { profile: profile.clone() },
        Look::Ellipsoid(semi_axes) => html::Shape::Ellipsoid { semi_axes: *semi_axes },
    };
    let view = |(index, (name, look)): (usize, (&String, &Look))| html::BodyView {
        name: name.clone(),
        fixed: at_rest(index),
        shape: shape(look),
    };
    cast.bodies.iter().zip(&cast.looks).enumerate().map(view).collect()
}

fn link(look: &LinkLook) -> html::Link {
    let kind = match look.kind {
        LinkKind::Ball => html::LinkKind::Ball,
        LinkKind::Hinge(axis) => html::LinkKind::Hinge { axis: axis.into() },
        LinkKind::Distance => html::LinkKind::Distance,
        LinkKind::Spring => html::LinkKind::Spring,
    };
    let end = |end: Attachment<f64>| match end {
        Attachment::Body { body_idx, at_body } => html::LinkEnd::Body { body: body_idx, point: at_body.into() },
        Attachment::World(point) => html::LinkEnd::World(point.into()),
    };
    html::Link { kind, ends: look.ends.map(end) }
}

/// Bodies whose orientation is recorded as a matrix M too, as S = ~R M.
fn stretched(record: &Record) -> Vec<html::Stretched> {
    let bodies = record.frames.first().map_or(0, |frame| frame.bodies.len());
    let of_body = |body: usize| {
        let of_frame = |frame: &Frame| {
            let sample = &frame.bodies[body];
            let columns = sample.matrix?.map(|column| <[f64; 3]>::from(sample.rotor.rev().apply(Vector::from(column))));
            Some(std::array::from_fn(|row| std::array::from_fn(|column| columns[column][row])))
        };
        let stretch: Vec<Option<[[f64; 3]; 3]>> = record.frames.iter().map(of_frame).collect();
        let whole = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let any = stretch.iter().any(Option::is_some);
        // At the start the matrix is that of the rotor.
        any.then(|| html::Stretched { body, stretch: stretch.iter().map(|rows| rows.unwrap_or(whole)).collect() })
    };
    (0..bodies).filter_map(of_body).collect()
}

fn mark(event: &Event, names: &[String]) -> html::Mark {
    html::Mark {
        time_s: event.time_s,
        a: names[event.a].clone(),
        b: names[event.b].clone(),
        point: <[f64; 3]>::from(event.point),
        normal: <[f64; 3]>::from(event.normal),
        impulse_n_s: event.impulse,
        kind: event.kind.name().into(),
    }
}

fn particles(cast: &Cast, record: &Record) -> ParticlesView {
    let look = &cast.particle_look;
    let vector = |vector: Vector<f64>| <[f64; 3]>::from(vector);
    let guide = |guide: &Guide| match *guide {
        Guide::Plane(point, normal) => html::Guide::Plane { point: point.into(), normal: vector(normal) },
        Guide::Sphere(centre, radius) => html::Guide::Sphere { centre: centre.into(), radius },
        Guide::Line(point, direction) => html::Guide::Line { point: point.into(), direction: vector(direction) },
        Guide::Circle(centre, radius, normal) => {
            html::Guide::Circle { centre: centre.into(), radius, normal: vector(normal) }
        }
    };
    let frames = record.frames.iter();
    ParticlesView {
        names: cast.particles.clone(),
        groups: look.groups.iter().map(|(name, range)| (name.clone(), range.len())).collect(),
        fixed: cast.fixed.clone(),
        masses: cast.mass.clone(),
        links: look.links.clone(),
        springs: look.springs.clone(),
        tethers: look.tethers.iter().map(|(particle, point)| (*particle, (*point).into())).collect(),
        centres: look.centres.iter().map(|point| (*point).into()).collect(),
        guides: look.guides.iter().map(guide).collect(),
        positions: frames.map(|frame| frame.particles.iter().map(|it| it.position.into()).collect()).collect(),
    }
}

//! From a checked scene to what can be simulated: bodies, whose shapes become meshes, which give mass and inertia; and
//! particles.

mod links;
mod particles;
mod solid;

pub use particles::{Guide, ParticleLook, ParticleSetup};

pub use links::{LinkKind, LinkLook};

use crate::algebra::Real;
use crate::algebra::cga::Point;
use crate::algebra::g3::{Bivector, Rotor, Vector};
use crate::collision::{Collider, Polyhedron};
use crate::geometry::mesh::Mesh;
use crate::rigid::{self, Bodies, Inertia, Motion, Solver};
use crate::scene::description::{Body, Scene};
use crate::scene::{Diagnostic, Numbers, SceneSource, bodies, plan, surfaces};
use crate::simulation::{Setup, World};
use solid::{Solid, solid};

/// How a body looks, in the body frame.
#[derive(Clone, Debug)]
pub enum Look {
    /// A closed surface.
    Mesh(Mesh),
    /// A plane through the body's origin.
    Plane(Vector<f64>),
    /// An ellipsoid by its half-axes, m: a ball, or for a body known by its inertia only the one with its mass and inertia.
    Ellipsoid([f64; 3]),
    /// A surface of revolution about the z axis: distances from it and heights, m, from below to above.
    Revolution(Vec<[f64; 2]>),
}

/// A scene that is ready to run.
#[derive(Clone, Debug)]
pub struct Built<T> {
    /// Bodies at the start, contact.
    pub setup: Setup<T>,
    /// What the bodies are subject to.
    pub subject: rigid::Setup<T>,
    /// How their motion is solved: lists of bodies that are solved alike.
    pub body_solvers: Vec<(Solver, Vec<usize>)>,
    /// How each body looks.
    pub looks: Vec<Look>,
    /// How what links them looks.
    pub links: Vec<LinkLook>,
    /// The particles, if there are any.
    pub particles: Option<ParticleSetup<T>>,
}

impl<T> Built<T> {
    /// The number of particles.
    #[must_use]
    pub fn particle_count(&self) -> usize {
        self.particles.as_ref().map_or(0, |particles| particles.names.len())
    }
}

type Found<T> = Result<T, Diagnostic>;

/// Builds all bodies, particles and forces. Every body that cannot be built is reported, not only the first.
///
/// # Errors
/// What is wrong with meshes, shapes and inertias; bodies that overlap at the start; values out of the range of `T`.
pub fn build<T: Real>(scene: &Scene, source: &SceneSource) -> Result<Built<T>, Vec<Diagnostic>> {
    let mut setup = Setup {
        bodies: Bodies::default(),
        colliders: vec![],
        restitution: T::from_f64(*scene.contact.restitution.get_ref()),
    };
    let mut subject = rigid::Setup { inertias: vec![], forces: links::forces(scene), joints: links::joints(scene) };
    let body_solvers = solvers(scene);
    let (mut looks, mut mistakes) = (vec![], vec![]);
    for body in &scene.body {
        match build_body(body, source, &mut setup, &mut subject) {
            Ok(look) => looks.push(look),
            Err(mistake) => mistakes.push(mistake),
        }
    }
    if mistakes.is_empty() {
        mistakes = overlaps(scene, &setup, &subject, &body_solvers);
    }
    let particles = particles::build(scene).map_err(|mistake| mistakes.push(mistake)).ok().flatten();
    if mistakes.is_empty() {
        Ok(Built { setup, subject, body_solvers, looks, links: links::looks(scene), particles })
    } else {
        Err(mistakes)
    }
}

/// The plan's solvers, each with its bodies. Fixed bodies go with the first.
fn solvers(scene: &Scene) -> Vec<(Solver, Vec<usize>)> {
    let dt_s = plan::interval_s(scene);
    let mut lists: Vec<(Solver, Vec<usize>)> = vec![];
    for solver in plan::BodySolverPlan::of(scene) {
        let first = lists.is_empty();
        let own = |body: &Body| if body.fixed { first } else { scene.formulation_of(body) == solver.formulation };
        let bodies = (0..scene.body.len()).filter(|body_idx| own(&scene.body[*body_idx])).collect();
        lists.push((solver.of_bodies(dt_s), bodies));
    }
    if lists.is_empty() {
        // Nothing moves: the cheapest way to stand still.
        lists.push((Solver::fixed(rigid::Method::FreeFlight, dt_s), (0..scene.body.len()).collect()));
    }
    lists
}

fn overlaps<T: Real>(
    scene: &Scene,
    setup: &Setup<T>,
    subject: &rigid::Setup<T>,
    solvers: &[(Solver, Vec<usize>)],
) -> Vec<Diagnostic> {
    let motion = match Motion::mixed(subject.clone(), &setup.bodies, solvers) {
        Ok(motion) => motion,
        Err(error) => return vec![Diagnostic::new(error.to_string())],
    };
    let overlaps = World::new(setup.clone(), motion).overlaps();
    let names = |index: usize| scene.body[index].name.get_ref();
    let report = |(a, b, depth): (usize, usize, T)| {
        Diagnostic::new(format!("bodies `{}` and `{}` overlap at the start", names(a), names(b)))
            .at(scene.body[b].name.span())
            .label(format!("{:.3e} m deep", depth.to_f64()))
            .help("move one of them by `position_m`, or turn it, until they are apart")
    };
    overlaps.into_iter().map(report).collect()
}

fn build_body<T: Real>(
    body: &Body,
    source: &SceneSource,
    setup: &mut Setup<T>,
    subject: &mut rigid::Setup<T>,
) -> Found<Look> {
    let name_span = body.name.span();
    let solid = body.shape.as_ref().map(|shape| solid(shape, *body.scale.get_ref(), source)).transpose()?;
    let inertia_matrix = match (&body.inertia_kg_m2, &solid) {
        (Some(given), _) => Some((symmetric(given.get_ref().rows()), given.span())),
        (None, solid) => solid.as_ref().and_then(Solid::properties).map(|(properties, span)| {
            let density = body.mass_kg.as_ref().map_or(0.0, |mass| mass.get_ref() / properties.volume);
            (properties.inertia_unit_density.map(|row| row.map(|x| x * density)), span.clone())
        }),
    };
    let inertia = match (&body.mass_kg, &inertia_matrix) {
        (Some(mass), Some((matrix, span))) if !body.fixed => {
            let failed = |error: rigid::InertiaError| Diagnostic::new(error.to_string()).at(span.clone());
            Inertia::new(*mass.get_ref(), *matrix).map_err(failed)?
        }
        _ => Inertia::immovable(),
    };
    let rotor = orientation(body)?;
    let collider = match &solid {
        Some(Solid::Mesh { mesh, bound, span, .. }) => {
            let polyhedron = Polyhedron::new(mesh, *bound);
            let failed = |error: crate::collision::PolyhedronError| {
                Diagnostic::new(format!("the shape cannot collide: {error}")).at(span.clone())
            };
            Collider::Convex(polyhedron.map_err(failed)?)
        }
        Some(Solid::Plane(normal)) => Collider::HalfSpace(normal.map(T::from_f64)),
        Some(Solid::Round { .. }) | None => Collider::None,
    };
    let omega_body = omega_body(body, rotor);
    let velocity = Vector::from(body.velocity_m_s.get_ref().0).map(T::from_f64);
    let angular_momentum = rotor.apply(inertia.momentum_of(omega_body));
    setup.bodies.push(Point::from(body.position_m.get_ref().0), rotor, velocity * inertia.mass, angular_momentum);
    subject.inertias.push(inertia);
    setup.colliders.push(collider);
    match solid {
        Some(Solid::Mesh { mesh, .. }) => Ok(Look::Mesh(mesh)),
        Some(Solid::Round { look, .. }) => Ok(look),
        Some(Solid::Plane(normal)) => Ok(Look::Plane(normal)),
        None => {
            let missing = || Diagnostic::new("a body needs a shape or an inertia").at(name_span);
            let (matrix, _) = inertia_matrix.ok_or_else(missing)?;
            let mass = body.mass_kg.as_ref().map_or(1.0, |mass| *mass.get_ref());
            Ok(Look::Ellipsoid(surfaces::ellipsoid_half_axes(mass, matrix)))
        }
    }
}

/// The mean of the two halves: what rounding left of an asymmetry goes.
fn symmetric(rows: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|r| std::array::from_fn(|c| f64::midpoint(rows[r][c], rows[c][r])))
}

fn orientation<T: Real>(body: &Body) -> Found<Rotor<T>> {
    let rotor = bodies::rotor(body);
    // Rounded to T it is renormalised, so that it is unit to the last digit of T.
    let rotor = rotor.and_then(|rotor| Rotor::normalise(rotor.map(T::from_f64).into()).map_err(|error| (error, 0..0)));
    rotor.map_err(|(error, span)| Diagnostic::new(error.to_string()).at(span))
}

fn omega_body<T: Real>(body: &Body, rotor: Rotor<T>) -> Bivector<T> {
    let components = |given: &toml::Spanned<Numbers<3>>| Bivector::from(given.get_ref().0).map(T::from_f64);
    match (&body.omega_body_rad_s, &body.omega_world_rad_s) {
        (Some(given), _) => components(given),
        (None, Some(given)) => rotor.rev().apply(components(given)),
        (None, None) => Bivector::default(),
    }
}

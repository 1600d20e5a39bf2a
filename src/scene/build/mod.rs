//! From a checked scene to what can be simulated: bodies, whose shapes become meshes, which give mass and inertia; and
//! particles.

mod particles;

pub use particles::{Guide, ParticleLook, ParticleSetup};

use crate::algebra::Real;
use crate::algebra::cga::{Dilator, Point, Sphere};
use crate::algebra::g3::{Bivector, Rotor, Vector};
use crate::collision::{Collider, Polyhedron};
use crate::geometry::enclosing_sphere::enclosing_sphere;
use crate::geometry::mass_properties::{MassProperties, mass_properties};
use crate::geometry::mesh::Mesh;
use crate::geometry::mesh_checks::{self, Severity};
use crate::io::mesh_file::read_mesh;
use crate::rigid::{self, Bodies, Force, Forces, Inertia, Motion, Solver};
use crate::scene::description::{self, Body, Orientation, Scene, Shape};
use crate::scene::{Diagnostic, Numbers, SceneSource, plan, solids};
use crate::simulation::{Setup, World};
use std::ops::Range;

/// How a body looks, in the body frame.
#[derive(Clone, Debug)]
pub enum Look {
    /// A closed surface.
    Mesh(Mesh),
    /// A plane through the body's origin.
    Plane(Vector<f64>),
    /// A body known by its inertia only: half-axes of the solid ellipsoid of the same mass and inertia, m.
    Ellipsoid([f64; 3]),
}

/// A scene that is ready to run.
#[derive(Clone, Debug)]
pub struct Built<T> {
    /// Bodies at the start, contact.
    pub setup: Setup<T>,
    /// What the bodies are subject to.
    pub subject: rigid::Setup<T>,
    /// How their motion is solved.
    pub body_solver: Solver,
    /// How each body looks.
    pub looks: Vec<Look>,
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
    let mut subject = rigid::Setup { inertias: vec![], forces: forces(scene), joints: vec![] };
    let body_solver = Solver::fixed(rigid::Method::Yoshida6, plan::interval_s(scene));
    let (mut looks, mut mistakes) = (vec![], vec![]);
    for body in &scene.body {
        match build_body(body, source, &mut setup, &mut subject) {
            Ok(look) => looks.push(look),
            Err(mistake) => mistakes.push(mistake),
        }
    }
    if mistakes.is_empty() {
        mistakes = overlaps(scene, &setup, &subject, &body_solver);
    }
    let particles = particles::build(scene).map_err(|mistake| mistakes.push(mistake)).ok().flatten();
    if mistakes.is_empty() { Ok(Built { setup, subject, body_solver, looks, particles }) } else { Err(mistakes) }
}

fn overlaps<T: Real>(scene: &Scene, setup: &Setup<T>, subject: &rigid::Setup<T>, solver: &Solver) -> Vec<Diagnostic> {
    let motion = match Motion::new(subject.clone(), &setup.bodies, solver) {
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
        (None, Some(Solid::Mesh { properties, span, .. })) => {
            let density = body.mass_kg.as_ref().map_or(0.0, |mass| mass.get_ref() / properties.volume);
            Some((properties.inertia_unit_density.map(|row| row.map(|x| x * density)), span.clone()))
        }
        _ => None,
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
        None => Collider::None,
    };
    let omega_body = omega_body(body, rotor);
    let velocity = Vector::from(body.velocity_m_s.get_ref().0).map(T::from_f64);
    let angular_momentum = rotor.apply(inertia.momentum_of(omega_body));
    setup.bodies.push(Point::from(body.position_m.get_ref().0), rotor, velocity * inertia.mass, angular_momentum);
    subject.inertias.push(inertia);
    setup.colliders.push(collider);
    match solid {
        Some(Solid::Mesh { mesh, .. }) => Ok(Look::Mesh(mesh)),
        Some(Solid::Plane(normal)) => Ok(Look::Plane(normal)),
        None => {
            let missing = || Diagnostic::new("a body needs a shape or an inertia").at(name_span);
            let (matrix, _) = inertia_matrix.ok_or_else(missing)?;
            let mass = body.mass_kg.as_ref().map_or(1.0, |mass| *mass.get_ref());
            Ok(Look::Ellipsoid(solids::ellipsoid_half_axes(mass, matrix)))
        }
    }
}

/// The mean of the two halves: what rounding left of an asymmetry goes.
fn symmetric(rows: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|r| std::array::from_fn(|c| f64::midpoint(rows[r][c], rows[c][r])))
}

fn orientation<T: Real>(body: &Body) -> Found<Rotor<T>> {
    let (rotor, span) = match &body.orientation {
        None => return Ok(Rotor::default()),
        Some(Orientation::Rotor(given)) => {
            let [s, e23, e31, e12] = given.get_ref().0;
            let largest = [s, e23, e31, e12].iter().fold(0.0_f64, |max, x| max.max(x.abs()));
            // Scaled first: the squares of very large or small numbers would leave the range.
            let even = crate::algebra::g3::Even::new(s, e23, e31, e12) / largest;
            (Rotor::normalise(even), given.span())
        }
        Some(Orientation::AxisAngle(turn)) => {
            let axis = Vector::from(turn.axis.get_ref().0);
            (Rotor::from_axis_angle(axis, *turn.angle_rad.get_ref()), turn.axis.span())
        }
    };
    let rotor: Rotor<f64> = rotor.map_err(|error| Diagnostic::new(error.to_string()).at(span.clone()))?;
    // Rounded to T it is renormalised, so that it is unit to the last digit of T.
    Rotor::normalise(rotor.map(T::from_f64).into()).map_err(|error| Diagnostic::new(error.to_string()).at(span))
}

fn omega_body<T: Real>(body: &Body, rotor: Rotor<T>) -> Bivector<T> {
    let components = |given: &toml::Spanned<Numbers<3>>| Bivector::from(given.get_ref().0).map(T::from_f64);
    match (&body.omega_body_rad_s, &body.omega_world_rad_s) {
        (Some(given), _) => components(given),
        (None, Some(given)) => rotor.rev().apply(components(given)),
        (None, None) => Bivector::default(),
    }
}

/// A shape in the body frame.
enum Solid {
    Mesh { mesh: Mesh, properties: MassProperties, bound: Sphere<f64>, span: Range<usize> },
    Plane(Vector<f64>),
}

fn solid(shape: &Shape, scale: f64, source: &SceneSource) -> Found<Solid> {
    let (mesh, span) = match shape {
        Shape::Plane(plane) => {
            let normal = Vector::from(plane.normal.get_ref().0);
            return Ok(Solid::Plane(normal / normal.norm_sq().sqrt()));
        }
        Shape::Box(shape) => (solids::cuboid(shape.size_m.get_ref().0), shape.size_m.span()),
        Shape::Pyramid(shape) => {
            (solids::pyramid(*shape.base_m.get_ref(), *shape.height_m.get_ref()), shape.base_m.span())
        }
        Shape::Tetrahedron(shape) => (solids::tetrahedron(shape.vertices_m.get_ref().0), shape.vertices_m.span()),
        Shape::Mesh(shape) => {
            let span = shape.file.span();
            let path = source.resolve(shape.file.get_ref());
            let file = read_mesh(&path).map_err(|error| Diagnostic::new(error.to_string()).at(span.clone()))?;
            (Ok(file.mesh), span)
        }
    };
    let failed = |what: String| Diagnostic::new(what).at(span.clone());
    let mesh = scaled(&mesh.map_err(|error| failed(error.to_string()))?, scale);
    usable(&mesh, &span)?;
    let properties = mass_properties(&mesh).map_err(|error| failed(error.to_string()))?;
    let centred: Vec<Point<f64>> =
        mesh.vertices.iter().map(|vertex| properties.centre.displacement_to(*vertex).into()).collect();
    let ball = enclosing_sphere(&centred).map_err(|error| failed(error.to_string()))?.ball;
    let mesh = Mesh::new(centred, mesh.triangles).map_err(|error| failed(error.to_string()))?;
    Ok(Solid::Mesh { mesh, properties, bound: Sphere::around(ball.centre, ball.radius), span })
}

/// Scales about the origin by the conformal dilator.
fn scaled(mesh: &Mesh, factor: f64) -> Mesh {
    let mut mesh = mesh.clone();
    // A factor of 1 must leave every bit as it is.
    if let Some(dilator) = Dilator::by(factor).filter(|_| factor != 1.0) {
        mesh.vertices.iter_mut().for_each(|vertex| *vertex = dilator.apply(*vertex));
    }
    mesh
}

/// Refuses what is no convex solid, in the words of the mesh report.
fn usable(mesh: &Mesh, span: &Range<usize>) -> Found<()> {
    let report = mesh_checks::check(mesh);
    if !report.usable_as_body {
        let worst = report.messages.iter().find(|message| message.severity == Severity::Error);
        let text = worst.map_or_else(|| "it bounds no solid".to_string(), |message| message.text.clone());
        return Err(Diagnostic::new(format!("this shape is no solid body: {text}"))
            .at(span.clone())
            .help("`ga-physics mesh FILE` lists all that is wrong with a mesh file"));
    }
    if !report.convex {
        return Err(Diagnostic::new("this shape is not convex, and collisions are modelled for convex bodies only")
            .at(span.clone())
            .help("use its convex hull, or split it into convex bodies"));
    }
    Ok(())
}

fn forces<T: Real>(scene: &Scene) -> Forces<T> {
    let vector = |numbers: &toml::Spanned<Numbers<3>>| Vector::from(numbers.get_ref().0).map(T::from_f64);
    let number = |value: &toml::Spanned<f64>| *value.get_ref();
    let forces = scene.force.iter().filter_map(|force| match force {
        description::Force::AtPoint(force) => Some(Force::AtPoint {
            body_idx: scene.body_idx(force.body.get_ref())?,
            at_body: vector(&force.at_body_m),
            force_world: vector(&force.force_world_n),
            start_s: number(&force.start_s),
            end_s: force.end_s.as_ref().map_or(f64::INFINITY, number),
        }),
        description::Force::LinearDrag(drag) => Some(Force::LinearDrag {
            body_idx: scene.body_idx(drag.body.as_ref()?.get_ref())?,
            k: T::from_f64(number(&drag.k_kg_s)),
            k_angular: T::from_f64(number(&drag.k_angular_n_m_s)),
        }),
        _ => None,
    });
    Forces { gravity: vector(&scene.gravity_m_s2), forces: forces.collect() }
}

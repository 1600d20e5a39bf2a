//! From a shape to its mass properties, and to what it looks like and collides as.

use std::ops::Range;

use super::{Found, Look};
use crate::algebra::cga::{Dilator, Point, Sphere};
use crate::algebra::g3::Vector;
use crate::geometry::enclosing_sphere::enclosing_sphere;
use crate::geometry::mass_properties::MassProperties;
use crate::geometry::mesh::Mesh;
use crate::geometry::mesh_checks::{self, Severity};
use crate::geometry::solids::{self, SolidError};
use crate::io::mass_file::{self, KeptMass};
use crate::io::mesh_file::read_mesh;
use crate::scene::description::Shape;
use crate::scene::{Diagnostic, SceneSource, pictures, surfaces};

/// A shape in the body frame.
pub(super) enum Solid {
    /// Convex: it collides.
    Mesh { mesh: Mesh, properties: MassProperties, bound: Sphere<f64>, span: Range<usize> },
    /// Of revolution: it does not collide yet.
    Round { look: Look, properties: MassProperties, span: Range<usize> },
    /// A half-space.
    Plane(Vector<f64>),
}

impl Solid {
    /// Its mass properties and the place of its shape in the text; a half-space has none.
    pub(super) fn properties(&self) -> Option<(&MassProperties, &Range<usize>)> {
        match self {
            Self::Mesh { properties, span, .. } | Self::Round { properties, span, .. } => Some((properties, span)),
            Self::Plane(_) => None,
        }
    }
}

/// The solid of a shape.
pub(super) fn solid(shape: &Shape, scale: f64, source: &SceneSource) -> Found<Solid> {
    let mut kept = None;
    let length = |value: &toml::Spanned<f64>| value.get_ref() * scale;
    let (mesh, span) = match shape {
        Shape::Ball(it) => {
            let radius = length(&it.radius_m);
            return round(solids::ball(radius), Look::Ellipsoid([radius; 3]), it.radius_m.span());
        }
        Shape::Capsule(it) => {
            let (r, l) = (length(&it.radius_m), length(&it.length_m));
            return round(solids::capsule(r, l), Look::Revolution(pictures::capsule(r, l)), it.radius_m.span());
        }
        Shape::Cylinder(it) => {
            let (r, l) = (length(&it.radius_m), length(&it.length_m));
            return round(solids::cylinder(r, l), Look::Revolution(pictures::cylinder(r, l)), it.radius_m.span());
        }
        Shape::Cone(it) => {
            let (r, h) = (length(&it.radius_m), length(&it.height_m));
            return round(solids::cone(r, h), Look::Revolution(pictures::cone(r, h)), it.radius_m.span());
        }
        Shape::Plane(plane) => {
            let normal = Vector::from(plane.normal.get_ref().0);
            return Ok(Solid::Plane(normal / normal.norm_sq().sqrt()));
        }
        Shape::Box(shape) => (surfaces::cuboid(shape.size_m.get_ref().0), shape.size_m.span()),
        Shape::Pyramid(shape) => {
            (surfaces::pyramid(*shape.base_m.get_ref(), *shape.height_m.get_ref()), shape.base_m.span())
        }
        Shape::Tetrahedron(shape) => (surfaces::tetrahedron(shape.vertices_m.get_ref().0), shape.vertices_m.span()),
        Shape::Mesh(shape) => {
            let span = shape.file.span();
            let path = source.resolve(shape.file.get_ref());
            let file = read_mesh(&path).map_err(|error| Diagnostic::new(error.to_string()).at(span.clone()))?;
            kept = mass_file::read(&path, &file.fingerprint)
                .map_err(|error| Diagnostic::new(error.to_string()).at(span.clone()))?;
            (Ok(file.mesh), span)
        }
    };
    let failed = |what: String| Diagnostic::new(what).at(span.clone());
    let mesh = mesh.map_err(|error| failed(error.to_string()))?;
    let properties = convex_solid(&mesh, kept, &span)?.scaled(scale).map_err(|error| failed(error.to_string()))?;
    let mesh = scaled(&mesh, scale);
    let centred: Vec<Point<f64>> =
        mesh.vertices.iter().map(|vertex| properties.centre.displacement_to(*vertex).into()).collect();
    let ball = enclosing_sphere(&centred).map_err(|error| failed(error.to_string()))?.ball;
    let mesh = Mesh::new(centred, mesh.triangles).map_err(|error| failed(error.to_string()))?;
    Ok(Solid::Mesh { mesh, properties, bound: Sphere::around(ball.centre, ball.radius), span })
}

/// A solid with mass properties in closed form.
fn round(properties: Result<MassProperties, SolidError>, look: Look, span: Range<usize>) -> Found<Solid> {
    let properties = properties.map_err(|error| Diagnostic::new(error.to_string()).at(span.clone()))?;
    Ok(Solid::Round { look, properties, span })
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

/// The mass properties of a convex solid, as kept beside its file or else from the mesh. What is none is refused in the words
/// of the mesh report. Judged as given, before it is scaled: the roundings of that would dent flat faces.
fn convex_solid(mesh: &Mesh, kept: Option<KeptMass>, span: &Range<usize>) -> Found<MassProperties> {
    let known = kept.map_or_else(|| examined(mesh, span), Ok)?;
    if !known.convex {
        return Err(Diagnostic::new("this shape is not convex, and collisions are modelled for convex bodies only")
            .at(span.clone())
            .help("use its convex hull, or split it into convex bodies"));
    }
    Ok(known.properties)
}

fn examined(mesh: &Mesh, span: &Range<usize>) -> Found<KeptMass> {
    let report = mesh_checks::check(mesh);
    let Some(properties) = report.mass_properties else {
        let worst = report.messages.iter().find(|message| message.severity == Severity::Error);
        let text = worst.map_or_else(|| "it bounds no solid".to_string(), |message| message.text.clone());
        return Err(Diagnostic::new(format!("this shape is no solid body: {text}"))
            .at(span.clone())
            .help("`ga-physics mesh FILE` lists all that is wrong with a mesh file"));
    };
    Ok(KeptMass { convex: report.convex, properties })
}

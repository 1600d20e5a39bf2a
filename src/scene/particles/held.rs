//! From the constraints of a scene to those of particles, in conformal form.
//!
//! A line is the meet of two planes through it at right angles, a circle that of its plane and the sphere with its
//! centre and radius: `M = undual(S1 ^ S2)`, so that `X ^ M = 0` is `X . S1 = X . S2 = 0`. Every surface is held in the
//! frame of a point of its own.

use super::Roster;
use crate::algebra::cga::{Point, Round};
use crate::algebra::g3::Vector;
use crate::particle;
use crate::scene::description::Constraint;

/// What one entry of the scene holds one particle by, or a pair.
#[derive(Clone, Debug)]
pub(crate) enum Held {
    Pair { a: usize, b: usize, length: f64 },
    ToPoint { particle: usize, point: Point<f64>, length: f64 },
    Plane { particle: usize, point: Point<f64>, normal: Vector<f64> },
    Sphere { particle: usize, centre: Point<f64>, radius: f64 },
    Line { particle: usize, point: Point<f64>, direction: Vector<f64> },
    Circle { particle: usize, centre: Point<f64>, radius: f64, normal: Vector<f64> },
}

fn unit(given: [f64; 3]) -> Vector<f64> {
    let vector = Vector::from(given);
    vector / vector.norm_sq().sqrt()
}

/// What an entry holds: one for each of its particles that is not fixed. Nothing where a name is not known.
pub(crate) fn held(constraint: &Constraint, roster: &Roster) -> Vec<Held> {
    let at = |index: usize| roster.position[index];
    let distance = |index: usize, point: Point<f64>| at(index).distance_sq_to(point).sqrt();
    let free = |name: &str| roster.all(name).unwrap_or_default().filter(|index| !roster.fixed[*index]);
    let number = |value: &Option<toml::Spanned<f64>>| value.as_ref().map(|value| *value.get_ref());
    match constraint {
        Constraint::Distance(it) => {
            let (Some(a), Some(b)) = (roster.one(it.a.get_ref()), roster.one(it.b.get_ref())) else {
                return vec![];
            };
            let length = number(&it.length_m).unwrap_or_else(|| distance(a, at(b)));
            vec![Held::Pair { a, b, length }]
        }
        Constraint::DistanceToPoint(it) => {
            let point = Point::from(it.point_m.get_ref().0);
            let length = |index| number(&it.length_m).unwrap_or_else(|| distance(index, point));
            let one = |particle| Held::ToPoint { particle, point, length: length(particle) };
            free(it.particle.get_ref()).map(one).collect()
        }
        Constraint::OnPlane(it) => {
            let point = |index| it.point_m.as_ref().map_or_else(|| at(index), |point| point.get_ref().0.into());
            let normal = unit(it.normal.get_ref().0);
            let one = |particle| Held::Plane { particle, point: point(particle), normal };
            free(it.particle.get_ref()).map(one).collect()
        }
        Constraint::OnSphere(it) => {
            let centre = Point::from(it.centre_m.get_ref().0);
            let radius = |index| number(&it.radius_m).unwrap_or_else(|| distance(index, centre));
            let one = |particle| Held::Sphere { particle, centre, radius: radius(particle) };
            free(it.particle.get_ref()).map(one).collect()
        }
        Constraint::OnLine(it) => {
            let point = |index| it.point_m.as_ref().map_or_else(|| at(index), |point| point.get_ref().0.into());
            let direction = unit(it.direction.get_ref().0);
            let one = |particle| Held::Line { particle, point: point(particle), direction };
            free(it.particle.get_ref()).map(one).collect()
        }
        Constraint::OnCircle(it) => {
            let centre = Point::from(it.centre_m.get_ref().0);
            let radius = |index| number(&it.radius_m).unwrap_or_else(|| distance(index, centre));
            let normal = unit(it.normal.get_ref().0);
            let one = |particle| Held::Circle { particle, centre, radius: radius(particle), normal };
            free(it.particle.get_ref()).map(one).collect()
        }
    }
}

/// Two unit vectors that make a right-handed frame with a unit vector.
fn across(direction: Vector<f64>) -> [Vector<f64>; 2] {
    // The axis that the direction is least along, less its part along the direction.
    let sizes = <[f64; 3]>::from(direction).map(f64::abs);
    let least = (0..3).fold(0, |least, axis| if sizes[axis] < sizes[least] { axis } else { least });
    let axis = Vector::from(std::array::from_fn(|i| if i == least { 1.0 } else { 0.0 }));
    let first = axis - direction * (axis | direction);
    let first = first / first.norm_sq().sqrt();
    let second = direction ^ first;
    [first, Vector::new(second.e23, second.e31, second.e12)]
}

/// The plane through the origin with a unit normal.
fn plane(normal: Vector<f64>) -> Round<f64> {
    Round::new(normal.e1, normal.e2, normal.e3, 0.0, 0.0)
}

/// The sphere about the origin.
fn sphere(radius: f64) -> Round<f64> {
    Round::new(0.0, 0.0, 0.0, 1.0, -0.5 * radius * radius)
}

impl Held {
    /// The constraints of this, one or two.
    pub(crate) fn constraints(&self) -> Vec<particle::Constraint> {
        let on = |particle: usize, anchor: Point<f64>, surfaces: &[Round<f64>]| {
            let one = |surface: &Round<f64>| particle::Constraint::On { particle, anchor, surface: *surface };
            surfaces.iter().map(one).collect()
        };
        match *self {
            Self::Pair { a, b, length } => vec![particle::Constraint::Distance { a, b, length }],
            Self::ToPoint { particle, point, length } => {
                vec![particle::Constraint::ToPoint { particle, point, length }]
            }
            Self::Plane { particle, point, normal } => on(particle, point, &[plane(normal)]),
            Self::Sphere { particle, centre, radius } => on(particle, centre, &[sphere(radius)]),
            Self::Line { particle, point, direction } => on(particle, point, &across(direction).map(plane)),
            Self::Circle { particle, centre, radius, normal } => on(particle, centre, &[plane(normal), sphere(radius)]),
        }
    }

    /// The particle that must be put somewhere, and the nearest place that this allows; of a pair there is no one.
    pub(crate) fn nearest(&self, roster: &Roster) -> Option<(usize, Point<f64>)> {
        let out = |centre: Point<f64>, way: Vector<f64>, radius: f64| {
            let size = way.norm_sq().sqrt();
            (size > 0.0).then(|| centre.moved(way * (radius / size)))
        };
        match *self {
            Self::Pair { .. } => None,
            Self::ToPoint { particle, point: centre, length: radius } | Self::Sphere { particle, centre, radius } => {
                let way = centre.displacement_to(roster.position[particle]);
                Some((particle, out(centre, way, radius)?))
            }
            Self::Plane { particle, point, normal } => {
                let way = point.displacement_to(roster.position[particle]);
                Some((particle, roster.position[particle].moved(normal * -(way | normal))))
            }
            Self::Line { particle, point, direction } => {
                let way = point.displacement_to(roster.position[particle]);
                Some((particle, point.moved(direction * (way | direction))))
            }
            Self::Circle { particle, centre, radius, normal } => {
                let way = centre.displacement_to(roster.position[particle]);
                Some((particle, out(centre, way - normal * (way | normal), radius)?))
            }
        }
    }

    /// Orthogonal unit vectors along which the particle must not move; of a pair, its second relative to its first.
    pub(crate) fn barred(&self, roster: &Roster) -> Vec<Vector<f64>> {
        let along = |from: Point<f64>, to: usize| unit(from.displacement_to(roster.position[to]).into());
        match *self {
            Self::Pair { a, b, .. } => vec![along(roster.position[a], b)],
            Self::ToPoint { particle, point, .. } => vec![along(point, particle)],
            Self::Sphere { particle, centre, .. } => vec![along(centre, particle)],
            Self::Plane { normal, .. } => vec![normal],
            Self::Line { direction, .. } => across(direction).into(),
            Self::Circle { particle, centre, normal, .. } => vec![normal, along(centre, particle)],
        }
    }
}

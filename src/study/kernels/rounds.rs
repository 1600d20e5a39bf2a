//! Spheres and circles from points, and whether two balls overlap.

use super::numbers::{Multi, numbers, position, single, sphere_of, truth};
use super::{Kernel, Way, inputs};
use crate::algebra::cga::{self, Point, Sphere};
use crate::algebra::dynamic::ToDynamic;
use crate::algebra::{Real, Scalar};
use crate::geometry::formulas;
use nalgebra::Vector3;

/// The sphere through four points: centre and squared radius.
#[must_use]
pub fn sphere_of_four_points() -> Kernel {
    fn sphere<T: Scalar>([a, b, c, d]: &[Point<T>; 4]) -> Sphere<T> {
        formulas::circumsphere(*a, *b, *c, *d)
    }
    let inputs = inputs::tetrahedra();
    Kernel::new("sphere of four points", "dual(A ^ B ^ C ^ D), normalised")
        .with(Way::generated(&inputs, sphere, |s| numbers::<_, _, 4>(*s)))
        .with(Way::single(&inputs, |points| points.map(|p| p.map(single)), sphere, |s| numbers::<_, _, 4>(*s)))
        .with(Way::dynamic(
            &inputs,
            |points| points.map(|point| point.to_dynamic()),
            |[a, b, c, d]: &[Multi<cga::Algebra>; 4]| formulas::circumsphere_dynamic(a, b, c, d),
            sphere_of,
        ))
        .with(Way::hand_written(
            &inputs,
            |points| points.map(position),
            circumsphere_by_vectors,
            |(centre, radius_sq)| vec![centre.x, centre.y, centre.z, *radius_sq],
        ))
}

/// The centre solves `2 (b - a) . (x - a) = |b - a|²` and the same for c and d, by Cramer's rule:
/// `x - a = (|u|² v×w + |v|² w×u + |w|² u×v) / (2 u . v×w)`.
fn circumsphere_by_vectors([a, b, c, d]: &[Vector3<f64>; 4]) -> (Vector3<f64>, f64) {
    let (u, v, w) = (b - a, c - a, d - a);
    let normal = v.cross(&w);
    let sum = normal * u.norm_squared() + w.cross(&u) * v.norm_squared() + u.cross(&v) * w.norm_squared();
    let radius = sum / (2.0 * u.dot(&normal));
    (a + radius, radius.norm_squared())
}

/// The circle through three points: centre and squared radius, as the smallest sphere through it.
#[must_use]
pub fn circle_of_three_points() -> Kernel {
    fn circle<T: Scalar>([a, b, c]: &[Point<T>; 3]) -> Sphere<T> {
        formulas::circle_sphere(*a, *b, *c)
    }
    let inputs = inputs::triangles();
    Kernel::new("circle of three points", "dual(K ^ dual(K ^ ninf)), normalised, with K = A ^ B ^ C")
        .with(Way::generated(&inputs, circle, |s| numbers::<_, _, 4>(*s)))
        .with(Way::single(&inputs, |points| points.map(|p| p.map(single)), circle, |s| numbers::<_, _, 4>(*s)))
        .with(Way::dynamic(
            &inputs,
            |points| points.map(|point| point.to_dynamic()),
            |[a, b, c]: &[Multi<cga::Algebra>; 3]| formulas::circle_sphere_dynamic(a, b, c),
            sphere_of,
        ))
        .with(Way::hand_written(
            &inputs,
            |points| points.map(position),
            circle_by_vectors,
            |(centre, radius_sq)| vec![centre.x, centre.y, centre.z, *radius_sq],
        ))
}

/// The centre in the frame of a: `(u×v) × (|v|² u - |u|² v) / (2 |u×v|²)`. The Gram matrix of u and v gives it in fewer
/// operations, but its determinant `u² v² - (u.v)²` cancels: an error of `eps/sin²` in the place of `eps/sin`.
fn circle_by_vectors([a, b, c]: &[Vector3<f64>; 3]) -> (Vector3<f64>, f64) {
    let (u, v) = (b - a, c - a);
    let normal = u.cross(&v);
    let radius = normal.cross(&(u * v.norm_squared() - v * u.norm_squared())) * (0.5 / normal.norm_squared());
    (a + radius, radius.norm_squared())
}

/// Whether two balls have a point in common.
#[must_use]
pub fn balls_overlap() -> Kernel {
    fn overlap<T: Real>([(a, r), (b, s)]: &[(Point<T>, T); 2]) -> bool {
        let (reach_sq, distance_sq) = formulas::ball_reach_and_distance_sq(*a, *r, *b, *s);
        distance_sq <= reach_sq
    }
    let inputs = inputs::ball_pairs();
    let spheres: Vec<_> = inputs.iter().map(|balls| balls.map(|(c, r)| Sphere::new(c.x, c.y, c.z, r * r))).collect();
    Kernel::new("balls overlap", "-2 A . B <= (r + s)²; dynamic: S . T >= -r s")
        .with(Way::generated(&inputs, overlap, |hit| truth(*hit)))
        .with(Way::single(&inputs, |pair| pair.map(|(c, r)| (c.map(single), single(r))), overlap, |hit| truth(*hit)))
        .with(Way::dynamic(
            &spheres,
            |pair| pair.map(|sphere| sphere.to_dynamic()),
            |[s, t]: &[Multi<cga::Algebra>; 2]| {
                (s | t).coefficient(0) >= -((s * s).coefficient(0) * (t * t).coefficient(0)).sqrt()
            },
            |hit| truth(*hit),
        ))
        .with(Way::hand_written(
            &inputs,
            |balls| balls.map(|(centre, radius)| (position(centre), radius)),
            |[(a, r), (b, s)]| (a - b).norm_squared() <= (r + s) * (r + s),
            |hit| truth(*hit),
        ))
}

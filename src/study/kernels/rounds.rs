//! Spheres and circles from points, and whether two balls overlap.

use super::numbers::{Multi, numbers, position, single, sphere_of, truth};
use super::{Kernel, Way, inputs};
use crate::algebra::cga::{self, Point, Sphere};
use crate::algebra::dynamic::ToDynamic;
use crate::algebra::g3::Vector;
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
        let round = formulas::circle_sphere_relative(*a, *b, *c);
        let scale = T::ratio(1, 1) / round.no;
        let radius = Vector::new(round.e1 * scale, round.e2 * scale, round.e3 * scale);
        Sphere::new(a.x + radius.e1, a.y + radius.e2, a.z + radius.e3, radius.norm_sq())
    }
    let inputs = inputs::triangles();
    Kernel::new("circle of three points", "dual(K ^ dual(K ^ ninf)), normalised, with K = A ^ B ^ C")
        .with(Way::generated(&inputs, circle, |s| numbers::<_, _, 4>(*s)))
        .with(Way::single(&inputs, |points| points.map(|p| p.map(single)), circle, |s| numbers::<_, _, 4>(*s)))
        .with(Way::dynamic(
            &inputs,
            |points| points.map(|point| point.to_dynamic()),
            |[a, b, c]: &[Multi<cga::Algebra>; 3]| formulas::circle_sphere_relative_dynamic(a, b, c),
            sphere_of,
        ))
        .with(Way::hand_written(
            &inputs,
            |points| points.map(position),
            circle_by_vectors,
            |(centre, radius_sq)| vec![centre.x, centre.y, centre.z, *radius_sq],
        ))
}

/// The centre `a + s u + t v` is as far from `a` as from b and c: `2 G (s, t) = (u², v²)` with the Gram matrix G of u, v.
fn circle_by_vectors([a, b, c]: &[Vector3<f64>; 3]) -> (Vector3<f64>, f64) {
    let (u, v) = (b - a, c - a);
    let (uu, uv, vv) = (u.norm_squared(), u.dot(&v), v.norm_squared());
    let scale = 0.5 / (uu * vv - uv * uv);
    let radius = u * (vv * (uu - uv) * scale) + v * (uu * (vv - uv) * scale);
    (a + radius, radius.norm_squared())
}

/// Whether two balls have a point in common.
#[must_use]
pub fn balls_overlap() -> Kernel {
    /// `S . T = (r² + s² - d²)/2`, and `d <= r + s` means `S . T >= -r s`.
    fn overlap<T: Real>([s, t]: &[Sphere<T>; 2]) -> bool {
        let product = *s | *t;
        (product >= T::zero()) | (product * product <= s.rho_sq * t.rho_sq)
    }
    let inputs = inputs::ball_pairs();
    let spheres: Vec<_> = inputs.iter().map(|balls| balls.map(|(c, r)| Sphere::new(c.x, c.y, c.z, r * r))).collect();
    Kernel::new("balls overlap", "S . T >= -r s")
        .with(Way::generated(&spheres, overlap, |hit| truth(*hit)))
        .with(Way::single(&spheres, |pair| pair.map(|s| s.map(single)), overlap, |hit| truth(*hit)))
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

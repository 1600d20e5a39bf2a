//! Where a line meets a plane: the line as six numbers, and as a point and a direction.

use super::numbers::{E, E1, E2, E3, EBAR, Multi, coefficients, numbers, position, single, vector};
use super::{Kernel, Way, inputs};
use crate::algebra::Scalar;
use crate::algebra::cga::{self, FinitePoint, Infinity, Line, Plane, Point};
use crate::algebra::dynamic::ToDynamic;
use crate::algebra::g3::Vector;
use crate::geometry::formulas;
use nalgebra::Vector3;

/// The point in which a line meets a plane; the line is six numbers, `A ^ B ^ ninf`.
#[must_use]
pub fn line_meets_plane() -> Kernel {
    fn meet<T: Scalar>((plane, line): &(Plane<T>, Line<T>)) -> FinitePoint<T> {
        formulas::line_blade_meets_plane(*line, *plane)
    }
    let inputs = inputs::planes_and_lines();
    let flats: Vec<_> = inputs.iter().map(|(plane, [p, q])| (*plane, (*p ^ *q) ^ Infinity)).collect();
    Kernel::new("line meets plane", "pi | L, normalised")
        .with(Way::generated(&flats, meet, |x| numbers::<_, _, 3>(*x)))
        .with(Way::single(&flats, |(a, b)| (a.map(single), b.map(single)), meet, |x| numbers::<_, _, 3>(*x)))
        .with(Way::dynamic(
            &flats,
            |(plane, line)| [plane.to_dynamic(), line.to_dynamic()],
            |[plane, line]: &[Multi<cga::Algebra>; 2]| plane | line,
            dynamic_position,
        ))
        .with(Way::hand_written(
            &inputs,
            |(plane, [p, q])| {
                let (p, q) = (position(*p), position(*q));
                (normal(plane), plane.ninf, q - p, p.cross(&q))
            },
            // Plücker coordinates: with the moment m = p×d, x (n . d) = n×m + delta d.
            |(n, delta, d, m)| (n.cross(m) + d * *delta) / n.dot(d),
            |x| x.as_slice().to_vec(),
        ))
}

/// The point in which a line, given by a point and a direction, meets a plane.
#[must_use]
pub fn ray_meets_plane() -> Kernel {
    fn meet<T: Scalar>((plane, p, d): &(Plane<T>, Point<T>, Vector<T>)) -> FinitePoint<T> {
        formulas::ray_meets_plane(*p, *d, *plane)
    }
    let inputs = inputs::planes_and_lines();
    let rays = inputs.iter().map(|(plane, [p, q])| (*plane, *p, Vector::new(q.x - p.x, q.y - p.y, q.z - p.z)));
    let rays: Vec<_> = rays.collect();
    Kernel::new("point and direction meet plane", "pi | (X ^ d ^ ninf), normalised")
        .with(Way::generated(&rays, meet, |x| numbers::<_, _, 3>(*x)))
        .with(Way::single(
            &rays,
            |(plane, p, d)| (plane.map(single), p.map(single), d.map(single)),
            meet,
            |x| numbers::<_, _, 3>(*x),
        ))
        .with(Way::dynamic(
            &rays,
            |(plane, p, d)| [plane.to_dynamic(), p.to_dynamic(), d.to_dynamic()],
            |[plane, p, d]: &[Multi<cga::Algebra>; 3]| {
                plane | &(&(p ^ d) ^ &ToDynamic::<_, f64>::to_dynamic(&Infinity))
            },
            dynamic_position,
        ))
        .with(Way::hand_written(
            &rays,
            |(plane, p, d)| (normal(plane), plane.ninf, position(*p), vector(*d)),
            // x = p + t d with n . x = delta
            |(n, delta, p, d)| p + d * ((delta - n.dot(p)) / n.dot(d)),
            |x| x.as_slice().to_vec(),
        ))
}

/// `X ^ ninf = x ^ ninf + no ^ ninf`: the point is the ratio of coefficients.
fn dynamic_position(flat: &Multi<cga::Algebra>) -> Vec<f64> {
    let weight = -flat.coefficient(E | EBAR);
    coefficients(flat, [E1 | E, E2 | E, E3 | E]).into_iter().map(|x| x / weight).collect()
}

fn normal(plane: &Plane) -> Vector3<f64> {
    Vector3::new(plane.e1, plane.e2, plane.e3)
}

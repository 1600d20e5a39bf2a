//! Rounds: how precision depends on the distance from the origin, and on thin triangles.

use crate::exact::{Big, big, distance, ratio};
use crate::{Random, Table};
use ga_physics::algebra::Real;
use ga_physics::algebra::cga::{Point, Round};
use ga_physics::geometry::formulas::{circle_sphere_relative, circumsphere, circumsphere_relative};
use num_traits::ToPrimitive;

type Triple = [Big; 3];

fn cross(a: &Triple, b: &Triple) -> Triple {
    [&a[1] * &b[2] - &a[2] * &b[1], &a[2] * &b[0] - &a[0] * &b[2], &a[0] * &b[1] - &a[1] * &b[0]]
}

fn dot(a: &Triple, b: &Triple) -> Big {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn combined(parts: [(&Big, &Triple); 3]) -> Triple {
    std::array::from_fn(|i| parts.iter().map(|(factor, v)| *factor * &v[i]).sum())
}

fn exactly<T: Real>(p: Point<T>) -> Triple {
    <[T; 3]>::from(p).map(|x| big(x.to_f64()))
}

fn difference(a: &Triple, b: &Triple) -> Triple {
    std::array::from_fn(|i| &a[i] - &b[i])
}

/// The centre of the sphere through 0, u, v, w.
fn sphere_centre(u: &Triple, v: &Triple, w: &Triple) -> Triple {
    let twice = dot(u, &cross(v, w)) * ratio(2, 1);
    let squares = [u, v, w].map(|x| dot(x, x) / &twice);
    combined([(&squares[0], &cross(v, w)), (&squares[1], &cross(w, u)), (&squares[2], &cross(u, v))])
}

/// The centre of the circle through 0, u, v.
fn circle_centre(u: &Triple, v: &Triple) -> Triple {
    let n = cross(u, v);
    let twice = dot(&n, &n) * ratio(2, 1);
    let (a, b) = (dot(u, u) / &twice, -(dot(v, v) / &twice));
    combined([(&a, &cross(v, &n)), (&b, &cross(u, &n)), (&ratio(0, 1), u)])
}

/// The error of a centre and a squared radius, as parts of the radius and its square.
fn error<T: Real>(centre: [T; 3], rho_sq: T, exact: &Triple, place: &Triple) -> f64 {
    let square = dot(exact, exact);
    let radius = square.to_f64().unwrap().sqrt();
    let mut worst = 0.0_f64;
    for (x, (e, p)) in centre.iter().zip(exact.iter().zip(place)) {
        if !x.to_f64().is_finite() {
            return f64::INFINITY;
        }
        worst = worst.max(distance(x.to_f64(), &(e + p)) / radius);
    }
    let rho_sq = rho_sq.to_f64();
    if rho_sq.is_finite() { worst.max(distance(rho_sq, &square) / square.to_f64().unwrap()) } else { f64::INFINITY }
}

fn relative<T: Real>(round: Round<T>) -> ([T; 3], T) {
    let weight = round.no;
    let c = [round.e1 / weight, round.e2 / weight, round.e3 / weight];
    let two = T::ratio(2, 1);
    (c, c[0] * c[0] + c[1] * c[1] + c[2] * c[2] - two * round.ninf / weight)
}

const ZERO: [i64; 3] = [0; 3];
const SAMPLES: usize = 40;

/// Worst errors of the sphere through four points, `away` sizes from the origin: relative to the first point, in the
/// world by way of its frame, in the world product by product.
fn spheres<T: Real>(away: f64) -> [f64; 3] {
    let (mut random, mut worst) = (Random(7), [0.0_f64; 3]);
    let corners = [[0.9, 0.1, -0.2], [-0.6, 0.8, 0.1], [0.1, -0.7, 0.7], [-0.3, -0.2, -0.9]];
    for _ in 0..SAMPLES {
        let middle = random.vector().map(|x| x + 1.5 * x.signum());
        let length = middle.iter().map(|x| x * x).sum::<f64>().sqrt();
        let middle = middle.map(|x| x * away / length);
        let points: [Point<T>; 4] = corners.map(|corner| {
            let jitter = random.vector();
            Point::from(std::array::from_fn::<T, 3, _>(|i| T::from_f64(middle[i] + corner[i] + 0.1 * jitter[i])))
        });
        let [a, b, c, d] = points;
        let place = exactly(a);
        let [u, v, w] = [b, c, d].map(|p| difference(&exactly(p), &place));
        let exact = sphere_centre(&u, &v, &w);
        let (centre, rho_sq) = relative(circumsphere_relative(a, b, c, d));
        let world = circumsphere(a, b, c, d);
        let (stepwise, stepwise_rho_sq) = relative((a ^ b ^ c ^ d).dual());
        let forms = [
            error(centre, rho_sq, &exact, &ZERO.map(|n| ratio(n, 1))),
            error([world.x, world.y, world.z], world.rho_sq, &exact, &place),
            error(stepwise, stepwise_rho_sq, &exact, &place),
        ];
        worst.iter_mut().zip(forms).for_each(|(worst, form)| *worst = worst.max(form));
    }
    worst
}

#[test]
fn spheres_far_from_the_origin() {
    let mut table = Table::default();
    // In the world a centre cannot be better than its coordinates: half an epsilon of the distance.
    let rounded = |away: f64| 1e-14 + f64::EPSILON * away;
    for (away, floor) in [(1.0, None), (10.0, Some(3e-14)), (1e3, Some(3e-8)), (1e5, Some(3e-2))] {
        let [relative, world, stepwise] = spheres::<f64>(away);
        table.good(format!("sphere, {away:.0e} sizes away, relative to its first point"), relative, 1e-14);
        table.good(format!("sphere, {away:.0e} sizes away, moved back to the world"), world, rounded(away));
        let what = format!("sphere, {away:.0e} sizes away, product by product in the world");
        floor.into_iter().for_each(|floor| table.bad(&what, stepwise, floor));
    }
    for (away, floor) in [(1.0, None), (10.0, Some(1e-5)), (1e3, Some(1.0)), (1e5, Some(1.0))] {
        let [relative, _, stepwise] = spheres::<f32>(away);
        table.good(format!("f32: sphere, {away:.0e} sizes away, relative to its first point"), relative, 4e-6);
        let what = format!("f32: sphere, {away:.0e} sizes away, product by product");
        floor.into_iter().for_each(|floor| table.bad(&what, stepwise, floor));
    }
    table.check();
}

/// The circle through 0, u, v by `|u x v|² = AB - d²`: fewer operations, and half of the digits.
fn gram(u: [f64; 3], v: [f64; 3]) -> ([f64; 3], f64) {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (a, b, d) = (dot(u, u), dot(v, v), dot(u, v));
    let half = 0.5 / (a * b - d * d);
    let (e, f) = ((a - d) * half, (b - d) * half);
    let (alpha, beta) = (b * e, a * f);
    let centre = std::array::from_fn(|i| alpha * u[i] + beta * v[i]);
    (centre, a * b * (e + f) / 2.0)
}

/// Worst errors of the circle through three points with heights of about `thin` times the base: relative to the first
/// point, by the Gram determinant.
fn circles(thin: f64) -> [f64; 2] {
    let (mut random, mut worst) = (Random(9), [0.0_f64; 2]);
    for _ in 0..SAMPLES {
        let (a, along, across) = (random.vector(), random.vector(), random.vector());
        let part = 0.4 + 0.2 * random.signed();
        let b: [f64; 3] = std::array::from_fn(|i| a[i] + along[i]);
        let c: [f64; 3] = std::array::from_fn(|i| a[i] + part * along[i] + thin * across[i]);
        let place = a.map(big);
        let [u, v] = [b, c].map(|p| difference(&p.map(big), &place));
        let exact = circle_centre(&u, &v);
        let (centre, rho_sq) = relative(circle_sphere_relative(Point::from(a), Point::from(b), Point::from(c)));
        let (edge, other) = (std::array::from_fn(|i| b[i] - a[i]), std::array::from_fn(|i| c[i] - a[i]));
        let (gram_centre, gram_rho_sq) = gram(edge, other);
        let zero = ZERO.map(|n| ratio(n, 1));
        let forms = [error(centre, rho_sq, &exact, &zero), error(gram_centre, gram_rho_sq, &exact, &zero)];
        worst.iter_mut().zip(forms).for_each(|(worst, form)| *worst = worst.max(form));
    }
    worst
}

#[test]
fn circles_through_thin_triangles() {
    let mut table = Table::default();
    // eps / sin for the one, eps / sin² for the other.
    let lines = [(1.0, 8e-15, None), (1e-3, 1e-12, Some(1e-11)), (1e-5, 1e-10, Some(1e-7)), (1e-7, 6e-9, Some(1e-3))];
    for (thin, ceiling, floor) in lines {
        let [relative, gram] = circles(thin);
        table.good(format!("circle, thinness {thin:.0e}, relative to its first point"), relative, ceiling);
        match floor {
            Some(floor) => table.bad(format!("circle, thinness {thin:.0e}, by the Gram determinant"), gram, floor),
            None => table.good(format!("circle, thinness {thin:.0e}, by the Gram determinant"), gram, 1e-13),
        }
    }
    table.check();
}

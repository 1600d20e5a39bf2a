//! Facets: the reciprocal frame, and crossings against the test of Moeller and Trumbore and exact signs.

use super::{Exact, Random, add, components, cross, dot, length, point, position, scale, sub, tetrahedron};
use ga_physics::algebra::cga::Point;
use ga_physics::geometry::Facet;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

fn facet(corners: [[f64; 3]; 3]) -> Facet {
    Facet::new(corners.map(point)).unwrap()
}

#[test]
fn barycentric_coordinates_are_one_at_their_corner_and_sum_to_one() {
    let mut random = Random(31);
    for distance in super::DISTANCES {
        for _ in 0..50 {
            let [a, b, c, _]: [Point<f64>; 4] = tetrahedron(&mut random, 1.0, distance);
            let facet = Facet::new([a, b, c]).unwrap();
            for (i, corner) in facet.corners.iter().enumerate() {
                let found = facet.barycentric(*corner);
                for (j, coordinate) in found.iter().enumerate() {
                    let delta = if i == j { 1.0 } else { 0.0 };
                    assert!((coordinate - delta).abs() < 1e-14, "{found:?} at corner {i}, {distance} away");
                }
                assert_eq!(found[i], 1.0, "exact at its own corner");
            }
            // Any point of space: the sum is linear, and 1 at all corners.
            let x = add(position(a), random.vector());
            let sum: f64 = facet.barycentric(point(x)).iter().sum();
            assert!((sum - 1.0).abs() < 1e-14);
            assert!(
                facet
                    .barycentric(point(scale(add(position(a), add(position(b), position(c))), 1.0 / 3.0)))
                    .iter()
                    .all(|third| (third - 1.0 / 3.0).abs() < 1e-14 + 1e-15 * distance)
            );
        }
    }
}

#[test]
fn barycentric_coordinates_are_ratios_of_areas() {
    let mut random = Random(32);
    for _ in 0..100 {
        let corners = [random.vector(), random.vector(), random.vector()];
        let [a, b, c] = corners;
        let normal = cross(sub(b, a), sub(c, a));
        if length(normal) < 0.1 {
            continue;
        }
        let (s, t) = (random.signed(), random.signed());
        let x = add(a, add(scale(sub(b, a), s), scale(sub(c, a), t)));
        let area = |p: [f64; 3], q: [f64; 3]| dot(cross(sub(p, x), sub(q, x)), normal) / dot(normal, normal);
        let found = facet(corners).barycentric(point(x));
        let expected = [area(b, c), area(c, a), area(a, b)];
        for (found, (area, weight)) in found.iter().zip(expected.iter().zip([1.0 - s - t, s, t])) {
            assert!((found - area).abs() < 1e-12 && (found - weight).abs() < 1e-12);
        }
    }
}

/// Moeller and Trumbore (1997): fraction along the segment and the three barycentric coordinates, if it crosses.
fn moeller_trumbore([a, b, c]: [[f64; 3]; 3], start: [f64; 3], end: [f64; 3]) -> Option<(f64, [f64; 3])> {
    let (u, v, ray) = (sub(b, a), sub(c, a), sub(end, start));
    let p = cross(ray, v);
    let determinant = dot(u, p);
    if determinant == 0.0 {
        return None;
    }
    let from = sub(start, a);
    let beta = dot(from, p) / determinant;
    let q = cross(from, u);
    let gamma = dot(ray, q) / determinant;
    let fraction = dot(v, q) / determinant;
    let inside = beta >= 0.0 && gamma >= 0.0 && beta + gamma <= 1.0 && fraction > 0.0 && fraction < 1.0;
    inside.then_some((fraction, [1.0 - beta - gamma, beta, gamma]))
}

/// Six times the volume of a tetrahedron, exactly.
fn orient([a, b, c]: [&Exact; 3], d: &Exact) -> BigRational {
    let [u, v, w] = [b, c, d].map(|p| p.minus(a));
    u.dot(&v.cross(&w))
}

/// Whether the segment crosses the inside of the triangle, exactly; and how near the nearest decision was to zero,
/// relative to the size of its terms.
fn exact_crossing(corners: [[f64; 3]; 3], start: [f64; 3], end: [f64; 3]) -> (bool, f64) {
    let at = |p: [f64; 3]| Exact::at::<f64>(point(p));
    let [a, b, c] = corners.map(at);
    let (s, e) = (at(start), at(end));
    let (above, below) = (orient([&a, &b, &c], &s), orient([&a, &b, &c], &e));
    let edges = [orient([&s, &e, &a], &b), orient([&s, &e, &b], &c), orient([&s, &e, &c], &a)];
    let crosses = above.is_positive() != below.is_positive()
        && (edges.iter().all(|edge| !edge.is_negative()) || edges.iter().all(|edge| !edge.is_positive()));
    let nearest = edges.iter().chain([&above, &below]).map(|x| x.to_f64().unwrap().abs()).fold(f64::INFINITY, f64::min);
    (crosses && !above.is_zero() && !below.is_zero(), nearest)
}

#[test]
fn crossings_agree_with_moeller_and_trumbore() {
    let mut random = Random(33);
    let (mut crossed, mut disagreed) = (0, 0);
    for round in 0..10_000 {
        let corners = [random.vector(), random.vector(), random.vector()];
        let start = random.vector();
        // Every twentieth segment aims at an edge or a corner, give or take a few units in the last place.
        let aim = match round % 20 {
            0 => {
                let t = (0.5 + 0.5 * random.signed()).round() * random.signed().abs();
                let edge = add(scale(corners[0], 1.0 - t), scale(corners[1], t));
                sub(scale(edge, 2.0), start)
            }
            _ => random.vector(),
        };
        let facet = facet(corners);
        let found = facet.crossing(point(start), point(aim));
        let expected = moeller_trumbore(corners, start, aim);
        crossed += usize::from(found.is_some());
        match (found, expected) {
            (Some(found), Some((fraction, barycentric))) => {
                // The sine of the angle at which the segment meets the plane amplifies the rounding of its heights.
                let ray = sub(aim, start);
                let sine = dot(components(facet.plane.normal()), ray).abs() / length(ray);
                let area = length(cross(sub(corners[1], corners[0]), sub(corners[2], corners[0])));
                let close = 1e-14 / (sine * area * area).min(1.0);
                assert!((found.fraction - fraction).abs() < close, "{} {fraction}", found.fraction);
                let at = add(start, scale(ray, fraction));
                assert!(length(sub(position(found.point), at)) < 4.0 * close);
                assert!(found.barycentric.iter().zip(barycentric).all(|(f, e)| (f - e).abs() < 8.0 * close));
            }
            (None, None) => {}
            (found, expected) => {
                let (_, nearest) = exact_crossing(corners, start, aim);
                // Coordinates of up to 4, products of three of them, a dozen roundings.
                assert!(nearest < 64.0 * 12.0 * f64::EPSILON, "{found:?} {expected:?} {nearest:.1e}");
                disagreed += 1;
            }
        }
        if round % 50 == 1 {
            let (crosses, nearest) = exact_crossing(corners, start, aim);
            assert!(crosses == found.is_some() || nearest < 64.0 * 12.0 * f64::EPSILON, "{nearest:.1e}");
        }
    }
    println!("{crossed} of 10000 cross, {disagreed} differ from Moeller-Trumbore within rounding");
    assert!(crossed > 500, "the segments test something: {crossed}");
}

#[test]
fn segments_in_the_plane_on_it_or_beside_it_do_not_cross() {
    let triangle = facet([[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [0.0, 4.0, 1.0]]);
    let crosses = |start: [f64; 3], end: [f64; 3]| triangle.crossing(point(start), point(end)).is_some();
    assert!(crosses([1.0, 1.0, 0.0], [1.0, 1.0, 2.0]) && crosses([1.0, 1.0, 2.0], [1.0, 1.0, 0.0]), "from either side");
    assert!(!crosses([-1.0, 1.0, 1.0], [3.0, 1.0, 1.0]), "in the plane, through the triangle");
    assert!(!crosses([1.0, 1.0, 0.0], [1.0, 1.0, 1.0]), "ends on it");
    assert!(!crosses([1.0, 1.0, 1.0], [1.0, 1.0, 2.0]), "starts on it");
    assert!(!crosses([1.0, 1.0, 2.0], [2.0, 1.0, 2.0]), "parallel");
    assert!(!crosses([1.0, 1.0, 0.0], [1.0, 1.0, 0.5]), "too short");
    assert!(!crosses([1.0, 1.0, 0.5], [1.0, 1.0, 0.5]), "a point");
    assert!(!crosses([3.0, 3.0, 0.0], [3.0, 3.0, 2.0]), "beside it");
    assert!(crosses([2.0, 0.0, 0.0], [2.0, 0.0, 2.0]), "edges belong to it");
    assert!(crosses([0.0, 0.0, 0.0], [0.0, 0.0, 2.0]), "corners belong to it");
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(!crosses([bad, 1.0, 0.0], [1.0, 1.0, 2.0]) && !crosses([1.0, 1.0, 0.0], [1.0, 1.0, bad]));
    }
    let crossing = triangle.crossing(point([1.0, 2.0, 0.0]), point([1.0, 2.0, 4.0])).unwrap();
    assert_eq!((crossing.fraction, position(crossing.point)), (0.25, [1.0, 2.0, 1.0]));
    assert_eq!(crossing.barycentric, [0.25, 0.25, 0.5]);
}

#[test]
fn crossings_are_found_at_all_sizes() {
    for exponent in [-300, -180, -100, 0, 100, 150] {
        let size = 10f64.powi(exponent);
        let sized = |p: [f64; 3]| scale(p, size);
        let triangle = facet([[0.0, 0.0, 1.0], [4.0, 0.0, 1.0], [0.0, 4.0, 1.0]].map(sized));
        let found = triangle.crossing(point(sized([1.0, 2.0, 0.0])), point(sized([1.0, 2.0, 4.0])));
        let found = found.unwrap_or_else(|| panic!("not seen at 1e{exponent}"));
        assert!((found.fraction - 0.25).abs() < 1e-15);
        assert!(found.barycentric.iter().zip([0.25, 0.25, 0.5]).all(|(f, e)| (f - e).abs() < 1e-15));
        assert!(length(sub(scale(position(found.point), 1.0 / size), [1.0, 2.0, 1.0])) < 1e-14);
    }
}

//! Spheres, circles and planes through points against exact rational solutions, near the origin and far from it.

use super::{
    DISTANCES, Exact, Random, Tested, components, cross, dot, exact, length, point, position, scale, sub, tetrahedron,
    world_rounding,
};
use ga_physics::algebra::Real;
use ga_physics::algebra::cga::{Infinity, Point, Round, Sphere};
use ga_physics::geometry::{
    circle_parts, circle_through, closest_point_on_line, line_through, plane_through, sphere_through,
    sphere_through_pair,
};
use num_rational::BigRational;
use num_traits::ToPrimitive;

const SAMPLES: usize = 20;

/// From the first point to the centre, exactly: `(u² v x w + v² w x u + w² u x v) / 2 u . (v x w)`.
fn exact_sphere<T: Real>([a, b, c, d]: [Point<T>; 4]) -> Exact {
    let a = Exact::at(a);
    let [u, v, w] = [b, c, d].map(|p| Exact::at(p).minus(&a));
    let sum = v.cross(&w).times(&u.dot(&u)).plus(&w.cross(&u).times(&v.dot(&v))).plus(&u.cross(&v).times(&w.dot(&w)));
    sum.times(&(exact(0.5) / u.dot(&v.cross(&w))))
}

/// From the first point to the centre, exactly: `(u² v - v² u) x (u x v)` over `-2 |u x v|²`.
fn exact_circle<T: Real>([a, b, c]: [Point<T>; 3]) -> (Exact, Exact) {
    let a = Exact::at(a);
    let [u, v] = [b, c].map(|p| Exact::at(p).minus(&a));
    let normal = u.cross(&v);
    let across = v.times(&u.dot(&u)).minus(&u.times(&v.dot(&v)));
    (across.cross(&normal).times(&(exact(0.5) / normal.dot(&normal))), normal)
}

/// Errors of centre and radius, relative to the size. The rounding of the world centre is taken off the centre's.
fn errors<T: Tested>(on: Point<T>, centre: Point<T>, radius: f64, expected: &Exact, size: f64) -> (f64, f64) {
    let off = Exact::at(centre).minus(&Exact::at(on)).minus(expected).length();
    let far = length(position(centre));
    ((off - world_rounding::<T>(far)).max(0.0) / size, (radius - expected.length()).abs() / size)
}

fn good_and_bad_spheres<T: Tested>() {
    for distance in DISTANCES {
        let mut random = Random(11);
        let (mut worst, mut worst_bad) = (0.0_f64, 0.0_f64);
        for _ in 0..SAMPLES {
            let size = 2f64.powf(6.0 * random.signed());
            let corners: [Point<T>; 4] = tetrahedron(&mut random, size, distance);
            let [a, b, c, d] = corners;
            let expected = exact_sphere(corners);
            let sphere = sphere_through(a, b, c, d).unwrap();
            let radius = sphere.radius().unwrap().to_f64();
            let (centre_off, radius_off) = errors(a, sphere.centre(), radius, &expected, size);
            worst = worst.max(centre_off).max(radius_off);
            let turned = sphere_through(b, a, c, d).unwrap();
            let (x, y) = (position(turned.centre()), position(sphere.centre()));
            let apart = 2.0 * T::BOUND * size + 2.0 * world_rounding::<T>(length(x));
            assert!(length(sub(x, y)) < apart, "the order of the points does not matter");
            worst_bad = worst_bad.max(bad_sphere(corners, &expected, size));
        }
        assert!(worst <= T::BOUND, "{distance} sizes away: {worst:.1e}");
        // The blade in world coordinates loses as many digits again as the distance has, three times over.
        if distance >= 1e3 {
            assert!(worst_bad > 100.0 * T::BOUND, "the bad method passes at {distance}: {worst_bad:.1e}");
        }
        println!("sphere {:>5e}: {worst:.1e}, blade in the world {worst_bad:.1e}", distance);
    }
}

/// The error of the radius by the blade in world coordinates.
fn bad_sphere<T: Tested>([a, b, c, d]: [Point<T>; 4], expected: &Exact, size: f64) -> f64 {
    let round: Round<T> = (a ^ b ^ c ^ d).dual();
    let [e1, e2, e3, no, ninf] = <[T; 5]>::from(round).map(Real::to_f64);
    let squared = (e1 * e1 + e2 * e2 + e3 * e3 - 2.0 * no * ninf) / (no * no);
    let radius = squared.max(0.0).sqrt();
    let error = (radius - expected.length()).abs() / size;
    if error.is_finite() { error } else { f64::INFINITY }
}

#[test]
fn spheres_through_four_points_are_exact_to_rounding_in_f64() {
    good_and_bad_spheres::<f64>();
}

#[test]
fn spheres_through_four_points_are_exact_to_rounding_in_f32() {
    good_and_bad_spheres::<f32>();
}

fn circles_and_planes<T: Tested>() {
    for distance in DISTANCES {
        let mut random = Random(12);
        let (mut worst, mut worst_normal) = (0.0_f64, 0.0_f64);
        for _ in 0..SAMPLES {
            let size = 2f64.powf(6.0 * random.signed());
            let [a, b, c, _]: [Point<T>; 4] = tetrahedron(&mut random, size, distance);
            let (expected, normal) = exact_circle([a, b, c]);
            let circle = circle_through(a, b, c).unwrap();
            let (centre_off, radius_off) = errors(a, circle.centre, circle.radius.to_f64(), &expected, size);
            worst = worst.max(centre_off).max(radius_off);
            let normal = scale(normal.rounded(), 1.0 / normal.length());
            let plane = plane_through(a, b, c).unwrap();
            for found in [circle.normal, plane.normal()] {
                worst_normal = worst_normal.max(length(sub(components(found), normal)));
            }
            let pair = sphere_through_pair(a, b).unwrap();
            let half = Exact::at(b).minus(&Exact::at(a)).times(&exact(0.5));
            let (centre_off, radius_off) = errors(a, pair.centre(), pair.radius().unwrap().to_f64(), &half, size);
            worst = worst.max(centre_off).max(radius_off);
            // The plane's one world number, delta: rounded once for each term of nu . a.
            let delta = Exact(components(plane.normal()).map(exact)).dot(&Exact::at(a)) - exact(plane.ninf.to_f64());
            let bound = 3.0 * T::EPSILON.to_f64() * length(position(a));
            assert!(delta.to_f64().unwrap().abs() <= bound, "{delta} at {distance}");
        }
        println!("circle {distance:>5e}: {worst:.1e}, normal {worst_normal:.1e}");
        assert!(worst <= T::BOUND && worst_normal <= T::BOUND, "{distance}: {worst:.1e} {worst_normal:.1e}");
    }
}

#[test]
fn circles_planes_and_pairs_are_exact_to_rounding_in_f64() {
    circles_and_planes::<f64>();
}

#[test]
fn circles_planes_and_pairs_are_exact_to_rounding_in_f32() {
    circles_and_planes::<f32>();
}

/// Distance of a point from the line through two others, by the line's own numbers.
fn lines<T: Tested>() {
    for distance in DISTANCES {
        let mut random = Random(13);
        let mut worst = 0.0_f64;
        for _ in 0..SAMPLES {
            let [a, b, c, _]: [Point<T>; 4] = tetrahedron(&mut random, 1.0, distance);
            let (ea, u) = (Exact::at(a), Exact::at(b).minus(&Exact::at(a)));
            let along: BigRational = Exact::at(c).minus(&ea).dot(&u) / u.dot(&u);
            let foot = ea.plus(&u.times(&along));
            let found = closest_point_on_line(c, line_through(a, b).unwrap()).unwrap();
            worst = worst.max(Exact::at(found).minus(&foot).length());
        }
        // The moment a ^ u is rounded at the size of |a| |u|: 6 products and 3 differences of u, then the kernel's own.
        let bound = T::BOUND + 8.0 * T::EPSILON.to_f64() * distance;
        println!("line {distance:>5e}: {worst:.1e} of {bound:.1e}");
        assert!(worst <= bound, "{distance}: {worst:.1e}, bound {bound:.1e}");
    }
}

#[test]
fn lines_far_from_the_origin_lose_only_what_their_moment_rounds() {
    lines::<f64>();
    lines::<f32>();
}

#[test]
fn circle_parts_of_a_blade_agree_with_circle_through_near_the_origin() {
    let mut random = Random(14);
    for _ in 0..200 {
        let [a, b, c, _]: [Point<f64>; 4] = tetrahedron(&mut random, 1.0, 1.0);
        let parts = circle_parts(a ^ b ^ c).unwrap();
        let circle = circle_through(a, b, c).unwrap();
        // The blade's coefficients are of fourth degree in coordinates of up to 2: 16 times the rounding of order 1.
        let close = 16.0 * 1e-14;
        assert!(length(sub(position(parts.centre), position(circle.centre))) < close);
        assert!((parts.radius - circle.radius).abs() < close);
        assert!(length(sub(components(parts.normal), components(circle.normal))) < close, "the same sense");
    }
}

#[test]
fn the_reports_check_of_orientation_has_no_scalar_part_and_the_dual_has() {
    let mut random = Random(15);
    for _ in 0..100 {
        let [a, b, c, d] = [(); 4].map(|()| point::<f64>(random.vector()));
        let shell = a ^ b ^ c ^ d;
        // As printed in Fig. 14: the inner product with the 4-blade. Its type is of grade 3 alone.
        let check: ga_physics::algebra::cga::Circle = Infinity | shell;
        let whole = ga_physics::algebra::cga::Multivector::from(check);
        assert_eq!(whole.s, 0.0, "never positive: the normals would never be flipped");
        assert!(check.norm_sq().abs() > 0.0, "while the trivector is there");
        // Corrected: with the dual vector. Both signs occur, and dividing by the weight puts the inside right.
        let round: Round = shell.dual();
        let weight = -(Infinity | round);
        assert_eq!(weight, round.no);
        let six_volumes =
            dot(sub(position(b), position(a)), cross(sub(position(c), position(a)), sub(position(d), position(a))));
        assert_eq!(weight > 0.0, six_volumes > 0.0, "the sign is that of the order of the points");
        let sphere: Sphere = sphere_through(a, b, c, d).unwrap();
        assert!((sphere.centre() | sphere) > 0.0);
        assert!(((sphere.centre() | round) / weight) > 0.0);
    }
}

//! Meets and reflections against plain vector formulas.

use super::{
    DISTANCES, Exact, Random, Tested, add, components, dot, exact, length, point, position, scale, sub, tetrahedron,
    vector, world_rounding,
};
use ga_physics::algebra::cga::{Plane, Point, Sphere};
use ga_physics::geometry::{
    Degenerate, SpheresMeet, closest_point_on_line, invert_in_sphere, line_meets_plane, line_through, plane_through,
    planes_meet, reflect_in_line, reflect_in_plane, spheres_meet,
};
use nalgebra::{Matrix3, Vector3};
use num_rational::BigRational;

const SAMPLES: usize = 20;

fn lines_meet_planes<T: Tested>() {
    for distance in DISTANCES {
        let mut random = Random(21);
        for _ in 0..SAMPLES {
            let [a, b, c, d]: [Point<T>; 4] = tetrahedron(&mut random, 1.0, distance);
            let plane = plane_through(a, b, c).unwrap();
            let towards: Point<T> = point(scale(add(position(b), position(c)), 0.5));
            let found = line_meets_plane(d, towards, plane).unwrap();
            // The plane's four numbers as exact: d + u (delta - nu . d) / (nu . u).
            let nu = Exact(components(plane.normal()).map(exact));
            let u = Exact::at(towards).minus(&Exact::at(d));
            let factor: BigRational = (exact(plane.ninf.to_f64()) - nu.dot(&Exact::at(d))) / nu.dot(&u);
            let expected = Exact::at(d).plus(&u.times(&factor));
            let error = Exact::at(found).minus(&expected).length();
            // The height over the plane is a difference at the size of the distance; the line meets the plane at more
            // than 30 degrees.
            let bound = T::BOUND + 8.0 * T::EPSILON.to_f64() * distance;
            assert!(error <= bound, "{distance}: {error:.1e} of {bound:.1e}");
        }
    }
}

#[test]
fn lines_meet_planes_where_the_vector_formula_says() {
    lines_meet_planes::<f64>();
    lines_meet_planes::<f32>();
}

#[test]
fn planes_meet_in_the_line_that_a_linear_solve_finds() {
    let mut random = Random(22);
    for _ in 0..SAMPLES {
        let (first, second) = (random.direction(), random.direction());
        let along = super::cross(first, second);
        if length(along) < 0.1 {
            continue;
        }
        let (h1, h2) = (random.signed(), random.signed());
        let plane = |n: [f64; 3], h: f64| Plane::new(n[0], n[1], n[2], h);
        let line = planes_meet(plane(first, h1), plane(second, h2)).unwrap();
        let matrix = Matrix3::from_rows(&[first, second, along].map(|row| Vector3::from(row).transpose()));
        let foot = matrix.lu().solve(&Vector3::new(h1, h2, 0.0)).unwrap();
        let found = closest_point_on_line(Point::origin(), line).unwrap();
        assert!(length(sub(position(found), foot.into())) < 1e-12);
        let direction = [-line.e1_no_ninf, -line.e2_no_ninf, -line.e3_no_ninf];
        assert!(length(sub(direction, along)) < 1e-14);
    }
}

#[test]
fn three_planes_meet_where_a_linear_solve_says() {
    let mut random = Random(23);
    for _ in 0..SAMPLES {
        let rows = [random.direction(), random.direction(), random.direction()];
        let matrix = Matrix3::from_rows(&rows.map(|row| Vector3::from(row).transpose()));
        if matrix.determinant().abs() < 0.1 {
            continue;
        }
        let heights = random.vector();
        let [p, q, r] = [0, 1, 2].map(|i| Plane::new(rows[i][0], rows[i][1], rows[i][2], heights[i]));
        let flat = r | planes_meet(p, q).unwrap();
        let expected = matrix.lu().solve(&Vector3::from(heights)).unwrap();
        assert!(length(sub(position(flat.point().unwrap()), expected.into())) < 1e-12);
    }
}

fn circle(first: Sphere<f64>, second: Sphere<f64>) -> (Point<f64>, f64, [f64; 3]) {
    match spheres_meet(first, second).unwrap() {
        SpheresMeet::Circle(parts) => (parts.centre, parts.radius, components(parts.normal)),
        other => panic!("{other:?}"),
    }
}

#[test]
fn spheres_meet_in_the_circle_of_the_radical_plane() {
    for distance in DISTANCES {
        let mut random = Random(24);
        for _ in 0..SAMPLES {
            let at = scale(random.direction(), distance);
            let axis = random.direction();
            let (r1, r2, d) = (2.0, 1.5 + 0.2 * random.signed(), 2.0 + random.signed());
            let first = Sphere::around(point(at), r1);
            let second = Sphere::around(point(add(at, scale(axis, d))), r2);
            let (centre, radius, normal) = circle(first, second);
            // The centres as rounded.
            let apart = sub(position(second.centre()), position(first.centre()));
            let d = length(apart);
            let h = (d * d + r1 * r1 - r2 * r2) / (2.0 * d);
            let expected = (r1 * r1 - h * h).sqrt();
            assert!((radius - expected).abs() < 1e-13, "{radius} {expected}");
            let local = sub(position(centre), position(first.centre()));
            assert!(length(sub(local, scale(apart, h / d))) < 1e-13 + 2.0 * world_rounding::<f64>(distance + 4.0));
            assert!(length(sub(normal, scale(apart, 1.0 / d))) < 1e-14, "from the first to the second");
        }
    }
}

#[test]
fn spheres_of_very_different_size_meet_without_losing_digits() {
    // Pythagorean triples: centres 1e6 apart at a right angle where the spheres cross, r1² + r2² = d².
    for (r1, r2, d) in [(999_999.5, 1000.0, 1_000_000.0_f64), (1e6 - 0.5, 999.999_875, 1e6), (40.0, 9.0, 41.0)] {
        let first = Sphere::around(Point::origin(), r1);
        let second = Sphere::around(Point::new(d, 0.0, 0.0), r2);
        let [r1, r2, d] = [first.rho_sq, second.rho_sq, d * d].map(exact);
        // 4 d² radius² = 4 d² r1² - (d² + r1² - r2²)², exactly.
        let sum = &d + &r1 - &r2;
        let squared = (exact(4.0) * &d * &r1 - &sum * &sum) / (exact(4.0) * &d);
        let expected = num_traits::ToPrimitive::to_f64(&squared).unwrap().sqrt();
        let (_, radius, _) = circle(first, second);
        // r1 and d are each rounded once more: 1e6 eps, seen at the angle at which the spheres cross.
        assert!((radius - expected).abs() < 1e-9 * expected.min(1.0), "{radius} against {expected}");
        let (_, swapped, _) = circle(second, first);
        assert_eq!(radius, swapped);
    }
    // A small ball half in a wide one: the circle is almost the small one's equator.
    let wide = Sphere::around(Point::origin(), 1e6);
    let (_, radius, _) = circle(wide, Sphere::around(Point::new(1e6, 0.0, 0.0), 1.0));
    let expected = (1.0 - 0.25e-12_f64).sqrt();
    assert!((radius - expected).abs() < 1e-12, "{radius} against {expected}");
    let (_, radius, _) = circle(wide, Sphere::around(Point::new(1e6 + 0.75, 0.0, 0.0), 1.0));
    // h over the plane through the small centre: 0.75 less the sagitta.
    let h: f64 = 0.75 + (1.0 - 0.75 * 0.75) / (2.0 * (1e6 + 0.75));
    assert!((radius - (1.0 - h * h).sqrt()).abs() < 1e-9, "{radius}");
}

#[test]
fn reflections_are_the_vector_formulas() {
    let mut random = Random(25);
    for _ in 0..200 {
        let (x, a, n) = (random.vector(), random.vector(), random.direction());
        let plane = Plane::with_normal_through(vector(n), point(a));
        let expected = sub(x, scale(n, 2.0 * dot(n, sub(x, a))));
        assert!(length(sub(position(reflect_in_plane(point::<f64>(x), plane)), expected)) < 1e-14);
        let line = line_through(point::<f64>(a), point(add(a, scale(n, 3.0)))).unwrap();
        let foot = add(a, scale(n, dot(n, sub(x, a))));
        let turned = position(reflect_in_line(point(x), line).unwrap());
        assert!(length(sub(turned, sub(scale(foot, 2.0), x))) < 1e-14);
        assert!(length(sub(position(closest_point_on_line(point(x), line).unwrap()), foot)) < 1e-14);
        let sphere = Sphere::around(point(a), 0.5);
        let arm = sub(x, a);
        let expected = add(a, scale(arm, 0.25 / dot(arm, arm)));
        let image = position(invert_in_sphere(point::<f64>(x), sphere).unwrap());
        assert!(length(sub(image, expected)) < 1e-14 * (1.0 + length(expected)));
    }
}

#[test]
fn inversion_keeps_its_digits_far_out_and_near_the_centre() {
    let unit = Sphere::around(Point::<f64>::origin(), 1.0);
    let mut random = Random(26);
    for decade in (-150..=150).step_by(10) {
        let x = scale(random.direction(), 10f64.powi(decade));
        let d = length(scale(x, 10f64.powi(-decade)));
        let image = position(invert_in_sphere(point(x), unit).unwrap());
        let expected = scale(x, 10f64.powi(-2 * decade) / (d * d));
        assert!(length(scale(sub(image, expected), 10f64.powi(decade))) < 1e-14, "1e{decade}");
    }
    let far = Sphere::around(Point::new(1e5_f32, 2e5, 0.0), 2.0);
    let image = invert_in_sphere(Point::new(1e5_f32 + 4.0, 2e5, 0.0), far).unwrap();
    assert_eq!(position(image), [100_001.0, 200_000.0, 0.0]);
    assert_eq!(invert_in_sphere(far.centre(), far), Err(Degenerate::CentreOfInversion));
}

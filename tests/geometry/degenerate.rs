//! Inputs without an answer get the name of what is wrong; near ones, at any size and distance, get their answer.

use super::{Random, add, components, cross, length, point, position, scale, sub};
use ga_physics::algebra::Real;
use ga_physics::algebra::cga::{Plane, Point, Sphere};
use ga_physics::geometry::{
    Degenerate, Facet, SpheresMeet, circle_parts, circle_through, closest_point_on_line, invert_in_sphere,
    line_meets_plane, line_through, plane_through, planes_meet, reflect_in_line, sphere_through, sphere_through_pair,
    spheres_meet,
};

/// One rounding each of the square root, the reciprocal and the product.
fn is_e3(plane: Plane) -> bool {
    length(sub(components(plane.normal()), [0.0, 0.0, 1.0])) < 2.0 * f64::EPSILON
}

const SIZES: [f64; 5] = [1e-100, 1e-30, 1.0, 1e30, 1e100];

#[test]
fn coincident_points_are_named() {
    for size in SIZES {
        let a = point::<f64>([size, 2.0 * size, 3.0 * size]);
        let b = point([2.0 * size, 0.0, 0.0]);
        assert_eq!(line_through(a, a), Err(Degenerate::CoincidentPoints));
        assert_eq!(sphere_through_pair(a, a), Err(Degenerate::CoincidentPoints));
        assert_eq!(line_meets_plane(a, a, Plane::new(0.0, 0.0, 1.0, 0.0)), Err(Degenerate::CoincidentPoints));
        assert_eq!(plane_through(a, a, b), Err(Degenerate::CollinearPoints));
        assert_eq!(plane_through(a, b, b), Err(Degenerate::CollinearPoints));
        assert_eq!(circle_through(a, a, a), Err(Degenerate::CollinearPoints));
        assert_eq!(sphere_through(a, b, a, Point::origin()), Err(Degenerate::CoplanarPoints));
    }
}

/// Points of one line or plane, with coordinates that are rounded once: off by at most half an epsilon of the largest.
fn flat_figures<T: Real>(sizes: &[f64]) {
    let mut random = Random(41);
    for size in sizes {
        for _ in 0..200 {
            let (u, v) = (random.direction(), random.direction());
            if length(cross(u, v)) < 0.3 {
                continue;
            }
            let on_line = |t: f64| point::<T>(scale(u, t * size));
            let [a, b, c] = [on_line(-1.0), on_line(0.3 + 0.5 * random.signed()), on_line(1.0)];
            assert_eq!(plane_through(a, b, c), Err(Degenerate::CollinearPoints), "{size:e} {a:?} {b:?} {c:?}");
            assert_eq!(circle_through(a, b, c), Err(Degenerate::CollinearPoints));
            assert_eq!(Facet::new([a, b, c]), Err(Degenerate::CollinearPoints));
            let in_plane = |s: f64, t: f64| point::<T>(scale(add(scale(u, s), scale(v, t)), *size));
            let flat = [in_plane(0.0, 0.0), in_plane(1.0, 0.1), in_plane(0.2, 1.0), in_plane(-0.7, 0.9)];
            let [a, b, c, d] = flat;
            assert_eq!(sphere_through(a, b, c, d), Err(Degenerate::CoplanarPoints), "{size:e} {flat:?}");
        }
    }
}

#[test]
fn collinear_and_coplanar_points_are_named_also_within_rounding() {
    flat_figures::<f64>(&SIZES);
    flat_figures::<f32>(&[1e-10, 1.0, 1e10]);
}

#[test]
fn exactly_collinear_and_coplanar_points_are_named_far_from_the_origin() {
    for distance in [1e3, 1e6, 1e9] {
        let at = |x: f64, y: f64, z: f64| point::<f64>([distance + x, -2.0 * distance + y, 3.0 * distance + z]);
        assert_eq!(
            plane_through(at(0.0, 0.0, 0.0), at(1.0, 2.0, 3.0), at(2.0, 4.0, 6.0)),
            Err(Degenerate::CollinearPoints)
        );
        let flat = sphere_through(at(0.0, 0.0, 0.0), at(1.0, 0.0, 1.0), at(0.0, 1.0, 1.0), at(1.0, 1.0, 2.0));
        assert_eq!(flat, Err(Degenerate::CoplanarPoints));
        // One unit in the last place off the plane is a proper, if flat, tetrahedron.
        let ulp = f64::EPSILON * 4.0 * distance;
        assert!(sphere_through(at(0.0, 0.0, 0.0), at(1.0, 0.0, 0.0), at(0.0, 1.0, 0.0), at(1.0, 2.0, ulp)).is_ok());
    }
}

#[test]
fn proper_figures_are_accepted_at_every_size() {
    for exponent in [-150, -120, -100, -60, 60, 100, 120, 150] {
        let size = 10f64.powi(exponent);
        let at = |x: f64, y: f64, z: f64| point::<f64>([x * size, y * size, z * size]);
        let [a, b, c, d] = [at(1.0, 1.0, 1.0), at(1.0, -1.0, -1.0), at(-1.0, 1.0, -1.0), at(-1.0, -1.0, 1.0)];
        let root3 = 3f64.sqrt();
        let plane = plane_through(a, b, c).unwrap();
        let normal = [1.0 / root3, 1.0 / root3, -1.0 / root3];
        let found = components(plane.normal());
        assert!(length(sub(found, normal)) < 1e-15 || length(add(found, normal)) < 1e-15, "{found:?} at {size:e}");
        let sphere = sphere_through(a, b, c, d).unwrap();
        assert!((sphere.radius().unwrap() / size - root3).abs() < 1e-15, "{size:e}");
        assert!(length(scale(position(sphere.centre()), 1.0 / size)) < 1e-15);
        let circle = circle_through(a, b, c).unwrap();
        assert!((circle.radius / size - (8f64 / 3.0).sqrt()).abs() < 1e-15, "{size:e}");
        assert!((sphere_through_pair(a, b).unwrap().radius().unwrap() / size - 2f64.sqrt()).abs() < 1e-15);
        let line = line_through(a, b).unwrap();
        let foot = scale(position(closest_point_on_line(Point::origin(), line).unwrap()), 1.0 / size);
        assert!(length(sub(foot, [1.0, 0.0, 0.0])) < 1e-15, "{foot:?}");
        assert!(reflect_in_line(c, line).is_ok());
        let met = line_meets_plane(at(0.0, 0.0, 3.0), at(0.0, 0.0, 5.0), Plane::new(0.0, 0.0, 1.0, size)).unwrap();
        assert!(length(sub(scale(position(met), 1.0 / size), [0.0, 0.0, 1.0])) < 1e-15);
        let facet = Facet::new([a, b, c]).unwrap();
        assert_eq!(facet.barycentric(a)[0], 1.0);
        assert!(facet.barycentric(a)[1].abs() < 1e-15);
    }
}

#[test]
fn planes_and_circles_of_any_representable_size_have_their_answer_and_spheres_a_name() {
    for size in [f64::MIN_POSITIVE, 1e-250, 1e250, 1e307] {
        let [a, b, c, d] = [[0.0; 3], [size, 0.0, 0.0], [0.0, size, 0.0], [0.0, 0.0, size]].map(point::<f64>);
        assert!(is_e3(plane_through(a, b, c).unwrap()), "{size:e}");
        assert!((circle_through(a, b, c).unwrap().radius / size - 0.5f64.sqrt()).abs() < 1e-15, "{size:e}");
        // A sphere stores its radius squared.
        assert_eq!(sphere_through(a, b, c, d), Err(Degenerate::OutOfRange), "{size:e}");
        assert_eq!(sphere_through_pair(a, b), Err(Degenerate::OutOfRange), "{size:e}");
    }
    let (low, high) = (point::<f64>([f64::MIN, 0.0, 0.0]), point([f64::MAX, 0.0, 0.0]));
    assert_eq!(line_through(low, high), Err(Degenerate::OutOfRange), "the difference overflows");
    // Edges of very different length.
    for short in [1e-9, 1e-100, 1e-200, 1e-300] {
        let (a, b, c) = (Point::origin(), point([1.0, 0.0, 0.0]), point::<f64>([0.0, short, 0.0]));
        assert!(is_e3(plane_through(a, b, c).unwrap()), "{short:e}");
        match circle_through(a, b, c) {
            Ok(circle) => assert!((circle.radius - 0.5).abs() < 1e-15, "{short:e}: {circle:?}"),
            Err(named) => assert!(named == Degenerate::OutOfRange && short < 1e-150, "{short:e}: {named:?}"),
        }
    }
}

#[test]
fn numbers_that_are_not_finite_are_named_wherever_they_stand() {
    let good = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut tried = 0;
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (which, axis) in (0..4).flat_map(|which| (0..3).map(move |axis| (which, axis))) {
            let mut points = good;
            points[which][axis] = bad;
            let [a, b, c, d] = points.map(point::<f64>);
            assert_eq!(sphere_through(a, b, c, d), Err(Degenerate::NotFinite));
            if which < 3 {
                assert_eq!(plane_through(a, b, c), Err(Degenerate::NotFinite));
                assert_eq!(circle_through(a, b, c), Err(Degenerate::NotFinite));
                assert_eq!(Facet::new([a, b, c]), Err(Degenerate::NotFinite));
            }
            if which < 2 {
                assert_eq!(line_through(a, b), Err(Degenerate::NotFinite));
                assert_eq!(sphere_through_pair(a, b), Err(Degenerate::NotFinite));
                let floor = Plane::new(0.0, 0.0, 1.0, -1.0);
                assert_eq!(line_meets_plane(a, b, floor), Err(Degenerate::NotFinite));
            }
            if which == 0 {
                let unit = Sphere::around(Point::origin(), 1.0);
                assert_eq!(invert_in_sphere(a, unit), Err(Degenerate::NotFinite));
                assert_eq!(invert_in_sphere(b, Sphere::around(a, 1.0)), Err(Degenerate::NotFinite));
                assert_eq!(spheres_meet(unit, Sphere::around(a, 1.0)), Err(Degenerate::NotFinite));
                let line = line_through(b, c).unwrap();
                assert_eq!(reflect_in_line(a, line), Err(Degenerate::NotFinite));
                assert_eq!(closest_point_on_line(a, line), Err(Degenerate::NotFinite));
                assert_eq!(circle_parts(a ^ b ^ c), Err(Degenerate::NotFinite));
            }
            tried += 1;
        }
        let plane = Plane::new(0.0, 0.0, bad, 0.0);
        assert_eq!(line_meets_plane(point(good[3]), Point::origin(), plane), Err(Degenerate::NotFinite));
        assert_eq!(planes_meet(plane, Plane::new(1.0, 0.0, 0.0, 0.0)), Err(Degenerate::NotFinite));
        assert_eq!(
            planes_meet(Plane::new(1.0, 0.0, 0.0, bad), Plane::new(0.0, 1.0, 0.0, 0.0)),
            Err(Degenerate::NotFinite)
        );
        assert_eq!(invert_in_sphere(point(good[1]), Sphere::new(0.0, 0.0, 0.0, bad)), Err(Degenerate::NotFinite));
    }
    assert_eq!(tried, 36);
    let imaginary = Sphere::new(0.0, 0.0, 0.0, -1.0);
    assert_eq!(imaginary.radius(), Err(Degenerate::ImaginaryRound));
    assert_eq!(Sphere::new(0.0, 0.0, 0.0, f64::NAN).radius(), Err(Degenerate::NotFinite));
    assert_eq!(spheres_meet(imaginary, Sphere::around(Point::origin(), 1.0)), Err(Degenerate::ImaginaryRound));
}

#[test]
fn lines_along_planes_and_parallel_planes_are_named() {
    let floor = Plane::new(0.0, 0.0, 1.0, 2.0);
    let at = |z: f64| (point([1.0, 2.0, z]), point::<f64>([4.0, -2.0, z]));
    for z in [2.0, 5.0] {
        assert_eq!(line_meets_plane(at(z).0, at(z).1, floor), Err(Degenerate::ParallelLineAndPlane));
    }
    assert_eq!(planes_meet(floor, floor), Err(Degenerate::ParallelPlanes));
    assert_eq!(planes_meet(floor, -floor), Err(Degenerate::ParallelPlanes));
    assert_eq!(planes_meet(floor, Plane::new(0.0, 0.0, 1.0, -7.0)), Err(Degenerate::ParallelPlanes));
    let mut random = Random(42);
    for _ in 0..1000 {
        let [a, b, c] = [(); 3].map(|()| random.vector());
        let (u, v) = (sub(b, a), sub(c, a));
        // A corner of less than 30 degrees amplifies the rounding of the normal.
        if length(cross(u, v)) < 0.5 * length(u) * length(v) {
            continue;
        }
        let plane = plane_through(point::<f64>([0.0; 3]), point(u), point(v)).unwrap();
        let in_plane = |s: f64, t: f64| point(add(scale(u, s), scale(v, t)));
        let found = line_meets_plane(in_plane(random.signed(), -1.0), in_plane(random.signed(), 1.0), plane);
        assert_eq!(found, Err(Degenerate::ParallelLineAndPlane), "within rounding");
        let moved = plane_through(in_plane(1.0, 1.0), in_plane(-0.5, 0.3), in_plane(1.0, -1.0)).unwrap();
        assert_eq!(planes_meet(plane, moved), Err(Degenerate::ParallelPlanes), "within rounding");
    }
}

#[test]
fn spheres_lie_to_each_other_as_named() {
    let unit = Sphere::around(Point::<f64>::origin(), 1.0);
    let ball = |x: f64, radius: f64| Sphere::around(Point::new(x, 0.0, 0.0), radius);
    for (other, expected) in [
        (ball(0.0, 1.0), SpheresMeet::Concentric),
        (ball(0.0, 3.0), SpheresMeet::Concentric),
        (ball(0.25, 0.5), SpheresMeet::Nested),
        (ball(0.25, 2.0), SpheresMeet::Nested),
        (ball(3.0, 1.0), SpheresMeet::Separate),
        (ball(2.000_001, 1.0), SpheresMeet::Separate),
    ] {
        assert_eq!(spheres_meet(unit, other), Ok(expected), "{other:?}");
        assert_eq!(spheres_meet(other, unit), Ok(expected), "{other:?}");
    }
    // Tangent from outside and from inside: a circle of radius 0 at the point of contact.
    for (other, at) in [(ball(3.0, 2.0), 1.0), (ball(0.5, 0.5), 1.0), (ball(-1.0, 2.0), 1.0), (ball(-5.0, 4.0), -1.0)] {
        for (first, second) in [(unit, other), (other, unit)] {
            let Ok(SpheresMeet::Circle(circle)) = spheres_meet(first, second) else { panic!("{other:?}") };
            assert_eq!((position(circle.centre), circle.radius), ([at, 0.0, 0.0], 0.0), "{other:?}");
        }
    }
}

#[test]
fn the_centre_has_no_inverse_and_its_neighbours_have() {
    let sphere = Sphere::around(Point::new(3.0, 4.0, 5.0), 2.0);
    assert_eq!(invert_in_sphere(sphere.centre(), sphere), Err(Degenerate::CentreOfInversion));
    let near = Point::new(3.0 + 4.0 * f64::EPSILON, 4.0, 5.0);
    let image = invert_in_sphere(near, sphere).unwrap();
    assert_eq!(position(image), [3.0 + 1.0 / f64::EPSILON, 4.0, 5.0]);
    let unit = Sphere::around(Point::<f64>::origin(), 1.0);
    let far = position(invert_in_sphere(point([1e-200, 0.0, 0.0]), unit).unwrap());
    assert!((far[0] / 1e200 - 1.0).abs() < 1e-15 && far[1..] == [0.0, 0.0]);
    assert_eq!(
        invert_in_sphere(point([1e-320, 0.0, 0.0]), unit),
        Err(Degenerate::CentreOfInversion),
        "1e320 overflows"
    );
}

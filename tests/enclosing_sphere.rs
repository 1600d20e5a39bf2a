//! Smallest enclosing spheres, against an exhaustive search, known answers and their own certificates.
#![allow(clippy::unwrap_used, reason = "a test that cannot be set up should stop there")]

#[path = "support/shapes.rs"]
mod shapes;

use ga_physics::algebra::cga::Point;
use ga_physics::geometry::enclosing_sphere::{EnclosingSphere, EnclosingSphereError, enclosing_sphere};
use nalgebra::Vector3;
use shapes::*;

/// Rounding of a radius in the local frame: a handful of operations, relative.
const FEW_ULP: f64 = 8.0 * f64::EPSILON;

type Vector = Vector3<f64>;

fn vector(p: Point<f64>) -> Vector {
    Vector::new(p.x, p.y, p.z)
}

fn points(list: &[[f64; 3]]) -> Vec<Point<f64>> {
    list.iter().map(|&[x, y, z]| point(x, y, z)).collect()
}

/// A reproducible sequence in [0, 1): multiplications modulo 2^64 (Knuth's MMIX constants), the high bits taken.
struct Sequence(u64);

impl Sequence {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn in_cube(&mut self) -> Point<f64> {
        point(self.next() - 0.5, self.next() - 0.5, self.next() - 0.5)
    }

    fn on_sphere(&mut self) -> Point<f64> {
        let v = std::iter::repeat_with(|| vector(self.in_cube()))
            .find(|v| (0.05..0.5).contains(&v.norm()))
            .unwrap()
            .normalize();
        point(v.x, v.y, v.z)
    }
}

/// Centre of the smallest sphere through two to four points: the centre in their affine hull at equal distances, by linear
/// equations for the weights, which is not how the library does it.
fn circumcentre(chosen: &[Vector]) -> Option<Vector> {
    let edges: Vec<Vector> = chosen[1..].iter().map(|p| p - chosen[0]).collect();
    let gram = nalgebra::DMatrix::from_fn(edges.len(), edges.len(), |i, j| 2.0 * edges[i].dot(&edges[j]));
    let squares = nalgebra::DVector::from_fn(edges.len(), |i, _| edges[i].norm_squared());
    let weights = gram.full_piv_lu().solve(&squares)?;
    let centre = edges.iter().zip(weights.iter()).map(|(e, w)| e * *w).sum::<Vector>() + chosen[0];
    centre.iter().all(|x| x.is_finite()).then_some(centre)
}

/// Radii of all balls on `k` of the points that enclose all points.
fn enclosing_radii(points: &[Vector], k: usize) -> Vec<f64> {
    let subsets = (0u32..1 << points.len()).filter(|s| s.count_ones() as usize == k);
    subsets
        .filter_map(|s| {
            let chosen: Vec<Vector> = (0..points.len()).filter(|i| s >> i & 1 == 1).map(|i| points[i]).collect();
            let centre = circumcentre(&chosen)?;
            let radius = (chosen[0] - centre).norm();
            points.iter().all(|p| (p - centre).norm() <= radius * (1.0 + 1e-9)).then_some(radius)
        })
        .collect()
}

/// The least radius over all enclosing balls of two, three and four points.
fn exhaustive_radius(points: &[Point<f64>]) -> f64 {
    let points: Vec<Vector> = points.iter().copied().map(vector).collect();
    (2..=4).flat_map(|k| enclosing_radii(&points, k)).fold(f64::INFINITY, f64::min)
}

/// The report's search: the first class with an enclosing ball, and the least of that class.
fn first_class_radius(points: &[Point<f64>]) -> f64 {
    let points: Vec<Vector> = points.iter().copied().map(vector).collect();
    let classes = (2..=4).map(|k| enclosing_radii(&points, k)).find(|radii| !radii.is_empty());
    classes.unwrap().into_iter().fold(f64::INFINITY, f64::min)
}

/// The ball encloses all points, its centre lies in the hull of its support, and no smaller ball is possible, to within
/// roundings: relative ones, and those of the centre, one of each of its coordinates.
fn assert_certified(points: &[Point<f64>], found: &EnclosingSphere) {
    let (c, r) = (vector(found.ball.centre), found.ball.radius);
    let rounding = FEW_ULP * r + f64::EPSILON * c.norm();
    for p in points {
        assert!((vector(*p) - c).norm() <= r * (1.0 + FEW_ULP), "{p:?} is outside {:?}", found.ball);
    }
    assert!((1..=4).contains(&found.support.len()), "{:?}", found.support);
    assert_eq!(found.support.len(), found.weights.len());
    assert!(found.weights.iter().all(|w| (0.0..=1.0).contains(w)), "{:?}", found.weights);
    assert!((found.weights.iter().sum::<f64>() - 1.0).abs() < FEW_ULP);
    let support = || found.support.iter().map(|&i| vector(points[i]));
    let mean = support().zip(&found.weights).map(|(p, w)| (p - c) * *w).sum::<Vector>();
    assert!(mean.norm() <= rounding, "the centre is {} off the hull of the support", mean.norm());
    // The bound again, from its definition.
    let bound = support().zip(&found.weights).map(|(p, w)| (p - c - mean).norm_squared() * w).sum::<f64>().sqrt();
    assert!((bound - found.radius_bound).abs() <= rounding, "bound {bound} stated as {}", found.radius_bound);
    assert!(r - bound <= rounding, "radius {r} exceeds the bound by {}", r - bound);
}

fn assert_radius(points: &[Point<f64>], radius: f64) {
    let found = enclosing_sphere(points).unwrap();
    assert_certified(points, &found);
    assert!((found.ball.radius - radius).abs() <= FEW_ULP * radius, "{} instead of {radius}", found.ball.radius);
}

#[test]
fn the_exhaustive_search_agrees() {
    let mut sequence = Sequence(1);
    for n in 2..=9 {
        for _ in 0..40 {
            let points: Vec<Point<f64>> = std::iter::repeat_with(|| sequence.in_cube()).take(n).collect();
            let found = enclosing_sphere(&points).unwrap();
            assert_certified(&points, &found);
            let radius = exhaustive_radius(&points);
            assert!((found.ball.radius - radius).abs() < 1e-12 * radius, "{} instead of {radius}", found.ball.radius);
        }
    }
}

/// On a small lattice many points share a sphere, and many supports a centre; a little off it, nearly. Each result must
/// prove itself.
#[test]
fn lattice_points_are_certified() {
    let mut sequence = Sequence(5);
    for round in 0..4000 {
        let off = [0.0, 1e-15, 1e-14, 1e-8][round % 4];
        let mut coordinate = |flat| if flat { 0.0 } else { (4.0 * sequence.next()).floor() } + off * sequence.next();
        let lattice: Vec<Point<f64>> = (0..4 + round % 9)
            .map(|_| point(coordinate(false), coordinate(false), coordinate(round % 3 == 0)))
            .collect();
        let found = enclosing_sphere(&lattice).unwrap();
        assert_certified(&lattice, &found);
        if round % 50 == 0 && found.ball.radius > 0.1 {
            assert!((found.ball.radius - exhaustive_radius(&lattice)).abs() < 1e-7);
        }
    }
}

/// A regular tetrahedron on the unit sphere and three points of a shallow cap: the great circle ball of an obtuse triangle
/// of the cap encloses everything, and is far too large.
#[test]
fn the_first_class_that_encloses_is_not_the_smallest() {
    let unit = regular_tetrahedron().vertices.iter().map(|p| vector(*p).normalize()).collect::<Vec<_>>();
    // Three points of an arc of radius 1.6 that stays inside the unit sphere; the ball of that radius holds the tetrahedron too.
    let (radius, half_angle) = (1.6f64, 0.25f64);
    let axis = -unit[0];
    let across = axis.cross(&Vector::x()).normalize();
    let cap_centre = -axis * (radius - 0.9);
    let cap = [-1.0, 0.0, 1.0]
        .map(|t: f64| cap_centre + radius * (axis * (t * half_angle).cos() + across * (t * half_angle).sin()));
    let all: Vec<Point<f64>> = unit.iter().chain(&cap).map(|v| point(v.x, v.y, v.z)).collect();
    let shortcut = first_class_radius(&all);
    assert!(shortcut > 1.5, "the counterexample does not work: the shortcut finds {shortcut}");
    assert!((exhaustive_radius(&all) - 1.0).abs() < 1e-12);
    assert_radius(&all, 1.0);
}

#[test]
fn degenerate_sets_are_no_special_case() {
    assert_eq!(enclosing_sphere(&[]), Err(EnclosingSphereError::NoPoints));
    assert!(matches!(
        enclosing_sphere(&points(&[[0.0; 3], [f64::NAN, 0.0, 0.0]])),
        Err(EnclosingSphereError::NotFinite { index: 1, .. })
    ));
    assert!(matches!(
        enclosing_sphere(&points(&[[-1e308; 3], [1e308; 3]])),
        Err(EnclosingSphereError::OutOfRange { .. })
    ));
    assert_radius(&points(&[[1.0, 2.0, 3.0]]), 0.0);
    assert_radius(&points(&[[1.0, 2.0, 3.0]; 7]), 0.0);
    assert_radius(&points(&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]), 1.0);
    // Collinear, coplanar, cospherical.
    assert_radius(
        &(0..100).map(|i| point(f64::from(i), 2.0 * f64::from(i), -2.0 * f64::from(i))).collect::<Vec<_>>(),
        148.5,
    );
    let grid: Vec<Point<f64>> = (0..400).map(|i| point(f64::from(i % 20), f64::from(i / 20), 1.0)).collect();
    assert_radius(&grid, 19.0 / 2f64.sqrt());
    assert_radius(&cube().vertices, 0.75f64.sqrt());
    assert_radius(&regular_tetrahedron().vertices, 3f64.sqrt());
    // The right angle: the centre is on the longest edge, and the corner tetrahedron's in its largest face.
    assert_radius(&points(&[[0.0; 3], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]]), 2.5);
    assert_radius(&corner_tetrahedron().vertices, (2f64 / 3.0).sqrt());
    for levels in 0..=4 {
        assert_radius(&icosphere(levels).vertices, 1.0);
    }
    let circle = |n: u32| (0..n).map(move |i| (f64::from(i) / f64::from(n) * std::f64::consts::TAU).sin_cos());
    for n in [3, 4, 5, 64, 1001] {
        assert_radius(&circle(n).map(|(s, c)| point(s, c, 0.25)).collect::<Vec<_>>(), 1.0);
    }
}

#[test]
fn many_points_on_a_sphere() {
    let mut sequence = Sequence(2);
    let many: Vec<Point<f64>> = std::iter::repeat_with(|| sequence.on_sphere()).take(100_000).collect();
    assert_radius(&many, 1.0);
    // And with every point there ten times.
    let often: Vec<Point<f64>> = many.iter().take(2_000).cycle().take(20_000).copied().collect();
    let found = enclosing_sphere(&often).unwrap();
    assert_certified(&often, &found);
}

/// Points on a thin cap, where circles through three of them are ill-conditioned and growth of the ball is second order.
#[test]
fn shallow_caps_and_near_misses_are_certified() {
    let mut sequence = Sequence(3);
    for depth in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-15] {
        let cap: Vec<Point<f64>> = (0..500)
            .map(|_| sequence.in_cube())
            .map(|p| point(p.x, p.y, depth * (p.x * p.x + p.y * p.y) + depth * depth * p.z))
            .collect();
        assert_certified(&cap, &enclosing_sphere(&cap).unwrap());
        // Two antipodal points and many that stick out by about the depth.
        let nearly: Vec<Point<f64>> = (0..500)
            .map(|i| (i, sequence.on_sphere()))
            .map(|(i, p)| {
                if i < 2 {
                    point(1.0 - 2.0 * f64::from(i), 0.0, 0.0)
                } else {
                    let s = 1.0 + depth * p.z;
                    point(p.x * s, p.y * s, p.z * s)
                }
            })
            .collect();
        assert_certified(&nearly, &enclosing_sphere(&nearly).unwrap());
        let one = points(&[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0 + depth, 0.0]]);
        // Through all three: r = (1 + h²) / 2h with h = 1 + depth.
        let h = one[2].y;
        assert_radius(&one, if h > 1.0 { (1.0 + h * h) / (2.0 * h) } else { 1.0 });
    }
}

#[test]
fn distance_from_the_origin_costs_the_rounding_of_the_centre_only() {
    let mut sequence = Sequence(4);
    for distance in [1e3, 1e4, 1e8] {
        for _ in 0..50 {
            let far: Vec<Point<f64>> = (0..30)
                .map(|_| sequence.in_cube())
                .map(|p| point(p.x + distance, p.y - distance, p.z + 0.5 * distance))
                .collect();
            let found = enclosing_sphere(&far).unwrap();
            assert_certified(&far, &found);
            // The same points moved back, which is exact, give the same radius to the last digits.
            let near: Vec<Point<f64>> =
                far.iter().map(|p| point(p.x - distance, p.y + distance, p.z - 0.5 * distance)).collect();
            let at_home = enclosing_sphere(&near).unwrap();
            assert_eq!(found.support, at_home.support);
            assert!((found.radius_bound - at_home.radius_bound).abs() <= FEW_ULP * at_home.radius_bound);
        }
    }
}

/// A wrong centre must fail the certificate: the assertion itself is tested.
#[test]
fn the_certificate_rejects_a_ball_that_is_not_smallest() {
    let corners = cube().vertices;
    let mut found = enclosing_sphere(&corners).unwrap();
    found.ball.centre.x += 1e-6;
    found.ball.radius += 1e-6;
    assert!(std::panic::catch_unwind(|| assert_certified(&corners, &found)).is_err());
}

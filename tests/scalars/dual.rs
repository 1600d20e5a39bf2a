//! Derivatives of generated code against closed forms, and against central differences in double-double.

use crate::Random;
use ga_physics::algebra::cga::{Motor, Point, Sphere};
use ga_physics::algebra::g3::{Rotor, Vector};
use ga_physics::algebra::num_dual::{self, Dual2, Dual64, DualNum, DualSVec64, HyperDual64};
use ga_physics::algebra::{DoubleDouble, Scalar};
use ga_physics::geometry::formulas;
use nalgebra::{SVector, Vector3};

/// Fifty epsilons of f64: for figures of about 1, made in a few dozen operations.
const LIMIT: f64 = 1e-14;

/// The rotor `exp(-B phi / 2)`, `B = e12` turned into the plane of a unit axis.
fn rotor<D: DualNum<Primitive = f64> + Scalar>(axis: [f64; 3], phi: D) -> Rotor<D> {
    let (sin, cos) = (phi * D::ratio(-1, 2)).sin_cos();
    let [x, y, z] = axis.map(D::from);
    Rotor::new(cos, x * sin, y * sin, z * sin)
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn near(a: [f64; 3], b: [f64; 3]) -> bool {
    (0..3).all(|i| (a[i] - b[i]).abs() < LIMIT)
}

const AXES: [[f64; 3]; 3] = [[0.0, 0.0, 1.0], [0.6, 0.0, -0.8], [2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0]];
const ANGLES: [f64; 7] = [0.0, 1e-9, 0.3, 1.5, std::f64::consts::PI, -2.0, 6.2];

/// x' = R(phi) x ~R + t phi: the velocity is `axis x (R x ~R) + t`.
#[test]
fn a_moved_point_moves_with_the_angular_velocity() {
    let (point, drift) = ([0.3, -0.8, 0.5], [0.25, 0.5, -1.0]);
    for axis in AXES {
        for phi in ANGLES {
            let phi = Dual64::new(phi, 1.0);
            let motor = Motor::from_parts(Vector::from(drift.map(|t| phi * t)), rotor(axis, phi));
            let moved: [Dual64; 3] = motor.apply(Point::from(point.map(Dual64::from))).into();
            let arm: [f64; 3] = std::array::from_fn(|i| moved[i].re - drift[i] * phi.re);
            let turning = cross(axis, arm);
            let velocity = std::array::from_fn(|i| turning[i] + drift[i]);
            assert!(near(moved.map(|x| x.eps), velocity), "{moved:?}, expected {velocity:?}");
        }
    }
}

/// The acceleration of a steady rotation points to the axis: `axis x (axis x r)`.
#[test]
fn a_second_derivative_is_the_centripetal_acceleration() {
    for axis in AXES {
        for phi in ANGLES {
            let phi = Dual2::new(phi, 1.0, 0.0);
            let turned: [Dual2<f64>; 3] = rotor(axis, phi).apply(Vector::new(0.3, -0.8, 0.5).map(Dual2::from)).into();
            let expected = cross(axis, cross(axis, turned.map(|x| x.re)));
            assert!(near(turned.map(|x| x.v2), expected), "{turned:?}, expected {expected:?}");
        }
    }
}

/// `P . s = (rho² - |p - c|²)/2`: the gradient by p is `c - p`, the derivative by p.x and c.x is 1.
#[test]
fn gradient_and_mixed_derivative_of_the_inner_product() {
    let centre = [0.5, 0.25, -2.0];
    let (value, gradient) = num_dual::gradient(
        |p: SVector<DualSVec64<3>, 3>| {
            let [x, y, z] = centre.map(DualSVec64::from);
            Point::new(p[0], p[1], p[2]) | Sphere::new(x, y, z, DualSVec64::from(9.0))
        },
        &Vector3::new(1.0, -1.0, 2.0),
    );
    assert_eq!(value, (9.0 - 0.25 - 1.5625 - 16.0) / 2.0);
    assert_eq!(gradient, Vector3::new(-0.5, 1.25, -4.0));

    let (one, constant) = (|x: f64, by_p: f64, by_c: f64| HyperDual64::new(x, by_p, by_c, 0.0), HyperDual64::from);
    let point = Point::new(one(1.0, 1.0, 0.0), constant(-1.0), constant(2.0));
    let inner = point | Sphere::new(one(0.5, 0.0, 1.0), constant(0.25), constant(-2.0), constant(9.0));
    assert_eq!((inner.eps1, inner.eps2, inner.eps1eps2), (-0.5, 0.5, 1.0));
}

/// Four points, of which the first moves.
struct Corners {
    points: [[f64; 3]; 4],
    velocity: [f64; 3],
}

impl Corners {
    fn random(random: &mut Random) -> Self {
        // About the corners of a tetrahedron, so that the sphere is well determined.
        let about = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        let points = about.map(|corner: [f64; 3]| corner.map(|x| x + 0.3 * random.signed()));
        Self { points, velocity: [(); 3].map(|()| random.signed()) }
    }

    /// Centre and squared radius of the sphere through them, `time` later.
    fn sphere<T: Scalar + From<f64>>(&self, time: T) -> [T; 4] {
        let mut points = self.points.map(|point| point.map(T::from));
        points[0] = std::array::from_fn(|i| points[0][i] + time * T::from(self.velocity[i]));
        let [a, b, c, d] = points.map(Point::from);
        formulas::circumsphere(a, b, c, d).into()
    }
}

/// Of `|p - c|² = rho²`: `2 (p - c) . (dp - dc) = d(rho²)` for each point, with `dp = 0` for those that rest.
#[test]
fn the_sphere_through_points_follows_them() {
    let mut random = Random(9);
    for _ in 0..200 {
        let corners = Corners::random(&mut random);
        let sphere = corners.sphere(Dual64::new(0.0, 1.0));
        for (index, point) in corners.points.into_iter().enumerate() {
            let speed = |i: usize| if index == 0 { corners.velocity[i] } else { 0.0 };
            let left: f64 = (0..3).map(|i| 2.0 * (point[i] - sphere[i].re) * (speed(i) - sphere[i].eps)).sum();
            assert!((left - sphere[3].eps).abs() < 10.0 * LIMIT, "point {index}: {left} and {}", sphere[3].eps);
        }
    }
}

/// Central differences over 1e-9 err by 1e-18 for the third derivative and by 1e-22 for rounding.
#[test]
fn derivatives_agree_with_differences_in_double_double() {
    let mut random = Random(10);
    let h = DoubleDouble::from(1e-9);
    for _ in 0..200 {
        let corners = Corners::random(&mut random);
        let (before, after) = (corners.sphere(-h), corners.sphere(h));
        for (i, dual) in corners.sphere(Dual64::new(0.0, 1.0)).into_iter().enumerate() {
            let difference = f64::from((after[i] - before[i]) / (h + h));
            assert!((dual.eps - difference).abs() < 10.0 * LIMIT, "{}, differences {difference}", dual.eps);
        }
    }
}

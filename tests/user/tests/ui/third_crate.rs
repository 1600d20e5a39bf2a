//! A third crate, over the algebra of a second one, which extends an algebra of the first.

use ga_physics::algebra::{cga, g3};
use ga_physics_user::{flat, meet_planes, sphere_around};

/// Calls a formula of the second crate; `Vector` is a type of the first.
#[ga_physics::formula(flat, dynamic = crossing_dynamic)]
pub fn crossing(a: Plane, b: Plane, normal: Vector) -> Point {
    let line: Line = ga_physics_user::meet_planes(a, b);
    line ^ normal
}

fn main() {
    let (a, b) = (flat::Plane::new(1.0, 0.0, 0.0, -2.0), flat::Plane::new(0.0, 1.0, 0.0, -3.0));
    let point = crossing(a, b, g3::Vector::new(0.0, 0.0, 1.0));
    assert_eq!((point, meet_planes(a, b).e12), (flat::Point::new(1.0, -2.0, -3.0, 0.0), 1.0));
    let sphere = sphere_around(cga::Point::new(1.0, 0.0, 0.0), cga::Point::new(1.0, 3.0, 4.0));
    assert_eq!(sphere, cga::Sphere::new(1.0, 0.0, 0.0, 25.0));
}

//! A value that depends on where the origin is.

use ga_physics::algebra::cga;
use ga_physics::formula;

#[formula(cga, local = a)]
fn from_origin(a: Point, b: Point) -> Scalar {
    (a | no) + (a | b)
}

#[formula(cga, local = a)]
fn free_vector(a: Point, offset: Vector) -> Round {
    a + offset
}

fn main() {}

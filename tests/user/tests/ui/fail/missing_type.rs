//! A call of which only its author knows what it returns.

use ga_physics::algebra::cga;
use ga_physics::formula;

#[formula(cga)]
fn touching(a: Point, b: Point) -> Sphere {
    let middle = ga_physics::geometry::formulas::pair_sphere(a, b);
    middle + Infinity
}

fn main() {}

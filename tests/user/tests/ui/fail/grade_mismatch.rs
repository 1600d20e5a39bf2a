//! A result that the declared type does not hold.

use ga_physics::algebra::cga;
use ga_physics::formula;

#[formula(cga)]
fn circle(a: Point, b: Point, c: Point) -> PointPair {
    a ^ b ^ c
}

#[formula(cga)]
fn sum(a: Point, b: Point) -> Point {
    (a + b) / 2
}

fn main() {}

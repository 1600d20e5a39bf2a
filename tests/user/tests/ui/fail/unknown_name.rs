//! Names that do not exist: of a value, a type, a component, a method, an option.

use ga_physics::algebra::cga;
use ga_physics::formula;

#[formula(cga)]
fn value(first: Point, second: Point) -> PointPair {
    first ^ secnd
}

#[formula(cga)]
fn ty(a: Sphare) -> Sphere {
    a
}

#[formula(cga)]
fn component(a: Sphere) -> Scalar {
    a.rho
}

#[formula(cga)]
fn method(a: Line) -> Line {
    a.normalized()
}

#[formula(cga, locale = a)]
fn option(a: Point) -> Point {
    a
}

fn main() {}

//! A module without an algebra, and one that does not exist.

use ga_physics::algebra::g3;
use ga_physics::formula;

#[formula(std::mem)]
fn elsewhere(a: Vector) -> Vector {
    a
}

#[formula(g3)]
fn fine(a: Vector) -> Vector {
    a
}

fn main() {}

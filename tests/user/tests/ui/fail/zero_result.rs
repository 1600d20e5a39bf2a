//! A result that is always zero.

use ga_physics::algebra::g3;
use ga_physics::formula;

#[formula(g3)]
fn zero(a: Vector, b: Vector) -> Trivector {
    let plane = a ^ b;
    plane ^ a
}

fn main() {}

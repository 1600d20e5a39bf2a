//! What is not used is reported by the compiler, on the token.

#![deny(unused_variables)]

use ga_physics::algebra::g3;
use ga_physics::formula;

#[formula(g3)]
fn unused(a: Vector, b: Vector) -> Vector {
    let plane = a ^ e1;
    let _ignored = a;
    a
}

fn main() {}

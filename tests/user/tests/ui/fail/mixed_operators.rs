//! Rust binds the operators otherwise than paper does.

use ga_physics::algebra::g3;
use ga_physics::formula;

#[formula(g3)]
fn inner_outer(a: Vector, b: Vector, c: Vector) -> Vector {
    a | b ^ c
}

#[formula(g3)]
fn outer_sum(a: Vector, b: Vector, c: Vector) -> Bivector {
    a ^ b + c
}

fn main() {}

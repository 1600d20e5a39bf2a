//! Rust that is no formula.

use ga_physics::algebra::g3;
use ga_physics::formula;

#[formula(g3)]
fn branch(a: Vector, b: Vector) -> Vector {
    if a.e1 > b.e1 { a } else { b }
}

#[formula(g3)]
fn looped(a: Vector) -> Vector {
    for _ in 0..3 {}
    a
}

#[formula(g3)]
fn reference(a: &Vector) -> Vector {
    a
}

#[formula(g3)]
fn generic<U>(a: Vector) -> Vector {
    a
}

#[formula(g3)]
fn closure(a: Vector) -> Vector {
    let twice = |x| x + x;
    a
}

#[formula(g3)]
async fn later(a: Vector) -> Vector {
    a
}

#[formula(g3)]
fn no_result(a: Vector) -> Vector {
    a + a;
}

fn main() {}

//! One item to read in assembly: write it here, then
//!
//! ```sh
//! cargo rustc --release --no-default-features --example assembly -- --emit asm -C symbol-mangling-version=v0
//! ```
//!
//! and read the label that holds `4item` in `target/release/examples/assembly-*.s`. A slice in, a slice out shows the code as
//! an inner loop gets it; a function of single operands shows it without the loop.

use ga_physics::algebra::cga::{Motor, Point};
use std::hint::black_box;

#[inline(never)]
fn item(motor: &Motor, point: &Point) -> Point {
    motor.apply(*point)
}

fn main() {
    let motor = black_box(Motor::new(1.0, 0.0, 0.0, 0.0, -0.5, 0.0, 0.0, 0.0));
    println!("{:?}", black_box(item(&motor, &black_box(Point::new(0.0, 0.0, 0.0)))));
}

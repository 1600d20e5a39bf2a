//! One item to read in assembly: write it here, then
//!
//! ```sh
//! cargo rustc --release --no-default-features --example assembly -- --emit asm
//! grep -l 4item: target/release/examples/assembly-*.s     # the file to read; the label is the one with `4item`
//! ```
//!
//! A slice in and a slice out in `item` shows the code as an inner loop gets it; single operands show it without the loop.

use ga_physics::algebra::cga::{Motor, Point};
use std::hint::black_box;

#[inline(never)]
fn item(motor: &Motor, point: &Point) -> Point {
    motor.apply(*point)
}

fn main() {
    let motor = black_box(Motor::from_fn(|index| if index == 0 { 1.0 } else { 0.0 }));
    println!("{:?}", item(&motor, &black_box(Point::new(1.0, 2.0, 3.0))));
}

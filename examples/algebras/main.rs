//! Five algebras, each declared in a file of its own, and what each is good for.
//!
//! `cargo run --example algebras`. Copy a file and change its types: so an algebra of your own begins. The test
//! `own_algebra` compares every operation of these with the dynamic multivector, exactly.
#![allow(dead_code, reason = "an algebra has more than one program needs")]

mod cga2;
mod g2;
mod pga2;
mod pga3;
mod spacetime;

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_3};

fn main() {
    complex_numbers();
    projective_plane();
    projective_space();
    events_and_fields();
    circles();
}

fn complex_numbers() {
    println!("G(2,0): the plane and its complex numbers");
    let (e1, v) = (g2::Vector::new(1.0, 0.0), g2::Vector::new(3.0, 4.0));
    let z = g2::complex(e1, v);
    println!("  e1 v = {z}, the complex number 3 + 4i; its square is {}", z * z);
    let turned: g2::Vector = g2::Rotor::from_angle(FRAC_PI_3).apply(v);
    println!("  v turned by 60 degrees: {turned}");
    println!("  area of the triangle 0, e1, v: {}", g2::area(g2::Vector::default(), e1, v));
}

fn projective_plane() {
    use pga2::{Line, Motor, Point};
    println!("G(2,0,1): lines and points of the plane");
    // x = 2 and y = 3, as x - 2 = 0 and y - 3 = 0.
    let (upright, level) = (Line::new(1.0, 0.0, -2.0), Line::new(0.0, 1.0, -3.0));
    println!("  x = 2 and y = 3 meet in {}", pga2::intersection(upright, level));
    println!("  x = 2 and x = 5 in the direction {}", pga2::intersection(upright, Line::new(1.0, 0.0, -5.0)));
    let (p, q) = (Point::new(0.0, 1.0), Point::new(4.0, 4.0));
    let line = pga2::join(p, q);
    println!("  the line through {p} and {q}: {line}");
    println!("  its nearest point to the origin: {}", pga2::foot(Point::new(0.0, 0.0), line));
    let turn = Motor::about(Point::new(2.0, 3.0), FRAC_PI_2);
    println!("  a quarter turn about (2, 3) takes (3, 3) to {}", turn.apply(Point::new(3.0, 3.0)));
}

fn projective_space() {
    use ga_physics::algebra::g3::Rotor;
    use pga3::{Plane, Point, Translator};
    println!("G(3,0,1): planes, lines and points of space");
    let axis = pga3::meet_planes(Plane::new(1.0, 0.0, 0.0, -1.0), Plane::new(0.0, 1.0, 0.0, -2.0));
    println!("  x = 1 and y = 2 meet in {axis}");
    println!("  which meets z = 5 in {}", pga3::pierce(axis, Plane::new(0.0, 0.0, 1.0, -5.0)));
    let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Point::from);
    let plane = pga3::plane_through(corners[0], corners[1], corners[2]);
    println!("  the plane through the ends of the axes: {plane}");
    let quarter = Rotor::new(FRAC_1_SQRT_2, 0.0, 0.0, -FRAC_1_SQRT_2);
    let motor = pga3::motor(Translator::new(0.0, 0.0, 3.0), quarter);
    println!("  a quarter turn about z and 3 up take (1, 0, 0) to {}", motor.apply(corners[0]));
}

fn events_and_fields() {
    use spacetime::{Bivector, Rotor, Vector};
    println!("G(1,3): events and fields");
    let boost = Rotor::boost_x(0.5_f64.atanh());
    let (here, there) = (Vector::default(), Vector::new(5.0, 3.0, 0.0, 0.0));
    let seen: Vector = boost.apply(there);
    println!("  boosted to v = 0.5 the event {there} is {seen}");
    println!(
        "  squared interval {} before, {} after",
        spacetime::interval(here, there),
        spacetime::interval(here, seen)
    );
    let field = Bivector::from_fields([0.0, 2.0, 0.0], [0.0, 0.0, 1.0]);
    let boosted: Bivector = boost.apply(field);
    println!("  the field {field} becomes {boosted}");
    println!("  F² = {} before, {} after", spacetime::invariants(field), spacetime::invariants(boosted));
}

fn circles() {
    use cga2::{Circle, ConformalRotor, Dilator, Point, Rotor, Translator};
    println!("G(3,1): circles of the plane");
    let [a, b, c] = [[3.0, 1.0], [2.0, 2.0], [1.0, 1.0]].map(Point::from);
    let circle: Circle = cga2::circle_through(a, b, c);
    println!("  through {a}, {b}, {c}: {circle}, centre {}", cga2::centre(circle));
    println!("  (5, 1) inverted in it: {}", cga2::invert(circle, Point::new(5.0, 1.0)));
    let similarity: ConformalRotor = Translator::new(1.0, 0.0) * (Rotor::from_angle(FRAC_PI_2) * Dilator::by(2.0));
    println!("  scaled by 2, turned by 90 degrees and moved by (1, 0): {}", similarity.apply(circle));
}

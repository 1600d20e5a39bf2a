//! A crate on the library: an algebra that extends one of the library's, and formulas over both. The tests of this crate
//! are a third crate, over its algebra.

/// The plane at infinity added to G(3,0).
pub mod flat {
    ga_physics::algebra! {
        pub algebra flat extends ga_physics::algebra::g3;
        basis e0 = 0;
        pseudoscalar e1230;

        /// A plane.
        type Plane = [e1, e2, e3, e0];
        /// A line.
        type Line = [e23, e31, e12, e10, e20, e30];
        /// A point.
        type Point = [e123, e230, e310, e120];
    }
}

/// The line in which two planes meet.
#[ga_physics::formula(crate::flat)]
pub fn meet_planes(a: Plane, b: Plane) -> Line {
    a ^ b
}

/// The sphere around a point that touches another one.
#[ga_physics::formula(ga_physics::algebra::cga, local = centre)]
pub fn sphere_around(centre: Point, x: Point) -> Sphere {
    centre + (x | centre) * Infinity
}

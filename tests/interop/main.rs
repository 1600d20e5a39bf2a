//! The generated types and those of other crates: the library's own, and those of algebras declared here, as in the
//! crate of a user. Tests have all features of interoperability.
// `unsafe impl Pod` of the types below is the library's: it must not meet the lints of the crate that declares them.
#![forbid(unsafe_code)]
#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test may panic")]

mod display;
mod nalgebra;

#[cfg(feature = "approx")]
mod approx;
#[cfg(feature = "bytemuck")]
mod bytes;
#[cfg(feature = "mint")]
mod mint;
#[cfg(feature = "rand")]
mod random;
#[cfg(feature = "serde")]
mod serde;

use ga_physics::algebra::g3::{Rotor, Vector};

/// The projective plane of a user, with a type for each way of knowing coefficients.
mod pga {
    ga_physics::algebra! {
        pub algebra user_pga;
        basis e0 = 0, e1 = 1, e2 = 1;

        /// The line at infinity.
        type Infinity = e0;
        type Line = [e1, e2, e0];
        /// A line of known direction.
        type Unit: unit = [e1, e2, e0];
        type Point = x*e20 + y*e01 + e12;
        /// A parabola: a coefficient that follows from another, and a name that Rust reserves.
        type Derived = r#type*e1 + r#type*r#type*e2;
        type Motor: unit + versor = [s, e12, e01, e20];
        type Translator: unit + versor = [s = 1, e01, e20];
        type Turn: unit + versor = [s, e12];
        type Even = [s, e12, e01, e20];
    }
}

/// Hyperbolic rotations, whose numbers grow without bound while they stay unit.
mod boosts {
    ga_physics::algebra! {
        pub algebra user_boosts;
        basis t = 1, x = -1;
        type Boost: unit + versor = [s, t_x];
        type Even = [s, t_x];
    }
}

/// Rotors that show every sign, and small and large numbers.
fn rotors() -> Vec<Rotor> {
    let axes = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.3, 0.4, -0.5], [1e-9, 1.0, -1e-200]];
    let angles = [0.0, 1e-12, 0.5, -2.0, core::f64::consts::PI, 6.0];
    let turn = |(axis, angle)| Rotor::from_axis_angle(Vector::from(axis), angle).unwrap();
    axes.into_iter().flat_map(|axis| angles.map(|angle| turn((axis, angle)))).collect()
}

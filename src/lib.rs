//! Geometric algebra with types and products generated at compile time, and a rigid-body simulator that stands on them.
//!
//! * [`mod@algebra`]: G(3,0) and the conformal algebra G(4,1) as fixed-size types with unrolled products, and
//!   [`algebra!`] to declare more; [`formula`] for whole formulas over any of them; the grade-tracked dynamic multivector
//!   that they replace.
//! * [`versor`]: rotors, translators, motors, dilators, conformal rotors; their exponentials, logarithms and interpolation.
//!   [`geometry`]: points, flats, rounds, meets, meshes.
//! * [`interop`]: the same things in the types of other crates.
//! * `ode`, `constraint`, `particle`, `rigid`, `collision`, `simulation` (feature `physics`): particles and bodies in
//!   motion.
//! * `io`, `scene`, `study`, `cli` (feature `cli`): what the command needs.
//!
//! A layer uses only the ones named before it.
//!
//! ```
//! use ga_physics::algebra::{cga::{Motor, Point}, g3::{Rotor, Vector}};
//! use ga_physics::geometry::{line_meets_plane, plane_through, sphere_through};
//!
//! // A quarter turn about z, then a metre up.
//! let turn = Rotor::from_axis_angle(Vector::new(0.0, 0.0, 1.0), std::f64::consts::FRAC_PI_2)?;
//! let motor = Motor::from_parts(Vector::new(0.0, 0.0, 1.0), turn);
//! let moved: Point = motor.apply(Point::new(1.0, 0.0, 0.0));
//! assert!(moved.distance_sq_to(Point::new(0.0, 1.0, 1.0)) < 1e-30);
//!
//! // Products are operators; the compiler knows the type of every result.
//! let corners: [[f64; 3]; 4] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]];
//! let [a, b, c, d] = corners.map(Point::from);
//! let circle = a ^ b ^ c;
//! let incidence = circle ^ d;
//! assert!(incidence.norm_sq() != 0.0, "d is not on the circle");
//!
//! // Checked constructions name what is degenerate.
//! let sphere = sphere_through(a, b, c, d)?;
//! assert!((sphere.radius()? - 1.0).abs() < 1e-15 && (Point::origin() | sphere) > 0.0);
//! let plane = plane_through(a, b, c)?;
//! let hit = line_meets_plane(Point::origin(), Point::new(1.0, 1.0, 1.0), plane)?;
//! assert!((hit.x - 1.0 / 3.0).abs() < 1e-15);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Conventions
//!
//! * SI units, right-handed axes. Angular quantities say their frame: `_world`, `_body`.
//! * Operators: `*` geometric, `^` outer, `|` left contraction, `&` meet, `undual(dual a ^ dual b)`. Rust's precedence is
//!   `*`, `+ -`, `&`, `^`, `|`: use brackets.
//! * Where `I² = 0` there is no dual, and `a & b` is the regressive product by complements: `c(a & b) = c(a) ^ c(b)` with
//!   `x ^ c(x) = I` for every basis blade x, so `I & a = a`. Metrics with both have `undual(dual a ^ dual b) = I² (b & a)`.
//!   Both take their orientation from the declared `pseudoscalar`; without one there is neither.
//! * Null basis: `no` the origin, `ninf` infinity, `no . ninf = -1`. Point `X = no + x + x²/2 ninf`, so
//!   `X . Y = -|x - y|²/2`, `X . ninf = -1`.
//! * `dual(M) = I M` with `I = -e123 (no ^ ninf)`, `I² = -1`; `undual(M) = -I M`. In G(3,0) `I = e123`.
//! * [`Sphere`](algebra::cga::Sphere) and [`Plane`](algebra::cga::Plane) are dual (vectors); line, circle, point pair and
//!   flat point are direct. Sphere: `X . s = (rho² - d²)/2`, positive *inside*. Plane `nu + delta ninf`:
//!   `X . pi = nu . x - delta`, positive on the side of the normal, *outside* a body. The two differ in sense.
//! * Versors: `R = exp(-B phi/2)`, `x' = R x ~R`; translator `T = 1 - t ninf/2`; dilator `exp(alpha/2 e ebar)` scales by
//!   `exp(-alpha)`; motor `M = T R`. The quaternion `w + x i + y j + z k` is the rotor `w - x e23 - y e31 - z e12`.
//! * Exponentials take the bivector itself: `exp(B)`. The motion with twist V, `Mdot = -1/2 V M`, is `exp(-V t/2)`. A versor
//!   and its negative move alike; `log` is that of the motion, the shorter way round, with a branch at a turn of pi.
//! * Bivectors are stored as (e23, e31, e12), which reads like the axial vector: `Omega = omega I3`.
//! * Motion: `v = x . Omega`, `L = x ^ (x . Omega)`, torque `r ^ F`, `Rdot = -1/2 Omega_world R = -1/2 R Omega_body`.
//! * Contacts: the normal points from a to b, the separation is negative on overlap, the impulse `+j n` acts on b.
//!
//! # Features
//!
//! `default-features = false` is `no_std` with `alloc`: algebra, versor, geometry. `physics` adds everything down to the
//! simulation and the standard library; `cli` (the default) adds files, scenes, the study and the command.
//!
//! For work with other crates, in any combination, none of them needs the standard library. `mint` is for the types of
//! this library, the others are for those of *every* [`algebra!`], also in your crate, which needs no dependency or feature of
//! its own for it:
//!
//! | feature | gives |
//! |---|---|
//! | `serde` | `Serialize`, `Deserialize`: a struct with the names of the fields; a unit type that is read is checked |
//! | `bytemuck` | `Pod`, `Zeroable`: slices of a type as bytes or numbers, for buffers of a GPU |
//! | `approx` | `AbsDiffEq`, `RelativeEq`, `UlpsEq`, coefficient by coefficient |
//! | `rand` | `rand::random()` and the like: uniform rotors, unit normals; numbers from 0 to 1 elsewhere |
//! | `mint` | conversions to and from `mint`, and so glam and most other mathematics crates |
//!
//! Arrays, `Display` and nalgebra's types are there in every build; see [`interop`].
//!
//! `wide`, `twofloat` and `num-dual` make SIMD lanes, double-double and dual numbers [scalars](algebra::Scalar). The first
//! two need no standard library.
//!
//! `parallel` spreads large nets of [`particle::xpbd`] over threads, with the same bits as on one; it implies `physics`.
#![cfg_attr(not(feature = "std"), no_std)]

extern crate alloc;
// Generated code names the library by this path, also within it.
extern crate self as ga_physics;

pub mod algebra;
#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "physics")]
pub mod collision;
#[cfg(feature = "physics")]
pub mod constraint;
pub mod geometry;
pub mod interop;
#[cfg(feature = "cli")]
pub mod io;
#[cfg(feature = "physics")]
pub mod ode;
#[cfg(feature = "physics")]
pub mod particle;
#[cfg(feature = "physics")]
pub mod rigid;
#[cfg(feature = "cli")]
pub mod scene;
#[cfg(feature = "physics")]
pub mod simulation;
#[cfg(feature = "cli")]
pub mod study;
pub mod versor;

pub use ga_macros::algebra;
/// A function over the types of an algebra, compiled as a whole.
///
/// ```
/// use ga_physics::algebra::cga;
/// use ga_physics::formula;
///
/// /// The sphere through four points.
/// #[formula(cga, local = a)]
/// pub fn circumsphere(a: Point, b: Point, c: Point, d: Point) -> Sphere {
///     (a ^ b ^ c ^ d).dual().normalised()
/// }
///
/// let [a, b, c, d] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]].map(cga::Point::from);
/// assert_eq!(circumsphere(a, b, c, d), cga::Sphere::new(0.0, 0.0, 0.0, 1.0));
/// ```
///
pub use ga_macros::formula;
#[doc(hidden)]
pub use ga_macros::{__algebra_with_base, __formula_with_spec};
/// The version whose types are converted from and to.
pub use nalgebra;

/// The examples of the README are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

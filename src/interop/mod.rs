//! Conversions to and from the types of other crates. Nothing else: what is computed, is computed in the layers below.
//!
//! # Arrays and slices
//!
//! Every generated type is `From` and `Into` the array of its stored numbers. With feature `bytemuck`, whole slices are
//! read in place:
//!
//! ```
//! # #[cfg(feature = "bytemuck")] {
//! use ga_physics::algebra::cga::Point;
//! let points = vec![Point::<f32>::new(1.0, 2.0, 3.0), Point::new(4.0, 5.0, 6.0)];
//! let numbers: &[f32] = bytemuck::cast_slice(&points);
//! assert_eq!(numbers, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
//! # }
//! ```
//!
//! Bytes are taken as they are: like arrays and struct literals, they are not checked for being unit.
//!
//! # nalgebra
//!
//! `Vector` and `Vector3`, `Point` and `Point3`, `Rotor` and `UnitQuaternion`, `Motor` or `Pose` and `Isometry3`, both ways by
//! `From`. The crate is re-exported, so that its version is the right one.
//!
//! ```
//! use ga_physics::algebra::g3::{Rotor, Vector};
//! use ga_physics::nalgebra::{UnitQuaternion, Vector3};
//!
//! let quaternion = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.5);
//! let rotor = Rotor::from(quaternion);
//! let (a, b) = (Vector3::new(1.0, 2.0, 3.0), Vector::new(1.0, 2.0, 3.0));
//! assert!((quaternion * a - Vector3::from(rotor.apply(b))).norm() < 1e-15);
//! ```
//!
//! A quaternion `w + x i + y j + z k` is the rotor `w - x e23 - y e31 - z e12`: signs change, so every number arrives
//! with its bits. A motor stores its translation multiplied into its rotor; translations of an isometry come back from
//! it within a few roundings of their length; a pose keeps them.
//!
//! # glam and others, by mint
//!
//! glam breaks its interface several times a year; `mint` does not. With feature `mint` here and glam's own (called
//! `mint-05` or `mint`, by version), each way is one line:
//!
//! ```
//! # #[cfg(feature = "mint")] {
//! use ga_physics::algebra::g3::{Rotor, Vector};
//! # let (turn, arrow) = (glam::DQuat::from_rotation_z(0.5), glam::DVec3::new(1.0, 2.0, 3.0));
//! let rotor = Rotor::try_from(mint::Quaternion::from(turn))?;
//! let moved = glam::DVec3::from(mint::Vector3::from(rotor.apply(Vector::from(mint::Vector3::from(arrow)))));
//! # assert!((moved - turn * arrow).length() < 1e-15);
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The quaternion of mint may have any norm, so that this conversion is checked: the error is `NotUnit`.
//!
//! # Files, by serde
//!
//! A type is a struct with the names of its fields: `{"s":1.0,"e23":0.0,"e31":0.0,"e12":0.0}`; formats that name nothing
//! store the numbers in order. Bits are kept as far as the format keeps them (`serde_json` needs its `float_roundtrip`). A unit type that is read is *checked*, because a
//! rotor of another norm would scale what it turns, and nobody would see it: a value is refused where `a ~a` is off from 1
//! by more than the square root of epsilon (1.5e-8 in f64, 3.5e-4 in f32), relative to the numbers it is made of. Versors that drifted through
//! millions of products pass; a quaternion typed with four digits does not. Read an `Even` in its place, and normalise
//! it. The scalar of a unit type that is read must be a [`Real`](crate::algebra::Real).
//!
//! # Random values
//!
//! With feature `rand` a type can be drawn from `StandardUniform`. Rotors are uniform over all rotations, the normals of
//! planes over all directions; translators, motors and poses move by numbers from 0 to 1 along each axis; every other number is
//! drawn from 0 to 1, as rand does for arrays. Dilators, and versors of an indefinite or degenerate metric, have no
//! distribution that everyone would expect, and no implementation.

#[cfg(feature = "mint")]
mod mint;
mod nalgebra;
#[cfg(feature = "rand")]
mod rand;

#[cfg(feature = "mint")]
pub use mint::NotUnit;

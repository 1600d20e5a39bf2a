//! Geometric algebra: the scalar traits, the two generated algebras, and the grade-tracked baseline that they replace.
//!
//! [`g3`] is G(3,0), [`cga`] the conformal algebra G(4,1), which extends it: a [`g3::Rotor`] *is* the rotor of both.
//! Their types and products are written by [`algebra!`](crate::algebra!) at compile time; each item's documentation
//! shows its formula and operation counts, printed from the same program as its code. The algebra knows no geometry.
//!
//! All of it is generic over [`Scalar`], f64 unless another number is named: f32, SIMD lanes, double-double, dual numbers,
//! intervals, or one of your own.

#[cfg_attr(feature = "bytemuck", allow(unsafe_code, reason = "repr(C), one scalar type, no padding: Pod; see support"))]
pub mod cga;
pub mod dynamic;
#[cfg_attr(feature = "bytemuck", allow(unsafe_code, reason = "repr(C), one scalar type, no padding: Pod; see support"))]
pub mod g3;
mod scalar;
pub mod split;
#[doc(hidden)]
pub mod support;

// The crates whose numbers are scalars, in the versions that are.
#[cfg(feature = "num-dual")]
pub use num_dual;
#[cfg(feature = "twofloat")]
pub use scalar::DoubleDouble;
pub use scalar::{Interval, NotAnInterval, Real, Scalar};
#[cfg(feature = "wide")]
pub use simba;
#[cfg(feature = "twofloat")]
pub use twofloat;

/// A versor that maps `x` to `v x ~v`.
///
/// Generated types call it through their inherent `apply`; the trait exists so that one versor applies to many types.
pub trait Apply<X> {
    /// The type of the image: that of `x` wherever it can hold it.
    type Output;
    /// `v x ~v`.
    fn apply(self, x: X) -> Self::Output;
}

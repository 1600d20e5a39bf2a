//! SIMD lanes as scalars, feature `wide`: several numbers that take every operation together.
//!
//! The types are simba's wrappers of `wide`: they bring comparison and selection by lane, and are scalars of nalgebra
//! too. Each lane holds bit for bit what the same code gives for f32 or f64 alone, because sums, products, quotients and
//! roots are correctly rounded and nothing is fused. Lanes have no order among themselves: code that branches does not
//! run on them, generated code does.
//!
//! Which registers are used is decided when the crate is compiled, see [`Scalar`]'s chapter on speed.

use super::Scalar;
use simba::simd::{WideF32x4, WideF32x8, WideF64x4};

macro_rules! lanes {
    ($($lanes:ident = [$float:ident; $count:literal];)*) => {$(
        impl Scalar for $lanes {
            #[inline]
            fn ratio(numerator: i32, denominator: i32) -> Self {
                [$float::ratio(numerator, denominator); $count].into()
            }
            #[inline]
            fn sqrt(self) -> Self {
                Self(self.0.sqrt())
            }
        }
    )*};
}

lanes! {
    WideF32x4 = [f32; 4];
    WideF32x8 = [f32; 8];
    WideF64x4 = [f64; 4];
}

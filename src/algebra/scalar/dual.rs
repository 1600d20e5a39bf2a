//! Dual numbers as scalars, feature `num-dual`: derivatives of generated code, exact up to rounding.
//!
//! The numbers are `num-dual`'s, over f32, f64 or again dual numbers: [`Dual`] carries one first derivative, [`Dual2`] a
//! second one, [`HyperDual`] a mixed one, [`DualVec`] a gradient, [`Dual2Vec`] a Hessian. A quotient is a product with
//! the reciprocal there, one rounding more than that of f64. At 0 the square root has no derivative and the quotient no
//! value: both give infinity or what is not a number, as in f64.

use super::Scalar;
use nalgebra::Const;
use num_dual::{Dual, Dual2, Dual2Vec, DualNum, DualVec, HyperDual};

macro_rules! dual {
    ($($number:ident<$part:ident $(, $size:ident)?>)*) => {$(
        impl<$part: DualNum + Scalar $(, const $size: usize)?> Scalar for $number<$part $(, Const<$size>)?> {
            #[inline]
            fn ratio(numerator: i32, denominator: i32) -> Self {
                Self::from_re($part::ratio(numerator, denominator))
            }
            #[inline]
            fn sqrt(self) -> Self {
                DualNum::sqrt(&self)
            }
        }
    )*};
}

dual!(Dual<D> Dual2<D> HyperDual<D> DualVec<D, N> Dual2Vec<D, N>);

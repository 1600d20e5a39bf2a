//! Products of multivectors of which nothing is known but their grades.

use super::numbers::{Multi, all, single};
use super::{Kernel, Way, inputs};
use crate::algebra::cga::{self, Even, Multivector};
use crate::algebra::dynamic::ToDynamic;
use crate::algebra::{Real, Scalar};

/// The product of two general multivectors: 32 coefficients each.
#[must_use]
pub fn general_product() -> Kernel {
    fn product<T: Scalar>((a, b): &(Multivector<T>, Multivector<T>)) -> Multivector<T> {
        *a * *b
    }
    let inputs = inputs::multivector_pairs();
    Kernel::new("multivector * multivector", "A B, 32 coefficients each")
        .with(Way::generated(&inputs, product, |m| all(&m.to_dynamic())))
        .with(Way::single(
            &inputs,
            |(a, b)| (a.map(single), b.map(single)),
            product,
            |m| all(&m.map(Real::to_f64).to_dynamic()),
        ))
        .with(Way::dynamic(
            &inputs,
            |(a, b)| [a.to_dynamic(), b.to_dynamic()],
            |[a, b]: &[Multi<cga::Algebra>; 2]| a * b,
            all,
        ))
}

/// The product of two even multivectors: 16 coefficients each.
#[must_use]
pub fn even_product() -> Kernel {
    fn product<T: Scalar>((a, b): &(Even<T>, Even<T>)) -> Even<T> {
        *a * *b
    }
    let inputs = inputs::even_pairs();
    Kernel::new("even * even", "A B, 16 coefficients each")
        .with(Way::generated(&inputs, product, |m| all(&m.to_dynamic())))
        .with(Way::single(
            &inputs,
            |(a, b)| (a.map(single), b.map(single)),
            product,
            |m| all(&m.map(Real::to_f64).to_dynamic()),
        ))
        .with(Way::dynamic(
            &inputs,
            |(a, b)| [a.to_dynamic(), b.to_dynamic()],
            |[a, b]: &[Multi<cga::Algebra>; 2]| a * b,
            all,
        ))
}

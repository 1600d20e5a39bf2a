//! Products of multivectors of which nothing is known but their grades, by the table of blades and in a split basis; and
//! what a conformal rotor does, in its split storage.

use super::numbers::{Multi, all, numbers, single};
use super::{Kernel, Way, inputs};
use crate::algebra::cga::{self, ConformalRotor, Even, Multivector, Point};
use crate::algebra::dynamic::ToDynamic;
use crate::algebra::{Real, Scalar, split};

/// The product of two general multivectors: 32 coefficients each.
#[must_use]
pub fn general_product() -> Kernel {
    fn product<T: Scalar>((a, b): &(Multivector<T>, Multivector<T>)) -> Multivector<T> {
        *a * *b
    }
    general("multivector * multivector", product, product)
}

/// The same in a split basis: fewer operations, less accurate where coefficients differ in size.
#[must_use]
pub fn general_product_split() -> Kernel {
    fn product<T: Scalar>((a, b): &(Multivector<T>, Multivector<T>)) -> Multivector<T> {
        split::multivector_product(*a, *b)
    }
    general("multivector * multivector, split", product, product)
}

/// The product of two even multivectors: 16 coefficients each.
#[must_use]
pub fn even_product() -> Kernel {
    fn product<T: Scalar>((a, b): &(Even<T>, Even<T>)) -> Even<T> {
        *a * *b
    }
    even("even * even", product, product)
}

/// The same in a split basis.
#[must_use]
pub fn even_product_split() -> Kernel {
    fn product<T: Scalar>((a, b): &(Even<T>, Even<T>)) -> Even<T> {
        split::even_product(*a, *b)
    }
    even("even * even, split", product, product)
}

fn general(
    name: &'static str,
    product: impl Fn(&(Multivector, Multivector)) -> Multivector + 'static,
    in_single: impl Fn(&(Multivector<f32>, Multivector<f32>)) -> Multivector<f32> + 'static,
) -> Kernel {
    let inputs = inputs::multivector_pairs();
    let widened = |m: &Multivector<f32>| all(&m.map(Real::to_f64).to_dynamic());
    Kernel::new(name, "A B, 32 coefficients each")
        .with(Way::generated(&inputs, product, |m| all(&m.to_dynamic())))
        .with(Way::single(&inputs, |(a, b)| (a.map(single), b.map(single)), in_single, widened))
        .with(Way::dynamic(&inputs, |(a, b)| [a.to_dynamic(), b.to_dynamic()], dynamic_product, all))
}

fn even(
    name: &'static str,
    product: impl Fn(&(Even, Even)) -> Even + 'static,
    in_single: impl Fn(&(Even<f32>, Even<f32>)) -> Even<f32> + 'static,
) -> Kernel {
    let inputs = inputs::even_pairs();
    let widened = |m: &Even<f32>| all(&m.map(Real::to_f64).to_dynamic());
    Kernel::new(name, "A B, 16 coefficients each")
        .with(Way::generated(&inputs, product, |m| all(&m.to_dynamic())))
        .with(Way::single(&inputs, |(a, b)| (a.map(single), b.map(single)), in_single, widened))
        .with(Way::dynamic(&inputs, |(a, b)| [a.to_dynamic(), b.to_dynamic()], dynamic_product, all))
}

/// The product of two conformal rotors, stored split on the null pair.
#[must_use]
pub fn conformal_times_conformal() -> Kernel {
    fn product<T: Scalar>((a, b): &(ConformalRotor<T>, ConformalRotor<T>)) -> ConformalRotor<T> {
        *a * *b
    }
    let inputs = inputs::conformal_pairs();
    let widened = |v: &ConformalRotor<f32>| all(&v.map(Real::to_f64).to_dynamic());
    Kernel::new("conformal rotor * conformal rotor", "V W")
        .with(Way::generated(&inputs, product, |v| all(&v.to_dynamic())))
        .with(Way::single(&inputs, |(a, b)| (a.map(single), b.map(single)), product, widened))
        .with(Way::dynamic(&inputs, |(a, b)| [a.to_dynamic(), b.to_dynamic()], dynamic_product, all))
}

/// A conformal rotor on a normalised point, normalised again.
#[must_use]
pub fn conformal_on_point() -> Kernel {
    fn image<T: Scalar>((v, x): &(ConformalRotor<T>, Point<T>)) -> Point<T> {
        v.apply(*x)
    }
    let inputs = inputs::conformals_and_points();
    Kernel::new("conformal rotor on point", "V X ~V, normalised")
        .with(Way::generated(&inputs, image, |x| numbers::<_, _, 3>(*x)))
        .with(Way::single(&inputs, |(v, x)| (v.map(single), x.map(single)), image, |x| numbers::<_, _, 3>(*x)))
        .with(Way::dynamic(
            &inputs,
            |(v, x)| [v.to_dynamic(), x.to_dynamic()],
            |[v, x]: &[Multi<cga::Algebra>; 2]| v.apply(x),
            super::numbers::point_of,
        ))
}

fn dynamic_product([a, b]: &[Multi<cga::Algebra>; 2]) -> Multi<cga::Algebra> {
    a * b
}

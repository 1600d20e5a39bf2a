//! The laws that all scalars obey: results within the rounding of each type of the exact ones.

use crate::Random;
use crate::exact::{Bounded, Exact, rational};
use crate::kernels::{INPUTS, Results, polynomials, quotients};
use ga_physics::algebra::num_dual::{Dual, Dual2, Dual2Vec, Dual64, DualSVec64, HyperDual64};
use ga_physics::algebra::simba::simd::{WideF32x4, WideF32x8, WideF64x4};
use ga_physics::algebra::{DoubleDouble, Interval, Scalar};
use nalgebra::Const;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};

/// A scalar under test.
pub(crate) trait Tested: Scalar {
    /// The relative error of one operation is at most this.
    const ROUNDOFF: f64;
    /// Inputs of about 1 are also taken times 2 to this power, and divided by it: as far as the type keeps its precision
    /// in sixth powers. Beyond 2^28 the power is made in steps of 28 bits.
    const SCALE: u32;
    /// All numbers in it that claim to be the result: each lane, both ends.
    fn values(self) -> Vec<BigRational>;
}

/// Half an epsilon.
const SINGLE: f64 = f32::EPSILON as f64 / 2.0;
const DOUBLE: f64 = f64::EPSILON / 2.0;

macro_rules! tested {
    ($($number:ty: $roundoff:expr, $scale:literal, $values:expr;)*) => {$(
        impl Tested for $number {
            const ROUNDOFF: f64 = $roundoff;
            const SCALE: u32 = $scale;
            fn values(self) -> Vec<BigRational> {
                let values: fn(Self) -> Vec<f64> = $values;
                values(self).into_iter().map(rational).collect()
            }
        }
    )*};
}

tested! {
    f32: SINGLE, 12, |x| vec![x.into()];
    f64: DOUBLE, 140, |x| vec![x];
    WideF32x4: SINGLE, 12, |x| x.into_arr().map(f64::from).into();
    WideF32x8: SINGLE, 12, |x| x.into_arr().map(f64::from).into();
    WideF64x4: DOUBLE, 140, |x| x.into_arr().into();
    // The quotient is a product with a rounded reciprocal.
    Dual64: 2.0 * DOUBLE, 140, |x| vec![x.re];
    Dual<Dual64>: 2.0 * DOUBLE, 140, |x| vec![x.re.re];
    Dual2<f64>: 2.0 * DOUBLE, 140, |x| vec![x.re];
    HyperDual64: 2.0 * DOUBLE, 140, |x| vec![x.re];
    DualSVec64<3>: 2.0 * DOUBLE, 140, |x| vec![x.re];
    Dual2Vec<f64, Const<3>>: 2.0 * DOUBLE, 140, |x| vec![x.re];
    // Half an ulp of rounding and the step to the next number; an ulp is at most two units.
    Interval: 3.0 * DOUBLE, 140, |x| vec![x.inf(), x.sup()];
}

impl Tested for DoubleDouble {
    /// The worst is the quotient: 15 u² and terms in u³.
    const ROUNDOFF: f64 = 16.0 * DOUBLE * DOUBLE;
    const SCALE: u32 = 112;
    fn values(self) -> Vec<BigRational> {
        vec![rational(self.0.hi()) + rational(self.0.lo())]
    }
}

/// Covers the terms of second order, where a divisor is off by no more than a thousandth.
const SECOND_ORDER: f64 = 1.01;
const WORST_DIVISOR: f64 = 1e-3;

/// How many numbers were compared, and how many left out because the divisor was off too far.
#[derive(Default)]
struct Count {
    compared: usize,
    left_out: usize,
}

fn compare<T: Tested>(count: &mut Count, results: Results<T>, exact: Results<Exact>, bounds: Results<Bounded>) {
    for (((name, values), (_, exact)), (_, bounds)) in results.into_iter().zip(exact).zip(bounds) {
        for ((value, exact), bound) in values.into_iter().zip(exact).zip(bounds) {
            if bound.worst_divisor * T::ROUNDOFF > WORST_DIVISOR {
                count.left_out += 1;
                continue;
            }
            let limit = SECOND_ORDER * T::ROUNDOFF * bound.units;
            for value in value.values() {
                let error = (&value - exact.0).abs().to_f64().unwrap();
                assert!(error <= limit, "{name}: off by {error:e}, allowed {limit:e}, of {:e}", bound.value);
                count.compared += 1;
            }
        }
    }
}

/// `p / q * 2^(sign * bits)`, from the type's own constants.
fn input<T: Scalar>([p, q]: [i32; 2], sign: i32, bits: u32) -> T {
    let step = bits.min(28);
    let power = if sign < 0 { T::ratio(1, 1 << step) } else { T::ratio(1 << step, 1) };
    let steps = if sign == 0 { 0 } else { bits / step };
    (0..steps).fold(T::ratio(p, q), |product, _| product * power)
}

fn ratio(random: &mut Random) -> [i32; 2] {
    let p = random.integer(98);
    [if p < 0 { p } else { p + 1 }, 1 + random.integer(4).abs()]
}

fn agrees_with_exact_results<T: Tested>() {
    let (mut random, mut count) = (Random(1), Count::default());
    for sign in [-1, 0, 1] {
        for _ in 0..8 {
            let ratios = [(); INPUTS].map(|()| ratio(&mut random));
            let values = ratios.map(|ratio| input::<T>(ratio, sign, T::SCALE));
            let exact = ratios.map(|ratio| input::<Exact>(ratio, sign, T::SCALE));
            let bounds = ratios.map(|ratio| input::<Bounded>(ratio, sign, T::SCALE));
            compare(&mut count, polynomials(&values), polynomials(&exact), polynomials(&bounds));
            compare(&mut count, quotients(&values), quotients(&exact), quotients(&bounds));
        }
    }
    let Count { compared, left_out } = count;
    assert!(compared > 2000 && 20 * left_out < compared, "{compared} compared, {left_out} left out");
}

/// The square of a root is exact to compare, the root is not.
fn squares_of_roots_are_the_numbers<T: Tested>() {
    let mut random = Random(2);
    for sign in [-1, 0, 1] {
        for _ in 0..50 {
            let number = ratio(&mut random).map(i32::abs);
            let exact = input::<Exact>(number, sign, T::SCALE).0;
            let bound = input::<Bounded>(number, sign, T::SCALE);
            // The error of the number, and twice that of the root.
            let limit = SECOND_ORDER * T::ROUNDOFF * (bound.units + 2.0 * bound.value);
            for root in Scalar::sqrt(input::<T>(number, sign, T::SCALE)).values() {
                let error = (&root * &root - exact).abs().to_f64().unwrap();
                assert!(error <= limit, "the root of {}: its square is off by {error:e} of {limit:e}", bound.value);
            }
        }
    }
}

fn constants_are_exact_where_they_can_be<T: Tested>() {
    for (p, q) in [(0, 1), (1, 1), (-1, 1), (1, 2), (-3, 4), (6, 3), (-6, -4), (5, -8), (1 << 20, 1), (0, 7)] {
        for value in T::ratio(p, q).values() {
            assert_eq!(&value, Exact::ratio(p, q).0, "{p} / {q}");
        }
    }
}

macro_rules! instantiate {
    ($($name:ident: $number:ty;)*) => {$(
        #[test]
        fn $name() {
            agrees_with_exact_results::<$number>();
            squares_of_roots_are_the_numbers::<$number>();
            constants_are_exact_where_they_can_be::<$number>();
        }
    )*};
}

instantiate! {
    single: f32;
    double: f64;
    four_singles: WideF32x4;
    eight_singles: WideF32x8;
    four_doubles: WideF64x4;
    dual: Dual64;
    dual_of_dual: Dual<Dual64>;
    second_dual: Dual2<f64>;
    hyper_dual: HyperDual64;
    gradient: DualSVec64<3>;
    hessian: Dual2Vec<f64, Const<3>>;
    interval: Interval;
    double_double: DoubleDouble;
}

//! A lane holds what the same code gives for the number alone, bit for bit, on any input.

use crate::Random;
use crate::kernels::{INPUTS, polynomials, quotients, roots};
use ga_physics::algebra::Scalar;
use ga_physics::algebra::cga::{Point, Sphere};
use ga_physics::algebra::simba::simd::{SimdPartialOrd, SimdValue, WideF32x4, WideF32x8, WideF64x4};

/// Numbers of all sizes and kinds: any bits at all, numbers about 1, and the ends of the range.
fn nasty(random: &mut Random) -> f64 {
    const ENDS: [f64; 10] =
        [0.0, -0.0, 1.0, 5e-324, 2.3e-308, f64::MAX, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1.0 + f64::EPSILON];
    match random.bits() % 8 {
        0 => f64::from_bits(random.bits()),
        1 => ENDS[usize::try_from(random.bits() % 10).unwrap()],
        2 => f64::from(random.integer(3)),
        _ => random.signed() * 1000.0,
    }
}

macro_rules! bit_for_bit {
    ($($name:ident: $lanes:ident = [$float:ident; $count:literal], $read:expr;)*) => {$(
        #[test]
        fn $name() {
            let (mut random, mut finite) = (Random(3), 0);
            let read: fn(u64, f64) -> $float = $read;
            // Half of the rounds are free of special numbers, so that results are numbers too.
            for round in 0..400 {
                let inputs = [(); INPUTS].map(|()| [(); $count].map(|()| {
                    let any = nasty(&mut random);
                    read(random.bits(), if round % 2 == 0 { random.signed() } else { any })
                }));
                let lanes = inputs.map($lanes::from);
                for lane in 0..$count {
                    let alone = inputs.map(|input| input[lane]);
                    let together = [polynomials(&lanes), quotients(&lanes), roots(&lanes)].concat();
                    let alone = [polynomials(&alone), quotients(&alone), roots(&alone)].concat();
                    for ((name, together), (_, alone)) in together.into_iter().zip(alone) {
                        for (together, alone) in together.into_iter().zip(alone) {
                            let together = together.into_arr()[lane];
                            let same = together.to_bits() == alone.to_bits() || together.is_nan() && alone.is_nan();
                            assert!(same, "{name}, lane {lane}: {together:e}, alone {alone:e}");
                            finite += usize::from(alone.is_finite());
                        }
                    }
                }
            }
            assert!(finite > 20_000, "only {finite} results were numbers");
        }
    )*};
}

#[allow(clippy::cast_possible_truncation, reason = "the wanted rounding, and half of the bits")]
fn single(bits: u64, value: f64) -> f32 {
    // An f64 of any size is mostly 0 or infinite in f32: half of those take any bits of an f32.
    if value.abs() > 1e4 && bits.is_multiple_of(2) { f32::from_bits((bits >> 32) as u32) } else { value as f32 }
}

bit_for_bit! {
    four_singles: WideF32x4 = [f32; 4], single;
    eight_singles: WideF32x8 = [f32; 8], single;
    four_doubles: WideF64x4 = [f64; 4], |_, value| value;
}

#[test]
fn lanes_are_compared_and_selected_one_by_one() {
    let sphere = Sphere::new(0.0, 0.0, 0.0, 1.0).map(WideF64x4::splat);
    // Inside, outside, on the sphere, and not a number.
    let points = [[0.5, 0.5, 0.5], [1.0, 1e-8, 0.0], [1.0, 0.0, 0.0], [f64::NAN, 0.0, 0.0]].map(Point::from);
    let packed = Point::from_fn(|field| points.map(|point| <[f64; 3]>::from(point)[field]).into());
    let inner = packed | sphere;
    let inside = inner.simd_gt(WideF64x4::ratio(0, 1));
    let chosen = WideF64x4::splat(1.0).select(inside, WideF64x4::splat(-1.0));
    assert_eq!(chosen.into_arr(), [1.0, -1.0, -1.0, -1.0]);
    for (lane, point) in points.into_iter().enumerate() {
        let alone = point | Sphere::new(0.0, 0.0, 0.0, 1.0);
        assert_eq!(inner.extract(lane).to_bits() & !(1 << 63), alone.to_bits() & !(1 << 63), "lane {lane}");
    }
}

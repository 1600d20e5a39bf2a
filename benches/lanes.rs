//! SIMD lanes against the same code on one number at a time, one source for both.
//!
//! ```sh
//! flags="-C no-vectorize-loops -C no-vectorize-slp"
//! RUSTFLAGS="$flags" cargo bench --bench lanes                                # 128-bit registers
//! RUSTFLAGS="$flags -C target-cpu=x86-64-v3" cargo bench --bench lanes        # 256-bit registers, AVX2
//! ```
//!
//! The flags keep the compiler from vectorising the loop over single numbers, which would compare lanes with lanes;
//! lanes ask for their instructions by name and are not touched by them. Without the flags the table shows what lanes
//! add to the compiler's own attempt.
//!
//! One item is a sandwich `R x ~R` or `M X ~M` with its own versor, or one point against a sphere shared by all. The
//! items of one lane type lie in an array of structs of lanes, so that a load fills a register and nothing is shuffled;
//! all data fit the first-level cache. The results of all types are compared bit by bit before anything is timed.
#![allow(missing_docs, reason = "the macro's main function has no place for them")]
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use criterion::{Criterion, Throughput, criterion_group};
use ga_physics::algebra::cga::{Motor, Point, Sphere};
use ga_physics::algebra::g3::{Rotor, Vector};
use ga_physics::algebra::simba::simd::{SimdPartialOrd, SimdValue, WideF32x4, WideF32x8, WideF64x4};
use ga_physics::algebra::{Real, Scalar};
use ga_physics::study::timing::{Effort, Timing, measure};
use std::cell::RefCell;
use std::hint::black_box;
use std::time::Duration;

/// Items of a pass: those of the motor take 28 KB in f64.
const ITEMS: usize = 256;

/// What the kernels ask for, of lanes and of single numbers: simba counts f32 and f64 as one lane.
trait Lanes: Scalar + SimdPartialOrd + SimdValue<Element: Real> {}
impl<T: Scalar + SimdPartialOrd + SimdValue<Element: Real>> Lanes for T {}

#[inline(never)]
fn turn<T: Lanes>(rotors: &[Rotor<T>], vectors: &[Vector<T>], images: &mut [Vector<T>]) {
    for ((rotor, vector), image) in rotors.iter().zip(vectors).zip(images) {
        *image = rotor.apply(*vector);
    }
}

#[inline(never)]
fn displace<T: Lanes>(motors: &[Motor<T>], points: &[Point<T>], images: &mut [Point<T>]) {
    for ((motor, point), image) in motors.iter().zip(points).zip(images) {
        *image = motor.apply(*point);
    }
}

/// 1 for each point inside, 0 for the others.
#[inline(never)]
fn inside<T: Lanes>(sphere: &Sphere<T>, points: &[Point<T>], marks: &mut [T]) {
    let (yes, no) = (T::ratio(1, 1), T::ratio(0, 1));
    for (point, mark) in points.iter().zip(marks) {
        *mark = yes.select((*point | *sphere).simd_gt(no), no);
    }
}

/// A number in -1 .. 1 for each item and field: SplitMix64.
fn number(item: usize, field: usize) -> f64 {
    let mut z = ((32 * item + field + 1) as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// The field of as many items as there are lanes, from item `LANES * index` on: this is all that packing takes.
fn pack<T: Lanes>(index: usize, field: usize) -> T {
    let mut lanes = T::splat(T::Element::zero());
    for lane in 0..T::LANES {
        lanes.replace(lane, T::Element::from_f64(number(T::LANES * index + lane, field)));
    }
    lanes
}

/// Item by item, the numbers of the results.
fn unpack<T: Lanes, const N: usize>(results: impl IntoIterator<Item = [T; N]>) -> Vec<f64> {
    let items = |packed: [T; N]| (0..T::LANES).flat_map(move |lane| packed.map(|field| field.extract(lane).to_f64()));
    results.into_iter().flat_map(items).collect()
}

/// A kernel on one type of number: its results, and a pass over all items.
struct Way {
    name: &'static str,
    results: Vec<f64>,
    pass: Box<dyn Fn()>,
}

impl Way {
    /// `kernel` overwrites all of `output`.
    fn new<R: Copy + 'static, T: Lanes, const N: usize>(
        name: &'static str,
        mut output: Vec<R>,
        kernel: impl Fn(&mut [R]) + 'static,
    ) -> Self
    where
        [T; N]: From<R>,
    {
        kernel(&mut output);
        let results = unpack(output.iter().map(|result| <[T; N]>::from(*result)));
        let output = RefCell::new(output);
        let pass = move || kernel(black_box(output.borrow_mut().as_mut_slice()));
        Self { name, results, pass: Box::new(pass) }
    }
}

const KERNELS: [&str; 3] = ["rotor sandwich", "motor sandwich", "point in sphere"];

/// The three kernels on one type.
fn ways<T: Lanes>(name: &'static str) -> [Way; 3] {
    let indices = || 0..ITEMS / T::LANES;
    let rotors: Vec<_> = indices().map(|index| Rotor::from_fn(|field| pack::<T>(index, field))).collect();
    let vectors: Vec<_> = indices().map(|index| Vector::from_fn(|field| pack::<T>(index, 8 + field))).collect();
    let motors: Vec<_> = indices().map(|index| Motor::from_fn(|field| pack::<T>(index, field))).collect();
    let points: Vec<_> = indices().map(|index| Point::from_fn(|field| pack::<T>(index, 8 + field))).collect();
    let to_test = points.clone();
    let sphere = Sphere::new(0.125, -0.25, 0.5, 0.75).map(|x| T::splat(T::Element::from_f64(x)));
    [
        Way::new::<_, T, 3>(name, vectors.clone(), move |images| {
            turn(black_box(rotors.as_slice()), black_box(vectors.as_slice()), images);
        }),
        Way::new::<_, T, 3>(name, points.clone(), move |images| {
            displace(black_box(motors.as_slice()), black_box(points.as_slice()), images);
        }),
        Way::new::<[T; 1], T, 1>(name, vec![[T::ratio(0, 1)]; ITEMS / T::LANES], move |marks| {
            inside(black_box(&sphere), black_box(to_test.as_slice()), marks.as_flattened_mut());
        }),
    ]
}

/// For each precision, single numbers first: `[precision][type][kernel]`.
fn rivals() -> [Vec<[Way; 3]>; 2] {
    let rivals = [
        vec![ways::<f32>("f32"), ways::<WideF32x4>("f32x4"), ways::<WideF32x8>("f32x8")],
        vec![ways::<f64>("f64"), ways::<WideF64x4>("f64x4")],
    ];
    for precision in &rivals {
        for (kernel, name) in KERNELS.iter().enumerate() {
            for lanes in precision {
                assert_eq!(lanes[kernel].results.len() % ITEMS, 0, "{name}: results are missing");
                let equal = lanes[kernel].results == precision[0][kernel].results;
                assert!(equal, "{name}: {} differs from {}", lanes[kernel].name, precision[0][kernel].name);
            }
        }
    }
    let inside: f64 = rivals[1][0][2].results.iter().sum();
    assert!(0.1 < inside / ITEMS as f64 && inside / (ITEMS as f64) < 0.9, "{inside} points inside tell nothing");
    rivals
}

fn lanes(criterion: &mut Criterion) {
    for precision in rivals() {
        for (kernel, name) in KERNELS.iter().enumerate() {
            let mut group = criterion.benchmark_group(*name);
            group.throughput(Throughput::Elements(ITEMS as u64));
            for lanes in &precision {
                group.bench_function(lanes[kernel].name, |bencher| bencher.iter(|| (lanes[kernel].pass)()));
            }
            group.finish();
        }
    }
}

/// The ratios, from the study's interleaved timer: criterion times one rival after the other.
fn table() {
    println!(
        "\n{:16} {:6} {:>10} {:>7}   times as fast as one by one [95 %]",
        "kernel", "type", "ns an item", "spread"
    );
    for precision in rivals() {
        for (kernel, name) in KERNELS.iter().enumerate() {
            let passes: Vec<&dyn Fn()> = precision.iter().map(|lanes| &*lanes[kernel].pass).collect();
            let samples = measure(&passes, ITEMS, Effort::FULL);
            for (rival, lanes) in precision.iter().enumerate() {
                let Timing { median_ns, spread, .. } = samples.timing(rival);
                let ratio = samples.ratio(0, rival);
                println!(
                    "{name:16} {:6} {median_ns:10.3} {:6.1}%   {:.2} [{:.2}, {:.2}]",
                    lanes[kernel].name,
                    100.0 * spread,
                    ratio.value,
                    ratio.low,
                    ratio.high
                );
            }
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(50)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1200));
    targets = lanes
}

fn main() {
    benches();
    Criterion::default().configure_from_args().final_summary();
    // As a test (`cargo test --benches`) or with a filter, the table is not what was asked for.
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments == ["--bench"] {
        table();
    }
}

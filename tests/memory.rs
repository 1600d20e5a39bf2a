//! What the two representations take from the heap, and how large the generated types are.
//!
//! A dynamic result is one block of known size, whatever the operation; a generated one is none at all.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use ga_physics::algebra::dynamic::{Dynamic, ToDynamic};
use ga_physics::algebra::{cga, g3};
use ga_physics::geometry::formulas;
use ga_physics::ode::{Adaptive, Crossing, Dop853, Event, Fixed, Rk4, Stepper, Tolerance, Watch};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use std::cell::RefCell;
use std::hint::black_box;
use std::sync::{Mutex, PoisonError};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// The counters are the process's: one measurement at a time.
static MEASURING: Mutex<()> = Mutex::new(());

/// Blocks and bytes that a call takes from the heap. The test harness may allocate on its own thread meanwhile, which
/// only adds: so the least of many calls is that of the call.
fn heap_use<R>(call: impl Fn() -> R) -> (usize, usize) {
    let _one_at_a_time = MEASURING.lock().unwrap_or_else(PoisonError::into_inner);
    let uses = (0..100).map(|_| {
        let region = Region::new(ALLOCATOR);
        let result = black_box(call());
        let change = region.change();
        drop(result);
        (change.allocations + change.reallocations, change.bytes_allocated)
    });
    uses.min().unwrap()
}

fn motor() -> cga::Motor {
    cga::Translator::new(-1.0, 2.0, -4.0) * g3::Rotor::new(0.5, 0.5, -0.5, 0.5)
}

fn one_block(name: &str, call: impl Fn() -> Dynamic<cga::Algebra, f64>) {
    let result = call();
    assert_eq!(heap_use(call), (1, result.heap_bytes()), "{name}: {result:?}");
}

#[test]
fn a_dynamic_result_is_one_block_of_known_size() {
    let (m, x) = (motor().to_dynamic(), cga::Point::new(1.0, 2.0, 3.0).to_dynamic());
    one_block("product", || &m * &m);
    one_block("outer product", || &x ^ &m);
    one_block("left contraction", || &x | &m);
    one_block("sum", || &x + &m);
    one_block("negation", || -&m);
    one_block("reverse", || m.rev());
    one_block("grade", || m.grade(2));
    one_block("dual", || m.dual().unwrap());
    one_block("scaled", || m.scaled(2.0));
    one_block("sandwich", || m.apply(&x));
    one_block("conversion", || motor().to_dynamic());
}

#[test]
fn a_block_holds_the_present_coefficients_and_two_counts() {
    // In the orthonormal basis `ei ninf = ei e + ei ebar`: a motor has 1 + 3 + 6 + 2 coefficients there, a point 3 + 2.
    let (m, x) = (motor().to_dynamic(), cga::Point::new(1.0, 2.0, 3.0).to_dynamic());
    assert_eq!(m.heap_bytes(), 16 + 12 * 8);
    assert_eq!(x.heap_bytes(), 16 + 5 * 8);
    // Single precision: an odd count is padded to a whole word.
    let single = || cga::Point::<f32>::new(1.0, 2.0, 3.0).to_dynamic();
    assert_eq!(heap_use(single), (1, single().heap_bytes()));
    assert_eq!(single().heap_bytes(), 16 + 24);
    // A clone shares the block.
    assert_eq!(heap_use(|| m.clone()), (0, 0));
}

#[test]
fn generated_operations_take_nothing_from_the_heap() {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(cga::Point::<f64>::from);
    let [a, b, c, d] = points;
    let (m, line) = (motor(), (a ^ b) ^ cga::Infinity);
    let plane = cga::Plane::new(1.0, 0.0, 0.0, 0.5);
    assert_eq!(heap_use(|| m * m), (0, 0));
    assert_eq!(heap_use(|| m.apply(b)), (0, 0));
    assert_eq!(heap_use(|| formulas::circumsphere(a, b, c, d)), (0, 0));
    assert_eq!(heap_use(|| plane | line), (0, 0));
    assert_eq!(heap_use(|| cga::dual(line)), (0, 0));
    assert_eq!(heap_use(|| cga::Even::from(m) * cga::Even::from(m)), (0, 0));
    // The counter counts.
    assert_eq!(heap_use(|| vec![1_u8; 77]), (1, 77));
}

/// A step of any integrator, with dense output, takes nothing from the heap.
#[test]
fn steps_take_nothing_from_the_heap() {
    let mut oscillator = |_: f64, y: &Vec<f64>, rate: &mut Vec<f64>| (rate[0], rate[1]) = (y[1], -y[0]);
    let (start, tolerance) = (vec![1.0, 0.0], Tolerance { rtol: 1e-9, atol: 1e-9 });
    let mut adaptive = Adaptive::<Dop853, _, _>::new(0.0, start.clone(), start.clone(), tolerance).unwrap();
    let mut fixed = Fixed::<Rk4, _, f64>::new(0.0, start.clone(), start.clone(), 0.1).unwrap();
    let mut watch = Watch::new(0.0, [Event::new(Crossing::Either, |_, y: &Vec<f64>| y[0])]);
    let (mut out, mut frame) = (start, 0.0);
    let step = || {
        frame += 0.75;
        adaptive.advance_watching(&mut oscillator, frame, &mut watch, &mut out, &mut |_, _| ()).unwrap();
        fixed.advance_to(&mut oscillator, frame, &mut out).unwrap();
    };
    let step = RefCell::new(step);
    assert_eq!(heap_use(|| step.borrow_mut()()), (0, 0));
}

/// Types are their stored numbers and nothing else.
#[test]
fn sizes_are_those_of_the_stored_numbers() {
    macro_rules! numbers {
        ($($ty:ident::$name:ident $count:literal)*) => {$(
            assert_eq!(size_of::<$ty::$name>(), 8 * $count, stringify!($name));
            assert_eq!(size_of::<$ty::$name<f32>>(), 4 * $count, stringify!($name));
            assert_eq!(align_of::<$ty::$name<f32>>(), 4, stringify!($name));
        )*};
    }
    numbers! {
        g3::Vector 3 g3::Bivector 3 g3::Trivector 1 g3::Rotor 4 g3::Even 4 g3::Odd 4 g3::Multivector 8
        cga::Point 3 cga::Sphere 4 cga::Plane 4 cga::FinitePoint 3 cga::FlatPoint 4 cga::Round 5 cga::Translator 3 cga::Dilator 2 cga::Pose 7 cga::ConformalRotor 16
        cga::DualLine 6 cga::Line 6 cga::Twist 6 cga::PointPair 10 cga::Circle 10 cga::DirectPlane 4
        cga::DirectSphere 5 cga::Pseudoscalar 1 cga::Motor 8 cga::Even 16 cga::Odd 16 cga::Multivector 32
    }
    assert_eq!((size_of::<cga::Infinity>(), size_of::<cga::Origin>()), (0, 0));
}

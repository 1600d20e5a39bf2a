//! After the first step nothing is taken from the heap.

use crate::systems::{Dice, System};
use ga_physics::constraint::{Method, Multipliers, Stop};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System as Heap;

#[global_allocator]
static ALLOCATOR: &StatsAlloc<Heap> = &INSTRUMENTED_SYSTEM;

/// Other tests allocate meanwhile, which only adds: one step among many that sees no allocation makes none itself.
fn some_step_takes_nothing(mut step: impl FnMut()) -> bool {
    (0..10_000).any(|_| {
        let region = Region::new(ALLOCATOR);
        step();
        let change = region.change();
        change.allocations + change.reallocations == 0
    })
}

#[test]
fn steps_take_nothing_from_the_heap() {
    // Redundant rows too, and a step that is not even converged.
    for mut system in [System::chain(2), System::net(4, 0.3), System::net(4, 0.0)] {
        for method in [Method::Direct, Method::ConjugateGradients(Stop::tight(30))] {
            let (mut rows, w) = (system.rows(), system.inv_mass.clone());
            let mut multipliers = Multipliers::new(&rows, w.as_slice(), method);
            let (b, mut lambda) = (vec![0.0; rows.len()], vec![0.0; rows.len()]);
            let mut dice = Dice(4);
            assert!(some_step_takes_nothing(|| {
                system.shake(1e-4, &mut dice);
                let _ = multipliers.project(&mut rows, w.as_slice(), &mut system, 1e-12);
                multipliers.freeze(&rows, w.as_slice()).unwrap();
                multipliers.velocity_change(w.as_slice(), |k| [k as f64; 3]).unwrap();
                multipliers.solve(w.as_slice(), &b, &mut lambda).unwrap();
            }));
        }
    }
    // The counter counts.
    assert!(!some_step_takes_nothing(|| drop(std::hint::black_box(vec![1_u8; 77]))));
}

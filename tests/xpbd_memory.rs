//! What a net takes from the heap. Alone in its binary: the counters are the process's.
#![cfg(feature = "physics")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::Vector;
use ga_physics::particle::xpbd::{Substeps, Xpbd};
use ga_physics::particle::{Constraint, Particles};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, Stats, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const SIDE: usize = 100;

fn kept(change: Stats) -> usize {
    change.bytes_allocated - change.bytes_deallocated
}

/// Bytes of state, of the constraints, and what a step takes.
fn bytes() -> (usize, usize, usize) {
    let region = Region::new(ALLOCATOR);
    let mut particles =
        Particles { position: Vec::with_capacity(SIDE * SIDE), velocity: Vec::with_capacity(SIDE * SIDE) };
    for index in 0..SIDE * SIDE {
        let (column, row) = ((index % SIDE) as f64, (index / SIDE) as f64);
        particles.push(Point::new(0.1 * column, 0.0, -0.1 * row), Vector::default());
    }
    let inv_mass: Vec<f64> = (0..SIDE * SIDE).map(|index| if index < SIDE { 0.0 } else { 100.0 }).collect();
    let state = kept(region.change());
    let along = (0..SIDE * SIDE - 1).filter(|a| a % SIDE + 1 < SIDE).map(|a| (a, a + 1));
    let across = (0..SIDE * (SIDE - 1)).map(|a| (a, a + SIDE));
    let hold = |(a, b)| Constraint::Distance { a, b, length: 0.1 };
    let constraints: Vec<Constraint> = along.chain(across).map(hold).collect();
    let region = Region::new(ALLOCATOR);
    let mut xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
    let made = kept(region.change());
    let region = Region::new(ALLOCATOR);
    let substeps = Substeps { dt_s: 1.0 / 60.0, count: 2, violation: 1e-3 };
    xpbd.step(&mut particles, &inv_mass, &substeps, Vector::new(0.0, 0.0, -9.81));
    (state, made, region.change().bytes_allocated)
}

#[test]
fn a_net_takes_56_bytes_a_particle_and_17_a_link_and_a_step_takes_none() {
    // The harness may allocate on its own thread meanwhile, which only adds: the least of several is that of the calls.
    let several: Vec<_> = (0..5).map(|_| bytes()).collect();
    let least = |of: fn(&(usize, usize, usize)) -> usize| several.iter().map(of).min().unwrap();
    assert_eq!(least(|bytes| bytes.0), 56 * SIDE * SIDE);
    assert_eq!(Particles::<f64>::bytes_per_particle(), 56);
    // Distances between two fixed particles are left out.
    let links = 2 * SIDE * (SIDE - 1) - (SIDE - 1);
    let made = least(|bytes| bytes.1) as f64 / links as f64;
    assert!(made <= 17.0, "{made} bytes a link");
    assert_eq!(least(|bytes| bytes.2), 0);
}

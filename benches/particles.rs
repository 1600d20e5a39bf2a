//! Nets by XPBD: a substep, by size and against a naive sweep, and whole frames.
//!
//! ```sh
//! cargo bench --bench particles --no-default-features --features physics              # one thread
//! cargo bench --bench particles --no-default-features --features physics,parallel
//! ```
//!
//! `substep` is time by the number of constraints: predictions and one sweep, of a net at rest. The ratio of two sizes is
//! what the cost grows by. `naive` sweeps 10,000 particles link after link, rows of the net first, with root and division
//! each; both start from the same positions.
//!
//! `frame` is a step of a net with links of 0.1 m as it hangs, with the substeps that [`Xpbd::substeps`] asks for a
//! violation of 1e-2: 10,000 particles at 60 frames a second, pinned by the first row or by two corners at half width, and
//! 1024 at 240 frames a second.
#![allow(missing_docs, reason = "the macro's main function has no place for them")]
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::Vector;
use ga_physics::particle::xpbd::{Substeps, Xpbd};
use ga_physics::particle::{Constraint, Particles};
use std::hint::black_box;

const LINK: f64 = 0.1;
const GRAVITY: Vector<f64> = Vector { e1: 0.0, e2: 0.0, e3: -9.81 };

struct Net {
    particles: Particles<f64>,
    inv_mass: Vec<f64>,
    constraints: Vec<Constraint>,
}

/// A square net in the plane y = 0; the columns folded to and fro by an angle.
fn net(side: usize, fold: f64, fixed: impl IntoIterator<Item = usize>) -> Net {
    let (mut particles, mut constraints) = (Particles::default(), Vec::new());
    let mut hold = |a, b| constraints.push(Constraint::Distance { a, b, length: LINK });
    for index in 0..side * side {
        let (column, row) = (index % side, index / side);
        let (x, y) = (column as f64 * LINK * fold.cos(), (column % 2) as f64 * LINK * fold.sin());
        particles.push(Point::new(x, y, -(row as f64) * LINK), Vector::default());
        if column > 0 {
            hold(index - 1, index);
        }
        if row > 0 {
            hold(index - side, index);
        }
    }
    let mut inv_mass = vec![100.0; side * side];
    fixed.into_iter().for_each(|particle| inv_mass[particle] = 0.0);
    Net { particles, inv_mass, constraints }
}

/// The textbook's: link after link.
fn naive(x: &mut [Point<f64>], old: &mut [Point<f64>], inv_mass: &[f64], links: &[(usize, usize)], h: f64) {
    for ((x, old), w) in x.iter_mut().zip(old).zip(inv_mass) {
        if *w > 0.0 {
            let now = *x;
            *x = now.moved(old.displacement_to(now) + GRAVITY * (h * h));
            *old = now;
        }
    }
    for (a, b) in links {
        let d = x[*b].displacement_to(x[*a]);
        let length = d.norm_sq().sqrt();
        let correction = d * ((length - LINK) / (length * (inv_mass[*a] + inv_mass[*b])));
        x[*a] = x[*a].moved(correction * -inv_mass[*a]);
        x[*b] = x[*b].moved(correction * inv_mass[*b]);
    }
}

fn substep(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("substep");
    for side in [32, 100, 316] {
        let Net { mut particles, inv_mass, constraints } = net(side, 0.0, []);
        let mut xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
        let substeps = Substeps { dt_s: 1e-3, count: 10, violation: f64::INFINITY };
        group.throughput(Throughput::Elements(10 * constraints.len() as u64));
        group.bench_function(format!("{} particles, 10 substeps", side * side), |bencher| {
            bencher.iter(|| xpbd.step(&mut particles, &inv_mass, &substeps, Vector::default()));
        });
    }
    let Net { mut particles, inv_mass, constraints } = net(100, 0.0, []);
    let links: Vec<(usize, usize)> = constraints
        .iter()
        .filter_map(|held| if let Constraint::Distance { a, b, .. } = held { Some((*a, *b)) } else { None })
        .collect();
    let mut old = particles.position.clone();
    group.throughput(Throughput::Elements(10 * links.len() as u64));
    group.bench_function("naive: 10000 particles, 10 substeps", |bencher| {
        bencher.iter(|| {
            for _ in 0..10 {
                naive(black_box(&mut particles.position), &mut old, &inv_mass, &links, 0.0);
            }
        });
    });
    group.finish();
}

fn frame(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("frame");
    group.sample_size(10);
    let fold = std::f64::consts::FRAC_PI_3;
    for (name, net, frames) in [
        ("first row, 10000 particles, 1/60 s", net(100, 0.0, 0..100), 60),
        ("two corners, 10000 particles, 1/60 s", net(100, fold, [0, 99]), 60),
        ("two corners, 1024 particles, 1/240 s", net(32, fold, [0, 31]), 240),
    ] {
        let Net { mut particles, inv_mass, constraints } = net;
        let mut xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
        let dt_s = 1.0 / f64::from(frames);
        let count = xpbd.substeps(dt_s, 9.81, 1e-2);
        let substeps = Substeps { dt_s, count, violation: 1e-2 };
        // It falls, snaps taut within a second, and swings.
        let mut worst: f64 = 0.0;
        for _ in 0..frames {
            xpbd.step(&mut particles, &inv_mass, &substeps, GRAVITY);
            worst = worst.max(xpbd.max_violation(&particles).relative);
        }
        println!("{name}: {count} substeps, violation at most {worst:.1e}");
        group.bench_function(name, |bencher| {
            bencher.iter_batched_ref(
                || particles.clone(),
                |particles| xpbd.step(particles, &inv_mass, &substeps, GRAVITY),
                BatchSize::LargeInput,
            );
        });
    }
    group.finish();
}

criterion_group!(benches, substep, frame);
criterion_main!(benches);

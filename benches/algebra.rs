//! Generated types against the dynamic multivector, nalgebra, glam and the formulas written out:
//! `cargo bench --bench algebra`.
//!
//! One criterion group a kernel, then the table of ratios with their uncertainty and of bytes, from the study's own
//! interleaved timer (the same closures; criterion times one rival after the other, which a change of the machine's
//! pace in between would falsify).
#![allow(missing_docs, reason = "the macro's main function has no place for them")]
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

mod rivals;

use criterion::{Criterion, Throughput, criterion_group};
use ga_physics::study::kernels;
use ga_physics::study::timing::Effort;
use std::time::Duration;

fn algebra(criterion: &mut Criterion) {
    for kernel in rivals::checked() {
        let mut group = criterion.benchmark_group(kernel.name);
        group.throughput(Throughput::Elements(kernel.calls() as u64));
        for way in &kernel.ways {
            group.bench_function(way.role.label(), |bencher| bencher.iter(|| way.pass()));
        }
        group.finish();
    }
}

/// 61 benchmarks of about 2 s each.
fn settings() -> Criterion {
    Criterion::default()
        .sample_size(50)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1200))
}

criterion_group! {
    name = benches;
    config = settings();
    targets = algebra
}

fn main() {
    benches();
    Criterion::default().configure_from_args().final_summary();
    // As a test (`cargo test --benches`) or with a filter, the table is not what was asked for.
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments == ["--bench"] {
        let report =
            kernels::measure(rivals::checked(), Effort::FULL, "cargo bench --bench algebra", &mut |_| {}).unwrap();
        println!("\n{}", report.text());
    }
}

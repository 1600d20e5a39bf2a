//! Instructions of every kernel and rival, counted by callgrind: `cargo bench --bench instructions`.
//!
//! Needs valgrind and `cargo install --version =0.20.0 gungraun-runner`. What is counted is one pass over 1024 inputs, a
//! slice in and a slice out, divided by 1024: the loop is included, the making of inputs is not, and nothing is
//! subtracted. Counts are exact and repeat on a busy machine; they know nothing of latency or caches, for which
//! `cargo bench --bench algebra` measures times. All ways are compared before they are counted.
//!
//! With an option more (`cargo bench --bench instructions -- --save-baseline=before`) gungraun runs by itself, with its
//! own output; see its documentation.
#![allow(missing_docs, reason = "gungraun's macros have no place for them")]
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

mod rivals;

use ga_physics::study::Provenance;
use ga_physics::study::kernels::{Kernel, Role, Way};
use std::process::{Command, ExitCode};

/// In the environment of the second process, which hands over to gungraun.
const HANDED_OVER: &str = "GA_PHYSICS_COUNTED";

#[gungraun::library_benchmark]
#[benches::way(iter = 0..rivals::N_WAYS, setup = rivals::way)]
fn count(way: Way) -> Way {
    way.pass();
    way
}

mod counted {
    use super::count;

    gungraun::library_benchmark_group!(name = kernels; benchmarks = count);
    gungraun::main!(library_benchmark_groups = kernels);

    pub(super) fn run() {
        main();
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if std::env::var_os(HANDED_OVER).is_some() || arguments.len() > 1 {
        counted::run();
        return ExitCode::SUCCESS;
    }
    let kernels = rivals::checked();
    if arguments != ["--bench"] {
        return ExitCode::SUCCESS; // As a test (`cargo test --benches`) there is nothing to count.
    }
    let runner = Command::new(std::env::current_exe().unwrap())
        .args(arguments)
        .envs([(HANDED_OVER, "1"), ("GUNGRAUN_OUTPUT_FORMAT", "json")])
        .stderr(std::process::Stdio::inherit())
        .output()
        .unwrap();
    if !runner.status.success() {
        eprintln!("Needs valgrind, and `cargo install --version =0.20.0 gungraun-runner`.");
        return ExitCode::FAILURE;
    }
    println!("{}", table(&kernels, &counts(&String::from_utf8(runner.stdout).unwrap())));
    ExitCode::SUCCESS
}

/// Instructions of each way, in the order of the ways: one JSON object a line.
fn counts(output: &str) -> Vec<f64> {
    let mut counts = vec![f64::NAN; rivals::N_WAYS];
    for line in output.lines() {
        let summary: serde_json::Value = serde_json::from_str(line).unwrap();
        let index: usize = summary["id"].as_str().unwrap().trim_start_matches("way_").parse().unwrap();
        counts[index] = summary["profiles"][0]["data"]["total"]["metrics"]["Ir"]["values"]["new"].as_f64().unwrap();
    }
    assert!(counts.iter().all(|count| count.is_finite()), "gungraun left a way out:\n{output}");
    counts
}

/// A traditional formulation; the least of these is the floor.
fn is_floor(role: Role) -> bool {
    matches!(role, Role::HandWritten | Role::Rival("glam f64" | "hand f64"))
}

/// Markdown: one line a kernel.
fn table(kernels: &[Kernel], counts: &[f64]) -> String {
    const COLUMNS: [Role; 8] = [
        Role::Generated,
        Role::HandWritten,
        Role::Rival("glam f64"),
        Role::Rival("hand f64"),
        Role::Rival("glam affine f64"),
        Role::Rival("hand Gram f64"),
        Role::GeneratedSingle,
        Role::Dynamic,
    ];
    let mut text = String::from("| kernel | ratio to the floor |");
    COLUMNS.iter().for_each(|role| text += &format!(" {} |", role.label()));
    text += &format!("\n|---|---:|{}", "---:|".repeat(COLUMNS.len()));
    let mut first = 0;
    for kernel in kernels {
        let per_call = |index: usize| counts[first + index] / kernel.calls() as f64;
        let of = |role: Role| kernel.ways.iter().position(|way| way.role == role).map(per_call);
        let floor = COLUMNS.iter().filter(|role| is_floor(**role)).filter_map(|role| of(*role)).reduce(f64::min);
        let cell = |value: Option<f64>, digits| value.map_or(String::new(), |value| format!("{value:.digits$}"));
        let ratio = of(Role::Generated).zip(floor).map(|(ours, floor)| ours / floor);
        text += &format!("\n| {} | {} |", kernel.name, cell(ratio, 2));
        COLUMNS.iter().for_each(|role| text += &format!(" {} |", cell(of(*role), 1)));
        first += kernel.ways.len();
    }
    let provenance = Provenance::gather("cargo bench --bench instructions").text();
    format!(
        "Instructions a call, the loop over a slice included; floor: the least of nalgebra, glam and hand.\n\n{text}\n\n{provenance}"
    )
}

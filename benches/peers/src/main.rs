//! The kernels of the study beside those of other geometric-algebra crates, in one run: see README.md.
//!
//! Inputs, comparison of results, timer and report are the study's own; glam and the written-out formulas come from
//! `benches/rivals`. This file only chooses which ways a kernel gets.

#[path = "../../rivals/mod.rs"]
mod rivals;

mod clifford_ways;
mod other_ways;

use ga_physics::study::kernels::{self, Kernel, KernelRow};
use ga_physics::study::timing::Effort;
use std::path::Path;
use std::process::ExitCode;

/// The kernel with the ways of all peers that have it.
fn with_peers(kernel: Kernel) -> Kernel {
    match kernel.name {
        "rotor * rotor" => other_ways::rotor_times_rotor(clifford_ways::rotor_times_rotor(kernel)),
        "rotor on vector" => other_ways::rotor_on_vector(clifford_ways::rotor_on_vector(kernel)),
        "motor on point" | "pose on point" => other_ways::motor_on_point(clifford_ways::motor_on_point(kernel)),
        "motor * motor" | "pose * pose" => other_ways::motor_times_motor(clifford_ways::motor_times_motor(kernel)),
        "sphere of four points" => clifford_ways::sphere_of_four_points(kernel),
        "multivector * multivector" => clifford_ways::general_product(kernel),
        _ => kernel,
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (effort, out) = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => (Effort::FULL, None),
        ["--quick"] => (Effort::QUICK, None),
        ["--out", out] => (Effort::FULL, Some(out)),
        _ => {
            eprintln!("usage: cargo run --release [-- --quick | --out DIR]");
            return ExitCode::from(2);
        }
    };
    let kernels = rivals::checked().into_iter().map(with_peers);
    let command = "cd benches/peers && cargo run --release";
    let report = kernels::measure(kernels, effort, command, &mut |name| eprintln!("{name}"));
    let written = report.and_then(|report| {
        println!("{}", report.text());
        println!("{}", table(&report.kernels));
        out.map_or(Ok(vec![]), |out| report.write(Path::new(out)))
    });
    match written {
        Ok(files) => {
            files.iter().for_each(|file| println!("{}", file.display()));
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Markdown: time over that of the generated code, with its 95 % interval, one line a kernel and peer.
fn table(rows: &[KernelRow]) -> String {
    let mut text = String::from("| kernel | peer | time over ours | ns (least) | bytes |\n|---|---|---:|---:|---:|");
    for row in rows {
        for way in &row.ways {
            let ratio = way.time_ratio;
            text += &format!(
                "\n| {} | {} | {:.2} [{:.2}, {:.2}] | {:.2} | {} |",
                row.name,
                way.role.label(),
                ratio.value,
                ratio.low,
                ratio.high,
                way.timing.min_ns,
                way.bytes
            );
        }
    }
    text
}

//! Mechanics cases beside rapier and two ODE crates, in one run on one thread: see README.md.

mod cases;
mod kepler;
mod measure;
mod pendulum;
mod rapier_ways;
mod report;

use cases::{Case, Pins};
use kepler::{Apsis, Orbit};
use measure::Way;
use std::f64::consts::FRAC_PI_2;
use std::io::{self, Write};
use std::process::ExitCode;

/// How often each way is timed.
struct Effort {
    small: usize,
    net: usize,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let effort = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => Effort { small: 21, net: 7 },
        ["--quick"] => Effort { small: 3, net: 1 },
        _ => {
            eprintln!("usage: cargo run --release --bin mechanics [-- --quick]");
            return ExitCode::from(2);
        }
    };
    match run(&mut io::stdout().lock(), &effort) {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever read has read enough.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run(out: &mut impl Write, effort: &Effort) -> io::Result<()> {
    orbits(out, effort)?;
    report::mechanics_head(out)?;
    let ropes_and_edges = || vec![rapier_ways::ropes(), rapier_ways::soft_edges()];
    let mut run = |case: Case, rounds: usize, ways: Vec<Way>| report::mechanics(out, &case, &ways, rounds);
    run(cases::double_pendulum(), effort.small, ropes_and_edges())?;
    run(cases::chain("chain, 0.7 rad", 1.0, cases::PENDULUM_RAD), effort.small, ropes_and_edges())?;
    run(cases::chain("chain, horizontal", 1.0, FRAC_PI_2), effort.small, ropes_and_edges())?;
    run(cases::folded_net(1).lasting(120, "folded net 32 x 32, 0.5 s"), effort.net, ropes_and_edges())?;
    run(cases::folded_net(2), effort.net, ropes_and_edges())?;
    run(cases::large_net(Pins::FirstRow), 1, ropes_and_edges())?;
    run(cases::large_net(Pins::Corners), 1, ropes_and_edges())
}

fn orbits(out: &mut impl Write, effort: &Effort) -> io::Result<()> {
    for (name, from) in [("pericentre", Apsis::Pericentre), ("apocentre", Apsis::Apocentre)] {
        writeln!(out, "\nKepler, e = 0.9, 100 periods from the {name}:")?;
        let orbit = Orbit { eccentricity: 0.9, periods: 100, from };
        report::kepler(out, orbit, &kepler::PEERS, &[1e-9, 1e-12], effort.small)?;
        writeln!(out, "\nKepler, e = 0.6, 3 periods from the {name}:")?;
        let orbit = Orbit { eccentricity: 0.6, periods: 3, from };
        report::work_precision(out, orbit, &kepler::PEERS, &[1e-3, 1e-6, 1e-9])?;
    }
    Ok(())
}

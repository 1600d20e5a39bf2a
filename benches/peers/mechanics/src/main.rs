//! Mechanics cases beside rapier and two ODE crates, in one run on one thread: see README.md.

mod cases;
mod free_body;
mod ga_ways;
mod kepler;
mod measure;
mod pendulum;
mod rapier_ways;
mod report;

use cases::{Case, Pins};
use ga_physics::particle::Method;
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
            eprintln!("usage: cargo run --release -p mechanics [-- --quick]");
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
    free_body::free_body(out, effort.small)?;
    orbits(out, effort)?;
    report::mechanics_head(out)?;
    let mut run = |case: Case, rounds: usize, ours: Vec<Way>| {
        let mut ways = vec![rapier_ways::ropes(), rapier_ways::soft_edges()];
        ways.extend(ours);
        report::mechanics(out, &case, &ways, rounds)
    };
    let fixed = || {
        vec![
            ga_ways::fixed("ga-physics rk4", Method::Rk4),
            ga_ways::fixed("ga-physics tsit5", Method::Tsit5),
            ga_ways::fixed("ga-physics dop853", Method::Dop853),
        ]
    };
    let chains = || {
        let mut ways = fixed();
        ways.push(ga_ways::adaptive("ga-physics dop853, adaptive 1e-9", Method::Dop853));
        ways
    };
    run(cases::double_pendulum(), effort.small, fixed())?;
    run(cases::chain("chain, 0.7 rad", 1.0, cases::PENDULUM_RAD), effort.small, chains())?;
    run(cases::chain("chain, horizontal", 1.0, FRAC_PI_2), effort.small, chains())?;
    let nets = || vec![ga_ways::newton(), ga_ways::sweeps()];
    let with_rattle = vec![ga_ways::rattle(), ga_ways::newton(), ga_ways::sweeps()];
    run(cases::folded_net(1).lasting(120, "folded net 32 x 32, 0.5 s"), effort.net, with_rattle)?;
    run(cases::folded_net(2), effort.net, nets())?;
    run(cases::large_net(Pins::FirstRow), 1, nets())?;
    run(cases::large_net(Pins::Corners), 1, vec![ga_ways::sweeps()])?;
    let sizes = cases::growing_nets();
    report::scaling(out, &sizes, &[ga_ways::sweeps_20(), ga_ways::sweeps()], effort.net)
}

fn orbits(out: &mut impl Write, effort: &Effort) -> io::Result<()> {
    let solvers = kepler::solvers();
    for (name, from) in [("pericentre", Apsis::Pericentre), ("apocentre", Apsis::Apocentre)] {
        writeln!(out, "\nKepler, e = 0.9, 100 periods from the {name}:")?;
        let orbit = Orbit { eccentricity: 0.9, periods: 100, from };
        report::kepler(out, orbit, &solvers, &[1e-9, 1e-12], effort.small)?;
        report::work_precision(out, orbit, &solvers, &[1e-6])?;
        writeln!(out, "\nKepler, e = 0.6, 3 periods from the {name}:")?;
        let orbit = Orbit { eccentricity: 0.6, periods: 3, from };
        report::work_precision(out, orbit, &solvers, &[1e-3, 1e-6, 1e-9])?;
    }
    Ok(())
}

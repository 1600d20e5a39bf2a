//! The shipped scenes of particles: each keeps what its comment says, and a method that is bad for it does not.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What a run of a scene leaves.
struct Run {
    summary: Value,
    /// Name, time, position and velocity of each row.
    states: Vec<(String, [f64; 7])>,
    _directory: tempfile::TempDir,
}

fn run(scene: &str, sets: &[&str]) -> Run {
    let directory = tempfile::tempdir().unwrap();
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(scene).with_extension("toml");
    let mut command = Command::new(env!("CARGO_BIN_EXE_ga-physics"));
    command.arg("run").arg(path).args(["--quiet", "--out"]).arg(directory.path());
    sets.iter().for_each(|set| {
        command.args(["--set", set]);
    });
    let output = command.output().unwrap();
    assert!(output.status.success(), "{scene}: {}", String::from_utf8_lossy(&output.stderr));
    let read = |file: &str| fs::read_to_string(directory.path().join(file)).unwrap();
    let state = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        let numbers = [0, 2, 3, 4, 9, 10, 11].map(|column| fields[column].parse().unwrap());
        (fields[1].to_owned(), numbers)
    };
    let states = read("trajectory.csv").lines().skip(1).map(state).collect();
    Run { summary: serde_json::from_str(&read("summary.json")).unwrap(), states, _directory: directory }
}

impl Run {
    fn figure(&self, key: &str) -> f64 {
        self.summary[key].as_f64().unwrap_or_else(|| panic!("no {key}"))
    }

    fn of<'a>(&'a self, name: &'a str) -> impl DoubleEndedIterator<Item = &'a [f64; 7]> {
        self.states.iter().filter(move |(found, _)| found == name).map(|(_, state)| state)
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

#[test]
fn a_pendulum_keeps_its_length_and_its_period() {
    let kept = run("pendulum", &[]);
    println!("energy {} violation {}", kept.figure("energy_drift_rel"), kept.figure("max_violation_m"));
    // Verlet: (omega h)² / 24 of the energy, with omega = 3.1 1/s and h = 2 ms, by a factor of a few at large swings.
    assert!(kept.figure("energy_drift_rel") < 1e-4);
    assert!(kept.figure("max_violation_m") < 1e-9);
    // The way back through the highest point takes a period: 4 K(sin 26.57°) sqrt(l / g) by the arithmetic-geometric mean.
    let (mut a, mut b) = (1.0_f64, (1.0 - 0.2_f64).sqrt());
    for _ in 0..6 {
        (a, b) = (f64::midpoint(a, b), (a * b).sqrt());
    }
    let period = std::f64::consts::TAU / a / 9.81_f64.sqrt();
    let rises = kept.of("bob").zip(kept.of("bob").skip(1)).filter(|(now, next)| now[4] > 0.0 && next[4] <= 0.0);
    // Turning points on the right by linear interpolation of the velocity, which is odd about them.
    let turns: Vec<f64> = rises.map(|(now, next)| now[0] + (next[0] - now[0]) * now[4] / (now[4] - next[4])).collect();
    let found = (turns[turns.len() - 1] - turns[0]) / (turns.len() - 1) as f64;
    assert!((found - period).abs() < 1e-4, "{found} s, not {period} s");
    let sets = ["solver.method=rk4", "solver.stabilisation=none", "dt_s=0.02"];
    let drifting = run("pendulum", &sets).figure("max_violation_m");
    assert!(drifting > 1e-6, "without stabilisation the length drifts: {drifting} m");
}

#[test]
fn a_planet_comes_back_to_its_start_after_ten_turns() {
    let kept = run("orbit", &[]);
    let (first, last) = (kept.of("planet").next().unwrap(), kept.of("planet").next_back().unwrap());
    let off = distance(&first[1..4], &last[1..4]);
    println!("off by {off} m, energy {}", kept.figure("energy_drift_rel"));
    assert!(off < 1e-6 && kept.figure("energy_drift_rel") < 1e-7 && kept.figure("angular_momentum_drift_rel") < 1e-7);
    assert!(kept.summary["momentum_drift_rel"].is_null(), "the centre takes momentum");
    let nearest = kept.of("planet").map(|state| distance(&state[1..4], &[0.0; 3])).fold(f64::INFINITY, f64::min);
    assert!((nearest - 0.4).abs() < 5e-3, "nearest {nearest} m, by frames of 1/30 s");
    let euler = run("orbit", &["solver.method=euler", "dt_s=0.01"]);
    assert!(euler.figure("energy_drift_rel") > 0.1, "Euler's method leaves the ellipse");
}

#[test]
fn three_bodies_stay_on_their_figure_of_eight() {
    let kept = run("three-bodies", &[]);
    for (key, bound) in
        [("energy_drift_rel", 1e-10), ("momentum_drift_rel", 1e-13), ("angular_momentum_drift_rel", 1e-12)]
    {
        println!("{key} {}", kept.figure(key));
        assert!(kept.figure(key) < bound, "{key} {}", kept.figure(key));
    }
    // After a third of a turn each is where the next one was.
    let period = 6.325_913_98;
    let at = |name: &str, time: f64| {
        let nearest = |a: &&[f64; 7], b: &&[f64; 7]| (a[0] - time).abs().total_cmp(&(b[0] - time).abs());
        *kept.of(name).min_by(nearest).unwrap()
    };
    let start = at("one", 0.0);
    let later = ["two", "three"].map(|name| {
        let state = at(name, period / 3.0);
        // A frame is at most 10 ms off: along the velocity to first order.
        let back = period / 3.0 - state[0];
        distance(&[1, 2, 3].map(|i| state[i] + back * state[i + 3]), &start[1..4])
    });
    assert!(later.iter().any(|off| *off < 1e-3), "{later:?}");
}

#[test]
fn drag_shortens_the_flight_and_none_leaves_a_parabola() {
    let kept = run("projectile-drag", &[]);
    let free = kept.of("in a vacuum").next_back().unwrap();
    let (speed, time) = (21.213203, free[0]);
    assert!((free[1] - speed * time).abs() < 1e-9 && (free[3] - time * (speed - 0.5 * 9.81 * time)).abs() < 1e-9);
    let dragged = kept.of("in air").next_back().unwrap();
    assert!(dragged[1] < 0.7 * free[1] && dragged[3] < free[3] && dragged[5] == 0.0, "{dragged:?}");
    assert!(kept.summary["energy_drift_rel"].is_null(), "drag takes energy");
}

#[test]
fn a_bead_on_a_wire_is_fastest_at_the_bottom() {
    let kept = run("bead-on-circle", &[]);
    assert!(kept.figure("energy_drift_rel") < 1e-7 && kept.figure("max_violation_m") < 1e-9);
    assert_eq!(kept.summary["particle_work"]["constraints"], 2);
    for state in kept.of("bead") {
        let [x, y, z] = [state[1], state[2], state[3]];
        assert!((x.hypot(z) - 1.0).abs() < 1e-9 && y.abs() < 1e-9, "{state:?}");
        let speed = distance(&state[4..7], &[0.0; 3]);
        // v² = v0² + 2 g (1 - z), from the start with 0.5 m/s at z = 1.
        assert!((speed * speed - 0.25 - 2.0 * 9.81 * (1.0 - z)).abs() < 1e-6, "{state:?}");
    }
}

#[test]
fn links_of_double_pendulum_chain_and_net_keep_their_lengths() {
    let cases: [(&str, &[&str]); 3] = [
        ("double-pendulum", &["duration_s=5"]),
        ("chain", &["duration_s=0.2"]),
        ("particle-net", &["duration_s=0.04"]),
    ];
    for (scene, sets) in cases {
        let kept = run(scene, sets);
        println!("{scene} {}", kept.figure("max_violation_m"));
        assert!(kept.figure("max_violation_m") < 1e-9, "{scene}");
        assert_eq!(kept.summary["particle_work"]["redundant_constraints"], 0, "{scene}");
    }
}

//! The shipped scenes of rigid bodies: each keeps what its comment says, in every formulation, and a formulation that is bad
//! for it does not.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

/// What a run of a scene leaves.
struct Run {
    summary: Value,
    /// Name and numbers of each row: time, position, rotor, velocity, angular velocity.
    states: Vec<(String, [f64; 14])>,
    /// Time, energies, momentum, angular momentum.
    energies: Vec<Vec<f64>>,
    page: String,
    _directory: TempDir,
}

fn run_path(path: &Path, sets: &[&str], directory: TempDir) -> Run {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ga-physics"));
    command.arg("run").arg(path).args(["--quiet", "--out"]).arg(directory.path().join("out"));
    sets.iter().for_each(|set| {
        command.args(["--set", set]);
    });
    let output = command.output().unwrap();
    let failed = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{} {sets:?}: {failed}", path.display());
    let read = |file: &str| fs::read_to_string(directory.path().join("out").join(file)).unwrap();
    let numbers = |fields: &[&str]| fields.iter().map(|field| field.parse().unwrap()).collect::<Vec<f64>>();
    let state = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        let mut all = numbers(&fields[..1]);
        all.extend(numbers(&fields[2..]));
        (fields[1].to_owned(), all.try_into().unwrap())
    };
    let states = read("trajectory.csv").lines().skip(1).map(state).collect();
    let (energies, page) = (read("energy.csv"), read("run.html"));
    let energies = energies.lines().skip(1).map(|line| numbers(&line.split(',').collect::<Vec<_>>()));
    let energies = energies.collect();
    Run { summary: serde_json::from_str(&read("summary.json")).unwrap(), states, energies, page, _directory: directory }
}

/// Runs a shipped scene.
fn run(scene: &str, sets: &[&str]) -> Run {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(scene).with_extension("toml");
    run_path(&path, sets, tempfile::tempdir().unwrap())
}

/// Runs a scene given as text.
fn run_text(text: &str) -> Run {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("scene.toml");
    fs::write(&path, text).unwrap();
    run_path(&path, &[], directory)
}

impl Run {
    fn figure(&self, key: &str) -> f64 {
        self.summary[key].as_f64().unwrap_or_else(|| panic!("no {key}"))
    }

    fn of<'a>(&'a self, name: &'a str) -> impl DoubleEndedIterator<Item = &'a [f64; 14]> {
        self.states.iter().filter(move |(found, _)| found == name).map(|(_, state)| state)
    }

    /// The largest departure of a column of `energy.csv` from its start.
    fn drift(&self, column: usize) -> f64 {
        self.energies.iter().map(|row| (row[column] - self.energies[0][column]).abs()).fold(0.0, f64::max)
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

#[test]
fn the_tennis_racket_needs_no_steps_however_few_states_are_asked_for() {
    let often = run("tennis-racket", &[]);
    println!("energy {} L {}", often.figure("energy_drift_rel"), often.figure("angular_momentum_drift_rel"));
    assert_eq!(often.summary["settings"]["body_solvers"][0]["method"], "free_flight");
    assert!(often.figure("energy_drift_rel") < 1e-13 && often.figure("angular_momentum_drift_rel") < 1e-14);
    let once = run("tennis-racket", &["record_hz=0.01"]);
    assert_eq!((once.figure("steps"), once.states.len()), (1.0, 2));
    let (last, alone) = (often.of("racket").next_back().unwrap(), once.of("racket").next_back().unwrap());
    println!("off by {}", distance(&last[4..8], &alone[4..8]));
    assert!(distance(&last[4..8], &alone[4..8]) < 1e-12, "{last:?} {alone:?}");
    // It does turn over: its middle axis points both ways.
    let along = |state: &&[f64; 14]| {
        let [s, a, b, c] = [state[4], state[5], state[6], state[7]];
        s * s - a * a + b * b - c * c
    };
    let ways: Vec<f64> = often.of("racket").collect::<Vec<_>>().iter().map(along).collect();
    assert!(ways.iter().any(|way| *way > 0.9) && ways.iter().any(|way| *way < -0.9));
}

/// The nods of a symmetric top let go at rest (Goldstein, 1980, section 5-7): with `u` the cosine of the tilt, a = C omega / A
/// and beta = 2 m g l / A, it moves by `(du/dt)² = (u0 - u) (beta (1 - u²) - a² (u0 - u))`. Lowest tilt and time of a nod.
fn nod(a: f64, beta: f64, u0: f64) -> (f64, f64) {
    let root = (a.powi(4) + 4.0 * beta * (beta - a * a * u0)).sqrt();
    let (low, far) = ((a * a - root) / (2.0 * beta), (a * a + root) / (2.0 * beta));
    // u = low + (u0 - low) sin² p makes the integrand smooth and even: the midpoint rule converges geometrically.
    let n = 64;
    let at = |k: i32| low + (u0 - low) * ((f64::from(k) + 0.5) / f64::from(n) * FRAC_PI_2).sin().powi(2);
    let half: f64 = (0..n).map(|k| 2.0 / (beta * (far - at(k))).sqrt()).sum::<f64>() * FRAC_PI_2 / f64::from(n);
    (low.acos(), 2.0 * half)
}

#[test]
fn a_heavy_top_nods_as_theory_says() {
    let (mass, length, spin) = (0.5, 0.3, 20.0);
    let (about_axis, about_tip) = (0.3 * mass * 0.25, mass * (0.15 * 0.25 + 0.6 * 0.16));
    let (lowest, period) =
        nod(about_axis * spin / about_tip, 2.0 * mass * 9.81 * length / about_tip, (TAU / 12.0).cos());
    let sets = |duration: f64| format!("duration_s={duration:.17}");
    for (duration, tilt) in [(period / 2.0, lowest), (period, TAU / 12.0)] {
        let kept = run("heavy-top", &[&sets(duration)]);
        let end = kept.of("top").next_back().unwrap();
        let found = (end[3] / length).acos();
        println!("{} rad off; energy {}", found - tilt, kept.figure("energy_drift_rel"));
        // Order 4 at 500 steps a second; the figure is that of a step of 2 ms.
        assert!((found - tilt).abs() < 1e-7, "{found} rad, not {tilt} rad");
        assert!((distance(&end[1..4], &[0.0; 3]) - length).abs() < 1e-12);
        assert!(kept.figure("energy_drift_rel") < 1e-7 && kept.figure("max_violation_m") < 1e-12);
    }
}

#[test]
fn a_compound_pendulum_has_the_period_of_the_elliptic_integral() {
    let kept = run("compound-pendulum", &["duration_s=0.6", "record_hz=500"]);
    // About the hinge, 0.45 m above the centre.
    let (arm, inertia) = (0.45_f64, (0.2_f64.powi(2) + 1.0) / 12.0 + 0.45_f64.powi(2));
    for (name, start) in [("narrow", TAU / 18.0), ("wide", TAU / 3.0)] {
        // 4 sqrt(I / (m g d)) K(sin(start / 2)) by the arithmetic-geometric mean.
        let (mut a, mut b) = (1.0_f64, (start / 2.0).cos());
        for _ in 0..8 {
            (a, b) = (f64::midpoint(a, b), (a * b).sqrt());
        }
        let quarter = FRAC_PI_2 / a * (inertia / (9.81 * arm)).sqrt();
        // A quarter of a period after the start it is below its hinge: x = 0, by Hermite's cubic between two states.
        let states: Vec<_> = kept.of(name).collect();
        let (before, after) =
            states.windows(2).find(|pair| pair[0][1] > 0.0 && pair[1][1] <= 0.0).map(|w| (w[0], w[1])).unwrap();
        let h = after[0] - before[0];
        let cubic = |f: f64| {
            let (x0, x1, v0, v1) = (before[1], after[1], before[8] * h, after[8] * h);
            let (low, high) = ((1.0 + 2.0 * f) * (1.0 - f).powi(2), f * f * (3.0 - 2.0 * f));
            x0 * low + x1 * high + v0 * f * (1.0 - f).powi(2) - v1 * f * f * (1.0 - f)
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = f64::midpoint(low, high);
            if cubic(middle) > 0.0 { low = middle } else { high = middle }
        }
        let found = before[0] + low * h;
        println!("{name}: quarter {quarter} s, off by {}", found - quarter);
        assert!((found - quarter).abs() < 2e-9, "{name}: {found} s, not {quarter} s");
    }
}

#[test]
fn a_closed_loop_of_hinges_moves_and_says_what_is_redundant() {
    let kept = run("four-bar", &["duration_s=0.4"]);
    let work = &kept.summary["body_work"];
    assert_eq!((work["joints"].as_u64(), work["joint_rows"].as_u64()), (Some(4), Some(20)));
    // 20 rows on 18 degrees of freedom, of which one is left.
    assert_eq!(work["redundant_rows"], 3);
    println!("violation {} energy {}", kept.figure("max_violation_m"), kept.figure("energy_drift_rel"));
    assert!(kept.figure("max_violation_m") < 1e-12 && kept.figure("energy_drift_rel") < 1e-5);
    for (name, y) in [("crank", 0.0), ("coupler", 0.1), ("rocker", 0.0)] {
        assert!(kept.of(name).all(|state| (state[2] - y).abs() < 1e-12), "{name} leaves its plane");
    }
    let (start, end) = (kept.of("crank").next().unwrap(), kept.of("crank").next_back().unwrap());
    assert!(distance(&start[1..4], &end[1..4]) > 0.2, "the crank has hardly moved");
}

#[test]
fn a_hung_chain_keeps_its_joints_energy_and_the_angular_momentum_about_the_vertical() {
    let kept = run("body-chain", &["duration_s=0.15"]);
    println!(
        "violation {} energy {} L {}",
        kept.figure("max_violation_m"),
        kept.figure("energy_drift_rel"),
        kept.drift(9)
    );
    assert!(kept.figure("max_violation_m") < 1e-12 && kept.figure("energy_drift_rel") < 1e-8);
    // Gravity has no moment about the vertical through the hook, and nor has the hook: sum of m x² omega is 10.88 kg m²/s.
    assert!(kept.drift(9) < 1e-12 * kept.energies[0][9].abs().max(1.0));
    for link in 1..8 {
        let name = |k: usize| format!("rod {k}");
        for (a, b) in kept.of(&name(link)).zip(kept.of(&name(link + 1))) {
            // Half a rod on either side of a joint: never farther apart than a rod.
            assert!(distance(&a[1..4], &b[1..4]) < 0.3 + 1e-12);
        }
    }
}

#[test]
fn a_matrix_drifts_and_a_rotor_does_not() {
    let kept = run("matrix-drift", &["duration_s=8"]);
    let distortion = kept.figure("max_distortion");
    println!("distortion {distortion}");
    assert!(distortion > 0.2, "{distortion}: nothing to be seen");
    // Two bodies, each with 200 steps: none is cut in two by rounding, late in the run.
    assert_eq!(kept.summary["body_work"]["accepted_steps"], 400);
    // What is written is the nearest rotation, and the page has the rest of one body.
    for (_, state) in &kept.states {
        assert!((distance(&state[4..8], &[0.0; 4]) - 1.0).abs() < 1e-14);
    }
    assert_eq!(kept.page.matches("\"rows\":").count(), 1);
    let by_rotors = run("matrix-drift", &["duration_s=8", "body.\"by matrix\".formulation=rotor"]);
    assert!(by_rotors.figure("max_distortion") < 1e-14, "{}", by_rotors.figure("max_distortion"));
    let (one, other) = (by_rotors.of("by matrix").next_back().unwrap(), by_rotors.of("by rotor").next_back().unwrap());
    assert_eq!(one[4..8], other[4..8], "equal bodies, equal bits");
    // The distortion is the step's: of order 5 in its length.
    let finer = run("matrix-drift", &["duration_s=8", "dt_s=0.02", "record_hz=50"]).figure("max_distortion");
    assert!(finer < distortion / 16.0, "{finer} at half the step");
}

#[test]
fn every_scene_runs_in_every_formulation() {
    let cases = [
        ("tennis-racket", "2", 1e-10),
        ("heavy-top", "0.1", 1e-6),
        ("compound-pendulum", "0.1", 1e-6),
        ("four-bar", "0.05", 1e-6),
        ("body-chain", "0.01", 1e-6),
    ];
    for (scene, duration, energy) in cases {
        let duration = format!("duration_s={duration}");
        let ends = ["rotor", "matrix", "quaternion", "motor"].map(|formulation| {
            let kept = run(scene, &[&duration, &format!("formulation={formulation}")]);
            assert_eq!(kept.summary["settings"]["body_solvers"][0]["formulation"], formulation);
            assert!(kept.figure("energy_drift_rel") < energy, "{scene} {formulation}");
            if kept.summary["body_work"]["joints"] != 0 {
                assert!(kept.figure("max_violation_m") < 1e-12, "{scene} {formulation}");
            }
            kept.states.last().unwrap().1
        });
        for end in &ends[1..] {
            let off = distance(&ends[0][1..4], &end[1..4]).max(
                distance(&ends[0][4..8], &end[4..8])
                    .min(distance(&ends[0][4..8].iter().map(|x| -x).collect::<Vec<_>>(), &end[4..8])),
            );
            assert!(off < 1e-6, "{scene}: off by {off}");
        }
    }
}

const HEAD: &str = "duration_s = 1\ndt_s = 0.01\n";

fn body(name: &str, rest: &str) -> String {
    format!("[[body]]\nname = \"{name}\"\nmass_kg = 2\ninertia_kg_m2 = [0.5, 0.4, 0.3]\n{rest}\n")
}

#[test]
fn a_torque_gives_its_impulse_and_is_no_drift() {
    let spun = run_text(&format!(
        "{HEAD}{}[[force]]\ntorque = {{ body = \"a\", torque_world_n_m = [0.1, -0.2, 0.3], start_s = 0.123, end_s = 0.777 }}\n",
        body("a", "omega_body_rad_s = [1, 2, 3]")
    ));
    let (start, end) = (&spun.energies[0], spun.energies.last().unwrap());
    for (column, torque) in [(7, 0.1), (8, -0.2), (9, 0.3)] {
        // Steps are cut where it starts and ends, so that the impulse is exact.
        assert!((end[column] - start[column] - 0.654 * torque).abs() < 1e-14, "{column}");
    }
    assert!(spun.summary["energy_drift_rel"].is_null() && spun.summary["angular_momentum_drift_rel"].is_null());
    assert!(spun.summary["max_violation_m"].is_null(), "nothing is held");
}

#[test]
fn springs_store_energy_dampers_take_it_and_those_between_bodies_keep_momentum() {
    let pair =
        body("a", "omega_body_rad_s = [1, 2, 3]") + &body("b", "position_m = [1, 0, 0]\nvelocity_m_s = [0, 0.5, 0.2]");
    let spring = |rest: &str| {
        format!("[[force]]\nspring = {{ a = \"a\", at_a_body_m = [0.1, 0.2, 0.3], stiffness_n_m = 30, {rest} }}\n")
    };
    let mutual =
        run_text(&format!("{HEAD}{pair}{}", spring("b = \"b\", at_b_body_m = [0, 0, 0.4], rest_length_m = 0.5")));
    println!("energy {}", mutual.figure("energy_drift_rel"));
    // Order 4, with 60 steps a swing.
    assert!(mutual.figure("energy_drift_rel") < 1e-5, "{}", mutual.figure("energy_drift_rel"));
    assert!(mutual.figure("momentum_drift_rel") < 1e-14 && mutual.figure("angular_momentum_drift_rel") < 1e-13);
    let anchored = run_text(&format!("{HEAD}{pair}{}", spring("to_m = [0, 0, 2]")));
    assert!(anchored.figure("energy_drift_rel") < 1e-5 && anchored.summary["momentum_drift_rel"].is_null());
    let damped = run_text(&format!("{HEAD}{pair}{}", spring("b = \"b\", damping_n_s_m = 1")));
    assert_eq!(damped.summary["settings"]["body_solvers"][0]["method"], "tsit5");
    assert!(damped.summary["energy_drift_rel"].is_null() && damped.figure("momentum_drift_rel") < 1e-14);
    let total = |row: &Vec<f64>| row[3];
    assert!(damped.energies.windows(2).all(|pair| total(&pair[1]) < total(&pair[0]) + 1e-12), "a damper takes energy");
}

#[test]
fn a_top_without_gravity_keeps_angular_momentum_about_its_joint() {
    let kept = run("heavy-top", &["gravity_m_s2=[0, 0, 0]", "duration_s=0.5", "body.top.omega_body_rad_s=[0, 0, -20]"]);
    assert!(kept.figure("angular_momentum_drift_rel") < 1e-12, "{}", kept.figure("angular_momentum_drift_rel"));
    assert!(kept.summary["momentum_drift_rel"].is_null(), "the joint takes momentum");
}

#[test]
fn elastic_impacts_of_jointed_bodies_keep_energy_and_their_joint() {
    // Two bars on a ball joint fall on a floor, one end on a post: the joint is struck, too.
    let bar = |name: &str, x: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass_kg = 1\nposition_m = [{x:?}, 0, 0.5]\nshape.box.size_m = [0.8, 0.2, 0.2]\n"
        )
    };
    let kept = run_text(&format!(
        "duration_s = 0.4\ndt_s = 0.005\ngravity_m_s2 = [0, 0, -9.81]\n{}{}[[joint]]\nball = {{ a = \"a\", b = \"b\", \
         point_m = [0.4, 0, 0.5] }}\n[[body]]\nname = \"floor\"\nfixed = true\nshape.plane.normal = [0, 0, 1]\n\
         [[body]]\nname = \"post\"\nfixed = true\nposition_m = [0.2, 0.1, 0.15]\nshape.box.size_m = [0.1, 0.1, 0.29]\n",
        bar("a", 0.0),
        bar("b", 0.8)
    ));
    println!("energy {} events {}", kept.figure("energy_drift_rel"), kept.figure("events"));
    assert!(kept.figure("events") >= 2.0 && kept.figure("max_violation_m") < 1e-12);
    assert!(kept.figure("energy_drift_rel") < 1e-5, "{}", kept.figure("energy_drift_rel"));
}

#[test]
fn a_joint_that_cannot_be_held_is_named_also_among_bodies_of_several_formulations() {
    // The top's joint comes second, and is the first of the rotors.
    let other = format!("formulation = \"motor\"\n{}", "position_m = [9, 0, 0]\n");
    let free = body("other", &other) + "[[joint]]\nball = { a = \"other\", point_m = [9, 0, 0] }\n";
    let shipped = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/heavy-top.toml")).unwrap();
    let (head, top) = shipped.split_once("[[body]]").unwrap();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("scene.toml");
    fs::write(&path, format!("{head}{free}[[body]]{top}")).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_ga-physics"));
    let sets = ["--set", "dt_s=0.5", "--set", "solver.method=\"yoshida4\""];
    let output = command.arg("run").arg(&path).args(sets).current_dir(directory.path()).output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("the ball joint of `top`") && message.contains("smaller `dt_s`"), "{message}");
}

//! The built program as users meet it: exit codes, files, messages.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

const FILES: [&str; 5] = ["energy.csv", "events.csv", "run.html", "summary.json", "trajectory.csv"];

const TRAJECTORY: &str = "time_s,body,x_m,y_m,z_m,r_1,r_e23,r_e31,r_e12,vx_m_s,vy_m_s,vz_m_s,\
                          omega_e23_world,omega_e31_world,omega_e12_world";
const ENERGY: &str = "time_s,kinetic_j,potential_j,total_j,px,py,pz,l_e23,l_e31,l_e12";
const EVENTS: &str = "time_s,kind,a,b,x_m,y_m,z_m,nx,ny,nz,separation_m,impulse_n_s";

const SUMMARY: [&str; 21] = [
    "angular_momentum_drift_rel",
    "bodies",
    "body_work",
    "energy_drift_rel",
    "events",
    "max_distortion",
    "max_penetration_m",
    "max_violation_m",
    "momentum_drift_rel",
    "particle_work",
    "particles",
    "real_time_factor",
    "scene",
    "settings",
    "sim_s",
    "state_bytes_per_body",
    "state_bytes_per_particle",
    "state_hash",
    "steps",
    "wall_s",
    "failure",
];

struct Ended {
    code: Option<i32>,
    out: String,
    err: String,
}

/// Runs the program in a directory, which becomes the place of relative paths.
fn program(directory: &Path, arguments: &[&str]) -> Ended {
    let output = Command::new(env!("CARGO_BIN_EXE_ga-physics"))
        .args(arguments)
        .current_dir(directory)
        .env("NO_COLOR", "1")
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    Ended { code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
}

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}

fn shipped() -> Vec<String> {
    let entries = fs::read_dir(scenes()).unwrap().map(|entry| entry.unwrap().path());
    let mut found: Vec<String> = entries
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .map(|path| path.to_str().unwrap().to_owned())
        .collect();
    found.sort();
    assert!(found.len() >= 4);
    found
}

/// The scenes that take long in an unoptimised build are run for their first instants only.
fn shortened(scene: &str) -> &'static [&'static str] {
    match Path::new(scene).file_stem().unwrap().to_str().unwrap() {
        "body-chain" => &["--set", "duration_s=0.02"],
        "chain" => &["--set", "duration_s=0.2"],
        "compound-pendulum" => &["--set", "duration_s=0.2"],
        "door" => &["--set", "duration_s=1"],
        "four-bar" => &["--set", "duration_s=0.1"],
        "heavy-top" => &["--set", "duration_s=0.3"],
        "matrix-drift" => &["--set", "duration_s=4"],
        "particle-net" => &["--set", "duration_s=0.04"],
        _ => &[],
    }
}

fn listing(directory: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(directory).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn summary(out: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(out.join("summary.json")).unwrap()).unwrap()
}

fn rows(path: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(path).unwrap();
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

/// Runs a scene given as text, in a directory of its own.
fn run_text(text: &str, more: &[&str]) -> (TempDir, Ended) {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("scene.toml"), text).unwrap();
    let ended = program(directory.path(), &[&["run", "scene.toml"], more].concat());
    (directory, ended)
}

const HEAD: &str = "duration_s = 0.1\ndt_s = 0.01\n";
const CUBE: &str = "[[body]]\nname = \"cube\"\nmass_kg = 1\nshape.box.size_m = [1, 1, 1]\n";

#[test]
fn every_shipped_scene_runs_and_writes_its_five_files() {
    let directory = tempfile::tempdir().unwrap();
    for scene in shipped() {
        let name = Path::new(&scene).file_stem().unwrap().to_str().unwrap().to_owned();
        let ended = program(directory.path(), &[&["run", &scene][..], shortened(&scene)].concat());
        assert_eq!(ended.code, Some(0), "{scene}\n{}", ended.err);
        assert!(ended.out.contains("run.html") && ended.out.contains("state hash"), "{}", ended.out);
        let out = directory.path().join("out").join(&name);
        assert_eq!(listing(&out), FILES, "{scene}");
        let first = |file: &str| fs::read_to_string(out.join(file)).unwrap().lines().next().unwrap().to_owned();
        assert_eq!(first("trajectory.csv"), TRAJECTORY);
        assert_eq!(first("energy.csv"), ENERGY);
        assert_eq!(first("events.csv"), EVENTS);
        let summary = summary(&out);
        let mut keys: Vec<&str> = summary.as_object().unwrap().keys().map(String::as_str).collect();
        keys.sort_unstable();
        let mut expected: Vec<&str> = SUMMARY.into_iter().filter(|key| *key != "failure").collect();
        expected.sort_unstable();
        assert_eq!(keys, expected);
        assert_eq!(summary["scene"], name.as_str());
        recorded_whole(&out, &summary);
    }
}

/// The first and the last state, of every body and particle, the latter without attitude; as many events as the summary says; whole numbers of columns.
fn recorded_whole(out: &Path, summary: &Value) {
    let trajectory = rows(&out.join("trajectory.csv"));
    let count = |key: &str| usize::try_from(summary[key].as_u64().unwrap()).unwrap();
    let bodies = count("bodies") + count("particles");
    let rotational = |row: &[String]| row[5..9].iter().chain(&row[12..15]).filter(|field| field.is_empty()).count();
    for (place, row) in trajectory.iter().enumerate() {
        let of_body = place % bodies < count("bodies");
        assert_eq!(rotational(row), if of_body { 0 } else { 7 }, "{row:?}");
    }
    let end = summary["sim_s"].as_f64().unwrap();
    assert!(trajectory[..bodies].iter().all(|row| number(&row[0]) == 0.0));
    assert!(trajectory[trajectory.len() - bodies..].iter().all(|row| number(&row[0]) == end));
    assert_eq!(trajectory.len() % bodies, 0);
    let energy = rows(&out.join("energy.csv"));
    assert_eq!((number(&energy[0][0]), number(&energy[energy.len() - 1][0])), (0.0, end));
    assert_eq!(energy.len(), trajectory.len() / bodies);
    assert!(energy.windows(2).all(|pair| number(&pair[0][0]) < number(&pair[1][0])), "time goes on");
    let events = rows(&out.join("events.csv"));
    assert_eq!(events.len() as u64, summary["events"].as_u64().unwrap());
    for (rows, header) in [(trajectory, TRAJECTORY), (energy, ENERGY), (events, EVENTS)] {
        let columns = header.split(',').count();
        assert!(
            rows.iter().all(|row| row.len() == columns && row.iter().all(|field| field != "NaN" && field != "inf"))
        );
    }
    let page = fs::read_to_string(out.join("run.html")).unwrap();
    assert!(page.trim_end().ends_with("</html>"));
}

#[test]
fn the_same_scene_gives_the_same_bits() {
    let directory = tempfile::tempdir().unwrap();
    for scene in shipped() {
        let mut found = Vec::new();
        for out in ["first", "second"] {
            let arguments = [&["run", &scene, "--out", out, "--quiet"][..], shortened(&scene)].concat();
            assert_eq!(program(directory.path(), &arguments).code, Some(0));
            let out = directory.path().join(out);
            let tables = ["trajectory.csv", "energy.csv", "events.csv"].map(|file| fs::read(out.join(file)).unwrap());
            found.push((summary(&out)["state_hash"].clone(), tables));
        }
        assert!(found[0] == found[1], "{scene}");
    }
}

#[test]
fn a_run_is_quiet_on_request_and_takes_overrides() {
    let directory = tempfile::tempdir().unwrap();
    let scene = scenes().join("free-collision.toml");
    let scene = scene.to_str().unwrap();
    let ended = program(directory.path(), &["run", scene, "--out", "plain", "--quiet"]);
    assert_eq!((ended.code, ended.out.as_str(), ended.err.as_str()), (Some(0), "", ""));
    let sets = ["--set", "body.box.mass_kg=3", "--set", "duration_s=1.5"];
    let ended = program(directory.path(), &[&["run", scene, "--out", "set", "--quiet"], &sets[..]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let (plain, set) = (summary(&directory.path().join("plain")), summary(&directory.path().join("set")));
    assert_eq!((plain["sim_s"].as_f64(), set["sim_s"].as_f64()), (Some(4.0), Some(1.5)));
    assert_ne!(plain["state_hash"], set["state_hash"]);
    assert_eq!(set["settings"]["overrides"], serde_json::json!(["body.box.mass_kg=3", "duration_s=1.5"]));
    let wrong = program(directory.path(), &["run", scene, "--out", "wrong", "--set", "body.box.mass_kg=-3"]);
    assert_eq!(wrong.code, Some(2));
    assert!(wrong.err.contains("-3") && !directory.path().join("wrong").exists(), "{}", wrong.err);
}

#[test]
fn shipped_scenes_conserve_what_they_should() {
    let directory = tempfile::tempdir().unwrap();
    let figures = |name: &str| {
        let scene = scenes().join(name).with_extension("toml");
        let ended = program(directory.path(), &["run", scene.to_str().unwrap(), "--out", name, "--quiet"]);
        assert_eq!(ended.code, Some(0));
        let found = summary(&directory.path().join(name));
        let drifts = ["energy_drift_rel", "momentum_drift_rel", "angular_momentum_drift_rel"];
        (found["events"].as_u64().unwrap(), drifts.map(|key| found[key].as_f64()))
    };
    let (events, drifts) = figures("free-collision");
    println!("free-collision {drifts:?}");
    let [energy, momentum, angular_momentum] = drifts.map(Option::unwrap);
    assert!(events >= 1);
    // Momenta change by equal and opposite impulses: rounding. Energy: fourth order in the step.
    assert!(momentum <= 1e-12 && angular_momentum <= 1e-12 && energy <= 1e-8, "{drifts:?}");
    let (events, drifts) = figures("tennis-racket");
    println!("tennis-racket {drifts:?}");
    assert_eq!(events, 0);
    assert!(drifts[0].unwrap() <= 1e-8 && drifts[2].unwrap() <= 1e-12, "{drifts:?}");
    // Gravity and a floor change all momenta, restitution 0.8 the energy: null, not a number that misleads.
    assert_eq!(figures("mesh-drop").1, [None; 3]);
}

/// What is wrong, what the message must name, and the scene.
fn mistakes() -> Vec<(&'static str, Vec<&'static str>, String)> {
    let body = |lines: &str| format!("{HEAD}[[body]]\nname = \"cube\"\n{lines}\n");
    vec![
        (
            "an unknown key",
            vec!["colour", "scene.toml:6"],
            body("mass_kg = 1\ncolour = \"red\"\nshape.box.size_m = [1, 1, 1]"),
        ),
        (
            "a wrong type",
            vec!["heavy", "mass_kg", "scene.toml:5"],
            body("mass_kg = \"heavy\"\nshape.box.size_m = [1, 1, 1]"),
        ),
        (
            "a negative mass",
            vec!["-2.5", "mass_kg", "scene.toml:5"],
            body("mass_kg = -2.5\nshape.box.size_m = [1, 1, 1]"),
        ),
        ("a mass that is no number", vec!["nan", "mass_kg"], body("mass_kg = nan\nshape.box.size_m = [1, 1, 1]")),
        ("an unknown shape", vec!["boks", "box"], body("mass_kg = 1\nshape.boks.size_m = [1, 1, 1]")),
        ("a missing mesh", vec!["nowhere.obj"], body("mass_kg = 1\nshape.mesh.file = \"nowhere.obj\"")),
        ("a step of zero", vec!["dt_s", "0"], format!("duration_s = 1\ndt_s = 0\n{CUBE}")),
        ("a negative duration", vec!["duration_s", "-1"], format!("duration_s = -1\ndt_s = 0.01\n{CUBE}")),
        ("no TOML", vec!["1"], "this is = = no scene\n".into()),
        (
            "overlapping bodies",
            vec!["cube", "other"],
            format!("{HEAD}{CUBE}{}position_m = [0.5, 0.2, 0.1]\n", CUBE.replace("cube", "other")),
        ),
        ("two bodies of one name", vec!["cube"], format!("{HEAD}{CUBE}{CUBE}position_m = [5, 0, 0]\n")),
    ]
}

#[test]
fn mistakes_in_a_scene_are_named_and_nothing_is_written() {
    for (what, names, text) in mistakes() {
        for more in [&[][..], &["--out", "here/deep"][..]] {
            let (directory, ended) = run_text(&text, more);
            assert_eq!(ended.code, Some(2), "{what}\n{}{}", ended.out, ended.err);
            assert_eq!(listing(directory.path()), ["scene.toml"], "{what} leaves files");
            assert!(ended.out.is_empty(), "{what} prints on standard output");
            for name in &names {
                assert!(ended.err.contains(name), "{what}: `{name}` is not in\n{}", ended.err);
            }
            assert!(ended.err.contains("scene.toml"), "{what}: the file is not named\n{}", ended.err);
            // What is wanted instead: as a help line, or in the label at the value.
            let wanted = ["help", "expected", "must be"].iter().any(|word| ended.err.contains(word));
            assert!(wanted, "{what}: no remedy\n{}", ended.err);
        }
    }
}

#[test]
fn what_is_no_scene_file_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let binary: Vec<u8> = (0..=255).cycle().take(4096).collect();
    fs::write(directory.path().join("binary.toml"), binary).unwrap();
    fs::create_dir(directory.path().join("folder.toml")).unwrap();
    fs::write(directory.path().join("empty.toml"), "").unwrap();
    let before = listing(directory.path());
    for name in ["binary.toml", "folder.toml", "empty.toml", "missing.toml"] {
        for command in ["run", "plan", "check"] {
            let ended = program(directory.path(), &[command, name]);
            assert_eq!(ended.code, Some(2), "{command} {name}\n{}", ended.err);
            assert!(ended.err.contains(name), "{}", ended.err);
            assert_eq!(listing(directory.path()), before);
        }
    }
}

const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
/// A cube with the top pushed in to a pit.
const DENTED: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nv 0.5 0.5 0.5\n\
    f 1 4 3\nf 1 3 2\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 8\n\
    f 5 6 9\nf 6 7 9\nf 7 8 9\nf 8 5 9\n";

#[test]
fn meshes_that_are_no_bodies_are_refused_and_nothing_is_written() {
    let scene = format!("{HEAD}[[body]]\nname = \"thing\"\nmass_kg = 1\nshape.mesh.file = \"thing.obj\"\n");
    for (what, word, mesh, alone) in [
        ("open", "not closed", format!("{TETRAHEDRON}f 1 3 2\nf 1 2 4\nf 1 4 3\n"), 2),
        ("inside out", "inside out", format!("{TETRAHEDRON}f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n"), 2),
        ("flat", "volume", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n".into(), 2),
        ("not convex", "convex", DENTED.into(), 0),
        ("no mesh", "thing.obj", "hello\n".into(), 2),
    ] {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("scene.toml"), &scene).unwrap();
        fs::write(directory.path().join("thing.obj"), mesh).unwrap();
        let ended = program(directory.path(), &["run", "scene.toml"]);
        assert_eq!(ended.code, Some(2), "{what}\n{}{}", ended.out, ended.err);
        assert!(ended.err.contains("thing.obj") && ended.err.contains(word), "{what}\n{}", ended.err);
        assert_eq!(listing(directory.path()), ["scene.toml", "thing.obj"], "{what}");
        let report = program(directory.path(), &["mesh", "thing.obj", "--json"]);
        let json: Value = serde_json::from_str(&report.out).unwrap_or_else(|e| panic!("{what}: {e}\n{}", report.out));
        assert_eq!(report.code, Some(alone), "{what}\n{}", report.out);
        assert_eq!(json["usable_as_body"], alone == 0, "{what}");
        assert_eq!(program(directory.path(), &["mesh", "thing.obj"]).code, Some(alone), "{what}");
    }
}

#[test]
fn a_box_that_comes_to_rest_ends_the_run_and_its_files_are_kept() {
    let floor = "[[body]]\nname = \"floor\"\nfixed = true\nshape.plane.normal = [0, 0, 1]\n";
    let scene = format!(
        "duration_s = 10\ndt_s = 0.01\nrecord_hz = 20\ngravity_m_s2 = [0, 0, -9.81]\n[contact]\nrestitution = 0.3\n{CUBE}\
         position_m = [0, 0, 1]\n{floor}"
    );
    let (directory, ended) = run_text(&scene, &[]);
    assert_eq!(ended.code, Some(1), "{}", ended.err);
    assert!(ended.err.contains("`cube`") && ended.err.contains("`floor`") && ended.err.contains(" s"), "{}", ended.err);
    let out = directory.path().join("out/scene");
    assert_eq!(listing(&out), FILES);
    let summary = summary(&out);
    let mut keys: Vec<&str> = summary.as_object().unwrap().keys().map(String::as_str).collect();
    keys.sort_unstable();
    let mut expected = SUMMARY;
    expected.sort_unstable();
    assert_eq!(keys, expected);
    assert!(summary["failure"].as_str().unwrap().contains("contact"));
    recorded_whole(&out, &summary);
    let events = rows(&out.join("events.csv"));
    assert_eq!(events.last().unwrap()[1], "contact_persists");
    assert!(events[..events.len() - 1].iter().all(|row| row[1] == "impact"));
    // The cube falls 0.5 m, in sqrt(2 h / g); bounces at 0.3 take (1 + 2 (0.3 + 0.09 + ..)) times that in all.
    let fall = (1.0_f64 / 9.81).sqrt();
    let end = fall * (1.0 + 2.0 * 0.3 / 0.7);
    assert!((number(&events[0][0]) - fall).abs() < 1e-9, "{}", events[0][0]);
    let ended_at = summary["sim_s"].as_f64().unwrap();
    assert!((ended_at - end).abs() < 0.02, "bounces end at {end} s, the run at {ended_at} s");
}

#[test]
fn a_body_that_turns_too_far_in_a_step_is_named_with_a_remedy() {
    let scene = format!("{HEAD}{CUBE}omega_body_rad_s = [1e3, 0, 0]\n");
    let (directory, ended) = run_text(&scene, &["--set", "solver.method=rk4"]);
    assert_eq!(ended.code, Some(1), "{}", ended.err);
    assert!(
        ended.err.contains("`cube`") && ended.err.contains("dt_s") && ended.err.contains("yoshida4"),
        "{}",
        ended.err
    );
    assert_eq!(listing(&directory.path().join("out/scene")), FILES, "what was recorded is kept");
    // What the message names helps.
    assert_eq!(run_text(&scene, &["--set", "solver.method=yoshida4"]).1.code, Some(0));
    assert_eq!(run_text(&scene, &[]).1.code, Some(0));
}

#[test]
fn a_place_that_cannot_be_written_is_a_failed_run_said_at_once() {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("scene.toml"), format!("{HEAD}{CUBE}")).unwrap();
    fs::write(directory.path().join("file"), "mine").unwrap();
    for out in ["file", "file/below"] {
        let ended = program(directory.path(), &["run", "scene.toml", "--out", out]);
        // The scene is right, so it is not 2 for the input's sake; the argument is not wrong in itself.
        assert_eq!(ended.code, Some(1), "{}", ended.err);
        assert!(ended.err.starts_with("error: ") && ended.err.contains(out), "{}", ended.err);
        assert_eq!(fs::read_to_string(directory.path().join("file")).unwrap(), "mine");
    }
}

#[test]
fn machine_readable_outputs_parse() {
    let directory = tempfile::tempdir().unwrap();
    for scene in shipped() {
        let ended = program(directory.path(), &["plan", &scene, "--json"]);
        assert_eq!(ended.code, Some(0));
        let plan: Value = serde_json::from_str(&ended.out).unwrap();
        let [bodies, particles] = ["bodies", "particles"].map(|key| plan[key].as_u64().unwrap());
        assert!(bodies + particles > 0 && plan["left_out"].is_array());
        assert_eq!(plan["particle_solver"].is_object(), particles > 0);
        assert_eq!(program(directory.path(), &["check", &scene]).code, Some(0));
    }
    let ended = program(directory.path(), &["schema"]);
    let schema: Value = serde_json::from_str(&ended.out).unwrap();
    assert!(schema["properties"]["duration_s"].is_object());
    let gem = scenes().join("meshes/gem.obj");
    let ended = program(directory.path(), &["mesh", gem.to_str().unwrap(), "--json"]);
    assert_eq!(ended.code, Some(0));
    let report: Value = serde_json::from_str(&ended.out).unwrap();
    assert_eq!(report["usable_as_body"], true);
    let ended = program(directory.path(), &["mesh", "missing.obj", "--json"]);
    assert_eq!(ended.code, Some(2));
    let report: Value = serde_json::from_str(&ended.out).unwrap();
    assert!(report["messages"][0].as_str().unwrap().contains("missing.obj"), "{report}");
    assert_eq!(listing(directory.path()), Vec::<String>::new(), "none of them writes a file");
}

#[test]
fn help_lists_the_commands_and_missing_arguments_are_user_errors() {
    let directory = tempfile::tempdir().unwrap();
    let ended = program(directory.path(), &["--help"]);
    assert_eq!(ended.code, Some(0));
    for command in ["run", "plan", "check", "schema", "mesh", "study"] {
        assert!(ended.out.lines().any(|line| line.trim_start().starts_with(command)), "{command}\n{}", ended.out);
        let ended = program(directory.path(), &[command, "--help"]);
        assert_eq!((ended.code, ended.out.contains("Usage:")), (Some(0), true), "{command}");
    }
    for wrong in [&["run"][..], &[], &["fly"], &["run", "a.toml", "--fast"], &["mesh"]] {
        assert_eq!(program(directory.path(), wrong).code, Some(2), "{wrong:?}");
    }
}

//! What users meet when a scene file is right, wrong, damaged or overridden.
//!
//! The texts of the messages are golden: `UPDATE_GOLDEN=1 cargo test --test scene` rewrites them,
//! and the difference is read before it is committed.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod bodies;
mod body_messages;
mod damage;
mod files;
mod messages;
mod overrides;
mod particle_messages;
mod particles;
mod values;

use std::fs;
use std::path::{Path, PathBuf};

use ga_physics::scene::{Rejected, Scene, SceneSource, parse};

/// A scene without mistakes that the cases below add theirs to.
const SOUND: &str = "duration_s = 1\ndt_s = 0.01\n";
const CUBE: &str = "[[body]]\nname = \"cube\"\nmass_kg = 1\nshape.box.size_m = [1, 1, 1]\n";

fn read(text: &str, sets: &[&str]) -> Result<(Scene, SceneSource), Rejected> {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    parse(SceneSource::from_text("scene.toml", text, &sets))
}

fn complaints(text: &str, sets: &[&str]) -> String {
    match read(text, sets) {
        Ok(_) => "(no complaint)".to_owned(),
        Err(rejected) => rejected.to_string(),
    }
}

fn assert_golden(file: &str, found: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(file);
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(&path, found).unwrap();
    }
    let expected = fs::read_to_string(&path).unwrap_or_default();
    for (line, (expected, found)) in expected.lines().zip(found.lines()).enumerate() {
        assert_eq!(found, expected, "{file}, line {}", line + 1);
    }
    assert_eq!(found.lines().count(), expected.lines().count(), "{file}: another length");
}

fn with_floor() -> String {
    format!(
        "{SOUND}gravity_m_s2 = [0, 0, -9.81]\n{CUBE}[[body]]\nname = \"floor\"\nfixed = true\n\
         shape.plane.normal = [0, 0, 1]\n"
    )
}

fn accepted(text: &str, sets: &[&str]) -> Scene {
    match read(text, sets) {
        Ok((scene, _)) => scene,
        Err(rejected) => panic!("{sets:?}\n{rejected}"),
    }
}

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}

fn shipped() -> Vec<PathBuf> {
    let entries = fs::read_dir(scenes()).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<PathBuf> = entries.filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    paths.sort();
    paths
}

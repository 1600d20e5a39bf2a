//! Files: the shipped scenes, and what is no scene.

use std::fs;

use ga_physics::scene::load;

use crate::{SOUND, shipped};

#[test]
fn every_shipped_scene_loads() {
    let names: Vec<String> = shipped()
        .iter()
        .map(|path| {
            if let Err(rejected) = load(path, &[]) {
                panic!("{rejected}");
            }
            path.file_stem().unwrap().to_string_lossy().into_owned()
        })
        .collect();
    for name in [
        "bead-on-circle",
        "body-chain",
        "chain",
        "compound-pendulum",
        "cube-and-pyramid",
        "door",
        "double-pendulum",
        "four-bar",
        "free-collision",
        "heavy-top",
        "matrix-drift",
        "mesh-drop",
        "orbit",
        "particle-net",
        "pendulum",
        "projectile-drag",
        "tennis-racket",
        "three-bodies",
    ] {
        assert!(names.iter().any(|found| found == name), "{name} is not among {names:?}");
    }
}

#[test]
fn files_that_are_no_scenes_are_named_as_what_they_are() {
    let dir = tempfile::tempdir().unwrap();
    let file = |name: &str, bytes: &[u8]| {
        let path = dir.path().join(name);
        fs::write(&path, bytes).unwrap();
        path
    };
    let cases = [
        (dir.path().join("missing.toml"), "does not exist"),
        (dir.path().to_owned(), "is a directory"),
        (file("binary.toml", b"dt_s\0\x01\x02"), "is a binary file"),
        (file("latin.toml", b"dt_s = 1\n# gr\xFC\xDF\n"), "line 2 is not UTF-8 text"),
        (file("gem.obj", b"v 0 0 0\n"), "is a mesh, not a scene"),
        (file("empty.toml", b""), "the scene has no `duration_s`"),
    ];
    for (path, expected) in cases {
        let rejected = load(&path, &[]).unwrap_err();
        let text = rejected.to_string();
        assert!(text.contains(expected), "expected {expected:?} in: {text}");
        assert!(text.contains(&path.display().to_string()), "the path is not in: {text}");
    }
}

#[test]
fn a_mesh_file_is_looked_for_beside_the_scene() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("scene.toml");
    let text = format!("{SOUND}[[body]]\nname = \"a\"\nmass_kg = 1\nshape.mesh.file = \"a.obj\"\n");
    fs::write(&path, text).unwrap();
    assert!(load(&path, &[]).unwrap_err().to_string().contains("does not exist"));
    fs::write(dir.path().join("a.obj"), "").unwrap();
    let (_, source) = load(&path, &[]).unwrap();
    assert_eq!(source.resolve("a.obj"), dir.path().join("a.obj"));
}

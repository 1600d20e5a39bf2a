//! Mass properties kept beside a mesh: every bit comes back, and a file that does not fit the mesh is refused by name.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that cannot be set up should stop there")]

use std::fs;
use std::path::{Path, PathBuf};

use ga_physics::algebra::cga::Point;
use ga_physics::cli::mesh::{Options, run};
use ga_physics::geometry::mass_properties::{MassProperties, mass_properties};
use ga_physics::io::mass_file::{self, Fingerprint, KeptMass, MassFileError};
use ga_physics::io::mesh_file::read_mesh;
use ga_physics::scene::build::build;
use ga_physics::scene::{SceneSource, parse};
use sha2::{Digest, Sha256};

const TETRAHEDRON: &str = "v 0.1 0 0\nv 1 0 0.7\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// A mesh in a directory of its own, and what is kept of it.
struct Kept {
    directory: tempfile::TempDir,
}

impl Kept {
    fn new() -> Self {
        let kept = Self { directory: tempfile::tempdir().unwrap() };
        fs::write(kept.mesh(), TETRAHEDRON).unwrap();
        let options = Options { file: kept.mesh(), json: false, save: true };
        let mut out = Vec::new();
        assert_eq!(run(&options, &mut out).unwrap(), 0);
        assert!(String::from_utf8(out).unwrap().contains("note: mass properties kept in "));
        kept
    }

    fn mesh(&self) -> PathBuf {
        self.directory.path().join("solid.obj")
    }

    fn file(&self) -> PathBuf {
        mass_file::path_beside(&self.mesh())
    }

    fn read(&self) -> Result<Option<KeptMass>, MassFileError> {
        mass_file::read(&self.mesh(), &read_mesh(&self.mesh()).unwrap().fingerprint)
    }

    /// Replaces words above the checksum, which is made right again.
    fn forge(&self, from: &str, to: &str) {
        let text = fs::read_to_string(self.file()).unwrap();
        assert!(text.contains(from), "no `{from}` in\n{text}");
        let above = text[..text.rfind("checksum").unwrap()].replacen(from, to, 1);
        let digest: String = Sha256::digest(above.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect();
        fs::write(self.file(), format!("{above}checksum = \"{digest}\"\n")).unwrap();
    }

    /// The state at the start of a scene with this mesh, or what is wrong with it.
    fn built(&self, scale: f64) -> Result<String, String> {
        let scene = format!(
            "duration_s = 1\ndt_s = 0.01\n[[body]]\nname = \"a\"\nmass_kg = 2\nscale = {scale:?}\n\
             omega_body_rad_s = [1, 2, 3]\nshape.mesh.file = \"solid.obj\"\n"
        );
        let source = SceneSource::from_text(self.directory.path().join("scene.toml"), scene, &[]);
        let (scene, source) = parse(source).map_err(|rejected| rejected.render(false))?;
        let built = build::<f64>(&scene, &source).map_err(|mistakes| format!("{mistakes:?}"))?;
        Ok(format!("{:?}", built.setup.bodies))
    }
}

#[test]
fn what_is_kept_comes_back_to_the_last_bit() {
    let kept = Kept::new();
    let expected = mass_properties(&read_mesh(&kept.mesh()).unwrap().mesh).unwrap();
    assert_eq!(kept.read().unwrap(), Some(KeptMass { convex: true, properties: expected }));
    // Numbers of all magnitudes, of both signs, and zeros.
    for exponent in [-300, -17, 0, 5, 250] {
        let x = |digits: f64| digits * 10f64.powi(exponent);
        let properties = MassProperties {
            volume: x(0.1),
            centre: Point::new(x(-1.0 / 3.0), 0.0, x(f64::EPSILON)),
            inertia_unit_density: [[x(2.0 / 3.0), -0.0, x(-0.7)], [0.0, x(1.1), 0.0], [x(-0.7), 0.0, x(1.3)]],
        };
        let (print, kept_mass) = (Fingerprint::of(b"solid"), KeptMass { convex: false, properties });
        mass_file::write(&kept.mesh(), &print, &kept_mass).unwrap();
        assert_eq!(mass_file::read(&kept.mesh(), &print).unwrap(), Some(kept_mass));
    }
}

#[test]
fn people_can_read_the_file_and_check_it_with_common_tools() {
    let kept = Kept::new();
    let text = fs::read_to_string(kept.file()).unwrap();
    assert!(kept.file().ends_with("solid.obj.mass.toml"));
    let digest = Sha256::digest(TETRAHEDRON.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect::<String>();
    for line in ["format = 1", &format!("mesh_bytes = {}", TETRAHEDRON.len()), "convex = true", &digest] {
        assert!(text.contains(line), "no `{line}` in\n{text}");
    }
    assert!(toml::from_str::<toml::Table>(&text).is_ok());
    let names: Vec<_> = fs::read_dir(kept.directory.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(names.len(), 2, "no temporary file is left: {names:?}");
}

#[test]
fn without_a_file_there_is_nothing_to_refuse() {
    let kept = Kept::new();
    fs::remove_file(kept.file()).unwrap();
    assert!(matches!(kept.read(), Ok(None)));
}

/// A scene runs on the kept numbers as it does on its own, at any scale, and knows when they are none of its mesh's.
#[test]
fn scenes_use_it_and_are_the_same_to_the_last_bit() {
    let kept = Kept::new();
    for scale in [1.0, 0.3, 7.0] {
        let with = kept.built(scale).unwrap();
        let aside = kept.directory.path().join("aside");
        fs::rename(kept.file(), &aside).unwrap();
        assert_eq!(with, kept.built(scale).unwrap());
        fs::rename(&aside, kept.file()).unwrap();
    }
    // It is used: other numbers, rightly closed, are another body.
    let right = kept.built(1.0).unwrap();
    kept.forge("volume_m3 = 1", "volume_m3 = 2");
    assert_ne!(kept.built(1.0).unwrap(), right);
    kept.forge("convex = true", "convex = false");
    assert!(kept.built(1.0).unwrap_err().contains("not convex"));
}

/// Every way in which the file can be wrong has its name and the remedy, at `mesh` (a warning) and in scenes (an error).
fn assert_refused(kept: &Kept, is: fn(&MassFileError) -> bool, words: &str) {
    let error = kept.read().unwrap_err();
    let told = error.to_string();
    assert!(is(&error) && told.contains(words), "expected `{words}`, found `{told}`");
    for part in ["solid.obj.mass.toml", "delete it, or make it anew: `ga-physics mesh ", "solid.obj --save`"] {
        assert!(told.contains(part), "no `{part}` in `{told}`");
    }
    let scene = kept.built(1.0).unwrap_err();
    assert!(scene.contains(words), "{scene}");
    let mut out = Vec::new();
    let code = run(&Options { file: kept.mesh(), json: false, save: false }, &mut out).unwrap();
    let report = String::from_utf8(out).unwrap();
    assert!(code == 0 && report.contains("warning: ") && report.contains(words), "{report}");
    // The remedy helps.
    run(&Options { file: kept.mesh(), json: true, save: true }, &mut Vec::new()).unwrap();
    kept.read().unwrap().unwrap();
    kept.built(1.0).unwrap();
}

#[test]
fn a_changed_mesh_makes_it_stale() {
    let kept = Kept::new();
    // The same length, one digit; then another length, of the same solid.
    fs::write(kept.mesh(), TETRAHEDRON.replace("0.7", "0.6")).unwrap();
    assert_refused(&kept, |e| matches!(e, MassFileError::Stale { .. }), "stale, made from another content of the mesh");
    fs::write(kept.mesh(), format!("{TETRAHEDRON}# more\n")).unwrap();
    assert_refused(&kept, |e| matches!(e, MassFileError::Stale { .. }), "stale, made from another content of the mesh");
}

#[test]
fn cut_anywhere_it_is_truncated() {
    let kept = Kept::new();
    let whole = fs::read(kept.file()).unwrap();
    for length in (0..whole.len()).filter(|&length| std::str::from_utf8(&whole[..length]).is_ok()) {
        fs::write(kept.file(), &whole[..length]).unwrap();
        assert!(matches!(kept.read(), Err(MassFileError::Truncated { .. })), "{length} of {} bytes", whole.len());
    }
    fs::write(kept.file(), &whole[..whole.len() / 2]).unwrap();
    assert_refused(&kept, |e| matches!(e, MassFileError::Truncated { .. }), "cut short");
}

#[test]
fn any_changed_byte_is_noticed() {
    let kept = Kept::new();
    let whole = fs::read(kept.file()).unwrap();
    for place in 0..whole.len() {
        let mut altered = whole.clone();
        altered[place] ^= 1;
        fs::write(kept.file(), &altered).unwrap();
        assert!(kept.read().is_err(), "byte {place}");
    }
    let text = String::from_utf8(whole).unwrap();
    fs::write(kept.file(), text.replace("convex = true", "convex = false")).unwrap();
    assert_refused(&kept, |e| matches!(e, MassFileError::Altered { .. }), "altered since it was written");
}

#[test]
fn what_is_whole_and_not_understood_is_malformed() {
    type Is = fn(&MassFileError) -> bool;
    let malformed: Is = |e| matches!(e, MassFileError::Malformed { .. });
    let cases: [(&str, &str, Is, &str); 7] = [
        ("format = 1", "format = 2", |e| matches!(e, MassFileError::OtherFormat { format: 2, .. }), "format 2, where"),
        ("format = 1\n", "", malformed, "missing field `format`"),
        ("format = 1", "format = 1\ncolour = 3", malformed, "unknown field `colour`"),
        ("convex = true", "convex = 1", malformed, "invalid type"),
        ("volume_m3 = ", "volume_m3 = -", malformed, "numbers that no solid has"),
        ("centre_m = [", "centre_m = [nan, ", malformed, "numbers that no solid has"),
        ("convex = true", "convex = ", malformed, "solid.obj.mass.toml"),
    ];
    for (from, to, is, words) in cases {
        let kept = Kept::new();
        kept.forge(from, to);
        assert_refused(&kept, is, words);
    }
    let kept = Kept::new();
    fs::write(kept.file(), [0xff, 0xfe, 0]).unwrap();
    assert_refused(&kept, malformed, "not UTF-8");
    fs::remove_file(kept.file()).unwrap();
    fs::create_dir(kept.file()).unwrap();
    assert!(matches!(kept.read(), Err(MassFileError::Unreadable { .. })));
}

#[test]
fn what_is_no_body_is_not_kept() {
    let directory = tempfile::tempdir().unwrap();
    let bad = |name: &str, text: &str| -> (u8, String, PathBuf) {
        let path: &Path = &directory.path().join(name);
        fs::write(path, text).unwrap();
        let mut out = Vec::new();
        let code = run(&Options { file: path.into(), json: false, save: true }, &mut out).unwrap();
        (code, String::from_utf8(out).unwrap(), mass_file::path_beside(path))
    };
    let open = TETRAHEDRON.replace("f 2 3 4\n", "");
    let inside_out = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
    let turned = TETRAHEDRON.replace("f 2 3 4", "f 2 4 3");
    let flat = TETRAHEDRON.replace("v 0 0 1", "v 0 0.3 0").replace("0.7", "0");
    for (name, text, words) in [
        ("open.obj", open.as_str(), "close the holes"),
        ("inside-out.obj", inside_out, "reverse the winding"),
        ("turned.obj", &turned, "wound against the rest"),
        ("flat.obj", &flat, "encloses no volume"),
    ] {
        let (code, report, beside) = bad(name, text);
        assert!(code == 2 && report.contains(words) && report.contains("nothing to keep"), "{report}");
        assert!(!beside.exists());
    }
}

//! Mesh files in their dialects, broken ones, and the `mesh` command on them.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that cannot be set up should stop there")]

#[path = "support/shapes.rs"]
mod shapes;

use std::fs;
use std::path::{Path, PathBuf};

use ga_physics::cli::mesh::{Options, run};
use ga_physics::geometry::mass_properties::{mass_properties, principal_axes};
use ga_physics::geometry::mesh::Mesh;
use ga_physics::geometry::mesh_checks::check;
use ga_physics::io::mesh_file::{MeshFile, MeshFileError, read_mesh};
use shapes::*;

fn file(directory: &Path, name: &str, contents: impl AsRef<[u8]>) -> PathBuf {
    let path = directory.join(name);
    fs::write(&path, contents).unwrap();
    path
}

fn read(name: &str, contents: impl AsRef<[u8]>) -> Result<MeshFile, MeshFileError> {
    let directory = tempfile::tempdir().unwrap();
    read_mesh(&file(directory.path(), name, contents))
}

const OBJ_CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

fn binary_stl(mesh: &Mesh, header: &[u8], count: u32) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend(count.to_le_bytes());
    for &t in &mesh.triangles {
        bytes.extend([0; 12]);
        for p in mesh.corners(t) {
            #[expect(clippy::cast_possible_truncation, reason = "STL holds f32")]
            bytes.extend([p.x, p.y, p.z].iter().flat_map(|&x| (x as f32).to_le_bytes()));
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn ascii_stl(mesh: &Mesh, name: &str) -> String {
    let mut text = format!("solid{name}\n");
    for &t in &mesh.triangles {
        text += " facet normal 0 0 0\n  outer loop\n";
        for p in mesh.corners(t) {
            text += &format!("   vertex {} {} {:e}\n", p.x, p.y, p.z);
        }
        text += "  endloop\n endfacet\n";
    }
    text + "endsolid\n"
}

#[test]
fn obj_dialects_give_the_same_tetrahedron() {
    let plain = read("a.obj", format!("{OBJ_CORNERS}f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")).unwrap();
    assert_eq!(mass_properties(&plain.mesh).unwrap(), mass_properties(&corner_tetrahedron()).unwrap());
    for (name, text) in [
        ("negative", format!("{OBJ_CORNERS}f -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1\n")),
        (
            "textured",
            format!(
                "{OBJ_CORNERS}vt 0 0\nvn 0 0 1\nf 1/1/1 3/1/1 2/1/1\nf 1//1 2//1 4//1\nf 1/9223372036854775807/9 4/1 3/1\nf 2 3 4\n"
            ),
        ),
        ("facets first", format!("f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n{OBJ_CORNERS}")),
        (
            "objects",
            format!(
                "mtllib none.mtl\no one\n{OBJ_CORNERS}usemtl red\nf 1 3 2\nf 1 2 4\no two\ng three\nf 1 4 3\ns off\nf 2 3 4\n"
            ),
        ),
        (
            "objects of their own vertices",
            format!("o one\n{OBJ_CORNERS}f 1 3 2\nf 1 2 4\no two\n{OBJ_CORNERS}f 5 8 7\nf 6 7 8\n"),
        ),
        (
            "comments, continued lines, CRLF",
            format!("{OBJ_CORNERS}# a\nf 1 3 2 # base\r\nf 1 \\\r\n 2 4\nf 1 4 \\\n3\n\tf 2 3 4")
                .replace('\n', "\r\n")
                .replace("\r\r", "\r"),
        ),
        (
            "colours, weights, lines, points",
            format!("{OBJ_CORNERS}v 5 5 5 1 0 0\nv 6 6 6 2\nl 1 2 3\np 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"),
        ),
    ] {
        let file = read("b.OBJ", &text).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(file.mesh, plain.mesh, "{name}");
        assert_eq!(file.unused_vertices, if name.starts_with("colours") { 2 } else { 0 }, "{name}");
    }
    let latin = [b"o caf\xe9\n".as_slice(), OBJ_CORNERS.as_bytes(), b"f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"].concat();
    assert_eq!(read("latin.obj", latin).unwrap().mesh, plain.mesh);
}

#[test]
fn polygons_become_fans() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
                f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    let report = check(&read("cube.obj", text).unwrap().mesh);
    assert!(report.convex && report.counts.triangles == 12 && report.volume == Some(1.0));
    let hexagon = "v 1 0 0\nv 1 1 0\nv 0 2 0\nv -1 1 0\nv -1 0 0\nv 0 -1 0\nf 1 2 3 4 5 6\n";
    assert_eq!(read("hexagon.obj", hexagon).unwrap().mesh.triangles, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]);
}

#[test]
fn broken_obj_files_name_the_line() {
    for (text, words) in [
        (String::new(), "no geometry"),
        ("\0\u{1}\u{2}\u{fffd} junk \u{7f}".into(), "no geometry"),
        (OBJ_CORNERS.into(), "no facets"),
        (format!("{OBJ_CORNERS}f 1 2 0\n"), ":5: `0` is not the index"),
        (format!("{OBJ_CORNERS}\nf 1 2 5\n"), ":6: the facet uses vertex 5, but the file has 4"),
        (format!("{OBJ_CORNERS}f -5 2 3\n"), ":5: the facet uses vertex -5"),
        (format!("f -1 -2 -3\n{OBJ_CORNERS}"), ":1: the facet uses vertex -1, but the file has 4, 0 of them before"),
        (format!("{OBJ_CORNERS}f 1 2 9223372036854775807\n"), ":5: the facet uses vertex 9223372036854775807"),
        (format!("{OBJ_CORNERS}f 1 2 -9223372036854775808\n"), ":5: the facet uses vertex -9223372036854775808"),
        (format!("{OBJ_CORNERS}f 1 2 99999999999999999999999\n"), ":5: `99999999999999999999999` is not the index"),
        (format!("{OBJ_CORNERS}f 1 2\n"), ":5: a facet needs three corners or more, this one has 2"),
        (format!("{OBJ_CORNERS}f\n"), ":5: a facet needs three corners or more, this one has 0"),
        (format!("{OBJ_CORNERS}f 1 2 x\n"), ":5: `x` is not the index"),
        (format!("{OBJ_CORNERS}f 1 \\\n2 \\\n3\nf 1 2 /7\n"), ":8: `` is not the index"),
        ("v 0 0\nf 1 1 1\n".into(), ":1: a vertex needs three coordinates, this one has 2"),
        ("v 0 0 0\nv nan 0 0\nf 1 1 1\n".into(), ":2: the coordinate `nan` is not a finite number"),
        ("v 0 0 0\nv 1e999 0 0\nf 1 1 1\n".into(), ":2: the coordinate `1e999` is not a finite number"),
        ("v 0 0 zero\nf 1 1 1\n".into(), ":1: the coordinate `zero` is not a finite number"),
    ] {
        let error = read("broken.obj", &text).unwrap_err().to_string();
        assert!(error.contains(words) && error.contains("broken.obj"), "expected `{words}`, found `{error}`");
    }
}

#[test]
fn stl_files_are_read_whatever_they_begin_with() {
    let solid = moved(&l_prism(), [0.1, 0.2, 0.3]);
    let rounded = |p: &f64| {
        #[expect(clippy::cast_possible_truncation, reason = "STL holds f32")]
        let single = *p as f32;
        f64::from(single)
    };
    let vertices = solid.vertices.iter().map(|p| point(rounded(&p.x), rounded(&p.y), rounded(&p.z))).collect();
    let exact = mass_properties(&Mesh::new(vertices, solid.triangles.clone()).unwrap()).unwrap();
    let n = u32::try_from(solid.triangles.len()).unwrap();
    let halves = [0..10, 10..solid.triangles.len()]
        .map(|r| Mesh::new(solid.vertices.clone(), solid.triangles[r].to_vec()).unwrap());
    let two = ascii_stl(&halves[0], " one") + &ascii_stl(&halves[1], " two");
    for (name, bytes) in [
        ("binary", binary_stl(&solid, b"made by a test", n)),
        ("binary with a header like text", binary_stl(&solid, b"solid made by a test", n)),
        ("ascii", ascii_stl(&solid, " named").into_bytes()),
        ("ascii without a name", ascii_stl(&solid, "").into_bytes()),
        ("ascii in capitals", ascii_stl(&solid, " x").to_uppercase().into_bytes()),
        ("ascii with CRLF", ascii_stl(&solid, " x").replace('\n', "\r\n").into_bytes()),
        ("two solids", two.into_bytes()),
    ] {
        let file = read("solid.stl", bytes).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(file.mesh.vertices.len(), 12, "{name}");
        assert_eq!(file.welded_vertices, 3 * solid.triangles.len() - 12, "{name}");
        assert_eq!(mass_properties(&file.mesh).unwrap(), exact, "{name}");
    }
}

#[test]
fn broken_stl_files_are_refused_without_panic_or_hunger() {
    let solid = cube();
    let mut cut = binary_stl(&solid, b"x", 12);
    cut.truncate(84 + 50 * 7 + 13);
    let mut not_a_number = binary_stl(&solid, b"x", 12);
    not_a_number[84 + 12..84 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    let text = ascii_stl(&solid, " x");
    for (name, bytes, words) in [
        ("empty", vec![], "not an STL file"),
        ("junk", b"\x00\xff\xfe junk".to_vec(), "not an STL file"),
        ("cut", cut, "cut short: the count says 12 triangles, there are 7"),
        (
            "huge count",
            binary_stl(&solid, b"x", u32::MAX),
            "cut short: the count says 4294967295 triangles, there are 12",
        ),
        ("small count", binary_stl(&solid, b"x", 3), "the count says 3 triangles, the file holds 12"),
        ("no facets", binary_stl(&solid, b"x", 0)[..84].to_vec(), "no triangles"),
        ("no facets, ascii", b"solid x\nendsolid x\n".to_vec(), "no triangles"),
        ("nan", not_a_number, "vertex 0 (counted from 0) is (NaN"),
        ("infinite", text.replacen("vertex -0.5", "vertex 1e39", 1).into_bytes(), "expected finite"),
        ("nan, ascii", text.replacen("vertex -0.5", "vertex nan", 1).into_bytes(), "finite"),
        ("two corners", text.replacen("   vertex", "   vortex", 1).into_bytes(), "facet 0"),
        ("cut ascii", text.as_bytes()[..400].to_vec(), "cut short"),
    ] {
        let error = read("broken.stl", bytes).unwrap_err().to_string();
        assert!(error.contains(words) && error.contains("broken.stl"), "{name}: expected `{words}`, found `{error}`");
    }
}

#[test]
fn missing_files_and_other_formats_say_so() {
    let error = read_mesh(Path::new("no/such/mesh.obj")).unwrap_err().to_string();
    assert!(error.contains("no/such/mesh.obj") && error.contains("check the path"), "{error}");
    for name in ["mesh.ply", "mesh", "obj"] {
        let error = read(name, "v 0 0 0").unwrap_err().to_string();
        assert!(error.contains(name) && error.contains(".obj or .stl"), "{error}");
    }
}

fn run_on(path: &Path, json: bool) -> (u8, String) {
    let mut out = Vec::new();
    let code = run(&Options { file: path.into(), json, save: false }, &mut out).unwrap();
    (code, String::from_utf8(out).unwrap())
}

#[test]
fn the_json_has_exactly_the_promised_fields() {
    let fields = "triangles closed oriented manifold convex usable_as_body volume_m3 centre_m inertia_unit_density \
                  principal_moments_unit_density principal_axes sphere_centre_m sphere_radius_m messages";
    let directory = tempfile::tempdir().unwrap();
    let tetrahedron = format!("{OBJ_CORNERS}f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    let good = file(directory.path(), "good.obj", &tetrahedron);
    let open = file(directory.path(), "open.obj", tetrahedron.replace("f 2 3 4\n", ""));
    let inside_out = file(
        directory.path(),
        "inside-out.obj",
        tetrahedron
            .replace("1 3 2", "1 2 3")
            .replace("1 2 4", "1 4 2")
            .replace("1 4 3", "1 3 4")
            .replace("2 3 4", "2 4 3"),
    );
    for (path, code, triangles, volume, centre) in [
        (good, 0, 4, Some(1.0 / 6.0), Some(0.25)),
        (open, 2, 3, None, None),
        (inside_out, 2, 4, Some(-1.0 / 6.0), None),
        (PathBuf::from("no/such/mesh.obj"), 2, 0, None, None),
    ] {
        let (found, text) = run_on(&path, true);
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        let object = json.as_object().unwrap();
        let mut names: Vec<&str> = fields.split_whitespace().collect();
        names.sort_unstable();
        assert_eq!(object.keys().map(String::as_str).collect::<Vec<_>>(), names);
        assert_eq!((found, json["usable_as_body"].as_bool()), (code, Some(code == 0)), "{text}");
        assert_eq!(json["triangles"], triangles);
        assert_eq!(json["volume_m3"].as_f64(), volume);
        assert_eq!(json["centre_m"][2].as_f64(), centre);
        assert_eq!(json["inertia_unit_density"].is_null(), centre.is_none());
        assert_eq!(json["messages"][0].as_str().is_some_and(|m| m.starts_with("error: ")), code == 2, "{text}");
    }
}

#[test]
fn the_text_reads_and_the_exit_code_is_right() {
    let directory = tempfile::tempdir().unwrap();
    let path =
        file(directory.path(), "extra.obj", format!("{OBJ_CORNERS}v 9 9 9\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"));
    let (code, text) = run_on(&path, false);
    assert_eq!(code, 0);
    for words in [
        "usable as a body",
        "convex          yes",
        "volume          0.16666666666666666 m³",
        "note: 1 vertex of the file",
    ] {
        assert!(text.contains(words), "no `{words}` in:\n{text}");
    }
    // The vertex that no facet uses does not count for the sphere.
    let (_, json) = run_on(&path, true);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert!(json["sphere_radius_m"].as_f64().unwrap() < 0.9, "{json}");
    let missing = Options { file: "no/such/mesh.obj".into(), json: false, save: true };
    assert!(run(&missing, &mut Vec::new()).is_err());
}

#[test]
fn the_gem_is_a_convex_body_that_tumbles() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/meshes/gem.obj");
    let gem = read_mesh(&path).unwrap().mesh;
    let report = check(&gem);
    assert!(
        report.usable_as_body && report.manifold && report.convex && report.messages.is_empty(),
        "{:?}",
        report.messages
    );
    let [a, b, c] = principal_axes(mass_properties(&gem).unwrap().inertia_unit_density).unwrap().moments;
    assert!(b > 1.02 * a && c > 1.02 * b, "moments {a}, {b}, {c}");
}

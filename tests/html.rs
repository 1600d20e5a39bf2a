//! Laws of `run.html`: what is stored comes back, names are text whatever they hold, the page refers to nothing outside.
//!
//! The look and the behaviour in a browser are judged by `tests/viewer/check.py`; `cargo test` needs no browser.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test fails by panicking")]

#[path = "html/sample.rs"]
mod sample;

use base64::{Engine as _, engine::general_purpose::STANDARD as BASE64};
use ga_physics::io::html::{BodyView, EnergySample, Guide, Mark, ParticlesView, Playback, Shape, render};
use serde_json::Value;

const HOSTILE: [&str; 9] = [
    "</script><img src=x onerror=alert(1)>",
    "<!--<script>",
    "\"quoted\" and 'single' \\ back",
    "{{script}} {{poses}} }}",
    "line\u{2028}and\u{2029}paragraph",
    "</title><script>alert(2)</script>",
    "&lt;b&gt; &amp;",
    "\u{0}\n\r\t\u{202e}",
    "",
];

/// The text of the element with this id; the block ends where a browser would end it.
fn block<'a>(page: &'a str, id: &str) -> &'a str {
    let (_, rest) = page.split_once(&format!("id=\"{id}\">")).unwrap();
    rest.split_once("</script").unwrap().0
}

fn index(page: &str) -> Value {
    serde_json::from_str(block(page, "ga-index")).unwrap()
}

fn f64s(page: &str, id: &str) -> Vec<f64> {
    let bytes = BASE64.decode(block(page, id)).unwrap();
    bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
}

fn f32s(text: &str) -> Vec<f32> {
    let bytes = BASE64.decode(text).unwrap();
    bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect()
}

fn u32s(text: &str) -> Vec<u32> {
    let bytes = BASE64.decode(text).unwrap();
    bytes.chunks_exact(4).map(|b| u32::from_le_bytes(b.try_into().unwrap())).collect()
}

fn count(page: &str, part: &str) -> usize {
    page.to_lowercase().matches(part).count()
}

fn hostile(name: &str) -> Playback<'_> {
    Playback {
        scene: name,
        bodies: vec![BodyView { name: name.to_owned(), fixed: false, shape: sample::cube(1.0) }],
        times_s: vec![0.0],
        poses: vec![vec![[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]]],
        stretched: vec![],
        links: vec![],
        particles: ParticlesView {
            names: vec![name.to_owned()],
            groups: vec![(name.to_owned(), 1)],
            fixed: vec![false],
            masses: vec![1.0],
            positions: vec![vec![[0.0; 3]]],
            ..ParticlesView::default()
        },
        marks: vec![Mark {
            time_s: 0.0,
            a: name.to_owned(),
            b: name.to_owned(),
            point: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
            impulse_n_s: 1.0,
            kind: name.to_owned(),
        }],
        energy: vec![],
    }
}

#[test]
fn a_hostile_name_adds_no_markup_and_comes_back_unchanged() {
    let plain = render(&hostile("plain"));
    for name in HOSTILE {
        let page = render(&hostile(name));
        for part in ["<script", "</script", "<!--", "<img", "</title", "\u{2028}", "\u{2029}"] {
            assert_eq!(count(&page, part), count(&plain, part), "{part:?} from the name {name:?}");
        }
        let index = index(&page);
        assert_eq!(index["scene"], name);
        assert_eq!(index["bodies"][0]["name"], name);
        assert_eq!(index["particles"]["names"][0], name);
        assert_eq!(index["particles"]["groups"][0][0], name);
        assert_eq!(index["names"], serde_json::json!([name]));
    }
}

#[test]
fn the_title_shows_a_hostile_scene_name_as_text() {
    let page = render(&hostile("a</title><b> & \"c\""));
    assert!(page.contains("<title>a&lt;/title&gt;&lt;b&gt; &amp; &quot;c&quot;</title>"));
}

#[test]
fn every_placeholder_is_filled() {
    let page = render(&sample::tumbling("sample", [0.0; 3]));
    for name in ["title", "style", "script", "index", "times", "poses", "points", "energy", "marks", "mark_names"] {
        assert!(!page.contains(&format!("{{{{{name}}}}}")), "{name} was left in the page");
    }
    let page = render(&sample::pendulums("sample", 3, [0.0; 3]));
    for id in ["ga-times", "ga-points", "ga-energy"] {
        assert!(!block(&page, id).is_empty(), "{id} is empty");
    }
}

#[test]
fn the_page_refers_to_nothing_outside_itself() {
    let page = render(&sample::tumbling("sample", [0.0; 3]));
    for part in [
        "http:",
        "https:",
        "//cdn",
        " src=",
        "@import",
        "url(",
        "import(",
        "fetch(",
        "xmlhttprequest",
        "type=\"module\"",
    ] {
        assert_eq!(count(&page, part), 0, "{part} in the page");
    }
    assert_eq!(count(&page, "href="), count(&page, "href=\"data:,\""), "a link that leads somewhere");
    assert!(page.contains("default-src 'none'"), "the policy that forbids every request");
}

#[test]
fn poses_come_back_relative_to_the_centre() {
    let playback = sample::tumbling("sample", [0.0; 3]);
    let page = render(&playback);
    // Read digit by digit: serde_json's own reading of numbers may be an ulp off, a browser's is exact.
    let (_, rest) = block(&page, "ga-index").split_once("\"centre\":[").unwrap();
    let centre: Vec<f64> = rest.split_once(']').unwrap().0.split(',').map(|x| x.parse().unwrap()).collect();
    let stored = f32s(block(&page, "ga-poses"));
    let expected: Vec<f32> = playback
        .poses
        .iter()
        .flatten()
        .flat_map(|p| [p[0] - centre[0], p[1] - centre[1], p[2] - centre[2], p[3], p[4], p[5], p[6]])
        .map(|x| x as f32)
        .collect();
    assert!(stored == expected, "a stored pose differs");
    assert_eq!(f64s(&page, "ga-times"), playback.times_s);
}

#[test]
fn what_links_bodies_and_what_is_left_of_a_matrix_come_back() {
    let offset = [1e6, 0.0, -1e3];
    let playback = sample::linked("sample", offset);
    let index = index(&render(&playback));
    let links = index["links"].as_array().unwrap();
    let kinds: Vec<_> = links.iter().map(|link| link["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["ball", "hinge", "distance", "spring"]);
    assert_eq!(links[0]["ends"][1], serde_json::json!({ "body": 2, "point": [0.0, 0.0, 0.45] }));
    assert_eq!((&links[1]["axis"], &links[0]["axis"]), (&serde_json::json!([0.0, 1.0, 0.0]), &Value::Null));
    // Points of the world are relative to the scene's centre, as positions are.
    let numbers =
        |value: &Value| -> Vec<f64> { value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect() };
    let (centre, hook) = (numbers(&index["centre"]), numbers(&links[3]["ends"][0]["point"]));
    let expected = [0.0, 0.0, 3.0];
    assert!((0..3).all(|i| (hook[i] + centre[i] - offset[i] - expected[i]).abs() < 1e-9), "{hook:?} {centre:?}");
    assert!(links[3]["ends"][0]["body"].is_null());
    let [stretched] = &index["stretches"].as_array().unwrap()[..] else { panic!("one body") };
    let rows = f32s(stretched["rows"].as_str().unwrap());
    let stored: Vec<f32> = playback.stretched[0].stretch.iter().flatten().flatten().map(|x| *x as f32).collect();
    assert_eq!((stretched["body"].as_u64(), rows), (Some(3), stored));
    let profiles = index["shapes"].as_array().unwrap().iter().filter(|shape| !shape["revolution"].is_null()).count();
    assert_eq!(profiles, 2);
}

#[test]
fn a_stretch_that_is_missing_is_nan() {
    let mut playback = sample::linked("short", [0.0; 3]);
    playback.stretched[0].stretch.truncate(1);
    let index = index(&render(&playback));
    let rows = f32s(index["stretches"][0]["rows"].as_str().unwrap());
    assert_eq!(rows.len(), 9 * playback.times_s.len());
    assert!(rows[..9].iter().all(|x| x.is_finite()) && rows[9..].iter().all(|x| x.is_nan()));
}

#[test]
fn a_scene_far_from_the_origin_keeps_its_digits() {
    // 1e6 m is between 2^19 and 2^20 m: f64 has steps of 2^-33 m there, f32 steps of 2^-4 m.
    let offset = [1e6, -1e6, 1e6];
    let (near, far) = (render(&sample::tumbling("s", [0.0; 3])), render(&sample::tumbling("s", offset)));
    // Half a step each for the moved position, the middle, and their difference; then an f32 below 4 m, rounded twice.
    let bound = 1.5 * 2.0_f64.powi(-33) + 4.0 * f64::from(f32::EPSILON);
    let worst = f32s(block(&near, "ga-poses"))
        .into_iter()
        .zip(f32s(block(&far, "ga-poses")))
        .enumerate()
        .filter(|(i, _)| i / 7 % 4 != 0) // not the floor: its middle is far from the moving bodies' by nature
        .map(|(_, (a, b))| (f64::from(a) - f64::from(b)).abs())
        .fold(0.0, f64::max);
    assert!(worst <= bound, "worst difference {worst} m, bound {bound} m");
}

#[test]
fn the_centre_is_that_of_the_moving_bodies() {
    let body = |fixed| BodyView { name: String::new(), fixed, shape: sample::cube(1.0) };
    let at = |x: f64| [x, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let playback = Playback {
        scene: "",
        bodies: vec![body(true), body(false)],
        times_s: vec![0.0, 1.0],
        poses: vec![vec![at(-1e9), at(2.0)], vec![at(-1e9), at(f64::NAN)]],
        stretched: vec![],
        links: vec![],
        particles: ParticlesView::default(),
        marks: vec![],
        energy: vec![],
    };
    assert_eq!(index(&render(&playback))["centre"], serde_json::json!([2.0, 0.0, 0.0]));
}

#[test]
fn a_missing_pose_is_nan_and_an_extra_one_is_dropped() {
    let mut playback = hostile("short");
    playback.times_s = vec![0.0, 1.0, 2.0];
    let pose = playback.poses[0][0];
    playback.poses = vec![vec![], vec![pose, pose]];
    let stored = f32s(block(&render(&playback), "ga-poses"));
    assert_eq!(stored.len(), 3 * 7);
    assert!(stored[..7].iter().all(|x| x.is_nan()));
    assert_eq!(stored[7..14], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    assert!(stored[14..].iter().all(|x| x.is_nan()));
}

#[test]
fn positions_of_particles_come_back_relative_to_the_centre_and_what_is_missing_is_nan() {
    let mut playback = sample::pendulums("sample", 3, [1e6, -1e6, 1e6]);
    playback.particles.positions[1].truncate(2);
    let page = render(&playback);
    let index = index(&page);
    let centre: Vec<f64> = index["centre"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    let stored = f32s(block(&page, "ga-points"));
    assert_eq!(stored.len(), playback.times_s.len() * 3 * 3);
    for (frame, positions) in playback.particles.positions.iter().enumerate() {
        for (particle, position) in positions.iter().enumerate() {
            let at = 3 * (3 * frame + particle);
            for k in 0..3 {
                // The centre as serde_json reads it may be an ulp of 1e6 off.
                let expected = position[k] - centre[k];
                assert!(
                    (f64::from(stored[at + k]) - expected).abs() < 1e-9 + 1e-7 * expected.abs(),
                    "{frame} {particle}"
                );
            }
        }
    }
    assert!(stored[3 * 5..3 * 6].iter().all(|x| x.is_nan()), "the third particle of the second frame");
}

#[test]
fn what_ties_particles_together_comes_back() {
    let mut playback = sample::pendulums("sample", 4, [0.0; 3]);
    playback.particles.masses = vec![8.0, 1.0, 0.0, f64::NAN];
    playback.particles.fixed = vec![false, true, false, true];
    playback.particles.springs = vec![[3, 1]];
    playback.particles.guides.push(Guide::Circle { centre: [1.0, 2.0, 3.0], radius: 4.0, normal: [0.0, 0.0, 2.0] });
    let page = render(&playback);
    let particles = index(&page)["particles"].clone();
    let numbers = |key: &str| u32s(particles[key].as_str().unwrap());
    assert_eq!(numbers("links"), [0, 1, 1, 2, 2, 3]);
    assert_eq!(numbers("springs"), [3, 1]);
    assert_eq!(numbers("tethered"), [0]);
    assert_eq!(numbers("fixed"), [1, 3]);
    assert_eq!(f32s(particles["sizes"].as_str().unwrap()), [1.0, 0.5, 0.0, 0.0], "by the cube root of the mass");
    assert_eq!(particles["groups"], serde_json::json!([["first", 1], ["others", 3]]));
    let guides = particles["guides"].as_array().unwrap();
    assert_eq!(guides.last().unwrap()["circle"]["radius"], 4.0);
    let centre = index(&page)["centre"][0].as_f64().unwrap();
    assert_eq!(guides.last().unwrap()["circle"]["centre"][0].as_f64().unwrap(), 1.0 - centre);
}

#[test]
fn the_centre_counts_particles_that_move() {
    let mut playback = sample::pendulums("sample", 1, [0.0; 3]);
    playback.particles.positions = vec![vec![[5.0, 6.0, 7.0]]; playback.times_s.len()];
    assert_eq!(index(&render(&playback))["centre"], serde_json::json!([5.0, 6.0, 7.0]));
    // Beside a body that moves, one that is fixed does not count.
    playback.particles.fixed = vec![true];
    playback.bodies = vec![BodyView { name: String::new(), fixed: false, shape: sample::cube(1.0) }];
    playback.poses = vec![vec![[1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0]]; playback.times_s.len()];
    assert_eq!(index(&render(&playback))["centre"], serde_json::json!([1.0, 2.0, 3.0]));
}

#[test]
fn equal_shapes_are_stored_once_and_unharmed() {
    let mut playback = sample::crowd("crowd", 10);
    playback.bodies.push(BodyView { name: "odd".to_owned(), fixed: false, shape: sample::pyramid(0.5) });
    let index = index(&render(&playback));
    // The floor, the cube, the ellipsoid, the pyramid.
    assert_eq!(index["shapes"].as_array().unwrap().len(), 4);
    let numbers: Vec<u64> = (0..12).map(|i| index["bodies"][i]["shape"].as_u64().unwrap()).collect();
    assert_eq!(numbers, [0, 1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 3]);
    let Shape::Mesh { vertices, triangles } = sample::pyramid(0.5) else { unreachable!() };
    let mesh = &index["shapes"][3]["mesh"];
    let expected: Vec<f32> = vertices.iter().flatten().map(|x| *x as f32).collect();
    assert_eq!(f32s(mesh["vertices"].as_str().unwrap()), expected);
    assert_eq!(u32s(mesh["triangles"].as_str().unwrap()), triangles.as_flattened());
}

#[test]
fn marks_and_energy_come_back_bit_for_bit() {
    let playback = sample::tumbling("sample", [0.1, 0.2, 0.3]);
    let page = render(&playback);
    let numbers: Vec<f64> = playback
        .marks
        .iter()
        .flat_map(|m| {
            let ([x, y, z], [nx, ny, nz]) = (m.point, m.normal);
            [m.time_s, x, y, z, nx, ny, nz, m.impulse_n_s]
        })
        .collect();
    assert!(numbers.len() > 8 * 5, "the sample has impacts");
    assert_eq!(f64s(&page, "ga-marks"), numbers);
    let names = index(&page)["names"].clone();
    let stored = u32s(block(&page, "ga-mark-names"));
    for (mark, named) in playback.marks.iter().zip(stored.chunks_exact(3)) {
        let text: Vec<&str> = named.iter().map(|k| names[*k as usize].as_str().unwrap()).collect();
        assert_eq!(text, [&mark.a, &mark.b, &mark.kind]);
    }
    let energy: Vec<f64> =
        playback.energy.iter().flat_map(|e| [e.time_s, e.kinetic_j, e.potential_j, e.total_j]).collect();
    assert_eq!(f64s(&page, "ga-energy"), energy);
}

#[test]
fn values_that_are_not_finite_leave_the_page_readable() {
    let mut playback = hostile("nan");
    playback.poses[0][0] = [f64::INFINITY, f64::NAN, 1e300, f64::NAN, 0.0, 0.0, 0.0];
    playback.bodies.push(BodyView {
        name: "e".to_owned(),
        fixed: false,
        shape: Shape::Ellipsoid { semi_axes: [f64::NAN, 1.0, 2.0] },
    });
    playback.bodies.push(BodyView {
        name: "p".to_owned(),
        fixed: true,
        shape: Shape::Plane { normal: [f64::INFINITY; 3] },
    });
    playback.energy.push(EnergySample { time_s: 0.0, kinetic_j: f64::NAN, potential_j: f64::INFINITY, total_j: 0.0 });
    let index = index(&render(&playback));
    assert_eq!(index["centre"], serde_json::json!([0.0, 0.0, 0.0]));
    assert_eq!(index["shapes"][1]["ellipsoid"], serde_json::json!([null, 1.0, 2.0]));
}

#[test]
fn the_same_playback_gives_the_same_bytes() {
    let page = render(&sample::crowd("crowd", 40));
    assert_eq!(page, render(&sample::crowd("crowd", 40)));
    assert_ne!(page, render(&sample::crowd("crowd", 41)), "the comparison can fail");
}

/// `cargo test --test html -- --ignored` writes pages to look at, and to give to `tests/viewer/check.py`.
#[test]
#[ignore = "writes files to look at"]
fn write_samples() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("viewer");
    std::fs::create_dir_all(&folder).unwrap();
    let mut single = sample::tumbling("one frame, nothing else", [0.0; 3]);
    single.times_s.truncate(1);
    single.poses.truncate(1);
    single.bodies.remove(0);
    single.particles = ParticlesView::default();
    single.poses[0].remove(0);
    single.marks.clear();
    single.energy.clear();
    let mut names = sample::tumbling(HOSTILE[0], [0.0; 3]);
    for (body, name) in names.bodies.iter_mut().zip(HOSTILE) {
        body.name = name.to_owned();
    }
    for (mark, name) in names.marks.iter_mut().zip(HOSTILE.iter().cycle()) {
        mark.a = (*name).to_owned();
    }
    let mut broken = sample::tumbling("values that are not finite", [0.0; 3]);
    for frame in broken.poses.iter_mut().skip(60) {
        frame[1] = [f64::NAN; 7];
    }
    broken.energy[100].kinetic_j = f64::NAN;
    broken.marks[0].point = [f64::NAN; 3];
    broken.bodies.push(BodyView {
        name: "never".to_owned(),
        fixed: false,
        shape: Shape::Ellipsoid { semi_axes: [f64::NAN; 3] },
    });
    for (file, playback) in [
        ("tumbling", sample::tumbling("tumbling bodies", [0.0; 3])),
        ("far", sample::tumbling("a million metres away", [1e6, -1e6, 1e6])),
        ("single", single),
        ("names", names),
        ("broken", broken),
        ("crowd", sample::crowd("three hundred bodies", 300)),
        ("pendulums", sample::pendulums("pendulums of all lengths", 12, [1e5, 0.0, 0.0])),
        ("sheet", sample::sheet("ten thousand particles", 100)),
        ("guides", sample::guides("what particles stay on")),
        ("linked", sample::linked("linked bodies", [1e3, 0.0, 0.0])),
    ] {
        let path = folder.join(format!("{file}.html"));
        std::fs::write(&path, render(&playback)).unwrap();
        println!("{}", path.display());
    }
}

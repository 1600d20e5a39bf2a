//! Each mistake with the text that is shown for it.

use crate::{CUBE, SOUND, assert_golden, complaints, read};

/// Name and text of scenes with a mistake. `+` stands for the sound beginning, `#` for the cube.
const MISTAKES: &[(&str, &str)] = &[
    ("nothing", ""),
    ("no dt", "duration_s = 1\n"),
    ("toml syntax", "duration_s = = 1\ndt_s = 0.01\n"),
    ("toml unclosed text", "+[[body]]\nname = \"cube\nmass_kg = 1\n"),
    ("toml unclosed list", "+[[body]]\nname = \"cube\"\nposition_m = [1, 2\nmass_kg = 1\n"),
    ("toml duplicate key", "+dt_s = 0.02\n"),
    ("decimal comma", "duration_s = 1,5\ndt_s = 0.01\n"),
    ("unknown key", "+#mas_kg = 2\n"),
    ("key without its unit", "+[[body]]\nname = \"cube\"\nmass = 1\nshape.box.size_m = [1, 1, 1]\n"),
    ("top-level key below a header", "+#gravity_m_s2 = [0, 0, -9.81]\n"),
    ("unknown table", "+[contacts]\nrestitution = 1\n"),
    ("unknown method", "+[solver]\nmethod = \"tsit\"\n"),
    ("unknown name", "+formulation = \"dual\"\n[solver]\nscalar = \"f46\"\n"),
    ("unknown shape", "+[[body]]\nname = \"a\"\nmass_kg = 1\nshape.bax.size_m = [1, 1, 1]\n"),
    ("unknown key in a shape", "+[[body]]\nname = \"a\"\nmass_kg = 1\nshape.box.size = [1, 1, 1]\n"),
    ("two shapes", "+#shape.pyramid = { base_m = 1, height_m = 1 }\n"),
    ("no kind of force", "+#[[force]]\n"),
    ("shape without its size", "+[[body]]\nname = \"a\"\nmass_kg = 1\nshape.pyramid.base_m = 1\n"),
    ("text for a number", "duration_s = \"1\"\ndt_s = 0.01\n"),
    ("number for a list", "+gravity_m_s2 = -9.81\n"),
    ("list too short", "+gravity_m_s2 = [0, -9.81]\n"),
    ("list too long", "+gravity_m_s2 = [0, 0, -9.81, 0]\n"),
    ("text in a list", "+gravity_m_s2 = [0, 0, \"-9.81\"]\n"),
    ("name for a shape", "+[[body]]\nname = \"a\"\nmass_kg = 1\nshape = \"box\"\n"),
    ("number for a shape", "+[[body]]\nname = \"a\"\nmass_kg = 1\nshape = 1\n"),
    ("body without a name", "+[[body]]\nmass_kg = 1\nshape.box.size_m = [1, 1, 1]\n"),
    ("body as one table", "+[body]\nname = \"cube\"\nmass_kg = 1\n"),
    (
        "three vertices",
        "+[[body]]\nname = \"a\"\nmass_kg = 1\nshape.tetrahedron.vertices_m = [[0,0,0],[1,0,0],[0,1,0]]\n",
    ),
    (
        "not finite",
        "+gravity_m_s2 = [0, 0, nan]\n[[body]]\nname = \"a\"\nmass_kg = inf\nshape.box.size_m = [1, inf, 1]\n",
    ),
    ("number too large", "duration_s = 1e999\ndt_s = 0.01\n"),
    ("negative mass", "+[[body]]\nname = \"a\"\nmass_kg = -1\nshape.box.size_m = [1, 1, 1]\n"),
    ("zero mass", "+[[body]]\nname = \"a\"\nmass_kg = 0\nshape.box.size_m = [1, 1, 1]\n"),
    ("no mass", "+[[body]]\nname = \"a\"\nshape.box.size_m = [1, 1, 1]\n"),
    ("duplicate names", "+##"),
    ("empty name", "+[[body]]\nname = \"\"\nmass_kg = 1\nshape.box.size_m = [1, 1, 1]\n"),
    ("both angular velocities", "+#omega_world_rad_s = [1, 0, 0]\nomega_body_rad_s = [1, 0, 0]\n"),
    ("zero step", "duration_s = 1\ndt_s = 0\n"),
    ("negative duration", "duration_s = -1\ndt_s = 0.01\n"),
    ("step longer than the run", "duration_s = 1\ndt_s = 2\n"),
    ("too many steps", "duration_s = 100\ndt_s = 1e-9\n"),
    ("record rate", "+record_hz = 0\n"),
    ("restitution", "+[contact]\nrestitution = 1.2\n"),
    ("scale", "+#scale = 0\n"),
    ("zero axis", "+#orientation.axis_angle = { axis = [0, 0, 0], angle_rad = 1 }\n"),
    ("tiny axis", "+#orientation.axis_angle = { axis = [0, 0, 1e-200], angle_rad = 1 }\n"),
    ("axis without an angle", "+#orientation.axis_angle = { axis = [0, 0, 1] }\n"),
    ("zero rotor", "+#orientation.rotor = [0, 0, 0, 0]\n"),
    ("zero normal", "+[[body]]\nname = \"floor\"\nfixed = true\nshape.plane.normal = [0, 0, 0]\n"),
    ("plane not fixed", "+[[body]]\nname = \"floor\"\nshape.plane.normal = [0, 0, 1]\n"),
    (
        "plane with mass",
        "+[[body]]\nname = \"floor\"\nfixed = true\nmass_kg = 1\nscale = 2\nshape.plane.normal = [0, 0, 1]\n",
    ),
    ("fixed body that moves", "+#fixed = true\nvelocity_m_s = [1, 0, 0]\nomega_body_rad_s = [0, 0, 1]\n"),
    ("no shape and no inertia", "+[[body]]\nname = \"a\"\nmass_kg = 1\n"),
    ("fixed without a shape", "+[[body]]\nname = \"a\"\nfixed = true\n"),
    ("flat box", "+[[body]]\nname = \"a\"\nmass_kg = 1\nshape.box.size_m = [1, 0, 1]\n"),
    ("negative height", "+[[body]]\nname = \"a\"\nmass_kg = 1\nshape.pyramid = { base_m = 1, height_m = -1 }\n"),
    ("negative moment", "+[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, -1, 1]\n"),
    ("triangle inequality", "+[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 4, 2]\n"),
    (
        "triangle inequality of a matrix",
        "+[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [[3, 0, 0], [0, 3, 2], [0, 2, 3]]\n",
    ),
    ("matrix of a rod", "+[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [[1, -1, 0], [-1, 1, 0], [0, 0, 2]]\n"),
    (
        "asymmetric matrix",
        "+[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [[1, 0, 0], [0, 1, 0.1], [0, 0.2, 1]]\n",
    ),
    ("two moments", "+[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 2]\n"),
    ("force on nobody", "+#[[force]]\nlinear_drag = { body = \"cubes\", k_kg_s = 1 }\n"),
    ("force on a fixed body", "+#fixed = true\n[[force]]\nlinear_drag = { body = \"cube\", k_kg_s = 1 }\n"),
    (
        "force ends before it starts",
        "+#[[force]]\nat_point = { body = \"cube\", force_world_n = [1, 0, 0], start_s = 0.6, end_s = 0.5 }\n",
    ),
    ("force after the run", "+#[[force]]\nat_point = { body = \"cube\", force_world_n = [1, 0, 0], start_s = 2 }\n"),
    ("negative drag", "+#[[force]]\nlinear_drag = { body = \"cube\", k_kg_s = -1 }\n"),
    ("mesh file that is not there", "+[[body]]\nname = \"a\"\nmass_kg = 1\nshape.mesh.file = \"meshes/no-such.obj\"\n"),
    (
        "several mistakes of all kinds",
        "duration_s = \"long\"\ndt_s = -1\n#colour = \"red\"\nscale = -1\n[[body]]\nmass_kg = \"heavy\"\nshape.box.size_m = [1, 1]\nvelocity_m_s = [0, nan, 0]\n[[force]]\nat_point = { body = \"cube\" }\n",
    ),
    ("beyond ASCII", "+[[body]]\nname = \"würfel\" # größer, дом\nmässe = 1\nshape.box.size_m = [1, 1, 1]\n"),
];

#[test]
fn every_mistake_is_shown_with_its_place_and_a_remedy() {
    let mut found = String::new();
    for (name, text) in MISTAKES {
        let text = text.replacen('+', SOUND, 1).replace("#[[", "#\n[[").replace('#', CUBE);
        let text = if name == &"beyond ASCII" { text.replace(CUBE, "# ") } else { text };
        let complaints = complaints(&text, &[]);
        assert_ne!(complaints, "(no complaint)", "{name}");
        found.push_str(&format!("=== {name}\n\n{complaints}\n\n"));
    }
    assert_golden("scene_mistakes.txt", &found);
}

#[test]
fn carriage_returns_and_byte_order_marks_do_not_move_the_place() {
    for text in ["\u{feff}duration_s = 1\ndt_s = 0\n", "duration_s = 1\r\ndt_s = 0\r\n"] {
        let found = complaints(text, &[]);
        assert!(found.contains("--> scene.toml:2:8"), "{found}");
    }
}

#[test]
fn colour_is_there_only_if_asked_for() {
    let rejected = read("dt_s = 0\n", &[]).unwrap_err();
    assert!(!rejected.render(false).contains('\u{1b}'));
    assert!(rejected.render(true).contains("\u{1b}["));
}

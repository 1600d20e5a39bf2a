//! Each mistake in particles, what holds them, and how they are solved, with the text that is shown for it.

use crate::{SOUND, accepted, assert_golden, complaints};

/// A particle at the origin, one a metre from it, and a fixed one.
const PARTICLES: &str = "[[particle]]\nname = \"sun\"\nfixed = true\nposition_m = [0, 0, 2]\n\
     [[particle]]\nname = \"bob\"\nmass_kg = 1\n\
     [[particle]]\nname = \"eve\"\nmass_kg = 1\nposition_m = [1, 0, 0]\n";

const CHAIN: &str = "[[chain]]\nname = \"rope\"\nparticles = 4\nfrom_m = [0, 0, 0]\nto_m = [3, 0, 0]\nmass_kg = 0.1\n";

const NET: &str = "[[net]]\nname = \"net\"\ncolumns = 4\nrows = 3\ncolumn_step_m = [0.1, 0, 0]\n\
     row_step_m = [0, 0.1, 0]\nmass_kg = 0.01\n";

/// Name and text of scenes with a mistake. `+` stands for the sound beginning, `#` for the three particles, `~` for the
/// chain, `%` for the net; after `NET` a line belongs to it.
const MISTAKES: &[(&str, &str)] = &[
    ("particle without mass", "+[[particle]]\nname = \"a\"\n"),
    ("zero mass", "+[[particle]]\nname = \"a\"\nmass_kg = 0\n"),
    ("negative mass", "+[[particle]]\nname = \"a\"\nmass_kg = -1\n"),
    ("mass that is no number", "+[[particle]]\nname = \"a\"\nmass_kg = \"heavy\"\n"),
    ("particle as one table", "+[particle]\nname = \"a\"\nmass_kg = 1\n"),
    ("fixed particle that moves", "+[[particle]]\nname = \"a\"\nfixed = true\nvelocity_m_s = [1, 0, 0]\n"),
    ("not finite", "+[[particle]]\nname = \"a\"\nmass_kg = 1\nposition_m = [nan, 0, 0]\nvelocity_m_s = [0, inf, 0]\n"),
    ("empty name", "+[[particle]]\nname = \" \"\nmass_kg = 1\n"),
    ("name of another particle", "+#[[particle]]\nname = \"bob\"\nmass_kg = 1\n"),
    ("name of a body", "+#[[body]]\nname = \"eve\"\nmass_kg = 1\nshape.box.size_m = [1, 1, 1]\n"),
    ("name of a particle of a chain", "+[[particle]]\nname = \"rope.2\"\nmass_kg = 1\nposition_m = [9, 9, 9]\n~"),
    ("chain of one", "+[[chain]]\nname = \"a\"\nparticles = 1\nfrom_m = [0, 0, 0]\nto_m = [1, 0, 0]\nmass_kg = 1\n"),
    (
        "half a particle",
        "+[[chain]]\nname = \"a\"\nparticles = 2.5\nfrom_m = [0, 0, 0]\nto_m = [1, 0, 0]\nmass_kg = 1\n",
    ),
    (
        "fewer than no particles",
        "+[[chain]]\nname = \"a\"\nparticles = -3\nfrom_m = [0, 0, 0]\nto_m = [1, 0, 0]\nmass_kg = 1\n",
    ),
    (
        "chain of no length",
        "+[[chain]]\nname = \"a\"\nparticles = 3\nfrom_m = [1, 0, 0]\nto_m = [1, 0, 0]\nmass_kg = 1\n",
    ),
    ("chain without its ends", "+[[chain]]\nname = \"a\"\nparticles = 3\nmass_kg = 1\n"),
    ("taut chain", "+~fixed = [\"first\", \"last\"]\n"),
    ("unknown end", "+~fixed = [\"begin\"]\n"),
    (
        "net without rows",
        "+[[net]]\nname = \"a\"\ncolumns = 3\nrows = 0\ncolumn_step_m = [1, 0, 0]\nrow_step_m = [0, 1, 0]\nmass_kg = 1\n",
    ),
    (
        "net of no width",
        "+[[net]]\nname = \"a\"\ncolumns = 3\nrows = 2\ncolumn_step_m = [0, 0, 0]\nrow_step_m = [0, 1, 0]\nmass_kg = 1\n",
    ),
    (
        "net of parallel steps",
        "+[[net]]\nname = \"a\"\ncolumns = 3\nrows = 2\ncolumn_step_m = [0.1, 0.3, 0]\nrow_step_m = [0.2, 0.6, 0]\nmass_kg = 1\n",
    ),
    (
        "net of too many",
        "+[[net]]\nname = \"a\"\ncolumns = 100000\nrows = 100000\ncolumn_step_m = [1, 0, 0]\nrow_step_m = [0, 1, 0]\nmass_kg = 1\n",
    ),
    ("net folded too far", "+%fold_rad = 1.6\n"),
    ("net with a taut row", "+%fixed = [[0, 0], [3, 0]]\n"),
    ("net with a taut column", "+%fixed = [\"corners\"]\nfold_rad = 0.3\n"),
    ("unknown part of a net", "+%fixed = [\"corner\"]\n"),
    ("place outside a net", "+%fixed = [[0, 0], [4, 2]]\n"),
    ("place of three numbers", "+%fixed = [[0, 0, 0]]\n"),
    ("no kind of constraint", "+#[[constraint]]\n"),
    ("unknown kind of constraint", "+#[[constraint]]\non_cirle = { particle = \"bob\" }\n"),
    ("unknown particle", "+#[[constraint]]\ndistance = { a = \"bob\", b = \"ewe\" }\n"),
    ("unknown particle of a chain", "+~[[constraint]]\ndistance = { a = \"rope.0\", b = \"rope.4\" }\n"),
    ("chain for one particle", "+#~[[constraint]]\ndistance = { a = \"sun\", b = \"rope\" }\n"),
    ("no particles at all", "+[[constraint]]\non_plane = { particle = \"bob\", normal = [0, 0, 1] }\n"),
    ("joined to itself", "+#[[constraint]]\ndistance = { a = \"bob\", b = \"bob\" }\n"),
    ("wrong length", "+#[[constraint]]\ndistance = { a = \"bob\", b = \"eve\", length_m = 1.2 }\n"),
    ("zero length", "+#[[constraint]]\ndistance = { a = \"bob\", b = \"eve\", length_m = 0 }\n"),
    (
        "no length",
        "+#[[particle]]\nname = \"ann\"\nmass_kg = 1\nposition_m = [1, 0, 0]\n[[constraint]]\ndistance = { a = \"ann\", b = \"eve\" }\n",
    ),
    (
        "both fixed",
        "+#[[particle]]\nname = \"moon\"\nfixed = true\n[[constraint]]\ndistance = { a = \"sun\", b = \"moon\", length_m = 3 }\n",
    ),
    (
        "two lengths for a pair",
        "+#[[constraint]]\ndistance = { a = \"bob\", b = \"eve\" }\n[[constraint]]\ndistance = { a = \"eve\", b = \"bob\", length_m = 1.5 }\n",
    ),
    ("held twice", "+~[[constraint]]\ndistance = { a = \"rope.1\", b = \"rope.2\" }\n"),
    (
        "wrong distance to a point",
        "+#[[constraint]]\ndistance_to_point = { particle = \"bob\", point_m = [0, 0, 2], length_m = 1.5 }\n",
    ),
    ("in the point", "+#[[constraint]]\ndistance_to_point = { particle = \"bob\", point_m = [0, 0, 0] }\n"),
    ("holding a fixed particle", "+#[[constraint]]\non_plane = { particle = \"sun\", normal = [0, 0, 1] }\n"),
    (
        "off the plane",
        "+#[[constraint]]\non_plane = { particle = \"eve\", point_m = [0, 0, 0.25], normal = [0, 0, 2] }\n",
    ),
    ("off the sphere", "+#[[constraint]]\non_sphere = { particle = \"eve\", centre_m = [3, 0, 0], radius_m = 1 }\n"),
    (
        "off the line",
        "+#[[constraint]]\non_line = { particle = \"eve\", point_m = [0, 0, 0], direction = [1, 1, 0] }\n",
    ),
    (
        "off the circle",
        "+#[[constraint]]\non_circle = { particle = \"eve\", centre_m = [0, 0, 1], radius_m = 1, normal = [0, 0, 1] }\n",
    ),
    (
        "another circle",
        "+#[[constraint]]\non_circle = { particle = \"eve\", centre_m = [-1, 0, 0], radius_m = 1, normal = [0, 0, 1] }\n",
    ),
    (
        "circle of no direction",
        "+#[[constraint]]\non_circle = { particle = \"eve\", centre_m = [0, 0, 0], normal = [0, 0, 0] }\n",
    ),
    (
        "moving off",
        "+[[particle]]\nname = \"a\"\nmass_kg = 1\nvelocity_m_s = [1, 0, 0.5]\n[[constraint]]\non_plane = { particle = \"a\", normal = [0, 0, 1] }\n",
    ),
    (
        "moving along the link",
        "+#[[particle]]\nname = \"a\"\nmass_kg = 1\nposition_m = [0, 5, 0]\nvelocity_m_s = [0, 1, 0]\n[[constraint]]\ndistance = { a = \"bob\", b = \"a\" }\n",
    ),
    (
        "two at one place",
        "+#[[particle]]\nname = \"ann\"\nmass_kg = 1\nposition_m = [1, -0.0, 0]\n[[force]]\ninverse_square.constant_m3_kg_s2 = 1\n",
    ),
    ("in the attracting point", "+#[[force]]\ninverse_square_to_point = { constant_m3_s2 = 1 }\n"),
    ("negative softening", "+#[[force]]\ninverse_square = { constant_m3_kg_s2 = 1, softening_m = -0.1 }\n"),
    ("attraction of nobody", "+[[force]]\ninverse_square.constant_m3_kg_s2 = 1\n"),
    (
        "drag on both",
        "+#[[body]]\nname = \"c\"\nmass_kg = 1\nshape.box.size_m = [1, 1, 1]\n[[force]]\nlinear_drag = { body = \"c\", particle = \"bob\", k_kg_s = 1 }\n",
    ),
    ("drag on a fixed particle", "+#[[force]]\nquadratic_drag = { particle = \"sun\", k_kg_m = 1 }\n"),
    (
        "drag that turns a particle",
        "+#[[force]]\nlinear_drag = { particle = \"bob\", k_kg_s = 1, k_angular_n_m_s = 1 }\n",
    ),
    (
        "drag on nobody",
        "+[[body]]\nname = \"c\"\nmass_kg = 1\nshape.box.size_m = [1, 1, 1]\n[[force]]\nlinear_drag.k_kg_s = 1\n",
    ),
    ("negative drag", "+#[[force]]\nquadratic_drag.k_kg_m = -1\n"),
    (
        "negative spring",
        "+#[[force]]\nspring = { a = \"bob\", b = \"eve\", stiffness_n_m = -1, damping_n_s_m = -1, rest_length_m = -1 }\n",
    ),
    ("spring to itself", "+#[[force]]\nspring = { a = \"bob\", b = \"bob\", stiffness_n_m = 1 }\n"),
    ("fixed steps without a step", "duration_s = 1\n#[solver]\nmethod = \"verlet\"\n"),
    ("tolerance below f64", "duration_s = 1\n#[solver]\nrtol = 1e-16\n"),
    ("tolerance below f32", "duration_s = 1\n#[solver]\nscalar = \"f32\"\nrtol = 1e-7\n"),
    ("negative tolerances", "duration_s = 1\n#[solver]\nrtol = -1e-6\natol = 0\n"),
    ("no tolerance", "duration_s = 1\n#[solver]\nrtol = 1\n"),
    ("sweeps of a method that cannot", "+#[solver]\nmethod = \"rk4\"\nconstraints = \"sweeps\"\n"),
    ("impossible violation", "+#[solver]\nviolation = 1\n"),
    ("no substeps", "+#[solver]\nmethod = \"xpbd\"\nsubsteps = 0\n"),
    (
        "too many frames",
        "duration_s = 1000\n#[[net]]\nname = \"a\"\ncolumns = 50\nrows = 50\ncolumn_step_m = [0.1, 0, 0]\nrow_step_m = [0, 0.1, 0]\nmass_kg = 1\n",
    ),
    (
        "several",
        "+[[chain]]\nname = \"a\"\nmass_kg = \"light\"\n[[particle]]\nposition_m = [1, 2]\n[[constraint]]\ndistance = { a = \"x\" }\n[[force]]\nspring.a = \"x\"\n",
    ),
];

fn text(pattern: &str) -> String {
    let text = pattern.replace('+', SOUND).replace('#', PARTICLES).replace('~', CHAIN).replace('%', NET);
    assert!(!text.contains("\n\n"));
    text
}

#[test]
fn every_mistake_is_shown_with_its_place_and_a_remedy() {
    let mut found = String::new();
    for (name, pattern) in MISTAKES {
        let complaints = complaints(&text(pattern), &[]);
        assert_ne!(complaints, "(no complaint)", "{name}");
        for complaint in complaints.split("\n\n") {
            // Under a value that is no number, or not finite, stands what is expected.
            let labels = ["help: ", "expected ", "^ not a finite number"];
            let remedied = labels.iter().any(|label| complaint.contains(label));
            assert!(remedied, "{name} has no remedy: {complaint}");
        }
        found.push_str(&format!("=== {name}\n\n{complaints}\n\n"));
    }
    assert_golden("particle_mistakes.txt", &found);
}

/// What lies just on the right side of each limit.
#[test]
fn what_is_nearly_a_mistake_is_none() {
    for pattern in [
        // Three digits short of the nearest f64 to a length that is no decimal.
        "+#[[constraint]]\ndistance = { a = \"sun\", b = \"eve\", length_m = 2.2360679775 }\n",
        "+#[[constraint]]\non_circle = { particle = \"eve\", centre_m = [0.4, 0.8, 0], radius_m = 1, normal = [0, 0, 1] }\n",
        "+~[[constraint]]\non_line = { particle = \"rope\", point_m = [-5, 0, 0], direction = [0.1, 0, 0] }\n",
        "+%fixed = [\"corners\"]\nfold_rad = 0.3\nrow_fold_rad = -0.3\n",
        "+%fixed = [\"first_row\", [1, 1]]\n",
        "+[[chain]]\nname = \"a\"\nparticles = 2\nfrom_m = [0, 0, 0]\nto_m = [1, 0, 0]\nmass_kg = 1\nfixed = [\"first\", \"last\"]\n",
        // A net of one row needs no second direction.
        "+[[net]]\nname = \"a\"\ncolumns = 9\nrows = 1\ncolumn_step_m = [1, 0, 0]\nrow_step_m = [2, 0, 0]\nmass_kg = 1\n",
        "+#[[particle]]\nname = \"ann\"\nmass_kg = 1\nposition_m = [1, 0, 0]\n[[force]]\ninverse_square = { constant_m3_kg_s2 = 1, softening_m = 0.1 }\n",
        "+#[[force]]\nlinear_drag.k_kg_s = 0\n",
        "duration_s = 1\n#[solver]\nrtol = 1e-14\n",
        // Far from the origin coordinates have steps of 1e-9 m, and no length of 1 m is exact.
        "+[[particle]]\nname = \"p\"\nfixed = true\nposition_m = [1e7, 1e7, 1e7]\n[[particle]]\nname = \"q\"\nmass_kg = 1\n\
         position_m = [10000000.6, 10000000.8, 1e7]\n[[constraint]]\ndistance = { a = \"p\", b = \"q\", length_m = 1 }\n",
    ] {
        accepted(&text(pattern), &[]);
    }
}

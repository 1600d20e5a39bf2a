//! Each mistake in joints, springs and torques on bodies, round shapes and how bodies are solved, with its text.

use crate::{SOUND, accepted, assert_golden, complaints};

/// A rod along x with its middle in the origin, a second one beside its end, and a fixed block.
const RODS: &str = "[[body]]\nname = \"rod\"\nmass_kg = 1\nshape.capsule = { radius_m = 0.05, length_m = 1 }\n\
     orientation.axis_angle = { axis = [0, 1, 0], angle_rad = 1.5707963267948966 }\n\
     [[body]]\nname = \"bar\"\nmass_kg = 2\ninertia_kg_m2 = [0.1, 0.1, 0.01]\nposition_m = [1, 0, 0]\n\
     [[body]]\nname = \"wall\"\nfixed = true\nposition_m = [0, 0, 2]\nshape.box.size_m = [1, 1, 1]\n";

const BOB: &str = "[[particle]]\nname = \"bob\"\nmass_kg = 1\nposition_m = [5, 5, 5]\n";

/// Name and text of scenes with a mistake. `+` stands for the sound beginning, `#` for the bodies, `%` for a particle.
const MISTAKES: &[(&str, &str)] = &[
    ("no kind of joint", "+#[[joint]]\n"),
    ("joint as one table", "+#[joint]\nball = { a = \"rod\", point_m = [0, 0, 0] }\n"),
    ("unknown kind of joint", "+#[[joint]]\nslider = { a = \"rod\" }\n"),
    ("joint without a point", "+#[[joint]]\nball = { a = \"rod\" }\n"),
    ("joint without a body", "+#[[joint]]\nball = { point_m = [0, 0, 0] }\n"),
    ("joint of nobody", "+#[[joint]]\nball = { a = \"rot\", point_m = [0, 0, 0] }\n"),
    ("joint of a particle", "+#%[[joint]]\nball = { a = \"rod\", b = \"bob\", point_m = [0, 0, 0] }\n"),
    ("joined to itself", "+#[[joint]]\nball = { a = \"rod\", b = \"rod\", point_m = [0, 0, 0] }\n"),
    ("fixed body joined to the world", "+#[[joint]]\nball = { a = \"wall\", point_m = [0, 0, 0] }\n"),
    (
        "both fixed",
        "+#[[body]]\nname = \"roof\"\nfixed = true\nposition_m = [0, 0, 9]\nshape.box.size_m = [1, 1, 1]\n\
         [[joint]]\ndistance = { a = \"wall\", b = \"roof\" }\n",
    ),
    ("not finite", "+#[[joint]]\nhinge = { a = \"rod\", point_m = [0, inf, 0], axis = [0, nan, 1] }\n"),
    ("zero axis", "+#[[joint]]\nhinge = { a = \"rod\", point_m = [0, 0, 0], axis = [0, 0, 0] }\n"),
    ("axis too small", "+#[[joint]]\nhinge = { a = \"rod\", point_m = [0, 0, 0], axis = [0, 0, 1e-200] }\n"),
    ("distance with one end", "+#[[joint]]\ndistance = { a = \"rod\" }\n"),
    ("distance with three ends", "+#[[joint]]\ndistance = { a = \"rod\", b = \"bar\", to_m = [0, 0, 1] }\n"),
    ("point of no body", "+#[[joint]]\ndistance = { a = \"rod\", at_b_body_m = [0, 0, 1], to_m = [0, 0, 1] }\n"),
    ("wrong distance", "+#[[joint]]\ndistance = { a = \"rod\", b = \"bar\", length_m = 1.5 }\n"),
    ("negative distance", "+#[[joint]]\ndistance = { a = \"rod\", b = \"bar\", length_m = -1 }\n"),
    ("no distance", "+#[[joint]]\ndistance = { a = \"rod\", b = \"bar\", at_b_body_m = [-1, 0, 0] }\n"),
    (
        "velocity against a ball",
        "+[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\nposition_m = [1, 0, 0]\n\
         omega_world_rad_s = [0, 0, 2]\n[[joint]]\nball = { a = \"a\", point_m = [0, 0, 0] }\n",
    ),
    (
        "velocity against the other body",
        "+#[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\nposition_m = [2, 0, 0]\nvelocity_m_s = [0, 1, 0]\n\
         [[joint]]\nball = { a = \"a\", b = \"bar\", point_m = [1.5, 0, 0] }\n",
    ),
    (
        "spin against a hinge",
        "+[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\nomega_body_rad_s = [1, 2, 3]\n\
         [[joint]]\nhinge = { a = \"a\", point_m = [0, 0, 0], axis = [0, 0, -5] }\n",
    ),
    (
        "velocity along a distance",
        "+[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\nposition_m = [3, 4, 0]\nvelocity_m_s = [1, 1, 1]\n\
         [[joint]]\ndistance = { a = \"a\", to_m = [0, 0, 0] }\n",
    ),
    (
        "two formulations in a joint",
        "+#[[joint]]\nball = { a = \"rod\", b = \"bar\", point_m = [0.5, 0, 0] }\n!rod motor",
    ),
    (
        "two formulations in a spring",
        "+#[[force]]\nspring = { a = \"rod\", b = \"bar\", stiffness_n_m = 1 }\n!bar matrix",
    ),
    ("unknown formulation", "+formulation = \"quaternions\"\n#"),
    ("unknown formulation of a body", "+#!rod vector"),
    ("spring to itself", "+#[[force]]\nspring = { a = \"rod\", b = \"rod\", stiffness_n_m = 1 }\n"),
    ("spring of one end", "+#[[force]]\nspring = { a = \"rod\", stiffness_n_m = 1 }\n"),
    ("spring from a body to a particle", "+#%[[force]]\nspring = { a = \"rod\", b = \"bob\", stiffness_n_m = 1 }\n"),
    ("spring of nobody", "+#[[force]]\nspring = { a = \"rad\", to_m = [0, 0, 0], stiffness_n_m = 1 }\n"),
    ("spring between fixed bodies", "+#[[force]]\nspring = { a = \"wall\", to_m = [0, 0, 0], stiffness_n_m = 1 }\n"),
    (
        "spring without a direction",
        "+#[[force]]\nspring = { a = \"rod\", to_m = [0, 0, 0], stiffness_n_m = 1, rest_length_m = 1 }\n",
    ),
    (
        "spring of particles to the world",
        "+#%[[force]]\nspring = { a = \"bob\", to_m = [0, 0, 0], stiffness_n_m = 1 }\n",
    ),
    ("spring of one particle", "+#%[[force]]\nspring = { a = \"bob\", stiffness_n_m = 1 }\n"),
    ("torque on nobody", "+#[[force]]\ntorque = { body = \"rad\", torque_world_n_m = [1, 0, 0] }\n"),
    ("torque on a fixed body", "+#[[force]]\ntorque = { body = \"wall\", torque_world_n_m = [1, 0, 0] }\n"),
    (
        "torque that is none",
        "+#[[force]]\ntorque = { body = \"rod\", torque_world_n_m = [nan, 0, 0], start_s = 0.5, end_s = 0.5 }\n",
    ),
    ("torque without a body", "+#[[force]]\ntorque = { torque_world_n_m = [1, 0, 0] }\n"),
    ("flat ball", "+[[body]]\nname = \"a\"\nmass_kg = 1\nshape.ball.radius_m = 0\n"),
    ("capsule without length", "+[[body]]\nname = \"a\"\nmass_kg = 1\nshape.capsule = { radius_m = 1 }\n"),
    ("capsule of no length", "+[[body]]\nname = \"a\"\nmass_kg = 1\nshape.capsule = { radius_m = 1, length_m = 0 }\n"),
    ("cone upside down", "+[[body]]\nname = \"a\"\nmass_kg = 1\nshape.cone = { radius_m = 1, height_m = -1 }\n"),
    ("method for particles", "+#[solver]\nmethod = \"xpbd\"\n"),
    ("method for bodies", "+%[solver]\nmethod = \"splitting4\"\n"),
    ("method for a rotor", "+formulation = \"matrix\"\n#[solver]\nmethod = \"yoshida4\"\n"),
    ("method for rotor or motor", "+formulation = \"quaternion\"\n#[solver]\nmethod = \"rkmk4\"\n"),
    (
        "free flight with a joint and a torque",
        "+#[solver]\nmethod = \"free_flight\"\n[[joint]]\nball = { a = \"rod\", point_m = [0, 0, 0] }\n\
         [[force]]\ntorque = { body = \"bar\", torque_world_n_m = [1, 0, 0] }\n",
    ),
    (
        "kicks without a step",
        "duration_s = 1\n[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\n[solver]\nmethod = \"verlet\"\n",
    ),
    (
        "collisions without a step",
        "duration_s = 1\n[[body]]\nname = \"a\"\nmass_kg = 1\nshape.box.size_m = [1, 1, 1]\n\
         [[body]]\nname = \"floor\"\nfixed = true\nposition_m = [0, 0, -2]\nshape.plane.normal = [0, 0, 1]\n",
    ),
    ("no inertia in one direction", "+[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 0]\n"),
    (
        "several",
        "+#[[joint]]\nhinge = { a = \"rod\", b = \"rod\", axis = [0, 0, 0] }\n[[force]]\nspring = { a = \"rod\" }\n",
    ),
];

/// The scene of a pattern; `!name formulation` at its end gives a body another one.
fn text(pattern: &str) -> String {
    let (pattern, other) = pattern.split_once('!').unwrap_or((pattern, ""));
    let text = pattern.replace('+', SOUND).replace('#', RODS).replace('%', BOB);
    match other.split_once(' ') {
        Some((name, formulation)) => text
            .replace(&format!("name = \"{name}\"\n"), &format!("name = \"{name}\"\nformulation = \"{formulation}\"\n")),
        None => text,
    }
}

#[test]
fn every_mistake_is_shown_with_its_place_and_a_remedy() {
    let mut found = String::new();
    for (name, pattern) in MISTAKES {
        let complaints = complaints(&text(pattern), &[]);
        assert_ne!(complaints, "(no complaint)", "{name}");
        for complaint in complaints.split("\n\n") {
            let labels = ["help: ", "expected ", "^ not a finite number"];
            assert!(labels.iter().any(|label| complaint.contains(label)), "{name} has no remedy: {complaint}");
        }
        found.push_str(&format!("=== {name}\n\n{complaints}\n\n"));
    }
    assert_golden("body_mistakes.txt", &found);
}

/// What lies just on the right side of each limit.
#[test]
fn what_is_nearly_a_mistake_is_none() {
    let turning = "[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\nposition_m = [0.3, 0.1, 0]\n";
    for pattern in [
        // The velocity of a turn about the joint, to ten digits.
        &format!(
            "+{turning}omega_world_rad_s = [0, 0, 3]\nvelocity_m_s = [-0.3, 0.9000000001, 0]\n\
             [[joint]]\nball = {{ a = \"a\", point_m = [0, 0, 0] }}\n"
        ),
        &format!(
            "+{turning}omega_world_rad_s = [0, 0, -3]\nvelocity_m_s = [0.3, -0.9, 0]\n\
             [[joint]]\nhinge = {{ a = \"a\", point_m = [0, 0, 7], axis = [0, 0, 1e-3] }}\n"
        ),
        // Across the line of a distance, anything goes.
        &format!("+{turning}velocity_m_s = [0, 0, 5]\n[[joint]]\ndistance = {{ a = \"a\", to_m = [0, 0, 0] }}\n"),
        "+#[[joint]]\ndistance = { a = \"rod\", b = \"bar\", at_b_body_m = [0, 0, 1], length_m = 1.41421356237 }\n",
        // A joint of two bodies twice: redundant, and kept.
        "+#[[joint]]\nball = { a = \"rod\", b = \"bar\", point_m = [0.5, 0, 0] }\n\
         [[joint]]\nball = { a = \"bar\", b = \"rod\", point_m = [0.5, 0, 0] }\n",
        // A fixed body has no formulation to differ by.
        "+#[[joint]]\nball = { a = \"rod\", b = \"wall\", point_m = [0, 0, 1] }\n!wall matrix",
        "+#[[force]]\nspring = { a = \"rod\", to_m = [0, 0, 0], stiffness_n_m = 1 }\n",
        // A lamina.
        "+[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [0.1, 0.7, 0.8]\n",
        "+#%[solver]\nmethod = \"xpbd\"\n",
        "+formulation = \"matrix\"\n#%[solver]\nmethod = \"verlet\"\n",
        "+#[solver]\nmethod = \"yoshida4\"\n!rod motor",
        // Free flight, and methods that choose their steps, need none.
        "duration_s = 1\n#",
        "duration_s = 1\nformulation = \"motor\"\n#",
        "duration_s = 1\n#[[joint]]\nball = { a = \"rod\", point_m = [0, 0, 0] }\n",
    ] {
        accepted(&text(pattern), &[]);
    }
}

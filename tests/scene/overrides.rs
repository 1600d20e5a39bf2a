//! `--set path=value`: what it changes, and what is said when it cannot.

use ga_physics::scene::description::{Scalar, Shape};

use crate::{CUBE, accepted, assert_golden, complaints, read, with_floor};

/// Overrides of a scene with the cube and a floor, and what is said about them.
const WRONG_OVERRIDES: &[&[&str]] = &[
    &["dt_s"],
    &["dt_s="],
    &["=1"],
    &["dt_s.=1"],
    &["two words=1"],
    &["dt_s=fast"],
    &["dt_s=0,01"],
    &["dt_s=1.0.0"],
    &["dt_s=-0.01"],
    &["dts=0.01"],
    &["contact.restitutoin=0.5"],
    &["contact.restitution=1.5"],
    &["dt_s.x=1"],
    &["body.cub.mass_kg=2"],
    &["body.7.mass_kg=2"],
    &["body.cube.mas_kg=2"],
    &["body.cube.shape.pyramid.base_m=2"],
    &["force.0.linear_drag.k_kg_s=1"],
    &["gravity_m_s2.3=1"],
    &["gravity_m_s2=[0, 0]"],
    &["dt_s=-1", "duration_s=\"ä\"", "body.floor.mass_kg=1"],
];

#[test]
fn wrong_overrides_are_shown_with_their_own_text() {
    let mut found = String::new();
    for sets in WRONG_OVERRIDES {
        let complaints = complaints(&with_floor(), sets);
        assert!(complaints.contains("--> --set:1:"), "{sets:?}: {complaints}");
        found.push_str(&format!("=== {}\n\n{complaints}\n\n", sets.join(" ")));
    }
    assert_golden("scene_overrides.txt", &found);
}

#[test]
fn overrides_change_what_their_path_names() {
    let scene = accepted(
        &with_floor(),
        &[
            "dt_s=0.001",
            "contact.restitution = 0.5",
            "body.cube.mass_kg=2",
            "body.0.scale=3 # by index, with a comment",
            "body.\"cube\".position_m=[1, 2, 3]",
            "body.cube.position_m.2=-4",
            "gravity_m_s2=[0, 0, 0]",
            "solver.scalar=f32",
            "body.floor.name=ground",
            "body.ground.position_m=[0, 0, -1]",
        ],
    );
    assert_eq!(*scene.dt_s.as_ref().unwrap().get_ref(), 0.001);
    assert_eq!(*scene.contact.restitution.get_ref(), 0.5);
    assert_eq!(scene.solver.scalar, Scalar::F32);
    assert_eq!(scene.gravity_m_s2.get_ref().0, [0.0; 3]);
    let [cube, ground] = &scene.body[..] else { panic!("two bodies") };
    assert_eq!(cube.mass_kg.as_ref().map(|mass| *mass.get_ref()), Some(2.0));
    assert_eq!(*cube.scale.get_ref(), 3.0);
    assert_eq!(cube.position_m.get_ref().0, [1.0, 2.0, -4.0]);
    assert_eq!(ground.name.get_ref(), "ground");
    assert_eq!(ground.position_m.get_ref().0, [0.0, 0.0, -1.0]);
    // The text on disk is what it was, and values not overridden are those of the file.
    assert_eq!(*scene.duration_s.get_ref(), 1.0);
}

#[test]
fn the_last_override_of_a_value_wins() {
    let scene = accepted(&with_floor(), &["dt_s=0.5", "dt_s=0.25"]);
    assert_eq!(*scene.dt_s.as_ref().unwrap().get_ref(), 0.25);
}

#[test]
fn an_override_may_choose_another_kind() {
    let pyramid = "body.cube.shape.pyramid={base_m=2, height_m=3}";
    let scene = accepted(&with_floor(), &[pyramid]);
    let Some(Shape::Pyramid(pyramid)) = &scene.body[0].shape else { panic!("a pyramid") };
    assert_eq!((*pyramid.base_m.get_ref(), *pyramid.height_m.get_ref()), (2.0, 3.0));
}

#[test]
fn an_override_mends_a_mistake_in_the_file() {
    let text = format!("duration_s = 1\ndt_s = -1\n{CUBE}");
    assert!(read(&text, &[]).is_err());
    assert_eq!(*accepted(&text, &["dt_s=0.5"]).dt_s.unwrap().get_ref(), 0.5);
}

#[test]
fn spans_lead_back_to_the_text_of_file_and_overrides() {
    let (scene, source) = read(&with_floor(), &["duration_s=2", "body.cube.mass_kg= 7.5 "]).unwrap();
    let cube = &scene.body[0];
    assert_eq!(source.written(scene.dt_s.as_ref().unwrap().span()), "0.01");
    assert_eq!(source.written(scene.duration_s.span()), "2");
    assert_eq!(source.written(cube.mass_kg.as_ref().unwrap().span()), "7.5");
    assert_eq!(source.written(cube.name.span()), "\"cube\"");
    assert_eq!(source.written(cube.scale.span()), "", "a default has no text");
}

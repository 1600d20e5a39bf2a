//! Values are read as written.

use ga_physics::scene::Inertia;
use ga_physics::scene::description::{Force, Orientation, Shape};

use crate::{SOUND, accepted, read};

#[test]
fn a_scene_of_every_kind_of_value_is_read_as_written() {
    let text = format!(
        "{SOUND}record_hz = 50\nformulation = \"rotor\"\n\
         [[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = [1, 2, 3]\n\
         orientation.axis_angle = {{ axis = [0, 0, 2], angle_rad = 1 }}\n\
         [[body]]\nname = \"b\"\nmass_kg = 1\norientation.rotor = [2, 0, 0, 1]\n\
         inertia_kg_m2 = [[2, 0.5, 0], [0.5, 2, 0], [0, 0, 2]]\n\
         [[body]]\nname = \"c\"\nmass_kg = 1\n\
         shape.tetrahedron.vertices_m = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]\n\
         [[force]]\nat_point.body = \"a\"\nat_point.force_world_n = [1, 0, 0]\n\
         [[force]]\nlinear_drag = {{ body = \"b\", k_kg_s = 1, k_angular_n_m_s = 2 }}\n"
    );
    let scene = accepted(&text, &[]);
    let [a, b, c] = &scene.body[..] else { panic!("three bodies") };
    assert_eq!(*a.inertia_kg_m2.as_ref().unwrap().get_ref(), Inertia::Principal([1.0, 2.0, 3.0]));
    let rows = [[2.0, 0.5, 0.0], [0.5, 2.0, 0.0], [0.0, 0.0, 2.0]];
    assert_eq!(b.inertia_kg_m2.as_ref().unwrap().get_ref().rows(), rows);
    // Raw: neither the axis nor the rotor is normalised here.
    let Some(Orientation::AxisAngle(turn)) = &a.orientation else { panic!("an axis") };
    assert_eq!((turn.axis.get_ref().0, *turn.angle_rad.get_ref()), ([0.0, 0.0, 2.0], 1.0));
    let Some(Orientation::Rotor(rotor)) = &b.orientation else { panic!("a rotor") };
    assert_eq!(rotor.get_ref().0, [2.0, 0.0, 0.0, 1.0]);
    let Some(Shape::Tetrahedron(shape)) = &c.shape else { panic!("a tetrahedron") };
    assert_eq!(shape.vertices_m.get_ref().0[3], [0.0, 0.0, 1.0]);
    let [Force::AtPoint(push), Force::LinearDrag(drag)] = &scene.force[..] else { panic!("two") };
    assert_eq!((push.at_body_m.get_ref().0, *push.start_s.get_ref()), ([0.0; 3], 0.0));
    assert!(push.end_s.is_none());
    assert_eq!(*drag.k_angular_n_m_s.get_ref(), 2.0);
    assert_eq!(scene.body_idx("b"), Some(1));
    assert_eq!(scene.body_idx("d"), None);
}

#[test]
fn a_lamina_is_a_body_whatever_rounding_does() {
    let with = |inertia: &str| {
        let text = format!("{SOUND}[[body]]\nname = \"a\"\nmass_kg = 1\ninertia_kg_m2 = {inertia}\n");
        read(&text, &[]).is_ok()
    };
    // 0.1 + 0.7 is less than 0.8 in f64. The matrices are laminae turned about an axis in their
    // plane by an angle with sine 3/5: their eigenvalues come out with rounding.
    for lamina in [
        "[1, 2, 3]",
        "[3, 1, 2]",
        "[0.1, 0.7, 0.8]",
        "[1e-7, 7e-7, 8e-7]",
        "[[1, 0, 0], [0, 2.36, -0.48], [0, -0.48, 2.64]]",
        "[[0.1, 0, 0], [0, 0.736, -0.048], [0, -0.048, 0.764]]",
    ] {
        assert!(with(lamina), "{lamina}");
    }
    // Beyond rounding by as little as one part in 10^12.
    for impossible in ["[1, 2, 3.000000000003]", "[0.333333, 0.333333, 0.666667]", "[1e-200, 1, 1.1]"] {
        assert!(!with(impossible), "{impossible}");
    }
    assert!(with("[1e308, 1e308, 1e308]"));
    assert!(with("[[1e308, 1e307, 0], [1e307, 1e308, 0], [0, 0, 1e308]]"));
    assert!(!with("[[0, 0, 0], [0, 0, 0], [0, 0, 0]]"));
}

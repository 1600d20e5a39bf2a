//! Bodies of a scene: what the plan chooses for them and says, what joins them, and what they are made of.

use ga_physics::algebra::Real;
use ga_physics::algebra::g3::Vector;
use ga_physics::rigid::{Attachment, Bodies, Force, Form, Formulation as _, Joint, matrix, motor, quaternion};
use ga_physics::scene::build::{Built, Look, build};
use ga_physics::scene::description::{self, Formulation, Method};
use ga_physics::scene::plan::{BodySolverPlan, Plan, Stepping, interval_s, plan, record_hz, steps};

use crate::{SOUND, accepted, complaints, read};

fn body(name: &str, rest: &str) -> String {
    format!("[[body]]\nname = \"{name}\"\nmass_kg = 2\ninertia_kg_m2 = [0.5, 0.4, 0.3]\n{rest}")
}

const BALL: &str = "[[joint]]\nball = { a = \"a\", point_m = [0, 0, 1] }\n";
const TORQUE: &str = "[[force]]\ntorque = { body = \"a\", torque_world_n_m = [1, 0, 0] }\n";
const DRAG: &str = "[[force]]\nlinear_drag = { body = \"a\", k_kg_s = 1 }\n";
const SPRING: &str = "[[force]]\nspring = { a = \"a\", to_m = [0, 0, 1], stiffness_n_m = 1 }\n";
const DAMPED: &str = "[[force]]\nspring = { a = \"a\", to_m = [0, 0, 1], stiffness_n_m = 1, damping_n_s_m = 1 }\n";

fn planned(text: &str) -> Plan {
    plan(&accepted(text, &[]))
}

fn chosen(text: &str) -> (Method, bool) {
    let solvers = planned(text).body_solvers;
    let [BodySolverPlan { method, adaptive, .. }] = &solvers[..] else { panic!("{} solvers", solvers.len()) };
    (*method, *adaptive)
}

#[test]
fn the_plan_chooses_by_what_acts() {
    let a = body("a", "");
    let cases = [
        ("", Method::FreeFlight),
        (BALL, Method::Tsit5),
        (TORQUE, Method::Yoshida4),
        (SPRING, Method::Yoshida4),
        (DRAG, Method::Tsit5),
        (DAMPED, Method::Tsit5),
    ];
    for (acts, expected) in cases {
        assert_eq!(chosen(&format!("{SOUND}{a}{acts}")), (expected, false), "{acts}");
        // Without a step, or with a tolerance, steps are chosen; free flight needs none.
        let by_error = if acts.is_empty() { (Method::FreeFlight, false) } else { (Method::Dop853, true) };
        assert_eq!(chosen(&format!("duration_s = 1\n{a}{acts}")), by_error, "{acts}");
        assert_eq!(chosen(&format!("{SOUND}{a}{acts}[solver]\nrtol = 1e-9\n")), by_error, "{acts}");
        for formulation in ["matrix", "quaternion", "motor"] {
            let text = format!("{SOUND}formulation = \"{formulation}\"\n{a}{acts}");
            let expected = if expected == Method::Tsit5 { expected } else { Method::Rk4 };
            assert_eq!(chosen(&text), (expected, false), "{formulation} {acts}");
        }
    }
    // Gravity makes no torque, and a fixed body is not moved.
    assert_eq!(chosen(&format!("{SOUND}gravity_m_s2 = [0, 0, -9.81]\n{a}")).0, Method::FreeFlight);
    let wall = "[[body]]\nname = \"wall\"\nfixed = true\nshape.box.size_m = [1, 1, 1]\n";
    assert!(planned(&format!("{SOUND}{wall}")).body_solvers.is_empty());
}

#[test]
fn every_formulation_has_its_solver_and_says_why() {
    let pair = format!("{SOUND}{}{}", body("a", ""), body("b", "position_m = [9, 0, 0]\nformulation = \"motor\"\n"));
    let solvers = planned(&pair).body_solvers;
    let found: Vec<_> = solvers.iter().map(|solver| (solver.formulation, solver.method, solver.bodies)).collect();
    assert_eq!(found, [(Formulation::Rotor, Method::FreeFlight, 1), (Formulation::Motor, Method::Rk4, 1)]);
    let named = planned(&format!("{pair}[solver]\nmethod = \"yoshida6\"\n")).body_solvers;
    assert_eq!((named[0].method, named[0].why.as_str()), (Method::Yoshida6, "the scene names it"));
    assert!(
        named[1].method == Method::Rk4 && named[1].why.contains("`yoshida6` is not for these bodies"),
        "{}",
        named[1].why
    );
    let both = planned(&format!("{pair}[solver]\nmethod = \"rkmk4\"\n")).body_solvers;
    assert!(both.iter().all(|solver| solver.method == Method::Rkmk4));
    // A joint is of the bodies that it holds.
    let jointed = planned(&format!("{pair}{BALL}")).body_solvers;
    assert_eq!((jointed[0].method, jointed[0].joint_rows), (Method::Tsit5, 3));
    assert_eq!((jointed[1].joints, jointed[1].joint_rows), (0, 0));
}

fn each<V>(_: &[V]) -> usize {
    size_of::<V>()
}

/// What the states of bodies keep of one body.
fn kept<T: Real>() -> [(Formulation, usize); 4] {
    let none = Bodies::<T>::default();
    let (matrix, quaternion) = (matrix::State::from_bodies(&none), quaternion::State::from_bodies(&none));
    let motor = motor::State::from_bodies(&none);
    let vectors = each(&none.momentum) + each(&none.angular_momentum);
    [
        (Formulation::Matrix, vectors + each(&matrix.position) + each(&matrix.orientation)),
        (Formulation::Quaternion, vectors + each(&quaternion.position) + each(&quaternion.orientation)),
        (Formulation::Rotor, vectors + each(&none.position) + each(&none.rotor)),
        (Formulation::Motor, vectors + each(&motor.anchor) + each(&motor.motor)),
    ]
}

#[test]
fn bytes_of_state_are_those_of_the_formulation() {
    for (scalar, expected) in [("f64", kept::<f64>()), ("f32", kept::<f32>())] {
        for (formulation, bytes) in expected {
            let set = format!("formulation={}", formulation.name());
            let scene = accepted(&format!("{SOUND}{}", body("a", "")), &[&set, &format!("solver.scalar={scalar}")]);
            assert_eq!(plan(&scene).state_bytes_per_body, bytes, "{scalar} {formulation:?}");
        }
    }
}

#[test]
fn what_is_evaluated_and_not_stepped_is_known_at_frames() {
    let a = body("a", "");
    // Without dt_s at frames of a display; with it at its multiples, unless frames are asked for.
    let free = accepted(&format!("duration_s = 2\n{a}"), &[]);
    assert_eq!((record_hz(&free), steps(&free)), (Some(60.0), 120));
    let stepped = accepted(&format!("{SOUND}{a}"), &[]);
    assert_eq!((record_hz(&stepped), steps(&stepped), interval_s(&stepped)), (None, 100, 0.01));
    let framed = accepted(&format!("{SOUND}record_hz = 5\n{a}"), &[]);
    assert_eq!((steps(&framed), plan(&framed).stepping), (5, Stepping::None));
    // In another formulation it is stepped, and so it is where bodies can collide.
    let matrix = accepted(&format!("{SOUND}record_hz = 5\n{a}"), &["formulation=matrix"]);
    assert_eq!((steps(&matrix), plan(&matrix).stepping), (100, Stepping::Fixed));
    let boxes = format!(
        "{}{}",
        body("a", "shape.box.size_m = [1, 1, 1]\n"),
        body("b", "position_m = [5, 0, 0]\nshape.box.size_m = [1, 1, 1]\n")
    );
    let colliding = accepted(&format!("{SOUND}record_hz = 5\n{boxes}"), &[]);
    assert_eq!((steps(&colliding), plan(&colliding).collision_pairs), (100, 1));
    let jointed = "[[joint]]\nball = { a = \"a\", b = \"b\", point_m = [2.5, 0, 0] }\n";
    assert_eq!(planned(&format!("{SOUND}{boxes}{jointed}")).collision_pairs, 0, "a joint's bodies do not collide");
    let balls = boxes.replace("shape.box.size_m = [1, 1, 1]", "shape.ball.radius_m = 0.5");
    let plan = planned(&format!("{SOUND}{balls}"));
    assert_eq!(plan.collision_pairs, 0);
    assert!(plan.left_out.iter().any(|left_out| left_out.what == "round shapes" && left_out.why.contains("2 here")));
}

fn built(text: &str) -> Built<f64> {
    let (scene, source) = read(text, &[]).unwrap_or_else(|rejected| panic!("{rejected}"));
    build(&scene, &source).unwrap()
}

/// A body turned by a quarter about z: its x axis is the world's y axis.
fn turned(name: &str, x: f64) -> String {
    let turn = format!("{:?}", std::f64::consts::FRAC_PI_2);
    body(
        name,
        &format!("position_m = [{x:?}, 0, 0]\norientation.axis_angle = {{ axis = [0, 0, 1], angle_rad = {turn} }}\n"),
    )
}

fn near(found: Vector<f64>, expected: [f64; 3]) -> bool {
    (found - Vector::from(expected)).norm_sq().sqrt() < 1e-15
}

#[test]
fn joints_are_placed_in_the_frames_of_their_bodies() {
    let bodies = format!("{SOUND}{}{}", turned("a", 0.0), turned("b", 2.0));
    let hinge = "[[joint]]\nhinge = { a = \"a\", b = \"b\", point_m = [1, 0, 3], axis = [5, 0, 0] }\n";
    let joints = built(&format!("{bodies}{hinge}")).subject.joints;
    let [Joint::Hinge { a, b, axis_a, axis_b }] = joints[..] else { panic!("{joints:?}") };
    let at = |end| match end {
        Attachment::Body { body_idx, at_body } => (body_idx, at_body),
        Attachment::World(_) => panic!("on a body"),
    };
    assert!(at(a).0 == 0 && near(at(a).1, [0.0, -1.0, 3.0]), "{a:?}");
    assert!(at(b).0 == 1 && near(at(b).1, [0.0, 1.0, 3.0]), "{b:?}");
    assert!(near(axis_a, [0.0, -1.0, 0.0]) && near(axis_b, [0.0, -1.0, 0.0]), "{axis_a} {axis_b}");
    let to_world = "[[joint]]\nhinge = { a = \"b\", point_m = [1, 0, 3], axis = [0, 2, 0] }\n\
                    [[joint]]\ndistance = { a = \"a\", at_a_body_m = [1, 0, 0], to_m = [0, 4, 0] }\n";
    let joints = built(&format!("{bodies}{to_world}")).subject.joints;
    let [Joint::Hinge { b: Attachment::World(point), axis_b, .. }, Joint::Distance { length, .. }] = joints[..] else {
        panic!("{joints:?}")
    };
    assert!(<[f64; 3]>::from(point) == [1.0, 0.0, 3.0] && near(axis_b, [0.0, 1.0, 0.0]));
    // From (0, 1, 0), where the body's (1, 0, 0) is, to (0, 4, 0).
    assert!((length - 3.0).abs() < 1e-15, "{length}");
}

#[test]
fn torques_and_springs_are_those_of_the_file() {
    let text = format!(
        "{SOUND}{}{}[[force]]\ntorque = {{ body = \"b\", torque_world_n_m = [1, 2, 3], end_s = 0.5 }}\n\
         [[force]]\nspring = {{ a = \"b\", b = \"a\", at_b_body_m = [0, 1, 0], stiffness_n_m = 7, damping_n_s_m = 2 }}\n",
        turned("a", 0.0),
        turned("b", 3.0)
    );
    let forces = built(&text).subject.forces.forces;
    let [
        Force::Torque { body_idx: 1, torque_world, start_s, end_s },
        Force::Spring { stiffness, damping, rest_length, .. },
    ] = forces[..]
    else {
        panic!("{forces:?}")
    };
    assert_eq!((torque_world.e23, torque_world.e31, torque_world.e12, start_s, end_s), (1.0, 2.0, 3.0, 0.0, 0.5));
    // The body's (0, 1, 0) is at (-1, 0, 0): 4 m from the other's centre.
    assert!((stiffness, damping) == (7.0, 2.0) && (rest_length - 4.0_f64).abs() < 1e-15, "{rest_length}");
}

#[test]
fn round_shapes_have_the_inertia_of_their_solids_and_a_picture_about_their_centres() {
    let of = |shape: &str, scale: f64| {
        let text = format!("{SOUND}[[body]]\nname = \"a\"\nmass_kg = 3\nscale = {scale:?}\nshape.{shape}\n");
        let built = built(&text);
        (built.subject.inertias[0].inertia_body, built.looks[0].clone())
    };
    let close = |found: [[f64; 3]; 3], [x, y, z]: [f64; 3]| {
        let expected = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
        found.iter().flatten().zip(expected.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-14 * z.max(x))
    };
    // m = 3: 2/5 m r²; m r²/2 and m (3 r² + l²) / 12; 3/10 m r² and 3/20 m r² + 3/80 m h².
    assert!(close(of("ball.radius_m = 0.5", 2.0).0, [1.2; 3]));
    assert!(close(of("cylinder = { radius_m = 1, length_m = 2 }", 1.0).0, [1.75, 1.75, 1.5]));
    assert!(close(of("cone = { radius_m = 1, height_m = 2 }", 1.0).0, [0.9, 0.9, 0.9]));
    let (capsule, look) = of("capsule = { radius_m = 1, length_m = 2 }", 0.5);
    let ends = [capsule[0][0], capsule[2][2]];
    // Between those of the ball of its radius and of the cylinder of its whole length.
    assert!(ends[0] > 0.4 * 3.0 * 0.25 && ends[0] < 3.0 * (3.0 * 0.25 + 4.0) / 12.0 && ends[1] < 0.375, "{ends:?}");
    let Look::Revolution(profile) = look else { panic!("{look:?}") };
    assert_eq!((profile[0], profile[profile.len() - 1]), ([0.0, -1.0], [0.0, 1.0]));
    assert!(profile.windows(2).all(|pair| pair[0][1] <= pair[1][1]), "from below to above");
    let (_, Look::Revolution(cone)) = of("cone = { radius_m = 1, height_m = 2 }", 1.0) else { panic!("a profile") };
    assert_eq!(cone, [[0.0, -0.5], [1.0, -0.5], [0.0, 1.5]]);
    assert!(matches!(of("ball.radius_m = 0.5", 2.0).1, Look::Ellipsoid([r, _, _]) if r == 1.0));
}

#[test]
fn bodies_are_listed_by_formulation_each_once() {
    let fixed = "[[body]]\nname = \"wall\"\nfixed = true\nposition_m = [0, 0, 9]\nshape.box.size_m = [1, 1, 1]\n";
    let text =
        format!("{SOUND}{}{fixed}{}", body("a", "formulation = \"matrix\"\n"), body("b", "position_m = [5, 0, 0]\n"));
    let lists: Vec<_> = built(&text).body_solvers.into_iter().map(|(solver, list)| (solver.form, list)).collect();
    assert_eq!(lists, [(Form::Matrix, vec![0, 1]), (Form::Rotor, vec![2])]);
}

#[test]
fn an_override_reaches_joints_by_their_index() {
    let text = format!("{SOUND}{}{BALL}", body("a", ""));
    let moved = accepted(&text, &["joint.0.ball.point_m=[1, 2, 3]", "body.a.formulation=motor"]);
    let [description::Joint::Ball(ball)] = &moved.joint[..] else { panic!("a ball") };
    assert_eq!(ball.point_m.get_ref().0, [1.0, 2.0, 3.0]);
    assert_eq!(moved.formulation_of(&moved.body[0]), Formulation::Motor);
    assert!(complaints(&text, &["joint.1.ball.point_m=[1, 2, 3]"]).contains("`joint` has no element `1`"));
    assert!(complaints(SOUND, &["joint.0.ball.point_m=[1, 2, 3]"]).contains("the scene has no [[joint]]"));
}

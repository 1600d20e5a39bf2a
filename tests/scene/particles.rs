//! Particles of a scene: their places, their constraints in conformal form, their forces, and the plan.

use ga_physics::algebra::cga::Point;
use ga_physics::particle::{Constraint, Force};
use ga_physics::scene::build::{ParticleSetup, build};
use ga_physics::scene::description::Method;
use ga_physics::scene::plan::{interval_s, plan, record_hz, steps};
use proptest::prelude::*;

use crate::{SOUND, accepted, read};

fn built(text: &str) -> ParticleSetup<f64> {
    let (scene, source) = read(text, &[]).unwrap_or_else(|rejected| panic!("{rejected}"));
    build(&scene, &source).unwrap().particles.unwrap()
}

fn distance(setup: &ParticleSetup<f64>, a: usize, b: usize) -> f64 {
    setup.state.position[a].distance_sq_to(setup.state.position[b]).sqrt()
}

fn net(columns: u32, rows: u32, fold: f64, row_fold: f64) -> String {
    format!(
        "{SOUND}[[net]]\nname = \"n\"\ncolumns = {columns}\nrows = {rows}\ncorner_m = [1e3, -2, 5]\n\
         column_step_m = [0.3, 0.1, 0]\nrow_step_m = [0, 0.2, -0.4]\nmass_kg = 0.5\nfold_rad = {fold:?}\n\
         row_fold_rad = {row_fold:?}\n"
    )
}

proptest! {
    #[test]
    fn links_of_a_net_keep_the_length_of_its_steps_however_it_is_folded(
        columns in 1_u32..6, rows in 1_u32..6, fold in -1.5..1.5_f64, row_fold in -1.5..1.5_f64,
    ) {
        let setup = built(&net(columns, rows, fold, row_fold));
        prop_assert_eq!(setup.names.len(), (columns * rows) as usize);
        prop_assert_eq!(setup.look.links.len(), ((columns - 1) * rows + columns * (rows - 1)) as usize);
        for [a, b] in &setup.look.links {
            let length = if b - a == 1 && columns > 1 { 0.3_f64.hypot(0.1) } else { 0.2_f64.hypot(0.4) };
            // Coordinates of 1e3 m are off by half an ulp, 6e-14 m.
            prop_assert!((distance(&setup, *a, *b) - length).abs() < 1e-12, "{} {}", a, b);
        }
    }
}

#[test]
fn a_net_is_named_by_column_and_row_and_folded_along_its_normal() {
    let fold: f64 = 0.5;
    let setup = built(&format!(
        "{SOUND}[[net]]\nname = \"n\"\ncolumns = 3\nrows = 2\ncolumn_step_m = [2, 0, 0]\nrow_step_m = [0, 1, 0]\n\
         mass_kg = 0.5\nfold_rad = {fold}\nfixed = [[0, 0], [2, 0]]\n"
    ));
    assert_eq!(setup.names, ["n.0.0", "n.1.0", "n.2.0", "n.0.1", "n.1.1", "n.2.1"]);
    assert_eq!(setup.fixed, [true, false, true, false, false, false]);
    let (wide, out) = (2.0 * fold.cos(), 2.0 * fold.sin());
    let expected = [[0.0, 0.0, 0.0], [wide, 0.0, out], [2.0 * wide, 0.0, 0.0], [0.0, 1.0, 0.0], [wide, 1.0, out]];
    for (found, expected) in setup.state.position.iter().zip(expected) {
        assert!(found.distance_sq_to(Point::from(expected)) < 1e-30, "{found:?} {expected:?}");
    }
}

#[test]
fn links_between_fixed_particles_are_drawn_but_hold_nothing() {
    let setup = built(&format!("{}fixed = [\"first_row\"]\n", net(4, 3, 0.0, 0.0)));
    assert_eq!(setup.look.links.len(), 3 * 3 + 4 * 2);
    assert_eq!(setup.constraints.len(), 3 * 3 + 4 * 2 - 3);
}

#[test]
fn a_chain_ends_where_it_is_said_to() {
    let setup = built(&format!(
        "{SOUND}[[chain]]\nname = \"c\"\nparticles = 4\nfrom_m = [0.1, 0, 0]\nto_m = [0.7, 0.3, -0.1]\nmass_kg = 2\n\
         fixed = [\"last\"]\n"
    ));
    assert_eq!(<[f64; 3]>::from(setup.state.position[3]), [0.7, 0.3, -0.1]);
    assert_eq!(setup.fixed, [false, false, false, true]);
    let whole = distance(&setup, 0, 3);
    for constraint in &setup.constraints {
        let Constraint::Distance { a, b, length } = constraint else { panic!("links only") };
        assert_eq!((b - a, *length), (1, distance(&setup, *a, *b)));
        assert!((3.0 * length - whole).abs() < 1e-15);
    }
}

/// `X . S` of every surface of the setup at a place.
fn incidences(setup: &ParticleSetup<f64>, at: [f64; 3]) -> Vec<f64> {
    let value = |constraint: &Constraint| {
        let Constraint::On { anchor, surface, .. } = constraint else { panic!("surfaces only") };
        Point::from(anchor.displacement_to(Point::from(at))) | *surface
    };
    setup.constraints.iter().map(value).collect()
}

fn held(position: [f64; 3], by: &str) -> ParticleSetup<f64> {
    built(&format!("{SOUND}[[particle]]\nname = \"p\"\nmass_kg = 1\nposition_m = {position:?}\n[[constraint]]\n{by}\n"))
}

#[test]
fn lines_and_circles_are_meets_of_two_surfaces_also_far_from_the_origin() {
    for far in [0.0, 1e6] {
        let moved = |[x, y, z]: [f64; 3]| [x + far, y + far, z + far];
        let (point, centre) = (moved([1.0, 2.0, 3.0]), moved([1.0, 0.0, 0.0]));
        let line = held(
            moved([2.0, 4.0, 5.0]),
            &format!("on_line = {{ particle = \"p\", point_m = {point:?}, direction = [1, 2, 2] }}"),
        );
        let circle = held(
            moved([1.0, 2.0, 0.0]),
            &format!("on_circle = {{ particle = \"p\", centre_m = {centre:?}, radius_m = 2, normal = [0.5, 0, 0] }}"),
        );
        // Half an ulp of each coordinate, through two subtractions and products with numbers up to 10.
        let bound = 20.0 * f64::EPSILON * (far + 10.0);
        assert_eq!((line.constraints.len(), circle.constraints.len()), (2, 2));
        for s in [-3.0, 0.0, 3.0] {
            let worst = incidences(&line, moved([1.0 + s, 2.0 + 2.0 * s, 3.0 + 2.0 * s]));
            assert!(worst.iter().all(|value| value.abs() < bound), "{far}: {worst:?}");
        }
        for (y, z) in [(2.0, 0.0), (0.0, -2.0), (1.2, 1.6)] {
            let worst = incidences(&circle, moved([1.0, y, z]));
            assert!(worst.iter().all(|value| value.abs() < bound), "{far}: {worst:?}");
        }
        // A place off them is off at least one of the two surfaces.
        for (setup, off) in [(&line, [1.0, 2.0, 3.5]), (&circle, [1.0, 1.5, 0.0]), (&circle, [1.5, 2.0, 0.0])] {
            assert!(incidences(setup, moved(off)).iter().any(|value| value.abs() > 0.1), "{off:?}");
        }
    }
}

#[test]
fn a_sphere_or_plane_is_one_surface_with_its_sign() {
    let sphere = held([3.0, 0.0, 0.0], "on_sphere = { particle = \"p\", centre_m = [1, 0, 0] }");
    assert_eq!(incidences(&sphere, [1.0, 0.0, 0.0]), [2.0], "positive inside: radius squared over 2");
    let plane = held([3.0, 0.0, 1.0], "on_plane = { particle = \"p\", normal = [0, 0, 4] }");
    assert_eq!(incidences(&plane, [9.0, 9.0, 3.0]), [2.0], "the distance on the side of the normal");
}

#[test]
fn the_name_of_a_group_stands_for_its_particles_that_move() {
    let setup = built(&format!(
        "{}fixed = [[0, 0]]\n[[constraint]]\non_plane = {{ particle = \"n\", normal = [0, 0, 1] }}\n\
         [[force]]\nlinear_drag = {{ particle = \"n\", k_kg_s = 2 }}\n[[force]]\nquadratic_drag.k_kg_m = 3\n",
        net(2, 2, 0.0, 0.0)
    ));
    let on: Vec<usize> = setup
        .constraints
        .iter()
        .filter_map(|constraint| match constraint {
            Constraint::On { particle, .. } => Some(*particle),
            _ => None,
        })
        .collect();
    assert_eq!(on, [1, 2, 3]);
    let dragged: Vec<Option<usize>> = setup
        .forces
        .iter()
        .filter_map(|force| match force {
            Force::LinearDrag { particle, .. } | Force::QuadraticDrag { particle, .. } => Some(*particle),
            _ => None,
        })
        .collect();
    assert_eq!(dragged, [Some(1), Some(2), Some(3), None]);
}

#[test]
fn gravity_is_a_force_on_particles_and_springs_rest_at_the_start() {
    let setup = built(&format!(
        "{SOUND}gravity_m_s2 = [0, 0, -9.81]\n[[particle]]\nname = \"a\"\nmass_kg = 1\n\
         [[particle]]\nname = \"b\"\nmass_kg = 1\nposition_m = [0, 3, 4]\n\
         [[force]]\nspring = {{ a = \"a\", b = \"b\", stiffness_n_m = 7 }}\n"
    ));
    let [Force::Uniform { acceleration }, Force::Spring { a: 0, b: 1, rest_length, .. }] = &setup.forces[..] else {
        panic!("{:?}", setup.forces)
    };
    assert_eq!((acceleration.e3, *rest_length), (-9.81, 5.0));
}

#[test]
fn values_beyond_f32_are_refused_for_f32_only() {
    let text = format!(
        "{SOUND}[[particle]]\nname = \"a\"\nmass_kg = 1e50\n[[force]]\ninverse_square_to_point = {{ constant_m3_s2 = 1e-60, \
         softening_m = 1 }}\n"
    );
    built(&text);
    for (mass, expected) in [("1e50", "1e-60 is out"), ("1", "1e-60 is out")] {
        let (scene, source) = read(&text.replace("1e50", mass), &["solver.scalar=f32"]).unwrap();
        let mistakes = build::<f32>(&scene, &source).unwrap_err();
        assert!(mistakes[0].message.contains(expected), "{}", mistakes[0].message);
    }
    let (scene, source) = read(&text.replace("1e-60", "1"), &["solver.scalar=f32"]).unwrap();
    assert!(build::<f32>(&scene, &source).unwrap_err()[0].message.contains("1e50 is out"));
}

const PENDULUM: &str = "[[particle]]\nname = \"a\"\nmass_kg = 1\nposition_m = [1, 0, 0]\n[[constraint]]\n\
     distance_to_point = { particle = \"a\", point_m = [0, 0, 0] }\n";

#[test]
fn the_plan_chooses_a_solver_and_says_why() {
    let method =
        |head: &str, tail: &str| plan(&accepted(&format!("{head}{PENDULUM}{tail}"), &[])).particle_solver.unwrap();
    let fixed = method(SOUND, "");
    assert_eq!((fixed.method, fixed.adaptive), (Method::Tsit5, false));
    let chosen = method("duration_s = 1\n", "");
    assert_eq!((chosen.method, chosen.adaptive), (Method::Dop853, true));
    assert_eq!(method("duration_s = 1\n", "[solver]\nrtol = 1e-3\n").method, Method::Tsit5);
    let named = method(SOUND, "[solver]\nmethod = \"cash_karp\"\n");
    assert_eq!((named.method, named.why.as_str()), (Method::CashKarp, "the scene names it"));
    let free = |tail: &str| {
        let text = format!("{SOUND}[[particle]]\nname = \"a\"\nmass_kg = 1\n{tail}");
        plan(&accepted(&text, &[])).particle_solver.unwrap().method
    };
    assert_eq!((free(""), free("[[force]]\nlinear_drag.k_kg_s = 1\n")), (Method::Yoshida4, Method::Tsit5));
    let large = format!("{}fixed = [[0, 0]]\n", net(9, 9, 0.0, 0.0));
    assert_eq!(plan(&accepted(&large, &[])).particle_solver.unwrap().method, Method::Verlet);
    let plan = plan(&accepted(&format!("{SOUND}{PENDULUM}"), &["solver.rtol=1e-3", "solver.method=rk4"]));
    assert!(plan.left_out.iter().any(|left_out| left_out.what == "tolerances"), "what is not used is said");
    assert!(plan.left_out.iter().any(|left_out| left_out.what == "bodies"));
    assert_eq!((plan.particles, plan.moving_particles, plan.constraints), (1, 1, 1));
}

#[test]
fn states_are_asked_for_at_frames_where_the_method_chooses_its_steps() {
    let scene = accepted(&format!("duration_s = 2\n{PENDULUM}"), &[]);
    assert_eq!((record_hz(&scene), steps(&scene)), (Some(60.0), 120));
    let fixed = accepted(&format!("{SOUND}{PENDULUM}"), &[]);
    assert_eq!((record_hz(&fixed), steps(&fixed), interval_s(&fixed)), (None, 100, 0.01));
    // Given with a tolerance, dt_s is the largest step, and not when states are asked for.
    let limited = accepted(&format!("{SOUND}record_hz = 5\n{PENDULUM}"), &["solver.rtol=1e-6"]);
    assert_eq!((steps(&limited), interval_s(&limited)), (5, 0.2));
    // Bodies that can collide need a step, whatever solves the particles.
    let body = |name: &str, x: f64| {
        format!("[[body]]\nname = \"{name}\"\nmass_kg = 1\nposition_m = [{x:?}, 9, 9]\nshape.box.size_m = [1, 1, 1]\n")
    };
    let (one, two) = (body("c", 0.0), body("c", 0.0) + &body("d", 3.0));
    let both = accepted(&format!("{SOUND}{PENDULUM}{one}"), &["solver.method=tsit5"]);
    assert_eq!(steps(&both), 100);
    assert_eq!(steps(&accepted(&format!("duration_s = 1\n{PENDULUM}{one}"), &[])), 60);
    assert!(read(&format!("duration_s = 1\n{PENDULUM}{two}"), &[]).is_err());
}

//! What cannot be held is told, by name.

use crate::cases::{Case, inertia_tensor, medley, turned, vector};
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::Rotor;
use ga_physics::constraint::{ProjectionError, SolveError};
use ga_physics::rigid::{Attachment, Held, Inertia, Joint, JointError, Wrenches};

fn ball() -> Inertia<f64> {
    Inertia::new(1.0, inertia_tensor([0.1; 3], Rotor::default())).unwrap()
}

/// Two bodies a metre apart, hinged to the world and to each other.
fn two() -> Case {
    let mut case = Case::default();
    let a = case.body([0.5, 0.0, 0.0], Rotor::default(), ball());
    let b = case.body([1.5, 0.0, 0.0], turned([0.0, 1.0, 0.0], 0.4), ball());
    case.hinge(a, None, [0.0; 3], [0.0, 1.0, 0.0]);
    case.hinge(b, Some(a), [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    case
}

fn refused(case: &Case) -> JointError {
    Held::new(&case.joints, &case.bodies, &case.inertias, 1e-12).err().unwrap()
}

#[test]
fn joints_that_hold_nothing_are_refused() {
    let on = |body_idx| Attachment::Body { body_idx, at_body: vector([0.5, 0.0, 0.0]) };
    let world = Attachment::World(Point::from([1.0, 0.0, 0.0]));
    let with = |joint| {
        let mut case = two();
        case.joints.push(joint);
        refused(&case)
    };
    let expected = JointError::NoSuchBody { joint: 2, body_idx: 7, bodies: 2 };
    assert_eq!(with(Joint::Ball { a: on(0), b: on(7) }), expected);
    assert_eq!(with(Joint::Ball { a: on(1), b: on(1) }), JointError::SameBody { joint: 2, body_idx: 1 });
    assert_eq!(with(Joint::Ball { a: world, b: world }), JointError::Immovable { joint: 2 });
    for length_m in [0.0, -1.0, f64::INFINITY] {
        assert_eq!(
            with(Joint::Distance { a: on(0), b: on(1), length: length_m }),
            JointError::Length { joint: 2, length_m }
        );
    }
    let axes =
        |axis_a, axis_b| with(Joint::Hinge { a: on(0), b: world, axis_a: vector(axis_a), axis_b: vector(axis_b) });
    assert_eq!(axes([0.0; 3], [1.0, 0.0, 0.0]), JointError::ZeroAxis { joint: 2 });
    assert_eq!(axes([1.0, 0.0, 0.0], [0.0, f64::NAN, 0.0]), JointError::NotFinite { joint: 2 });
    let nowhere = Attachment::World(Point::from([0.0, f64::INFINITY, 0.0]));
    assert_eq!(with(Joint::Ball { a: on(0), b: nowhere }), JointError::NotFinite { joint: 2 });

    let mut fixed = two();
    fixed.inertias = vec![Inertia::immovable(), ball()];
    assert_eq!(refused(&fixed), JointError::Immovable { joint: 0 });
    fixed.inertias.truncate(1);
    assert_eq!(refused(&fixed), JointError::Sizes { bodies: 2, inertias: 1 });
}

/// An axis says a direction, whatever its length.
#[test]
fn an_axis_may_have_any_length() {
    let mut case = two();
    for joint in &mut case.joints {
        if let Joint::Hinge { axis_a, axis_b, .. } = joint {
            (*axis_a, *axis_b) = (*axis_a * 1e-200, *axis_b * 1e200);
        }
    }
    let mut held = Held::new(&case.joints, &case.bodies, &case.inertias, 1e-12).unwrap();
    assert!(held.worst_violation(&case.bodies).unwrap().1 < 1e-15);
}

#[test]
fn joints_that_do_not_fit_at_the_start_are_refused() {
    let mut apart = two();
    apart.bodies.position[1] = Point::from([1.5, 0.0, 1e-6]);
    let JointError::Apart { joint: 1, gap_m, allowed_m } = refused(&apart) else { panic!("{}", refused(&apart)) };
    assert!((gap_m - 1e-6).abs() < 1e-12 && allowed_m < 1e-11, "{gap_m:e} {allowed_m:e}");
    // Rounding is no gap.
    apart.bodies.position[1] = Point::from([1.5, 0.0, 1e-15]);
    assert!(Held::new(&apart.joints, &apart.bodies, &apart.inertias, 1e-12).is_ok());
    apart.bodies.position[1] = Point::from([f64::NAN, 0.0, 0.0]);
    assert_eq!(refused(&apart), JointError::NotFinite { joint: 1 });

    let skew = |angle: f64| {
        let mut case = two();
        if let Joint::Hinge { axis_a, .. } = &mut case.joints[0] {
            *axis_a = turned([1.0, 0.0, 0.0], angle).apply(*axis_a);
        }
        match refused(&case) {
            JointError::AxesApart { joint: 0, angle_rad } => angle_rad,
            other => panic!("{other}"),
        }
    };
    // Opposite axes satisfy every equation of a hinge.
    for angle in [1e-6, 0.3, 2.0, std::f64::consts::PI] {
        assert!((skew(angle) - angle).abs() < 1e-14, "{angle}");
    }
}

/// A body that nothing moves was moved by hand: out of reach, or with its axis reversed.
#[test]
fn what_cannot_be_reached_ends_the_run_and_names_the_joint() {
    let mut case = Case::default();
    let (a, b) = (case.body([0.5, 0.0, 0.0], Rotor::default(), ball()), case.body([1.0; 3], Rotor::default(), ball()));
    case.inertias[b] = Inertia::immovable();
    case.distance(a, None, [0.5, 0.0, 0.2], [0.0, 0.0, 0.0]);
    case.hinge(a, Some(b), [0.9, 0.0, 0.0], [0.0, 0.0, 1.0]);
    let mut held = Held::new(&case.joints, &case.bodies, &case.inertias, 1e-12).unwrap();
    let mut far = case.bodies.clone();
    far.position[b] = Point::from([11.0, 1.0, 1.0]);
    let Err(ProjectionError::NotConverged { row, violation_m, .. }) = held.project(&mut far) else {
        panic!("it was reached")
    };
    assert!(row < 2 && violation_m > 1.0, "{row} {violation_m}");
    assert!(far.position[a].x.is_finite());
    let mut reversed = case.bodies.clone();
    reversed.rotor[b] = turned([1.0, 0.0, 0.0], std::f64::consts::PI);
    reversed.position[b] = Point::from([1.0, -1.0, -1.0]);
    let outcome = held.project(&mut reversed);
    let Err(ProjectionError::NotConverged { row: 1, .. }) = outcome else { panic!("{outcome:?}") };
}

#[test]
fn numbers_that_are_none_name_the_joint() {
    let case = medley();
    let mut held = Held::new(&case.joints, &case.bodies, &case.inertias, 1e-12).unwrap();
    let mut wrenches = Wrenches::zeros(3);
    wrenches.force[2] = vector([f64::NAN; 3]);
    let outcome = held.constrain(&case.bodies, &case.inertias, &mut wrenches);
    assert_eq!(outcome, Err(SolveError::NotFinite { row: 2 }));
    let mut bodies = case.bodies.clone();
    bodies.position[0].x = f64::NAN;
    let outcome = held.project(&mut bodies);
    assert_eq!(outcome, Err(ProjectionError::Solve(SolveError::NotFinite { row: 0 })));
}

//! Observed orders.

use super::reference::{quaternion, split};
use super::ways::{Case, Pace, Way, spinning, ways};
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::Vector;
use ga_physics::rigid::{Attachment, Bodies, Force};
use nalgebra::UnitQuaternion;

/// Steps, the finer ones twice as many: few enough that rounding is not seen, many enough that higher terms are not.
fn steps(way: &Way<f64>) -> [f64; 2] {
    match way.order {
        4 => [128.0, 256.0],
        5 => [64.0, 128.0],
        _ => [9.0, 18.0],
    }
}

/// How far the observed order may be below and above the stated one. Methods of order 5 and 8 have leading terms that are
/// small on purpose: later ones are seen beside them.
fn bounds(order: u32) -> (f64, f64) {
    match order {
        4 => (0.1, 0.1),
        5 => (0.2, 1.2),
        _ => (0.15, 0.6),
    }
}

fn check(way: &Way<f64>, order: f64) {
    let off = order - f64::from(way.order);
    let (below, above) = bounds(way.order);
    assert!(-below < off && off < above, "{}: observed order {order}", way.name());
}

#[test]
fn the_attitude_of_a_free_body_converges_with_the_stated_order() {
    let (moments, omega, duration) = ([1.0, 2.0, 2.5], [0.6, 0.4, 0.8], 4.0);
    let reference = split(moments, omega, UnitQuaternion::identity(), duration, 2000);
    let case = spinning(1.0, moments, omega);
    for way in &ways() {
        let errors = steps(way).map(|steps| {
            let end = way.run(&case, Pace::Fixed(duration / steps), duration);
            quaternion(end.rotor[0]).angle_to(&reference)
        });
        let order = (errors[0] / errors[1]).log2();
        println!("{}: {errors:?}, order {order:.3}", way.name());
        check(way, order);
    }
}

/// A body that hangs on a spring by a corner.
fn hanging() -> Case<f64> {
    let mut case: Case<f64> = spinning(1.0, [1.0, 2.0, 2.5], [0.6, 0.4, 0.8]);
    let a = Attachment::Body { body_idx: 0, at_body: Vector::new(0.3, 0.2, 0.5) };
    let b = Attachment::World(Point::new(0.0, 0.5, 5.0));
    case.setup.forces.forces = vec![Force::Spring { a, b, stiffness: 1.0, damping: 0.1, rest_length: 4.0 }];
    case
}

#[test]
fn position_and_attitude_of_a_body_on_a_spring_converge_with_the_stated_order() {
    let (case, duration) = (hanging(), 3.0);
    let all = ways();
    let best = all.iter().find(|way| (way.form, way.method) == ("rotor", "dop853")).unwrap();
    let reference = best.run(&case, Pace::Fixed(duration / 256.0), duration);
    let error = |end: &Bodies<f64>| {
        let turned = quaternion(end.rotor[0]).angle_to(&quaternion(reference.rotor[0]));
        turned.hypot(end.position[0].distance_sq_to(reference.position[0]).sqrt())
    };
    for way in &all {
        let errors = steps(way).map(|steps| error(&way.run(&case, Pace::Fixed(duration / steps), duration)));
        let order = (errors[0] / errors[1]).log2();
        println!("{}: {errors:?}, order {order:.3}", way.name());
        check(way, order);
    }
}

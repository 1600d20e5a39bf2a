//! What a formulation is beside its speed: bytes, lines, and what only one of them does.

use super::case::angle_between;
use crate::algebra::cga::{Motor, Point};
use crate::algebra::g3::{Bivector, Rotor, Vector};
use crate::rigid::{Bodies, Form, Method, Motion, Solver};
use crate::study::StudyError;
use nalgebra::{Matrix3, Point3, Quaternion, Vector3};
use serde::Serialize;

/// What holds for a formulation whatever integrates it.
#[derive(Clone, Debug, Serialize)]
pub struct Traits {
    /// The formulation.
    pub form: &'static str,
    /// State of a body in f64.
    pub bytes_per_body: usize,
    /// Lines of its file that are neither blank nor comments.
    pub lines_of_code: usize,
    /// Of these, in its equations of motion.
    pub lines_of_rhs: usize,
    /// How far a body that spins at 1 rad/s and flies at 1 m/s is off its straight line after 10 s, by RK4 with steps of
    /// 0.1 s, m.
    pub flight_error_m: f64,
    /// What it is for.
    pub buys: &'static str,
}

const SOURCES: [(Form, &str); 4] = [
    (Form::Matrix, include_str!("../../rigid/matrix.rs")),
    (Form::Quaternion, include_str!("../../rigid/quaternion.rs")),
    (Form::Rotor, include_str!("../../rigid/rotor.rs")),
    (Form::Motor, include_str!("../../rigid/motor.rs")),
];

/// Of each formulation.
///
/// # Errors
/// A solver cannot be used, or does not arrive.
pub fn traits() -> Result<Vec<Traits>, StudyError> {
    SOURCES
        .into_iter()
        .map(|(form, source)| {
            Ok(Traits {
                form: form.name(),
                bytes_per_body: bytes_per_body(form),
                lines_of_code: lines_of_code(source),
                lines_of_rhs: lines_of_code(function(source, "pub fn rhs")),
                flight_error_m: flight_error_m(form)?,
                buys: buys(form),
            })
        })
        .collect()
}

fn bytes_per_body(form: Form) -> usize {
    let momenta = 2 * size_of::<Vector3<f64>>();
    match form {
        Form::Matrix => size_of::<Point3<f64>>() + size_of::<Matrix3<f64>>() + momenta,
        Form::Quaternion => size_of::<Point3<f64>>() + size_of::<Quaternion<f64>>() + momenta,
        Form::Rotor => Bodies::<f64>::bytes_per_body(),
        Form::Motor => {
            size_of::<Point<f64>>() + size_of::<Motor<f64>>() + size_of::<Vector<f64>>() + size_of::<Bivector<f64>>()
        }
    }
}

fn buys(form: Form) -> &'static str {
    match form {
        Form::Matrix => "turns many points fastest; drifts",
        Form::Quaternion => "what every other program stores",
        Form::Rotor => "planes, not axes; exponentials, exact free motion and splittings",
        Form::Motor => "position and orientation as one: composes, and follows screws",
    }
}

/// Lines that are neither blank nor comments.
#[must_use]
pub fn lines_of_code(source: &str) -> usize {
    source.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//")).count()
}

/// The text of a function that begins a line, up to the brace that ends it there.
fn function<'a>(source: &'a str, head: &str) -> &'a str {
    let from = source.find(head).map_or("", |at| &source[at..]);
    from.find("\n}").map_or(from, |end| &from[..end + 2])
}

fn flight_error_m(form: Form) -> Result<f64, StudyError> {
    const SECONDS: f64 = 10.0;
    let (setup, mut bodies) = super::case::body()?;
    bodies.momentum[0] = Vector::new(0.6, 0.0, 0.8);
    let mut motion = Motion::new(setup, &bodies, &Solver::fixed(Method::Rk4, 0.1).in_form(form))?;
    motion.advance(&mut bodies, 0.0, SECONDS)?;
    Ok(bodies.position[0].distance_sq_to(Point::new(0.6 * SECONDS, 0.0, 0.8 * SECONDS)).sqrt())
}

/// Interpolation half-way between two recorded poses of a body on a hinge at 1 m from its centre, 1 rad apart.
#[derive(Clone, Debug, Serialize)]
pub struct Between {
    /// How far the hinge's point comes off, m, where the pose is a motor and the way a screw.
    pub screw_m: f64,
    /// Where position and orientation are interpolated each by itself.
    pub separate_m: f64,
    /// How far both orientations are apart, rad.
    pub turn_rad: f64,
}

/// See [`Between`].
pub(super) fn between() -> Between {
    let arm = Vector::new(1.0, 0.0, 0.0);
    let pose = |angle: f64| {
        let rotor = Rotor::exp(Bivector::new(0.0, 0.0, -0.5 * angle));
        (rotor.apply(arm), rotor)
    };
    let ((from, from_rotor), (to, to_rotor)) = (pose(0.0), pose(1.0));
    // The hinge is at the origin of the world, at -arm in the body.
    let off = |centre: Vector<f64>, rotor: Rotor<f64>| (centre + rotor.apply(-arm)).norm_sq().sqrt();
    let screw = Motor::from_parts(from, from_rotor).interpolate(Motor::from_parts(to, to_rotor), 0.5);
    let rotor = from_rotor.interpolate(to_rotor, 0.5);
    Between {
        screw_m: off(screw.translation(), screw.rotor()),
        separate_m: off((from + to) * 0.5, rotor),
        turn_rad: angle_between(screw.rotor().into(), rotor.into()),
    }
}

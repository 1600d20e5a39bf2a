//! Where a body is at the start, and how it moves.

use std::ops::Range;

use crate::algebra::cga::Point;
use crate::algebra::g3::{Bivector, Even, Rotor, Vector};
use crate::scene::description::{Body, Orientation};
use crate::versor::NotARotor;

/// The state of a body at the start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    pub(crate) position: Point<f64>,
    pub(crate) rotor: Rotor<f64>,
    pub(crate) velocity: Vector<f64>,
    pub(crate) omega_world: Bivector<f64>,
}

impl Pose {
    /// The pose of a body; none if its orientation is no rotation.
    pub(crate) fn of(body: &Body) -> Option<Self> {
        let rotor = rotor(body).ok()?;
        let omega_world = match (&body.omega_world_rad_s, &body.omega_body_rad_s) {
            (Some(world), _) => Bivector::from(world.get_ref().0),
            (None, Some(in_body)) => rotor.apply(Bivector::from(in_body.get_ref().0)),
            (None, None) => Bivector::default(),
        };
        Some(Self {
            position: body.position_m.get_ref().0.into(),
            rotor,
            velocity: body.velocity_m_s.get_ref().0.into(),
            omega_world,
        })
    }

    /// The place of a point of the body.
    pub(crate) fn place(&self, at_body: Vector<f64>) -> Point<f64> {
        self.position.moved(self.rotor.apply(at_body))
    }

    /// A place as a point of the body.
    pub(crate) fn to_body(self, place: Point<f64>) -> Vector<f64> {
        self.rotor.rev().apply(self.position.displacement_to(place))
    }

    /// The velocity `v + r . Omega` of the point of the body at a place.
    pub(crate) fn velocity_at(&self, place: Point<f64>) -> Vector<f64> {
        self.velocity + (self.position.displacement_to(place) | self.omega_world)
    }
}

/// The orientation of a body.
///
/// # Errors
/// What is no rotation, and where it stands.
pub(crate) fn rotor(body: &Body) -> Result<Rotor<f64>, (NotARotor, Range<usize>)> {
    match &body.orientation {
        None => Ok(Rotor::default()),
        Some(Orientation::Rotor(given)) => {
            let [s, e23, e31, e12] = given.get_ref().0;
            let largest = [s, e23, e31, e12].iter().fold(0.0_f64, |max, x| max.max(x.abs()));
            // Scaled first: the squares of very large or small numbers would leave the range.
            let even = Even::new(s, e23, e31, e12) / largest;
            Rotor::normalise(even).map_err(|error| (error, given.span()))
        }
        Some(Orientation::AxisAngle(turn)) => {
            let axis = Vector::from(turn.axis.get_ref().0);
            Rotor::from_axis_angle(axis, *turn.angle_rad.get_ref()).map_err(|error| (error, turn.axis.span()))
        }
    }
}

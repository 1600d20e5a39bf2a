//! What a scene file says: the structs that its TOML is read into.
//!
//! The numbers are raw, in SI units, as the user wrote them; nothing is normalised or computed
//! here (that is the builder's work), and a value is only known to be sound once
//! [`load`](crate::scene::load) has checked it. A value that a later stage may have to point at is
//! a [`Spanned`]; a default's span is `0..0`. Enums are externally tagged
//! (`shape.box.size_m = ..`), which is what lets an error point at the value itself.
//!
//! The doc comments of fields are also the descriptions in the JSON schema.

use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::rigid;
use crate::scene::values::Numbers;

mod body;
mod constraint;
mod force;
mod joint;
mod particle;
mod shape;
mod solver;

pub use body::{AxisAngle, Body, Orientation};
pub use constraint::{Constraint, Distance, DistanceToPoint, OnCircle, OnLine, OnPlane, OnSphere};
pub use force::{AtPoint, Force, InverseSquare, InverseSquareToPoint, LinearDrag, QuadraticDrag, Spring, Torque};
pub use joint::{BallJoint, DistanceJoint, HingeJoint, Joint};
pub use particle::{Chain, ChainEnd, Net, NetFixed, NetPart, Particle};
pub use shape::{Ball, BoxShape, Capsule, Cone, Cylinder, Mesh, Plane, Pyramid, Shape, Tetrahedron};
pub use solver::{ConstraintSolver, Method, Scalar, Solver, Stabilisation};

/// A scene for `ga-physics run`: bodies, particles, forces, gravity, and how long to simulate them.
/// SI units, right-handed axes.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// How long the run lasts, in s. Positive.
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub duration_s: Spanned<f64>,
    /// The time step, in s. Positive, at most `duration_s`. Where steps are chosen by `rtol` it is the largest for particles,
    /// and for bodies how often they are looked at; unless bodies can collide, it may be left out then.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub dt_s: Option<Spanned<f64>>,
    /// How many frames per second of simulated time are recorded, in 1/s. Without it every step is; 60 where the steps
    /// are chosen by the `method`.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub record_hz: Option<Spanned<f64>>,
    /// The acceleration of gravity [x, y, z], in m/s².
    #[serde(default = "zeros")]
    #[schemars(with = "Numbers<3>")]
    pub gravity_m_s2: Spanned<Numbers<3>>,
    /// How the motion of rigid bodies is written.
    #[serde(default = "rotor")]
    #[schemars(with = "Formulation")]
    pub formulation: Spanned<Formulation>,
    /// How the motion is solved.
    #[serde(default)]
    pub solver: Solver,
    /// What happens where bodies touch.
    #[serde(default)]
    pub contact: Contact,
    /// The rigid bodies.
    #[serde(default)]
    pub body: Vec<Body>,
    /// The particles, one by one.
    #[serde(default)]
    pub particle: Vec<Particle>,
    /// Particles in a row, linked.
    #[serde(default)]
    pub chain: Vec<Chain>,
    /// Particles in rows and columns, linked.
    #[serde(default)]
    pub net: Vec<Net>,
    /// The forces besides gravity.
    #[serde(default)]
    pub force: Vec<Force>,
    /// What holds particles, besides the links of chains and nets.
    #[serde(default)]
    pub constraint: Vec<Constraint>,
    /// What joins bodies to one another or to the world.
    #[serde(default)]
    pub joint: Vec<Joint>,
}

/// How the motion of a rigid body is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Formulation {
    /// Orientation as a rotation matrix of nine numbers, which the steps distort: nothing puts it right.
    Matrix,
    /// Orientation as a unit quaternion.
    Quaternion,
    /// Orientation as a rotor of G(3), angular quantities as bivectors.
    #[default]
    Rotor,
    /// Position and orientation as one conformal motor of eight numbers.
    Motor,
}

impl Formulation {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Matrix, Self::Quaternion, Self::Rotor, Self::Motor];

    /// As it is written in a scene.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.form().name()
    }

    /// The same for bodies in motion.
    #[must_use]
    pub fn form(self) -> rigid::Form {
        match self {
            Self::Matrix => rigid::Form::Matrix,
            Self::Quaternion => rigid::Form::Quaternion,
            Self::Rotor => rigid::Form::Rotor,
            Self::Motor => rigid::Form::Motor,
        }
    }
}

/// What happens where bodies touch.
#[derive(Clone, Debug, Deserialize, serde::Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Contact {
    /// The ratio of separation to approach speed in an impact, dimensionless: 1 is elastic, 0 lets
    /// bodies not rebound.
    #[serde(default = "one")]
    #[schemars(with = "f64", range(min = 0, max = 1))]
    pub restitution: Spanned<f64>,
}

impl Default for Contact {
    fn default() -> Self {
        Self { restitution: one() }
    }
}

impl Scene {
    /// The place of the body `name` in [`Scene::body`].
    #[must_use]
    pub fn body_idx(&self, name: &str) -> Option<usize> {
        self.body.iter().position(|body| body.name.get_ref() == name)
    }

    /// How the motion of a body is written: as it says, else as the scene does.
    #[must_use]
    pub fn formulation_of(&self, body: &Body) -> Formulation {
        *body.formulation.as_ref().unwrap_or(&self.formulation).get_ref()
    }
}

fn zeros() -> Spanned<Numbers<3>> {
    Spanned::new(0..0, Numbers([0.0; 3]))
}

fn one() -> Spanned<f64> {
    Spanned::new(0..0, 1.0)
}

fn zero() -> Spanned<f64> {
    Spanned::new(0..0, 0.0)
}

fn rotor() -> Spanned<Formulation> {
    Spanned::new(0..0, Formulation::Rotor)
}

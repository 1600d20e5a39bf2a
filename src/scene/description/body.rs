//! Rigid bodies and their orientations.

use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use super::{Formulation, Shape, one, zeros};
use crate::scene::values::{Inertia, Numbers};

/// A rigid body. Its frame has the shape's axes and its origin in the centre of mass.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// The name that forces, joints and outputs refer to. Unique in the scene.
    #[schemars(with = "String", length(min = 1))]
    pub name: Spanned<String>,
    /// The mass, in kg. Required unless the body is fixed.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub mass_kg: Option<Spanned<f64>>,
    /// The inertia about the centre of mass in the body frame, in kg m²: three principal moments,
    /// or a symmetric 3x3 with off-diagonals -∫xy dm. Without it the shape and the mass give it, at
    /// uniform density; with it a shape is optional.
    #[schemars(with = "Option<Inertia>")]
    pub inertia_kg_m2: Option<Spanned<Inertia>>,
    /// The centre of mass at the start [x, y, z], in m, world frame.
    #[serde(default = "zeros")]
    #[schemars(with = "Numbers<3>")]
    pub position_m: Spanned<Numbers<3>>,
    /// The velocity of the centre of mass at the start [x, y, z], in m/s, world frame.
    #[serde(default = "zeros")]
    #[schemars(with = "Numbers<3>")]
    pub velocity_m_s: Spanned<Numbers<3>>,
    /// The orientation at the start, from the body frame to the world frame. Default: aligned.
    pub orientation: Option<Orientation>,
    /// The angular velocity at the start in the world frame, in rad/s: the bivector components
    /// [e23, e31, e12], which read like the axial vector [x, y, z].
    #[schemars(with = "Option<Numbers<3>>")]
    pub omega_world_rad_s: Option<Spanned<Numbers<3>>>,
    /// The angular velocity at the start in the body frame, in rad/s: the bivector components
    /// [e23, e31, e12], which read like the axial vector [x, y, z].
    #[schemars(with = "Option<Numbers<3>>")]
    pub omega_body_rad_s: Option<Spanned<Numbers<3>>>,
    /// Factor on the lengths of the shape, dimensionless. A given inertia is not scaled.
    #[serde(default = "one")]
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub scale: Spanned<f64>,
    /// A fixed body never moves; it needs no mass and has no velocity.
    #[serde(default)]
    pub fixed: bool,
    /// How the motion of this body is written, where it is not as that of the others. Bodies that a joint or spring links
    /// have one formulation.
    #[schemars(with = "Option<Formulation>")]
    pub formulation: Option<Spanned<Formulation>>,
    /// The shape.
    pub shape: Option<Shape>,
}

/// An orientation: the rotation that takes the body frame to the world frame.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Orientation {
    /// A rotation about an axis, by the right-hand rule.
    AxisAngle(AxisAngle),
    /// The rotor [s, e23, e31, e12]; normalised on reading. The quaternion w, x, y, z is the rotor
    /// [w, -x, -y, -z].
    #[schemars(with = "Numbers<4>")]
    Rotor(Spanned<Numbers<4>>),
}

/// A rotation about an axis, by the right-hand rule.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AxisAngle {
    /// The axis [x, y, z], of any length but zero.
    #[schemars(with = "Numbers<3>")]
    pub axis: Spanned<Numbers<3>>,
    /// The angle, in rad.
    #[schemars(with = "f64")]
    pub angle_rad: Spanned<f64>,
}

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

use crate::scene::values::{Inertia, Numbers, Vertices};

/// A scene for `ga-physics run`: bodies, forces, gravity, and how long to simulate them.
/// SI units, right-handed axes.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// How long the run lasts, in s. Positive.
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub duration_s: Spanned<f64>,
    /// The time step, in s. Positive, at most `duration_s`.
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub dt_s: Spanned<f64>,
    /// How many frames per second of simulated time are recorded, in 1/s. Without it every step is.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub record_hz: Option<Spanned<f64>>,
    /// The acceleration of gravity [x, y, z], in m/s².
    #[serde(default = "zeros")]
    #[schemars(with = "Numbers<3>")]
    pub gravity_m_s2: Spanned<Numbers<3>>,
    /// How the motion of a rigid body is written.
    #[serde(default)]
    pub formulation: Formulation,
    /// How the motion is solved.
    #[serde(default)]
    pub solver: Solver,
    /// What happens where bodies touch.
    #[serde(default)]
    pub contact: Contact,
    /// The rigid bodies.
    #[serde(default)]
    pub body: Vec<Body>,
    /// The forces besides gravity.
    #[serde(default)]
    pub force: Vec<Force>,
}

/// How the motion of a rigid body is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Formulation {
    /// Orientation as a rotor of G(3), angular quantities as bivectors.
    #[default]
    Rotor,
}

/// How the motion is solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, serde::Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Solver {
    /// The number type of everything but world positions, which are always f64.
    #[serde(default)]
    pub scalar: Scalar,
}

/// A number type.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scalar {
    /// 64-bit floating point, about 16 digits.
    #[default]
    F64,
    /// 32-bit floating point, about 7 digits.
    F32,
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

/// A rigid body. Its frame has the shape's axes and its origin in the centre of mass.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// The name that forces and outputs refer to. Unique in the scene.
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

/// A shape. It is moved so that the centre of mass becomes the origin of the body frame.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// A box with edges along the axes.
    Box(BoxShape),
    /// A pyramid on a square base in the xy plane, sides along x and y, apex on +z.
    Pyramid(Pyramid),
    /// A tetrahedron.
    Tetrahedron(Tetrahedron),
    /// A convex body from a mesh file.
    Mesh(Mesh),
    /// A half-space that nothing enters; for fixed bodies only.
    Plane(Plane),
}

/// A box with edges along the axes.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxShape {
    /// The whole edge lengths along [x, y, z], in m.
    #[schemars(with = "Numbers<3>")]
    pub size_m: Spanned<Numbers<3>>,
}

/// A pyramid on a square base in the xy plane, sides along x and y, apex on +z.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pyramid {
    /// The side of the base, in m.
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub base_m: Spanned<f64>,
    /// The height of the apex over the base, in m.
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub height_m: Spanned<f64>,
}

/// A tetrahedron.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tetrahedron {
    /// The four vertices [x, y, z], in m, in any order and about any origin.
    #[schemars(with = "[Numbers<3>; 4]")]
    pub vertices_m: Spanned<Vertices>,
}

/// A convex body from a mesh file.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    /// The mesh file, relative to the directory of the scene file; lengths in m.
    #[schemars(with = "String", length(min = 1))]
    pub file: Spanned<String>,
}

/// A half-space that nothing enters; for fixed bodies only.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plane {
    /// The normal [x, y, z] in the body frame, of any length but zero. The plane goes through
    /// `position_m`; bodies stay on the side that the normal points to.
    #[schemars(with = "Numbers<3>")]
    pub normal: Spanned<Numbers<3>>,
}

/// A force on one body.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Force {
    /// A constant force that acts on a point of the body.
    AtPoint(AtPoint),
    /// A drag against the motion: force -k v, torque -k_angular Omega.
    LinearDrag(LinearDrag),
}

impl Force {
    /// The name of the body that the force acts on.
    #[must_use]
    pub fn body(&self) -> &Spanned<String> {
        match self {
            Self::AtPoint(at_point) => &at_point.body,
            Self::LinearDrag(drag) => &drag.body,
        }
    }
}

/// A constant force that acts on a point of the body.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AtPoint {
    /// The name of the body.
    #[schemars(with = "String")]
    pub body: Spanned<String>,
    /// The point [x, y, z], in m, in the body frame. Default: the centre of mass.
    #[serde(default = "zeros")]
    #[schemars(with = "Numbers<3>")]
    pub at_body_m: Spanned<Numbers<3>>,
    /// The force [x, y, z], in N, in the world frame.
    #[schemars(with = "Numbers<3>")]
    pub force_world_n: Spanned<Numbers<3>>,
    /// When the force sets in, in s.
    #[serde(default = "zero")]
    #[schemars(with = "f64")]
    pub start_s: Spanned<f64>,
    /// When the force ends, in s. Default: the end of the run.
    #[schemars(with = "Option<f64>")]
    pub end_s: Option<Spanned<f64>>,
}

/// A drag against the motion: force -k v, torque -k_angular Omega.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LinearDrag {
    /// The name of the body.
    #[schemars(with = "String")]
    pub body: Spanned<String>,
    /// The factor k on the velocity of the centre of mass, in kg/s.
    #[schemars(with = "f64", range(min = 0))]
    pub k_kg_s: Spanned<f64>,
    /// The factor on the angular velocity, in N m s.
    #[serde(default = "zero")]
    #[schemars(with = "f64", range(min = 0))]
    pub k_angular_n_m_s: Spanned<f64>,
}

impl Scene {
    /// The place of the body `name` in [`Scene::body`].
    #[must_use]
    pub fn body_idx(&self, name: &str) -> Option<usize> {
        self.body.iter().position(|body| body.name.get_ref() == name)
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

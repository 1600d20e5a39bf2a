//! Rigid bodies, their orientations and shapes.

use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use super::{one, zeros};
use crate::scene::values::{Inertia, Numbers, Vertices};

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

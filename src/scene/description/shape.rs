//! Shapes of bodies.

use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::scene::values::{Numbers, Vertices};

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
    /// A ball.
    Ball(Ball),
    /// A cylinder along z with half a ball on each end.
    Capsule(Capsule),
    /// A cylinder along z.
    Cylinder(Cylinder),
    /// A cone along z, its tip on +z.
    Cone(Cone),
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

/// A ball. It does not collide yet.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ball {
    /// The radius, in m.
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub radius_m: Spanned<f64>,
}

/// A cylinder along z with half a ball on each end. It does not collide yet.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Capsule {
    /// The radius, in m.
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub radius_m: Spanned<f64>,
    /// The length of the cylinder, without the balls, in m.
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub length_m: Spanned<f64>,
}

/// A cylinder along z. It does not collide yet.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// The radius, in m.
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub radius_m: Spanned<f64>,
    /// The length, in m.
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub length_m: Spanned<f64>,
}

/// A cone along z, its tip on +z. It does not collide yet.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cone {
    /// The radius of the base, in m.
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub radius_m: Spanned<f64>,
    /// The height of the tip over the base, in m.
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub height_m: Spanned<f64>,
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

impl Shape {
    /// Whether bodies of this shape collide.
    #[must_use]
    pub fn collides(&self) -> bool {
        !matches!(self, Self::Ball(_) | Self::Capsule(_) | Self::Cylinder(_) | Self::Cone(_))
    }
}

//! What joins bodies.

use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::scene::values::Numbers;

/// What joins a body to another, or to the world. Bodies that a joint links directly do not collide with one another.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Joint {
    /// A point that both have in common: they turn about it in any way.
    Ball(BallJoint),
    /// An axis that both have in common: they turn about it.
    Hinge(HingeJoint),
    /// Two points keep their distance, as if by a rod without mass.
    Distance(DistanceJoint),
}

/// A point that two bodies have in common, or a body and the world: they turn about it in any way.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BallJoint {
    /// The name of the first body.
    #[schemars(with = "String")]
    pub a: Spanned<String>,
    /// The name of the second body. Default: the world.
    #[schemars(with = "Option<String>")]
    pub b: Option<Spanned<String>>,
    /// Where the joint is at the start [x, y, z], in m, world frame.
    #[schemars(with = "Numbers<3>")]
    pub point_m: Spanned<Numbers<3>>,
}

/// An axis that two bodies have in common, or a body and the world: they turn about it.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HingeJoint {
    /// The name of the first body.
    #[schemars(with = "String")]
    pub a: Spanned<String>,
    /// The name of the second body. Default: the world.
    #[schemars(with = "Option<String>")]
    pub b: Option<Spanned<String>>,
    /// A point of the axis at the start [x, y, z], in m, world frame: there the bodies hold each other along the axis.
    #[schemars(with = "Numbers<3>")]
    pub point_m: Spanned<Numbers<3>>,
    /// The direction of the axis at the start [x, y, z], world frame, of any length but zero.
    #[schemars(with = "Numbers<3>")]
    pub axis: Spanned<Numbers<3>>,
}

/// Two points of bodies, or one of a body and one of the world, keep their distance.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DistanceJoint {
    /// The name of the first body.
    #[schemars(with = "String")]
    pub a: Spanned<String>,
    /// The name of the second body. Without it `to_m` says which point of the world it is joined to.
    #[schemars(with = "Option<String>")]
    pub b: Option<Spanned<String>>,
    /// The point of the first body [x, y, z], in m, in its frame. Default: its centre of mass.
    #[schemars(with = "Option<Numbers<3>>")]
    pub at_a_body_m: Option<Spanned<Numbers<3>>>,
    /// The point of the second body [x, y, z], in m, in its frame. Default: its centre of mass.
    #[schemars(with = "Option<Numbers<3>>")]
    pub at_b_body_m: Option<Spanned<Numbers<3>>>,
    /// The point of the world [x, y, z], in m, in the place of a second body.
    #[schemars(with = "Option<Numbers<3>>")]
    pub to_m: Option<Spanned<Numbers<3>>>,
    /// The distance, in m. Default: the one at the start, which it must be.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub length_m: Option<Spanned<f64>>,
}

impl Joint {
    /// The names of its bodies; without a second one it joins the first to the world.
    #[must_use]
    pub fn names(&self) -> (&Spanned<String>, Option<&Spanned<String>>) {
        match self {
            Self::Ball(BallJoint { a, b, .. })
            | Self::Hinge(HingeJoint { a, b, .. })
            | Self::Distance(DistanceJoint { a, b, .. }) => (a, b.as_ref()),
        }
    }
}

//! What holds particles.

use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::scene::values::Numbers;

/// What holds particles. Where it names one particle, the name of a chain or net stands for each of its particles.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Constraint {
    /// Two particles keep their distance.
    Distance(Distance),
    /// A particle keeps its distance to a point.
    DistanceToPoint(DistanceToPoint),
    /// A particle stays on a plane.
    OnPlane(OnPlane),
    /// A particle stays on a sphere.
    OnSphere(OnSphere),
    /// A particle stays on a line.
    OnLine(OnLine),
    /// A particle stays on a circle.
    OnCircle(OnCircle),
}

/// Two particles keep their distance.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Distance {
    /// The name of the first particle.
    #[schemars(with = "String")]
    pub a: Spanned<String>,
    /// The name of the second particle.
    #[schemars(with = "String")]
    pub b: Spanned<String>,
    /// The distance, in m. Default: the one at the start, which it must be.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub length_m: Option<Spanned<f64>>,
}

/// A particle keeps its distance to a point.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DistanceToPoint {
    /// The name of the particle.
    #[schemars(with = "String")]
    pub particle: Spanned<String>,
    /// The point [x, y, z], in m.
    #[schemars(with = "Numbers<3>")]
    pub point_m: Spanned<Numbers<3>>,
    /// The distance, in m. Default: the one at the start, which it must be.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub length_m: Option<Spanned<f64>>,
}

/// A particle stays on a plane.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OnPlane {
    /// The name of the particle.
    #[schemars(with = "String")]
    pub particle: Spanned<String>,
    /// A point of the plane [x, y, z], in m. Default: where the particle is at the start.
    #[schemars(with = "Option<Numbers<3>>")]
    pub point_m: Option<Spanned<Numbers<3>>>,
    /// The normal [x, y, z], of any length but zero.
    #[schemars(with = "Numbers<3>")]
    pub normal: Spanned<Numbers<3>>,
}

/// A particle stays on a sphere.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OnSphere {
    /// The name of the particle.
    #[schemars(with = "String")]
    pub particle: Spanned<String>,
    /// The centre [x, y, z], in m.
    #[schemars(with = "Numbers<3>")]
    pub centre_m: Spanned<Numbers<3>>,
    /// The radius, in m. Default: that of the start, which it must be.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub radius_m: Option<Spanned<f64>>,
}

/// A particle stays on a line.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OnLine {
    /// The name of the particle.
    #[schemars(with = "String")]
    pub particle: Spanned<String>,
    /// A point of the line [x, y, z], in m. Default: where the particle is at the start.
    #[schemars(with = "Option<Numbers<3>>")]
    pub point_m: Option<Spanned<Numbers<3>>>,
    /// The direction [x, y, z], of any length but zero.
    #[schemars(with = "Numbers<3>")]
    pub direction: Spanned<Numbers<3>>,
}

/// A particle stays on a circle.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OnCircle {
    /// The name of the particle.
    #[schemars(with = "String")]
    pub particle: Spanned<String>,
    /// The centre [x, y, z], in m.
    #[schemars(with = "Numbers<3>")]
    pub centre_m: Spanned<Numbers<3>>,
    /// The radius, in m. Default: that of the start, which it must be.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub radius_m: Option<Spanned<f64>>,
    /// The normal of the circle's plane [x, y, z], of any length but zero.
    #[schemars(with = "Numbers<3>")]
    pub normal: Spanned<Numbers<3>>,
}

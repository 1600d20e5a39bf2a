//! Forces on bodies and particles, besides gravity.

use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use super::{zero, zeros};
use crate::scene::values::Numbers;

/// A force.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Force {
    /// A constant force that acts on a point of a body.
    AtPoint(AtPoint),
    /// A drag against the motion of a body or of particles: force -k v, on a body torque -k_angular Omega.
    LinearDrag(LinearDrag),
    /// A drag against the motion of particles: force -k |v| v.
    QuadraticDrag(QuadraticDrag),
    /// An attraction between every two particles: C m1 m2 / r².
    InverseSquare(InverseSquare),
    /// An attraction of all particles to a point: D m / r².
    InverseSquareToPoint(InverseSquareToPoint),
    /// A spring with a damper between two particles, two bodies, or a body and a point of the world.
    Spring(Spring),
    /// A constant torque on a body.
    Torque(Torque),
}

/// A constant force that acts on a point of a body.
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

/// A drag against the motion of a body or of particles: force -k v, on a body torque -k_angular Omega. It acts on all
/// particles if it names neither.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LinearDrag {
    /// The name of the body.
    #[schemars(with = "Option<String>")]
    pub body: Option<Spanned<String>>,
    /// The name of the particle, or of a chain or net for all its particles.
    #[schemars(with = "Option<String>")]
    pub particle: Option<Spanned<String>>,
    /// The factor k on the velocity, of a body that of its centre of mass, in kg/s.
    #[schemars(with = "f64", range(min = 0))]
    pub k_kg_s: Spanned<f64>,
    /// The factor on the angular velocity of a body, in N m s.
    #[serde(default = "zero")]
    #[schemars(with = "f64", range(min = 0))]
    pub k_angular_n_m_s: Spanned<f64>,
}

/// A drag against the motion of particles: force -k |v| v. It acts on all particles if it names none.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct QuadraticDrag {
    /// The name of the particle, or of a chain or net for all its particles.
    #[schemars(with = "Option<String>")]
    pub particle: Option<Spanned<String>>,
    /// The factor k, in kg/m.
    #[schemars(with = "f64", range(min = 0))]
    pub k_kg_m: Spanned<f64>,
}

/// An attraction between every two particles: C m1 m2 r / (r² + s²)^(3/2), which is C m1 m2 / r² without softening.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InverseSquare {
    /// C, in m³/(kg s²); 6.6743e-11 is gravitation. Negative: a repulsion.
    #[schemars(with = "f64")]
    pub constant_m3_kg_s2: Spanned<f64>,
    /// The softening length s, in m: within it the force falls to zero.
    #[serde(default = "zero")]
    #[schemars(with = "f64", range(min = 0))]
    pub softening_m: Spanned<f64>,
}

/// An attraction of all particles to a point: D m r / (r² + s²)^(3/2), which is D m / r² without softening.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InverseSquareToPoint {
    /// The point [x, y, z], in m. Default: the origin.
    #[serde(default = "zeros")]
    #[schemars(with = "Numbers<3>")]
    pub point_m: Spanned<Numbers<3>>,
    /// D, in m³/s²; for gravitation the constant times the mass in the point. Negative: a repulsion.
    #[schemars(with = "f64")]
    pub constant_m3_s2: Spanned<f64>,
    /// The softening length s, in m: within it the force falls to zero.
    #[serde(default = "zero")]
    #[schemars(with = "f64", range(min = 0))]
    pub softening_m: Spanned<f64>,
}

/// A spring with a damper between two particles, two bodies, or a body and a point of the world: force
/// k (r - l) + c dr/dt along their line.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Spring {
    /// The name of the first particle or body.
    #[schemars(with = "String")]
    pub a: Spanned<String>,
    /// The name of the second particle or body. For a body, `to_m` can take its place.
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
    /// k, in N/m.
    #[schemars(with = "f64", range(min = 0))]
    pub stiffness_n_m: Spanned<f64>,
    /// c, in N s/m.
    #[serde(default = "zero")]
    #[schemars(with = "f64", range(min = 0))]
    pub damping_n_s_m: Spanned<f64>,
    /// l, in m. Default: the distance at the start.
    #[schemars(with = "Option<f64>", range(min = 0))]
    pub rest_length_m: Option<Spanned<f64>>,
}

/// A constant torque on a body.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Torque {
    /// The name of the body.
    #[schemars(with = "String")]
    pub body: Spanned<String>,
    /// The torque, in N m, in the world frame: the bivector components [e23, e31, e12], which read like the axial vector
    /// [x, y, z].
    #[schemars(with = "Numbers<3>")]
    pub torque_world_n_m: Spanned<Numbers<3>>,
    /// When the torque sets in, in s.
    #[serde(default = "zero")]
    #[schemars(with = "f64")]
    pub start_s: Spanned<f64>,
    /// When the torque ends, in s. Default: the end of the run.
    #[schemars(with = "Option<f64>")]
    pub end_s: Option<Spanned<f64>>,
}

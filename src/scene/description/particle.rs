//! Particles: one by one, in chains, in nets.

use core::fmt;
use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{Deserializer, Error, SeqAccess, Visitor};
use toml::Spanned;

use super::{zero, zeros};
use crate::scene::values::{Numbers, exactly};

/// A particle: a point mass.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Particle {
    /// The name that forces, constraints and outputs refer to. Unique in the scene.
    #[schemars(with = "String", length(min = 1))]
    pub name: Spanned<String>,
    /// The mass, in kg. Required unless the particle is fixed; a fixed one attracts by its mass, if it has one.
    #[schemars(with = "Option<f64>", extend("exclusiveMinimum" = 0))]
    pub mass_kg: Option<Spanned<f64>>,
    /// Where it is at the start [x, y, z], in m.
    #[serde(default = "zeros")]
    #[schemars(with = "Numbers<3>")]
    pub position_m: Spanned<Numbers<3>>,
    /// The velocity at the start [x, y, z], in m/s.
    #[serde(default = "zeros")]
    #[schemars(with = "Numbers<3>")]
    pub velocity_m_s: Spanned<Numbers<3>>,
    /// A fixed particle never moves.
    #[serde(default)]
    pub fixed: bool,
}

/// Particles in a row, each linked to the next by the distance at the start. They are called `name.0`, `name.1`, ..
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Chain {
    /// The name, which forces and constraints can use for all its particles. Unique in the scene.
    #[schemars(with = "String", length(min = 1))]
    pub name: Spanned<String>,
    /// How many particles. At least 2.
    #[schemars(with = "u32", range(min = 2))]
    pub particles: Spanned<u32>,
    /// The first particle at the start [x, y, z], in m.
    #[schemars(with = "Numbers<3>")]
    pub from_m: Spanned<Numbers<3>>,
    /// The last particle at the start [x, y, z], in m. The others are between, at equal distances.
    #[schemars(with = "Numbers<3>")]
    pub to_m: Spanned<Numbers<3>>,
    /// The mass of each particle, in kg.
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub mass_kg: Spanned<f64>,
    /// Which ends never move.
    #[serde(default)]
    #[schemars(with = "Vec<ChainEnd>")]
    pub fixed: Vec<Spanned<ChainEnd>>,
}

/// An end of a chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ChainEnd {
    /// The particle at `from_m`.
    First,
    /// The particle at `to_m`.
    Last,
}

/// Particles in columns and rows, each linked to its neighbours by the distance at the start. They are called
/// `name.c.r`, column and row from 0.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Net {
    /// The name, which forces and constraints can use for all its particles. Unique in the scene.
    #[schemars(with = "String", length(min = 1))]
    pub name: Spanned<String>,
    /// How many columns. At least 1.
    #[schemars(with = "u32", range(min = 1))]
    pub columns: Spanned<u32>,
    /// How many rows. At least 1.
    #[schemars(with = "u32", range(min = 1))]
    pub rows: Spanned<u32>,
    /// The particle in column 0 and row 0 at the start [x, y, z], in m.
    #[serde(default = "zeros")]
    #[schemars(with = "Numbers<3>")]
    pub corner_m: Spanned<Numbers<3>>,
    /// From a column to the next [x, y, z], in m, before folding; the links have this length.
    #[schemars(with = "Numbers<3>")]
    pub column_step_m: Spanned<Numbers<3>>,
    /// From a row to the next [x, y, z], in m, before folding; the links have this length.
    #[schemars(with = "Numbers<3>")]
    pub row_step_m: Spanned<Numbers<3>>,
    /// The mass of each particle, in kg.
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0))]
    pub mass_kg: Spanned<f64>,
    /// How far the columns are folded at the start, in rad: every second one stands out of the plane of the net, its
    /// links at this angle to the plane, so that the net is narrower than it is long. A row between two fixed particles
    /// can only move if it is folded.
    #[serde(default = "zero")]
    #[schemars(with = "f64")]
    pub fold_rad: Spanned<f64>,
    /// As `fold_rad`, for the rows.
    #[serde(default = "zero")]
    #[schemars(with = "f64")]
    pub row_fold_rad: Spanned<f64>,
    /// Which particles never move: names of parts of the net, or [column, row].
    #[serde(default)]
    #[schemars(with = "Vec<NetFixed>")]
    pub fixed: Vec<Spanned<NetFixed>>,
}

/// Fixed particles of a net: a part of it, or one by its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NetFixed {
    /// A part of the net.
    Part(NetPart),
    /// The particle at [column, row], from 0.
    Cell([u32; 2]),
}

/// A part of a net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NetPart {
    /// All four.
    Corners,
    /// Row 0.
    FirstRow,
    /// The last row.
    LastRow,
    /// Column 0.
    FirstColumn,
    /// The last column.
    LastColumn,
}

impl NetPart {
    const NAMES: [&str; 5] = ["corners", "first_row", "last_row", "first_column", "last_column"];
    const ALL: [Self; 5] = [Self::Corners, Self::FirstRow, Self::LastRow, Self::FirstColumn, Self::LastColumn];
}

/// Own reading rather than serde's for a choice of either form, which would say only that neither matched.
struct NetFixedVisitor;

impl<'de> Visitor<'de> for NetFixedVisitor {
    type Value = NetFixed;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a part or [column, row]")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<NetFixed, E> {
        let known = NetPart::NAMES.iter().position(|known| *known == name);
        let part = known.and_then(|index| NetPart::ALL.get(index));
        part.map(|part| NetFixed::Part(*part)).ok_or_else(|| E::unknown_variant(name, &NetPart::NAMES))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<NetFixed, A::Error> {
        exactly(seq, "numbers").map(NetFixed::Cell)
    }
}

impl<'de> Deserialize<'de> for NetFixed {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NetFixedVisitor)
    }
}

impl JsonSchema for NetFixed {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "NetFixed".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let names = NetPart::NAMES.map(|name| json_schema!({ "type": "string", "const": name }));
        json_schema!({ "anyOf": [
            { "oneOf": names },
            { "type": "array", "items": { "type": "number", "minimum": 0 }, "minItems": 2, "maxItems": 2 },
        ] })
    }
}

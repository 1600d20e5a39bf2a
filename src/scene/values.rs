//! Lists of numbers as scene files hold them: fixed-length lists and the two forms of an inertia.
//!
//! Own readers rather than serde's for `[f64; N]`, because that one ignores whatever follows the
//! N-th element (so that a 3-vector written with four numbers would pass), and because the messages
//! are for people who do not know serde. Whole numbers are accepted where f64 is meant.

use core::fmt;
use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserializer, Error, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};

/// A list of exactly `N` numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(into = "Vec<f64>")]
pub struct Numbers<const N: usize>(pub [f64; N]);

impl<const N: usize> From<Numbers<N>> for Vec<f64> {
    fn from(numbers: Numbers<N>) -> Self {
        numbers.0.to_vec()
    }
}

impl<const N: usize> From<Numbers<N>> for [f64; N] {
    fn from(numbers: Numbers<N>) -> Self {
        numbers.0
    }
}

/// The four vertices of a tetrahedron, in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertices(pub [[f64; 3]; 4]);

/// The inertia of a body about its centre of mass in its own frame, in kg m².
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inertia {
    /// The principal moments: the body's axes are the principal axes.
    Principal([f64; 3]),
    /// The rows of the inertia matrix, off-diagonals -∫xy dm.
    Matrix([[f64; 3]; 3]),
}

impl Inertia {
    /// The rows of the matrix as written, a diagonal one for principal moments. An asymmetry
    /// within rounding is left in.
    #[must_use]
    pub fn rows(&self) -> [[f64; 3]; 3] {
        match *self {
            Self::Principal([a, b, c]) => [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]],
            Self::Matrix(rows) => rows,
        }
    }
}

struct NumbersVisitor<const N: usize>;

impl<'de, const N: usize> Visitor<'de> for NumbersVisitor<N> {
    type Value = Numbers<N>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a list of {N} numbers")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
        exactly(seq, "numbers").map(Numbers)
    }
}

impl<'de, const N: usize> Deserialize<'de> for Numbers<N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(NumbersVisitor)
    }
}

struct VerticesVisitor;

impl<'de> Visitor<'de> for VerticesVisitor {
    type Value = Vertices;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of 4 vertices, each a list of 3 numbers")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
        let vertices: [Numbers<3>; 4] = exactly(seq, "vertices")?;
        Ok(Vertices(vertices.map(|vertex| vertex.0)))
    }
}

impl<'de> Deserialize<'de> for Vertices {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(VerticesVisitor)
    }
}

/// Reads a whole sequence and insists on its length.
pub(crate) fn exactly<'de, A: SeqAccess<'de>, T: Deserialize<'de>, const N: usize>(
    mut seq: A,
    what: &str,
) -> Result<[T; N], A::Error> {
    let mut items = Vec::with_capacity(N);
    while let Some(item) = seq.next_element()? {
        items.push(item);
    }
    <[T; N]>::try_from(items).map_err(|items| A::Error::custom(format!("expected {N} {what}, found {}", items.len())))
}

/// One element of an inertia: a principal moment or a row of the matrix.
enum Element {
    Moment(f64),
    Row([f64; 3]),
}

struct ElementVisitor;

impl<'de> Visitor<'de> for ElementVisitor {
    type Value = Element;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number or a list of 3 numbers")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Element, E> {
        Ok(Element::Moment(value))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Element, E> {
        Ok(Element::Moment(value as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Element, A::Error> {
        exactly(seq, "numbers").map(Element::Row)
    }
}

impl<'de> Deserialize<'de> for Element {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ElementVisitor)
    }
}

struct InertiaVisitor;

impl<'de> Visitor<'de> for InertiaVisitor {
    type Value = Inertia;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("three principal moments or three rows of 3 numbers")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Inertia, A::Error> {
        let mut moments = Vec::new();
        let mut rows = Vec::new();
        while let Some(element) = seq.next_element()? {
            match element {
                Element::Moment(moment) => moments.push(moment),
                Element::Row(row) => rows.push(row),
            }
        }
        match (&moments[..], &rows[..]) {
            (&[a, b, c], []) => Ok(Inertia::Principal([a, b, c])),
            ([], &[a, b, c]) => Ok(Inertia::Matrix([a, b, c])),
            _ => Err(A::Error::custom(format!(
                "expected three principal moments or three rows of 3 numbers, found {} number(s) \
                 and {} row(s)",
                moments.len(),
                rows.len()
            ))),
        }
    }
}

impl<'de> Deserialize<'de> for Inertia {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(InertiaVisitor)
    }
}

impl<const N: usize> JsonSchema for Numbers<N> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("Numbers{N}").into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "array", "items": { "type": "number" }, "minItems": N, "maxItems": N })
    }
}

impl JsonSchema for Inertia {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Inertia".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let triple = Numbers::<3>::json_schema(generator);
        json_schema!({
            "anyOf": [triple, { "type": "array", "items": triple, "minItems": 3, "maxItems": 3 }]
        })
    }
}

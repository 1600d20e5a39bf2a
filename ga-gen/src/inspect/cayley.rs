//! Tables of the products of basis blades.

use crate::blade::Blade;
use crate::product::{Kind, blade_product};
use crate::scalar::Rational;
use crate::signature::Signature;

/// The products of some blades, row by column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cayley {
    /// The operator.
    pub kind: Kind,
    /// The names of the left factors.
    pub rows: Vec<String>,
    /// The names of the right factors.
    pub columns: Vec<String>,
    /// For each row and column, the blades of the product with their coefficients.
    pub cells: Vec<Vec<Vec<(Rational, String)>>>,
}

impl Cayley {
    /// The products of the rows with the columns.
    #[must_use]
    pub fn new(signature: &Signature, kind: Kind, rows: &[Blade], columns: &[Blade]) -> Self {
        let name = |blade: &Blade| signature.name(*blade);
        let cell = |a: Blade, b: Blade| blade_product(signature, kind, a, b).map(|(c, x)| (x, name(&c))).collect();
        Self {
            kind,
            rows: rows.iter().map(name).collect(),
            columns: columns.iter().map(name).collect(),
            cells: rows.iter().map(|a| columns.iter().map(|b| cell(*a, *b)).collect()).collect(),
        }
    }

    /// The table with its head as cells; `name` and `cell` say how a blade and a product are written.
    pub(super) fn grid(
        &self,
        corner: &str,
        name: impl Fn(&str) -> String,
        cell: impl Fn(&[(Rational, String)]) -> String,
    ) -> Vec<Vec<String>> {
        let head = std::iter::once(corner.to_string()).chain(self.columns.iter().map(|column| name(column)));
        let row = |(row, cells): (&String, &Vec<Vec<_>>)| {
            std::iter::once(name(row)).chain(cells.iter().map(|terms| cell(terms))).collect()
        };
        std::iter::once(head.collect()).chain(self.rows.iter().zip(&self.cells).map(row)).collect()
    }
}

/// `-1+no_ninf`: a product as text; the scalar blade is 1.
pub(super) fn cell_text(terms: &[(Rational, String)]) -> String {
    let mut text = String::new();
    for (coefficient, blade) in terms {
        let magnitude = coefficient.abs();
        text += if coefficient.is_negative() { "-" } else { "+" };
        text += &match (blade.as_str(), magnitude == Rational::ONE) {
            ("s", _) => magnitude.to_string(),
            (blade, true) => blade.to_string(),
            (blade, false) => format!("{magnitude} {blade}"),
        };
    }
    if text.is_empty() { "0".into() } else { text.trim_start_matches('+').to_string() }
}

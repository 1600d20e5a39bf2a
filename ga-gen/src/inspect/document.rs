//! What inspection shows, before it is known in which format: headings, tables, programs and code in order.

use super::{Cayley, latex, markdown, text};
use crate::program::Program;
use crate::spec::Spec;
use std::ops::Range;

/// A format that documents are printed in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Format {
    /// Aligned columns, for terminals.
    #[default]
    Text,
    /// With the tables and code fences of GitHub's dialect.
    Markdown,
    /// A whole document for LaTeX, which needs amsmath and longtable.
    Latex,
}

impl Format {
    /// A format by its name on the command line.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "text" => Some(Self::Text),
            "markdown" => Some(Self::Markdown),
            "latex" => Some(Self::Latex),
            _ => None,
        }
    }
}

/// Blocks in order.
#[derive(Clone)]
pub struct Document<'a> {
    /// The blocks.
    pub blocks: Vec<Block<'a>>,
}

/// A part of a document.
#[derive(Clone)]
pub enum Block<'a> {
    /// The name of what is shown.
    Title(String),
    /// A heading.
    Section(String),
    /// A smaller heading.
    Step(String),
    /// A sentence.
    Note(String),
    /// Names with their values.
    Facts(Vec<(&'static str, String)>),
    /// A table of words and numbers.
    Table(Table),
    /// Products of basis blades.
    Cayley(Cayley),
    /// Scalar code, as a formula.
    Program(&'a Spec, Program),
    /// Formatted Rust.
    Rust(String),
}

/// A table of words and numbers.
#[derive(Clone, Debug)]
pub struct Table {
    /// The headings of the columns.
    pub head: Vec<String>,
    /// The columns that hold numbers.
    pub numbers: Range<usize>,
    /// The rows, each as long as the head.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with some columns of numbers.
    #[must_use]
    pub fn new<const N: usize>(head: [&str; N], numbers: Range<usize>, rows: Vec<Vec<String>>) -> Self {
        Self { head: head.map(String::from).to_vec(), numbers, rows }
    }
}

impl Document<'_> {
    /// The document in a format.
    #[must_use]
    pub fn print(&self, format: Format) -> String {
        match format {
            Format::Text => text::print(self),
            Format::Markdown => markdown::print(self),
            Format::Latex => latex::print(self),
        }
    }
}

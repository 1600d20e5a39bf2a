//! A document in aligned columns.

use super::cayley::cell_text;
use super::{Block, Document, Table};
use crate::item::symbol;
use crate::print::program_text;

/// The document as plain text.
pub(super) fn print(document: &Document<'_>) -> String {
    let mut text = String::new();
    for block in &document.blocks {
        let block = match block {
            Block::Title(line) | Block::Section(line) => line.clone() + "\n",
            Block::Step(line) => format!("  {line}\n"),
            Block::Note(line) => format!("    {line}\n"),
            Block::Facts(facts) => facts.iter().map(|(name, value)| format!("{name:<10}  {value}\n")).collect(),
            Block::Table(table) => grid(&[vec![table.head.clone()], table.rows.clone()].concat(), Some(table)),
            Block::Cayley(cayley) => grid(&cayley.grid(symbol(cayley.kind), str::to_string, cell_text), None),
            Block::Program(spec, program) => indented(&program_text(spec, program)),
            Block::Rust(code) => indented(code),
        };
        if !text.is_empty() {
            text.push('\n');
        }
        text += &block;
    }
    text
}

fn indented(text: &str) -> String {
    text.lines().map(|line| if line.is_empty() { "\n".into() } else { format!("    {line}\n") }).collect()
}

/// Cells in columns; without a table, all are aligned as numbers are.
fn grid(rows: &[Vec<String>], table: Option<&Table>) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max();
    let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or(0)).collect();
    let number = |column: usize| table.is_none_or(|table| table.numbers.contains(&column));
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (column, cell) in row.iter().enumerate() {
            let width = widths[column];
            line += &if number(column) { format!("  {cell:>width$}") } else { format!("  {cell:<width$}") };
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}

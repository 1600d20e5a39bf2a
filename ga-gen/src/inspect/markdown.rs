//! A document in Markdown, with the tables of GitHub's dialect.
//!
//! Names stand in code spans, so that `*` and `_` are themselves; a `|` has to be escaped in a table even there.

use super::cayley::cell_text;
use super::{Block, Document};
use crate::item::symbol;
use crate::print::program_text;

/// The document as Markdown.
pub(super) fn print(document: &Document<'_>) -> String {
    let mut text = String::new();
    for block in &document.blocks {
        let block = match block {
            Block::Title(name) => format!("# {}\n", code(name)),
            Block::Section(line) => format!("## {}\n", line.replace('*', "\\*")),
            Block::Step(line) => format!("### {line}\n"),
            Block::Note(line) => format!("{line}\n"),
            Block::Facts(facts) => facts.iter().map(|(name, value)| format!("- {name}: {}\n", code(value))).collect(),
            Block::Table(table) => {
                let number = |column: usize| table.numbers.contains(&column);
                let written = |(column, cell): (usize, &String)| match number(column) || cell.is_empty() {
                    true => cell.clone(),
                    false => code(cell),
                };
                let rows = table.rows.iter().map(|row| row.iter().enumerate().map(written).collect());
                grid(&[vec![table.head.clone()], rows.collect()].concat(), number)
            }
            Block::Cayley(cayley) => {
                grid(&cayley.grid(&code(symbol(cayley.kind)), code, |terms| code(&cell_text(terms))), |column| {
                    column > 0
                })
            }
            Block::Program(spec, program) => format!("```text\n{}```\n", program_text(spec, program)),
            Block::Rust(code) => format!("```rust\n{code}```\n"),
        };
        if !text.is_empty() {
            text.push('\n');
        }
        text += &block;
    }
    text
}

fn code(text: &str) -> String {
    format!("`{text}`")
}

/// A table: the first row is the head.
fn grid(rows: &[Vec<String>], number: impl Fn(usize) -> bool) -> String {
    let line = |cells: &Vec<String>| {
        let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let columns = rows.first().map_or(0, Vec::len);
    let rule: Vec<String> = (0..columns).map(|c| if number(c) { "--:".into() } else { "---".into() }).collect();
    let mut lines: Vec<String> = rows.iter().map(line).collect();
    lines.insert(1.min(lines.len()), format!("| {} |\n", rule.join(" | ")));
    lines.concat()
}

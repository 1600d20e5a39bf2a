//! A document in LaTeX: formulas as `align*`, tables of products as `array`.

mod equations;

use super::{Block, Cayley, Document, Table};
use crate::product::Kind;
use equations::{blade, cell, equations};

const HEAD: &str = "\
\\documentclass{article}
\\usepackage{amsmath}
\\usepackage{longtable}
\\allowdisplaybreaks
\\begin{document}
";

/// The document as LaTeX.
pub(super) fn print(document: &Document<'_>) -> String {
    let blocks = document.blocks.iter().map(|block| match block {
        Block::Title(name) => format!("\\section*{{{}}}\n", escaped(name)),
        Block::Section(line) => format!("\\subsection*{{{}}}\n", escaped(line)),
        Block::Step(line) => format!("\\subsubsection*{{{}}}\n", escaped(line)),
        Block::Note(line) => format!("{}\n", escaped(line)),
        Block::Facts(facts) => {
            let item = |(name, value): &(&str, String)| format!("\\item[{name}] {}\n", escaped(value));
            format!("\\begin{{description}}\n{}\\end{{description}}\n", facts.iter().map(item).collect::<String>())
        }
        Block::Table(table) => words(table),
        Block::Cayley(cayley) => products(cayley),
        Block::Program(spec, program) => equations(spec, program),
        Block::Rust(code) => format!("\\begin{{verbatim}}\n{code}\\end{{verbatim}}\n"),
    });
    let blocks: Vec<String> = blocks.collect();
    format!("{HEAD}\n{}\n\\end{{document}}\n", blocks.join("\n"))
}

/// A table that may be longer than a page.
fn words(table: &Table) -> String {
    let align = |column| if table.numbers.contains(&column) { 'r' } else { 'l' };
    let columns: String = (0..table.head.len()).map(align).collect();
    let line = |cells: &Vec<String>| row(&cells.iter().map(|cell| escaped(cell)).collect::<Vec<_>>());
    let rows: String = table.rows.iter().map(line).collect();
    format!("\\begin{{longtable}}{{{columns}}}\n{}\\hline\n\\endhead\n{rows}\\end{{longtable}}\n", line(&table.head))
}

fn products(cayley: &Cayley) -> String {
    let product = match cayley.kind {
        Kind::Geometric => "",
        Kind::Outer => "\\wedge",
        Kind::Contraction => "\\rfloor",
    };
    let grid = cayley.grid(product, blade, cell);
    let columns = "r".repeat(cayley.columns.len());
    let head = grid.first().map(|cells| row(cells)).unwrap_or_default();
    let rows: String = grid.iter().skip(1).map(|cells| row(cells)).collect();
    format!("\\[\n\\begin{{array}}{{r|{columns}}}\n{head}\\hline\n{rows}\\end{{array}}\n\\]\n")
}

fn row(cells: &[String]) -> String {
    cells.join(" & ") + " \\\\\n"
}

/// Words outside of formulas.
fn escaped(text: &str) -> String {
    let mut result = String::new();
    for letter in text.chars() {
        match letter {
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => result.extend(['\\', letter]),
            '\\' => result += "\\textbackslash{}",
            '~' => result += "\\textasciitilde{}",
            '^' => result += "\\textasciicircum{}",
            '<' => result += "\\textless{}",
            '>' => result += "\\textgreater{}",
            '|' => result += "\\textbar{}",
            // Two in a row would be a dash.
            '-' => result += "-{}",
            other => result.push(other),
        }
    }
    result
}

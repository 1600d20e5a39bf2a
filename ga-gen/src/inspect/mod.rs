//! What is in a source file: of an algebra its products, types and items, and the formulas with their cost; of one of
//! them its formula, the program before and after each pass, what the other ways to compute it would have cost, and the
//! code. All of it is put together as one [`Document`], which is printed as text, Markdown or LaTeX.

mod cayley;
mod document;
mod latex;
mod load;
mod markdown;
mod report;
mod text;
mod ways;

pub use cayley::Cayley;
pub use document::{Block, Document, Format, Table};
pub use load::{InspectError, load};

use crate::formula::Compiled;
use crate::item::{self, Item, Operation};
use crate::print::{formula_output, output_name};
use crate::program::{Counts, Program};
use crate::spec::Spec;
use report::Subject;
use std::path::Path;

/// This many items are looked at for names close to a wrong one.
const MOST_NAMES: usize = 6;

/// A name less like the wrong one than this is no help: by trial, what remains differs by a few letters or an operand.
const LEAST_LIKENESS: f64 = 0.8;

/// What a source file holds.
pub struct Inspected {
    /// The last algebra of the file.
    pub algebra: Option<Spec>,
    /// Its formulas, each with its algebra.
    pub formulas: Vec<(Spec, Compiled)>,
}

/// All items of an algebra that code is generated for, compiled.
///
/// # Errors
/// A unit type that cannot be sampled.
pub fn items(spec: &Spec) -> syn::Result<Vec<Item>> {
    let compiled = item::operations(spec).into_iter().map(|operation| compiled(spec, operation));
    compiled.filter_map(Result::transpose).collect()
}

/// An operation on constants alone has no scalar to be generic over, and no code.
fn compiled(spec: &Spec, operation: Operation) -> syn::Result<Option<Item>> {
    let stores = |(_, ty): &(String, usize)| !spec.types[*ty].fields.is_empty();
    Ok(item::compile(spec, operation)?.filter(|item| item.parameters.iter().any(stores)))
}

/// The overview: products of basis vectors, types, items with their cost; formulas with theirs. `blades` asks for the
/// products of all basis blades.
///
/// # Errors
/// A unit type that cannot be sampled.
pub fn overview(inspected: &Inspected, blades: bool) -> syn::Result<Document<'_>> {
    let mut blocks = Vec::new();
    if let Some(spec) = &inspected.algebra {
        blocks.extend(algebra_overview(spec, blades)?);
    }
    if !inspected.formulas.is_empty() {
        let row = |(spec, compiled): &(Spec, Compiled)| {
            let name = compiled.formula.source.header.name.to_string();
            cost_row(name, formula_output(spec, compiled), &compiled.program)
        };
        blocks.push(Block::Section("formulas".into()));
        blocks.push(Block::Table(cost_table("formula", inspected.formulas.iter().map(row).collect())));
    }
    Ok(Document { blocks })
}

fn algebra_overview(spec: &Spec, blades: bool) -> syn::Result<Vec<Block<'_>>> {
    let (what, shown) = match blades {
        true => ("basis blades", spec.signature.blades()),
        false => {
            ("basis vectors", (0..spec.signature.dimension()).map(crate::blade::Blade::vector).collect::<Vec<_>>())
        }
    };
    let types = spec.types.iter().map(|ty| {
        let origin = if ty.shared { "base algebra" } else { "" };
        vec![ty.name.to_string(), ty.fields.len().to_string(), ty.fields.join(", "), origin.into()]
    });
    let items = items(spec)?.into_iter();
    let items = items.map(|item| cost_row(item.name, output_name(spec, item.output), &item.program));
    Ok(vec![
        Block::Title(format!("algebra {}", spec.name)),
        Block::Section(format!("products of {what}, row * column")),
        Block::Cayley(Cayley::new(&spec.signature, crate::product::Kind::Geometric, &shown, &shown)),
        Block::Section("types".into()),
        Block::Table(Table::new(["type", "numbers", "fields", "declared in"], 1..2, types.collect())),
        Block::Section("items".into()),
        Block::Table(cost_table("item", items.collect())),
    ])
}

fn cost_table(what: &str, rows: Vec<Vec<String>>) -> Table {
    Table::new([what, "result", "mul", "add", "neg", "div", "sqrt"], 2..7, rows)
}

fn cost_row(name: String, output: String, program: &Program) -> Vec<String> {
    let Counts { mul, add, neg, div, sqrt } = program.counts();
    let counts = [mul, add, neg, div, sqrt].map(|count| count.to_string());
    [vec![name, output], counts.to_vec()].concat()
}

/// One item or formula. `blades` asks for the products of all blades of its operands, however many.
///
/// # Errors
/// No such item, or a unit type that cannot be sampled.
pub fn item<'a>(inspected: &'a Inspected, name: &str, file: &Path, blades: bool) -> Result<Document<'a>, InspectError> {
    let wanted = name.replace(' ', "");
    let fault = |error| InspectError::Syntax(file.into(), error);
    let named = |compiled: &Compiled| compiled.formula.source.header.name.to_string();
    if let Some((spec, compiled)) = inspected.formulas.iter().find(|(_, compiled)| named(compiled) == wanted) {
        return report::report(spec, &Subject::Formula(compiled), blades).map_err(fault);
    }
    let mut known: Vec<String> = inspected.formulas.iter().map(|(_, compiled)| named(compiled)).collect();
    if let Some(spec) = &inspected.algebra {
        let mut operations: Vec<_> = item::operations(spec).into_iter().map(|o| (item::name(spec, o), o)).collect();
        operations.sort_by(|(a, _), (b, _)| likeness(b, &wanted).total_cmp(&likeness(a, &wanted)));
        // The closest first: it is the wanted one if there is any. Of some operations there is no item.
        for (name, operation) in operations.into_iter().take(MOST_NAMES) {
            let Some(item) = compiled(spec, operation).map_err(fault)? else { continue };
            if name == wanted {
                return report::report(spec, &Subject::Item(&item), blades).map_err(fault);
            }
            known.push(name);
        }
    }
    known.retain(|known| likeness(known, &wanted) > LEAST_LIKENESS);
    Err(InspectError::NoItem(name.into(), known))
}

fn likeness(a: &str, b: &str) -> f64 {
    strsim::jaro_winkler(&a.to_lowercase(), &b.to_lowercase())
}

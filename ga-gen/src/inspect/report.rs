//! One item or formula in full.

use super::{Block, Cayley, Document, ways};
use crate::blade::Blade;
use crate::emit;
use crate::formula::Compiled;
use crate::infer::Output;
use crate::item::{Item, Operation};
use crate::ledger;
use crate::print::{counts_text, formula_layout, formula_output, layout_text, output_name};
use crate::product::Kind;
use crate::program::Program;
use crate::spec::Spec;

/// What is reported on.
pub(super) enum Subject<'a> {
    /// An item of an algebra.
    Item(&'a Item),
    /// A formula.
    Formula(&'a Compiled),
}

/// A table of products with more rows or columns is shown on demand only: it would not fit a page.
const WIDEST_TABLE: usize = 16;

impl Subject<'_> {
    fn name(&self) -> String {
        match self {
            Self::Item(item) => item.name.clone(),
            Self::Formula(compiled) => compiled.formula.source.header.name.to_string(),
        }
    }

    fn program(&self) -> &Program {
        match self {
            Self::Item(item) => &item.program,
            Self::Formula(compiled) => &compiled.program,
        }
    }

    /// Operands and result.
    fn layout(&self, spec: &Spec) -> [String; 2] {
        match self {
            Self::Item(item) => [layout_text(spec, item), output_name(spec, item.output)],
            Self::Formula(compiled) => [formula_layout(spec, compiled), formula_output(spec, compiled)],
        }
    }

    fn bytes(&self, spec: &Spec) -> usize {
        match self {
            Self::Item(item) => ledger::item_bytes(spec, item),
            Self::Formula(compiled) => ledger::formula_bytes(spec, compiled),
        }
    }

    /// The product that the operands are multiplied by, and the blades of both: of an operation on two types theirs, else
    /// those of all operands.
    fn factors(&self, spec: &Spec) -> (Kind, Vec<Blade>, Vec<Blade>) {
        let blades = |types: &[usize]| -> Vec<Blade> {
            let present = |blade: &Blade| types.iter().any(|ty| spec.types[*ty].coefficients.contains_key(blade));
            spec.signature.blades().into_iter().filter(present).collect()
        };
        let all: Vec<usize> = match self {
            Self::Item(item) => match item.operation {
                Operation::Product(kind, a, b) => return (kind, blades(&[a]), blades(&[b])),
                Operation::Meet(a, b) | Operation::Apply(a, b) => {
                    return (Kind::Geometric, blades(&[a]), blades(&[b]));
                }
                _ => item.parameters.iter().map(|(_, ty)| *ty).collect(),
            },
            Self::Formula(compiled) => {
                let types = compiled.formula.parameters.iter();
                types.filter_map(|ty| if let Output::Type(index) = ty { Some(*index) } else { None }).collect()
            }
        };
        (Kind::Geometric, blades(&all), blades(&all))
    }

    fn rust(&self, spec: &Spec) -> syn::Result<String> {
        let tokens = match self {
            Self::Item(item) => emit::item(spec, item),
            Self::Formula(compiled) => emit::formula_function(spec, compiled),
        };
        Ok(prettyplease::unparse(&without_docs(syn::parse2(tokens)?)))
    }
}

/// Everything that is known of one item or formula.
pub(super) fn report<'a>(spec: &'a Spec, subject: &Subject<'_>, blades: bool) -> syn::Result<Document<'a>> {
    let program = subject.program();
    let counts = program.counts();
    let [operands, result] = subject.layout(spec);
    let operations =
        format!("{} ({} in all, division and square root apart)", counts_text(counts), counts.operations());
    let bytes = format!("{} of operands and result in f64", subject.bytes(spec));
    let mut document = vec![
        Block::Title(subject.name()),
        Block::Facts(vec![("operands", operands), ("result", result), ("operations", operations), ("bytes", bytes)]),
    ];
    document.extend(products(spec, subject, blades));
    document.extend([Block::Section("formula".into()), Block::Program(spec, program.clone())]);
    document.push(Block::Section("ways to compute it, each with the others as they are".into()));
    document.push(match ways::table(spec, subject) {
        Some(table) => Block::Table(table),
        None => Block::Note("There is one way.".into()),
    });
    document.extend(passes(spec, subject));
    document.extend([Block::Section("Rust".into()), Block::Rust(subject.rust(spec)?)]);
    Ok(Document { blocks: document })
}

fn products(spec: &Spec, subject: &Subject<'_>, wanted: bool) -> Vec<Block<'static>> {
    let (kind, rows, columns) = subject.factors(spec);
    let heading = Block::Section("products of basis blades, row by column".into());
    if rows.is_empty() || columns.is_empty() {
        return vec![];
    }
    if !wanted && rows.len().max(columns.len()) > WIDEST_TABLE {
        let size = format!("{} by {} blades: shown with --blades.", rows.len(), columns.len());
        return vec![heading, Block::Note(size)];
    }
    vec![heading, Block::Cayley(Cayley::new(&spec.signature, kind, &rows, &columns))]
}

/// The program before and after each pass.
fn passes<'a>(spec: &'a Spec, subject: &Subject<'_>) -> Vec<Block<'a>> {
    let mut blocks = vec![Block::Section("the program before and after each pass".into())];
    let mut before: Option<Program> = None;
    for (pass, program) in subject.stages(spec) {
        let Some(program) = program else {
            blocks.push(Block::Step(format!("{pass}: left out, for whole formulas only")));
            continue;
        };
        if before.as_ref() == Some(&program) {
            blocks.push(Block::Step(format!("{pass}: no change")));
            continue;
        }
        blocks.push(Block::Step(format!("{pass}: {}", counts_text(program.counts()))));
        blocks.push(Block::Program(spec, program.clone()));
        before = Some(program);
    }
    blocks
}

/// The formula stands above already.
fn without_docs(mut file: syn::File) -> syn::File {
    let strip = |attributes: &mut Vec<syn::Attribute>| attributes.retain(|attribute| !attribute.path().is_ident("doc"));
    for item in &mut file.items {
        match item {
            syn::Item::Fn(function) => strip(&mut function.attrs),
            syn::Item::Impl(block) => {
                for inner in &mut block.items {
                    if let syn::ImplItem::Fn(method) = inner {
                        strip(&mut method.attrs);
                    }
                }
            }
            _ => {}
        }
    }
    file
}

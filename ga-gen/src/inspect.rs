//! What is in a source file, as text: of an algebra its products, types and items, and the formulas; for one of them its
//! formula, program, cost and code.

use crate::emit;
use crate::formula::{self, Compiled};
use crate::header;
use crate::item::{self, Item};
use crate::parse::Source;
use crate::print::{counts_text, formula_layout, formula_output, layout_text, output_name, program_text};
use crate::program::{Counts, Program};
use crate::read;
use crate::scalar::Rational;
use crate::spec::Spec;
use quote::quote;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Why a file cannot be inspected.
#[derive(Debug)]
pub enum InspectError {
    /// The file cannot be read.
    Read(PathBuf, std::io::Error),
    /// The file, or an `algebra!` in it, is not understood: file, line, column and what is wrong.
    Syntax(PathBuf, syn::Error),
    /// Neither `algebra!` nor `#[formula]` in the file.
    Nothing(PathBuf),
    /// An algebra that is extended, or that a formula is over, was not found in these files.
    NoAlgebra(String, Vec<PathBuf>),
    /// An algebra extends itself, over others.
    Circle(String),
    /// No such item; the closest names.
    NoItem(String, Vec<String>),
}

impl std::fmt::Display for InspectError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Read(path, error) => write!(f, "cannot read {}: {error}", path.display()),
            Self::Syntax(path, error) => {
                let start = error.span().start();
                write!(f, "{}:{}:{}: {error}", path.display(), start.line, start.column + 1)
            }
            Self::Nothing(path) => write!(f, "{} holds neither `algebra!` nor `#[formula]`", path.display()),
            Self::NoAlgebra(name, files) => {
                let files: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
                write!(f, "the algebra `{name}` is in none of {}; name its file with --algebra FILE", files.join(", "))
            }
            Self::Circle(name) => write!(f, "the algebra `{name}` extends itself"),
            Self::NoItem(name, close) => {
                write!(f, "no item `{name}`")?;
                if !close.is_empty() {
                    write!(f, "; close to it: {}", close.join(", "))?;
                }
                write!(f, " (without ITEM, all are listed)")
            }
        }
    }
}

impl std::error::Error for InspectError {}

/// What a source file holds.
#[derive(Debug)]
pub struct Inspected {
    /// The last algebra of the file.
    pub algebra: Option<Spec>,
    /// Its formulas, each with its algebra.
    pub formulas: Vec<(Spec, Compiled)>,
}

/// Reads a source file. An algebra that another one extends, or that a formula is over, is found by the last name of its
/// path: in the same file, then in a sibling named for it, then in `algebra_file`.
///
/// # Errors
/// See [`InspectError`].
pub fn load(file: &Path, algebra_file: Option<&Path>) -> Result<Inspected, InspectError> {
    let Found { algebras, formulas } = found(file)?;
    let build = |source: &Source| spec_of(source, file, algebra_file, &[]);
    let algebra = algebras.last().map(build).transpose()?;
    let mut compiled = Vec::new();
    for source in &formulas {
        let spec = named(&last_name(&source.options.path), file, algebra_file, &[])?;
        let formula = read::read(&spec, source).and_then(|formula| formula::compile(&spec, &formula));
        compiled.push((spec, formula.map_err(|error| InspectError::Syntax(file.into(), error))?));
    }
    if algebra.is_none() && compiled.is_empty() {
        return Err(InspectError::Nothing(file.into()));
    }
    Ok(Inspected { algebra, formulas: compiled })
}

fn last_name(path: &syn::Path) -> String {
    path.segments.last().map(|segment| segment.ident.to_string()).unwrap_or_default()
}

/// The algebra of a name, seen from a file; `above` are those that extend it.
fn named(name: &str, file: &Path, given: Option<&Path>, above: &[String]) -> Result<Spec, InspectError> {
    let sibling = file.with_file_name(format!("{name}.rs"));
    let mut tried = Vec::new();
    for candidate in [Some(file), Some(sibling.as_path()), given].into_iter().flatten().filter(|path| path.exists()) {
        if let Some(source) = found(candidate)?.algebras.iter().find(|source| source.name == name) {
            return spec_of(source, candidate, given, above);
        }
        tried.push(candidate.to_path_buf());
    }
    Err(InspectError::NoAlgebra(name.into(), tried))
}

fn spec_of(source: &Source, file: &Path, given: Option<&Path>, above: &[String]) -> Result<Spec, InspectError> {
    let name = source.name.to_string();
    if above.contains(&name) {
        return Err(InspectError::Circle(name));
    }
    let above = [above, &[name]].concat();
    let base = source.extends.as_ref().map(|path| named(&last_name(path), file, given, &above)).transpose()?;
    Spec::new(source, base.as_ref()).map_err(|error| InspectError::Syntax(file.into(), error))
}

/// The invocations of a file, also within modules.
#[derive(Default)]
struct Found {
    algebras: Vec<Source>,
    formulas: Vec<header::Source>,
}

fn found(file: &Path) -> Result<Found, InspectError> {
    let text = std::fs::read_to_string(file).map_err(|error| InspectError::Read(file.into(), error))?;
    let fault = |error| InspectError::Syntax(file.into(), error);
    let mut found = Found::default();
    found.collect(&syn::parse_file(&text).map_err(fault)?.items).map_err(fault)?;
    Ok(found)
}

impl Found {
    fn collect(&mut self, items: &[syn::Item]) -> syn::Result<()> {
        let is = |path: &syn::Path, name: &str| path.segments.last().is_some_and(|segment| segment.ident == name);
        for item in items {
            match item {
                syn::Item::Macro(invocation) if is(&invocation.mac.path, "algebra") => {
                    self.algebras.push(invocation.mac.parse_body()?);
                }
                syn::Item::Fn(function) => {
                    let mut function = function.clone();
                    let mark = function.attrs.iter().position(|attribute| is(attribute.path(), "formula"));
                    if let Some(mark) = mark {
                        let options = function.attrs.remove(mark).meta.require_list()?.tokens.clone();
                        self.formulas.push(header::Source::new(options, quote!(#function))?);
                    }
                }
                syn::Item::Mod(module) => {
                    let inner = module.content.as_ref().map(|(_, items)| items.as_slice());
                    self.collect(inner.unwrap_or_default())?;
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// All items of an algebra, compiled.
///
/// # Errors
/// A formula that is wrong.
pub fn items(spec: &Spec) -> syn::Result<Vec<Item>> {
    let compiled = item::operations(spec).into_iter().map(|operation| item::compile(spec, operation));
    compiled.filter_map(Result::transpose).collect()
}

const HEADING: &str = "result, then multiplications, additions, sign changes, divisions, square roots";

/// The overview: products of basis vectors, types, items with their cost; formulas with theirs.
///
/// # Errors
/// A unit type that cannot be sampled.
pub fn overview(inspected: &Inspected) -> syn::Result<String> {
    let mut text = inspected.algebra.as_ref().map(algebra_overview).transpose()?.unwrap_or_default();
    if !inspected.formulas.is_empty() {
        let _ = writeln!(text, "{}formulas: {HEADING}\n", if text.is_empty() { "" } else { "\n" });
    }
    for (spec, compiled) in &inspected.formulas {
        let name = compiled.formula.source.header.name.to_string();
        text += &cost_line(&name, &formula_output(spec, compiled), &compiled.program);
    }
    Ok(text)
}

fn cost_line(name: &str, output: &str, program: &Program) -> String {
    let Counts { mul, add, neg, div, sqrt } = program.counts();
    format!("  {name:<28} {output:<13} {mul:>4} {add:>4} {neg:>3} {div:>2} {sqrt:>2}\n")
}

fn algebra_overview(spec: &Spec) -> syn::Result<String> {
    let mut text =
        format!("algebra {}\n\nproducts of basis vectors (row * column)\n\n{}\ntypes\n\n", spec.name, cayley(spec));
    for ty in &spec.types {
        let origin = if ty.shared { "  (of the base algebra)" } else { "" };
        let fields = ty.fields.join(", ");
        let _ = writeln!(text, "  {:<14} {:>2} numbers  {fields}{origin}", ty.name.to_string(), ty.fields.len());
    }
    let _ = writeln!(text, "\nitems: {HEADING}\n");
    for item in items(spec)? {
        text += &cost_line(&item.name, &output_name(spec, item.output), &item.program);
    }
    Ok(text)
}

fn cayley(spec: &Spec) -> String {
    let names = spec.signature.names();
    let vector = crate::blade::Blade::vector;
    let mut rows = vec![[vec![String::new()], names.to_vec()].concat()];
    for (i, name) in names.iter().enumerate() {
        let cells = (0..names.len()).map(|j| {
            let terms = spec.signature.geometric(vector(i), vector(j));
            let parts = terms.iter().map(|(blade, c)| {
                let name = if blade.grade() == 0 { "1".into() } else { spec.signature.name(*blade) };
                match *c == Rational::ONE {
                    true => format!("+{name}"),
                    false if *c == -Rational::ONE => format!("-{name}"),
                    false => format!("{c} {name}"),
                }
            });
            let text: String = parts.collect();
            if text.is_empty() { "0".to_string() } else { text.trim_start_matches('+').to_string() }
        });
        rows.push([vec![name.clone()], cells.collect()].concat());
    }
    let width = rows.iter().flatten().map(String::len).max().unwrap_or(0) + 2;
    rows.iter().map(|row| row.iter().map(|cell| format!("{cell:>width$}")).collect::<String>() + "\n").collect()
}

/// One item or formula: layout, program, counts and formatted Rust.
///
/// # Errors
/// No such item, or a unit type that cannot be sampled.
pub fn item_text(inspected: &Inspected, name: &str, file: &Path) -> Result<String, InspectError> {
    let wanted = name.replace(' ', "");
    let fault = |error| InspectError::Syntax(file.into(), error);
    let mut known = Vec::new();
    for (spec, compiled) in &inspected.formulas {
        let name = compiled.formula.source.header.name.to_string();
        if name == wanted {
            let (layout, output) = (formula_layout(spec, compiled), formula_output(spec, compiled));
            return text(spec, &wanted, [&layout, &output], &compiled.program, emit::formula_function(spec, compiled))
                .map_err(fault);
        }
        known.push(name);
    }
    if let Some(spec) = &inspected.algebra {
        for item in items(spec).map_err(fault)? {
            if item.name == wanted {
                let (layout, output) = (layout_text(spec, &item), output_name(spec, item.output));
                return text(spec, &wanted, [&layout, &output], &item.program, emit::item(spec, &item)).map_err(fault);
            }
            known.push(item.name);
        }
    }
    let stem = |text: &str| text.chars().take_while(|c| c.is_alphanumeric()).collect::<String>().to_lowercase();
    let close = known.iter().filter(|known| stem(known) == stem(&wanted)).cloned();
    Err(InspectError::NoItem(name.into(), close.take(12).collect()))
}

fn text(
    spec: &Spec,
    name: &str,
    [layout, output]: [&str; 2],
    program: &Program,
    tokens: proc_macro2::TokenStream,
) -> syn::Result<String> {
    let counts = program.counts();
    let code = syn::parse2::<syn::File>(tokens)?;
    Ok(format!(
        "{name}\n\noperands    {layout}\nresult      {output}\noperations  {} ({} in all, division and square root apart)\n\nformula\n\n{}\nRust\n\n{}",
        counts_text(counts),
        counts.operations(),
        indented(&program_text(spec, program)),
        indented(&prettyplease::unparse(&without_docs(code)))
    ))
}

fn indented(text: &str) -> String {
    text.lines().map(|line| if line.is_empty() { "\n".into() } else { format!("    {line}\n") }).collect()
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

//! What is in an algebra, as text: its products, types and items; for one item its formula, program, cost and code.

use crate::emit;
use crate::formula::{counts_text, layout_text, output_name, program_text};
use crate::item::{self, Item};
use crate::parse::Source;
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
    /// No `algebra!` in the file.
    NoAlgebra(PathBuf),
    /// The base algebra was not found in these files.
    NoBase(String, Vec<PathBuf>),
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
            Self::NoAlgebra(path) => write!(f, "{} holds no `algebra!` invocation", path.display()),
            Self::NoBase(name, files) => {
                let files: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
                write!(
                    f,
                    "the base algebra `{name}` is in none of {}; name its file with --algebra FILE",
                    files.join(", ")
                )
            }
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

/// Reads the algebra of a source file. A base algebra is looked for in the same file, then in a sibling named for it,
/// then in `base_file`.
///
/// # Errors
/// See [`InspectError`].
pub fn load(file: &Path, base_file: Option<&Path>) -> Result<Spec, InspectError> {
    let sources = algebras(file)?;
    let source = sources.last().ok_or_else(|| InspectError::NoAlgebra(file.into()))?;
    let fault = |error| InspectError::Syntax(file.into(), error);
    let Some(path) = &source.extends else {
        return Spec::new(source, None).map_err(fault);
    };
    let name = path.segments.last().map(|segment| segment.ident.to_string()).unwrap_or_default();
    let sibling = file.with_file_name(format!("{name}.rs"));
    let mut tried = Vec::new();
    for candidate in [Some(file), Some(sibling.as_path()), base_file].into_iter().flatten().filter(|path| path.exists())
    {
        if let Some(base) = algebras(candidate)?.iter().find(|source| source.name == name) {
            let base = Spec::new(base, None).map_err(|error| InspectError::Syntax(candidate.into(), error))?;
            return Spec::new(source, Some(&base)).map_err(fault);
        }
        tried.push(candidate.to_path_buf());
    }
    Err(InspectError::NoBase(name, tried))
}

/// The `algebra!` invocations of a file, also within modules.
fn algebras(file: &Path) -> Result<Vec<Source>, InspectError> {
    let text = std::fs::read_to_string(file).map_err(|error| InspectError::Read(file.into(), error))?;
    let fault = |error| InspectError::Syntax(file.into(), error);
    let mut found = Vec::new();
    collect(&syn::parse_file(&text).map_err(fault)?.items, &mut found).map_err(fault)?;
    Ok(found)
}

fn collect(items: &[syn::Item], found: &mut Vec<Source>) -> syn::Result<()> {
    for item in items {
        match item {
            syn::Item::Macro(invocation)
                if invocation.mac.path.segments.last().is_some_and(|s| s.ident == "algebra") =>
            {
                found.push(invocation.mac.parse_body()?);
            }
            syn::Item::Mod(module) => {
                let inner = module.content.as_ref().map(|(_, items)| items.as_slice());
                collect(inner.unwrap_or_default(), found)?;
            }
            _ => {}
        }
    }
    Ok(())
}

/// All items of an algebra, compiled.
///
/// # Errors
/// A kernel that is wrong.
pub fn items(spec: &Spec) -> syn::Result<Vec<Item>> {
    let compiled = item::operations(spec).into_iter().map(|operation| item::compile(spec, operation));
    compiled.filter_map(Result::transpose).collect()
}

/// The overview: products of basis vectors, types, items with their cost.
///
/// # Errors
/// A kernel that is wrong.
pub fn overview(spec: &Spec) -> syn::Result<String> {
    let mut text =
        format!("algebra {}\n\nproducts of basis vectors (row * column)\n\n{}\ntypes\n\n", spec.name, cayley(spec));
    for ty in &spec.types {
        let origin = if ty.shared { "  (of the base algebra)" } else { "" };
        let fields = ty.fields.join(", ");
        let _ = writeln!(text, "  {:<14} {:>2} numbers  {fields}{origin}", ty.name.to_string(), ty.fields.len());
    }
    text += "\nitems: result, then multiplications, additions, sign changes, divisions, square roots\n\n";
    for item in items(spec)? {
        let counts = item.program.counts();
        let _ = writeln!(
            text,
            "  {:<28} {:<13} {:>4} {:>4} {:>3} {:>2} {:>2}",
            item.name,
            output_name(spec, item.output),
            counts.mul,
            counts.add,
            counts.neg,
            counts.div,
            counts.sqrt
        );
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

/// One item: layout, program, counts and formatted Rust.
///
/// # Errors
/// No such item, or a kernel that is wrong.
pub fn item_text(spec: &Spec, name: &str, file: &Path) -> Result<String, InspectError> {
    let wanted = name.replace(' ', "");
    let fault = |error| InspectError::Syntax(file.into(), error);
    let all = items(spec).map_err(fault)?;
    let Some(item) = all.iter().find(|item| item.name == wanted) else {
        let stem = |text: &str| text.chars().take_while(|c| c.is_alphanumeric()).collect::<String>().to_lowercase();
        let close = all.iter().filter(|item| stem(&item.name) == stem(&wanted)).map(|item| item.name.clone());
        return Err(InspectError::NoItem(name.into(), close.take(12).collect()));
    };
    let counts = item.program.counts();
    let tokens = emit::item(spec, item);
    let code = syn::parse2::<syn::File>(quote!(#tokens)).map_err(fault)?;
    Ok(format!(
        "{}\n\noperands    {}\nresult      {}\noperations  {} ({} in all, division and square root apart)\n\nformula\n\n{}\nRust\n\n{}",
        item.name,
        layout_text(spec, item),
        output_name(spec, item.output),
        counts_text(counts),
        counts.operations(),
        indented(&program_text(&item.program)),
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

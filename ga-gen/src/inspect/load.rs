//! Reads the `algebra!` and `#[formula]` of a source file, and finds the algebras that they stand on in other files.

use super::Inspected;
use crate::formula;
use crate::header;
use crate::parse::Source;
use crate::read;
use crate::spec::Spec;
use quote::quote;
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
    /// A line of a list of ledgers is none.
    Source(PathBuf, usize),
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
            Self::Source(list, line) => {
                write!(f, "{}:{line}: a ledger is `name file`, or `name file algebra_file`", list.display())
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
        // `#[formula(self)]` stands beside its algebra.
        let spec = match (last_name(&source.options.path).as_str(), algebras.last()) {
            ("self", Some(beside)) => build(beside)?,
            (name, _) => named(name, file, algebra_file, &[])?,
        };
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

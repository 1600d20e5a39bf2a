//! The ledger: what every item and formula of a file costs, one line each, so that a change of the optimiser shows as a
//! change of lines.
//!
//! Counts are those of the emitted code (see [`crate::program::Counts`]); those of formulas leave out what they call.
//! Bytes are operands and result as f64. `ledger/sources.txt` lists the ledgers that are kept.

use crate::formula::Compiled;
use crate::infer::Output;
use crate::inspect::{InspectError, Inspected, items, load};
use crate::item::{Item, field_names};
use crate::program::Counts;
use crate::spec::Spec;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// The first line.
pub const HEADING: &str = "item\tmul\tadd\tneg\tdiv\tsqrt\tbytes";

/// What one item costs.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Row {
    /// Its name.
    pub item: String,
    /// Multiplications, additions, sign changes, divisions, square roots.
    pub counts: [usize; 5],
    /// Operands and result in f64.
    pub bytes: usize,
}

impl Row {
    fn new(item: String, counts: Counts, bytes: usize) -> Self {
        let Counts { mul, add, neg, div, sqrt } = counts;
        Self { item, counts: [mul, add, neg, div, sqrt], bytes }
    }

    /// Its line, without an end.
    #[must_use]
    pub fn line(&self) -> String {
        let [mul, add, neg, div, sqrt] = self.counts;
        format!("{}\t{mul}\t{add}\t{neg}\t{div}\t{sqrt}\t{}", self.item, self.bytes)
    }
}

/// The items of the last algebra of a file and its formulas, by name.
///
/// # Errors
/// A unit type that cannot be sampled.
pub fn rows(inspected: &Inspected) -> syn::Result<Vec<Row>> {
    let mut rows = Vec::new();
    if let Some(spec) = &inspected.algebra {
        let row = |item: Item| Row::new(item.name.clone(), item.program.counts(), item_bytes(spec, &item));
        rows.extend(items(spec)?.into_iter().map(row));
    }
    for (spec, compiled) in &inspected.formulas {
        let name = compiled.formula.source.header.name.to_string();
        rows.push(Row::new(name, compiled.program.counts(), formula_bytes(spec, compiled)));
    }
    rows.sort();
    Ok(rows)
}

/// The ledger as a table with tabs.
#[must_use]
pub fn text(rows: &[Row]) -> String {
    let mut text = format!("{HEADING}\n");
    for row in rows {
        let _ = writeln!(text, "{}", row.line());
    }
    text
}

/// What a kept ledger says otherwise than the rows, one sentence each.
#[must_use]
pub fn differences(kept: &str, rows: &[Row]) -> Vec<String> {
    let by_item = |line: &str| line.split_once('\t').map(|(item, rest)| (item.to_string(), rest.replace('\t', " ")));
    let old: BTreeMap<String, String> = kept.lines().skip(1).filter_map(by_item).collect();
    let new: BTreeMap<String, String> = rows.iter().filter_map(|row| by_item(&row.line())).collect();
    let items: BTreeSet<&String> = old.keys().chain(new.keys()).collect();
    let mut found = Vec::new();
    for item in items {
        match (old.get(item), new.get(item)) {
            (Some(old), Some(new)) if old != new => found.push(format!("{item}: {old} became {new}")),
            (Some(old), None) => found.push(format!("{item}: {old} is gone")),
            (None, Some(new)) => found.push(format!("{item}: {new} is new")),
            _ => {}
        }
    }
    // What is the same in other words: another order, another heading.
    if found.is_empty() && kept != text(rows) {
        found.push("the lines are not those that are written".into());
    }
    found
}

/// A ledger that is kept in the repository.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// Its name: it is `ledger/NAME.tsv`.
    pub name: String,
    /// The source file, from the root of the workspace.
    pub file: PathBuf,
    /// Where the algebra is that the file's formulas are over, or that its algebra extends.
    pub algebra: Option<PathBuf>,
}

impl Source {
    /// The ledgers that `ledger/sources.txt` lists, by the root of the workspace.
    ///
    /// # Errors
    /// The list cannot be read, or a line of it is none.
    pub fn listed(root: &Path) -> Result<Vec<Self>, InspectError> {
        let list = root.join("ga-gen/ledger/sources.txt");
        let text = std::fs::read_to_string(&list).map_err(|error| InspectError::Read(list.clone(), error))?;
        let mut sources = Vec::new();
        for (index, line) in text.lines().enumerate().filter(|(_, line)| !line.starts_with('#')) {
            let words: Vec<&str> = line.split_whitespace().collect();
            let (name, file, algebra) = match words[..] {
                [name, file] => (name.into(), file.into(), None),
                [name, file, algebra] => (name.into(), file.into(), Some(algebra.into())),
                _ => return Err(InspectError::Source(list, index + 1)),
            };
            sources.push(Self { name, file, algebra });
        }
        Ok(sources)
    }

    /// Where the ledger is kept.
    #[must_use]
    pub fn path(&self, root: &Path) -> PathBuf {
        root.join(format!("ga-gen/ledger/{}.tsv", self.name))
    }

    /// What the source costs now.
    ///
    /// # Errors
    /// The source cannot be inspected.
    pub fn rows(&self, root: &Path) -> Result<Vec<Row>, InspectError> {
        let file = root.join(&self.file);
        let inspected = load(&file, self.algebra.as_ref().map(|algebra| root.join(algebra)).as_deref())?;
        rows(&inspected).map_err(|error| InspectError::Syntax(file, error))
    }
}

/// Operands and result of an item.
#[must_use]
pub fn item_bytes(spec: &Spec, item: &Item) -> usize {
    let operands: usize = item.parameters.iter().map(|(_, ty)| bytes(spec, Output::Type(*ty))).sum();
    operands + bytes(spec, item.output)
}

/// Operands and results of a formula.
#[must_use]
pub fn formula_bytes(spec: &Spec, compiled: &Compiled) -> usize {
    let formula = &compiled.formula;
    let results = formula.results.iter().filter_map(|operand| formula.type_of(*operand));
    formula.parameters.iter().copied().chain(results).map(|ty| bytes(spec, ty)).sum()
}

fn bytes(spec: &Spec, ty: Output) -> usize {
    size_of::<f64>() * field_names(spec, ty).len()
}

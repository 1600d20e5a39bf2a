//! `--set path=value`: overrides applied to the TOML document before it is read.
//!
//! A path is a dotted TOML key. In an array of tables an element is addressed by its `name` or by
//! its index from 0: `body.cube.mass_kg=2`, `body.0.mass_kg=2`; a name that holds a dot or a space
//! is quoted, `body."big cube".mass_kg=2`. A value is a TOML value; a plain word may leave out the
//! quotes that a shell would eat: `solver.scalar=f32`.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use crate::scene::diagnostic::Diagnostic;
use crate::scene::source::SceneSource;
use crate::scene::suggest;

const EXAMPLE: &str = "write --set path=value, for example --set dt_s=0.001";

/// An override whose halves stand where they stand in the whole source, with blanks before them,
/// so that the parser's spans need no shifting.
pub(crate) struct Padded {
    begin: usize,
    path: String,
    value: Option<PaddedValue>,
}

/// The text behind the `=`, from `at` on, made the document `v=..` of one key: the parser of single
/// values takes no blanks before them. There is room for `v=`, as overrides begin at 1 or later and
/// have an `=` themselves.
struct PaddedValue {
    at: usize,
    document: String,
}

impl PaddedValue {
    fn new(at: usize, written: &str) -> Self {
        Self { at, document: format!("{}v={written}", " ".repeat(at.saturating_sub(2))) }
    }

    /// The text as written, without the blanks around it, and its place.
    fn written(&self) -> (&str, Range<usize>) {
        let text = self.document.get(self.at..).unwrap_or_default();
        let start = self.at + text.len() - text.trim_start().len();
        (text.trim(), start..start + text.trim().len())
    }

    /// The value, if the text is one and no more.
    fn parse(&self) -> Option<Spanned<DeValue<'_>>> {
        let mut entries = DeTable::parse(&self.document).ok()?.into_inner().into_iter();
        let (_, value) = entries.next()?;
        entries.next().is_none().then_some(value)
    }
}

/// Splits the overrides and puts them in place.
pub(crate) fn pad(source: &SceneSource) -> Vec<Padded> {
    let one = |(begin, text): (usize, &str)| {
        let equals = equals_sign(text);
        let (path, value) = match equals {
            Some(at) => (text.get(..at), text.get(at + 1..)),
            None => (Some(text), None),
        };
        let at = begin + equals.unwrap_or_default() + 1;
        Padded {
            begin,
            path: format!("{}{}", " ".repeat(begin), path.unwrap_or_default()),
            value: value.map(|written| PaddedValue::new(at, written)),
        }
    };
    source.placed_overrides().map(one).collect()
}

/// The place of the first `=` outside quotes.
fn equals_sign(text: &str) -> Option<usize> {
    let mut quote = None;
    for (at, c) in text.char_indices() {
        match (quote, c) {
            (None, '=') => return Some(at),
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), _) if open == c => quote = None,
            _ => {}
        }
    }
    None
}

/// Applies the overrides to the document in their order; returns those that could not be applied.
pub(crate) fn apply<'p>(root: &mut DeValue<'p>, overrides: &'p [Padded]) -> Vec<Diagnostic> {
    let one = |padded: &'p Padded| {
        let keys = keys(padded)?;
        let value = value(padded)?;
        assign(root, None, &keys, value)
    };
    overrides.iter().map(one).filter_map(Result::err).collect()
}

/// The segments of the path with their places.
fn keys(padded: &Padded) -> Result<Vec<Spanned<String>>, Diagnostic> {
    let whole = padded.begin..padded.path.len();
    let document = format!("{}=0", padded.path);
    let wrong = |span: Option<Range<usize>>| {
        Diagnostic::new(format!("`{}` is not a path to a value", padded.path.trim()))
            .at(span.filter(|span| span.start < whole.end).unwrap_or(whole.clone()))
            .help(format!("{EXAMPLE}; keys are separated by dots, odd ones quoted"))
    };
    let root = DeTable::parse(&document).map_err(|error| wrong(error.span()))?.into_inner();
    let mut keys = Vec::new();
    let mut table = root;
    loop {
        let mut entries = table.into_iter();
        let (Some((key, value)), None) = (entries.next(), entries.next()) else {
            return Err(wrong(None));
        };
        keys.push(Spanned::new(key.span(), key.into_inner().into_owned()));
        match value.into_inner() {
            DeValue::Table(inner) => table = inner,
            _ => return Ok(keys),
        }
    }
}

fn value(padded: &Padded) -> Result<Spanned<DeValue<'_>>, Diagnostic> {
    let Some(value) = &padded.value else {
        return Err(Diagnostic::new(format!("`--set {}` gives no value", padded.path.trim()))
            .at(padded.path.len()..padded.path.len())
            .label("expected `=value`")
            .help(EXAMPLE));
    };
    let (written, span) = value.written();
    match value.parse() {
        Some(value) => Ok(value),
        None if is_plain_word(written) => Ok(Spanned::new(span, DeValue::String(written.into()))),
        None if written.is_empty() => {
            Err(Diagnostic::new("`--set` with an empty value").at(span).label("expected a value").help(EXAMPLE))
        }
        None => Err(Diagnostic::new(format!("`{written}` is not a TOML value"))
            .at(span)
            .help("values look like 0.5, [0, 0, -9.81], true, or \"a text\"")),
    }
}

/// Whether a text can only be meant as a string: a word or a relative path.
fn is_plain_word(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || matches!(c, '_' | '/' | '.'))
        && text.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '/' | '.' | ' '))
}

/// Puts `value` where `keys` lead from `node`, which stands at the key `parent`.
fn assign<'p>(
    node: &mut DeValue<'p>,
    parent: Option<&str>,
    keys: &[Spanned<String>],
    value: Spanned<DeValue<'p>>,
) -> Result<(), Diagnostic> {
    let Some((key, rest)) = keys.split_first() else {
        return Ok(());
    };
    let name = key.get_ref().as_str();
    match node {
        DeValue::Table(table) => {
            if matches!(parent, Some("shape" | "orientation")) && !table.contains_key(name) {
                // Of these kinds there can be one only: the new one takes the place of the old.
                table.clear();
            }
            if rest.is_empty() {
                // Removed first, so that the key's place becomes that of the override, too.
                table.remove(name);
                table.insert(Spanned::new(key.span(), name.to_owned().into()), value);
                return Ok(());
            }
            let inner = subtable(table, key)?;
            assign(inner.get_mut(), Some(name), rest, value)
        }
        DeValue::Array(array) => {
            let slot = element(array, key, parent)?;
            if rest.is_empty() {
                *slot = value;
                return Ok(());
            }
            assign(slot.get_mut(), Some(name), rest, value)
        }
        _ => {
            let message = format!("{} is a single value and has no `{name}`", described(parent));
            let diagnostic = Diagnostic::new(message).at(key.span());
            Err(diagnostic.help("end the path one key earlier"))
        }
    }
}

fn described(parent: Option<&str>) -> String {
    parent.map_or_else(|| "the scene".to_owned(), |parent| format!("`{parent}`"))
}

/// What stands at `key` in a table, an empty table if there is nothing yet.
fn subtable<'a, 'p>(
    table: &'a mut DeTable<'p>,
    key: &Spanned<String>,
) -> Result<&'a mut Spanned<DeValue<'p>>, Diagnostic> {
    let name = key.get_ref().as_str();
    if matches!(name, "body" | "particle" | "chain" | "net" | "force" | "constraint" | "joint")
        && !table.contains_key(name)
    {
        let diagnostic = Diagnostic::new(format!("the scene has no [[{name}]]")).at(key.span());
        return Err(diagnostic.help("--set changes what the scene file has; add it there"));
    }
    let place = Spanned::new(key.span(), name.to_owned().into());
    let empty = Spanned::new(key.span(), DeValue::Table(DeTable::new()));
    Ok(table.entry(place).or_insert(empty))
}

/// The element of an array that a key addresses: by name, else by index.
fn element<'a, 'p>(
    array: &'a mut DeArray<'p>,
    key: &Spanned<String>,
    parent: Option<&str>,
) -> Result<&'a mut Spanned<DeValue<'p>>, Diagnostic> {
    let wanted = key.get_ref().as_str();
    let names: Vec<Option<String>> =
        array.iter().map(|item| Some(item.get_ref().get("name")?.get_ref().as_str()?.to_owned())).collect();
    let by_name = names.iter().position(|name| name.as_deref() == Some(wanted));
    let idx = by_name.or_else(|| wanted.parse().ok());
    if let Some(item) = idx.and_then(|idx| array.get_mut(idx)) {
        return Ok(item);
    }
    let message = format!("{} has no element `{wanted}`", described(parent));
    let mut diagnostic = Diagnostic::new(message).at(key.span());
    let known: Vec<&str> = names.iter().flatten().map(String::as_str).collect();
    if let Some(near) = suggest::closest(wanted, known.iter().copied()) {
        diagnostic = diagnostic.label(format!("did you mean `{near}`?"));
    }
    let by_index = match names.len() {
        0 => "it is empty".to_owned(),
        count => format!("elements have the indices 0 to {}", count - 1),
    };
    Err(diagnostic.help(match &known[..] {
        [] => by_index,
        known => format!("the names are {}; {by_index}", suggest::list(known.iter().copied())),
    }))
}

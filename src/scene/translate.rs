//! The messages of the TOML reader and of serde, said in the words of scene files.
//!
//! serde hands out its complaints as English text only, so they are recognised by that text. One
//! that is not recognised is shown as it is.

use std::collections::HashSet;
use std::ops::Range;

use crate::scene::diagnostic::Diagnostic;
use crate::scene::suggest;

/// What the reader complains about.
pub(crate) enum Kind {
    /// A key that the table does not have, and those it may have.
    UnknownKey(String, Vec<String>),
    /// A name that is none of the possible ones.
    UnknownName(String, Vec<String>),
    /// A required key that is not there.
    Missing(String),
    /// A value of another type: found, expected.
    WrongType(String, String),
    /// A choice among named kinds that is not made.
    Unchosen,
    /// A choice among named kinds that is made more than once.
    ChosenTwice,
    /// Anything else, in the reader's words.
    Other(String),
}

impl Kind {
    pub(crate) fn of(message: &str) -> Self {
        let mut quoted = message.split('`').skip(1).step_by(2).map(str::to_owned);
        if message.starts_with("unknown field") {
            Self::UnknownKey(quoted.next().unwrap_or_default(), quoted.collect())
        } else if message.starts_with("unknown variant") {
            Self::UnknownName(quoted.next().unwrap_or_default(), quoted.collect())
        } else if message.starts_with("missing field") {
            Self::Missing(quoted.next().unwrap_or_default())
        } else if message == "wanted exactly 1 element, found 0 elements" {
            Self::Unchosen
        } else if message.starts_with("wanted exactly 1 element") {
            Self::ChosenTwice
        } else if message == "wanted string or table" {
            Self::WrongType(String::new(), "one of the kinds, as a table".to_owned())
        } else if let Some((found, expected)) = types(message) {
            Self::WrongType(plain_found(found), plain_expected(expected))
        } else {
            Self::Other(message.to_owned())
        }
    }
}

/// Splits "invalid type: FOUND, expected EXPECTED"; the found text may itself hold commas.
fn types(message: &str) -> Option<(&str, &str)> {
    let rest = message.strip_prefix("invalid type: ").or_else(|| message.strip_prefix("invalid value: "))?;
    rest.rsplit_once(", expected ")
}

fn plain_expected(expected: &str) -> String {
    match expected {
        "f64" => "a number".to_owned(),
        "u32" => "a whole number from 0".to_owned(),
        "a sequence" => "a list".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "string or map" | "newtype variant" => "a table of values".to_owned(),
        _ if expected.starts_with("struct ") => "a table".to_owned(),
        _ => expected.to_owned(),
    }
}

fn plain_found(found: &str) -> String {
    match found {
        "sequence" => "a list".to_owned(),
        "map" => "a table".to_owned(),
        "unit variant" => "only the name of a kind".to_owned(),
        _ => {
            let found = found.replace("floating point", "number").replace("integer", "number");
            let found = found.replace("string \"", "the text \"").replace("boolean ", "");
            if found.starts_with("number") { format!("the {found}") } else { found }
        }
    }
}

/// Keys of the top level that land in the table above them when they are written below a header.
const TOP_LEVEL: [&str; 5] = ["duration_s", "dt_s", "record_hz", "gravity_m_s2", "formulation"];

/// The diagnostic for a complaint about the place `span`; `in_root` if that is the whole file.
/// `key` is the key of the entry, or for what is missing that of its table.
pub(crate) fn mistake(kind: &Kind, span: Range<usize>, in_root: bool, key: Option<&str>) -> Diagnostic {
    let diagnostic = match kind {
        Kind::UnknownKey(key, possible) => unknown_key(key, possible),
        Kind::UnknownName(name, possible) => {
            let possible_names = suggest::list(possible.iter().map(String::as_str));
            with_suggestion(Diagnostic::new(format!("there is no `{name}` here")), name, possible)
                .help(format!("possible here: {possible_names}"))
        }
        Kind::Missing(key) if in_root => {
            return Diagnostic::new(format!("the scene has no `{key}`"))
                .help(format!("add `{key} = ..` at the top, above the first [table]"));
        }
        Kind::Missing(key) => Diagnostic::new(format!("`{key}` is missing"))
            .label(format!("this needs `{key}`"))
            .help(format!("add `{key} = ..`")),
        Kind::WrongType(found, expected) => wrong_type(found, expected, key),
        Kind::Unchosen => Diagnostic::new("no kind is chosen").help(kinds(key)),
        Kind::ChosenTwice => Diagnostic::new("more than one kind is chosen")
            .label("only one can be")
            .help(format!("keep one; {}", kinds(key))),
        Kind::Other(message) if message.ends_with("number overflowed") => {
            Diagnostic::new("the number is too large").label("beyond the range of f64")
        }
        Kind::Other(message) => Diagnostic::new(message.clone()),
    };
    diagnostic.at(span)
}

fn wrong_type(found: &str, expected: &str, key: Option<&str>) -> Diagnostic {
    let message = match found {
        "" => format!("expected {expected}"),
        found => format!("expected {expected}, found {found}"),
    };
    let diagnostic = Diagnostic::new(message).label(format!("expected {expected}"));
    match key {
        Some(list @ ("body" | "particle" | "chain" | "net" | "force" | "constraint" | "joint"))
            if found == "a table" =>
        {
            diagnostic.help(format!("write [[{list}]] with two brackets: there can be several"))
        }
        Some("shape" | "orientation") => diagnostic.help(kinds(key)),
        _ => diagnostic,
    }
}

/// How to choose a kind of what stands at `key`.
fn kinds(key: Option<&str>) -> &'static str {
    match key {
        Some("shape") => "for example `shape.box.size_m = [1, 1, 1]`",
        Some("orientation") => "for example `orientation.rotor = [1, 0, 0, 0]`",
        Some("force") => {
            "a [[force]] has one of `at_point`, `linear_drag`, `quadratic_drag`, `inverse_square`, \
             `inverse_square_to_point`, `spring`, `torque`, for example `linear_drag = { body = \"cube\", k_kg_s = 0.1 }`"
        }
        Some("constraint") => {
            "a [[constraint]] has one of `distance`, `distance_to_point`, `on_plane`, `on_sphere`, `on_line`, `on_circle`, \
             for example `distance = { a = \"one\", b = \"other\" }`"
        }
        Some("joint") => {
            "a [[joint]] has one of `ball`, `hinge`, `distance`, for example \
             `ball = { a = \"rod\", point_m = [0, 0, 0] }`"
        }
        _ => "write exactly one",
    }
}

fn unknown_key(key: &str, possible: &[String]) -> Diagnostic {
    let diagnostic = Diagnostic::new(format!("unknown key `{key}`"));
    if TOP_LEVEL.contains(&key) {
        return diagnostic
            .label("belongs to the top level")
            .help(format!("move `{key}` above the first [table]: in TOML a key belongs to the header above it"));
    }
    let keys = suggest::list(possible.iter().map(String::as_str));
    with_suggestion(diagnostic, key, possible).help(format!("the keys here are {keys}"))
}

fn with_suggestion(diagnostic: Diagnostic, name: &str, possible: &[String]) -> Diagnostic {
    match suggest::closest(name, possible.iter().map(String::as_str)) {
        Some(near) => diagnostic.label(format!("did you mean `{near}`?")),
        None => diagnostic.label("not known here"),
    }
}

/// The diagnostics for mistakes in the TOML itself, of each line the first: the others on it are
/// the parser's attempts to go on.
pub(crate) fn syntax(errors: &[toml::de::Error], text: &str) -> Vec<Diagnostic> {
    let line = |error: &toml::de::Error| {
        let start = error.span().map_or(0, |span| span.start);
        text.bytes().take(start).filter(|&byte| byte == b'\n').count()
    };
    let mut seen = HashSet::new();
    errors.iter().filter(|error| seen.insert(line(error))).map(|e| syntax_error(e, text)).collect()
}

fn syntax_error(error: &toml::de::Error, text: &str) -> Diagnostic {
    let diagnostic = Diagnostic::new(format!("not valid TOML: {}", error.message()));
    let Some(span) = error.span() else {
        return diagnostic;
    };
    let comma = text.get(span.start..).is_some_and(|rest| rest.starts_with(','));
    let diagnostic = match error.message() {
        "duplicate key" => diagnostic.help("a key may be given once: keep one of the two"),
        _ if comma => diagnostic.help("numbers have a decimal point: 1.5, not 1,5"),
        _ => diagnostic,
    };
    diagnostic.at(span)
}

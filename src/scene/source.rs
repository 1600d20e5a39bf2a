//! From a path to a scene: reading the file, and keeping its text for the messages about it.
//!
//! The `--set` texts count as a continuation of the file: override `i` begins one byte after the
//! end of the one before it. So a span alone says which text it is in, and values that come from
//! an override are pointed at like any other.

use core::fmt;
use std::fs;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::scene::check;
use crate::scene::description::Scene;
use crate::scene::diagnostic::Diagnostic;
use crate::scene::overrides;
use crate::scene::read;
use crate::scene::translate;

/// A scene's text and where it came from.
#[derive(Clone, Debug)]
pub struct SceneSource {
    path: PathBuf,
    text: String,
    overrides: Vec<String>,
}

/// Where a span lies: in the file, or in one of the overrides.
pub(crate) struct Place<'a> {
    pub(crate) name: String,
    pub(crate) text: &'a str,
    pub(crate) span: Range<usize>,
}

impl SceneSource {
    /// A scene that is in memory already. `path` names it in messages, and mesh files are looked
    /// for in its directory.
    pub fn from_text(path: impl Into<PathBuf>, text: impl Into<String>, sets: &[String]) -> Self {
        Self { path: path.into(), text: text.into(), overrides: sets.to_vec() }
    }

    /// The path of the scene file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The text of the file, without the overrides.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The overrides `path=value`, in the order in which they were applied.
    #[must_use]
    pub fn overrides(&self) -> &[String] {
        &self.overrides
    }

    /// The path of a file that the scene names: relative to the directory of the scene.
    #[must_use]
    pub fn resolve(&self, file: &str) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(file)
    }

    /// The text of the value at `span` as it was written; empty if the span is of no text.
    #[must_use]
    pub fn written(&self, span: Range<usize>) -> &str {
        let place = self.locate(span);
        place.text.get(place.span).unwrap_or_default()
    }

    pub(crate) fn name(&self) -> String {
        self.path.display().to_string()
    }

    /// The overrides with the places where their texts begin.
    pub(crate) fn placed_overrides(&self) -> impl Iterator<Item = (usize, &str)> {
        self.overrides.iter().scan(self.text.len() + 1, |next, text| {
            let begin = *next;
            *next += text.len() + 1;
            Some((begin, text.as_str()))
        })
    }

    /// Where `span` lies; what is outside the text is moved to its end.
    pub(crate) fn locate(&self, span: Range<usize>) -> Place<'_> {
        let (begin, name, text) = self
            .placed_overrides()
            .filter(|&(begin, _)| begin <= span.start)
            .last()
            .map_or_else(|| (0, self.name(), &*self.text), |(b, text)| (b, "--set".into(), text));
        let start = char_boundary(text, span.start - begin);
        let end = char_boundary(text, span.end.saturating_sub(begin)).max(start);
        Place { name, text, span: start..end }
    }
}

/// The last character boundary of `text` at or before `at`.
fn char_boundary(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

/// A scene that cannot be used: every mistake that was found, in file order, and the text.
#[derive(Clone, Debug)]
pub struct Rejected {
    /// The text that the mistakes are in; empty if it could not be read.
    pub source: SceneSource,
    /// The mistakes, at least one.
    pub diagnostics: Vec<Diagnostic>,
}

impl Rejected {
    /// All mistakes, one below the other with a blank line between.
    #[must_use]
    pub fn render(&self, colour: bool) -> String {
        let mistakes: Vec<String> = self.diagnostics.iter().map(|d| d.render(&self.source, colour)).collect();
        mistakes.join("\n\n")
    }
}

impl fmt::Display for Rejected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for Rejected {}

/// Reads the scene file `path` with the overrides `sets` (each `path=value`) applied.
///
/// # Errors
/// [`Rejected`] if the file cannot be read, is not TOML, or says something that cannot be meant.
pub fn load(path: &Path, sets: &[String]) -> Result<(Scene, SceneSource), Rejected> {
    match read_text(path) {
        Ok(text) => parse(SceneSource::from_text(path, text, sets)),
        Err(diagnostic) => {
            Err(Rejected { source: SceneSource::from_text(path, "", sets), diagnostics: vec![diagnostic] })
        }
    }
}

/// As [`load`], from a text in memory. Mesh files are still looked for on disk.
///
/// # Errors
/// [`Rejected`] if the text is not TOML, or says something that cannot be meant.
pub fn parse(source: SceneSource) -> Result<(Scene, SceneSource), Rejected> {
    let (scene, mut diagnostics) = examine(&source);
    diagnostics.sort_by_key(|d| d.span.as_ref().map(|span| span.start));
    diagnostics.dedup();
    match scene {
        Some(scene) if diagnostics.is_empty() => Ok((scene, source)),
        _ => Err(Rejected { source, diagnostics }),
    }
}

fn examine(source: &SceneSource) -> (Option<Scene>, Vec<Diagnostic>) {
    let (table, errors) = DeTable::parse_recoverable(&source.text);
    if !errors.is_empty() {
        return (None, translate::syntax(&errors, &source.text));
    }
    let span = table.span();
    let mut root = Spanned::new(span, DeValue::Table(table.into_inner()));
    let padded = overrides::pad(source);
    let mut diagnostics = overrides::apply(root.get_mut(), &padded);
    let reading = read::read(root);
    diagnostics.extend(reading.diagnostics);
    if let Some(scene) = &reading.scene {
        let found = check::check(scene, source, &reading.damage);
        diagnostics.extend(found.into_iter().filter(|d| d.span != Some(read::PLACEHOLDER)));
    }
    (reading.scene, diagnostics)
}

fn read_text(path: &Path) -> Result<String, Diagnostic> {
    let bytes = fs::read(path).map_err(|error| unreadable(path, &error))?;
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    if matches!(extension.to_lowercase().as_str(), "obj" | "stl" | "ply" | "gltf" | "glb") {
        return Err(Diagnostic::new("this is a mesh, not a scene")
            .help("name it in a scene: `shape.mesh.file = \"..\"` in a [[body]]"));
    }
    if bytes.contains(&0) {
        return Err(Diagnostic::new("this is a binary file, not a scene")
            .help("a scene is a TOML text file, for example scenes/free-collision.toml"));
    }
    String::from_utf8(bytes).map_err(|error| not_utf8(&error))
}

fn unreadable(path: &Path, error: &std::io::Error) -> Diagnostic {
    if path.is_dir() {
        return Diagnostic::new("this is a directory, not a scene file").help("name a .toml file in it");
    }
    let diagnostic = Diagnostic::new(match error.kind() {
        ErrorKind::NotFound => "the scene file does not exist".to_owned(),
        ErrorKind::PermissionDenied => "no permission to read the scene file".to_owned(),
        _ => format!("the scene file cannot be read: {error}"),
    });
    if error.kind() == ErrorKind::NotFound && path.extension().is_none() {
        return diagnostic.help("scene files end in .toml");
    }
    diagnostic
}

fn not_utf8(error: &std::string::FromUtf8Error) -> Diagnostic {
    let good = error.utf8_error().valid_up_to();
    let (before, after) = error.as_bytes().split_at(good);
    let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
    let byte = after.first().copied().unwrap_or_default();
    Diagnostic::new(format!("line {line} is not UTF-8 text: it contains the byte 0x{byte:02X}"))
        .help("save the file with the encoding UTF-8")
}

//! A mistake of the user: what is wrong, where, and what to do about it, in the look of rustc.
//!
//! Any stage that works from a scene makes these, with the spans that the scene's values carry.
//! Spans are byte ranges of the text that [`SceneSource`] holds, overrides included.

use std::io::IsTerminal;
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};

use crate::scene::source::SceneSource;

/// One mistake in a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What is wrong, in a sentence with the value; no full stop.
    pub message: String,
    /// Where the value at fault stands; none if the mistake has no place in the text.
    pub span: Option<Range<usize>>,
    /// A few words under the value.
    pub label: Option<String>,
    /// The remedy.
    pub help: Option<String>,
}

impl Diagnostic {
    /// A mistake without a place.
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: one_line(message.into()), span: None, label: None, help: None }
    }

    /// Points at `span`.
    #[must_use]
    pub fn at(mut self, span: Range<usize>) -> Self {
        self.span = Some(span);
        self
    }

    /// Writes `label` under the value.
    #[must_use]
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = Some(one_line(label.into()));
        self
    }

    /// Names the remedy.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(one_line(help.into()));
        self
    }

    /// The message with the line it is about, `colour` by terminal escapes. No newline at the end.
    #[must_use]
    pub fn render(&self, source: &SceneSource, colour: bool) -> String {
        let mut group: Group<'_> = Group::with_title(Level::ERROR.primary_title(&*self.message));
        // A default has the place 0..0, which is none.
        if let Some(span) = self.span.as_ref().filter(|span| **span != (0..0)) {
            let place = source.locate(span.clone());
            let mut mark = AnnotationKind::Primary.span(place.span);
            if let Some(label) = &self.label {
                mark = mark.label(&**label);
            }
            let snippet = Snippet::source(place.text).path(place.name).annotation(mark);
            group = group.element(snippet);
        } else {
            group = group.element(Origin::path(source.name()));
        }
        if let Some(help) = &self.help {
            group = group.element(Level::HELP.message(&**help));
        }
        let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
        renderer.render(&[group])
    }
}

/// A text with its control characters written out: messages quote what users wrote, and that may
/// hold line ends or terminal escapes.
fn one_line(text: String) -> String {
    if !text.contains(char::is_control) {
        return text;
    }
    let visible = |c: char| match c.is_control() {
        true => c.escape_default().to_string(),
        false => c.to_string(),
    };
    text.chars().map(visible).collect()
}

/// Whether messages on standard error may be coloured: it is a terminal, and neither `NO_COLOR`
/// (set and not empty, <https://no-color.org>) nor `TERM=dumb` speaks against it.
#[must_use]
pub fn stderr_wants_colour() -> bool {
    let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    !refused && !dumb && std::io::stderr().is_terminal()
}

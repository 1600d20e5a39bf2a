//! From a TOML document to a [`Scene`], going on after a mistake so that all are reported at once.
//!
//! serde stops at the first mistake. So the entry at fault is taken out of the document and the
//! rest read again, until a scene comes out. A required entry that is missing, or that was taken
//! out, is replaced by a placeholder: NaN, 0 or an empty text at [`PLACEHOLDER`], a place that no text
//! has. Later complaints about that place follow from the first mistake and are dropped.

use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeArray, DeValue, ValueDeserializer};

use crate::scene::description::Scene;
use crate::scene::diagnostic::Diagnostic;
use crate::scene::suggest;
use crate::scene::translate::{self, Kind};

/// The place of values that the file does not have.
pub(crate) const PLACEHOLDER: Range<usize> = usize::MAX..usize::MAX;

/// How many mistakes are looked for: each costs a reading of the document, and a file with more is
/// not a scene with slips but something else.
const MAX_MISTAKES: usize = 50;

/// What came out of a document.
pub(crate) struct Reading {
    pub(crate) scene: Option<Scene>,
    pub(crate) diagnostics: Vec<Diagnostic>,
    pub(crate) damage: Damage,
}

/// Which parts of the scene are not what the file says, so that "this is missing" may not be said.
#[derive(Default)]
pub(crate) struct Damage {
    /// Arrays of tables and the elements that were changed; no element: one was taken out, or all.
    changed: Vec<(String, Option<usize>)>,
}

impl Damage {
    /// Whether an entry of the element of an array of tables was taken out or put in.
    pub(crate) fn of(&self, array: &str, idx: usize) -> bool {
        self.changed.iter().any(|(name, place)| name == array && place.is_none_or(|place| place == idx))
    }

    /// Whether the file may have a body of a name that the scene has not.
    pub(crate) fn of_names(&self, scene: &Scene) -> bool {
        self.changed.iter().any(|(name, place)| name == "body" && place.is_none())
            || scene.body.iter().any(|body| body.name.span() == PLACEHOLDER)
    }

    /// Whether the particles of the scene may not be those of the file.
    pub(crate) fn of_particles(&self) -> bool {
        self.changed.iter().any(|(name, _)| matches!(name.as_str(), "particle" | "chain" | "net"))
    }

    fn note(&mut self, path: &[Segment]) {
        match path {
            [Segment::Key(key)] => self.changed.push((key.clone(), None)),
            [Segment::Key(key), Segment::Idx(idx), ..] => self.changed.push((key.clone(), Some(*idx))),
            _ => {}
        }
    }
}

/// Reads the document `root`.
pub(crate) fn read(mut root: Spanned<DeValue<'_>>) -> Reading {
    let mut diagnostics = Vec::new();
    let mut repair = Repair::default();
    while diagnostics.len() < MAX_MISTAKES {
        let error = match Scene::deserialize(ValueDeserializer::from(root.clone())) {
            Ok(scene) => {
                return Reading { scene: Some(scene), diagnostics, damage: repair.damage };
            }
            Err(error) => error,
        };
        let kind = Kind::of(error.message());
        let span = error.span().unwrap_or_else(|| root.span());
        let mut path = Vec::new();
        let step = repair.step(&mut root, &kind, &span, &mut path);
        if step != Step::Consequence {
            let in_root = span == root.span();
            diagnostics.push(translate::mistake(&kind, span, in_root, last_key(&path)));
        }
        if step == Step::Stuck {
            break;
        }
    }
    Reading { scene: None, diagnostics, damage: repair.damage }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Step {
    /// The document is a step closer to a scene.
    Repaired,
    /// So it is, and the mistake only followed from an earlier repair.
    Consequence,
    /// Nothing could be done.
    Stuck,
}

#[derive(Default)]
struct Repair {
    /// The tables (by place) and keys of the entries taken out, and of those that were meant.
    removed: Vec<(Range<usize>, String)>,
    damage: Damage,
}

impl Repair {
    /// Repairs what is wrong at `span`; `path` becomes the path of the entry.
    fn step(
        &mut self,
        root: &mut Spanned<DeValue<'_>>,
        kind: &Kind,
        span: &Range<usize>,
        path: &mut Vec<Segment>,
    ) -> Step {
        let follows = self.removed.iter().any(|(table, name)| {
            table == span
                && match kind {
                    Kind::Missing(key) => name == key,
                    Kind::Unchosen => true,
                    _ => false,
                }
        });
        let done = match kind {
            Kind::Missing(key) => placeholder(key).is_some_and(|value| insert(root, key, value, span, path)),
            _ => self.remove(root, span, path),
        };
        if let (Kind::UnknownKey(key, possible), Some((table, _))) = (kind, self.removed.last()) {
            let meant = suggest::closest(key, possible.iter().map(String::as_str));
            let meant = meant.map(|meant| (table.clone(), meant.to_owned()));
            self.removed.extend(meant);
        }
        self.damage.note(path);
        match (done, follows) {
            (true, true) => Step::Consequence,
            (true, false) => Step::Repaired,
            (false, _) => Step::Stuck,
        }
    }

    /// Takes out the innermost entry whose key or value is at `span`; `path` leads to its table.
    fn remove(&mut self, node: &mut Spanned<DeValue<'_>>, span: &Range<usize>, path: &mut Vec<Segment>) -> bool {
        let table_span = node.span();
        match node.get_mut() {
            DeValue::Table(table) => {
                for (key, value) in table.iter_mut() {
                    path.push(Segment::Key(key.get_ref().to_string()));
                    if self.remove(value, span, path) {
                        return true;
                    }
                    path.pop();
                }
                let at_fault = table.iter().find(|(key, value)| {
                    let place = value.span();
                    key.span() == *span || (place.start <= span.start && span.end <= place.end)
                });
                let Some(key) = at_fault.map(|(key, _)| key.get_ref().to_string()) else {
                    return false;
                };
                table.remove(key.as_str());
                self.removed.push((table_span, key.clone()));
                path.push(Segment::Key(key));
                true
            }
            DeValue::Array(array) => {
                for (idx, item) in array.iter_mut().enumerate() {
                    path.push(Segment::Idx(idx));
                    if item.get_ref().is_table() && self.remove(item, span, path) {
                        return true;
                    }
                    path.pop();
                }
                Self::remove_element(array, span)
            }
            _ => false,
        }
    }

    /// Takes out the table at `span` of an array of tables. An element of another array stays: the
    /// whole array is at fault then.
    fn remove_element(array: &mut DeArray<'_>, span: &Range<usize>) -> bool {
        let at_fault = |item: &Spanned<DeValue<'_>>| item.get_ref().is_table() && item.span() == *span;
        let found = array.iter().any(at_fault);
        if found {
            *array = array.iter().filter(|item| !at_fault(item)).cloned().collect();
        }
        found
    }
}

/// The innermost key of a path.
fn last_key(path: &[Segment]) -> Option<&str> {
    path.iter().rev().find_map(|segment| match segment {
        Segment::Key(key) => Some(key.as_str()),
        Segment::Idx(_) => None,
    })
}

enum Segment {
    Key(String),
    Idx(usize),
}

/// Puts an entry into the first table at `span` that lacks it; `path` leads to the table.
fn insert(
    node: &mut Spanned<DeValue<'_>>,
    key: &str,
    entry: DeValue<'static>,
    span: &Range<usize>,
    path: &mut Vec<Segment>,
) -> bool {
    let here = node.span() == *span;
    match node.get_mut() {
        DeValue::Table(table) if here && !table.contains_key(key) => {
            let key = Spanned::new(PLACEHOLDER, key.to_owned().into());
            table.insert(key, Spanned::new(PLACEHOLDER, entry));
            true
        }
        DeValue::Table(table) => table.iter_mut().any(|(name, value)| {
            path.push(Segment::Key(name.get_ref().to_string()));
            let done = insert(value, key, entry.clone(), span, path);
            if !done {
                path.pop();
            }
            done
        }),
        DeValue::Array(array) => array.iter_mut().enumerate().any(|(idx, item)| {
            path.push(Segment::Idx(idx));
            let done = insert(item, key, entry.clone(), span, path);
            if !done {
                path.pop();
            }
            done
        }),
        _ => false,
    }
}

/// A value of the right type for a required key, and one that no check takes for good.
fn placeholder(key: &str) -> Option<DeValue<'static>> {
    let text = match key {
        "duration_s" | "angle_rad" | "base_m" | "height_m" | "k_kg_s" | "k_kg_m" | "mass_kg" | "stiffness_n_m"
        | "constant_m3_kg_s2" | "constant_m3_s2" | "radius_m" | "length_m" => "nan",
        "particles" | "columns" | "rows" => "0",
        "name" | "body" | "file" | "a" | "b" | "particle" => "''",
        "axis" | "force_world_n" | "torque_world_n_m" | "normal" | "size_m" | "from_m" | "to_m" | "column_step_m"
        | "row_step_m" | "point_m" | "centre_m" | "direction" => "[nan, nan, nan]",
        "vertices_m" => "[[nan, nan, nan], [0, 0, 0], [0, 0, 0], [0, 0, 0]]",
        _ => return None,
    };
    DeValue::parse(text).ok().map(Spanned::into_inner)
}

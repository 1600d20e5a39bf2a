//! Whatever a file or an override holds, reading it ends in a scene or in messages.

use std::fs;

use ga_physics::scene::{SceneSource, parse};
use proptest::prelude::*;

use crate::{shipped, with_floor};

/// Every reading of a damaged scene ends in a scene or in complaints that can be shown.
fn ends_well(text: &str, sets: &[String]) -> Result<(), TestCaseError> {
    if let Err(rejected) = parse(SceneSource::from_text("scene.toml", text, sets)) {
        prop_assert!(!rejected.diagnostics.is_empty());
        for diagnostic in &rejected.diagnostics {
            prop_assert!(!diagnostic.message.is_empty());
            prop_assert!(diagnostic.render(&rejected.source, true).contains(&diagnostic.message));
        }
    }
    Ok(())
}

const PIECES: &[&str] = &[
    "=",
    ".",
    ",",
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    "\"",
    "'",
    "\n",
    " ",
    "#",
    "-",
    "0",
    "1e999",
    "nan",
    "ä",
    "名",
    "body",
    "shape",
    "box",
    "name",
    "cube",
    "orientation",
    "at_point",
    "[[body]]\n",
    "\r",
    "fixed = true\n",
    "[contact]\n",
    "\"\"\"",
    "1979-05-27",
    "true",
    "\u{feff}",
    "\t",
];

proptest! {
    #[test]
    fn no_damage_to_a_scene_ends_in_a_panic(
        which in any::<prop::sample::Index>(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0..12_usize, 0..PIECES.len()), 1..6),
    ) {
        let mut text = fs::read_to_string(which.get(&shipped())).unwrap();
        for (at, length, piece) in edits {
            let chars: Vec<char> = text.chars().collect();
            let at = at.index(chars.len() + 1);
            let end = (at + length).min(chars.len());
            text = chars[..at].iter().collect::<String>() + PIECES[piece]
                + &chars[end..].iter().collect::<String>();
        }
        ends_well(&text, &[])?;
    }

    #[test]
    fn no_override_ends_in_a_panic(sets in prop::collection::vec(
        prop::collection::vec(0..PIECES.len(), 0..8).prop_map(|pieces| {
            pieces.into_iter().map(|i| PIECES[i]).collect::<String>()
        }), 1..4)
    ) {
        ends_well(&with_floor(), &sets)?;
        ends_well("", &sets)?;
    }
}

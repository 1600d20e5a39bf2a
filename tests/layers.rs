//! The layers of the source: a folder under `src/` may name only itself and the folders before it in [`LAYERS`].
//!
//! The check reads text, not the compiler's names: paths that start at `crate`, `$crate` or `ga_physics`, in `use` lines
//! (groups and renames included) and inline, and chains of `super` that leave their folder. Comments and strings do not
//! count. What it cannot see: a name that macro expansion puts together.
#![allow(clippy::unwrap_used, reason = "a test that cannot read the source should stop")]

use std::fs;
use std::path::{Path, PathBuf};

/// From the bottom up.
const LAYERS: [&str; 15] = [
    "algebra",
    "versor",
    "geometry",
    "interop",
    "ode",
    "constraint",
    "particle",
    "rigid",
    "collision",
    "simulation",
    "io",
    "scene",
    "study",
    "cli",
    "main",
];

/// Paths that a layer must not name at all, beside those of the layers over it.
const FOREIGN: [(&str, &str); 8] = [
    ("simulation", "std::fs"),
    ("simulation", "std::io"),
    ("simulation", "std::net"),
    ("simulation", "std::env"),
    ("simulation", "println!"),
    ("simulation", "eprintln!"),
    ("collision", "std::fs"),
    ("rigid", "std::fs"),
];

fn rank(layer: &str) -> Option<usize> {
    LAYERS.iter().position(|known| *known == layer)
}

/// The text with comments and the insides of strings and character literals blanked.
fn code_only(text: &str) -> String {
    let (chars, mut code, mut at): (Vec<char>, _, _) = (text.chars().collect(), String::new(), 0);
    let starts = |at: usize, what: &str| what.chars().enumerate().all(|(i, c)| chars.get(at + i) == Some(&c));
    while at < chars.len() {
        if starts(at, "//") {
            while at < chars.len() && chars[at] != '\n' {
                at += 1;
            }
        } else if starts(at, "/*") {
            let mut depth = 0;
            while at < chars.len() {
                if starts(at, "/*") {
                    (depth, at) = (depth + 1, at + 2);
                } else if starts(at, "*/") {
                    (depth, at) = (depth - 1, at + 2);
                } else {
                    at += 1;
                }
                if depth == 0 {
                    break;
                }
            }
            code.push(' ');
        } else if starts(at, "r\"") || starts(at, "r#") && !code.ends_with(|c: char| c.is_alphanumeric() || c == '_') {
            let hashes = chars[at + 1..].iter().take_while(|c| **c == '#').count();
            if chars.get(at + 1 + hashes) != Some(&'"') {
                at += 2; // A raw identifier.
                continue;
            }
            let end = format!("\"{}", "#".repeat(hashes));
            at += 2 + hashes;
            while at < chars.len() && !starts(at, &end) {
                at += 1;
            }
            at += end.len();
            code.push_str("\"\"");
        } else if chars[at] == '"' {
            at += 1;
            while at < chars.len() && chars[at] != '"' {
                at += if chars[at] == '\\' { 2 } else { 1 };
            }
            at += 1;
            code.push_str("\"\"");
        } else if starts(at, "'\\") || chars[at] == '\'' && chars.get(at + 2) == Some(&'\'') {
            at += if chars[at + 1] == '\\' { 3 } else { 2 };
            while at < chars.len() && chars[at] != '\'' {
                at += 1;
            }
            at += 1;
            code.push_str("' '");
        } else {
            code.push(chars[at]);
            at += 1;
        }
    }
    code
}

/// Identifiers, `::`, and other characters one by one.
fn tokens(code: &str) -> Vec<String> {
    let (mut found, mut word) = (Vec::<String>::new(), String::new());
    for c in code.chars().chain([' ']) {
        if c.is_alphanumeric() || c == '_' {
            word.push(c);
            continue;
        }
        if !word.is_empty() {
            found.push(std::mem::take(&mut word));
        }
        match (c, found.last_mut()) {
            (':', Some(last)) if last == ":" => last.push(':'),
            _ if c.is_whitespace() => {}
            _ => found.push(c.to_string()),
        }
    }
    found
}

/// The first names of what follows `root ::`: one, or one for each branch of a group.
fn heads(tokens: &[String]) -> Vec<&str> {
    if tokens.first().is_none_or(|first| first != "{") {
        return tokens.first().map(String::as_str).into_iter().collect();
    }
    let (mut depth, mut fresh, mut found) = (0, false, Vec::new());
    for token in tokens {
        match token.as_str() {
            "{" => {
                depth += 1;
                fresh = depth == 1;
            }
            "}" => depth -= 1,
            "," => fresh = depth == 1,
            name if fresh => {
                found.push(name);
                fresh = false;
            }
            _ => {}
        }
        if depth == 0 {
            break;
        }
    }
    found
}

/// What breaks the order in the text of a file. `depth` is how many `super` lead from the file's module to the root.
fn violations(layer: &str, depth: usize, text: &str) -> Vec<String> {
    let Some(own) = rank(layer) else {
        return vec![format!("`{layer}` has no place among the layers: add it to LAYERS")];
    };
    let code = code_only(text);
    let tokens = tokens(&code);
    let is_path = |at: usize| tokens.get(at + 1).is_some_and(|next| next == "::");
    let (mut found, mut supers) = (Vec::new(), 0);
    for at in 0..tokens.len() {
        let token = tokens[at].as_str();
        supers = match token {
            "super" => supers + 1,
            "::" => supers,
            _ => 0,
        };
        let root = match token {
            "crate" | "ga_physics" => is_path(at),
            "super" => is_path(at) && supers >= depth,
            _ => false,
        };
        let renamed = token == "crate" && tokens.get(at + 1).is_some_and(|next| next == "as");
        if renamed && at > 0 && tokens[at - 1] == "use" {
            found.push(format!("{layer} renames the whole crate"));
        }
        for head in if root { heads(&tokens[at + 2..]) } else { Vec::new() } {
            if (head == "*" || head == "self") && token != "super" {
                found.push(format!("{layer} takes in the whole crate by `{token}::{head}`"));
            } else if rank(head).is_some_and(|rank| rank > own) {
                found.push(format!("{layer} names {head}, a layer over it, by `{token}::{head}`"));
            }
        }
    }
    let joined = tokens.concat();
    let named = FOREIGN.iter().filter(|(of, foreign)| *of == layer && joined.contains(foreign));
    found.extend(named.map(|(of, foreign)| format!("{of} names {foreign}")));
    let grouped = tokens.windows(3).position(|w| w[0] == "std" && w[1] == "::" && w[2] == "{");
    let inside = grouped.map_or_else(Vec::new, |at| heads(&tokens[at + 2..]));
    let hidden = inside.iter().filter(|head| FOREIGN.contains(&(layer, format!("std::{head}").as_str())));
    found.extend(hidden.map(|head| format!("{layer} names std::{head}")));
    found
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> = entries
        .flat_map(|path| match path.is_dir() {
            true => rust_files(&path),
            false => vec![path],
        })
        .filter(|path| path.extension().is_some_and(|e| e == "rs"))
        .collect();
    files.sort();
    files
}

/// The layer of a file by its path below `src/`, and the depth of its module.
fn place(path: &Path) -> (String, usize) {
    let mut parts: Vec<String> =
        path.with_extension("").components().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect();
    if parts.last().is_some_and(|last| last == "mod") {
        parts.pop();
    }
    (parts[0].clone(), parts.len())
}

#[test]
fn no_layer_names_one_over_it() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let files = rust_files(&src);
    assert!(files.len() > 50, "only {} files found under src", files.len());
    let mut found = Vec::new();
    for path in files {
        let below = path.strip_prefix(&src).unwrap();
        // The root declares the layers, and so names all of them.
        if below == Path::new("lib.rs") {
            continue;
        }
        let (layer, depth) = place(below);
        let text = fs::read_to_string(&path).unwrap();
        found.extend(violations(&layer, depth, &text).into_iter().map(|v| format!("src/{}: {v}", below.display())));
    }
    assert!(found.is_empty(), "\n{}", found.join("\n"));
}

/// Whether a manifest has a dependency of a name, under its own key or as `package = ".."`.
fn depends_on(manifest: &str, name: &str) -> bool {
    let mut dependencies = false;
    manifest.lines().map(str::trim).any(|line| {
        if line.starts_with('[') {
            dependencies = line.contains("dependencies");
            return dependencies && line.trim_end_matches(']').ends_with(&format!(".{name}"));
        }
        let key = line.split(['=', '.']).next().unwrap_or("").trim().trim_matches('"');
        dependencies && (key == name || line.replace(' ', "").contains(&format!("package=\"{name}\"")))
    })
}

#[test]
fn the_generator_knows_no_physics() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |path: &str| fs::read_to_string(root.join(path)).unwrap();
    assert!(!depends_on(&read("ga-gen/Cargo.toml"), "ga-physics"));
    assert!(!depends_on(&read("ga-gen/Cargo.toml"), "ga-macros"));
    assert!(!depends_on(&read("ga-macros/Cargo.toml"), "ga-physics"));
    assert!(depends_on(&read("ga-macros/Cargo.toml"), "ga-gen"), "the check sees dependencies that are there");
    for path in rust_files(&root.join("ga-gen/src")) {
        // Emitted code names the library, as text in quotations; the generator itself must not use it.
        let code = code_only(&fs::read_to_string(&path).unwrap());
        assert!(!code.contains("use ga_physics"), "{}", path.display());
    }
}

#[test]
fn the_check_of_manifests_can_fail() {
    for manifest in [
        "[dependencies]\nga-physics = { path = \"..\" }",
        "[dev-dependencies]\nga-physics.workspace = true",
        "[target.'cfg(unix)'.dependencies]\nphysics = { package = \"ga-physics\", path = \"..\" }",
        "[dependencies.ga-physics]\npath = \"..\"",
    ] {
        assert!(depends_on(manifest, "ga-physics"), "{manifest}");
    }
    for manifest in ["[package]\nname = \"ga-physics\"", "[dependencies]\nga-gen = \"1\" # not ga-physics"] {
        assert!(!depends_on(manifest, "ga-physics"), "{manifest}");
    }
}

#[test]
fn the_check_of_layers_can_fail() {
    for (layer, depth, text) in [
        ("algebra", 2, "use crate::geometry::Facet;"),
        ("ode", 1, "pub use crate::rigid::Bodies;"),
        ("collision", 2, "fn f() { let _ = crate::scene::load; }"),
        ("collision", 2, "use crate::{algebra::{Real, g3}, scene};"),
        ("collision", 2, "use crate::{\n    algebra::Real,\n    scene::{self, Scene},\n};"),
        ("geometry", 2, "use ga_physics::simulation::World;"),
        ("geometry", 2, "use ::ga_physics :: simulation :: World;"),
        ("geometry", 2, "use super::super::simulation::World;"),
        ("geometry", 1, "use super::simulation::World;"),
        ("versor", 2, "macro_rules! m { () => { $crate::geometry::Facet } }"),
        ("versor", 2, "use crate::*;"),
        ("versor", 2, "use crate as everything;"),
        ("versor", 2, "use crate::{self as everything};"),
        ("versor", 2, "const QUOTE: char = '\"'; use crate::geometry::Facet; const OTHER: char = '\\'';"),
        ("simulation", 2, "use std::fs::File;"),
        ("simulation", 2, "let _ = std::io::stdout();"),
        ("simulation", 2, "use std::{collections::HashMap, fs};"),
        ("simulation", 2, "println!(\"{}\", 1);"),
        ("scene", 3, "use crate::cli::run;"),
        ("plugins", 2, ""),
    ] {
        assert!(!violations(layer, depth, text).is_empty(), "not seen in {layer}: {text}");
    }
}

#[test]
fn the_check_of_layers_lets_pass_what_is_right() {
    for (layer, depth, text) in [
        ("geometry", 2, "use crate::algebra::{Real, cga::Point}; use super::Degenerate;"),
        ("geometry", 3, "use super::super::scene;"),
        ("geometry", 2, "// crate::scene\n/* crate::scene /* nested */ crate::cli */ use crate::geometry::mesh;"),
        (
            "geometry",
            2,
            "/// See [`Scene`](crate::scene::Scene).\nconst HELP: &str = \"crate::scene \\\" crate::cli\";",
        ),
        ("geometry", 2, "const RAW: &str = r#\"crate::scene \" crate::cli\"#; fn f<'a>(x: &'a str) -> &'a str { x }"),
        ("algebra", 2, "crate::algebra! { pub algebra g3; }"),
        ("cli", 2, "use crate::scene::{self, Rejected}; use std::fs;"),
        ("simulation", 2, "use crate::{algebra::Real, collision::{scene, Contact}};"),
    ] {
        assert_eq!(violations(layer, depth, text), Vec::<String>::new(), "{layer}: {text}");
    }
}

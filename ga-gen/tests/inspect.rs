//! What inspection says of files with formulas: where it finds their algebra, and what is wrong when it does not.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use ga_gen::inspect::{self, Format, InspectError, Inspected, load};
use std::path::{Path, PathBuf};

const PLANE: &str = "algebra! { pub algebra plane; basis e1 = 1, e2 = 1; type Vector = [e1, e2]; type Area = [e12]; }";
const FORMULA: &str = "mod inner { #[ga_physics::formula(crate::plane, dynamic = area_dynamic)] \
                       pub fn area(a: Vector, b: Vector) -> Area { a ^ b } }";

/// A folder of its own for each test, with the given files.
fn folder(test: &str, files: &[(&str, &str)]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    std::fs::create_dir_all(&folder).unwrap();
    for (name, text) in files {
        std::fs::write(folder.join(name), text).unwrap();
    }
    folder
}

fn item_text(inspected: &Inspected, name: &str, file: &Path) -> Result<String, InspectError> {
    Ok(inspect::item(inspected, name, file, false)?.print(Format::Text))
}

#[test]
fn the_algebra_of_a_formula_is_found_beside_it() {
    let together = folder("together", &[("both.rs", &format!("{PLANE}\n{FORMULA}"))]).join("both.rs");
    let beside = folder("beside", &[("plane.rs", PLANE), ("area.rs", FORMULA)]).join("area.rs");
    let apart = folder("apart", &[("area.rs", FORMULA)]).join("area.rs");
    for (file, algebra) in [(&together, None), (&beside, None), (&apart, Some(beside.with_file_name("plane.rs")))] {
        let inspected = load(file, algebra.as_deref()).unwrap();
        let text = item_text(&inspected, "area", file).unwrap();
        assert!(text.contains("operands    a: Vector(e1, e2); b: Vector(e1, e2)"), "{text}");
        assert!(text.contains("result.e12 = a.e1 b.e2 - a.e2 b.e1"), "{text}");
        assert!(text.contains("-> crate::plane::Area<T>"), "{text}");
        let overview = inspect::overview(&inspected, false).unwrap();
        assert!(overview.print(Format::Text).contains("area "));
    }
    let inside = format!("{PLANE}\n#[formula(self)] fn area(a: Vector, b: Vector) -> Area {{ a ^ b }}");
    let inside = folder("inside", &[("both.rs", &inside)]).join("both.rs");
    assert!(item_text(&load(&inside, None).unwrap(), "area", &inside).is_ok());
    let both = load(&together, None).unwrap();
    assert!(item_text(&both, "Vector^Vector", &together).is_ok());
    let error = item_text(&both, "area_of", &together).unwrap_err();
    assert!(error.to_string().starts_with("no item `area_of`"), "{error}");
}

#[test]
fn what_is_missing_or_wrong_is_named() {
    let alone = folder("alone", &[("area.rs", FORMULA)]).join("area.rs");
    let error = load(&alone, None).err().unwrap().to_string();
    assert!(error.starts_with("the algebra `plane` is in none of") && error.contains("--algebra FILE"), "{error}");
    let empty = folder("empty", &[("none.rs", "fn main() {}")]).join("none.rs");
    assert!(matches!(load(&empty, None), Err(InspectError::Nothing(_))));
    let text = format!("{PLANE}\n#[formula(plane)]\nfn area(a: Vector) -> Area {{ a }}");
    let wrong = folder("wrong", &[("area.rs", &text)]).join("area.rs");
    let error = load(&wrong, None).err().unwrap().to_string();
    assert!(error.contains("area.rs:3:23: `Area` does not hold the result"), "{error}");
    let circle = "algebra! { algebra a extends b; basis e1 = 1; } algebra! { algebra b extends a; basis e2 = 1; }";
    let circle = folder("circle", &[("both.rs", circle)]).join("both.rs");
    assert!(matches!(load(&circle, None), Err(InspectError::Circle(_))));
}

/// The library's file, with the conformal algebra.
fn library(file: &str) -> (PathBuf, Inspected) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src");
    let path = root.join(file);
    let inspected = load(&path, Some(&root.join("algebra/cga.rs"))).unwrap();
    (path, inspected)
}

#[test]
fn the_passes_and_the_ways_not_taken_are_shown_with_their_cost() {
    let (file, g3) = library("algebra/g3.rs");
    let text = item_text(&g3, "Rotor.apply(Vector)", &file).unwrap();
    let lines: Vec<String> = text.lines().map(|l| l.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    let position =
        |line: &str| lines.iter().position(|known| known == line).unwrap_or_else(|| panic!("{line}:\n{text}"));
    // 41 and 30: sandwich as two products, and by the commutator.
    position("1. sandwich plain 41 0 0");
    position("1. sandwich commutator taken 30 0 0");
    let order = ["lower: 24 mul, 12 add, 2 neg", "factor: left out, for whole formulas only", "scale: 18 mul, 12 add"];
    assert!(order.map(position).is_sorted(), "{text}");
    position("moves: no change");
    let (file, formulas) = library("geometry/formulas.rs");
    let text = item_text(&formulas, "circumsphere", &file).unwrap();
    for way in ["frame  world                    129    1     0", "frame  local = a  taken          73    1     0"] {
        assert!(text.contains(way), "{text}");
    }
    assert!(text.contains("factor:") && !text.contains("left out"), "{text}");
}

#[test]
fn tables_of_products_are_those_of_the_operands_and_large_ones_are_asked_for() {
    let (file, cga) = library("algebra/cga.rs");
    let text = item_text(&cga, "Infinity^Origin", &file).err().map(|error| error.to_string());
    assert!(text.is_some_and(|text| text.starts_with("no item")), "two constants have no operator");
    let error = item_text(&cga, "motor.aply(Point)", &file).unwrap_err().to_string();
    assert!(error.contains("close to it: Motor.apply(Point), "), "{error}");
    let text = item_text(&cga, "Point|Sphere", &file).unwrap();
    let rows: Vec<&str> = text.lines().skip_while(|line| !line.trim_start().starts_with('|')).take(6).collect();
    let cells: Vec<Vec<&str>> = rows.iter().map(|row| row.split_whitespace().collect()).collect();
    assert_eq!(cells[0], ["|", "e1", "e2", "e3", "no", "ninf"]);
    assert_eq!(cells[4], ["no", "0", "0", "0", "0", "-1"], "no . ninf = -1");
    let name = "Multivector*Multivector";
    assert!(item_text(&cga, name, &file).unwrap().contains("32 by 32 blades: shown with --blades."));
    let all = inspect::item(&cga, name, &file, true).unwrap().print(Format::Markdown);
    let longest =
        all.lines().filter(|line| line.starts_with("| `e123_no_ninf` |")).map(|line| line.matches(" | ").count());
    assert_eq!(longest.max(), Some(32), "a row of the table");
}

#[test]
fn markdown_tables_have_cells_as_many_as_their_heads() {
    let (file, g3) = library("algebra/g3.rs");
    let overview = inspect::overview(&g3, true).unwrap().print(Format::Markdown);
    let item = inspect::item(&g3, "Vector|Bivector", &file, false).unwrap().print(Format::Markdown);
    assert!(item.starts_with("# `Vector|Bivector`\n") && overview.contains("| `Vector\\|Bivector` | `Vector` | 6 |"));
    for text in [overview, item] {
        let mut width = None;
        for line in text.lines() {
            let cells = line.replace("\\|", "").matches('|').count();
            let row = line.starts_with('|');
            assert!(!row || width.is_none_or(|width| width == cells), "{line}");
            width = row.then_some(cells);
        }
        assert_eq!(text.lines().filter(|line| line.starts_with("```")).count() % 2, 0);
    }
}

/// What LaTeX would stop at: groups and environments that are not closed, special letters in text, unknown commands.
fn check_latex(text: &str) {
    let mut open: Vec<String> = Vec::new();
    let mut rest = text;
    let (mut depth, mut verbatim) = (0_usize, false);
    while let Some(letter) = rest.chars().next() {
        let place = rest.lines().next().unwrap();
        if verbatim && !rest.starts_with("\\end{verbatim}") {
            rest = &rest[letter.len_utf8()..];
            continue;
        }
        assert!(letter.is_ascii(), "{place}");
        let math = open.iter().any(|name| ["align*", "array", "["].contains(&name.as_str()));
        let mut length = 1;
        match letter {
            '\\' => {
                let name = rest[1..].split(|c: char| !c.is_ascii_alphabetic()).next().unwrap();
                length = 1 + name.len().max(1);
                let argument = || rest[length..].trim_start_matches('{').split('}').next().unwrap().to_string();
                match name {
                    "begin" => {
                        open.push(argument());
                        verbatim = open.last().unwrap() == "verbatim";
                        length += argument().len() + 2;
                    }
                    "end" => {
                        assert_eq!(open.pop(), Some(argument()), "{place}");
                        verbatim = false;
                        length += argument().len() + 2;
                    }
                    "" if rest.starts_with("\\[") => open.push("[".into()),
                    "" if rest.starts_with("\\]") => assert_eq!(open.pop().as_deref(), Some("["), "{place}"),
                    "" => assert!("\\,&%$#_{}".contains(rest[1..].chars().next().unwrap()), "{place}"),
                    "frac" | "tfrac" | "sqrt" | "mathrm" | "infty" | "wedge" | "rfloor" | "quad" | "prime" => {
                        assert!(math, "{place}");
                    }
                    "documentclass" | "usepackage" | "allowdisplaybreaks" | "section" | "subsection"
                    | "subsubsection" | "item" | "hline" | "endhead" | "textbackslash" | "textasciitilde"
                    | "textasciicircum" | "textless" | "textgreater" | "textbar" => {}
                    other => panic!("\\{other}: {place}"),
                }
            }
            '{' => depth += 1,
            '}' => depth = depth.checked_sub(1).unwrap_or_else(|| panic!("closes nothing: {place}")),
            '_' => assert!(math && rest[1..].starts_with(['{', 'o', '\\']), "{place}"),
            '^' => assert!(math && rest.starts_with("^{\\prime"), "{place}"),
            '&' => {
                assert!(open.iter().any(|name| ["align*", "array", "longtable"].contains(&name.as_str())), "{place}")
            }
            '|' => assert!(math, "{place}"),
            '<' | '>' => assert!(math, "{place}"),
            '#' | '$' | '%' | '~' => panic!("{place}"),
            _ => {}
        }
        rest = &rest[length..];
    }
    assert!(open.is_empty() && depth == 0, "{open:?}, {depth} groups open");
}

#[test]
fn latex_is_balanced_and_escaped() {
    for (file, items) in [
        (
            "algebra/g3.rs",
            vec!["Rotor.apply(Vector)", "Vector^Vector", "Vector|Rotor", "Vector&Bivector", "Even.grade2"],
        ),
        ("algebra/cga.rs", vec!["Motor.apply(Point)", "ConformalRotor.apply(Point)", "Round::from(Point)"]),
        ("geometry/formulas.rs", vec!["circumsphere", "ball_reach_and_distance_sq", "reflect_in_sphere"]),
    ] {
        let (path, inspected) = library(file);
        check_latex(&inspect::overview(&inspected, true).unwrap().print(Format::Latex));
        for name in items {
            let text = inspect::item(&inspected, name, &path, false).unwrap().print(Format::Latex);
            assert!(text.starts_with("\\documentclass") && text.ends_with("\\end{document}\n"));
            check_latex(&text);
        }
    }
    let (path, cga) = library("algebra/cga.rs");
    let text = inspect::item(&cga, "Point|Point", &path, false).unwrap().print(Format::Latex);
    assert!(text.contains("n_o & 0 & 0 & 0 & 0 & -1 \\\\"), "{text}");
    let text = inspect::item(&cga, "Motor.apply(Point)", &path, false).unwrap().print(Format::Latex);
    assert!(text.contains("e_{123} \\wedge n_\\infty &"), "{text}");
    // The terms of a step, in whatever order.
    let step = text.lines().find(|line| line.starts_with("{t}_{e_{1}} &= ")).unwrap();
    for term in ["{a}_{e_{31}}\\, {b}_{z}", "{a}_{e_{1}\\,n_\\infty}", "{a}_{e_{12}}\\, {b}_{y}"] {
        assert!(step.contains(term), "{step}");
    }
}

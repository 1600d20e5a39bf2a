//! What inspection says of files with formulas: where it finds their algebra, and what is wrong when it does not.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use ga_gen::inspect::{InspectError, item_text, load, overview};
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
        assert!(overview(&inspected).unwrap().contains("area "));
    }
    let both = load(&together, None).unwrap();
    assert!(item_text(&both, "Vector^Vector", &together).is_ok());
    let error = item_text(&both, "area_of", &together).unwrap_err();
    assert!(error.to_string().starts_with("no item `area_of`"), "{error}");
}

#[test]
fn what_is_missing_or_wrong_is_named() {
    let alone = folder("alone", &[("area.rs", FORMULA)]).join("area.rs");
    let error = load(&alone, None).unwrap_err().to_string();
    assert!(error.starts_with("the algebra `plane` is in none of") && error.contains("--algebra FILE"), "{error}");
    let empty = folder("empty", &[("none.rs", "fn main() {}")]).join("none.rs");
    assert!(matches!(load(&empty, None), Err(InspectError::Nothing(_))));
    let text = format!("{PLANE}\n#[formula(plane)]\nfn area(a: Vector) -> Area {{ a }}");
    let wrong = folder("wrong", &[("area.rs", &text)]).join("area.rs");
    let error = load(&wrong, None).unwrap_err().to_string();
    assert!(error.contains("area.rs:3:23: `Area` does not hold the result"), "{error}");
    let circle = "algebra! { algebra a extends b; basis e1 = 1; } algebra! { algebra b extends a; basis e2 = 1; }";
    let circle = folder("circle", &[("both.rs", circle)]).join("both.rs");
    assert!(matches!(load(&circle, None), Err(InspectError::Circle(_))));
}

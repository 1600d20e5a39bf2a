//! The ledgers say what the code costs.

use crate::root;
use ga_gen::ledger::{self, Row, Source};

const COMMAND: &str = "cargo run -p ga-gen --example ledgers";

#[test]
fn ledgers_are_those_of_the_code() {
    let mut stale = Vec::new();
    for source in Source::listed(&root()).unwrap() {
        let rows = source.rows(&root()).unwrap();
        assert!(!rows.is_empty(), "{} holds nothing", source.file.display());
        let kept = std::fs::read_to_string(source.path(&root())).unwrap_or_default();
        let differences = ledger::differences(&kept, &rows);
        stale.extend(differences.into_iter().map(|difference| format!("{}: {difference}", source.name)));
    }
    assert!(
        stale.is_empty(),
        "item: mul add neg div sqrt bytes\n{}\n{} lines of the ledgers are stale; if the change is meant: {COMMAND}",
        stale.join("\n"),
        stale.len()
    );
}

#[test]
fn every_kind_of_difference_is_told() {
    let row = |item: &str, mul| Row { item: item.into(), counts: [mul, 2, 0, 0, 0], bytes: 8 };
    let rows = [row("a*b", 3), row("a^b", 1)];
    let kept = ledger::text(&rows);
    assert_eq!(kept, format!("{}\na*b\t3\t2\t0\t0\t0\t8\na^b\t1\t2\t0\t0\t0\t8\n", ledger::HEADING));
    assert!(ledger::differences(&kept, &rows).is_empty());
    let changed = ledger::differences(&kept, &[row("a*b", 4), row("a|b", 1)]);
    assert_eq!(changed, ["a*b: 3 2 0 0 0 8 became 4 2 0 0 0 8", "a^b: 1 2 0 0 0 8 is gone", "a|b: 1 2 0 0 0 8 is new"]);
    let swapped = [row("a^b", 1), row("a*b", 3)];
    assert_eq!(ledger::differences(&kept, &swapped).len(), 1, "the order counts");
    assert_eq!(ledger::differences("", &rows).len(), 2);
}

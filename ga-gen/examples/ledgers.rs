//! Writes the ledgers that `ledger/sources.txt` lists: `cargo run -p ga-gen --example ledgers`.
//!
//! Prints what changed in them, one line an item.

use ga_gen::ledger::{self, Source};
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for source in Source::listed(&root)? {
        let (path, rows) = (source.path(&root), source.rows(&root)?);
        let kept = std::fs::read_to_string(&path).unwrap_or_default();
        for difference in ledger::differences(&kept, &rows) {
            println!("{}: {difference}", source.name);
        }
        std::fs::write(path, ledger::text(&rows))?;
    }
    Ok(())
}

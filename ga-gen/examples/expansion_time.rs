//! How long the expansion of the library's two algebras takes: `cargo run -p ga-gen --release --example expansion_time`.
//!
//! Prints milliseconds, the size of the expansion, and a hash of its text: a change to the generator that claims to
//! leave the output alone leaves the hash alone. Run from the root of the workspace.

use proc_macro2::TokenStream;
use quote::quote;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::time::Instant;

/// The minimum of this many runs is reported: the rest is the noise of the machine.
const REPEATS: usize = 3;

/// The tokens within the first `algebra!` of a file.
fn invocation(path: &str) -> Result<TokenStream, Box<dyn std::error::Error>> {
    let file = syn::parse_file(&std::fs::read_to_string(path)?)?;
    let found = file.items.into_iter().find_map(|item| match item {
        syn::Item::Macro(item) if item.mac.path.segments.last().is_some_and(|s| s.ident == "algebra") => {
            Some(item.mac.tokens)
        }
        _ => None,
    });
    found.ok_or_else(|| format!("{path} holds no `algebra!`").into())
}

fn report(name: &str, expand: impl Fn() -> syn::Result<TokenStream>) -> Result<(), Box<dyn std::error::Error>> {
    let mut best = f64::INFINITY;
    let mut text = String::new();
    for _ in 0..REPEATS {
        let start = Instant::now();
        let tokens = expand()?;
        best = best.min(start.elapsed().as_secs_f64());
        text = tokens.to_string();
    }
    let mut hasher = DefaultHasher::new();
    text.hash(&mut hasher);
    println!("{name:<4} {:>8.1} ms  {:>9} bytes of text  hash {:016x}", 1e3 * best, text.len(), hasher.finish());
    if let Some(directory) = std::env::args().nth(1) {
        std::fs::write(format!("{directory}/{name}.txt"), &text)?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (g3, cga) = (invocation("src/algebra/g3.rs")?, invocation("src/algebra/cga.rs")?);
    report("g3", || ga_gen::expand(g3.clone()))?;
    report("cga", || ga_gen::expand_with_base(quote!({ #g3 } #cga)))
}

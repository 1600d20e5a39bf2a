//! The library's two algebras, read from their sources.

use ga_gen::parse::Source;
use proc_macro2::TokenStream;
use std::path::PathBuf;

/// The tokens within the `algebra!` of `src/algebra/NAME.rs`.
pub(crate) fn tokens_of(name: &str) -> TokenStream {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("../src/algebra/{name}.rs"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let items = syn::parse_file(&text).unwrap().items;
    let found = items.into_iter().find_map(|item| match item {
        syn::Item::Macro(item) if item.mac.path.segments.last().is_some_and(|s| s.ident == "algebra") => {
            Some(item.mac.tokens)
        }
        _ => None,
    });
    found.unwrap_or_else(|| panic!("{} holds no `algebra!`", path.display()))
}

/// The same, parsed.
pub(crate) fn source_of(name: &str) -> Source {
    syn::parse2(tokens_of(name)).unwrap()
}

//! What generated code costs: the ledgers are those of the code, the kernels of inner loops stay below their ceilings, and
//! what is counted is what is emitted.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod ceilings;
mod emitted;
mod ledgers;
#[path = "../support/mod.rs"]
mod support;

/// The root of the workspace.
fn root() -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

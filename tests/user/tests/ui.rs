//! What users see: formulas in a third crate compile and run, and each kind of mistake is one sentence on the right token.
//!
//! `TRYBUILD=overwrite cargo test -p ga-physics-user` writes the expected messages anew.

#[test]
fn messages() {
    let cases = trybuild::TestCases::new();
    cases.pass("tests/ui/third_crate.rs");
    cases.compile_fail("tests/ui/fail/*.rs");
}

//! Every pass, every way of lowering and every schedule keep the meaning of what they rewrite: shown on random elements
//! of a prime field, against dense products in an orthonormal basis that share nothing with the generator.
//!
//! Over the field no digit is lost, so equality is exact: a wrong rewrite of degree d passes with probability d / 2^61.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod algebras;
mod dense;
mod elements;
mod evaluate;
mod formulas;
mod hunt;
mod interpret;
mod mutations;
mod operations;
mod plans;
mod precision;
#[path = "../support/mod.rs"]
mod support;

use operations::Check;

#[test]
fn every_operation_of_g3_by_every_plan() {
    let algebra = algebras::g3();
    let mut check = Check::new(&algebra);
    check.operations(|_, _| true);
    println!("{:?}", check.tally);
    assert!(check.tally.plans > 700 && check.tally.passes.len() == 8, "{:?}", check.tally);
}

#[test]
fn every_operation_of_small_algebras_by_every_plan() {
    for algebra in algebras::small() {
        let mut check = Check::new(&algebra);
        check.operations(|_, _| true);
        println!("{}: {:?}", algebra.name, check.tally);
        assert!(check.tally.plans > 100, "{:?}", check.tally);
    }
}

/// A third of the pairs of types: all of them by all plans take a minute.
#[test]
fn every_third_operation_of_cga_by_every_plan() {
    let algebra = algebras::cga();
    let mut check = Check::new(&algebra);
    check.operations(|i, j| (i + j) % 3 == 0 && !algebra.spec.is_full(i) && !algebra.spec.is_full(j));
    println!("{:?}", check.tally);
    assert!(check.tally.plans > 2000, "{:?}", check.tally);
}

#[test]
fn every_compiled_item() {
    for algebra in algebras::small().into_iter().chain([algebras::g3(), algebras::cga()]) {
        let mut check = Check::new(&algebra);
        let items = check.items();
        println!("{}: {} items of {} operations", algebra.name, items.len(), operations::operations_of(&algebra));
    }
}

/// All plans of the small ones; the conformal rotors have some thousand.
const MOST_PLANS: usize = 24;

#[test]
fn formulas_by_every_plan_in_every_frame() {
    let (mut tally, mut random) = (formulas::Tally::default(), elements::Random(4));
    let small = algebras::small();
    let cases =
        [(&algebras::g3(), &formulas::G3[..]), (&algebras::cga(), &formulas::CGA), (&small[2], &formulas::MIXED)];
    for (algebra, texts) in cases {
        for text in texts {
            formulas::check(algebra, text, MOST_PLANS, &mut random, &mut tally);
        }
    }
    println!("{tally:?}");
    assert!(tally.frames > 45 && tally.plans > 150 && tally.programs > 1000, "{tally:?}");
}

/// What would not be noticed in a value is not tested by it: every turned sign must be.
#[test]
fn every_turned_sign_is_noticed() {
    let (mut mutants, mut survivors) = (0, vec![]);
    for (algebra, texts) in [(algebras::g3(), &formulas::G3[..]), (algebras::cga(), &formulas::CGA)] {
        for text in texts {
            let (count, missed) = mutations::survivors(&algebra, text);
            mutants += count;
            survivors.extend(missed);
        }
    }
    println!("{mutants} mutants");
    assert!(survivors.is_empty() && mutants > 1000, "of {mutants}: {survivors:#?}");
}

/// The library's formulas, as they are compiled into it.
#[test]
fn formulas_of_the_library() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../src");
    let found = ga_gen::inspect::load(&root.join("geometry/formulas.rs"), Some(&root.join("algebra/cga.rs"))).unwrap();
    assert!(found.formulas.len() > 10, "{}", found.formulas.len());
    let algebra = algebras::cga();
    let oracle = dense::Oracle::new(&algebra.spec);
    for (_, compiled) in &found.formulas {
        let name = &compiled.formula.source.header.name;
        assert!(formulas::agrees(&algebra, &oracle, compiled, &mut elements::Random(3)), "{name}");
    }
}

/// Random formulas over each algebra. More of them: `HUNT=10000 cargo test -p ga-gen --test meaning random`.
#[test]
fn random_formulas_agree_with_the_dense_value() {
    let more = std::env::var("HUNT").ok().and_then(|count| count.parse().ok());
    for algebra in algebras::small().into_iter().chain([algebras::g3(), algebras::cga()]) {
        let cases = more.unwrap_or(if algebra.name == "cga" { 40 } else { 120 });
        for depth in [2, 3, 4] {
            let (equal, refused) =
                hunt::hunt(&algebra, cases, depth, 0x5851_f42d_4c95_7f2d + u64::try_from(depth).unwrap());
            println!("{}, depth {depth}: {equal} equal, {refused} refused", algebra.name);
            assert!(equal > cases / 3, "{}: only {equal} of {cases} have a value", algebra.name);
        }
    }
}

/// Every pass keeps the sum of the sizes of all terms, or makes it smaller.
#[test]
fn no_pass_brings_in_terms_that_cancel() {
    let mut random = elements::Random(21);
    let mut grown = Vec::new();
    for (algebra, texts) in [(algebras::g3(), &formulas::G3[..]), (algebras::cga(), &formulas::CGA)] {
        texts.iter().for_each(|text| grown.extend(precision::growth(&algebra, text, &mut random)));
    }
    assert!(grown.is_empty(), "{}", grown.join("\n"));
}

/// Errors after factoring may be other ones, not larger ones.
const MORE_ERROR: f64 = 2.0;

#[test]
fn factoring_loses_no_digits() {
    let (algebra, mut random) = (algebras::cga(), elements::Random(22));
    println!("{:>8} {:>8}  worst errors before and after factoring, in epsilons of the sum of sizes", "", "");
    for text in formulas::CGA {
        let [before, after] = precision::errors(&algebra, text, &mut random);
        println!("{before:>8.2} {after:>8.2}  {text}");
        assert!(before > 0.0 && after <= (MORE_ERROR * before).max(1.0), "{text}: {before} before, {after} after");
    }
}

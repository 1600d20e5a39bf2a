//! The same source gives the same code, and an operation's program does not depend on what is declared before it.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use ga_gen::formula;
use ga_gen::header;
use ga_gen::inspect;
use ga_gen::parse::Source;
use ga_gen::program::Program;
use ga_gen::spec::Spec;
use quote::quote;
use std::collections::BTreeMap;
use support::{source_of, tokens_of};

#[test]
fn the_same_tokens_expand_to_the_same_tokens() {
    let (g3, cga) = (tokens_of("g3"), tokens_of("cga"));
    let expand = || {
        let base = ga_gen::expand(g3.clone()).unwrap().to_string();
        (base, ga_gen::expand_with_base(quote!({ #g3 } #cga)).unwrap().to_string())
    };
    let (first, second) = (expand(), expand());
    assert!(first.0 == second.0, "two expansions of g3 differ");
    assert!(first.1 == second.1, "two expansions of cga differ");
}

/// Every operation's program, by its name. The type of the result is left out: ties go to the first declared.
fn programs(base: Option<&Source>, own: &Source) -> BTreeMap<String, Program> {
    let base = base.map(|base| Spec::new(base, None).unwrap());
    let spec = Spec::new(own, base.as_ref()).unwrap();
    inspect::items(&spec).unwrap().into_iter().map(|item| (item.name, item.program)).collect()
}

fn compare(first: &BTreeMap<String, Program>, second: &BTreeMap<String, Program>, change: &str) {
    let names: Vec<_> = first.keys().collect();
    assert_eq!(names, second.keys().collect::<Vec<_>>(), "{change}: other operations exist");
    for (name, program) in first {
        assert_eq!(Some(program), second.get(name), "{change}: {name}");
    }
}

#[test]
fn programs_do_not_depend_on_the_order_of_declaration() {
    let (g3, cga) = (source_of("g3"), source_of("cga"));
    let (base, own) = (programs(None, &g3), programs(Some(&g3), &cga));
    assert!(own.len() > 1500, "only {} operations", own.len());
    let mut backwards = (g3.clone(), cga.clone());
    for source in [&mut backwards.0, &mut backwards.1] {
        source.types.reverse();
    }
    compare(&base, &programs(None, &backwards.0), "g3 backwards");
    compare(&own, &programs(Some(&backwards.0), &backwards.1), "cga backwards");
    let mut turned = cga;
    let half = turned.types.len() / 2;
    turned.types.rotate_left(half);
    compare(&own, &programs(Some(&g3), &turned), "cga, its second half first");
}

/// With sandwiches, products in the split basis, words of factors, quotients, roots, and frames to choose from.
const FORMULAS: [&str; 5] = [
    "fn f(a: Point, b: Point, c: Point, d: Point) -> Sphere { (a ^ b ^ c ^ d).dual().normalised() }",
    "fn f(v: ConformalRotor, w: Motor, x: Point) -> Point { (v * w).apply(x).normalised() }",
    "fn f(a: Pose, b: Pose, x: Point) -> (Pose, Point) { let c: Pose = a * b.rev(); (c, c.apply(x)) }",
    "fn f(a: Circle, x: Point) -> Round { (a * x * a).grade(1) }",
    "fn f(a: Sphere, b: Sphere) -> Scalar { (a | b) / (a.rho_sq * b.rho_sq).sqrt() }",
];

fn formula_programs(spec: &Spec) -> Vec<(Program, String)> {
    let compile = |text: &&str| {
        let source = header::Source::new(quote!(cga), text.parse().unwrap()).unwrap();
        let compiled = formula::compile(spec, &ga_gen::read::read(spec, &source).unwrap()).unwrap();
        let code = ga_gen::emit::formula_function(spec, &compiled).to_string();
        (compiled.program, code)
    };
    FORMULAS.iter().map(compile).collect()
}

#[test]
fn formulas_depend_neither_on_the_run_nor_on_the_order_of_declaration() {
    let (g3, cga) = (source_of("g3"), source_of("cga"));
    let spec = |base: &Source, own: &Source| Spec::new(own, Some(&Spec::new(base, None).unwrap())).unwrap();
    let first = formula_programs(&spec(&g3, &cga));
    assert!(first == formula_programs(&spec(&g3, &cga)), "the same again");
    let mut backwards = (g3, cga);
    backwards.0.types.reverse();
    backwards.1.types.reverse();
    assert!(first == formula_programs(&spec(&backwards.0, &backwards.1)), "with the types declared backwards");
}

//! Which formulas are evaluated in a local frame without being asked, and that large ones end.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use ga_gen::formula::{self, Compiled};
use ga_gen::header::{Frame, Source};
use ga_gen::spec::Spec;
use quote::quote;
use support::source_of;

fn cga() -> Spec {
    Spec::new(&source_of("cga"), Some(&Spec::new(&source_of("g3"), None).unwrap())).unwrap()
}

fn compile(spec: &Spec, text: &str) -> syn::Result<Compiled> {
    let source = Source::new(quote!(cga), text.parse().unwrap())?;
    formula::compile(spec, &ga_gen::read::read(spec, &source)?)
}

fn frame(spec: &Spec, text: &str) -> Option<String> {
    let compiled = compile(spec, text).unwrap_or_else(|error| panic!("{text}: {error}"));
    match compiled.formula.source.options.frame {
        Frame::World => None,
        Frame::Local(name) | Frame::Relative(name) => Some(name.to_string()),
    }
}

/// Each holds something that is tied to the origin, and that moves the value.
#[test]
fn what_is_tied_to_the_origin_is_evaluated_in_the_world() {
    let cga = cga();
    for text in [
        "fn f(a: Point, b: Point, c: Point) -> Round { (a ^ b ^ c ^ no).dual() }",
        "fn f(a: Point, b: Point, c: Point) -> Round { (a ^ b ^ c ^ Origin).dual() }",
        "fn f(a: Point, b: Point) -> Scalar { (a | no) + (a | b) }",
        "fn f(a: Point, b: Point) -> Circle { a ^ b ^ e1 }",
        "fn f(a: Point, b: Point, u: Vector) -> Circle { a ^ b ^ u }",
        "fn f(a: Point, b: Point, u: Vector) -> Scalar { ((a - b) | (a - b)) * (a | u) }",
        "fn f(a: Point, b: Point, r: Rotor) -> Round { r.apply(a) - b }",
        "fn f(a: Point, b: Point) -> Scalar { (a | b) * b.e1 }",
        "fn f(a: Point, b: Point) -> Scalar { (a | b) * a.x }",
        "fn f(a: Point, b: Point) -> Round { a + no * (a | b) }",
    ] {
        assert_eq!(frame(&cga, text), None, "{text}");
    }
}

/// The same with nothing tied to the origin: what the test above would say if no frame were ever taken.
#[test]
fn what_moves_along_is_evaluated_in_a_frame() {
    let cga = cga();
    for text in [
        "fn f(a: Point, b: Point, c: Point, d: Point) -> Round { (a ^ b ^ c ^ d).dual() }",
        "fn f(a: Point, b: Point, c: Point, d: Point) -> Sphere { (a ^ b ^ c ^ d).dual().normalised() }",
        // A free vector moves along as a direction, and a plane as it is.
        "fn f(a: Point, b: Point, c: Point, u: Vector) -> Scalar { (a ^ b ^ (u ^ ninf)) | (a ^ b ^ c ^ ninf) }",
        "fn f(a: Point, u: Vector, p: Plane) -> FinitePoint { (p | (a ^ (u ^ ninf))).normalised() }",
    ] {
        assert!(frame(&cga, text).is_some(), "{text}");
    }
}

/// `m.apply(m.apply(.. x))`
fn sandwiches(count: usize, versor: &str) -> String {
    let body = format!("{}x{}", "m.apply(".repeat(count), ")".repeat(count));
    format!("fn f(m: {versor}, x: Point) -> Multivector {{ {body} }}")
}

fn products(count: usize) -> String {
    let names: Vec<String> = (0..count).map(|index| format!("p{index}")).collect();
    let parameters: Vec<String> = names.iter().map(|name| format!("{name}: Multivector")).collect();
    format!("fn f({}) -> Multivector {{ {} }}", parameters.join(", "), names.join(" * "))
}

/// Points of choice and terms are capped: these would take for ever by all plans, or with all pairs of terms looked at.
#[test]
fn monstrous_formulas_end() {
    let cga = cga();
    let sum = vec!["a"; 150].join(" + ");
    let formulas = [
        (products(6), 10_000),
        (sandwiches(30, "Motor"), 1000),
        (sandwiches(30, "Pose"), 1000),
        (sandwiches(6, "ConformalRotor"), 400),
        (format!("fn f(a: Multivector) -> Multivector {{ {sum} }}"), 32),
        (format!("fn f(a: Vector) -> Vector {{ {}a{} }}", "(".repeat(100), ")".repeat(100)), 0),
    ];
    for (text, least) in formulas {
        let counts = compile(&cga, &text).unwrap_or_else(|error| panic!("{error}: {text}")).program.counts();
        println!("{:>6} operations: {:.60}", counts.operations(), text);
        assert!(counts.operations() >= least, "{counts:?}: {text}");
    }
}

/// Each step stands on the one before.
#[test]
fn long_chains_of_steps_end() {
    let steps: String = (0..1000).map(|_| "let a = a + (a | b) * b; ").collect();
    let text = format!("fn f(a: Vector, b: Vector) -> Vector {{ {steps} a }}");
    let counts = compile(&cga(), &text).unwrap_or_else(|error| panic!("{error}")).program.counts();
    println!("{} operations", counts.operations());
    assert!(counts.operations() >= 1000, "{counts:?}");
}

/// A sum of a thousand terms is as deep as it is long.
#[test]
fn deep_expressions_are_refused() {
    let text = format!("fn f(a: Vector) -> Vector {{ {} }}", vec!["a"; 1000].join(" + "));
    let error = compile(&cga(), &text).err().expect("too deep").to_string();
    assert!(error.contains("name a part of it with `let`"), "{error}");
}

/// Numbers that grow without end are refused, not wrapped.
#[test]
fn numbers_that_grow_without_end_are_refused() {
    let cga = cga();
    let text = format!("fn f(a: Vector) -> Vector {{ {} a }}", "2147483647 * ".repeat(9));
    let error = compile(&cga, &text).err().expect("no constant of 32 bits").to_string();
    assert!(error.contains("constants of generated code have 32 bits"), "{error}");
}

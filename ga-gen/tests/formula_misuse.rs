//! What `#[formula]` says to each kind of mistake: a sentence, on the token at fault.
//!
//! The token at fault stands between `<<` and `>>` in the source of each case.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use proc_macro2::TokenStream;

/// G(3,0) with a vector, a bivector and a rotor: what most cases stand on.
const G3: &str = "pub algebra g; basis e1 = 1, e2 = 1, e3 = 1; pseudoscalar e123; type V = [e1, e2, e3]; \
                  type B = [e23, e31, e12]; type R: unit + versor = [s, e23, e31, e12]; type Unit = e1;";
/// A conformal line: a null pair, a free vector, a general one.
const LINE: &str = "pub algebra g; basis e1 = 1, null pair (no, ninf) = -1; type P = x*e1 + no + x*x/2*ninf; \
                    type Infinity = ninf; type Origin = no; type V = [e1]; type W = [e1, no, ninf];";

fn expand(algebra: &str, formula: &str) -> syn::Result<TokenStream> {
    let source = format!("{formula} @ {{ {algebra} }}");
    let tokens: TokenStream = source.parse().unwrap();
    // The chain stands first; in the text it stands last, so that columns are those of the formula.
    let mut trees: Vec<_> = tokens.into_iter().collect();
    let chain = trees.pop().unwrap();
    trees.pop();
    ga_gen::expand_formula([chain].into_iter().chain(trees).collect())
}

/// Each formula is refused with a sentence that holds the words, on the marked token.
fn refused(algebra: &str, cases: &[(&str, &str)]) {
    for (marked, words) in cases {
        let start = marked.find("<<").unwrap();
        let source = marked.replacen("<<", "", 1);
        let end = source.find(">>").unwrap();
        let source = source.replacen(">>", "", 1);
        let error = expand(algebra, &source).expect_err(marked);
        let text = error.to_string();
        assert!(text.contains(words), "{marked}\n`{text}` does not say `{words}`");
        let span = error.span();
        assert_eq!((span.start().line, span.end().line), (1, 1), "{marked}\n{text}");
        let found = &source[span.start().column..span.end().column];
        assert_eq!((span.start().column, span.end().column), (start, end), "{marked}\n`{text}` stands on `{found}`");
    }
}

#[test]
fn correct_formulas_expand() {
    for (algebra, formula) in [
        (G3, "(g) pub fn f(a: V, b: V) -> B { a ^ b }"),
        (G3, "(crate::g,) fn f(a: V, b: V) -> Scalar { (a | b) / (a.norm_sq() * b.norm_sq()).sqrt() }"),
        (G3, "(g, dynamic = g) fn f(a: V, b: V) -> (B, Scalar) { let c = a ^ b; (c, 0.25 * c.norm_sq() - a.e1 / 2) }"),
        (G3, "(g) fn f(a: V, k: Scalar) -> V { let b: V = other(a, k * a, 2); let a = b; a + b }"),
        (G3, "(g) fn f(a: V, k: Scalar) -> V { let (b, c): (V, Scalar) = other(a, k); b * c }"),
        (G3, "(g) fn f(a: V) -> V { other(a) }"),
        (G3, "(g) fn f(a: R, b: V) -> V { a.apply(b - 1/2 * e2) + Unit }"),
        (G3, "(g) fn f(norm: V) -> V { norm.normalised() }"),
        (LINE, "(g, local = a) fn f(a: P, b: P) -> W { (a + b) / 2 }"),
        (LINE, "(g, relative = a) fn f(a: P, b: P) -> W { b - (a | b) * Infinity }"),
        // A free vector is left as it is, and what is made of it does not depend on the origin.
        (LINE, "(g, local = a) fn f(a: P, b: P, v: V) -> Scalar { (v ^ ninf) | (a ^ b) }"),
        (LINE, "(g) fn f(_a: Infinity) -> Infinity { ninf }"),
    ] {
        let tokens = expand(algebra, formula).unwrap_or_else(|error| panic!("{formula}\n{error}"));
        syn::parse2::<syn::File>(tokens).unwrap_or_else(|error| panic!("{formula}\n{error}"));
    }
}

#[test]
fn options() {
    refused(
        LINE,
        &[
            ("(<<local>> = a) fn f(a: P) -> P { a }", "name the module of the algebra first"),
            ("(g, <<locl>> = a) fn f(a: P) -> P { a }", "no option `locl`; there are `local = a`"),
            ("(g, local = a, <<local>> = a) fn f(a: P) -> P { a }", "option `local` stands twice"),
            ("(g, local = a, <<relative>> = a) fn f(a: P) -> P { a }", "one frame: `local` or `relative`"),
            ("(g, dynamic = a, <<dynamic>> = b) fn f(a: P) -> P { a }", "option `dynamic` stands twice"),
            ("(g, local = <<c>>) fn f(a: P) -> P { a }", "no parameter `c`"),
            ("(g, local = <<v>>) fn f(a: P, v: V) -> P { a }", "`v` is no normalised point"),
            ("(g) <<struct>> S;", "a formula is a function"),
        ],
    );
    refused(G3, &[("(g, local = <<a>>) fn f(a: V) -> V { a }", "a local frame needs a null pair")]);
}

#[test]
fn signatures() {
    refused(
        G3,
        &[
            ("(g) <<const>> fn f(a: V) -> V { a }", "not `const`"),
            ("(g) <<async>> fn f(a: V) -> V { a }", "not `async`"),
            ("(g) <<unsafe>> fn f(a: V) -> V { a }", "neither `unsafe`"),
            ("(g) fn f< <<T>> >(a: V) -> V { a }", "leave the generics out"),
            ("(g) fn f(<<self>>, a: V) -> V { a }", "it has no `self`"),
            ("(g) fn f(a: <<&V>>) -> V { a }", "leave `&` out"),
            ("(g) fn f(<<mut>> a: V) -> V { a }", "leave `mut` out"),
            ("(g) fn f(<<(a, b)>>: V) -> V { a }", "no patterns"),
            ("(g) fn f(a: V, <<a>>: V) -> V { a }", "parameter `a` stands twice"),
            ("(g) fn f(a: <<g::V>>) -> V { a }", "the bare name of a type"),
            ("(g) fn f(a: <<[V; 2]>>) -> V { a }", "one of the algebra, by name, or `Scalar`"),
            ("(g) fn f(a: <<f64>>) -> V { a }", "is a `Scalar`, not `f64`"),
            ("(g) fn f(a: <<Nope>>) -> V { a }", "no type `Nope` in the algebra `g`; there are V, B, R"),
            ("(g) fn f(a: V) -> <<v>> { a }", "did you mean `V`?"),
            ("(g) fn <<f>>(a: V) { a }", "say what this formula returns"),
            ("(g) fn f(a: V) -> <<()>> { a }", "a formula has a result"),
            ("(g) fn f(a: V) -> V <<where>> V: Copy { a }", "leave the `where` clause out"),
        ],
    );
}

#[test]
fn rust_that_is_no_formula() {
    refused(
        G3,
        &[
            ("(g) fn f(a: V) -> V { <<if a { a } else { a }>> }", "no branches"),
            ("(g) fn f(a: V) -> V { <<match a { _ => a }>> }", "no branches"),
            ("(g) fn f(a: V) -> V { let b = <<loop {}>>; b }", "no loops"),
            ("(g) fn f(a: V) -> V { <<for i in a {}>> }", "no loops"),
            ("(g) fn f(a: V) -> V { a * <<|x| x>> }", "no closures"),
            ("(g) fn f(a: V) -> V { a + <<{ a }>> }", "no blocks"),
            ("(g) fn f(a: V) -> V { a + <<m!()>> }", "no macros"),
            ("(g) fn f(a: V) -> V { <<m!();>> a }", "no macros"),
            ("(g) fn f(a: V) -> V { <<&a>> }", "leave `&` out"),
            ("(g) fn f(a: V) -> V { <<return a>> }", "without `return`"),
            ("(g) fn f(a: V) -> V { <<a?>> }", "cannot fail"),
            ("(g) fn f(a: V) -> V { <<a = a>> }", "nothing changes"),
            ("(g) fn f(a: V) -> V { <<a as f64>> }", "no `as`"),
            ("(g) fn f(a: V) -> V { <<a[0]>> }", "no arrays"),
            ("(g) fn f(a: V) -> V { <<V { e1: 1 }>> }", "no struct literals"),
            ("(g) fn f(a: V) -> V { let <<mut>> b = a; b }", "leave `mut` out"),
            ("(g) fn f(a: V) -> V { <<let b;>> a }", "has a value"),
            ("(g) fn f(a: V) -> V { <<fn g() {}>> a }", "no items"),
            ("(g) fn f(a: V) -> V { <<a + a>>; a }", "nothing uses this value"),
            ("(g) fn f(a: V) -> V { <<!>>a }", "there is the minus only"),
            ("(g) fn f(a: V) -> V { a <<%>> a }", "no such operator"),
            ("(g) fn f(a: V) -> V { <<\"text\">> }", "a formula has integers"),
            ("(g) fn f(a: V) -> V { a<<;>> }", "a formula ends with its result"),
            ("(g) fn <<f>>(a: V) -> V { }", "a formula ends with its result"),
            ("(g) fn f(a: V) -> V { <<let b = a;>> }", "a formula ends with its result"),
        ],
    );
}

#[test]
fn names_and_numbers() {
    refused(
        G3,
        &[
            ("(g) fn f(first: V) -> V { <<fist>> }", "did you mean `first`?"),
            ("(g) fn f(a: V) -> V { a + <<e4>> }", "did you mean `e1`?"),
            ("(g) fn f(a: V) -> V { a + <<B>> }", "`B` is a type with stored numbers"),
            ("(g) fn f(a: V) -> V { a * <<std::f64::consts::PI>> }", "by their bare names"),
            ("(g) fn f(a: V) -> V { a.<<normalized>>() }", "did you mean `normalised`?"),
            ("(g) fn f(a: V) -> V { a.<<rev>>(1) }", "`rev` takes nothing in brackets"),
            ("(g) fn f(a: V) -> V { a.<<apply>>() }", "`apply` takes one multivector"),
            ("(g) fn f(a: V) -> V { a.grade(<<a>>) }", "the grade is a number"),
            ("(g) fn f(a: V) -> Scalar { a.<<e4>> }", "`V` has no component `e4`; did you mean `e1`?"),
            ("(g) fn f(a: V) -> Scalar { a.<<e12>> }", "`V` has no component `e12`"),
            ("(g) fn f(a: V) -> Scalar { (a * a).<<x>> }", "give the value a type"),
            ("(g) fn f(a: V, b: V) -> Scalar { (a ^ b).<<e1>> }", "identically zero: it has the blades e12"),
            ("(g) fn f(k: Scalar) -> Scalar { k.<<e1>> }", "a scalar has no components"),
            ("(g) fn f(a: V) -> Scalar { a.<<0>> }", "components have names"),
            ("(g) fn f(a: V) -> V { a + <<h>>(a) }", "say what this call returns"),
            ("(g) fn f(a: V) -> V { let b = <<h>>(a); b }", "say what this call returns"),
            ("(g) fn f(a: V) -> V { <<0.5f32>> * a }", "leave `f32` out"),
            ("(g) fn f(a: V) -> V { <<1e-3>> * a }", "without exponent"),
            ("(g) fn f(a: V) -> V { <<99999999999>> * a }", "go up to 2147483647"),
            ("(g) fn <<f>>(a: V) -> V { 2147483647 * 2147483647 * a }", "the number 4611686014132420609"),
            ("(g) fn f(a: V) -> V { a / <<0>> }", "division by zero"),
            ("(g) fn f(a: V) -> V { a / <<(1 - 1)>> }", "division by zero"),
        ],
    );
}

#[test]
fn operators() {
    let brackets = "put brackets round this";
    refused(
        G3,
        &[
            ("(g) fn f(a: V, b: V, c: V) -> B { a ^ b <<+>> c }", brackets),
            ("(g) fn f(a: V, b: V, c: V) -> B { a <<+>> b ^ c }", brackets),
            ("(g) fn f(a: V, b: V, c: V) -> V { a | b <<^>> c }", brackets),
            ("(g) fn f(a: B, b: B, c: V) -> V { a <<&>> b | c }", brackets),
            ("(g) fn f(a: V, b: V) -> V { a / <<b>> }", "the divisor is no scalar: it has the blades e1, e2, e3"),
            ("(g) fn f(a: V, b: V) -> V { a / <<((b ^ b) | a)>> }", "the divisor is identically zero"),
            ("(g) fn f(a: V, b: V) -> V { (a * b).<<sqrt>>() * a }", "what stands under this root is no scalar"),
            ("(g) fn f(a: V) -> V { a * (1 - 5).<<sqrt>>() }", "the root of -4"),
        ],
    );
    let degenerate = "pub algebra g; basis e0 = 0, e1 = 1; pseudoscalar e01; type V = [e0, e1]; ";
    refused(
        degenerate,
        &[("(g) fn f(a: V) -> V { a.<<dual>>() }", "`g` has no dual: its pseudoscalar squares to 0. `&` is there")],
    );
    refused(
        &degenerate.replace("pseudoscalar e01;", ""),
        &[
            ("(g) fn f(a: V) -> V { a.<<undual>>() }", "a dual needs a pseudoscalar, and `g` declares none"),
            ("(g) fn f(a: V, b: V) -> Scalar { a <<&>> b }", "the meet needs a pseudoscalar, and `g` declares none"),
        ],
    );
    refused(
        "pub algebra g; basis e1 = 1, e2 = -1; type V = [e1, e2];",
        &[("(g) fn f(a: V) -> V { let u = a.<<normalised>>(); u + a }", "the sign of the square of this is not known")],
    );
}

#[test]
fn results() {
    refused(
        G3,
        &[
            (
                "(g) fn f(a: V, b: V) -> <<V>> { a ^ b }",
                "`V` does not hold the result: it has the blades e12, e13, e23",
            ),
            ("(g) fn f(a: V, b: V) -> V { let c: <<V>> = a ^ b; c }", "`V` does not hold the result"),
            ("(g) fn f(a: V) -> B { <<a ^ a>> }", "identically zero"),
            ("(g) fn f(a: V) -> V { <<a.grade(7)>> }", "identically zero"),
            ("(g) fn f(a: V) -> Scalar { <<a ^ a>> }", "identically zero"),
            ("(g) fn f(a: V, b: V) -> <<Scalar>> { a * b }", "the result is no scalar: it has the blades s, e12"),
            ("(g) fn f(a: V) -> Scalar { <<(a | a).normalised()>> }", "a scalar is not normalised"),
            ("(g) fn f(a: R, b: R) -> <<R>> { a + b }", "what the type states of its coefficients is not proved"),
            ("(g) fn f(a: V) -> (V, V) { <<a>> }", "declared as a tuple"),
            ("(g) fn f(a: V) -> (V, V) { <<(a, a, a)>> }", "2 results are declared, here are 3"),
            ("(g) fn f(a: V) -> V { <<(a, a)>> }", "tuples only as its result"),
            ("(g) fn f(a: V, b: V) -> (V, <<B>>) { (a, a * b) }", "`B` does not hold the result"),
        ],
    );
    refused(
        LINE,
        &[("(g) fn f(a: P, b: P) -> P { <<(a - b).normalised()>> }", "the weight of the result is identically zero")],
    );
}

/// A frame is taken only where it is proved to change nothing.
#[test]
fn frames() {
    let tied = "cannot be evaluated with `local = a`: ";
    refused(
        LINE,
        &[
            ("(g, local = a) fn f(a: P) -> W { a + <<no>> }", &format!("{tied}`no` is tied to the origin")),
            ("(g, local = a) fn f(a: P) -> W { a + <<Origin>> }", &format!("{tied}`Origin` is tied to the origin")),
            ("(g, local = a) fn f(a: P) -> W { ninf * a.<<x>> }", "`x` is tied to the origin"),
            ("(g, local = a) fn f(a: P, <<v>>: V) -> W { a + v }", "`v` is tied to the origin"),
            ("(g, relative = a) fn f(a: P, b: P) -> W { b + 2 * <<e1>> + no }", "`e1`, `no` are tied to the origin"),
            // Deep within, and named once though it stands twice.
            (
                "(g, local = a) fn f(a: P, b: P) -> Scalar { (a | (b ^ <<no>>)) | (a + no) }",
                "`no` is tied to the origin",
            ),
            ("(g, local = a) fn f(a: P, b: P) -> W { let c = (a | b) * <<e1>>; a + c }", "`e1` is tied to the origin"),
            // A free vector is none within a product with a point.
            ("(g, local = a) fn f(a: P, b: P, <<v>>: V) -> Scalar { (a | v) + (a | b) }", "`v` is tied to the origin"),
            ("(g, relative = b) fn f(a: P, b: P) -> Scalar { (a | b) * b.<<x>> }", "`x` is tied to the origin"),
        ],
    );
}

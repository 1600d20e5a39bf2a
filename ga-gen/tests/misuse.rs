//! What `algebra!` says to each kind of mistake: a sentence, on the token at fault.
//!
//! The token at fault stands between `<<` and `>>` in the source of each case.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use proc_macro2::TokenStream;

/// G(3,0) with a vector, a bivector and a rotor: what most cases stand on.
const G3: &str = "pub algebra a; basis e1 = 1, e2 = 1, e3 = 1; pseudoscalar e123; type V = [e1, e2, e3]; \
                  type B = [e23, e31, e12]; type R: unit + versor = [s, e23, e31, e12]; ";
/// A conformal line: a null pair.
const LINE: &str = "pub algebra a; basis e1 = 1, null pair (no, ninf) = -1; type P = x*e1 + no + x*x/2*ninf; \
                    type N = ninf; type O = no; ";

/// The text of the fault in a source, after checking that it stands on the marked token.
fn fault(marked: &str) -> String {
    let start = marked.find("<<").unwrap();
    let source = marked.replacen("<<", "", 1);
    let end = source.find(">>").unwrap();
    let source = source.replacen(">>", "", 1);
    let tokens: TokenStream = source.parse().unwrap();
    let error = ga_gen::expand(tokens).expect_err(marked);
    let span = error.span();
    assert_eq!((span.start().line, span.end().line), (1, 1));
    let found = &source[span.start().column..span.end().column];
    assert_eq!((span.start().column, span.end().column), (start, end), "{marked}\n`{error}` stands on `{found}`");
    error.to_string()
}

/// `given` and each case together are refused with a sentence that holds the words.
fn refused(given: &str, cases: &[(&str, &str)]) {
    for (case, words) in cases {
        let text = fault(&format!("{given}{case}"));
        assert!(text.contains(words), "{case}\n`{text}` does not say `{words}`");
    }
}

#[test]
fn the_cases_stand_on_correct_algebras() {
    for correct in [G3, LINE] {
        ga_gen::expand(correct.parse().unwrap()).unwrap();
    }
}

#[test]
fn blades() {
    refused(
        G3,
        &[
            ("type W = [e1, <<e9>>];", "`e9` is no basis blade; the basis vectors are e1, e2, e3"),
            ("type W = [<<e11>>];", "`e11` is no basis blade"),
            ("type W = x*e1 + y*<<e9>>;", "`e9` is no basis blade"),
            ("type W = [e1, e2, <<e1>>];", "blade `e1` stands twice"),
            ("type W = [e12, <<e21>>];", "blade `e21` stands twice"),
            ("type <<W>> = [];", "no blade"),
            ("type <<W>> = 0;", "no blade"),
            ("type <<W>> = x*e1 - x*e1;", "no blade"),
            ("type <<W>> = e2 + x*e1 - x*e1;", "the number `x` of this type cancels"),
            ("type W = <<e1 * e2>>;", "a coefficient is a polynomial in the fields, times one basis blade"),
            ("type W = <<f(x)>>;", "a type is a sum like"),
        ],
    );
    refused(
        "pub algebra a; ",
        &[
            ("basis p1 = 1, p2 = 1; pseudoscalar <<p12>>;", "all of them together are named like p1_p2"),
            ("basis e1 = 1, <<e2>>;", "what does `e2` square to? Write `e2 = 1`"),
        ],
    );
}

#[test]
fn numbers() {
    refused(
        G3,
        &[
            ("type W = [e1 = <<1.5>>, e2];", "write 1/2 for a half"),
            ("type W = [e1 = <<0>>, e2];", "leave `e1` out"),
            ("type W = x*e1 / <<0>>;", "only division by a number other than zero"),
            ("type W = x*e1 / <<y>>;", "only division by a number other than zero"),
            ("type W = [e1 = <<99999999999>>];", "integers here go up to 2147483647"),
            ("type <<W>> = [e1 = 2147483647, e2];", "2147483647 is too large"),
            // Beyond 128 bits, and below their reciprocal.
            ("type <<W>> = 2147483647*2147483647*2147483647*2147483647*2147483647*e1;", "too large"),
            ("type <<W>> = x/2147483647/2147483647/2147483647/2147483647/2147483647*e1;", "too large"),
        ],
    );
}

#[test]
fn facts() {
    refused(
        G3,
        &[
            ("type W: <<nice>> = [e1];", "unknown fact `nice`; there are `unit` and `versor`"),
            ("type <<W>>: versor = [s, e12];", "a versor type is `unit + versor`"),
            ("type <<W>>: unit + versor = [s, e12, e23];", "`unit` is for even versors that form a group"),
            ("type <<W>>: unit = [e1, e123];", "`unit` is for even versors that form a group"),
            ("type <<W>>: unit = [e12];", "`unit` is for even versors that form a group"),
            ("type <<W>>: unit = [e1 = 3];", "`unit` contradicts the constants"),
            ("type <<W>>: unit + versor = [s = 2, e12];", "`unit` contradicts the constants"),
            ("type <<W>>: unit = x*e1 + 2*e2;", "`unit` contradicts the constants"),
        ],
    );
}

#[test]
fn names() {
    refused(
        G3,
        &[
            ("type <<V>> = [e1];", "type `V` is declared twice"),
            ("type <<T>> = [e1];", "`T` means something else"),
            ("type <<Scalar>> = [e1];", "`Scalar` means something else"),
        ],
    );
}

#[test]
fn metric() {
    refused(
        "pub algebra a; basis e1 = 1; ",
        &[
            ("basis <<e1>> = 1;", "basis vector `e1` is already taken"),
            ("basis <<s>> = 1;", "basis vector `s` is already taken"),
            ("basis e2 = <<2>>;", "a basis vector squares to 1, -1 or 0"),
            ("basis e2 = -<<2>>;", "a basis vector squares to 1, -1 or 0"),
            ("basis e2 = <<999999999999999999999999999999999999999999>>;", "a basis vector squares to 1, -1 or 0"),
            ("basis null pair (a, <<a>>) = -1;", "basis vector `a` is already taken"),
            ("basis null pair (<<e1>>, b) = -1;", "basis vector `e1` is already taken"),
            ("basis null pair (a, b) = <<0>>;", "a null pair has inner product 1 or -1"),
            ("basis null pair (a, b) = <<3>>;", "a basis vector squares to 1, -1 or 0"),
            ("basis <<e12>> = 1;", "`e12` reads like a blade"),
            ("basis <<e1_e2>> = 1;", "`e1_e2` reads like a blade"),
            ("basis <<r#fn>> = 1;", "`r#fn` reads like a blade"),
            ("basis e2 = 1, e3 = 1, e4 = 1, e5 = 1, e6 = 1, <<e7>> = 1;", "more than 6 basis vectors"),
            ("basis e2 = 1, e3 = 1, e4 = 1, e5 = 1, null pair (<<a>>, b) = -1;", "more than 6 basis vectors"),
            ("basis e2 = 1; pseudoscalar <<e1>>;", "the pseudoscalar is the product of all basis vectors: e1, e2"),
            ("pseudoscalar e1; <<pseudoscalar>> -e1;", "the pseudoscalar is declared twice"),
            ("pseudoscalar <<e7>>;", "`e7` is no basis blade"),
            ("<<nonsense>>", "expected one of: `basis`, `pseudoscalar`, `type`"),
            ("<<fn>> f(a: V) -> V { a }", "formulas stand outside of `algebra!`"),
        ],
    );
    refused("pub algebra <<a>>; type V = [s];", &[("", "this algebra has no basis vector")]);
    refused("pub algebra a extends <<a>>;", &[("", "an algebra does not extend itself")]);
    refused("pub algebra a extends <<self>>;", &[("", "an algebra does not extend itself")]);
}

/// Unusual, but right: these expand, and what they expand to is Rust.
#[test]
fn unusual_algebras_expand() {
    let even_of_six = "pub algebra a; basis e1 = 1, e2 = 1, e3 = 1, e4 = -1, e5 = -1, e6 = 0; type V = [e1, e2, e3, e4, e5, e6]; \
        type B = [e12, e13, e14, e15, e16, e23, e24, e25, e26, e34, e35, e36, e45, e46, e56];";
    for source in [
        "pub algebra a; basis e1 = 1;",
        "algebra a; basis e1 = -0; type V = [e1];",
        "pub algebra r#fn; basis e1 = 1; type r#type = r#match*e1 + r#fn/3;",
        "pub algebra a; basis x = 1, y = 1, null pair (o, i) = 1; type V = [x, y, o, i]; type B = [x_y, o_i];",
        "pub algebra a; basis e1 = 1, e2 = 1; type V = [e1, e2]; type W = self*e1 + while*while*e2;",
        even_of_six,
    ] {
        // `while` is no expression: written as a raw name.
        let source = source.replace("while", "r#while");
        let tokens = ga_gen::expand(source.parse().unwrap()).unwrap_or_else(|error| panic!("{source}\n{error}"));
        syn::parse2::<syn::File>(tokens).unwrap_or_else(|error| panic!("{source}\n{error}"));
    }
}

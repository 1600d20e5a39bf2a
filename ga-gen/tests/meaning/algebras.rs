//! The algebras that the tests run over.

use crate::support::source_of;
use ga_gen::spec::Spec;
use proc_macro2::TokenStream;

/// Four dimensions, two null pairs, one of either sign; the types are made to mix them.
const TWO_PAIRS: &str = "pub algebra two; basis null pair (a, b) = -1, null pair (c, d) = 1; pseudoscalar a_b_c_d; \
    type Vector = [a, b, c, d]; type P = x*b + a - x*x*b; type Boost: unit + versor = (p + q)/2 + (p - q)/2*a_b; \
    type Turn: unit + versor = [s = 1, b_d]; type Bivector = [a_b, a_c, a_d, b_c, b_d, c_d]; type Third = [a_b_c, b_c_d]; \
    type Even = [s, a_b, a_c, a_d, b_c, b_d, c_d, a_b_c_d]; type Scalars = [s, a_b_c_d]; \
    type Multivector = [s, a, b, c, d, a_b, a_c, a_d, b_c, b_d, c_d, a_b_c, a_b_d, a_c_d, b_c_d, a_b_c_d];";

/// Projective geometry of the plane: a degenerate metric.
const PGA: &str = "pub algebra pga; basis e0 = 0, e1 = 1, e2 = 1; pseudoscalar e012; type Line = [e0, e1, e2]; \
    type Point = [e12, e20, e01]; type Motor: unit + versor = [s, e12, e20, e01]; type Direction: unit = [e1, e2]; \
    type Translator: unit + versor = [s = 1, e20, e01]; type Even = [s, e12, e20, e01]; type Odd = [e0, e1, e2, e012]; \
    type Finite = e12 + x*e20 + y*e01; type Multivector = [s, e0, e1, e2, e12, e20, e01, e012];";

/// A degenerate metric in an even dimension: there left and right complements differ.
const PROJECTIVE_LINE: &str = "pub algebra line; basis e0 = 0, e1 = 1; pseudoscalar -e01; type Vector = [e0, e1]; \
    type Pseudoscalar = [e01]; type Even = [s, e01]; type Multivector = [s, e0, e1, e01];";

/// A conformal line with the pair first, and a direction of negative square.
const MIXED: &str = "pub algebra mixed; basis null pair (o, i) = -1, e1 = 1, t = -1; pseudoscalar -o_i_e1_t; \
    type Point = o + x*e1 + (x*x)/2*i; type Event = o + x*e1 + y*t + (x*x - y*y)/2*i; type Vector = [o, i, e1, t]; \
    type Bivector = [o_i, o_e1, o_t, i_e1, i_t, e1_t]; type Boost: unit + versor = [s, e1_t]; \
    type Dilator: unit + versor = (p + q)/2 + (p - q)/2*o_i; type Shift: unit + versor = [s = 1, e1_i, t_i]; \
    type Moved: unit + versor = Shift * Boost; type Infinity = i; \
    type Multivector = [s, o, i, e1, t, o_i, o_e1, o_t, i_e1, i_t, e1_t, o_i_e1, o_i_t, o_e1_t, i_e1_t, o_i_e1_t];";

/// An algebra.
pub(crate) struct Algebra {
    pub(crate) name: &'static str,
    pub(crate) spec: Spec,
}

fn own(name: &'static str, text: &str) -> Algebra {
    let tokens: TokenStream = text.parse().unwrap();
    let spec = Spec::new(&syn::parse2(tokens).unwrap(), None).unwrap();
    Algebra { name, spec }
}

pub(crate) fn g3() -> Algebra {
    Algebra { name: "g3", spec: Spec::new(&source_of("g3"), None).unwrap() }
}

pub(crate) fn cga() -> Algebra {
    let spec = Spec::new(&source_of("cga"), Some(&g3().spec)).unwrap();
    Algebra { name: "cga", spec }
}

/// Small ones, with the metrics that the library's own do not have.
pub(crate) fn small() -> Vec<Algebra> {
    vec![
        own("two null pairs", TWO_PAIRS),
        own("projective plane", PGA),
        own("mixed", MIXED),
        own("projective line", PROJECTIVE_LINE),
    ]
}

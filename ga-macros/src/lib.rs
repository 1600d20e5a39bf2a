//! `algebra!` and `#[formula]`: tokens in, tokens out, an error on the right token. All work is done in `ga_gen`.

use proc_macro::TokenStream;

/// Generates the types and products of a geometric algebra; see `ga_gen::parse` for the grammar.
///
/// Write it alone in a module: the items are emitted where the invocation stands.
#[proc_macro]
pub fn algebra(input: TokenStream) -> TokenStream {
    expand(ga_gen::expand(input.into()))
}

/// Compiles a function over the types of an algebra as a whole: intermediate results need no type, products of them
/// share what they have in common, and the result is of the declared type because that is proved.
///
/// `#[formula(cga, local = a)] pub fn circumsphere(a: Point, b: Point, c: Point, d: Point) -> Sphere { .. }`
///
/// What is emitted is `pub fn circumsphere<T: Scalar>(a: cga::Point<T>, ..) -> cga::Sphere<T>`: straight-line arithmetic.
/// Its documentation shows the program and its operation counts below the docs of the source.
///
/// # Options
///
/// * `path`, first: the module that holds the `algebra!`, in this crate or another. The crate `ga_physics` must be a
///   dependency by this name.
/// * `local = a`: evaluated with the point `a` as origin, the result moved back. `relative = a`: the result stays relative
///   to `a`. Both take differences before products, which keeps the digits of what is far from the origin. They are
///   taken only where it is proved that the value is the same; else the error names what is tied to the origin (`no`,
///   `e1`, a free vector, a coordinate). A parameter whose type translations do not keep, like a `Vector`, stays as it is.
///   Without either, the frame of each point is tried, and taken where that is proved and costs no more.
/// * `dynamic = name`: also emits `fn name`, the same formula product by product over the dynamic multivector, in the
///   world: an oracle for tests and a baseline for measurements.
/// * `schedule = split`: products may be computed in a split basis of the null pair, with up to three times fewer operations
///   for general multivectors. The same value, but the error is relative to the largest coefficients of an operand: small
///   ones beside large ones lose digits. Without it only types that are stored split are multiplied so, where nothing is
///   lost.
///
/// # What a formula holds
///
/// * Parameters and results of the algebra's types, by their bare names (those of the algebras that it extends as well),
///   or `Scalar`. Several results are a tuple.
/// * `let x = ..;`, without a type or with one, which then must hold the value. A later name hides an earlier one.
/// * Numbers, exact: `2`, `0.5`, `1/3`. Basis blades (`e1`, `e12`, `e1_ninf`) and types without numbers (`Infinity`).
/// * `+ - * /`, `^` outer, `|` left contraction, `&` meet, unary minus. The divisor is a scalar; what is divided is
///   multiplied by its reciprocal. `& ^ |` mixed with each other or with `+ -` need brackets: Rust's precedence is not
///   that of paper.
/// * `.rev()`, `.dual()`, `.undual()`, `.grade(k)`, `.norm_sq()`, `v.apply(x)` (which is `v x ~v`, in the grades of x),
///   `.sqrt()` of a scalar, and `.normalised()`: divided by the weight of the type that the value is given, or by the
///   root of `|<a ~a>|` where the type has no weight.
/// * Components: fields of a value with a type (`sphere.rho_sq`), or coefficients of blades (`(a * b).e12`).
/// * Calls of other formulas, each by a `let` that says what it returns: `let s: Sphere = circumsphere(a, b, c, d);`,
///   `let (s, k): (Sphere, Scalar) = ..;`. Nothing is known of the result but its type; in a frame the call is made in
///   the world.
///
/// # What is not checked
///
/// A formula is a kernel: no branch, no assertion, so that it runs on every scalar, lanes included. Division by zero gives
/// what the scalar gives (infinity or NaN for floats), a negative number under a root as well, and operands of unit
/// types are taken to be unit. Checked constructions stand in `ga_physics::geometry`.
///
/// # Errors
///
/// Everything else is refused by a sentence on the token at fault: unknown names, types that do not hold the result (with
/// its blades), results that are identically zero, Rust that is no formula. A module without an algebra has no
/// `__spec`, which is what the compiler then says.
#[proc_macro_attribute]
pub fn formula(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand(ga_gen::formula_attribute(attribute.into(), item.into()))
}

/// The second half of an `algebra!` that extends another one: called by the base algebra's specification macro.
#[doc(hidden)]
#[proc_macro]
pub fn __algebra_with_base(input: TokenStream) -> TokenStream {
    expand(ga_gen::expand_with_base(input.into()))
}

/// The second half of a formula: called by the specification macro of its algebra.
#[doc(hidden)]
#[proc_macro]
pub fn __formula_with_spec(input: TokenStream) -> TokenStream {
    expand(ga_gen::expand_formula(input.into()))
}

fn expand(result: Result<proc_macro2::TokenStream, ga_gen::Error>) -> TokenStream {
    result.unwrap_or_else(|error| error.to_compile_error()).into()
}

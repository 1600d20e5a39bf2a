//! Formulas by every plan, in every frame that the proof admits, after every pass; and as compiled.

use crate::algebras::Algebra;
use crate::dense::{Dense, Oracle, Part, number};
use crate::elements::{Random, fields};
use crate::evaluate::{Names, run};
use crate::interpret::inputs;
use crate::plans::every_plan;
use ga_gen::alternatives::Plan;
use ga_gen::blade::Blade;
use ga_gen::body::Formula;
use ga_gen::field::Residue;
use ga_gen::formula::{self, Compiled, Lowered};
use ga_gen::frame;
use ga_gen::header::{Frame, Source};
use ga_gen::infer::Output;
use ga_gen::optimise::{Effort, stages};
use ga_gen::program::Scaled;
use ga_gen::scalar::Rational;
use ga_gen::signature::Kind;
use proc_macro2::{TokenStream, TokenTree};
use std::collections::BTreeMap;

/// Roots exist for every second element of the field: four of them, for every sixteenth.
const MOST_TRIES: usize = 2000;

/// `(options) fn f(..) -> .. { .. }` read over an algebra.
pub(crate) fn read(algebra: &Algebra, text: &str) -> syn::Result<Formula> {
    let mut tokens = text.parse::<TokenStream>().unwrap().into_iter();
    let Some(TokenTree::Group(options)) = tokens.next() else { panic!("no options: {text}") };
    ga_gen::read::read(&algebra.spec, &Source::new(options.stream(), tokens.collect())?)
}

/// A point of the field where a formula has a value: the parameters' numbers, and the results seen from the world.
pub(crate) struct Point {
    pub(crate) inputs: Names<Residue>,
    fields: Vec<Vec<Residue>>,
    world: Vec<Dense>,
}

/// A random point where all roots exist, if one is found.
pub(crate) fn point(
    algebra: &Algebra,
    oracle: &Oracle,
    formula: &Formula,
    signs: &[Option<Rational>],
    random: &mut Random,
) -> Option<Point> {
    let spec = &algebra.spec;
    for _ in 0..MOST_TRIES {
        let mut sample = |ty: &Output| match ty {
            Output::Scalar => vec![random.residue()],
            Output::Type(index) => fields(oracle, &spec.types[*index], random),
        };
        let fields: Vec<Vec<Residue>> = formula.parameters.iter().map(&mut sample).collect();
        if let Some(world) = oracle.formula(spec, formula, signs, &fields) {
            let names: Vec<String> =
                formula.source.header.parameters.iter().map(|(name, _)| name.to_string()).collect();
            let named = names.iter().map(String::as_str).zip(formula.parameters.iter().copied());
            return Some(Point { inputs: inputs(spec, named, &fields), fields, world });
        }
    }
    None
}

/// The results as the formula's frame shows them: from the world, or moved by the origin's translator.
fn seen(algebra: &Algebra, oracle: &Oracle, formula: &Formula, point: &Point) -> Vec<Dense> {
    let Frame::Relative(origin) = &formula.source.options.frame else { return point.world.clone() };
    let names = &formula.source.header.parameters;
    let index = names.iter().position(|(name, _)| name == origin).unwrap();
    let place = oracle.output(&algebra.spec, formula.parameters[index], &point.fields[index]);
    let kinds = algebra.spec.signature.kinds();
    let pair = kinds.iter().position(|kind| matches!(kind, Kind::PairFirst(_))).unwrap();
    let infinity = oracle.blade(Blade::vector(pair + 1));
    // ~T = 1 + p ninf / 2; p may have parts along the pair as well, which ninf or the grades drop.
    let euclidean = (0..kinds.len()).filter(|i| *i != pair && *i != pair + 1).fold(oracle.zero(), |sum, i| {
        let coefficient = oracle.coefficients(&place)[1 << i];
        oracle.sum(&sum, &oracle.scaled(oracle.blade(Blade::vector(i)), coefficient))
    });
    let bivector = oracle.product(Part::All, &euclidean, infinity);
    let into = oracle.sum(&oracle.scalar(Residue::ONE), &oracle.scaled(&bivector, number(1, 2)));
    point.world.iter().map(|value| oracle.sandwich(&into, value)).collect()
}

fn outputs(algebra: &Algebra, lowered: &Lowered) -> Vec<(String, Scaled)> {
    let results = lowered.results.iter().enumerate();
    results
        .flat_map(|(index, (ty, fields))| {
            let names =
                ga_gen::item::field_names(&algebra.spec, *ty).into_iter().map(move |name| format!("{index}.{name}"));
            names.zip(fields.iter().copied()).collect::<Vec<_>>()
        })
        .collect()
}

/// Numbers of the results, one after the other, as multivectors.
fn values(algebra: &Algebra, oracle: &Oracle, types: &[Output], numbers: &[Residue]) -> Vec<Dense> {
    let mut rest = numbers;
    let mut values = Vec::new();
    for ty in types {
        let (own, others) = rest.split_at(ga_gen::item::field_names(&algebra.spec, *ty).len());
        values.push(oracle.output(&algebra.spec, *ty, own));
        rest = others;
    }
    values
}

fn result_types(formula: &Formula) -> Vec<Output> {
    formula.results.iter().map(|result| formula.type_of(*result).unwrap_or(Output::Scalar)).collect()
}

/// What was run.
#[derive(Debug, Default)]
pub(crate) struct Tally {
    pub(crate) formulas: usize,
    pub(crate) frames: usize,
    pub(crate) plans: usize,
    pub(crate) programs: usize,
    pub(crate) passes: BTreeMap<&'static str, usize>,
}

/// Compares a compiled formula with the dense value; says what is wrong.
pub(crate) fn agrees(algebra: &Algebra, oracle: &Oracle, compiled: &Compiled, random: &mut Random) -> bool {
    let formula = &compiled.formula;
    let point = point(algebra, oracle, formula, &compiled.signs, random).expect("a point where all roots exist");
    let numbers = run(&compiled.program, &point.inputs).unwrap();
    values(algebra, oracle, &result_types(formula), &numbers) == seen(algebra, oracle, formula, &point)
}

/// Lowers a formula in its own frame, and in all others that are proved, by every plan.
pub(crate) fn check(algebra: &Algebra, text: &str, most_plans: usize, random: &mut Random, tally: &mut Tally) {
    let (spec, oracle) = (&algebra.spec, Oracle::new(&algebra.spec));
    let formula = read(algebra, text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let compiled = formula::compile(spec, &formula).unwrap_or_else(|error| panic!("{text}: {error}"));
    assert!(agrees(algebra, &oracle, &compiled, random), "{}: {text}, as compiled", algebra.name);
    let (first, _) = formula::lower(spec, &formula, Plan::default()).unwrap();
    tally.formulas += 1;
    for (index, framed) in [formula.clone()].into_iter().chain(frame::automatic(&formula)).enumerate() {
        let admitted = formula::lower(spec, &framed, Plan::default()).is_ok_and(|(l, _)| l.world == first.world);
        assert!(admitted || index > 0, "{text}");
        if !admitted {
            continue;
        }
        tally.frames += 1;
        let point = point(algebra, &oracle, &framed, &first.signs, random).expect("a point where all roots exist");
        let expected = seen(algebra, &oracle, &framed, &point);
        tally.plans += every_plan(most_plans, |plan| {
            let Ok((lowered, plan)) = formula::lower(spec, &framed, plan.clone()) else { return plan };
            let outputs = outputs(algebra, &lowered);
            for effort in [Effort::Product, Effort::Whole] {
                let mut last = None;
                for (pass, program) in stages(&lowered.builder, &outputs, effort) {
                    let Some(program) = program else { continue };
                    *tally.passes.entry(pass).or_default() += 1;
                    if last.as_ref() == Some(&program) {
                        continue;
                    }
                    let numbers = run(&program, &point.inputs).unwrap();
                    let found = values(algebra, &oracle, &result_types(&framed), &numbers);
                    let frame = &framed.source.options.frame;
                    let name = algebra.name;
                    assert!(found == expected, "{name}: {text}, {frame:?}, {plan:?}, {effort:?}, after {pass}");
                    tally.programs += 1;
                    last = Some(program);
                }
            }
            plan
        });
    }
}

pub(crate) const G3: [&str; 8] = [
    "(g3) fn f(a: Vector, b: Vector, c: Vector) -> Vector { (c | (a ^ b)) + a }",
    "(g3) fn f(a: Rotor, b: Rotor, c: Vector) -> Vector { (a * b).apply(c) }",
    "(g3) fn f(a: Rotor, b: Vector, c: Vector) -> (Vector, Scalar) { let d = a.apply(b + c); (d, d | b) }",
    "(g3) fn f(a: Vector, b: Vector) -> Scalar { (a | b) / (a.norm_sq() * b.norm_sq()).sqrt() }",
    "(g3) fn f(a: Vector, b: Vector) -> Vector { (a.normalised() + b.normalised()).normalised() }",
    "(g3) fn f(a: Vector, b: Vector, k: Scalar) -> Bivector { (a ^ b) / (k + a.e1 - 2 * b.e3) }",
    "(g3) fn f(a: Vector, n: Vector) -> Vector { a - 2 * (a | n) * n / n.norm_sq() }",
    "(g3) fn f(a: Even, b: Odd) -> Multivector { (a * b * a.rev() + 1/2 * b).undual() & (a.dual() - 0.25) }",
];

pub(crate) const CGA: [&str; 18] = [
    "(cga) fn f(a: Point, b: Point, c: Point, d: Point) -> Sphere { (a ^ b ^ c ^ d).dual().normalised() }",
    "(cga, local = c) fn f(a: Point, b: Point, c: Point, d: Point) -> Sphere { (a ^ b ^ c ^ d).dual().normalised() }",
    "(cga, relative = b) fn f(a: Point, b: Point, c: Point, d: Point) -> Round { (a ^ b ^ c ^ d).dual() }",
    "(cga) fn f(a: Point, b: Point, c: Point) -> Sphere { let k = a ^ b ^ c; (k ^ (k ^ Infinity).dual()).dual().normalised() }",
    "(cga) fn f(a: Point, b: Point, c: Point) -> Round { (a ^ b ^ c ^ Infinity).dual().normalised() }",
    "(cga) fn f(a: Point, b: Point, p: Plane) -> FinitePoint { (p | (a ^ b ^ Infinity)).normalised() }",
    "(cga, relative = a) fn f(a: Point, b: Point, p: Plane) -> FlatPoint { p | (a ^ b ^ Infinity) }",
    "(cga) fn f(x: Point, s: Sphere) -> Point { (s * x * s).normalised() }",
    "(cga) fn f(x: Point, c: Circle) -> Round { (c * x * c).grade(1) }",
    "(cga) fn f(a: Motor, b: Motor, x: Point) -> Point { (a * b).apply(x) }",
    "(cga) fn f(a: Pose, b: Pose) -> Pose { a * b.rev() }",
    "(cga) fn f(a: Pose, b: Translator, c: Rotor, x: Point, l: Line) -> (Pose, Point, Line) { let m: Pose = a * b * c; (m, m.apply(x), m.apply(l)) }",
    "(cga) fn f(v: ConformalRotor, x: Point) -> Point { v.apply(x).normalised() }",
    "(cga) fn f(v: ConformalRotor, w: Motor, d: Dilator, x: Point, y: Point) -> (ConformalRotor, Scalar) { let u: ConformalRotor = v * w * d; (u, u.apply(x) | y) }",
    "(cga) fn f(v: ConformalRotor, s: Sphere) -> Sphere { v.apply(s).normalised() }",
    "(cga) fn f(v: Even, x: Round) -> Round { v.apply(x) + v.rev().apply(x) }",
    "(cga) fn f(a: Sphere, b: Sphere) -> Scalar { (a | b) + (a.rho_sq * b.rho_sq).sqrt() }",
    "(cga) fn f(a: Point, v: Vector, p: Plane) -> Round { a + p * (a | p) + v.e1 * Infinity - 3 * Origin }",
];

pub(crate) const MIXED: [&str; 5] = [
    "(mixed) fn f(a: Event, b: Event, c: Event) -> Multivector { (a ^ b ^ c).dual() * (a - b) }",
    "(mixed, relative = a) fn f(a: Event, b: Event) -> Multivector { (b * a * b) + Infinity / 3 }",
    "(mixed) fn f(m: Moved, n: Moved, a: Event) -> (Moved, Event) { let k: Moved = m * n; (k, k.apply(a)) }",
    "(mixed) fn f(d: Dilator, m: Shift, a: Point) -> Event { (m * d).apply(a).normalised() }",
    "(mixed) fn f(a: Point, b: Point) -> Scalar { ((a - b) | (a - b)) / (a | b) }",
];

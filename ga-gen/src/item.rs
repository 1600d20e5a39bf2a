//! The items of an algebra: every operation that exists for some types, compiled.

use crate::alternatives::{Plan, cheapest};
use crate::expression::Expression;
use crate::infer::{self, Output};
use crate::lower::{Components, Lowering, Schedule};
use crate::normalise::by_weight;
use crate::optimise::{Effort, optimise};
use crate::product::Kind;
use crate::program::{Builder, Program, Scaled};
use crate::scalar::Rational;
use crate::spec::Spec;

/// An operation on declared types, by index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// `a * b`, `a ^ b`, `a | b`.
    Product(Kind, usize, usize),
    /// `a & b`.
    Meet(usize, usize),
    /// `a.rev()`.
    Reverse(usize),
    /// `a.dual()`.
    Dual(usize),
    /// `a.undual()`.
    Undual(usize),
    /// `a.grade2()`.
    Grade(u32, usize),
    /// `a.norm_sq()`.
    NormSq(usize),
    /// `a.apply(b)`.
    Apply(usize, usize),
    /// A type held by a larger one.
    Embed(usize, usize),
}

/// A compiled operation.
#[derive(Clone, Debug)]
pub struct Item {
    /// The operation.
    pub operation: Operation,
    /// The name under which it is inspected: `Rotor*Rotor`, `Motor.apply(Point)`.
    pub name: String,
    /// Names and types of the parameters.
    pub parameters: Vec<(String, usize)>,
    /// The type of the result.
    pub output: Output,
    /// The scalar code.
    pub program: Program,
    /// How it was lowered.
    pub plan: Plan,
}

/// All operations that may exist; [`compile`] says which do.
#[must_use]
pub fn operations(spec: &Spec) -> Vec<Operation> {
    let all = 0..spec.types.len();
    let own = |index: &usize| !spec.types[*index].shared;
    let mut result = Vec::new();
    for a in all.clone() {
        let ty = &spec.types[a];
        if own(&a) {
            result.extend([Operation::Reverse(a), Operation::NormSq(a)]);
            let grades = ty.grades();
            if grades.len() > 1 && !ty.is_compact() {
                result.extend(grades.into_iter().map(|grade| Operation::Grade(grade, a)));
            }
        }
        if !ty.is_compact() {
            result.extend([Operation::Dual(a), Operation::Undual(a)]);
        }
        for b in all.clone() {
            // A full multivector meets only its like: anything else is converted first, so that the cost shows.
            if spec.is_full(a) != spec.is_full(b) {
                if spec.is_full(b) {
                    result.push(Operation::Embed(a, b));
                }
                continue;
            }
            // A versor in compact storage multiplies versors and applies to what is none; for the rest it is converted
            // first, and the image of a versor is the product `v w ~v`.
            let compact = ty.is_compact() || spec.types[b].is_compact();
            if !compact {
                result.push(Operation::Meet(a, b));
            }
            if own(&a) || own(&b) {
                if !compact {
                    let products = [Kind::Geometric, Kind::Outer, Kind::Contraction];
                    result.extend(products.map(|kind| Operation::Product(kind, a, b)));
                } else if ty.versor && spec.types[b].versor {
                    result.push(Operation::Product(Kind::Geometric, a, b));
                }
                if ty.versor && !(compact && spec.types[b].versor) {
                    result.push(Operation::Apply(a, b));
                }
                if a != b && spec.types[b].is_linear() {
                    result.push(Operation::Embed(a, b));
                }
            }
        }
    }
    result
}

/// A lowered operation.
#[derive(Clone, Debug)]
pub struct Lowered {
    /// The graph.
    pub builder: Builder,
    /// The type of the result.
    pub output: Output,
    /// The names and values of its fields.
    pub fields: Vec<(String, Scaled)>,
}

/// Compiles an operation; `None` where it is identically zero, undefined, no declared type holds its result, or a
/// constant of it exceeds 32 bits.
///
/// # Errors
/// A unit type that cannot be sampled.
pub fn compile(spec: &Spec, operation: Operation) -> syn::Result<Option<Item>> {
    let (name, parameters) = describe(spec, operation);
    let lower = |plan: Plan| -> syn::Result<Option<((Output, Program), Plan)>> {
        let lowered = lower_by(spec, operation, plan)?;
        let program = |lowered: &Lowered| optimise(&lowered.builder, &lowered.fields, Effort::Product);
        Ok(lowered.map(|(lowered, plan)| ((lowered.output, program(&lowered)), plan)))
    };
    let best = cheapest(lower, |(_, program)| program)?;
    let best = best.map(|((output, program), plan)| Item { operation, name, parameters, output, program, plan });
    Ok(best.filter(|item| item.program.oversized().is_none()))
}

/// Lowers an operation by a plan; also returns the plan with the choices it made.
///
/// # Errors
/// A unit type that cannot be sampled.
pub fn lower_by(spec: &Spec, operation: Operation, plan: Plan) -> syn::Result<Option<(Lowered, Plan)>> {
    let mut lowering = Lowering::new(spec, plan, Schedule::Stable);
    let lowered = lower(&mut lowering, operation, &describe(spec, operation).1)?;
    let (builder, plan) = lowering.finish();
    Ok(lowered.map(|(output, fields)| {
        let fields = field_names(spec, output).into_iter().zip(fields).collect();
        (Lowered { builder, output, fields }, plan)
    }))
}

/// The coefficients of `a ~a` for a type that declares them to be those of 1, one output a blade.
#[must_use]
pub fn unit_defects(spec: &Spec, ty: usize) -> Program {
    let mut lowering = Lowering::new(spec, Plan::default(), Schedule::Stable);
    lowering.add_raw_parameter("a", ty);
    let a = lowering.parameters[0].clone();
    let product = lowering.product(Kind::Geometric, &a, &crate::lower::reversed(&a));
    let outputs: Vec<(String, Scaled)> =
        product.into_iter().map(|(blade, value)| (spec.signature.name(blade), value)).collect();
    optimise(&lowering.builder, &outputs, Effort::Product)
}

/// The names of the fields of a result; a scalar has one without a name.
#[must_use]
pub fn field_names(spec: &Spec, output: Output) -> Vec<String> {
    match output {
        Output::Scalar => vec![String::new()],
        Output::Type(index) => spec.types[index].fields.clone(),
    }
}

/// The name under which an operation is inspected.
#[must_use]
pub fn name(spec: &Spec, operation: Operation) -> String {
    describe(spec, operation).0
}

fn describe(spec: &Spec, operation: Operation) -> (String, Vec<(String, usize)>) {
    let name = |index: usize| spec.types[index].name.to_string();
    let one = |a| vec![("a".to_string(), a)];
    let two = |a, b| vec![("a".to_string(), a), ("b".to_string(), b)];
    match operation {
        Operation::Product(kind, a, b) => (format!("{}{}{}", name(a), symbol(kind), name(b)), two(a, b)),
        Operation::Meet(a, b) => (format!("{}&{}", name(a), name(b)), two(a, b)),
        Operation::Reverse(a) => (format!("{}.rev", name(a)), one(a)),
        Operation::Dual(a) => (format!("{}.dual", name(a)), one(a)),
        Operation::Undual(a) => (format!("{}.undual", name(a)), one(a)),
        Operation::Grade(grade, a) => (format!("{}.grade{grade}", name(a)), one(a)),
        Operation::NormSq(a) => (format!("{}.norm_sq", name(a)), one(a)),
        Operation::Apply(v, x) => (format!("{}.apply({})", name(v), name(x)), two(v, x)),
        Operation::Embed(a, b) => (format!("{}::from({})", name(b), name(a)), one(a)),
    }
}

/// The operator of a product.
#[must_use]
pub fn symbol(kind: Kind) -> &'static str {
    match kind {
        Kind::Geometric => "*",
        Kind::Outer => "^",
        Kind::Contraction => "|",
    }
}

fn expression(operation: Operation) -> Expression {
    let a = || Box::new(Expression::Input(0));
    let b = || Box::new(Expression::Input(1));
    match operation {
        Operation::Product(kind, ..) => Expression::Product(kind, a(), b()),
        Operation::Meet(..) => Expression::Meet(a(), b()),
        Operation::Reverse(_) => Expression::Reverse(a()),
        Operation::Dual(_) => Expression::Dual(a()),
        Operation::Undual(_) => Expression::Undual(a()),
        Operation::Grade(grade, _) => Expression::Grade(grade, a()),
        Operation::Apply(..) => Expression::Sandwich(a(), b()),
        Operation::NormSq(_) | Operation::Embed(..) => *a(),
    }
}

/// Lowers an operation: the type of the result and its fields.
fn lower(
    lowering: &mut Lowering<'_>,
    operation: Operation,
    parameters: &[(String, usize)],
) -> syn::Result<Option<(Output, Vec<Scaled>)>> {
    let spec = lowering.spec;
    if let Operation::NormSq(ty) = operation {
        lowering.add_raw_parameter("a", ty);
        let input = lowering.parameters[0].clone();
        let value = lowering.norm_sq(&input);
        return Ok(value.node.is_some().then(|| (Output::Scalar, vec![value])));
    }
    for (name, ty) in parameters {
        lowering.add_parameter(name, *ty)?;
    }
    if let Some(result) = factored(lowering, operation, parameters) {
        return Ok(Some(result));
    }
    let Some(components) = lowering.lower(&expression(operation)) else {
        return Ok(None);
    };
    let result = match operation {
        Operation::Embed(_, target) => {
            infer::fit(spec, &mut lowering.builder, &components, target).map(|fields| (Output::Type(target), fields))
        }
        Operation::Apply(_, x) => image(spec, lowering, &components, x),
        _ => {
            let full = parameters.iter().all(|(_, ty)| spec.is_full(*ty));
            infer::infer(spec, &mut lowering.builder, &components, full)
        }
    };
    Ok(result)
}

/// A product or reverse of factored versors, as a factored versor.
fn factored(
    lowering: &mut Lowering<'_>,
    operation: Operation,
    parameters: &[(String, usize)],
) -> Option<(Output, Vec<Scaled>)> {
    let (Operation::Product(Kind::Geometric, ..) | Operation::Reverse(_)) = operation else { return None };
    let types = &lowering.spec.types;
    let ty = parameters.iter().map(|(_, ty)| *ty).find(|ty| types[*ty].factors.is_some())?;
    let fields = lowering.word_fields(&expression(operation), ty)?;
    Some((Output::Type(ty), fields))
}

/// The image of a type under a versor: of that type itself if it holds it, if need be after division by the weight.
fn image(spec: &Spec, lowering: &mut Lowering<'_>, components: &Components, x: usize) -> Option<(Output, Vec<Scaled>)> {
    if let Some(fields) = infer::fit(spec, &mut lowering.builder, components, x) {
        return Some((Output::Type(x), fields));
    }
    // A unit versor keeps norms, so the squared radius of the image is known without differences of large squares.
    let norm_sq = lowering.norm_sq(&lowering.parameters[1].clone());
    let plain = infer::infer(spec, &mut lowering.builder, components, false);
    let fields = |result: &Option<(Output, Vec<Scaled>)>| result.as_ref().map_or(usize::MAX, |(_, f)| f.len());
    let weight = spec.types[x].weight();
    let Some((normalised, inverse)) = weight.and_then(|w| by_weight(lowering, components, w)) else {
        return plain;
    };
    lowering.builder.sum(&[(Rational::ONE, vec![norm_sq, inverse, inverse])], "kept");
    if let Some(fields) = infer::fit(spec, &mut lowering.builder, &normalised, x) {
        return Some((Output::Type(x), fields));
    }
    // The origin goes to a point.
    let normalised = infer::infer(spec, &mut lowering.builder, &normalised, false);
    if fields(&normalised) < fields(&plain) { normalised } else { plain }
}

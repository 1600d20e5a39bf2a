//! Formulas, compiled as a whole: step by step to scalar nodes, in the world or in a local frame, then to a program.
//!
//! In a local frame (`local = a`, `relative = a`) the point `a` is the origin and every other parameter is moved there
//! by the translator of `a` ("difference first"): rounds built in world coordinates lose `eps |a|^2` of their size
//! squared, in the frame of one of their own points they lose nothing. `local` moves the result back, `relative` leaves
//! it. That a frame leaves the value as it is, is proved ([`crate::frame`]).

use crate::alternatives::{Plan, cheapest, cost};
use crate::blade::Blade;
use crate::body::{Component, Formula, Operation, Step};
use crate::expression::Expression;
use crate::field::{Fingerprint, Stream};
use crate::frame;
use crate::header::Frame;
use crate::infer::{self, Output};
use crate::item::field_names;
use crate::lower::{Components, Lowering, reversed};
use crate::normalise::{by_norm, by_weight};
use crate::optimise::{Effort, optimise};
use crate::program::{Builder, CallNode, NodeId, Program, Scaled};
use crate::scalar::Rational;
use crate::spec::Spec;
use proc_macro2::Span;
use std::collections::BTreeMap;
use syn::Error;

/// A lowered formula.
#[derive(Clone, Debug)]
pub struct Lowered {
    /// The graph.
    pub builder: Builder,
    /// The type and the fields of each result.
    pub results: Vec<(Output, Vec<Scaled>)>,
    /// The values of the results at the random points, seen from the world.
    pub world: Vec<Vec<Fingerprint>>,
    /// For each step that divides by a norm, the sign of the norm's square.
    pub signs: Vec<Option<Rational>>,
    /// For each step that is a call, the types of the arguments.
    pub arguments: BTreeMap<usize, Vec<Output>>,
}

/// A compiled formula.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// As read.
    pub formula: Formula,
    /// The scalar code. A result of several names its numbers `0.e1`.
    pub program: Program,
    /// For each step that divides by a norm, the sign of the norm's square.
    pub signs: Vec<Option<Rational>>,
    /// For each step that is a call, the types of the arguments.
    pub arguments: BTreeMap<usize, Vec<Output>>,
}

/// Compiles a formula: lowers it in each way worth trying, and keeps the cheapest program.
///
/// # Errors
/// A sentence on the token at fault.
pub fn compile(spec: &Spec, formula: &Formula) -> syn::Result<Compiled> {
    let first = lower(spec, formula, Plan::default());
    frame::prove(spec, formula, first.as_ref().ok().map(|(lowered, _)| lowered))?;
    let world = first?.0.world;
    let mut best = cheapest_in(spec, formula, &world)?;
    // A frame is cheaper and loses no digits: it is taken wherever it changes nothing else and costs no more.
    for framed in frame::automatic(formula) {
        if let Ok(Some(other)) = cheapest_in(spec, &framed, &world)
            && best.as_ref().is_none_or(|known| cost(other.program.counts()) <= cost(known.program.counts()))
        {
            best = Some(other);
        }
    }
    let fault = |message: String| Error::new(formula.source.header.name.span(), message);
    let best = best.ok_or_else(|| fault("this formula has no way to be computed".into()))?;
    match best.program.oversized() {
        Some(constant) => {
            Err(fault(format!("this needs the number {constant}; constants of generated code have 32 bits")))
        }
        None => Ok(best),
    }
}

/// The cheapest program in the formula's own frame, among those with the given values at the random points.
fn cheapest_in(spec: &Spec, formula: &Formula, world: &[Vec<Fingerprint>]) -> syn::Result<Option<Compiled>> {
    let compiled = |plan: Plan| -> syn::Result<Option<(Compiled, Plan)>> {
        let (lowered, plan) = lower(spec, formula, plan)?;
        if lowered.world != world {
            return Ok(None);
        }
        let program = optimise(&lowered.builder, &outputs(spec, formula, &lowered.results), Effort::Whole);
        let (signs, arguments) = (lowered.signs, lowered.arguments);
        Ok(Some((Compiled { formula: formula.clone(), program, signs, arguments }, plan)))
    };
    cheapest(compiled, |compiled| &compiled.program)
}

/// The names and values of all numbers of the results.
fn outputs(spec: &Spec, formula: &Formula, results: &[(Output, Vec<Scaled>)]) -> Vec<(String, Scaled)> {
    let mut outputs = Vec::new();
    for (index, (output, fields)) in results.iter().enumerate() {
        let place = if formula.source.header.tuple { index.to_string() } else { String::new() };
        let names = field_names(spec, *output).into_iter().map(|name| match (place.is_empty(), name.is_empty()) {
            (true, _) => name,
            (false, true) => place.clone(),
            (false, false) => format!("{place}.{name}"),
        });
        outputs.extend(names.zip(fields.iter().copied()));
    }
    outputs
}

/// Lowers a formula by a plan; also returns the choices that there were.
///
/// # Errors
/// A sentence on the token at fault: a value that its type does not hold, zero, no scalar where one is needed.
pub fn lower(spec: &Spec, formula: &Formula, plan: Plan) -> syn::Result<(Lowered, Plan)> {
    let mut evaluation = Evaluation::new(spec, formula, plan)?;
    if let Frame::Local(origin) | Frame::Relative(origin) = &formula.source.options.frame {
        evaluation.enter(origin)?;
    }
    for (index, needed) in formula.needed().into_iter().enumerate() {
        evaluation.step(index, needed)?;
    }
    Ok(evaluation.finish())
}

/// A formula on its way to scalars. The operands of its expressions are the parameters of the lowering.
struct Evaluation<'a> {
    spec: &'a Spec,
    formula: &'a Formula,
    lowering: Lowering<'a>,
    /// The fields of operands of a stated type.
    fields: Vec<Option<Vec<Scaled>>>,
    /// The fields of the parameters, as they are handed over.
    handed: Vec<Vec<Scaled>>,
    /// The translator that leads back to the world.
    back: Option<Components>,
    calls: BTreeMap<usize, NodeId>,
    signs: Vec<Option<Rational>>,
    arguments: BTreeMap<usize, Vec<Output>>,
}

impl<'a> Evaluation<'a> {
    fn new(spec: &'a Spec, formula: &'a Formula, plan: Plan) -> syn::Result<Self> {
        let lowering = Lowering::new(spec, plan, formula.source.options.schedule);
        let signs = vec![None; formula.steps.len()];
        let (calls, arguments) = (BTreeMap::new(), BTreeMap::new());
        let (fields, handed) = (vec![], vec![]);
        let mut evaluation = Self { spec, formula, lowering, fields, handed, back: None, calls, signs, arguments };
        for ((name, _), ty) in formula.source.header.parameters.iter().zip(&formula.parameters) {
            let name = name.to_string();
            let fields = evaluation.sampled(*ty, &name, |builder, path, values| {
                let path = if path.is_empty() { name.clone() } else { format!("{name}.{path}") };
                builder.input(&path, values)
            })?;
            evaluation.handed.push(fields.clone());
            evaluation.add(*ty, fields, &name);
        }
        Ok(evaluation)
    }

    /// The numbers of a type that enter the graph here, sampled on its manifold.
    fn sampled(
        &mut self,
        ty: Output,
        name: &str,
        mut enter: impl FnMut(&mut Builder, &str, Fingerprint) -> Scaled,
    ) -> syn::Result<Vec<Scaled>> {
        let values = match ty {
            Output::Type(index) => self.spec.sample(index, name)?,
            Output::Scalar => {
                let mut stream = Stream::named(&format!("{name}: Scalar"));
                vec![Fingerprint(std::array::from_fn(|_| stream.next_residue()))]
            }
        };
        let fields = field_names(self.spec, ty).into_iter().zip(values);
        Ok(fields.map(|(field, values)| enter(&mut self.lowering.builder, &field, values)).collect())
    }

    fn components(&mut self, ty: Output, fields: &[Scaled], hint: &str) -> Components {
        match ty {
            Output::Type(index) => self.lowering.of_type(&self.spec.types[index], fields, hint),
            Output::Scalar => {
                fields.iter().filter(|value| !value.is_zero()).map(|value| (Blade::SCALAR, *value)).collect()
            }
        }
    }

    /// The next operand, of a stated type.
    fn add(&mut self, ty: Output, fields: Vec<Scaled>, hint: &str) {
        let components = self.components(ty, &fields, hint);
        let factors = match ty {
            Output::Type(index) => self.lowering.factors_of(&self.spec.types[index], &fields, hint),
            Output::Scalar => None,
        };
        self.lowering.push(components, factors);
        self.fields.push(Some(fields));
    }

    /// Moves every parameter into the frame; one whose type translations do not keep stays as it is.
    fn enter(&mut self, origin: &syn::Ident) -> syn::Result<()> {
        let translator = frame::translator(self.spec, self.formula, &self.lowering.parameters, origin)?;
        let into = reversed(&translator);
        let header = &self.formula.source.header;
        for (index, (name, _)) in header.parameters.iter().enumerate() {
            let ty = self.formula.parameters[index];
            let mark = self.lowering.builder.entries().len();
            let Some(fields) = frame::moved(self.spec, &mut self.lowering, &into, ty, &self.handed[index]) else {
                continue;
            };
            // The derived coefficients are formed anew, from the differences.
            self.lowering.builder.forget_since(mark, &fields);
            self.lowering.parameters[index] = self.components(ty, &fields, &name.to_string());
            self.fields[index] = Some(fields);
        }
        self.back = Some(translator);
        Ok(())
    }

    /// Fields of a type, moved by a translator if there is a frame and translations keep the type.
    fn shifted(&mut self, ty: Output, fields: Vec<Scaled>, into: bool) -> Vec<Scaled> {
        let Some(back) = &self.back else { return fields };
        let translator = if into { reversed(back) } else { back.clone() };
        frame::moved(self.spec, &mut self.lowering, &translator, ty, &fields).unwrap_or(fields)
    }

    fn value(&mut self, expression: &Expression, span: Span) -> syn::Result<Components> {
        let undefined =
            || Error::new(span, "this has no value: a dual needs a pseudoscalar with a square other than 0");
        self.lowering.lower(expression).ok_or_else(undefined)
    }

    fn scalar(&mut self, expression: &Expression, span: Span, what: &str) -> syn::Result<Scaled> {
        let components = self.value(expression, span)?;
        let scalar = components.get(&Blade::SCALAR).copied().filter(|_| components.len() == 1);
        match (components.is_empty(), scalar) {
            (true, _) => Ok(Scaled::ZERO),
            (false, Some(value)) => Ok(value),
            (false, None) => Err(Error::new(span, format!("{what} is no scalar: {}", blades(self.spec, &components)))),
        }
    }

    /// Computes the next step; one that no result needs has no value.
    fn step(&mut self, index: usize, needed: bool) -> syn::Result<()> {
        let step = &self.formula.steps[index];
        if !needed {
            self.lowering.push(Components::new(), None);
            self.fields.push(None);
            return Ok(());
        }
        let components = match &step.operation {
            Operation::Value(value) => self.value(value, step.span)?,
            Operation::Normalised(value) => self.by_norm(index, value)?,
            Operation::Sqrt(value) => self.root(value, step.span)?,
            Operation::Quotient(a, b) => self.quotient(a, b, step.span)?,
            Operation::Component(of, component) => self.component(*of, *component, step.span)?,
            Operation::Call { .. } => self.call(index)?,
            Operation::Part(call, part) => return self.part(step, *call, *part),
            Operation::Typed { value, normalised, declared } => {
                let ty = step.ty.unwrap_or(Output::Scalar);
                let fields = self.typed(index, value, *normalised, ty, *declared)?;
                self.add(ty, fields, &step.name);
                return Ok(());
            }
        };
        let scalar = components.get(&Blade::SCALAR).copied();
        self.fields.push(step.ty.map(|_| vec![scalar.unwrap_or(Scaled::ZERO)]));
        self.lowering.push(components, None);
        Ok(())
    }

    fn by_norm(&mut self, index: usize, value: &Expression) -> syn::Result<Components> {
        let span = self.formula.steps[index].span;
        let value = self.value(value, span)?;
        if value.is_empty() {
            return Err(Error::new(span, "this is identically zero: it has no norm to be divided by"));
        }
        let message = "the sign of the square of this is not known: only a sum of squares of one sign has a norm; give \
                       the result a type with a weight, or divide by what you mean";
        let (unit, sign) = by_norm(&mut self.lowering, &value).ok_or_else(|| Error::new(span, message))?;
        self.signs[index] = Some(sign);
        Ok(unit)
    }

    fn root(&mut self, value: &Expression, span: Span) -> syn::Result<Components> {
        let radicand = self.scalar(value, span, "what stands under this root")?;
        if radicand.node.is_none() && radicand.coefficient.is_negative() {
            return Err(Error::new(span, format!("the root of {}, a negative number", radicand.coefficient)));
        }
        if radicand.is_zero() {
            return Ok(Components::new());
        }
        let root = self.lowering.builder.sqrt(radicand, "root");
        Ok([(Blade::SCALAR, root)].into())
    }

    fn quotient(&mut self, a: &Expression, b: &Expression, span: Span) -> syn::Result<Components> {
        let divisor = self.scalar(b, span, "the divisor")?;
        let zero = || Error::new(span, "the divisor is identically zero");
        if let Some(number) = a.as_number() {
            let quotient = self.lowering.builder.quotient(number, divisor, "quotient").ok_or_else(zero)?;
            return Ok([(Blade::SCALAR, quotient)].into());
        }
        let value = self.value(a, span)?;
        let inverse = self.lowering.builder.quotient(Rational::ONE, divisor, "inverse").ok_or_else(zero)?;
        Ok(self.lowering.scaled(&value, inverse))
    }

    fn component(&mut self, of: usize, component: Component, span: Span) -> syn::Result<Components> {
        let value = match component {
            Component::Field(field) => self.fields[of].as_ref().and_then(|fields| fields.get(field)).copied(),
            Component::Coefficient(blade, odd) => {
                let sign = if odd { -Rational::ONE } else { Rational::ONE };
                self.lowering.parameters[of].get(&blade).map(|value| value.scaled(sign))
            }
        };
        let missing = || {
            Error::new(
                span,
                format!("this component is identically zero: {}", blades(self.spec, &self.lowering.parameters[of])),
            )
        };
        let value = value.ok_or_else(missing)?;
        Ok(self.components(Output::Scalar, &[value], ""))
    }

    /// The fields of a declared type that hold a value.
    fn typed(
        &mut self,
        index: usize,
        value: &Expression,
        normalised: bool,
        ty: Output,
        declared: Span,
    ) -> syn::Result<Vec<Scaled>> {
        let span = self.formula.steps[index].span;
        let fault = |message: &str| Error::new(span, message);
        let weight = match ty {
            Output::Scalar if normalised => return Err(fault("a scalar is not normalised: it would be 1 or -1")),
            Output::Scalar => None,
            Output::Type(index) => self.spec.types[index].weight(),
        };
        let mut components = match (normalised, weight) {
            (true, None) => self.by_norm(index, value)?,
            _ => self.value(value, span)?,
        };
        if components.is_empty() {
            return Err(fault("the result is identically zero"));
        }
        if let (true, Some(weight)) = (normalised, weight) {
            let divided = by_weight(&mut self.lowering, &components, weight);
            (components, _) = divided.ok_or_else(|| fault("the weight of the result is identically zero"))?;
        }
        let fields = match ty {
            Output::Type(ty) if self.spec.types[ty].factors.is_some() => {
                let word = self.lowering.word_fields(value, ty).filter(|_| !normalised);
                word.or_else(|| self.lowering.factor_fields(&components, ty))
            }
            Output::Type(ty) => infer::fit(self.spec, &mut self.lowering.builder, &components, ty),
            Output::Scalar => {
                let scalar = components.get(&Blade::SCALAR).copied().filter(|_| components.len() == 1);
                scalar.map(|value| vec![value])
            }
        };
        fields.ok_or_else(|| Error::new(declared, misfit(self.spec, &components, ty)))
    }

    /// A call: its arguments are made values of declared types, in the world.
    fn call(&mut self, index: usize) -> syn::Result<Components> {
        let step = &self.formula.steps[index];
        let Operation::Call { function, arguments, .. } = &step.operation else { return Ok(Components::new()) };
        let (mut handed, mut types) = (Vec::new(), Vec::new());
        for argument in arguments {
            let (ty, fields) = match argument {
                Expression::Input(operand) if *operand < self.handed.len() => {
                    (self.formula.parameters[*operand], self.handed[*operand].clone())
                }
                other => {
                    let (ty, fields) = self.materialised(other, step.span)?;
                    (ty, self.shifted(ty, fields, false))
                }
            };
            types.push(ty);
            let names = field_names(self.spec, ty);
            let ty = if let Output::Type(index) = ty { Some(index) } else { None };
            handed.push((ty, names.into_iter().zip(fields).collect()));
        }
        let function = function.segments.last().map(|segment| segment.ident.to_string()).unwrap_or_default();
        let node = self.lowering.builder.call(CallNode { call: index, function, arguments: handed }, &step.name);
        self.calls.insert(index, node);
        self.arguments.insert(index, types);
        Ok(Components::new())
    }

    /// The value of an argument: of its stated type, or of the smallest one that holds it.
    fn materialised(&mut self, argument: &Expression, span: Span) -> syn::Result<(Output, Vec<Scaled>)> {
        if let Expression::Input(operand) = argument
            && let (Some(ty), Some(fields)) = (self.formula.type_of(*operand), &self.fields[*operand])
        {
            return Ok((ty, fields.clone()));
        }
        let components = self.value(argument, span)?;
        let message = || {
            let blades = blades(self.spec, &components);
            Error::new(span, format!("no declared type holds an argument of this call: {blades}"))
        };
        infer::infer(self.spec, &mut self.lowering.builder, &components, false).ok_or_else(message)
    }

    /// A result of a call: of its numbers nothing is known but their type.
    fn part(&mut self, step: &Step, call: usize, part: usize) -> syn::Result<()> {
        let ty = step.ty.unwrap_or(Output::Scalar);
        let index = call - self.formula.parameters.len();
        let tuple = matches!(self.formula.steps[index].operation, Operation::Call { tuple: true, .. });
        let node = self.calls.get(&index).copied().unwrap_or_default();
        let values = self.lowering.builder.entries()[node].fingerprint;
        let fields = self.sampled(ty, &format!("{values:?} {part}"), |builder, field, values| {
            let path = match (tuple, field.is_empty()) {
                (true, true) => part.to_string(),
                (true, false) => format!("{part}.{field}"),
                (false, _) => field.to_string(),
            };
            builder.part(node, &path, values)
        })?;
        let fields = self.shifted(ty, fields, true);
        self.add(ty, fields, &step.name);
        Ok(())
    }

    fn finish(mut self) -> (Lowered, Plan) {
        let mut results = Vec::new();
        let mut world = Vec::new();
        for operand in &self.formula.results {
            let ty = self.formula.type_of(*operand).unwrap_or(Output::Scalar);
            let fields = self.fields[*operand].clone().unwrap_or_default();
            let back = self.shifted(ty, fields.clone(), false);
            world.push(back.iter().map(|value| self.lowering.builder.fingerprint(*value)).collect());
            let relative = matches!(self.formula.source.options.frame, Frame::Relative(_));
            results.push((ty, if relative { fields } else { back }));
        }
        let Self { lowering, signs, arguments, .. } = self;
        let (builder, plan) = lowering.finish();
        (Lowered { builder, results, world, signs, arguments }, plan)
    }
}

fn blades(spec: &Spec, components: &Components) -> String {
    let blades: Vec<String> = components.keys().map(|blade| spec.signature.name(*blade)).collect();
    if blades.is_empty() { "it is zero".into() } else { format!("it has the blades {}", blades.join(", ")) }
}

fn misfit(spec: &Spec, components: &Components, ty: Output) -> String {
    let Output::Type(index) = ty else {
        return format!("the result is no scalar: {}", blades(spec, components));
    };
    let ty = &spec.types[index];
    let all = blades(spec, components);
    if components.keys().all(|blade| ty.coefficients.contains_key(blade)) {
        return format!(
            "`{}` does not hold the result: {all}, but what the type states of its coefficients is not proved of it",
            ty.name
        );
    }
    format!("`{}` does not hold the result: {all}", ty.name)
}

//! The steps of a formula, one by one, to scalar nodes: parameters and the frame, calls, and the results.

mod arithmetic;

use crate::alternatives::Plan;
use crate::blade::Blade;
use crate::body::{Formula, Operation, Step};
use crate::expression::Expression;
use crate::field::{Fingerprint, Stream};
use crate::formula::Lowered;
use crate::frame;
use crate::header::Frame;
use crate::infer::{self, Output};
use crate::item::field_names;
use crate::lower::{Components, Lowering, reversed};
use crate::program::{Argument, Builder, CallNode, NodeId, Scaled};
use crate::scalar::Rational;
use crate::spec::Spec;
use arithmetic::blades;
use proc_macro2::TokenStream;
use std::collections::BTreeMap;
use syn::Error;
/// A formula on its way to scalars. The operands of its expressions are the parameters of the lowering.
pub(crate) struct Evaluation<'a> {
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
    pub(crate) fn new(spec: &'a Spec, formula: &'a Formula, plan: Plan) -> syn::Result<Self> {
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
        let factors = match ty {
            Output::Type(index) => self.lowering.factors_of(&self.spec.types[index], &fields, hint),
            Output::Scalar => None,
        };
        let components = self.components(ty, &fields, hint);
        self.lowering.push(components, factors);
        self.fields.push(Some(fields));
    }

    /// Moves every parameter into the frame; one whose type translations do not keep stays as it is.
    pub(crate) fn enter(&mut self, origin: &syn::Ident) -> syn::Result<()> {
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
            if let Output::Type(ty) = ty {
                let factors = self.lowering.factors_of(&self.spec.types[ty], &fields, &name.to_string());
                self.lowering.factors[index] = factors;
            }
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

    fn value(&mut self, expression: &Expression, place: &TokenStream) -> syn::Result<Components> {
        let undefined =
            || Error::new_spanned(place, "this has no value: a dual needs a pseudoscalar with a square other than 0");
        self.lowering.lower(expression).ok_or_else(undefined)
    }

    fn scalar(&mut self, expression: &Expression, place: &TokenStream, what: &str) -> syn::Result<Scaled> {
        let components = self.value(expression, place)?;
        let scalar = components.get(&Blade::SCALAR).copied().filter(|_| components.len() == 1);
        match (components.is_empty(), scalar) {
            (true, _) => Ok(Scaled::ZERO),
            (false, Some(value)) => Ok(value),
            (false, None) => {
                Err(Error::new_spanned(place, format!("{what} is no scalar: {}", blades(self.spec, &components))))
            }
        }
    }

    /// Computes the next step; one that no result needs has no value.
    pub(crate) fn step(&mut self, index: usize, needed: bool) -> syn::Result<()> {
        let step = &self.formula.steps[index];
        if !needed {
            self.lowering.push(Components::new(), None);
            self.fields.push(None);
            return Ok(());
        }
        let components = match &step.operation {
            Operation::Value(value) => self.value(value, &step.place)?,
            Operation::Normalised(value) => self.by_norm(index, value)?,
            Operation::Sqrt(value) => self.root(value, &step.place)?,
            Operation::Quotient(a, b) => self.quotient(a, b, &step.place)?,
            Operation::Component(of, component) => self.component(*of, *component, &step.place)?,
            Operation::Call { .. } => self.call(index)?,
            Operation::Part(call, part) => return self.part(step, *call, *part),
            Operation::Typed { value, normalised, declared } => {
                let ty = step.ty.unwrap_or(Output::Scalar);
                let fields = self.typed(index, value, *normalised, ty, declared)?;
                self.add(ty, fields, &step.name);
                return Ok(());
            }
        };
        let scalar = components.get(&Blade::SCALAR).copied();
        self.fields.push(step.ty.map(|_| vec![scalar.unwrap_or(Scaled::ZERO)]));
        self.lowering.push(components, None);
        Ok(())
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
                    let (ty, fields) = self.materialised(other, &step.place)?;
                    (ty, self.shifted(ty, fields, false))
                }
            };
            types.push(ty);
            let names = field_names(self.spec, ty);
            let ty = if let Output::Type(index) = ty { Some(index) } else { None };
            handed.push(Argument { ty, fields: names.into_iter().zip(fields).collect() });
        }
        let function = function.segments.last().map(|segment| segment.ident.to_string()).unwrap_or_default();
        let node = self.lowering.builder.call(CallNode { call: index, function, arguments: handed }, &step.name);
        self.calls.insert(index, node);
        self.arguments.insert(index, types);
        Ok(Components::new())
    }

    /// The value of an argument: of its stated type, or of the smallest one that holds it.
    fn materialised(&mut self, argument: &Expression, place: &TokenStream) -> syn::Result<(Output, Vec<Scaled>)> {
        if let Expression::Input(operand) = argument
            && let (Some(ty), Some(fields)) = (self.formula.type_of(*operand), &self.fields[*operand])
        {
            return Ok((ty, fields.clone()));
        }
        let components = self.value(argument, place)?;
        let message = || {
            let blades = blades(self.spec, &components);
            Error::new_spanned(place, format!("no declared type holds an argument of this call: {blades}"))
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

    pub(crate) fn finish(mut self) -> (Lowered, Plan) {
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

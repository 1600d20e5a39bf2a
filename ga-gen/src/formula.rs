//! Formulas, compiled as a whole: step by step to scalar nodes, in the world or in a local frame, then to a program.
//!
//! In a local frame (`local = a`, `relative = a`) the point `a` is the origin and every other parameter is moved there
//! by the translator of `a` ("difference first"): rounds built in world coordinates lose `eps |a|^2` of their size
//! squared, in the frame of one of their own points they lose nothing. `local` moves the result back, `relative` leaves
//! it. That a frame leaves the value as it is, is proved ([`crate::frame`]).

use crate::alternatives::{Plan, cheapest, cost};
use crate::body::Formula;
use crate::evaluate::Evaluation;
use crate::field::Fingerprint;
use crate::frame;
use crate::header::Frame;
use crate::infer::Output;
use crate::item::field_names;
use crate::optimise::{Effort, optimise};
use crate::program::{Builder, Program, Scaled};
use crate::scalar::Rational;
use crate::spec::Spec;
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
#[derive(Clone)]
pub struct Compiled {
    /// As read.
    pub formula: Formula,
    /// The scalar code. A result of several names its numbers `0.e1`.
    pub program: Program,
    /// For each step that divides by a norm, the sign of the norm's square.
    pub signs: Vec<Option<Rational>>,
    /// For each step that is a call, the types of the arguments.
    pub arguments: BTreeMap<usize, Vec<Output>>,
    /// How it was lowered.
    pub plan: Plan,
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
pub(crate) fn cheapest_in(spec: &Spec, formula: &Formula, world: &[Vec<Fingerprint>]) -> syn::Result<Option<Compiled>> {
    let compiled = |plan: Plan| -> syn::Result<Option<(Compiled, Plan)>> {
        // The first way has a value; in another one none may be found, say no sum of squares: it is then no rival.
        let Ok((lowered, plan)) = lower(spec, formula, plan) else { return Ok(None) };
        if lowered.world != world {
            return Ok(None);
        }
        let program = optimise(&lowered.builder, &outputs(spec, formula, &lowered.results), Effort::Whole);
        let (signs, arguments) = (lowered.signs, lowered.arguments);
        Ok(Some((Compiled { formula: formula.clone(), program, signs, arguments, plan: plan.clone() }, plan)))
    };
    Ok(cheapest(compiled, |compiled| &compiled.program)?.map(|(compiled, _)| compiled))
}

/// The names and values of all numbers of the results.
#[must_use]
pub fn outputs(spec: &Spec, formula: &Formula, results: &[(Output, Vec<Scaled>)]) -> Vec<(String, Scaled)> {
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

/// Lowers a formula by a plan; also returns the plan with what it was asked.
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

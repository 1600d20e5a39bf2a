//! Local frames: how a formula gets into one, and the proof that it may.
//!
//! A formula may be evaluated with one of its points as origin if its value, moved back, is the same. That is decided at
//! the random points, like every identity here: the program in the frame and the one in the world have equal
//! fingerprints. What changes under translations (`no`, `e1`, a free vector, a coordinate) makes them differ, unless it
//! cancels.

use crate::alternatives::Plan;
use crate::blade::Blade;
use crate::body::{Formula, Tied};
use crate::expression::Expression;
use crate::formula::{Lowered, lower};
use crate::header::Frame;
use crate::infer::{self, Output};
use crate::lower::{Components, Lowering, Schedule};
use crate::program::Scaled;
use crate::sandwich::Sandwich;
use crate::scalar::Rational;
use crate::signature::Kind as Metric;
use crate::spec::Spec;
use syn::{Error, Ident};

/// The translator that leads from the frame of a parameter back to the world: `T = 1 - p ninf / 2`, with p the
/// Euclidean part of the point.
///
/// # Errors
/// The parameter is no normalised point, or the algebra has none.
pub fn translator(
    spec: &Spec,
    formula: &Formula,
    parameters: &[Components],
    origin: &Ident,
) -> syn::Result<Components> {
    let fault = |message: String| Error::new(origin.span(), message);
    let names = &formula.source.header.parameters;
    let position = names.iter().position(|(name, _)| name == origin);
    let position = position.ok_or_else(|| fault(format!("no parameter `{origin}`")))?;
    let kinds = spec.signature.kinds();
    let pair = kinds.iter().position(|kind| *kind == Metric::PairFirst(-1));
    let pair = pair.ok_or_else(|| fault("a local frame needs a null pair with inner product -1".into()))?;
    let point = &parameters[position];
    let weight = point.get(&Blade::vector(pair)).copied();
    if weight != Some(Scaled::ONE) || point.keys().any(|blade| blade.grade() != 1) {
        let message = format!("`{origin}` is no normalised point: a frame needs a vector whose `{}` is 1", {
            spec.signature.name(Blade::vector(pair))
        });
        return Err(fault(message));
    }
    let infinity = Blade::vector(pair + 1);
    let mut translator = Components::from([(Blade::SCALAR, Scaled::ONE)]);
    for (blade, value) in point {
        let euclidean =
            kinds.iter().enumerate().any(|(i, kind)| Blade::vector(i) == *blade && matches!(kind, Metric::Square(_)));
        if euclidean {
            let half = Rational::new(-1, 2).unwrap_or(Rational::ONE);
            // The blade `e ninf` by its sorted name: the vectors of the pair may stand before e.
            let terms = spec.signature.geometric(*blade, infinity);
            translator.extend(terms.iter().map(|(product, sign)| (*product, value.scaled(half * *sign))));
        }
    }
    Ok(translator)
}

/// The formula in the frame of each of its parameters in turn, where none was named.
#[must_use]
pub fn automatic(formula: &Formula) -> Vec<Formula> {
    if !matches!(formula.source.options.frame, Frame::World) {
        return vec![];
    }
    let names = formula.source.header.parameters.iter().map(|(name, _)| name.clone());
    let framed = names.map(|name| {
        let mut framed = formula.clone();
        framed.source.options.frame = Frame::Local(name);
        framed
    });
    framed.collect()
}

/// The fields of a value of a type after a translation; `None` where translations do not keep the type.
pub fn moved(
    spec: &Spec,
    lowering: &mut Lowering<'_>,
    translator: &Components,
    ty: Output,
    fields: &[Scaled],
) -> Option<Vec<Scaled>> {
    let Output::Type(index) = ty else { return Some(fields.to_vec()) };
    let components = lowering.of_type(&spec.types[index], fields, "local");
    let image = lowering.sandwich_by(Sandwich::Commutator, translator, &components);
    held(lowering, &image, index)
}

/// The fields of a type that hold a value, of a factored type as well.
pub fn held(lowering: &mut Lowering<'_>, value: &Components, index: usize) -> Option<Vec<Scaled>> {
    let fields = infer::fit(lowering.spec, &mut lowering.builder, value, index);
    fields.or_else(|| lowering.factor_fields(value, index))
}

/// Proves that a formula has the same value in its frame and in the world; `local` is none where it has no value in its
/// frame.
///
/// # Errors
/// It has not: on what is tied to the origin, if that is found.
pub fn prove(spec: &Spec, formula: &Formula, local: Option<&Lowered>) -> syn::Result<()> {
    let (option, origin) = match &formula.source.options.frame {
        Frame::World => return Ok(()),
        Frame::Local(origin) => ("local", origin),
        Frame::Relative(origin) => ("relative", origin),
    };
    let mut world = formula.clone();
    world.source.options.frame = Frame::World;
    let world = lower(spec, &world, Plan::default()).map(|(world, _)| world);
    match (&world, local) {
        (Ok(world), Some(local)) if world.world == local.world => return Ok(()),
        // Wrong in the world as well: what is wrong is said there, not here.
        (Err(_), None) => return Ok(()),
        _ => {}
    }
    let tied = tied(spec, formula, origin)?;
    let names: Vec<String> = tied.iter().map(|(_, text)| format!("`{text}`")).collect();
    let cause = match &names[..] {
        [] => "its value depends on where the origin is".to_string(),
        [one] => format!("{one} is tied to the origin"),
        several => format!("{} are tied to the origin", several.join(", ")),
    };
    let span = tied.first().map_or(origin.span(), |(span, _)| *span);
    Err(Error::new(span, format!("this formula cannot be evaluated with `{option} = {origin}`: {cause}")))
}

/// What a translation changes and the frame cannot move along.
fn tied(spec: &Spec, formula: &Formula, origin: &Ident) -> syn::Result<Vec<(proc_macro2::Span, String)>> {
    let mut lowering = Lowering::new(spec, Plan::default(), Schedule::Stable);
    for ((name, _), ty) in formula.source.header.parameters.iter().zip(&formula.parameters) {
        match ty {
            Output::Type(index) => lowering.add_parameter(&name.to_string(), *index)?,
            Output::Scalar => lowering.push(Components::new(), None),
        }
    }
    let parameters = lowering.parameters.clone();
    let translator = translator(spec, formula, &parameters, origin)?;
    let mut found: Vec<(proc_macro2::Span, String)> = Vec::new();
    for fixed in &formula.fixed {
        let changes = match &fixed.what {
            Tied::Component => true,
            Tied::Constant(constant) => {
                let terms = if let Expression::Constant(terms) = constant { terms.clone() } else { continue };
                let value: Components = terms.into_iter().map(|(b, c)| (b, Scaled::constant(c))).collect();
                lowering.sandwich_by(Sandwich::Commutator, &translator, &value) != value
            }
            Tied::Parameter(index) => match formula.parameters[*index] {
                Output::Scalar => false,
                Output::Type(ty) => {
                    let value = &parameters[*index];
                    let image = lowering.sandwich_by(Sandwich::Commutator, &translator, value);
                    let unread = formula.unused.iter().any(|name| *name == fixed.text);
                    !unread && held(&mut lowering, &image, ty).is_none()
                }
            },
        };
        if changes && !found.iter().any(|(_, text)| *text == fixed.text) {
            found.push((fixed.span, fixed.text.clone()));
        }
    }
    Ok(found)
}

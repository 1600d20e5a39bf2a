//! Kernels: named formulas of an algebra, compiled as a whole, in the world or in a local frame.
//!
//! In a local frame (`local a`, `relative a`) the point `a` is the origin and every other parameter is moved there by
//! the translator of `a` ("difference first"): rounds built in world coordinates lose `eps |a|^2` of their size squared,
//! in the frame of one of their own points they lose nothing. `local` moves the result back, `relative` leaves it.

use crate::blade::Blade;
use crate::expression::Expression;
use crate::infer::{self, Output};
use crate::lower::{Components, Lowering, reversed};
use crate::parse::{Frame, KernelSource};
use crate::product::Kind;
use crate::program::Scaled;
use crate::sandwich::Sandwich;
use crate::scalar::Rational;
use crate::signature::Kind as Metric;
use crate::spec::Spec;
use crate::types::integer;
use std::collections::BTreeMap;
use syn::spanned::Spanned;
use syn::{BinOp, Error, Expr, Ident, UnOp};

/// Lowers a kernel: the type of the result and its fields.
///
/// # Errors
/// A sentence on the token at fault: unknown names, unsupported syntax, a result that the declared type does not hold.
pub fn lower(lowering: &mut Lowering<'_>, source: &KernelSource) -> syn::Result<(Output, Vec<Scaled>)> {
    let spec = lowering.spec;
    let mut types = Vec::new();
    for (position, (name, ty)) in source.parameters.iter().enumerate() {
        if source.parameters[..position].iter().any(|(earlier, _)| earlier == name) {
            return Err(Error::new(name.span(), format!("parameter `{name}` stands twice")));
        }
        let index = find_type(spec, ty)?;
        lowering.add_parameter(&name.to_string(), index)?;
        types.push(index);
    }
    if types.iter().all(|index| spec.types[*index].fields.is_empty()) {
        let message = "a kernel needs a parameter that stores numbers: without one it has no scalar to compute in";
        return Err(Error::new(source.name.span(), message));
    }
    let translator = enter_frame(lowering, spec, source, &types)?;
    let expression = Reader { spec, source }.expression(&source.body)?;
    let (body, normalised) = match expression {
        Expression::Normalised(inner) => (*inner, true),
        other => (other, false),
    };
    let fault = |message: &str| Error::new(source.body.span(), message);
    let undefined = || {
        fault(
            "this has no value: a dual needs a pseudoscalar with a square other than 0, normalised() a weight or a square of one sign",
        )
    };
    if source.output == "Scalar" {
        if normalised {
            return Err(fault("a scalar is not normalised: it would be 1 or -1"));
        }
        let components = lowering.lower(&body).ok_or_else(undefined)?;
        if components.is_empty() {
            return Err(fault("the result is identically zero"));
        }
        let value = components.get(&Blade::SCALAR).copied().filter(|_| components.len() == 1);
        let misfit =
            || Error::new(source.output.span(), format!("the result is no scalar: {}", describe(spec, &components)));
        let value = value.ok_or_else(misfit)?;
        return Ok((Output::Scalar, vec![value]));
    }
    let index = find_type(spec, &source.output)?;
    let weight = spec.types[index].weight();
    let mut components = match (normalised, weight) {
        (true, None) => lowering.lower(&Expression::Normalised(Box::new(body))),
        _ => lowering.lower(&body),
    }
    .ok_or_else(undefined)?;
    if components.is_empty() {
        return Err(fault("the result is identically zero"));
    }
    if let (true, Some(weight)) = (normalised, weight) {
        let zero = || fault("the weight of the result is identically zero");
        (components, _) = divide_by_weight(lowering, &components, weight).ok_or_else(zero)?;
    }
    let misfit = || {
        Error::new(
            source.output.span(),
            format!("`{}` does not hold the result: {}", source.output, describe(spec, &components)),
        )
    };
    let mut fields = infer::fit(spec, &mut lowering.builder, &components, index).ok_or_else(misfit)?;
    if let (Frame::Local(_), Some(translator)) = (&source.frame, translator) {
        let local = lowering.of_type(&spec.types[index], &fields, "local");
        let world = lowering.sandwich_by(Sandwich::Commutator, &translator, &local);
        fields = infer::fit(spec, &mut lowering.builder, &world, index).ok_or_else(misfit)?;
    }
    Ok((Output::Type(index), fields))
}

fn describe(spec: &Spec, components: &Components) -> String {
    let blades: Vec<String> = components.keys().map(|blade| spec.signature.name(*blade)).collect();
    format!("it has the blades {}", blades.join(", "))
}

fn find_type(spec: &Spec, name: &Ident) -> syn::Result<usize> {
    let known: Vec<String> = spec.types.iter().map(|ty| ty.name.to_string()).collect();
    spec.find(&name.to_string()).ok_or_else(|| {
        Error::new(name.span(), format!("no type `{name}` in this algebra; there are {}", known.join(", ")))
    })
}

/// Divides by the coefficient that the type fixes; also returns by what it multiplied. One division: the reciprocal carries the factor that most stored
/// coefficients share.
pub fn divide_by_weight(
    lowering: &mut Lowering<'_>,
    components: &Components,
    weight: (Blade, Rational),
) -> Option<(Components, Scaled)> {
    let (blade, constant) = weight;
    let weight = components.get(&blade)?.scaled(constant.recip()?);
    let inverse = weight.coefficient.recip()?;
    let mut shares: BTreeMap<Rational, usize> = BTreeMap::new();
    for value in components.iter().filter(|(other, _)| **other != blade).map(|(_, value)| value) {
        *shares.entry((value.coefficient * inverse).abs()).or_insert(0) += 1;
    }
    let share = shares.into_iter().max_by_key(|(_, count)| *count).map_or(Rational::ONE, |(share, _)| share);
    let reciprocal = lowering.builder.quotient(share * weight.coefficient, weight, "inv_weight")?;
    let factor = reciprocal.scaled((share * weight.coefficient).recip()?);
    Some((lowering.scaled(components, factor), factor))
}

/// Moves every parameter into the frame; returns the translator that leads back.
fn enter_frame(
    lowering: &mut Lowering<'_>,
    spec: &Spec,
    source: &KernelSource,
    types: &[usize],
) -> syn::Result<Option<Components>> {
    let origin = match &source.frame {
        Frame::World => return Ok(None),
        Frame::Local(name) | Frame::Relative(name) => name,
    };
    let position = source.parameters.iter().position(|(name, _)| name == origin);
    let position = position.ok_or_else(|| Error::new(origin.span(), format!("no parameter `{origin}`")))?;
    let kinds = spec.signature.kinds();
    let infinity = kinds.iter().position(|kind| *kind == Metric::PairFirst(-1)).map(|first| Blade::vector(first + 1));
    let infinity =
        infinity.ok_or_else(|| Error::new(origin.span(), "a local frame needs a null pair with inner product -1"))?;
    // T = 1 - p ninf / 2, with p the Euclidean part of the (normalised) point.
    let mut translator = Components::from([(Blade::SCALAR, Scaled::ONE)]);
    for (blade, value) in lowering.parameters[position].clone() {
        let euclidean = blade.grade() == 1
            && kinds.iter().enumerate().any(|(i, kind)| Blade::vector(i) == blade && matches!(kind, Metric::Square(_)));
        if euclidean {
            let half = Rational::new(-1, 2).unwrap_or(Rational::ONE);
            translator.insert(Blade(blade.0 | infinity.0), value.scaled(half));
        }
    }
    let back = reversed(&translator);
    for (index, ty) in types.iter().enumerate() {
        let name = &source.parameters[index].0;
        let components = lowering.parameters[index].clone();
        let mark = lowering.builder.entries().len();
        let moved = lowering.sandwich_by(Sandwich::Commutator, &back, &components);
        let fields = infer::fit(spec, &mut lowering.builder, &moved, *ty).ok_or_else(|| {
            Error::new(
                name.span(),
                "this parameter's type is not kept by a translation, so it cannot enter a local frame",
            )
        })?;
        // The derived coefficients are formed anew, from the differences.
        lowering.builder.forget_since(mark, &fields);
        lowering.parameters[index] = lowering.of_type(&spec.types[*ty], &fields, &name.to_string());
    }
    Ok(Some(translator))
}

/// Reads a Rust expression as a multivector expression.
struct Reader<'a> {
    spec: &'a Spec,
    source: &'a KernelSource,
}

impl Reader<'_> {
    fn expression(&self, expression: &Expr) -> syn::Result<Expression> {
        match expression {
            Expr::Paren(inner) => self.expression(&inner.expr),
            Expr::Path(path) => self.name(path.path.require_ident()?),
            Expr::Lit(literal) => Ok(Expression::Constant([(Blade::SCALAR, integer(&literal.lit)?.into())].into())),
            Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
                Ok(Expression::Sum(vec![(-Rational::ONE, self.expression(&unary.expr)?)]))
            }
            Expr::Binary(binary) => self.binary(binary),
            Expr::MethodCall(call) => self.method(call),
            other => Err(Error::new(
                other.span(),
                "a kernel has names, integers, + - * / ^ | &, brackets and the methods rev, dual, undual, grade, apply, normalised",
            )),
        }
    }

    fn name(&self, name: &Ident) -> syn::Result<Expression> {
        if let Some(index) = self.source.parameters.iter().position(|(parameter, _)| parameter == name) {
            return Ok(Expression::Input(index));
        }
        let constant = self.spec.types.iter().find(|ty| ty.name == *name && ty.fields.is_empty());
        if let Some(ty) = constant {
            let terms = ty.coefficients.iter().filter_map(|(blade, c)| Some((*blade, c.as_constant()?)));
            return Ok(Expression::Constant(terms.collect()));
        }
        Err(Error::new(name.span(), format!("`{name}` is neither a parameter nor a constant type of the algebra")))
    }

    fn binary(&self, binary: &syn::ExprBinary) -> syn::Result<Expression> {
        refuse_bare_mix(binary)?;
        let a = self.expression(&binary.left)?;
        if let (BinOp::Div(_), Expr::Lit(literal)) = (&binary.op, &*binary.right) {
            let inverse = Rational::from(integer(&literal.lit)?).recip();
            let inverse = inverse.ok_or_else(|| Error::new(literal.span(), "division by zero"))?;
            return Ok(Expression::Sum(vec![(inverse, a)]));
        }
        let b = self.expression(&binary.right)?;
        match binary.op {
            BinOp::Add(_) => Ok(Expression::sum(a, Rational::ONE, b)),
            BinOp::Sub(_) => Ok(Expression::sum(a, -Rational::ONE, b)),
            BinOp::Mul(_) => Ok(Expression::product(Kind::Geometric, a, b)),
            BinOp::BitXor(_) => Ok(Expression::product(Kind::Outer, a, b)),
            BinOp::BitOr(_) => Ok(Expression::product(Kind::Contraction, a, b)),
            BinOp::BitAnd(_) => Ok(Expression::Meet(Box::new(a), Box::new(b))),
            _ => Err(Error::new(binary.op.span(), "no such operator on multivectors; division is by an integer only")),
        }
    }

    fn method(&self, call: &syn::ExprMethodCall) -> syn::Result<Expression> {
        let receiver = Box::new(self.expression(&call.receiver)?);
        let arguments: Vec<&Expr> = call.args.iter().collect();
        match (call.method.to_string().as_str(), &arguments[..]) {
            ("rev", []) => Ok(Expression::Reverse(receiver)),
            ("dual", []) => Ok(Expression::Dual(receiver)),
            ("undual", []) => Ok(Expression::Undual(receiver)),
            ("normalised", []) => Ok(Expression::Normalised(receiver)),
            ("apply", [x]) => Ok(Expression::Sandwich(receiver, Box::new(self.expression(x)?))),
            ("grade", [Expr::Lit(grade)]) => {
                Ok(Expression::Grade(u32::try_from(integer(&grade.lit)?).unwrap_or(u32::MAX), receiver))
            }
            _ => Err(Error::new(
                call.method.span(),
                "a multivector has rev(), dual(), undual(), grade(k), apply(x) and normalised()",
            )),
        }
    }
}

/// Rust binds `+ -` tighter than `&`, `^`, `|`, in this order, which is not how products are read on paper.
fn refuse_bare_mix(binary: &syn::ExprBinary) -> syn::Result<()> {
    let rank = |op: &BinOp| match op {
        BinOp::BitAnd(_) => Some(1),
        BinOp::BitXor(_) => Some(2),
        BinOp::BitOr(_) => Some(3),
        BinOp::Add(_) | BinOp::Sub(_) => Some(0),
        _ => None,
    };
    let Some(outer) = rank(&binary.op) else {
        return Ok(());
    };
    for side in [&*binary.left, &*binary.right] {
        if let Expr::Binary(inner) = side
            && rank(&inner.op).is_some_and(|inner| inner != outer)
        {
            return Err(Error::new(
                inner.op.span(),
                "put brackets round this: Rust binds + - tighter than &, & tighter than ^, and ^ tighter than |",
            ));
        }
    }
    Ok(())
}

//! Named types: sets of blades with what is known about their coefficients.

use crate::blade::Blade;
use crate::parse::{TypeBody, TypeSource};
use crate::polynomial::Polynomial;
use crate::scalar::Rational;
use crate::signature::Signature;
use crate::spec::parse_blade;
use crate::storage::{Readout, readouts};
use std::collections::BTreeMap;
use syn::spanned::Spanned;
use syn::{Attribute, BinOp, Error, Expr, Ident, Lit, UnOp};

/// A named type.
#[derive(Clone)]
pub struct Type {
    /// The name, with the user's span.
    pub name: Ident,
    /// Doc comments.
    pub docs: Vec<Attribute>,
    /// Declared by the base algebra, not by this one.
    pub shared: bool,
    /// Stored numbers, in order.
    pub fields: Vec<String>,
    /// The coefficient of every blade that is present, in terms of the fields.
    pub coefficients: BTreeMap<Blade, Polynomial>,
    /// `X ~X = 1` holds for every value.
    pub unit: bool,
    /// Has `apply`.
    pub versor: bool,
    /// How each field is read from the coefficients, where it is linear in them.
    pub readouts: Vec<Option<Readout>>,
    /// The two types whose product it is: `Pose = Translator * Rotor` stores the fields of both.
    pub factors: Option<Box<[Type; 2]>>,
}

impl Type {
    /// Every coefficient is a stored number, and nothing else is known: closed under sums and multiples.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        !self.unit && self.coefficients.values().all(|coefficient| coefficient.as_stored().is_some())
    }

    /// A versor that is stored otherwise than by its blades: factored, or split on a null pair.
    #[must_use]
    pub fn is_compact(&self) -> bool {
        let mixed = |readout: &Option<Readout>| readout.as_ref().is_none_or(|readout| readout.terms.len() > 1);
        self.versor && self.readouts.iter().any(mixed)
    }

    /// Is minus a value the value of all fields negated?
    #[must_use]
    pub fn negates(&self) -> bool {
        self.coefficients.values().flat_map(Polynomial::terms).all(|(fields, _)| fields.len() == 1)
    }

    /// The fields of the scalar 1, for versor types.
    #[must_use]
    pub fn identity(&self) -> Vec<Rational> {
        if let Some(factors) = &self.factors {
            return factors.iter().flat_map(Self::identity).collect();
        }
        let one = |(blade, factor): &(Blade, Rational)| if *blade == Blade::SCALAR { *factor } else { Rational::ZERO };
        let field = |readout: &Readout| readout.terms.iter().fold(readout.constant, |sum, term| sum + one(term));
        self.readouts.iter().map(|readout| readout.as_ref().map_or(Rational::ZERO, field)).collect()
    }

    /// The one blade whose coefficient is constant, if there is one: the weight of points and spheres.
    #[must_use]
    pub fn weight(&self) -> Option<(Blade, Rational)> {
        let mut constants = self.coefficients.iter().filter_map(|(blade, c)| Some((*blade, c.as_constant()?)));
        constants.next().filter(|_| constants.next().is_none())
    }

    /// The grades that occur.
    #[must_use]
    pub fn grades(&self) -> Vec<u32> {
        let mut grades: Vec<u32> = self.coefficients.keys().map(|blade| blade.grade()).collect();
        grades.sort_unstable();
        grades.dedup();
        grades
    }
}

/// Checks a declaration; `known` are the types declared before it.
///
/// # Errors
/// A sentence on the token at fault.
pub fn check_type(signature: &Signature, source: &TypeSource, known: &[Type]) -> syn::Result<Type> {
    let mut ty = Type {
        name: source.name.clone(),
        docs: source.docs.clone(),
        shared: false,
        fields: vec![],
        coefficients: BTreeMap::new(),
        unit: false,
        versor: false,
        readouts: vec![],
        factors: None,
    };
    for fact in &source.facts {
        match fact.to_string().as_str() {
            "unit" => ty.unit = true,
            "versor" => ty.versor = true,
            other => {
                return Err(Error::new(fact.span(), format!("unknown fact `{other}`; there are `unit` and `versor`")));
            }
        }
    }
    if ty.versor && !ty.unit {
        return Err(Error::new(
            source.name.span(),
            "a versor type is `unit + versor`: apply does not divide by the norm",
        ));
    }
    match &source.body {
        TypeBody::Stored(blades) => stored(signature, blades, &mut ty)?,
        TypeBody::Sum(expression) => match factors(&source.body, known) {
            Some([a, b]) => multiply(signature, a, b, expression, &mut ty)?,
            None => {
                ty.coefficients = evaluate(signature, &mut ty.fields, expression)?;
                ty.coefficients.retain(|_, coefficient| !coefficient.is_zero());
            }
        },
    }
    check_coefficients(&ty)?;
    ty.readouts = readouts(&ty.coefficients, ty.fields.len());
    Ok(ty)
}

/// `[s = 1, e23, ..]`
fn stored(signature: &Signature, blades: &[(Ident, Option<Lit>)], ty: &mut Type) -> syn::Result<()> {
    for (name, constant) in blades {
        let (blade, odd) = parse_blade(signature, name)?;
        let magnitude = match constant {
            Some(literal) if integer(literal)? == 0 => {
                return Err(Error::new(literal.span(), format!("leave `{name}` out, and it is 0")));
            }
            Some(literal) => Polynomial::constant(integer(literal)?.into()),
            None => Polynomial::field(ty.fields.len()),
        };
        let coefficient = magnitude.scaled(if odd { -Rational::ONE } else { Rational::ONE });
        if ty.coefficients.insert(blade, coefficient).is_some() {
            return Err(Error::new(name.span(), format!("blade `{name}` stands twice in this type")));
        }
        if constant.is_none() {
            ty.fields.push(name.to_string());
        }
    }
    Ok(())
}

/// The names A and B of the body `A * B`, if it has this form.
fn factor_names(body: &TypeBody) -> Option<[&Ident; 2]> {
    let TypeBody::Sum(body) = body else { return None };
    let Expr::Binary(binary) = &**body else { return None };
    let BinOp::Mul(_) = binary.op else { return None };
    let [Expr::Path(a), Expr::Path(b)] = [&*binary.left, &*binary.right] else { return None };
    Some([a.path.get_ident()?, b.path.get_ident()?])
}

/// Is it declared as a product of two types?
#[must_use]
pub fn is_factored(source: &TypeSource, names: &[&Ident]) -> bool {
    factor_names(&source.body).is_some_and(|factors| factors.iter().all(|factor| names.contains(factor)))
}

fn factors<'a>(body: &TypeBody, known: &'a [Type]) -> Option<[&'a Type; 2]> {
    let [a, b] = factor_names(body)?.map(|name| known.iter().find(|ty| ty.name == *name));
    Some([a?, b?])
}

/// `A * B`: the fields of both versors, and the coefficients of their geometric product.
fn multiply(signature: &Signature, a: &Type, b: &Type, body: &Expr, ty: &mut Type) -> syn::Result<()> {
    if !(a.versor && b.versor && ty.versor) || a.factors.is_some() || b.factors.is_some() {
        let message = "a factored type is `unit + versor`, and the product of two versor types that are not factored";
        return Err(Error::new(body.span(), message));
    }
    if let Some(twice) = a.fields.iter().find(|field| b.fields.contains(field)) {
        let message = format!("both factors have a number `{twice}`; name it differently in one of them");
        return Err(Error::new(body.span(), message));
    }
    let shift = a.fields.len();
    for (blade_a, x) in &a.coefficients {
        for (blade_b, y) in &b.coefficients {
            let product = x.times(&y.shifted(shift));
            for (blade, factor) in signature.geometric(*blade_a, *blade_b) {
                let sum = ty.coefficients.entry(*blade).or_default();
                *sum = sum.plus(&product.scaled(*factor));
            }
        }
    }
    ty.coefficients.retain(|_, coefficient| !coefficient.is_zero());
    ty.fields = [&a.fields[..], &b.fields[..]].concat();
    ty.factors = Some(Box::new([a.clone(), b.clone()]));
    Ok(())
}

/// The largest part of a fraction in a type: the product of two of them still has 32 bits.
const LARGEST_CONSTANT: i128 = 1 << 15;

fn check_coefficients(ty: &Type) -> syn::Result<()> {
    let fault = |message: String| Err(Error::new(ty.name.span(), message));
    if ty.coefficients.is_empty() {
        return fault("this type has no blade".into());
    }
    if let Some(idle) = (0..ty.fields.len()).find(|f| !ty.coefficients.values().any(|c| c.fields().contains(f))) {
        return fault(format!("the number `{}` of this type cancels", ty.fields[idle]));
    }
    let mut constants = ty.coefficients.values().flat_map(Polynomial::terms).map(|(_, constant)| constant);
    let large =
        |c: &Rational| !c.fits() || c.numerator().abs() > LARGEST_CONSTANT || c.denominator() > LARGEST_CONSTANT;
    match constants.find(large) {
        Some(constant) => fault(format!("{constant} is too large for a constant of a type: up to {LARGEST_CONSTANT}")),
        None => Ok(()),
    }
}

/// Evaluates the sum form of a type: identifiers are blades, or else fields in order of appearance.
fn evaluate(
    signature: &Signature,
    fields: &mut Vec<String>,
    expression: &Expr,
) -> syn::Result<BTreeMap<Blade, Polynomial>> {
    let only = |blade, polynomial| BTreeMap::from([(blade, polynomial)]);
    match expression {
        Expr::Paren(inner) => evaluate(signature, fields, &inner.expr),
        Expr::Lit(literal) => Ok(only(Blade::SCALAR, Polynomial::constant(integer(&literal.lit)?.into()))),
        Expr::Path(path) => {
            let name = path.path.require_ident()?;
            if let Some((blade, odd)) = signature.parse(&name.to_string()) {
                return Ok(only(blade, Polynomial::constant(if odd { -Rational::ONE } else { Rational::ONE })));
            }
            // A field could have such a name; but whoever writes it means a blade.
            if name.to_string().strip_prefix('e').is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit())) {
                parse_blade(signature, name)?;
            }
            let known = fields.iter().position(|field| name == field);
            let index = known.unwrap_or_else(|| {
                fields.push(name.to_string());
                fields.len() - 1
            });
            Ok(only(Blade::SCALAR, Polynomial::field(index)))
        }
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
            Ok(scale(evaluate(signature, fields, &unary.expr)?, &Polynomial::constant(-Rational::ONE)))
        }
        Expr::Binary(binary) => {
            let a = evaluate(signature, fields, &binary.left)?;
            let b = evaluate(signature, fields, &binary.right)?;
            let scalar =
                |m: &BTreeMap<Blade, Polynomial>| (m.len() == 1).then(|| m.get(&Blade::SCALAR).cloned()).flatten();
            match (&binary.op, scalar(&a), scalar(&b)) {
                (BinOp::Add(_), ..) => Ok(add(a, &b)),
                (BinOp::Sub(_), ..) => Ok(add(a, &scale(b, &Polynomial::constant(-Rational::ONE)))),
                (BinOp::Mul(_), Some(factor), _) => Ok(scale(b, &factor)),
                (BinOp::Mul(_), _, Some(factor)) => Ok(scale(a, &factor)),
                (BinOp::Div(_), _, Some(divisor)) => {
                    let inverse = divisor.as_constant().and_then(Rational::recip);
                    let inverse = inverse
                        .ok_or_else(|| Error::new(binary.right.span(), "only division by a number other than zero"))?;
                    Ok(scale(a, &Polynomial::constant(inverse)))
                }
                _ => Err(Error::new(
                    expression.span(),
                    "a coefficient is a polynomial in the fields, times one basis blade",
                )),
            }
        }
        other => Err(Error::new(
            other.span(),
            "a type is a sum like `x*e1 + no + (x*x)/2*ninf`: + - * /, fields, blades and integers",
        )),
    }
}

fn add(mut a: BTreeMap<Blade, Polynomial>, b: &BTreeMap<Blade, Polynomial>) -> BTreeMap<Blade, Polynomial> {
    for (blade, coefficient) in b {
        let sum = a.get(blade).map_or_else(|| coefficient.clone(), |known| known.plus(coefficient));
        a.insert(*blade, sum);
    }
    a
}

fn scale(a: BTreeMap<Blade, Polynomial>, factor: &Polynomial) -> BTreeMap<Blade, Polynomial> {
    a.into_iter().map(|(blade, coefficient)| (blade, coefficient.times(factor))).collect()
}

/// An integer literal that fits 32 bits.
///
/// # Errors
/// Any other literal.
pub fn integer(literal: &Lit) -> syn::Result<i32> {
    match literal {
        Lit::Int(value) => {
            let fault = |_| Error::new(value.span(), format!("integers here go up to {}", i32::MAX));
            value.base10_parse().map_err(fault)
        }
        other => Err(Error::new(
            other.span(),
            "numbers in a formula are integers; write 1/2 for a half, so that it stays exact",
        )),
    }
}

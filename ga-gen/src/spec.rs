//! A checked algebra: its metric, its types as sets of blades with knowledge, its kernels.

use crate::blade::Blade;
use crate::field::{Fingerprint, POINTS, Residue, Stream};
use crate::parse::{Basis, KernelSource, Source, TypeBody, TypeSource};
use crate::polynomial::Polynomial;
use crate::product::Pseudoscalar;
use crate::scalar::Rational;
use crate::signature::Signature;
use std::cell::RefCell;
use std::collections::BTreeMap;
use syn::spanned::Spanned;
use syn::{Attribute, BinOp, Error, Expr, Ident, Lit, UnOp, Visibility};

/// A named type.
#[derive(Clone, Debug)]
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
}

impl Type {
    /// Every coefficient is a stored number, and nothing else is known: closed under sums and multiples.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        !self.unit && self.coefficients.values().all(|coefficient| coefficient.as_stored().is_some())
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

/// A checked algebra.
#[derive(Clone, Debug)]
pub struct Spec {
    /// Its name.
    pub name: Ident,
    /// Visibility of its types.
    pub visibility: Visibility,
    /// The module of the base algebra.
    pub extends: Option<syn::Path>,
    /// The metric.
    pub signature: Signature,
    /// `I`; `None` where it was not declared.
    pub pseudoscalar: Option<Pseudoscalar>,
    /// Named types; those of the base algebra first, unless redeclared.
    pub types: Vec<Type>,
    /// Named formulas.
    pub kernels: Vec<KernelSource>,
    /// What [`Self::sample`] found before: nearly every operation has parameters of the same two names.
    samples: RefCell<BTreeMap<(usize, String), Vec<Fingerprint>>>,
}

impl Spec {
    /// Checks a source.
    ///
    /// # Errors
    /// A sentence on the token at fault.
    pub fn new(source: &Source, base: Option<&Self>) -> syn::Result<Self> {
        let mut signature = base.map(|base| base.signature.clone()).unwrap_or_default();
        add_basis(&mut signature, &source.basis)?;
        if signature.dimension() == 0 {
            let message = "this algebra has no basis vector; write `basis e1 = 1, e2 = 1;` with their squares";
            return Err(Error::new(source.name.span(), message));
        }
        let pseudoscalar = source.pseudoscalar.as_ref().map(|(negative, blade)| {
            let (found, odd) = parse_blade(&signature, blade)?;
            if found.grade() as usize != signature.dimension() {
                let all = signature.names().join(", ");
                let message = format!("the pseudoscalar is the product of all basis vectors: {all}");
                return Err(Error::new(blade.span(), message));
            }
            Ok(Pseudoscalar::new(&signature, if *negative == odd { Rational::ONE } else { -Rational::ONE }))
        });
        let redeclared = |name: &Ident| source.types.iter().any(|own| own.name == *name);
        let shared = base.map(|base| base.types.clone()).unwrap_or_default();
        let mut types: Vec<Type> = shared.into_iter().filter(|t| !redeclared(&t.name)).collect();
        types.iter_mut().for_each(|shared| shared.shared = true);
        for own in &source.types {
            if types.iter().any(|known| known.name == own.name) {
                return Err(Error::new(own.name.span(), format!("type `{}` is declared twice", own.name)));
            }
            types.push(check_type(&signature, own)?);
        }
        check_names(source)?;
        Ok(Self {
            name: source.name.clone(),
            visibility: source.visibility.clone(),
            extends: source.extends.clone(),
            signature,
            pseudoscalar: pseudoscalar.transpose()?,
            types,
            kernels: source.kernels.clone(),
            samples: RefCell::default(),
        })
    }

    /// The index of a type.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<usize> {
        self.types.iter().position(|known| known.name == name)
    }

    /// Does the type hold every blade? Such a type is never chosen for a result by itself.
    #[must_use]
    pub fn is_full(&self, index: usize) -> bool {
        self.types[index].coefficients.len() == 1 << self.signature.dimension()
    }

    /// Random values for the fields of a type, from its own manifold: unit types are sampled from unit elements.
    ///
    /// # Errors
    /// A unit type that is neither an even versor nor a vector.
    pub fn sample(&self, index: usize, parameter: &str) -> syn::Result<Vec<Fingerprint>> {
        let key = (index, parameter.to_string());
        if let Some(known) = self.samples.borrow().get(&key) {
            return Ok(known.clone());
        }
        let fields = self.new_sample(index, parameter)?;
        self.samples.borrow_mut().insert(key, fields.clone());
        Ok(fields)
    }

    fn new_sample(&self, index: usize, parameter: &str) -> syn::Result<Vec<Fingerprint>> {
        let ty = &self.types[index];
        let mut stream = Stream::named(&format!("{parameter}: {}", ty.name));
        let mut fields = vec![Fingerprint::constant(Rational::ZERO); ty.fields.len()];
        let mut elements = Vec::new();
        for point in 0..POINTS {
            let element = if ty.unit { Some(self.unit_element(ty, &mut stream)?) } else { None };
            for (field, values) in fields.iter_mut().enumerate() {
                values.0[point] = match &element {
                    None => stream.next_residue(),
                    Some(element) => stored_value(ty, field, element),
                };
            }
            elements.extend(element);
        }
        let contradicts = |(blade, polynomial): (&Blade, &Polynomial)| {
            let Fingerprint(values) = polynomial.fingerprint(&fields);
            elements.iter().zip(values).any(|(element, value)| value_of(element, *blade) != value)
        };
        if ty.coefficients.iter().any(contradicts) {
            let message = "`unit` contradicts the constants of this type: a unit multivector has other coefficients";
            return Err(Error::new(ty.name.span(), message));
        }
        Ok(fields)
    }

    /// A random unit element: a product of `(a + b B)^2 / (a^2 - b^2 B^2)` over basis bivectors B, applied to a basis
    /// vector if the type is a vector.
    fn unit_element(&self, ty: &Type, stream: &mut Stream) -> syn::Result<Dense> {
        let blades: Vec<Blade> = ty.coefficients.keys().copied().collect();
        let is_vector = blades.iter().all(|blade| blade.grade() == 1);
        let bivectors: Vec<Blade> = if is_vector {
            pairs(&blades)
        } else {
            blades.iter().copied().filter(|blade| blade.grade() == 2).collect()
        };
        let mut versor: Dense = [(Blade::SCALAR, Residue::ONE)].into();
        for blade in [&bivectors[..], &bivectors[..]].concat() {
            let (a, b) = (stream.next_residue(), stream.next_residue());
            let factor: Dense = [(Blade::SCALAR, a), (blade, b)].into();
            let square = self.dense_product(&[(blade, Residue::ONE)].into(), &[(blade, Residue::ONE)].into());
            let square = square.get(&Blade::SCALAR).copied().unwrap_or(Residue::ZERO);
            let norm = a.times(a).plus(b.times(b).times(square).negated()).inverse();
            let mut unit = self.dense_product(&factor, &factor);
            unit.values_mut().for_each(|value| *value = value.times(norm));
            versor = self.dense_product(&versor, &unit);
        }
        let element = if is_vector {
            let start =
                blades.iter().copied().find(|b| self.signature.geometric(*b, *b) == [(Blade::SCALAR, Rational::ONE)]);
            let start = start.unwrap_or_default();
            let image = self.dense_product(&versor, &[(start, Residue::ONE)].into());
            self.dense_product(&image, &reversed(&versor))
        } else {
            versor
        };
        let inside =
            element.iter().all(|(blade, value)| *value == Residue::ZERO || ty.coefficients.contains_key(blade));
        let even = is_vector || blades.iter().all(|blade| blade.grade() % 2 == 0);
        if !(inside && even) {
            let message =
                "`unit` is for even versors that form a group, and for vectors; this set of blades is neither";
            return Err(Error::new(ty.name.span(), message));
        }
        Ok(element)
    }

    fn dense_product(&self, a: &Dense, b: &Dense) -> Dense {
        let mut result = Dense::new();
        for (blade_a, x) in a {
            for (blade_b, y) in b {
                for (blade, c) in self.signature.geometric(*blade_a, *blade_b) {
                    let sum = result.entry(blade).or_insert(Residue::ZERO);
                    *sum = sum.plus(x.times(*y).times(c.into()));
                }
            }
        }
        result
    }
}

/// A multivector over the prime field.
type Dense = BTreeMap<Blade, Residue>;

fn reversed(a: &Dense) -> Dense {
    a.iter().map(|(b, value)| (*b, if b.reverse_is_negative() { value.negated() } else { *value })).collect()
}

fn value_of(element: &Dense, blade: Blade) -> Residue {
    element.get(&blade).copied().unwrap_or(Residue::ZERO)
}

fn pairs(vectors: &[Blade]) -> Vec<Blade> {
    let all = vectors.iter().flat_map(|a| vectors.iter().map(move |b| (a, b)));
    all.filter(|(a, b)| a < b).map(|(a, b)| Blade(a.0 | b.0)).collect()
}

fn stored_value(ty: &Type, field: usize, element: &Dense) -> Residue {
    let stored = ty.coefficients.iter().find_map(|(blade, coefficient)| {
        let (factor, index) = coefficient.as_stored()?;
        (index == field).then_some((blade, factor))
    });
    stored.map_or(Residue::ZERO, |(blade, factor)| {
        let value = value_of(element, *blade);
        value.times(factor.recip().unwrap_or(Rational::ONE).into())
    })
}

/// Names that generated code uses itself, and kernels that share one.
fn check_names(source: &Source) -> syn::Result<()> {
    for ty in &source.types {
        if ["T", "Scalar", "Algebra", "Dual", "Undual", "Meet"].iter().any(|taken| ty.name == taken) {
            let message = format!("`{}` means something else in generated code; name the type differently", ty.name);
            return Err(Error::new(ty.name.span(), message));
        }
    }
    for (index, kernel) in source.kernels.iter().enumerate() {
        let twice = source.kernels[..index].iter().any(|earlier| earlier.name == kernel.name);
        if twice || ["dual", "undual", "meet"].iter().any(|taken| kernel.name == taken) {
            return Err(Error::new(kernel.name.span(), format!("a function `{}` exists already", kernel.name)));
        }
    }
    Ok(())
}

/// A blade is named by its factors, so their names must not read like blades themselves.
fn check_basis_name(name: &Ident) -> syn::Result<()> {
    let text = name.to_string();
    let digits = text.strip_prefix('e').is_some_and(|rest| rest.len() > 1 && rest.bytes().all(|b| b.is_ascii_digit()));
    if digits || text.contains('_') || text.starts_with("r#") {
        let message = format!("`{text}` reads like a blade; name basis vectors like e1 or ninf, without underscore");
        return Err(Error::new(name.span(), message));
    }
    Ok(())
}

fn add_basis(signature: &mut Signature, basis: &[Basis]) -> syn::Result<()> {
    for item in basis {
        let names = match item {
            Basis::Vector(name, _) => vec![name],
            Basis::Pair(first, second, _) => vec![first, second],
        };
        for (index, name) in names.iter().enumerate() {
            check_basis_name(name)?;
            if signature.names().iter().any(|known| *name == known) || *name == "s" || names[..index].contains(name) {
                return Err(Error::new(name.span(), format!("basis vector `{name}` is already taken")));
            }
        }
        match item {
            Basis::Vector(name, square) => signature.push(name.to_string(), *square),
            Basis::Pair(first, second, inner) => signature.push_pair(first.to_string(), second.to_string(), *inner),
        }
        if signature.dimension() > Signature::MAX_DIMENSION {
            let message =
                format!("more than {} basis vectors: unrolled products would not pay", Signature::MAX_DIMENSION);
            return Err(Error::new(names[0].span(), message));
        }
    }
    Ok(())
}

/// Reads a blade name, or says which basis vectors there are.
///
/// # Errors
/// The name is no blade of this algebra.
pub fn parse_blade(signature: &Signature, name: &Ident) -> syn::Result<(Blade, bool)> {
    signature.parse(&name.to_string()).ok_or_else(|| {
        let known = signature.names().join(", ");
        Error::new(name.span(), format!("`{name}` is no basis blade; the basis vectors are {known}, blades are named like e12 or e1_ninf, and s is the scalar"))
    })
}

fn check_type(signature: &Signature, source: &TypeSource) -> syn::Result<Type> {
    let mut ty = Type {
        name: source.name.clone(),
        docs: source.docs.clone(),
        shared: false,
        fields: vec![],
        coefficients: BTreeMap::new(),
        unit: false,
        versor: false,
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
        TypeBody::Stored(blades) => {
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
        }
        TypeBody::Sum(expression) => {
            ty.coefficients = evaluate(signature, &mut ty.fields, expression)?;
            ty.coefficients.retain(|_, coefficient| !coefficient.is_zero());
        }
    }
    check_coefficients(&ty)?;
    Ok(ty)
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

//! A checked algebra: its metric, and its types as sets of blades with knowledge.

use crate::blade::Blade;
use crate::field::Fingerprint;
use crate::parse::{Basis, Source};
use crate::product::Pseudoscalar;
use crate::scalar::Rational;
use crate::signature::Signature;
use crate::split::{Depth, SplitBasis};
use crate::types::{Type, check_type, is_factored};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use syn::{Error, Ident, Visibility};

/// A checked algebra.
#[derive(Clone)]
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
    /// What [`Self::sample`] found before: nearly every operation has parameters of the same two names.
    pub(crate) samples: RefCell<BTreeMap<(usize, String), Vec<Fingerprint>>>,
    /// Split bases that were asked for.
    splits: RefCell<BTreeMap<Depth, Option<Rc<SplitBasis>>>>,
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
        // Factored types stand on the others, wherever they are declared.
        let names: Vec<&Ident> = types.iter().map(|ty| &ty.name).chain(source.types.iter().map(|t| &t.name)).collect();
        let (factored, plain): (Vec<_>, Vec<_>) = source.types.iter().partition(|ty| is_factored(ty, &names));
        for own in plain.into_iter().chain(factored) {
            if types.iter().any(|known| known.name == own.name) {
                return Err(Error::new(own.name.span(), format!("type `{}` is declared twice", own.name)));
            }
            types.push(check_type(&signature, own, &types)?);
        }
        let declared = |ty: &Type| source.types.iter().position(|own| own.name == ty.name);
        types.sort_by_key(|ty| declared(ty).filter(|_| !ty.shared));
        check_names(source)?;
        Ok(Self {
            name: source.name.clone(),
            visibility: source.visibility.clone(),
            extends: source.extends.clone(),
            signature,
            pseudoscalar: pseudoscalar.transpose()?,
            types,
            samples: RefCell::default(),
            splits: RefCell::default(),
        })
    }

    /// The index of a type.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<usize> {
        self.types.iter().position(|known| known.name == name)
    }

    /// The split basis of the metric, if there is one.
    #[must_use]
    pub fn split_basis(&self, depth: Depth) -> Option<Rc<SplitBasis>> {
        let mut known = self.splits.borrow_mut();
        known.entry(depth).or_insert_with(|| SplitBasis::new(&self.signature, depth).map(Rc::new)).clone()
    }

    /// Is there a dual: a declared `I` with a square other than 0?
    #[must_use]
    pub fn has_dual(&self) -> bool {
        self.pseudoscalar.is_some_and(|i| !i.square.is_zero())
    }

    /// Does the type hold every blade? Such a type is never chosen for a result by itself.
    #[must_use]
    pub fn is_full(&self, index: usize) -> bool {
        self.types[index].coefficients.len() == 1 << self.signature.dimension()
    }
}

/// Names that generated code uses itself.
fn check_names(source: &Source) -> syn::Result<()> {
    for ty in &source.types {
        if ["T", "Scalar", "Algebra", "Dual", "Undual", "Meet"].iter().any(|taken| ty.name == taken) {
            let message = format!("`{}` means something else in generated code; name the type differently", ty.name);
            return Err(Error::new(ty.name.span(), message));
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
        let all = signature.name(Blade((1 << signature.dimension()) - 1));
        let message = format!("`{name}` is no basis blade; the basis vectors are {known}, all of them together are named like {all}, and s is the scalar");
        Error::new(name.span(), message)
    })
}

//! From multivector expressions to scalar nodes, product by product.
//!
//! Stepwise lowering: the components of every intermediate multivector are made nodes in normal form, so equal minors
//! of a wedge meet by themselves. Some products have several lowerings; the caller tries them and keeps the cheapest
//! program (see [`crate::alternatives`]).

use crate::alternatives::Plan;
use crate::blade::Blade;
use crate::expression::Expression;
use crate::field::Fingerprint;
use crate::product::{self, Kind, blade_product};
use crate::program::{Builder, Scaled};
use crate::scalar::Rational;
use crate::signature::Terms;
use crate::spec::Spec;
use crate::types::Type;
use std::collections::BTreeMap;

/// A multivector at lowering: the scalar in front of each blade that is present.
pub type Components = BTreeMap<Blade, Scaled>;

/// How products may be computed where that changes digits, not only operations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Schedule {
    /// By the table of blades; in a split basis only where the operands are stored split, so that no digit is lost.
    #[default]
    Stable,
    /// In a split basis wherever it is cheaper: exact in the algebra, but only as accurate as the largest coefficient.
    Split,
}

/// Lowers expressions over given parameters.
///
/// Where there are several ways to compute something, the plan says which one to take: see [`crate::alternatives`].
pub struct Lowering<'a> {
    pub(crate) spec: &'a Spec,
    /// The graph that grows.
    pub builder: Builder,
    /// The components of each parameter.
    pub parameters: Vec<Components>,
    /// The components of the two factors of each parameter of a factored type.
    pub factors: Vec<Option<[Components; 2]>>,
    schedule: Schedule,
    /// Is a value of a type that is stored split among the operands?
    pub(crate) stored_split: bool,
    plan: Plan,
    products: usize,
}

impl<'a> Lowering<'a> {
    /// A lowering without parameters.
    #[must_use]
    pub fn new(spec: &'a Spec, plan: Plan, schedule: Schedule) -> Self {
        let (builder, parameters, factors) = (Builder::default(), vec![], vec![]);
        Self { spec, builder, parameters, factors, schedule, stored_split: false, plan, products: 0 }
    }

    /// The graph, and the choices that were made.
    #[must_use]
    pub fn finish(self) -> (Builder, Plan) {
        (self.builder, self.plan)
    }

    /// Which of several ways to take.
    pub fn choose(&mut self, what: &'static str, ways: &[&'static str]) -> usize {
        self.plan.choose(what, ways)
    }

    /// The next parameter: a value of a type, reachable by a name.
    ///
    /// # Errors
    /// The type cannot be sampled.
    pub fn add_parameter(&mut self, name: &str, ty: usize) -> syn::Result<()> {
        let samples = self.spec.sample(ty, name)?;
        self.add_sampled(name, ty, samples);
        Ok(())
    }

    /// The next parameter, as if nothing but its stored numbers were known: for the norm of a unit type.
    pub fn add_raw_parameter(&mut self, name: &str, ty: usize) {
        let mut stream = crate::field::Stream::named(name);
        let mut sample = || Fingerprint(std::array::from_fn(|_| stream.next_residue()));
        let samples = self.spec.types[ty].fields.iter().map(|_| sample()).collect();
        self.add_sampled(name, ty, samples);
    }

    fn add_sampled(&mut self, name: &str, ty: usize, samples: Vec<Fingerprint>) {
        let ty = &self.spec.types[ty];
        let fields: Vec<Scaled> =
            ty.fields.iter().zip(samples).map(|(field, f)| self.builder.input(&format!("{name}.{field}"), f)).collect();
        let factors = self.factors_of(ty, &fields, name);
        let components = self.of_type(ty, &fields, name);
        self.push(components, factors);
    }

    /// The next operand, lowered already.
    pub fn push(&mut self, components: Components, factors: Option<[Components; 2]>) {
        self.parameters.push(components);
        self.factors.push(factors);
    }

    /// The components of the two factors of a factored type with given fields.
    pub fn factors_of(&mut self, ty: &Type, fields: &[Scaled], hint: &str) -> Option<[Components; 2]> {
        let [a, b] = &**ty.factors.as_ref()?;
        let (left, right) = fields.split_at(a.fields.len());
        Some([self.of_type(a, left, hint), self.of_type(b, right, hint)])
    }

    /// The components of a type with given fields.
    pub fn of_type(&mut self, ty: &Type, fields: &[Scaled], hint: &str) -> Components {
        self.stored_split |= ty.is_compact();
        let components = ty.coefficients.iter().map(|(blade, polynomial)| {
            if let Some((factor, field)) = polynomial.as_stored() {
                return (*blade, fields[field].scaled(factor));
            }
            let products: Vec<_> =
                polynomial.terms().map(|(f, c)| (c, f.iter().map(|i| fields[*i]).collect())).collect();
            (*blade, self.builder.sum(&products, &format!("{hint}_{}", self.spec.signature.name(*blade))))
        });
        components.collect()
    }

    /// Lowers an expression.
    ///
    /// `None` where the expression has no meaning: a dual without pseudoscalar, division by an identical zero.
    pub fn lower(&mut self, expression: &Expression) -> Option<Components> {
        Some(match expression {
            Expression::Input(index) => self.parameters.get(*index)?.clone(),
            Expression::Constant(terms) => terms.iter().map(|(b, c)| (*b, Scaled::constant(*c))).collect(),
            Expression::Sum(parts) => {
                let lowered: Option<Vec<_>> = parts.iter().map(|(c, part)| Some((*c, self.lower(part)?))).collect();
                self.combine(&lowered?)
            }
            Expression::Product(kind, a, b) => {
                let (a, b) = (self.lower(a)?, self.lower(b)?);
                self.product(*kind, &a, &b)
            }
            Expression::Meet(a, b) => {
                let (a, b) = (self.lower(a)?, self.lower(b)?);
                self.meet(&a, &b)?
            }
            Expression::Reverse(a) => reversed(&self.lower(a)?),
            Expression::Dual(a) => {
                let a = self.lower(a)?;
                self.dual(&a)?
            }
            Expression::Undual(a) => {
                let a = self.lower(a)?;
                self.undual(&a)?
            }
            Expression::Grade(grade, a) => {
                self.lower(a)?.into_iter().filter(|(blade, _)| blade.grade() == *grade).collect()
            }
            Expression::Sandwich(v, x) => {
                let x = self.lower(x)?;
                if let Expression::Input(index) = **v
                    && let Some([a, b]) = self.factors.get(index)?.clone()
                {
                    let inner = self.sandwich(&b, &x);
                    self.sandwich(&a, &inner)
                } else {
                    let v = self.lower(v)?;
                    self.sandwich(&v, &x)
                }
            }
        })
    }

    /// What may be traded for fewer operations.
    #[must_use]
    pub fn schedule(&self) -> Schedule {
        self.schedule
    }

    pub(crate) fn hint(&mut self) -> String {
        const LETTERS: [&str; 6] = ["t", "u", "v", "w", "p", "q"];
        let (round, letter) = (self.products / LETTERS.len(), LETTERS[self.products % LETTERS.len()]);
        self.products += 1;
        if round == 0 { letter.into() } else { format!("{letter}{round}") }
    }

    /// Collects weighted products of scalars into components in normal form.
    pub(crate) fn collect(&mut self, terms: Vec<(Blade, Rational, Vec<Scaled>)>) -> Components {
        let hint = self.hint();
        let mut sums: BTreeMap<Blade, Vec<(Rational, Vec<Scaled>)>> = BTreeMap::new();
        for (blade, coefficient, scalars) in terms {
            sums.entry(blade).or_default().push((coefficient, scalars));
        }
        let mut components = Components::new();
        for (blade, products) in sums {
            let value = self.builder.sum(&products, &format!("{hint}_{}", self.spec.signature.name(blade)));
            if !value.is_zero() {
                components.insert(blade, value);
            }
        }
        components
    }

    pub(crate) fn terms(
        &self,
        kind: Kind,
        a: &Components,
        b: &Components,
        sign: Rational,
    ) -> Vec<(Blade, Rational, Vec<Scaled>)> {
        let pairs = a.iter().flat_map(|x| b.iter().map(move |y| (x, y)));
        pairs
            .flat_map(|((blade_a, x), (blade_b, y))| {
                let terms = blade_product(&self.spec.signature, kind, *blade_a, *blade_b);
                terms.map(move |(blade, c)| (blade, c * sign, vec![*x, *y]))
            })
            .collect()
    }

    /// A bilinear product.
    pub fn product(&mut self, kind: Kind, a: &Components, b: &Components) -> Components {
        if kind == Kind::Geometric
            && let Some(depth) = self.split_depth(a, b)
            && let Some(product) = self.split_product(depth, a, b)
        {
            return product;
        }
        let terms = self.terms(kind, a, b, Rational::ONE);
        self.collect(terms)
    }

    /// A linear combination.
    pub fn combine(&mut self, parts: &[(Rational, Components)]) -> Components {
        let terms = parts.iter().flat_map(|(c, part)| part.iter().map(|(blade, x)| (*blade, *c, vec![*x])));
        self.collect(terms.collect())
    }

    fn map_blades(&mut self, a: &Components, f: impl Fn(Blade) -> Terms) -> Components {
        let terms = a.iter().flat_map(|(blade, x)| f(*blade).into_iter().map(|(image, c)| (image, c, vec![*x])));
        self.collect(terms.collect())
    }

    fn dual(&mut self, a: &Components) -> Option<Components> {
        let pseudoscalar = self.metric_pseudoscalar()?;
        let signature = &self.spec.signature;
        Some(self.map_blades(a, |blade| pseudoscalar.dual(signature, blade)))
    }

    fn undual(&mut self, a: &Components) -> Option<Components> {
        let pseudoscalar = self.metric_pseudoscalar()?;
        let signature = &self.spec.signature;
        Some(self.map_blades(a, |blade| pseudoscalar.undual(signature, blade)))
    }

    /// `undual(dual a ^ dual b)`; where `I^2 = 0`, the same with complements.
    fn meet(&mut self, a: &Components, b: &Components) -> Option<Components> {
        let pseudoscalar = self.spec.pseudoscalar?;
        if !pseudoscalar.square.is_zero() {
            let (a, b) = (self.dual(a)?, self.dual(b)?);
            let outer = self.product(Kind::Outer, &a, &b);
            return self.undual(&outer);
        }
        let [a, b] = [a, b].map(|operand| self.map_blades(operand, |blade| pseudoscalar.complement(blade)));
        let outer = self.product(Kind::Outer, &a, &b);
        Some(self.map_blades(&outer, |blade| pseudoscalar.uncomplement(blade)))
    }

    fn metric_pseudoscalar(&self) -> Option<product::Pseudoscalar> {
        self.spec.pseudoscalar.filter(|i| !i.square.is_zero())
    }

    /// `<a ~a>_0`.
    pub fn norm_sq(&mut self, a: &Components) -> Scaled {
        let product = self.product(Kind::Geometric, a, &reversed(a));
        product.get(&Blade::SCALAR).copied().unwrap_or(Scaled::ZERO)
    }

    /// Every component times one scalar.
    pub fn scaled(&mut self, a: &Components, factor: Scaled) -> Components {
        let terms = a.iter().map(|(blade, x)| (*blade, Rational::ONE, vec![*x, factor]));
        self.collect(terms.collect())
    }
}

/// The reverse.
#[must_use]
pub fn reversed(a: &Components) -> Components {
    let sign = |blade: Blade| {
        if blade.reverse_is_negative() { -Rational::ONE } else { Rational::ONE }
    };
    a.iter().map(|(blade, value)| (*blade, value.scaled(sign(*blade)))).collect()
}

//! Ways to lower a sandwich `v x ~v`, restricted to the grades of x. The caller's plan says which one is taken.

use crate::blade::Blade;
use crate::lower::{Components, Lowering, Schedule, reversed};
use crate::product::Kind;
use crate::program::Scaled;
use crate::scalar::Rational;
use crate::signature::Kind as Metric;
use crate::split::Depth;
use crate::values;

/// A way to compute `v x ~v`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sandwich {
    /// `(v x) ~v`.
    Plain,
    /// `x + (v x - x v) ~v`, for unit versors without dilation only: there, x is added and cancelled.
    Commutator,
    /// All terms at once, for tiny versors, where terms cancel.
    Expanded,
    /// `-1/2 Y ninf ~Y` with `Y = v (no + x P)`, `P = (1 + no_ninf)/2`, for normalised points x = no + x + x²/2 ninf, which
    /// are `T no ~T`. Needs no unit v, and forms no square of x.
    Spinor,
}

impl Sandwich {
    fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Commutator => "commutator",
            Self::Expanded => "expanded",
            Self::Spinor => "spinor",
        }
    }
}

/// Expanding beyond this many triple products is refused.
const EXPANSION_CAP: usize = 128;

/// The most blades of a versor, a translator or a rotor of space, for which two products may be the cheapest way.
const SHORT_VERSOR: usize = 4;

impl Lowering<'_> {
    /// `v x ~v`, restricted to the grades of x, in the way that the plan says.
    pub fn sandwich(&mut self, v: &Components, x: &Components) -> Components {
        let versor = values::of(&self.builder, v);
        let isometry = values::is_isometry(&self.spec.signature, &versor);
        let mut ways = Vec::new();
        // In the commutator the scalar part and half the grades fall out: of a longer versor two products cost more.
        if !isometry || v.len() <= SHORT_VERSOR {
            ways.push(Sandwich::Plain);
        }
        if v.len() * v.len() * x.len() <= EXPANSION_CAP {
            ways.push(Sandwich::Expanded);
        }
        if isometry {
            ways.push(Sandwich::Commutator);
        } else if self.spinor_base(x).is_some() {
            ways.push(Sandwich::Spinor);
        }
        let names: Vec<&str> = ways.iter().map(|way| way.name()).collect();
        let way = ways[self.choose("sandwich", &names)];
        self.sandwich_by(way, v, x)
    }

    /// `v x ~v`, restricted to the grades of x, computed in a given way.
    pub fn sandwich_by(&mut self, way: Sandwich, v: &Components, x: &Components) -> Components {
        let mut result = match way {
            Sandwich::Plain => {
                let half = self.product(Kind::Geometric, v, x);
                self.product(Kind::Geometric, &half, &reversed(v))
            }
            Sandwich::Commutator => self.commutator_sandwich(v, x),
            Sandwich::Expanded => self.expanded_sandwich(v, x),
            Sandwich::Spinor => self.spinor_sandwich(v, x).unwrap_or_default(),
        };
        result.retain(|blade, _| x.keys().any(|known| known.grade() == blade.grade()));
        result
    }

    fn commutator_sandwich(&mut self, v: &Components, x: &Components) -> Components {
        let mut terms = self.terms(Kind::Geometric, v, x, Rational::ONE);
        terms.extend(self.terms(Kind::Geometric, x, v, -Rational::ONE));
        let commutator = self.collect(terms);
        let mut terms = self.terms(Kind::Geometric, &commutator, &reversed(v), Rational::ONE);
        terms.extend(x.iter().map(|(blade, value)| (*blade, Rational::ONE, vec![*value])));
        terms.retain(|(blade, ..)| x.keys().any(|known| known.grade() == blade.grade()));
        self.collect(terms)
    }

    fn expanded_sandwich(&mut self, v: &Components, x: &Components) -> Components {
        let mut terms = Vec::new();
        for (blade_a, c, scalars) in self.terms(Kind::Geometric, v, x, Rational::ONE) {
            for (blade_b, y) in &reversed(v) {
                for (blade, d) in self.spec.signature.geometric(blade_a, *blade_b) {
                    terms.push((*blade, c * *d, [&scalars[..], &[*y]].concat()));
                }
            }
        }
        self.collect(terms)
    }

    fn spinor_sandwich(&mut self, v: &Components, x: &Components) -> Option<Components> {
        let (base, infinity) = self.spinor_base(x)?;
        let y = self.split_product(Depth::Pair, v, &base)?;
        let minus_half = Components::from([(infinity, Scaled::constant(Rational::new(-1, 2)?))]);
        let half = self.split_product(Depth::Pair, &y, &minus_half)?;
        self.split_product(Depth::Pair, &half, &reversed(&y))
    }

    /// `no + x P` of a normalised point, and the vector `ninf`; `None` where x is none, which is proved on random values.
    fn spinor_base(&mut self, x: &Components) -> Option<(Components, Blade)> {
        let kinds = self.spec.signature.kinds();
        let pair = kinds.iter().position(|kind| *kind == Metric::PairFirst(-1))?;
        let (origin, infinity) = (Blade::vector(pair), Blade::vector(pair + 1));
        let weight = *x.get(&origin)?;
        if weight != Scaled::ONE || x.keys().any(|blade| blade.grade() != 1) {
            return None;
        }
        let half = Rational::new(1, 2)?;
        let mut base = Components::from([(origin, Scaled::ONE)]);
        for (blade, value) in x.iter().filter(|(blade, _)| **blade != origin && **blade != infinity) {
            base.insert(*blade, value.scaled(half));
            for (image, sign) in self.spec.signature.geometric(*blade, Blade(origin.0 | infinity.0)) {
                base.insert(*image, value.scaled(half * *sign));
            }
        }
        let signature = &self.spec.signature;
        let spinor = values::of(&self.builder, &base);
        let minus_half = Components::from([(infinity, Scaled::constant(-half))]);
        let image = values::product(signature, &spinor, &values::of(&self.builder, &minus_half));
        let image = values::product(signature, &image, &values::reversed(&spinor));
        (image == values::of(&self.builder, x)).then_some((base, infinity))
    }

    /// How far a product is split: as its operands are stored, or as the schedule allows and the plan says.
    pub(crate) fn split_depth(&mut self, a: &Components, b: &Components) -> Option<Depth> {
        let ways: Vec<Option<Depth>> = match self.schedule() {
            Schedule::Split => vec![None, Some(Depth::Pair), Some(Depth::PairAndVector)],
            Schedule::Stable if self.is_stored_split(a, b) => vec![Some(Depth::Pair), None],
            Schedule::Stable => return None,
        };
        let name = |depth: &Option<Depth>| match depth {
            None => "table",
            Some(Depth::Pair) => "split",
            Some(Depth::PairAndVector) => "split twice",
        };
        let names: Vec<&str> = ways.iter().map(name).collect();
        ways[self.choose("product", &names)]
    }
}

//! Versors stored as a product `A B` of two types: `Pose = Translator * Rotor`.
//!
//! What is stored is the pair, so a product of such versors is wanted as a pair again. Where A is normal in the group of
//! all products (`b a ~b` is of type A for every b of type B), a word of factors sorts itself: every b moves right past
//! the a's that follow it, `b a = (b a ~b) b`. So of `a1 b1 a2 b2` the pair is `a1 (b1 a2 ~b1)` and `b1 b2`: no product of
//! the whole is formed, and nothing is multiplied out to be divided again.

use crate::expression::Expression;
use crate::infer;
use crate::lower::{Components, Lowering, reversed};
use crate::product::Kind;
use crate::program::Scaled;
use crate::types::Type;
use crate::values;

/// A factor of a word: of the first or second of the two types.
struct Letter {
    first: bool,
    value: Components,
}

impl Lowering<'_> {
    /// The fields of a factored type, for an expression that is a word of its factors.
    ///
    /// `None` where it is none, or where the sorted word is not proved to be the same versor.
    pub fn word_fields(&mut self, expression: &Expression, ty: usize) -> Option<Vec<Scaled>> {
        let ty = &self.spec.types[ty];
        let factors = ty.factors.as_ref()?;
        let word = self.word(expression, factors)?;
        let (mut first, mut second): (Option<Components>, Option<Components>) = (None, None);
        for Letter { first: is_first, value } in word {
            if !is_first {
                second = Some(self.times(second, value));
                continue;
            }
            let moved = match &second {
                Some(prefix) => self.sandwich(&prefix.clone(), &value),
                None => value,
            };
            first = Some(self.times(first, moved));
        }
        let whole = self.lower(expression)?;
        self.pair_fields(&first?, &second?, &whole, ty)
    }

    /// The fields of a factored type for any versor that it holds: the second factor is what is left when the first is 1,
    /// and the first is `M ~B`.
    pub fn factor_fields(&mut self, whole: &Components, ty: usize) -> Option<Vec<Scaled>> {
        let ty = &self.spec.types[ty];
        let [_, second] = &**ty.factors.as_ref()?;
        let blades = |blade: &_| second.coefficients.contains_key(blade);
        let second: Components = whole.iter().filter(|(b, _)| blades(*b)).map(|(b, value)| (*b, *value)).collect();
        let first = self.product(Kind::Geometric, whole, &reversed(&second));
        self.pair_fields(&first, &second, whole, ty)
    }

    fn pair_fields(&mut self, a: &Components, b: &Components, whole: &Components, ty: &Type) -> Option<Vec<Scaled>> {
        let signature = &self.spec.signature;
        let [x, y, z] = [a, b, whole].map(|part| values::of(&self.builder, part));
        if values::product(signature, &x, &y) != z {
            return None;
        }
        let factors = ty.factors.as_ref()?;
        let fields = infer::fit_type(self.spec, &mut self.builder, a, &factors[0])?;
        let rest = infer::fit_type(self.spec, &mut self.builder, b, &factors[1])?;
        Some([fields, rest].concat())
    }

    fn times(&mut self, left: Option<Components>, right: Components) -> Components {
        match left {
            Some(left) => self.product(Kind::Geometric, &left, &right),
            None => right,
        }
    }

    fn word(&mut self, expression: &Expression, factors: &[Type; 2]) -> Option<Vec<Letter>> {
        match expression {
            Expression::Product(Kind::Geometric, a, b) => {
                let mut word = self.word(a, factors)?;
                word.extend(self.word(b, factors)?);
                Some(word)
            }
            Expression::Reverse(a) => {
                let mut word = self.word(a, factors)?;
                word.reverse();
                word.iter_mut().for_each(|letter| letter.value = reversed(&letter.value));
                Some(word)
            }
            Expression::Input(index) => match self.factors.get(*index)?.clone() {
                Some([a, b]) => Some(vec![Letter { first: true, value: a }, Letter { first: false, value: b }]),
                None => {
                    let value = self.parameters.get(*index)?.clone();
                    let holds = |ty| infer::fit_type(self.spec, &mut self.builder, &value, ty).is_some();
                    let first = factors.iter().position(holds)? == 0;
                    Some(vec![Letter { first, value }])
                }
            },
            _ => None,
        }
    }
}

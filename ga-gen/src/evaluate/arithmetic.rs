//! Steps that can fail, each in its place: norms, roots, quotients, components, values of a declared type.

use super::Evaluation;
use crate::blade::Blade;
use crate::body::Component;
use crate::expression::Expression;
use crate::frame;
use crate::infer::{self, Output};
use crate::lower::Components;
use crate::normalise::{by_norm, by_weight};
use crate::print::output_name;
use crate::program::Scaled;
use crate::scalar::Rational;
use crate::spec::Spec;
use proc_macro2::TokenStream;
use syn::Error;

impl Evaluation<'_> {
    pub(super) fn by_norm(&mut self, index: usize, value: &Expression) -> syn::Result<Components> {
        let place = &self.formula.steps[index].place;
        let value = self.value(value, place)?;
        if value.is_empty() {
            return Err(Error::new_spanned(place, "this is identically zero: it has no norm to be divided by"));
        }
        let message = "the sign of the square of this is not known: only a sum of squares of one sign has a norm; give \
                       the result a type with a weight, or divide by what you mean";
        let (unit, sign) = by_norm(&mut self.lowering, &value).ok_or_else(|| Error::new_spanned(place, message))?;
        self.signs[index] = Some(sign);
        Ok(unit)
    }

    pub(super) fn root(&mut self, value: &Expression, place: &TokenStream) -> syn::Result<Components> {
        let radicand = self.scalar(value, place, "what stands under this root")?;
        if radicand.node.is_none() && radicand.coefficient.is_negative() {
            return Err(Error::new_spanned(place, format!("the root of {}, a negative number", radicand.coefficient)));
        }
        if radicand.is_zero() {
            return Ok(Components::new());
        }
        let root = self.lowering.builder.sqrt(radicand, "root");
        Ok([(Blade::SCALAR, root)].into())
    }

    pub(super) fn quotient(&mut self, a: &Expression, b: &Expression, place: &TokenStream) -> syn::Result<Components> {
        let divisor = self.scalar(b, place, "the divisor")?;
        let zero = || Error::new_spanned(place, "the divisor is identically zero");
        if let Some(number) = a.as_number() {
            let quotient = self.lowering.builder.quotient(number, divisor, "quotient").ok_or_else(zero)?;
            return Ok([(Blade::SCALAR, quotient)].into());
        }
        let value = self.value(a, place)?;
        let inverse = self.lowering.builder.quotient(Rational::ONE, divisor, "inverse").ok_or_else(zero)?;
        Ok(self.lowering.scaled(&value, inverse))
    }

    pub(super) fn component(
        &mut self,
        of: usize,
        component: Component,
        place: &TokenStream,
    ) -> syn::Result<Components> {
        let value = match component {
            Component::Field(field) => self.fields[of].as_ref().and_then(|fields| fields.get(field)).copied(),
            Component::Coefficient(blade, odd) => {
                let sign = if odd { -Rational::ONE } else { Rational::ONE };
                self.lowering.parameters[of].get(&blade).map(|value| value.scaled(sign))
            }
        };
        let missing = || {
            Error::new_spanned(
                place,
                format!("this component is identically zero: {}", blades(self.spec, &self.lowering.parameters[of])),
            )
        };
        let value = value.ok_or_else(missing)?;
        Ok(self.components(Output::Scalar, &[value], ""))
    }

    /// The fields of a declared type that hold a value.
    pub(super) fn typed(
        &mut self,
        index: usize,
        value: &Expression,
        normalised: bool,
        ty: Output,
        declared: &syn::Ident,
    ) -> syn::Result<Vec<Scaled>> {
        let place = &self.formula.steps[index].place;
        let fault = |message: &str| Error::new_spanned(place, message);
        let weight = match ty {
            Output::Scalar if normalised => return Err(fault("a scalar is not normalised: it would be 1 or -1")),
            Output::Scalar => None,
            Output::Type(index) => self.spec.types[index].weight(),
        };
        let mut components = match (normalised, weight) {
            (true, None) => self.by_norm(index, value)?,
            _ => self.value(value, place)?,
        };
        if components.is_empty() {
            return Err(fault("the result is identically zero"));
        }
        if let (true, Some(weight)) = (normalised, weight) {
            let divided = by_weight(&mut self.lowering, &components, weight);
            (components, _) = divided.ok_or_else(|| fault("the weight of the result is identically zero"))?;
        }
        let fields = match ty {
            // A word of factored versors keeps its factors; of any other value they are found.
            Output::Type(ty) => {
                let word = self.lowering.word_fields(value, ty).filter(|_| !normalised);
                word.or_else(|| frame::held(&mut self.lowering, &components, ty))
            }
            Output::Scalar => {
                let scalar = components.get(&Blade::SCALAR).copied().filter(|_| components.len() == 1);
                scalar.map(|value| vec![value])
            }
        };
        fields.ok_or_else(|| {
            let smallest = infer::infer(self.spec, &mut self.lowering.builder, &components, false);
            let smallest = smallest.map(|(ty, _)| output_name(self.spec, ty));
            Error::new(declared.span(), misfit(self.spec, &components, ty, smallest))
        })
    }
}

pub(super) fn blades(spec: &Spec, components: &Components) -> String {
    let blades: Vec<String> = components.keys().map(|blade| spec.signature.name(*blade)).collect();
    if blades.is_empty() { "it is zero".into() } else { format!("it has the blades {}", blades.join(", ")) }
}

/// What a type does not hold, and the smallest type that does.
fn misfit(spec: &Spec, components: &Components, ty: Output, smallest: Option<String>) -> String {
    let smallest = smallest.map_or_else(String::new, |name| format!("; `{name}` holds it"));
    let all = format!("{}{smallest}", blades(spec, components));
    let Output::Type(index) = ty else { return format!("the result is no scalar: {all}") };
    let ty = &spec.types[index];
    if components.keys().all(|blade| ty.coefficients.contains_key(blade)) {
        return format!(
            "`{}` does not hold the result: what the type states of its coefficients is not proved of it; {all}",
            ty.name
        );
    }
    format!("`{}` does not hold the result: {all}", ty.name)
}

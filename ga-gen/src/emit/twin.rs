//! Tokens of the dynamic twin of a formula: the same steps over the dynamic multivector, in the world, as written.
//!
//! Nothing of the program is used but the signs of norms: the twin is what the program is tested against, and the baseline
//! of measurements. It works in the orthonormal basis, where a null pair `(o, i)` with `o . i = c` stands for `p, m` with
//! `o = c (p - m)/2`, `i = p + m`.

use super::arithmetic;
use super::code::identifier;
use super::formula::type_tokens;
use super::types::{self, orthonormal};
use crate::blade::{Blade, swaps_are_odd};
use crate::body::{Component, Formula, Operation};
use crate::expression::Expression;
use crate::formula::Compiled;
use crate::infer::Output;
use crate::product::Kind as Product;
use crate::scalar::Rational;
use crate::signature::{Kind, Signature};
use crate::spec::Spec;
use crate::types::Type;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use std::collections::BTreeMap;

/// The twin, as a function of a given name.
pub(super) fn twin(spec: &Spec, compiled: &Compiled, name: &Ident) -> TokenStream {
    let formula = &compiled.formula;
    let header = &formula.source.header;
    let (path, visibility) = (&formula.source.options.path, &header.visibility);
    let multivector = quote!(::ga_physics::algebra::dynamic::Dynamic<#path::Algebra, T>);
    let printer = Printer { spec, compiled, formula, multivector: &multivector };
    let parameters = (0..formula.parameters.len()).map(|index| {
        let name = printer.name(index);
        quote!(#name: &#multivector)
    });
    let needed = formula.needed();
    let steps = (0..formula.steps.len()).filter(|index| needed[*index]).map(|index| printer.statement(index));
    let read = formula.read();
    let unread = (0..formula.parameters.len()).filter(|index| !read[*index]).map(|index| {
        let name = printer.name(index);
        quote!(let _ = #name;)
    });
    let results = formula.results.iter().map(|operand| printer.name(*operand));
    let (result, value) = match header.tuple {
        true => {
            let types = formula.results.iter().map(|_| &multivector);
            (quote!((#(#types,)*)), quote!((#(#results,)*)))
        }
        false => (multivector.clone(), quote!(#(#results)*)),
    };
    let doc = format!(
        "The formula [`{}`] over the dynamic multivector, product by product and in the world: what it is tested and \
         measured against.",
        header.name
    );
    quote! {
        #[doc = #doc]
        #visibility fn #name<T: ::ga_physics::algebra::Scalar>(#(#parameters),*) -> #result {
            #(#unread)*
            #(#steps)*
            #value
        }
    }
}

struct Printer<'a> {
    spec: &'a Spec,
    compiled: &'a Compiled,
    formula: &'a Formula,
    multivector: &'a TokenStream,
}

impl Printer<'_> {
    /// The variable of an operand.
    fn name(&self, operand: usize) -> Ident {
        match self.formula.source.header.parameters.get(operand) {
            Some((name, _)) => identifier(&name.to_string()),
            None => format_ident!("step{}", operand - self.formula.parameters.len()),
        }
    }

    /// A reference to the value of an operand.
    fn operand(&self, operand: usize) -> TokenStream {
        let name = self.name(operand);
        if operand < self.formula.parameters.len() { quote!(#name) } else { quote!(&#name) }
    }

    fn statement(&self, index: usize) -> TokenStream {
        let name = self.name(self.formula.parameters.len() + index);
        let step = &self.formula.steps[index];
        let value = match &step.operation {
            Operation::Value(value) => self.owned(value),
            Operation::Typed { value, normalised: false, .. } => self.owned(value),
            Operation::Typed { value, normalised: true, .. } => self.normalised(index, value),
            Operation::Normalised(value) => self.normalised(index, value),
            Operation::Sqrt(value) => {
                let value = self.scalar(value);
                self.scalar_multivector(&quote!(::ga_physics::algebra::Scalar::sqrt(#value)))
            }
            Operation::Quotient(a, b) => {
                let (a, b) = (self.reference(a), self.scalar(b));
                quote!((#a).scaled(T::ratio(1, 1) / #b))
            }
            Operation::Component(of, component) => self.scalar_multivector(&self.component(*of, *component)),
            Operation::Call { function, arguments, .. } => {
                let arguments = arguments.iter().map(|argument| self.reference(argument));
                // The types of the arguments are those that the program found: the call is the same call.
                let types = self.compiled.arguments.get(&index).into_iter().flatten();
                let arguments = arguments.zip(types).map(|(value, ty)| self.materialised(&value, *ty));
                quote!(#function(#(#arguments),*))
            }
            Operation::Part(call, part) => {
                let call_name = self.name(*call);
                let position = call - self.formula.parameters.len();
                let tuple = matches!(self.formula.steps[position].operation, Operation::Call { tuple: true, .. });
                let part = Literal::usize_unsuffixed(*part);
                let value = if tuple { quote!(#call_name.#part) } else { quote!(#call_name) };
                match step.ty {
                    Some(Output::Type(_)) => {
                        let algebra = &self.formula.source.options.path;
                        quote!(::ga_physics::algebra::dynamic::ToDynamic::<#algebra::Algebra, T>::to_dynamic(&#value))
                    }
                    _ => self.scalar_multivector(&value),
                }
            }
        };
        quote!(let #name = #value;)
    }

    /// An expression that owns its value.
    fn owned(&self, expression: &Expression) -> TokenStream {
        match expression {
            Expression::Input(index) => {
                let name = self.name(*index);
                quote!(#name.clone())
            }
            Expression::Constant(terms) => {
                let mut sums: BTreeMap<Blade, Rational> = BTreeMap::new();
                for (blade, value) in terms {
                    for (image, factor) in orthonormal(self.spec, *blade) {
                        let sum = sums.entry(image).or_insert(Rational::ZERO);
                        *sum = *sum + *value * factor;
                    }
                }
                let entries = sums.into_iter().filter(|(_, value)| !value.is_zero()).map(|(blade, value)| {
                    let (blade, value) = (Literal::u32_unsuffixed(blade.0), arithmetic::constant(value));
                    quote!((#blade, #value))
                });
                let multivector = self.multivector;
                quote!(<#multivector>::from_terms(&[#(#entries),*]))
            }
            Expression::Sum(parts) => self.sum(parts),
            Expression::Product(kind, a, b) => {
                let (a, b) = (self.reference(a), self.reference(b));
                match kind {
                    Product::Geometric => quote!(#a * #b),
                    Product::Outer => quote!(#a ^ #b),
                    Product::Contraction => quote!(#a | #b),
                }
            }
            Expression::Meet(a, b) => {
                let (a, b) = (self.reference(a), self.reference(b));
                quote!((#a).__meet(#b))
            }
            Expression::Reverse(a) => self.method(a, &quote!(rev())),
            Expression::Dual(a) => self.method(a, &quote!(__dual())),
            Expression::Undual(a) => self.method(a, &quote!(__undual())),
            Expression::Grade(grade, a) => {
                let grade = Literal::u32_unsuffixed(*grade);
                self.method(a, &quote!(grade(#grade)))
            }
            Expression::Sandwich(v, x) => {
                let x = self.reference(x);
                self.method(v, &quote!(apply(#x)))
            }
        }
    }

    fn scalar_multivector(&self, value: &TokenStream) -> TokenStream {
        let multivector = self.multivector;
        quote!(<#multivector>::from_terms(&[(0, #value)]))
    }

    fn method(&self, receiver: &Expression, call: &TokenStream) -> TokenStream {
        let receiver = self.reference(receiver);
        quote!((#receiver).#call)
    }

    fn sum(&self, parts: &[(Rational, Expression)]) -> TokenStream {
        let mut total: Option<TokenStream> = None;
        for (factor, part) in parts {
            let reference = self.reference(part);
            let term = match *factor {
                one if one == Rational::ONE => self.owned(part),
                minus if minus == -Rational::ONE => quote!(-(#reference)),
                other => {
                    let factor = arithmetic::constant(other);
                    quote!((#reference).scaled(#factor))
                }
            };
            total = Some(match total {
                None => term,
                Some(sum) if *factor == -Rational::ONE => quote!(&(#sum) - #reference),
                Some(sum) => quote!(&(#sum) + &(#term)),
            });
        }
        total.unwrap_or_default()
    }

    /// A reference to the value of an expression.
    fn reference(&self, expression: &Expression) -> TokenStream {
        match expression {
            Expression::Input(index) => self.operand(*index),
            other => {
                let value = self.owned(other);
                quote!(&(#value))
            }
        }
    }

    fn scalar(&self, expression: &Expression) -> TokenStream {
        let value = self.reference(expression);
        quote!((#value).coefficient(0))
    }

    /// Divided by the weight of the step's type, or by the norm.
    fn normalised(&self, index: usize, value: &Expression) -> TokenStream {
        let value = self.owned(value);
        let number = match self.compiled.signs[index] {
            Some(sign) => {
                let sign = arithmetic::constant(sign);
                quote!(::ga_physics::algebra::Scalar::sqrt(#sign * (&value * &value.rev()).coefficient(0)))
            }
            None => {
                let ty = self.formula.steps[index].ty;
                let weight = if let Some(Output::Type(ty)) = ty { self.spec.types[ty].weight() } else { None };
                let (blade, constant) = weight.unwrap_or((Blade::SCALAR, Rational::ONE));
                let weight = coefficient(&self.spec.signature, &quote!(value), blade);
                let inverse = arithmetic::constant(constant.recip().unwrap_or(Rational::ONE));
                if constant == Rational::ONE { weight } else { quote!((#weight) * #inverse) }
            }
        };
        quote! {{
            let value = #value;
            let number = #number;
            value.scaled(T::ratio(1, 1) / number)
        }}
    }

    fn component(&self, of: usize, component: Component) -> TokenStream {
        let value = self.operand(of);
        let value = quote!((#value));
        match (component, self.formula.type_of(of)) {
            (Component::Coefficient(blade, odd), _) => {
                let coefficient = coefficient(&self.spec.signature, &value, blade);
                if odd { quote!(-(#coefficient)) } else { coefficient }
            }
            (Component::Field(field), Some(Output::Type(ty))) => {
                self.fields(&self.spec.types[ty], &value).into_iter().nth(field).unwrap_or_default()
            }
            (Component::Field(_), _) => quote!(#value.coefficient(0)),
        }
    }

    /// A multivector as a value of a declared type.
    fn materialised(&self, value: &TokenStream, ty: Output) -> TokenStream {
        match ty {
            Output::Scalar => quote!((#value).coefficient(0)),
            Output::Type(index) => {
                let fields = self.fields(&self.spec.types[index], &quote!((#value)));
                let built = types::construct(self.spec, index, &fields);
                let path = type_tokens(self.spec, ty);
                quote!({ let built: #path = #built; built })
            }
        }
    }

    /// The fields of a type, read from a multivector that it holds: stored coefficients directly, then those that occur
    /// linearly in a derived one.
    fn fields(&self, ty: &Type, value: &TokenStream) -> Vec<TokenStream> {
        let signature = &self.spec.signature;
        let mut fields: Vec<Option<TokenStream>> = vec![None; ty.fields.len()];
        for (field, readout) in ty.readouts.iter().enumerate() {
            let Some(readout) = readout else { continue };
            let terms = readout.terms.iter().map(|(blade, factor)| {
                let (read, magnitude) = (coefficient(signature, value, *blade), arithmetic::constant(*factor));
                if *factor == Rational::ONE { read } else { quote!(#magnitude * #read) }
            });
            let constant = (!readout.constant.is_zero()).then(|| arithmetic::constant(readout.constant));
            let terms = terms.chain(constant);
            fields[field] = Some(quote!((#(#terms)+*)));
        }
        for (blade, polynomial) in &ty.coefficients {
            let unknown: Vec<usize> =
                polynomial.fields().into_iter().filter(|field| fields[*field].is_none()).collect();
            let [field] = unknown[..] else { continue };
            let Some(inverse) = polynomial.linear_in(field).and_then(Rational::recip) else { continue };
            let read = coefficient(signature, value, *blade);
            let known = polynomial.terms().filter(|(term, _)| !term.contains(&field)).map(|(term, factor)| {
                let (factors, factor) =
                    (term.iter().filter_map(|known| fields[*known].as_ref()), arithmetic::constant(factor));
                quote!(- #factor #(* (#factors))*)
            });
            let (known, inverse) = (known.collect::<TokenStream>(), arithmetic::constant(inverse));
            fields[field] = Some(quote!(((#read) #known) * #inverse));
        }
        let unread = format!("the dynamic twin cannot read the numbers of a `{}`", ty.name);
        fields.into_iter().map(|field| field.unwrap_or_else(|| quote!(::core::compile_error!(#unread)))).collect()
    }
}

/// The coefficient of a blade of the declared basis, from those of the orthonormal one: with `o = c (p - m)/2`,
/// `i = p + m` the coefficient of o is `c (p - m)` and that of i `(p + m)/2`, of the coefficients of p and m; blades are
/// outer products of these.
fn coefficient(signature: &Signature, value: &TokenStream, blade: Blade) -> TokenStream {
    let half = Rational::new(1, 2).unwrap_or(Rational::ONE);
    let mut terms = vec![(Blade::SCALAR, Rational::ONE)];
    for (index, kind) in signature.kinds().iter().enumerate().filter(|(index, _)| blade.contains(*index)) {
        let vector = |index: usize| Blade::vector(index);
        let functional = match kind {
            Kind::Square(_) => vec![(vector(index), Rational::ONE)],
            Kind::PairFirst(c) => {
                let c = Rational::from(i32::from(*c));
                vec![(vector(index), c), (vector(index + 1), -c)]
            }
            Kind::PairSecond => vec![(vector(index - 1), half), (vector(index), half)],
        };
        let mut next: BTreeMap<Blade, Rational> = BTreeMap::new();
        for (a, x) in &terms {
            for (b, y) in functional.iter().filter(|(b, _)| a.0 & b.0 == 0) {
                let sign = if swaps_are_odd(*a, *b) { -Rational::ONE } else { Rational::ONE };
                let sum = next.entry(Blade(a.0 | b.0)).or_insert(Rational::ZERO);
                *sum = *sum + *x * *y * sign;
            }
        }
        terms = next.into_iter().filter(|(_, c)| !c.is_zero()).collect();
    }
    let parts = terms.into_iter().map(|(blade, factor)| {
        let (blade, magnitude) = (Literal::u32_unsuffixed(blade.0), arithmetic::constant(factor.abs()));
        let read = if factor.abs() == Rational::ONE {
            quote!(#value.coefficient(#blade))
        } else {
            quote!(#magnitude * #value.coefficient(#blade))
        };
        if factor.is_negative() { quote!(- #read) } else { quote!(+ #read) }
    });
    let mut tokens = parts.collect::<TokenStream>().into_iter().peekable();
    // The first sign, if it is a plus.
    if tokens.peek().is_some_and(|token| token.to_string() == "+") {
        tokens.next();
    }
    let tokens: TokenStream = tokens.collect();
    quote!((#tokens))
}

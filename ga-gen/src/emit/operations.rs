//! Tokens of the operations: operator impls, traits of the algebra.

use super::{code, types};
use crate::infer::Output;
use crate::item::{Item, Operation};
use crate::print;
use crate::product::Kind;
use crate::spec::Spec;
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

/// The method of an operator.
pub(super) fn method(kind: Kind) -> Ident {
    match kind {
        Kind::Geometric => format_ident!("mul"),
        Kind::Outer => format_ident!("bitxor"),
        Kind::Contraction => format_ident!("bitor"),
    }
}

/// The traits and functions that mean this algebra's dual and meet, also on the types of its base. Without a declared
/// pseudoscalar there are none; without a dual, where `I^2 = 0`, there is the meet alone.
pub(super) fn traits(spec: &Spec) -> TokenStream {
    if spec.pseudoscalar.is_none() {
        return TokenStream::new();
    }
    let duals = if spec.has_dual() { dual_traits(spec) } else { TokenStream::new() };
    let meet = meet_trait(spec);
    quote!(#duals #meet)
}

fn dual_traits(spec: &Spec) -> TokenStream {
    let visibility = &spec.visibility;
    quote! {
        /// `I a`, with this algebra's pseudoscalar.
        #visibility trait Dual {
            /// The smallest type that holds the dual.
            type Output;
            /// `I a`.
            fn dual(self) -> Self::Output;
        }
        /// The inverse of [`Dual`].
        #visibility trait Undual {
            /// The smallest type that holds the result.
            type Output;
            /// `I^-1 a`.
            fn undual(self) -> Self::Output;
        }
        /// `I a`, with this algebra's pseudoscalar.
        #[inline]
        #visibility fn dual<A: Dual>(a: A) -> A::Output { a.dual() }
        /// The inverse of [`dual`].
        #[inline]
        #visibility fn undual<A: Undual>(a: A) -> A::Output { a.undual() }
    }
}

fn meet_trait(spec: &Spec) -> TokenStream {
    let visibility = &spec.visibility;
    let (formula, meaning) = match spec.has_dual() {
        true => ("`undual(dual a ^ dual b)`", "The intersection of direct blades whose join is the whole space."),
        false => (
            "`c⁻¹(c(a) ^ c(b))` with the right complement, `x ^ c(x) = I` for every basis blade x",
            "The regressive product, for `I² = 0` and so there is no dual. `I & a = a`, and `c(a & b) = c(a) ^ c(b)`. \
             Of direct blades whose join is the whole space it is the intersection; where vectors are planes or lines, and \
             `^` intersects, it is the join.",
        ),
    };
    let of_two = format!("{formula}, with this algebra's pseudoscalar.");
    let heading = format!("{formula}.");
    quote! {
        #[doc = #heading]
        #[doc = ""]
        #[doc = #meaning]
        #visibility trait Meet<B> {
            /// The smallest type that holds the meet.
            type Output;
            #[doc = #heading]
            fn meet(self, b: B) -> Self::Output;
        }
        #[doc = #of_two]
        #[inline]
        #visibility fn meet<A: Meet<B>, B>(a: A, b: B) -> A::Output { a.meet(b) }
    }
}

/// The tokens of an item; empty where it cannot be written: an operation on constants alone has no scalar.
pub(super) fn emit(spec: &Spec, item: &Item) -> TokenStream {
    let generic = item.parameters.iter().any(|(_, ty)| !spec.types[*ty].fields.is_empty());
    if !generic {
        return TokenStream::new();
    }
    let output = match item.output {
        Output::Scalar => quote!(T),
        Output::Type(index) => types::path(spec, index),
    };
    let doc = print::documentation(spec, item);
    let body = body(spec, item);
    let operand = |index: usize| types::path(spec, item.parameters[index].1);
    let receiver = code::reads(&item.program, "a").then(|| quote!(let a = self;));
    let argument = if code::reads(&item.program, "b") { format_ident!("b") } else { format_ident!("_b") };
    let scalar = quote!(::ga_physics::algebra::Scalar);
    let inline = code::inline(&item.program);
    match item.operation {
        Operation::Product(kind, ..) => {
            let (a, b, method) = (operand(0), operand(1), method(kind));
            let operator = match kind {
                Kind::Geometric => quote!(Mul),
                Kind::Outer => quote!(BitXor),
                Kind::Contraction => quote!(BitOr),
            };
            quote! {
                impl<T: #scalar> ::core::ops::#operator<#b> for #a {
                    type Output = #output;
                    #[doc = #doc]
                    #inline
                    #[allow(clippy::suspicious_arithmetic_impl, reason = "products of multivectors are sums of products")]
                    fn #method(self, #argument: #b) -> #output { #receiver #body }
                }
            }
        }
        Operation::Meet(left, right) => {
            let (a, b) = (operand(0), operand(1));
            let own = !(spec.types[left].shared && spec.types[right].shared);
            let operator = own.then(|| {
                quote! {
                    impl<T: #scalar> ::core::ops::BitAnd<#b> for #a {
                        type Output = #output;
                        #[doc = #doc]
                        #[inline]
                        fn bitand(self, b: #b) -> #output { Meet::meet(self, b) }
                    }
                }
            });
            quote! {
                impl<T: #scalar> Meet<#b> for #a {
                    type Output = #output;
                    #[doc = #doc]
                    #[inline]
                    fn meet(self, #argument: #b) -> #output { #receiver #body }
                }
                #operator
            }
        }
        Operation::Apply(..) => {
            let (a, b) = (operand(0), operand(1));
            quote! {
                impl<T: #scalar> ::ga_physics::algebra::Apply<#b> for #a {
                    type Output = #output;
                    #[doc = #doc]
                    #inline
                    fn apply(self, #argument: #b) -> #output { #receiver #body }
                }
            }
        }
        Operation::Embed(..) => {
            let a = operand(0);
            quote! {
                impl<T: #scalar> From<#a> for #output {
                    #[doc = #doc]
                    #[inline]
                    fn from(a: #a) -> #output { #body }
                }
            }
        }
        Operation::Reverse(_) => inherent(spec, item, &format_ident!("rev"), &output, &doc, &body),
        Operation::NormSq(_) => inherent(spec, item, &format_ident!("norm_sq"), &output, &doc, &body),
        Operation::Grade(grade, _) => inherent(spec, item, &format_ident!("grade{grade}"), &output, &doc, &body),
        Operation::Dual(_) => {
            unary_trait(spec, item, &format_ident!("Dual"), &format_ident!("dual"), &output, &doc, &body)
        }
        Operation::Undual(_) => {
            unary_trait(spec, item, &format_ident!("Undual"), &format_ident!("undual"), &output, &doc, &body)
        }
    }
}

fn body(spec: &Spec, item: &Item) -> TokenStream {
    let steps = code::steps(&item.program);
    let code::Results { before, after, values } = code::results(&item.program);
    let result = match item.output {
        Output::Scalar => quote!(#(#values)*),
        Output::Type(index) => types::construct(spec, index, &values),
    };
    quote!(#before #steps #after #result)
}

fn inherent(
    spec: &Spec,
    item: &Item,
    name: &Ident,
    output: &TokenStream,
    doc: &str,
    body: &TokenStream,
) -> TokenStream {
    let ty = types::path(spec, item.parameters[0].1);
    quote! {
        impl<T: ::ga_physics::algebra::Scalar> #ty {
            #[doc = #doc]
            #[inline]
            pub fn #name(self) -> #output { let a = self; #body }
        }
    }
}

fn unary_trait(
    spec: &Spec,
    item: &Item,
    name: &Ident,
    method: &Ident,
    output: &TokenStream,
    doc: &str,
    body: &TokenStream,
) -> TokenStream {
    let index = item.parameters[0].1;
    let ty = types::path(spec, index);
    let forward = (!spec.types[index].shared).then(|| {
        quote! {
            impl<T: ::ga_physics::algebra::Scalar> #ty {
                #[doc = #doc]
                #[inline]
                pub fn #method(self) -> #output { #name::#method(self) }
            }
        }
    });
    quote! {
        impl<T: ::ga_physics::algebra::Scalar> #name for #ty {
            type Output = #output;
            #[doc = #doc]
            #[inline]
            fn #method(self) -> #output { let a = self; #body }
        }
        #forward
    }
}

//! Tokens of a formula: the function, from its program.

use super::{code, twin, types};
use crate::body::Operation;
use crate::formula::Compiled;
use crate::infer::Output;
use crate::print;
use crate::program::{Argument, Call};
use crate::spec::Spec;
use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

/// The function of a formula, and its dynamic twin where one is asked for.
#[must_use]
pub fn formula(spec: &Spec, compiled: &Compiled) -> TokenStream {
    let mut tokens = formula_function(spec, compiled);
    if let Some(name) = &compiled.formula.source.options.dynamic {
        let spec = seen_through(spec, &compiled.formula.source.options.path);
        tokens.extend(twin::twin(&spec, compiled, name));
    }
    tokens
}

/// The function alone.
#[must_use]
pub fn formula_function(spec: &Spec, compiled: &Compiled) -> TokenStream {
    function(&seen_through(spec, &compiled.formula.source.options.path), compiled)
}

/// The algebra as code outside of its module sees it: every type is reached through the path of the module.
fn seen_through(spec: &Spec, path: &syn::Path) -> Spec {
    let mut seen = spec.clone();
    seen.extends = Some(path.clone());
    seen.types.iter_mut().for_each(|ty| ty.shared = true);
    seen
}

/// `T`, `cga::Sphere<T>`
pub(super) fn type_tokens(spec: &Spec, ty: Output) -> TokenStream {
    match ty {
        Output::Scalar => quote!(T),
        Output::Type(index) => types::path(spec, index),
    }
}

fn function(spec: &Spec, compiled: &Compiled) -> TokenStream {
    let (formula, header) = (&compiled.formula, &compiled.formula.source.header);
    let (visibility, name, attributes) = (&header.visibility, &header.name, &header.attributes);
    let stores = |ty: &Output| match ty {
        Output::Scalar => true,
        Output::Type(index) => !spec.types[*index].fields.is_empty(),
    };
    let outputs: Vec<Output> = formula.results.iter().filter_map(|operand| formula.type_of(*operand)).collect();
    let generic = formula.parameters.iter().chain(&outputs).any(stores);
    let generics = generic.then(|| quote!(<T: ::ga_physics::algebra::Scalar>));
    let parameters = header.parameters.iter().zip(&formula.parameters).map(|((name, _), ty)| {
        let (name, ty) = (code::identifier(&name.to_string()), type_tokens(spec, *ty));
        quote!(#name: #ty)
    });
    let result = outputs.iter().map(|ty| type_tokens(spec, *ty));
    let result = if header.tuple { quote!((#(#result,)*)) } else { quote!(#(#result)*) };
    let doc = print::formula_documentation(spec, compiled);
    let inline = attributes.iter().any(|attribute| attribute.path().is_ident("inline"));
    let inline = (!inline).then(|| code::inline(&compiled.program));
    let body = body(spec, compiled, &outputs);
    quote! {
        #(#attributes)*
        #[doc = ""]
        #[doc = #doc]
        #inline
        #visibility fn #name #generics (#(#parameters),*) -> #result { #body }
    }
}

fn body(spec: &Spec, compiled: &Compiled, outputs: &[Output]) -> TokenStream {
    let (formula, program) = (&compiled.formula, &compiled.program);
    let mut tokens = unread(compiled);
    let code::Results { before, after, values } = code::results(program);
    tokens.extend(before);
    tokens.extend(code::steps_with(program, |call| call_tokens(spec, compiled, call)));
    tokens.extend(after);
    let mut values = values.into_iter();
    let results: Vec<TokenStream> = outputs
        .iter()
        .map(|ty| match ty {
            Output::Scalar => values.next().unwrap_or_default(),
            Output::Type(index) => {
                let fields: Vec<TokenStream> = values.by_ref().take(spec.types[*index].fields.len()).collect();
                types::construct(spec, *index, &fields)
            }
        })
        .collect();
    tokens.extend(if formula.source.header.tuple { quote!((#(#results,)*)) } else { quote!(#(#results)*) });
    tokens
}

/// Statements for the compiler's lints: a name that the source does not read is reported on the source's token, and a
/// parameter that the program needs no number of is not.
fn unread(compiled: &Compiled) -> TokenStream {
    let unused = &compiled.formula.unused;
    let mut tokens = quote!(#(let #unused = ();)*);
    for (name, _) in &compiled.formula.source.header.parameters {
        if !code::reads(&compiled.program, &name.to_string()) {
            let name = code::identifier(&name.to_string());
            tokens.extend(quote!(let _ = #name;));
        }
    }
    tokens
}

fn call_tokens(spec: &Spec, compiled: &Compiled, call: &Call) -> TokenStream {
    let operation = &compiled.formula.steps[call.call].operation;
    let function = if let Operation::Call { function, .. } = operation { function.to_token_stream() } else { quote!() };
    let arguments = call.arguments.iter().map(|Argument { ty, fields }| {
        let values: Vec<TokenStream> = fields.iter().map(|field| code::value(&field.value)).collect();
        match ty {
            Some(index) => types::construct(spec, *index, &values),
            None => quote!(#(#values)*),
        }
    });
    quote!(#function(#(#arguments),*))
}

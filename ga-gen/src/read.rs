//! From the syntax of a formula to its steps: what each name means in the algebra, what each operator is.

mod expression;

use crate::body::{Fixed, Formula, Operation, Step, Tied};
use crate::expression::Expression;
use crate::header::{self, Source};
use crate::infer::Output;
use crate::names::unknown;
use crate::spec::Spec;
use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::spanned::Spanned;
use syn::{Error, Expr, Ident, Pat, Stmt};

/// Reads a formula.
///
/// # Errors
/// A sentence on the token at fault.
pub fn read(spec: &Spec, source: &Source) -> syn::Result<Formula> {
    let mut reader =
        Reader { spec, scope: vec![], types: vec![], steps: vec![], unused: vec![], fixed: vec![], depth: 0 };
    for (name, ty) in &source.header.parameters {
        let ty = reader.declared(ty)?;
        reader.types.push(Some(ty));
        reader.bind(name, reader.types.len() - 1);
        let what = Tied::Parameter(reader.types.len() - 1);
        reader.fixed.push(Fixed { span: name.span(), text: name.to_string(), what });
    }
    let parameters: Vec<Output> = reader.types.iter().flatten().copied().collect();
    let results = reader.body(source)?;
    let mut unused = std::mem::take(&mut reader.unused);
    unused.extend(reader.scope.into_iter().filter(|known| !known.used).map(|known| known.name));
    unused.retain(|name| !name.to_string().starts_with('_'));
    Ok(Formula { source: source.clone(), parameters, steps: reader.steps, results, unused, fixed: reader.fixed })
}

/// A name in scope.
struct Known {
    name: Ident,
    operand: usize,
    used: bool,
}

struct Reader<'a> {
    spec: &'a Spec,
    scope: Vec<Known>,
    /// The stated type of each operand.
    types: Vec<Option<Output>>,
    steps: Vec<Step>,
    unused: Vec<Ident>,
    fixed: Vec<Fixed>,
    /// How many expressions the one that is read stands in.
    depth: usize,
}

impl Reader<'_> {
    /// What a declared type is.
    fn declared(&self, name: &Ident) -> syn::Result<Output> {
        if name == "Scalar" {
            return Ok(Output::Scalar);
        }
        if let Some(index) = self.spec.find(&name.to_string()) {
            return Ok(Output::Type(index));
        }
        if ["T", "f32", "f64"].iter().any(|number| name == number) {
            return Err(Error::new(name.span(), format!("a number in a formula is a `Scalar`, not `{name}`")));
        }
        let known: Vec<String> = self.spec.types.iter().map(|ty| ty.name.to_string()).collect();
        let fault = format!("no type `{name}` in the algebra `{}`", self.spec.name);
        Err(Error::new(name.span(), unknown(&fault, &name.to_string(), &known)))
    }

    fn bind(&mut self, name: &Ident, operand: usize) {
        // As in Rust, a later name hides an earlier one.
        if let Some(known) = self.scope.iter_mut().find(|known| known.name == *name) {
            if !known.used {
                self.unused.push(known.name.clone());
            }
            *known = Known { name: name.clone(), operand, used: false };
        } else {
            self.scope.push(Known { name: name.clone(), operand, used: false });
        }
    }

    fn push(&mut self, name: &str, place: TokenStream, operation: Operation, ty: Option<Output>) -> usize {
        self.steps.push(Step { name: name.into(), place, operation, ty });
        self.types.push(ty);
        self.types.len() - 1
    }

    /// The statements; returns the operands that are the results.
    fn body(&mut self, source: &Source) -> syn::Result<Vec<usize>> {
        let missing = "a formula ends with its result: an expression without a semicolon";
        let Some((last, statements)) = source.body.stmts.split_last() else {
            return Err(Error::new(source.header.name.span(), missing));
        };
        for statement in statements {
            match statement {
                Stmt::Local(local) => self.binding(local)?,
                Stmt::Item(item) => return Err(Error::new_spanned(item, "a formula has no items inside")),
                Stmt::Macro(invocation) => {
                    let message = "a formula has no macros: it is read before they are expanded";
                    return Err(Error::new_spanned(invocation, message));
                }
                Stmt::Expr(unused, _) => {
                    self.expression(unused)?;
                    return Err(Error::new(
                        unused.span(),
                        "nothing uses this value: name it with `let`, or leave it out",
                    ));
                }
            }
        }
        match last {
            Stmt::Expr(result, None) => self.results(source, result),
            Stmt::Expr(result, Some(semicolon)) => {
                self.expression(result)?;
                Err(Error::new(semicolon.span(), missing))
            }
            Stmt::Local(local) => {
                self.binding(local)?;
                Err(Error::new_spanned(local, missing))
            }
            other => Err(Error::new_spanned(other, missing)),
        }
    }

    fn results(&mut self, source: &Source, result: &Expr) -> syn::Result<Vec<usize>> {
        let header = &source.header;
        let outputs: Vec<Output> = header.outputs.iter().map(|ty| self.declared(ty)).collect::<syn::Result<_>>()?;
        let parts: Vec<&Expr> = match (header.tuple, ungrouped(result)) {
            (true, Expr::Tuple(tuple)) => tuple.elems.iter().collect(),
            (false, single) => vec![single],
            (true, Expr::Call(call)) => {
                let message = "name the results of the call first: `let (s, p): (Sphere, Plane) = f(a);`";
                return Err(Error::new_spanned(call, message));
            }
            (true, other) => {
                return Err(Error::new_spanned(other, "the result is declared as a tuple: write `(x, y)`"));
            }
        };
        if parts.len() != outputs.len() {
            let message = format!("{} results are declared, here are {}", outputs.len(), parts.len());
            return Err(Error::new_spanned(result, message));
        }
        let mut results = Vec::new();
        for ((part, output), name) in parts.into_iter().zip(outputs).zip(&header.outputs) {
            let value = match ungrouped(part) {
                Expr::Call(call) => self.call(call, "result", vec![output], false)?[0],
                other => self.typed("result", other, output, name)?,
            };
            results.push(value);
        }
        // A result that comes from a call is a typed step like the others, so that a frame can move it.
        let typed = results.into_iter().zip(&header.outputs).map(|(operand, name)| self.retyped(operand, name));
        Ok(typed.collect())
    }

    fn retyped(&mut self, operand: usize, declared: &Ident) -> usize {
        let parameters = self.types.len() - self.steps.len();
        match operand.checked_sub(parameters).and_then(|index| self.steps.get(index)) {
            Some(Step { operation: Operation::Part(..), ty, place, .. }) => {
                let (ty, place, declared) = (*ty, place.clone(), declared.clone());
                let operation = Operation::Typed { value: Expression::Input(operand), normalised: false, declared };
                self.push("result", place, operation, ty)
            }
            _ => operand,
        }
    }

    /// A value of a declared type.
    fn typed(&mut self, name: &str, value: &Expr, output: Output, declared: &Ident) -> syn::Result<usize> {
        let (place, declared) = (value.to_token_stream(), declared.clone());
        let value = self.expression(value)?;
        // By which number a value is divided depends on the type that it gets: a weight, or else the norm.
        let parameters = self.types.len() - self.steps.len();
        let step = match &value {
            Expression::Input(operand) => operand.checked_sub(parameters).and_then(|index| self.steps.get(index)),
            _ => None,
        };
        let operation = match step.map(|step| &step.operation) {
            Some(Operation::Normalised(inner)) => Operation::Typed { value: inner.clone(), normalised: true, declared },
            _ => Operation::Typed { value, normalised: false, declared },
        };
        Ok(self.push(name, place, operation, Some(output)))
    }

    /// `let x = ..;`, `let x: Sphere = ..;`, `let (x, y): (Sphere, Plane) = f(..);`
    fn binding(&mut self, local: &syn::Local) -> syn::Result<()> {
        if let Some(attribute) = local.attrs.first() {
            return Err(Error::new_spanned(attribute, "a `let` in a formula has no attributes"));
        }
        let (pattern, ty) = match &local.pat {
            Pat::Type(typed) => (&*typed.pat, Some(&*typed.ty)),
            other => (other, None),
        };
        let Some(init) = &local.init else {
            return Err(Error::new_spanned(local, "a `let` in a formula has a value"));
        };
        if let Some((token, _)) = &init.diverge {
            return Err(Error::new(token.span(), "a formula has no branches: leave the `else` out"));
        }
        let value = ungrouped(&init.expr);
        match (value, ty) {
            (Expr::Call(call), Some(ty)) => {
                let (types, tuple) = header::type_names(ty)?;
                let names = names_of(pattern, tuple, types.len())?;
                let outputs = types.iter().map(|ty| self.declared(ty)).collect::<syn::Result<_>>()?;
                let name = if tuple { "results".into() } else { names[0].to_string() };
                let operands = self.call(call, &name, outputs, tuple)?;
                names.iter().zip(operands).for_each(|(name, operand)| self.bind(name, operand));
            }
            (_, Some(ty)) => {
                let (name, ty) = (header::name_of(pattern)?, header::type_name(ty)?);
                let output = self.declared(&ty)?;
                let operand = self.typed(&name.to_string(), value, output, &ty)?;
                self.bind(&name, operand);
            }
            (Expr::Call(call), None) => return Err(untyped_call(call)),
            (_, None) => {
                let name = header::name_of(pattern)?;
                let expression = self.expression(value)?;
                let operand = self.operand(expression, value);
                self.bind(&name, operand);
            }
        }
        Ok(())
    }

    /// A call of another formula; one operand a result.
    fn call(&mut self, call: &syn::ExprCall, name: &str, outputs: Vec<Output>, tuple: bool) -> syn::Result<Vec<usize>> {
        let function = match &*call.func {
            Expr::Path(path) if path.qself.is_none() => path.path.clone(),
            other => return Err(Error::new_spanned(other, "a formula calls another one by its path")),
        };
        let arguments = call.args.iter().map(|argument| self.expression(argument)).collect::<syn::Result<_>>()?;
        let operation = Operation::Call { function, arguments, tuple };
        let step = self.push(name, call.to_token_stream(), operation, None);
        let parts = outputs.into_iter().enumerate();
        Ok(parts
            .map(|(index, ty)| self.push(name, call.to_token_stream(), Operation::Part(step, index), Some(ty)))
            .collect())
    }

    /// The operand that an expression is; a step is made of it if need be.
    fn operand(&mut self, expression: Expression, source: &Expr) -> usize {
        match expression {
            Expression::Input(operand) => operand,
            other => self.push("t", source.to_token_stream(), Operation::Value(other), None),
        }
    }

    fn step(&mut self, name: &str, place: impl ToTokens, operation: Operation, ty: Option<Output>) -> Expression {
        Expression::Input(self.push(name, place.to_token_stream(), operation, ty))
    }
}

fn names_of(pattern: &Pat, tuple: bool, count: usize) -> syn::Result<Vec<Ident>> {
    match (pattern, tuple) {
        (Pat::Tuple(names), true) if names.elems.len() == count => names.elems.iter().map(header::name_of).collect(),
        (Pat::Tuple(_), true) => Err(Error::new_spanned(pattern, format!("the call returns {count} results"))),
        (_, true) => Err(Error::new_spanned(pattern, "the call returns a tuple: write `let (x, y): ..`")),
        (single, false) => Ok(vec![header::name_of(single)?]),
    }
}

fn untyped_call(call: &syn::ExprCall) -> Error {
    Error::new(call.func.span(), "say what this call returns, by a `let` of its own before: `let x: Sphere = f(a, b);`")
}

/// Without the invisible brackets that macros leave, and without visible ones.
fn ungrouped(expression: &Expr) -> &Expr {
    match expression {
        Expr::Group(inner) => ungrouped(&inner.expr),
        Expr::Paren(inner) => ungrouped(&inner.expr),
        other => other,
    }
}

//! From the syntax of a formula to its steps: what each name means in the algebra, what each operator is.

use crate::blade::Blade;
use crate::body::{Component, Fixed, Formula, Operation, Step, Tied};
use crate::expression::Expression;
use crate::header::{self, Source};
use crate::infer::Output;
use crate::literal;
use crate::names::{closest, unknown};
use crate::product::Kind;
use crate::scalar::Rational;
use crate::spec::Spec;
use crate::unsupported;
use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{BinOp, Error, Expr, Ident, Member, Pat, Stmt, UnOp};

/// The methods of a multivector in a formula.
const METHODS: [&str; 8] = ["rev", "dual", "undual", "grade", "apply", "normalised", "norm_sq", "sqrt"];

/// Reads a formula.
///
/// # Errors
/// A sentence on the token at fault.
pub fn read(spec: &Spec, source: &Source) -> syn::Result<Formula> {
    let mut reader = Reader { spec, scope: vec![], types: vec![], steps: vec![], unused: vec![], fixed: vec![] };
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

    fn push(&mut self, name: &str, span: Span, operation: Operation, ty: Option<Output>) -> usize {
        self.steps.push(Step { name: name.into(), span, operation, ty });
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
                Stmt::Item(item) => return Err(Error::new(item.span(), "a formula has no items inside")),
                Stmt::Macro(invocation) => {
                    let message = "a formula has no macros: it is read before they are expanded";
                    return Err(Error::new(invocation.span(), message));
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
                Err(Error::new(local.span(), missing))
            }
            other => Err(Error::new(other.span(), missing)),
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
                return Err(Error::new(call.span(), message));
            }
            (true, other) => return Err(Error::new(other.span(), "the result is declared as a tuple: write `(x, y)`")),
        };
        if parts.len() != outputs.len() {
            let message = format!("{} results are declared, here are {}", outputs.len(), parts.len());
            return Err(Error::new(result.span(), message));
        }
        let mut results = Vec::new();
        for ((part, output), name) in parts.into_iter().zip(outputs).zip(&header.outputs) {
            let value = match ungrouped(part) {
                Expr::Call(call) => self.call(call, "result", vec![output], false)?[0],
                other => self.typed("result", other, output, name.span())?,
            };
            results.push(value);
        }
        // A result that comes from a call is a typed step like the others, so that a frame can move it.
        let typed = results.into_iter().zip(&header.outputs).map(|(operand, name)| self.retyped(operand, name.span()));
        Ok(typed.collect())
    }

    fn retyped(&mut self, operand: usize, declared: Span) -> usize {
        let parameters = self.types.len() - self.steps.len();
        match operand.checked_sub(parameters).and_then(|index| self.steps.get(index)) {
            Some(Step { operation: Operation::Part(..), ty, span, .. }) => {
                let (ty, span) = (*ty, *span);
                let operation = Operation::Typed { value: Expression::Input(operand), normalised: false, declared };
                self.push("result", span, operation, ty)
            }
            _ => operand,
        }
    }

    /// A value of a declared type.
    fn typed(&mut self, name: &str, value: &Expr, output: Output, declared: Span) -> syn::Result<usize> {
        let span = value.span();
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
        Ok(self.push(name, span, operation, Some(output)))
    }

    /// `let x = ..;`, `let x: Sphere = ..;`, `let (x, y): (Sphere, Plane) = f(..);`
    fn binding(&mut self, local: &syn::Local) -> syn::Result<()> {
        if let Some(attribute) = local.attrs.first() {
            return Err(Error::new(attribute.span(), "a `let` in a formula has no attributes"));
        }
        let (pattern, ty) = match &local.pat {
            Pat::Type(typed) => (&*typed.pat, Some(&*typed.ty)),
            other => (other, None),
        };
        let Some(init) = &local.init else {
            return Err(Error::new(local.span(), "a `let` in a formula has a value"));
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
                let operand = self.typed(&name.to_string(), value, output, ty.span())?;
                self.bind(&name, operand);
            }
            (Expr::Call(call), None) => return Err(untyped_call(call)),
            (_, None) => {
                let name = header::name_of(pattern)?;
                let expression = self.expression(value)?;
                let operand = self.operand(expression, value.span());
                self.bind(&name, operand);
            }
        }
        Ok(())
    }

    /// A call of another formula; one operand a result.
    fn call(&mut self, call: &syn::ExprCall, name: &str, outputs: Vec<Output>, tuple: bool) -> syn::Result<Vec<usize>> {
        let function = match &*call.func {
            Expr::Path(path) if path.qself.is_none() => path.path.clone(),
            other => return Err(Error::new(other.span(), "a formula calls another one by its path")),
        };
        let arguments = call.args.iter().map(|argument| self.expression(argument)).collect::<syn::Result<_>>()?;
        let operation = Operation::Call { function, arguments, tuple };
        let step = self.push(name, call.span(), operation, None);
        let parts = outputs.into_iter().enumerate();
        Ok(parts.map(|(index, ty)| self.push(name, call.span(), Operation::Part(step, index), Some(ty))).collect())
    }

    /// The operand that an expression is; a step is made of it if need be.
    fn operand(&mut self, expression: Expression, span: Span) -> usize {
        match expression {
            Expression::Input(operand) => operand,
            other => self.push("t", span, Operation::Value(other), None),
        }
    }

    fn step(&mut self, name: &str, span: Span, operation: Operation, ty: Option<Output>) -> Expression {
        Expression::Input(self.push(name, span, operation, ty))
    }

    fn expression(&mut self, expression: &Expr) -> syn::Result<Expression> {
        match expression {
            Expr::Group(inner) => self.expression(&inner.expr),
            Expr::Paren(inner) => self.expression(&inner.expr),
            Expr::Path(path) if path.qself.is_none() => match path.path.get_ident() {
                Some(name) => self.name(name),
                None => {
                    let message =
                        "a formula reads its parameters and `let`s, and constants of the algebra by their bare names";
                    Err(Error::new(path.span(), message))
                }
            },
            Expr::Lit(literal) => Ok(Expression::number(literal::number(&literal.lit)?)),
            Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
                Ok(Expression::Sum(vec![(-Rational::ONE, self.expression(&unary.expr)?)]))
            }
            Expr::Unary(unary) => {
                Err(Error::new(unary.op.span(), "no such sign on a multivector: there is the minus only"))
            }
            Expr::Binary(binary) => self.binary(binary),
            Expr::MethodCall(call) => self.method(call),
            Expr::Field(field) => self.component(field),
            Expr::Call(call) => Err(untyped_call(call)),
            other => Err(unsupported::expression(other)),
        }
    }

    fn name(&mut self, name: &Ident) -> syn::Result<Expression> {
        if let Some(known) = self.scope.iter_mut().find(|known| known.name == *name) {
            known.used = true;
            return Ok(Expression::Input(known.operand));
        }
        let text = name.to_string();
        let ty = self.spec.types.iter().find(|ty| ty.name == *name && ty.fields.is_empty());
        let constant = match ty {
            Some(ty) => {
                let terms = ty.coefficients.iter().filter_map(|(blade, c)| Some((*blade, c.as_constant()?)));
                Expression::Constant(terms.collect())
            }
            None => match self.spec.signature.parse(&text).filter(|(blade, _)| *blade != Blade::SCALAR) {
                Some((blade, odd)) => {
                    Expression::Constant([(blade, if odd { -Rational::ONE } else { Rational::ONE })].into())
                }
                None => return Err(self.unknown_name(name)),
            },
        };
        self.fixed.push(Fixed { span: name.span(), text, what: Tied::Constant(constant.clone()) });
        Ok(constant)
    }

    fn unknown_name(&self, name: &Ident) -> Error {
        if self.spec.find(&name.to_string()).is_some() {
            return Error::new(name.span(), format!("`{name}` is a type with stored numbers, not a constant"));
        }
        let mut known: Vec<String> = self.scope.iter().map(|known| known.name.to_string()).collect();
        let constant = self.spec.types.iter().filter(|ty| ty.fields.is_empty());
        known.extend(constant.map(|ty| ty.name.to_string()));
        known.extend(self.spec.signature.names().iter().cloned());
        let fault =
            format!("no `{name}` here: it is neither a parameter nor a `let`, nor a constant type or basis blade");
        Error::new(name.span(), unknown(&fault, &name.to_string(), &known))
    }

    fn binary(&mut self, binary: &syn::ExprBinary) -> syn::Result<Expression> {
        refuse_bare_mix(binary)?;
        let a = self.expression(&binary.left)?;
        let b = self.expression(&binary.right)?;
        match binary.op {
            BinOp::Add(_) => Ok(Expression::sum(a, Rational::ONE, b)),
            BinOp::Sub(_) => Ok(Expression::sum(a, -Rational::ONE, b)),
            BinOp::Mul(_) => Ok(Expression::product(Kind::Geometric, a, b)),
            BinOp::BitXor(_) => Ok(Expression::product(Kind::Outer, a, b)),
            BinOp::BitOr(_) => Ok(Expression::product(Kind::Contraction, a, b)),
            BinOp::BitAnd(token) => {
                self.needs_dual("the meet", token.span())?;
                Ok(Expression::Meet(Box::new(a), Box::new(b)))
            }
            BinOp::Div(_) => match b.as_number() {
                Some(number) => {
                    let inverse = number.recip();
                    let inverse = inverse.ok_or_else(|| Error::new(binary.right.span(), "division by zero"))?;
                    Ok(Expression::Sum(vec![(inverse, a)]))
                }
                None => Ok(self.step("quotient", binary.right.span(), Operation::Quotient(a, b), None)),
            },
            _ => Err(Error::new(binary.op.span(), "no such operator on multivectors: there are + - * / ^ | &")),
        }
    }

    fn needs_dual(&self, what: &str, span: Span) -> syn::Result<()> {
        if self.spec.pseudoscalar.is_some_and(|i| !i.square.is_zero()) {
            return Ok(());
        }
        let message = format!("{what} needs a pseudoscalar with a square other than 0; `{}` has none", self.spec.name);
        Err(Error::new(span, message))
    }

    fn method(&mut self, call: &syn::ExprMethodCall) -> syn::Result<Expression> {
        let (name, span) = (call.method.to_string(), call.method.span());
        if let Some(turbofish) = &call.turbofish {
            return Err(Error::new(turbofish.span(), "methods in a formula have no type parameters"));
        }
        let receiver = self.expression(&call.receiver)?;
        let arguments: Vec<&Expr> = call.args.iter().map(ungrouped).collect();
        if name == "dual" || name == "undual" {
            self.needs_dual("a dual", span)?;
        }
        match (name.as_str(), &arguments[..]) {
            ("rev", []) => Ok(Expression::Reverse(Box::new(receiver))),
            ("dual", []) => Ok(Expression::Dual(Box::new(receiver))),
            ("undual", []) => Ok(Expression::Undual(Box::new(receiver))),
            ("normalised", []) => Ok(self.step("unit", span, Operation::Normalised(receiver), None)),
            ("sqrt", []) => Ok(self.step("root", span, Operation::Sqrt(receiver), None)),
            ("norm_sq", []) => {
                let a = Expression::Input(self.operand(receiver, call.receiver.span()));
                let square = Expression::product(Kind::Geometric, a.clone(), Expression::Reverse(Box::new(a)));
                Ok(Expression::Grade(0, Box::new(square)))
            }
            ("apply", [x]) => Ok(Expression::Sandwich(Box::new(receiver), Box::new(self.expression(x)?))),
            ("grade", [Expr::Lit(grade)]) => Ok(Expression::Grade(literal::grade(&grade.lit)?, Box::new(receiver))),
            ("grade", [other]) => Err(Error::new(other.span(), "the grade is a number, like grade(2)")),
            _ if METHODS.contains(&name.as_str()) => {
                let takes = match name.as_str() {
                    "apply" => "one multivector",
                    "grade" => "one number",
                    _ => "nothing",
                };
                Err(Error::new(span, format!("`{name}` takes {takes} in brackets")))
            }
            _ => {
                let methods = METHODS.map(String::from);
                Err(Error::new(span, unknown(&format!("a multivector has no method `{name}`"), &name, &methods)))
            }
        }
    }

    /// `sphere.rho_sq`, `(a * b).e12`
    fn component(&mut self, field: &syn::ExprField) -> syn::Result<Expression> {
        let Member::Named(name) = &field.member else {
            return Err(Error::new(field.member.span(), "components have names, like `a.e1`"));
        };
        let base = self.expression(&field.base)?;
        let operand = self.operand(base, field.base.span());
        let component = self.component_of(operand, name)?;
        self.fixed.push(Fixed { span: name.span(), text: name.to_string(), what: Tied::Component });
        Ok(self.step(&name.to_string(), name.span(), Operation::Component(operand, component), Some(Output::Scalar)))
    }

    fn component_of(&self, operand: usize, name: &Ident) -> syn::Result<Component> {
        let text = name.to_string();
        let blade = self.spec.signature.parse(&text).map(|(blade, odd)| Component::Coefficient(blade, odd));
        match self.types[operand] {
            Some(Output::Type(index)) => {
                let ty = &self.spec.types[index];
                if let Some(field) = ty.fields.iter().position(|field| *field == text) {
                    return Ok(Component::Field(field));
                }
                let present = |component: &Component| match component {
                    Component::Coefficient(blade, _) => ty.coefficients.contains_key(blade),
                    Component::Field(_) => true,
                };
                let fault = format!("`{}` has no component `{text}`", ty.name);
                blade.filter(present).ok_or_else(|| Error::new(name.span(), unknown(&fault, &text, &ty.fields)))
            }
            Some(Output::Scalar) => Err(Error::new(name.span(), "a scalar has no components")),
            None => blade.ok_or_else(|| {
                let names = self.spec.signature.names();
                let near = closest(&text, names).map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
                let message = format!(
                    "`{text}` is no basis blade; give the value a type (`let x: Sphere = ..;`) to read its fields{near}"
                );
                Error::new(name.span(), message)
            }),
        }
    }
}

fn names_of(pattern: &Pat, tuple: bool, count: usize) -> syn::Result<Vec<Ident>> {
    match (pattern, tuple) {
        (Pat::Tuple(names), true) if names.elems.len() == count => names.elems.iter().map(header::name_of).collect(),
        (Pat::Tuple(_), true) => Err(Error::new(pattern.span(), format!("the call returns {count} results"))),
        (_, true) => Err(Error::new(pattern.span(), "the call returns a tuple: write `let (x, y): ..`")),
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

/// Rust binds `+ -` tighter than `&`, `^`, `|`, in this order, which is not how products are read on paper.
fn refuse_bare_mix(binary: &syn::ExprBinary) -> syn::Result<()> {
    let rank = |op: &BinOp| match op {
        BinOp::BitAnd(_) => Some(1),
        BinOp::BitXor(_) => Some(2),
        BinOp::BitOr(_) => Some(3),
        BinOp::Add(_) | BinOp::Sub(_) => Some(0),
        _ => None,
    };
    let Some(outer) = rank(&binary.op) else {
        return Ok(());
    };
    for side in [&*binary.left, &*binary.right] {
        if let Expr::Binary(inner) = side
            && rank(&inner.op).is_some_and(|inner| inner != outer)
        {
            return Err(Error::new(
                inner.op.span(),
                "put brackets round this: Rust binds + - tighter than &, & tighter than ^, and ^ tighter than |",
            ));
        }
    }
    Ok(())
}

//! Expressions of a formula: names, operators, methods, components.

use super::{Reader, ungrouped, untyped_call};
use crate::blade::Blade;
use crate::body::{Component, Fixed, Operation, Tied};
use crate::expression::Expression;
use crate::infer::Output;
use crate::literal;
use crate::names::{closest, unknown};
use crate::product::Kind;
use crate::scalar::Rational;
use crate::unsupported;
use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{BinOp, Error, Expr, Ident, Member, UnOp};

/// The methods of a multivector in a formula.
const METHODS: [&str; 8] = ["rev", "dual", "undual", "grade", "apply", "normalised", "norm_sq", "sqrt"];

/// Deeper expressions are refused: they are read, lowered and dropped by functions that call themselves, and the stack ends
/// at some thousand of them in a build without optimisation. `a + b + c` stands two deep.
const DEEPEST: usize = 160;

impl Reader<'_> {
    pub(super) fn expression(&mut self, expression: &Expr) -> syn::Result<Expression> {
        if self.depth == DEEPEST {
            let message = format!("this expression is more than {DEEPEST} deep: name a part of it with `let`");
            return Err(Error::new_spanned(expression, message));
        }
        self.depth += 1;
        let result = self.expression_within(expression);
        self.depth -= 1;
        result
    }

    fn expression_within(&mut self, expression: &Expr) -> syn::Result<Expression> {
        match expression {
            Expr::Group(inner) => self.expression(&inner.expr),
            Expr::Paren(inner) => self.expression(&inner.expr),
            Expr::Path(path) if path.qself.is_none() => match path.path.get_ident() {
                Some(name) => self.name(name),
                None => {
                    let message =
                        "a formula reads its parameters and `let`s, and constants of the algebra by their bare names";
                    Err(Error::new_spanned(path, message))
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
                self.needs_pseudoscalar("the meet", token.span())?;
                Ok(Expression::Meet(Box::new(a), Box::new(b)))
            }
            BinOp::Div(_) => match b.as_number() {
                Some(number) => {
                    let inverse = number.recip();
                    let inverse = inverse.ok_or_else(|| Error::new_spanned(&binary.right, "division by zero"))?;
                    Ok(Expression::Sum(vec![(inverse, a)]))
                }
                None => Ok(self.step("quotient", &binary.right, Operation::Quotient(a, b), None)),
            },
            _ => Err(Error::new(binary.op.span(), "no such operator on multivectors: there are + - * / ^ | &")),
        }
    }

    fn needs_pseudoscalar(&self, what: &str, span: Span) -> syn::Result<()> {
        if self.spec.pseudoscalar.is_some() {
            return Ok(());
        }
        let name = &self.spec.name;
        let message = format!("{what} needs a pseudoscalar, and `{name}` declares none, like `pseudoscalar e12;`");
        Err(Error::new(span, message))
    }

    fn needs_dual(&self, span: Span) -> syn::Result<()> {
        self.needs_pseudoscalar("a dual", span)?;
        if self.spec.has_dual() {
            return Ok(());
        }
        let name = &self.spec.name;
        let message = format!("`{name}` has no dual: its pseudoscalar squares to 0. `&` is there, by complements");
        Err(Error::new(span, message))
    }

    fn method(&mut self, call: &syn::ExprMethodCall) -> syn::Result<Expression> {
        let (name, span) = (call.method.to_string(), call.method.span());
        if let Some(turbofish) = &call.turbofish {
            return Err(Error::new_spanned(turbofish, "methods in a formula have no type parameters"));
        }
        let receiver = self.expression(&call.receiver)?;
        let arguments: Vec<&Expr> = call.args.iter().map(ungrouped).collect();
        if name == "dual" || name == "undual" {
            self.needs_dual(span)?;
        }
        match (name.as_str(), &arguments[..]) {
            ("rev", []) => Ok(Expression::Reverse(Box::new(receiver))),
            ("dual", []) => Ok(Expression::Dual(Box::new(receiver))),
            ("undual", []) => Ok(Expression::Undual(Box::new(receiver))),
            ("normalised", []) => Ok(self.step("unit", &call.method, Operation::Normalised(receiver), None)),
            ("sqrt", []) => Ok(self.step("root", &call.method, Operation::Sqrt(receiver), None)),
            ("norm_sq", []) => {
                let a = Expression::Input(self.operand(receiver, &call.receiver));
                let square = Expression::product(Kind::Geometric, a.clone(), Expression::Reverse(Box::new(a)));
                Ok(Expression::Grade(0, Box::new(square)))
            }
            ("apply", [x]) => Ok(Expression::Sandwich(Box::new(receiver), Box::new(self.expression(x)?))),
            ("grade", [Expr::Lit(grade)]) => Ok(Expression::Grade(literal::grade(&grade.lit)?, Box::new(receiver))),
            ("grade", [other]) => Err(Error::new_spanned(other, "the grade is a number, like grade(2)")),
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
        let operand = self.operand(base, &field.base);
        let component = self.component_of(operand, name)?;
        self.fixed.push(Fixed { span: name.span(), text: name.to_string(), what: Tied::Component });
        Ok(self.step(&name.to_string(), name, Operation::Component(operand, component), Some(Output::Scalar)))
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

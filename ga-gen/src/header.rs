//! The head of a formula: the options of `#[formula(..)]` and the signature of the function, as tokens. What the names
//! mean in the algebra is found out in [`crate::read`].
//!
//! ```text
//! #[formula(cga, local = a, dynamic = circumsphere_dynamic)]
//! pub fn circumsphere(a: Point, b: Point, c: Point, d: Point) -> Sphere { .. }
//! ```

use crate::lower::Schedule;
use crate::unsupported;
use proc_macro2::{Span, TokenStream};
use syn::parse::{Parse, ParseStream};
use syn::spanned::Spanned;
use syn::{Attribute, Error, FnArg, Ident, ItemFn, Pat, Path, ReturnType, Token, Type, Visibility};

/// In which frame a formula is evaluated.
#[derive(Clone, Debug)]
pub enum Frame {
    /// As written.
    World,
    /// With this parameter as origin; the result is moved back.
    Local(Ident),
    /// With this parameter as origin; the result stays relative to it.
    Relative(Ident),
}

/// The options of the attribute.
#[derive(Clone)]
pub struct Options {
    /// The module that holds the algebra.
    pub path: Path,
    /// The frame.
    pub frame: Frame,
    /// The name of the same formula over the dynamic multivector.
    pub dynamic: Option<Ident>,
    /// What may be traded for fewer operations.
    pub schedule: Schedule,
}

/// What stands before the body.
#[derive(Clone)]
pub struct Header {
    /// Docs and other attributes.
    pub attributes: Vec<Attribute>,
    /// The visibility.
    pub visibility: Visibility,
    /// The name.
    pub name: Ident,
    /// Names and types of the parameters.
    pub parameters: Vec<(Ident, Ident)>,
    /// The types of the results.
    pub outputs: Vec<Ident>,
    /// Is the result written as a tuple?
    pub tuple: bool,
}

/// A formula as written: options, head and body, checked for what is no formula, whatever the algebra.
#[derive(Clone)]
pub struct Source {
    /// The options of the attribute.
    pub options: Options,
    /// What stands before the body.
    pub header: Header,
    /// The body.
    pub body: syn::Block,
}

impl Source {
    /// Reads the attribute and the function under it.
    ///
    /// # Errors
    /// A sentence on the token at fault.
    pub fn new(attribute: TokenStream, item: TokenStream) -> syn::Result<Self> {
        let options = syn::parse2(attribute)?;
        let not_a_function = |error: Error| {
            let message = format!("a formula is a function `fn name(a: Point) -> Sphere {{ .. }}`: {error}");
            Error::new(error.span(), message)
        };
        let function: ItemFn = syn::parse2(item).map_err(not_a_function)?;
        let header = Header::new(&function)?;
        Ok(Self { options, header, body: *function.block })
    }
}

impl Parse for Options {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let unnamed = "name the module of the algebra first: `#[formula(cga)]`";
        if input.is_empty() {
            return Err(Error::new(Span::call_site(), unnamed));
        }
        let path = Path::parse_mod_style(input)?;
        if input.peek(Token![=]) {
            return Err(Error::new_spanned(path, unnamed));
        }
        let mut options = Self { path, frame: Frame::World, dynamic: None, schedule: Schedule::Stable };
        while !input.is_empty() {
            input.parse::<Token![,]>()?;
            if !input.is_empty() {
                options.parse_option(input)?;
            }
        }
        Ok(options)
    }
}

impl Options {
    fn parse_option(&mut self, input: ParseStream) -> syn::Result<()> {
        let key: Ident = input.parse()?;
        let name = key.to_string();
        if !["local", "relative", "dynamic", "schedule"].contains(&name.as_str()) {
            let message = format!(
                "no option `{name}`; there are `local = a`, `relative = a`, `dynamic = name` and `schedule = split`"
            );
            return Err(Error::new(key.span(), message));
        }
        input.parse::<Token![=]>()?;
        let value: Ident = input.parse()?;
        match (name.as_str(), &self.frame, &self.dynamic) {
            ("dynamic", _, None) => self.dynamic = Some(value),
            ("schedule", ..) if value != "split" => {
                return Err(Error::new(value.span(), format!("no schedule `{value}`; there is `split`")));
            }
            ("schedule", ..) if self.schedule == Schedule::Stable => self.schedule = Schedule::Split,
            ("local", Frame::World, _) => self.frame = Frame::Local(value),
            ("relative", Frame::World, _) => self.frame = Frame::Relative(value),
            ("local", Frame::Relative(_), _) | ("relative", Frame::Local(_), _) => {
                return Err(Error::new(key.span(), "a formula has one frame: `local` or `relative`, not both"));
            }
            _ => return Err(Error::new(key.span(), format!("option `{name}` stands twice"))),
        }
        Ok(())
    }
}

impl Header {
    fn new(function: &ItemFn) -> syn::Result<Self> {
        let signature = &function.sig;
        unsupported::refuse_signature(signature)?;
        let mut parameters: Vec<(Ident, Ident)> = Vec::new();
        for argument in &signature.inputs {
            let (name, ty) = parameter(argument)?;
            if parameters.iter().any(|(earlier, _)| *earlier == name) {
                return Err(Error::new(name.span(), format!("parameter `{name}` stands twice")));
            }
            parameters.push((name, ty));
        }
        let (outputs, tuple) = results(&signature.output, signature.ident.span())?;
        Ok(Self {
            attributes: function.attrs.clone(),
            visibility: function.vis.clone(),
            name: signature.ident.clone(),
            parameters,
            outputs,
            tuple,
        })
    }
}

fn parameter(argument: &FnArg) -> syn::Result<(Ident, Ident)> {
    let typed = match argument {
        FnArg::Receiver(receiver) => {
            return Err(Error::new(receiver.self_token.span(), "a formula is a free function: it has no `self`"));
        }
        FnArg::Typed(typed) => typed,
    };
    if let Some(attribute) = typed.attrs.first() {
        return Err(Error::new_spanned(attribute, "a parameter of a formula has no attributes"));
    }
    Ok((name_of(&typed.pat)?, type_name(&typed.ty)?))
}

/// The name that a pattern is.
///
/// # Errors
/// Any other pattern.
pub fn name_of(pattern: &Pat) -> syn::Result<Ident> {
    match pattern {
        Pat::Ident(name) => {
            if let Some(token) = &name.mutability {
                return Err(Error::new(token.span(), "nothing changes in a formula: leave `mut` out"));
            }
            if name.by_ref.is_some() || name.subpat.is_some() || !name.attrs.is_empty() {
                return Err(Error::new_spanned(pattern, "write a name here: a formula has no patterns"));
            }
            Ok(name.ident.clone())
        }
        other => Err(Error::new_spanned(other, "write a name here: a formula has no patterns")),
    }
}

/// The name that a type is.
///
/// # Errors
/// Any other type.
pub fn type_name(ty: &Type) -> syn::Result<Ident> {
    match ty {
        Type::Group(inner) => type_name(&inner.elem),
        Type::Paren(inner) => type_name(&inner.elem),
        Type::Path(path) if path.qself.is_none() => path.path.get_ident().cloned().ok_or_else(|| {
            let message =
                "write the bare name of a type of the algebra: the attribute says where it is, and the scalar is `T`";
            Error::new_spanned(ty, message)
        }),
        Type::Reference(_) => Err(Error::new_spanned(ty, "operands of a formula are values: leave `&` out")),
        other => Err(Error::new_spanned(other, "a type in a formula is one of the algebra, by name, or `Scalar`")),
    }
}

/// The types after `->`, or on a `let`, and whether they are written as a tuple.
///
/// # Errors
/// What is no name of a type.
pub fn type_names(ty: &Type) -> syn::Result<(Vec<Ident>, bool)> {
    match ty {
        Type::Tuple(tuple) if tuple.elems.is_empty() => Err(Error::new_spanned(ty, "a formula has a result")),
        Type::Tuple(tuple) => Ok((tuple.elems.iter().map(type_name).collect::<syn::Result<_>>()?, true)),
        single => Ok((vec![type_name(single)?], false)),
    }
}

fn results(output: &ReturnType, name: Span) -> syn::Result<(Vec<Ident>, bool)> {
    match output {
        ReturnType::Type(_, ty) => type_names(ty),
        ReturnType::Default => Err(Error::new(name, "say what this formula returns: `-> Sphere`, or `-> Scalar`")),
    }
}

//! The grammar of `algebra!`, token by token; nothing is checked for sense here.
//!
//! ```text
//! pub algebra cga extends super::g3;
//! basis e1 = 1, e2 = 1, e3 = 1;                    // squares +1, -1 or 0
//! basis null pair (no, ninf) = -1;                 // no.no = ninf.ninf = 0, no.ninf = -1
//! pseudoscalar -e123_no_ninf;                      // I, for dual, undual and &; without it there is none of them
//! type Rotor: unit + versor = [s, e23, e31, e12];  // stored coefficients, fields named by their blades
//! type Translator: unit + versor = [s = 1, e1_ninf, e2_ninf, e3_ninf];   // with a constant one
//! type Point = x*e1 + y*e2 + z*e3 + no + (x*x + y*y + z*z)/2*ninf;   // stored, constant and derived
//! ```

use proc_macro2::{Span, TokenStream};
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Attribute, Expr, Ident, Token, Visibility};

mod keyword {
    syn::custom_keyword!(algebra);
    syn::custom_keyword!(extends);
    syn::custom_keyword!(basis);
    syn::custom_keyword!(null);
    syn::custom_keyword!(pair);
    syn::custom_keyword!(pseudoscalar);
}

/// One `algebra!` invocation.
#[derive(Clone)]
pub struct Source {
    /// Visibility of the generated types.
    pub visibility: Visibility,
    /// The algebra's name.
    pub name: Ident,
    /// The module of the algebra that it extends.
    pub extends: Option<syn::Path>,
    /// Basis vectors in declared order.
    pub basis: Vec<Basis>,
    /// The pseudoscalar: is there a minus, and the blade.
    pub pseudoscalar: Option<(bool, Ident)>,
    /// Named types.
    pub types: Vec<TypeSource>,
}

/// Declared basis vectors.
#[derive(Clone, Debug)]
pub enum Basis {
    /// `e1 = 1`
    Vector(Ident, i8),
    /// `null pair (no, ninf) = -1`
    Pair(Ident, Ident, i8),
}

/// `type NAME: FACTS = BODY;`
#[derive(Clone)]
pub struct TypeSource {
    /// Doc comments.
    pub docs: Vec<Attribute>,
    /// The name.
    pub name: Ident,
    /// `unit`, `versor`.
    pub facts: Vec<Ident>,
    /// The coefficients.
    pub body: TypeBody,
}

/// The coefficients of a type.
#[derive(Clone)]
pub enum TypeBody {
    /// `[s = 1, e23, e31, e12]`: stored coefficients, or constant ones.
    Stored(Vec<(Ident, Option<syn::Lit>)>),
    /// `x*e1 + no + ...`
    Sum(Box<Expr>),
}

/// What an algebra's specification macro hands over: the algebras that it stands on, the first one first, and itself.
pub struct Chain(pub Vec<(Source, TokenStream)>);

impl Parse for Chain {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let mut chain = Vec::new();
        while input.peek(syn::token::Brace) {
            let content;
            syn::braced!(content in input);
            let tokens: TokenStream = content.parse()?;
            chain.push((syn::parse2(tokens.clone())?, tokens));
        }
        Ok(Self(chain))
    }
}

/// A chain of algebras, and one that extends the last of them.
pub struct WithBase {
    /// The algebras that `own` stands on.
    pub chain: Chain,
    /// The algebra that extends the last of them.
    pub own: Source,
    /// The tokens of `own`.
    pub own_tokens: TokenStream,
}

impl Parse for WithBase {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let chain = input.parse()?;
        let own_tokens: TokenStream = input.parse()?;
        Ok(Self { chain, own: syn::parse2(own_tokens.clone())?, own_tokens })
    }
}

/// A chain of algebras, the options of a formula in brackets, and the function.
pub struct WithFormula {
    /// The algebra of the formula, last.
    pub chain: Chain,
    /// The options.
    pub attribute: TokenStream,
    /// The function.
    pub item: TokenStream,
}

impl Parse for WithFormula {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let chain = input.parse()?;
        let attribute;
        syn::parenthesized!(attribute in input);
        Ok(Self { chain, attribute: attribute.parse()?, item: input.parse()? })
    }
}

impl Parse for Source {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let visibility = input.parse()?;
        input.parse::<keyword::algebra>()?;
        let name = input.parse()?;
        let mut extends = None;
        if input.parse::<Option<keyword::extends>>()?.is_some() {
            let base = syn::Path::parse_mod_style(input)?;
            if base.is_ident("self") || base.is_ident(&name) {
                return Err(syn::Error::new_spanned(base, "an algebra does not extend itself"));
            }
            extends = Some(base);
        }
        input.parse::<Token![;]>()?;
        let mut source = Self { visibility, name, extends, basis: vec![], pseudoscalar: None, types: vec![] };
        while !input.is_empty() {
            source.parse_item(input)?;
        }
        Ok(source)
    }
}

impl Source {
    fn parse_item(&mut self, input: ParseStream) -> syn::Result<()> {
        let docs = input.call(Attribute::parse_outer)?;
        let lookahead = input.lookahead1();
        if lookahead.peek(keyword::basis) {
            input.parse::<keyword::basis>()?;
            self.basis.extend(Punctuated::<Basis, Token![,]>::parse_separated_nonempty(input)?);
            input.parse::<Token![;]>()?;
        } else if lookahead.peek(keyword::pseudoscalar) {
            let keyword = input.parse::<keyword::pseudoscalar>()?;
            if self.pseudoscalar.is_some() {
                return Err(syn::Error::new(keyword.span, "the pseudoscalar is declared twice"));
            }
            let negative = input.parse::<Option<Token![-]>>()?.is_some();
            self.pseudoscalar = Some((negative, input.parse()?));
            input.parse::<Token![;]>()?;
        } else if lookahead.peek(Token![type]) {
            self.types.push(TypeSource::parse(docs, input)?);
        } else if input.peek(Token![fn]) {
            return Err(input.error("formulas stand outside of `algebra!`: write `#[formula(path)]` on the function"));
        } else {
            return Err(lookahead.error());
        }
        Ok(())
    }
}

/// A square or an inner product, and where it stands.
fn parse_square(input: ParseStream) -> syn::Result<(i8, Span)> {
    let negative = input.parse::<Option<Token![-]>>()?.is_some();
    let literal: syn::LitInt = input.parse()?;
    match literal.base10_parse::<i8>() {
        Ok(value @ (0 | 1)) => Ok((if negative { -value } else { value }, literal.span())),
        _ => Err(syn::Error::new(literal.span(), "a basis vector squares to 1, -1 or 0; scale it until it does")),
    }
}

impl Parse for Basis {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        if input.parse::<Option<keyword::null>>()?.is_none() {
            let name: Ident = input.parse()?;
            if !input.peek(Token![=]) {
                let message = format!("what does `{name}` square to? Write `{name} = 1`, or -1, or 0");
                return Err(syn::Error::new(name.span(), message));
            }
            input.parse::<Token![=]>()?;
            return Ok(Self::Vector(name, parse_square(input)?.0));
        }
        input.parse::<keyword::pair>()?;
        let names;
        syn::parenthesized!(names in input);
        let first: Ident = names.parse()?;
        names.parse::<Token![,]>()?;
        let second = names.parse()?;
        input.parse::<Token![=]>()?;
        match parse_square(input)? {
            (0, span) => Err(syn::Error::new(
                span,
                "a null pair has inner product 1 or -1; with 0 these are two vectors of square 0",
            )),
            (inner, _) => Ok(Self::Pair(first, second, inner)),
        }
    }
}

impl TypeSource {
    fn parse(docs: Vec<Attribute>, input: ParseStream) -> syn::Result<Self> {
        input.parse::<Token![type]>()?;
        let name = input.parse()?;
        let mut facts = Vec::new();
        if input.parse::<Option<Token![:]>>()?.is_some() {
            facts.extend(Punctuated::<Ident, Token![+]>::parse_separated_nonempty(input)?);
        }
        input.parse::<Token![=]>()?;
        let body = if input.peek(syn::token::Bracket) {
            let blades;
            syn::bracketed!(blades in input);
            let mut stored = Vec::new();
            while !blades.is_empty() {
                let blade = blades.parse()?;
                let constant =
                    if blades.parse::<Option<Token![=]>>()?.is_some() { Some(blades.parse()?) } else { None };
                stored.push((blade, constant));
                if !blades.is_empty() {
                    blades.parse::<Token![,]>()?;
                }
            }
            TypeBody::Stored(stored)
        } else {
            TypeBody::Sum(Box::new(input.parse()?))
        };
        input.parse::<Token![;]>()?;
        Ok(Self { docs, name, facts, body })
    }
}

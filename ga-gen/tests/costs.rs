//! Ceilings on the operations of the kernels that inner loops are made of.
//!
//! A count above its ceiling is a loss of speed that no other test sees. A count below it is good news: lower the
//! ceiling with it.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use ga_gen::formula::Compiled;
use ga_gen::inspect;
use ga_gen::item::Item;
use ga_gen::program::Counts;
use ga_gen::spec::Spec;
use support::source_of;

/// Name, multiplications and additions and sign changes together, divisions. No item here takes a square root.
const G3: [(&str, usize, usize); 2] = [("Rotor*Rotor", 28, 0), ("Rotor.apply(Vector)", 30, 0)];
const CGA: [(&str, usize, usize); 4] =
    [("Point|Point", 10, 0), ("Motor.apply(Point)", 39, 0), ("Motor*Motor", 88, 0), ("Even*Even", 496, 0)];
const FORMULAS: [(&str, usize, usize); 1] = [("circumsphere", 73, 1)];

fn check(items: &[Item], ceilings: &[(&str, usize, usize)]) {
    for (name, operations, div) in ceilings {
        let item = items.iter().find(|item| item.name == *name).unwrap_or_else(|| panic!("no item {name}"));
        check_counts(name, item.program.counts(), *operations, *div);
    }
}

fn check_counts(name: &str, counts: Counts, operations: usize, div: usize) {
    assert!(counts.operations() <= operations, "{name}: {counts:?}, at most {operations}");
    assert!(counts.div <= div && counts.sqrt == 0, "{name}: {counts:?}, at most {div} divisions");
    println!("{name}: {} operations of {operations}", counts.operations());
}

#[test]
fn formulas_stay_below_their_ceilings() {
    let formulas = library_formulas();
    for (name, operations, div) in FORMULAS {
        let found = formulas.iter().find(|(_, compiled)| compiled.formula.source.header.name == name);
        check_counts(name, found.unwrap().1.program.counts(), operations, div);
    }
}

#[test]
fn kernels_stay_below_their_ceilings() {
    let g3 = Spec::new(&source_of("g3"), None).unwrap();
    let cga = Spec::new(&source_of("cga"), Some(&g3)).unwrap();
    check(&inspect::items(&g3).unwrap(), &G3);
    check(&inspect::items(&cga).unwrap(), &CGA);
}

/// What is counted is what is emitted: operators in the code against counts of the program.
#[test]
fn counts_are_those_of_the_emitted_code() {
    let g3 = Spec::new(&source_of("g3"), None).unwrap();
    let cga = Spec::new(&source_of("cga"), Some(&g3)).unwrap();
    let mut compared = 0;
    for item in inspect::items(&cga).unwrap() {
        let code = ga_gen::emit::item(&cga, &item);
        let Ok(file) = syn::parse2::<syn::File>(code) else { continue };
        // A meet is emitted with an operator that forwards to it: the first function is the one that computes.
        let Some(first) = file.items.first() else { continue };
        compare(&item.name, first, item.program.counts());
        compared += 1;
    }
    for (spec, compiled) in library_formulas() {
        let function = syn::parse2(ga_gen::emit::formula_function(&spec, &compiled)).unwrap();
        let name = compiled.formula.source.header.name.to_string();
        compare(&name, &function, compiled.program.counts());
        compared += 1;
    }
    assert!(compared > 1500, "only {compared} items were compared");
}

fn compare(name: &str, function: &syn::Item, counts: Counts) {
    let mut counter = Counter::default();
    syn::visit::Visit::visit_item(&mut counter, function);
    let Counts { mul, add, neg, div, sqrt } = counts;
    let found = (counter.mul, counter.add + counter.neg, counter.div, counter.sqrt);
    assert_eq!(found, (mul, add + neg, div, sqrt), "{name}");
}

/// The formulas of the library's geometry.
fn library_formulas() -> Vec<(Spec, Compiled)> {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../src");
    let file = root.join("geometry/formulas.rs");
    inspect::load(&file, Some(&root.join("algebra/cga.rs"))).unwrap().formulas
}

#[derive(Default)]
struct Counter {
    mul: usize,
    add: usize,
    neg: usize,
    div: usize,
    sqrt: usize,
}

impl<'a> syn::visit::Visit<'a> for Counter {
    fn visit_expr_binary(&mut self, expression: &'a syn::ExprBinary) {
        match expression.op {
            syn::BinOp::Mul(_) => self.mul += 1,
            syn::BinOp::Add(_) | syn::BinOp::Sub(_) => self.add += 1,
            syn::BinOp::Div(_) => self.div += 1,
            _ => {}
        }
        syn::visit::visit_expr_binary(self, expression);
    }

    fn visit_expr_unary(&mut self, expression: &'a syn::ExprUnary) {
        // A minus in a constant is no operation.
        if !matches!(&*expression.expr, syn::Expr::Lit(_)) {
            self.neg += 1;
        }
        syn::visit::visit_expr_unary(self, expression);
    }

    fn visit_expr_call(&mut self, call: &'a syn::ExprCall) {
        if let syn::Expr::Path(path) = &*call.func
            && path.path.segments.last().is_some_and(|segment| segment.ident == "sqrt")
        {
            self.sqrt += 1;
        }
        syn::visit::visit_expr_call(self, call);
    }
}

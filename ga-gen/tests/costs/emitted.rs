//! What is counted is what is emitted: operators in the code against counts of the program.

use crate::root;
use crate::support::source_of;
use ga_gen::formula::Compiled;
use ga_gen::inspect;
use ga_gen::program::Counts;
use ga_gen::spec::Spec;

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
    let algebra = root().join("src/algebra/cga.rs");
    inspect::load(&root().join("src/geometry/formulas.rs"), Some(&algebra)).unwrap().formulas
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

//! Random formulas: small trees of operations over random types, compiled as text and compared with the dense value. What
//! fails is cut down to a smallest tree that still does.

use crate::algebras::Algebra;
use crate::dense::{Dense, Oracle, Part, number};
use crate::elements::{Random, fields};
use crate::evaluate::run;
use crate::formulas::read;
use crate::interpret::inputs;
use ga_gen::blade::Blade;
use ga_gen::field::Residue;
use ga_gen::formula;
use ga_gen::infer::Output;
use ga_gen::types::Type;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// None of them is a basis vector of an algebra here.
const PARAMETERS: [&str; 3] = ["x", "y", "z"];

#[derive(Clone, Debug)]
enum Tree {
    Parameter(usize),
    Blade(String, Blade),
    Number(i32, i32),
    Unary(Unary, Box<Tree>),
    Binary(Binary, Box<Tree>, Box<Tree>),
}

#[derive(Clone, Copy, Debug)]
enum Unary {
    Negative,
    Reverse,
    Dual,
    Undual,
    Grade(u32),
    NormSq,
}

#[derive(Clone, Copy, Debug)]
enum Binary {
    Plus,
    Minus,
    Geometric,
    Outer,
    Contraction,
    Meet,
    Apply,
    /// Divided by the norm squared of the second.
    Over,
}

impl fmt::Display for Tree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Parameter(index) => f.write_str(PARAMETERS[*index]),
            Self::Blade(name, _) => f.write_str(name),
            Self::Number(n, d) => write!(f, "({n}/{d})"),
            Self::Unary(unary, a) => match unary {
                Unary::Negative => write!(f, "(-{a})"),
                Unary::Reverse => write!(f, "{a}.rev()"),
                Unary::Dual => write!(f, "{a}.dual()"),
                Unary::Undual => write!(f, "{a}.undual()"),
                Unary::Grade(grade) => write!(f, "{a}.grade({grade})"),
                Unary::NormSq => write!(f, "{a}.norm_sq()"),
            },
            Self::Binary(Binary::Apply, a, b) => write!(f, "{a}.apply({b})"),
            Self::Binary(Binary::Over, a, b) => write!(f, "({a} / {b}.norm_sq())"),
            Self::Binary(binary, a, b) => {
                let symbol = match binary {
                    Binary::Plus => "+",
                    Binary::Minus => "-",
                    Binary::Geometric => "*",
                    Binary::Outer => "^",
                    Binary::Contraction => "|",
                    Binary::Meet => "&",
                    Binary::Apply | Binary::Over => unreachable!("written above"),
                };
                write!(f, "({a} {symbol} {b})")
            }
        }
    }
}

impl Tree {
    fn random(algebra: &Algebra, types: usize, depth: usize, random: &mut Random) -> Self {
        let dual = algebra.spec.pseudoscalar.is_some_and(|i| !i.square.is_zero());
        if depth == 0 || random.below(9) == 0 {
            return match random.below(8) {
                0 => Self::Number(
                    i32::try_from(random.below(4)).unwrap() + 1,
                    i32::try_from(random.below(3)).unwrap() + 1,
                ),
                1 | 2 => {
                    let blade =
                        Blade(u32::try_from(random.below((1 << algebra.spec.signature.dimension()) - 1) + 1).unwrap());
                    Self::Blade(algebra.spec.signature.name(blade), blade)
                }
                _ => Self::Parameter(random.below(types)),
            };
        }
        let mut below = |depth| Box::new(Self::random(algebra, types, depth, random));
        let (a, b) = (below(depth - 1), below(depth.saturating_sub(2)));
        let unary = |unary| Self::Unary(unary, a.clone());
        let (a_, b_) = if random.below(2) == 0 { (a.clone(), b) } else { (b, a.clone()) };
        let binary = |binary| Self::Binary(binary, a_, b_);
        match random.below(20) {
            0 => unary(Unary::Negative),
            1 | 2 => unary(Unary::Reverse),
            3 if dual => unary(Unary::Dual),
            4 if dual => unary(Unary::Undual),
            5 => unary(Unary::Grade(u32::try_from(random.below(algebra.spec.signature.dimension() + 1)).unwrap())),
            6 => unary(Unary::NormSq),
            7 | 8 => binary(Binary::Plus),
            9 => binary(Binary::Minus),
            10 | 11 => binary(Binary::Outer),
            12 => binary(Binary::Contraction),
            13 => binary(Binary::Meet),
            14 | 15 => binary(Binary::Apply),
            16 => binary(Binary::Over),
            _ => binary(Binary::Geometric),
        }
    }

    /// The value; `None` where it divides by zero.
    fn value(&self, oracle: &Oracle, parameters: &[Dense]) -> Option<Dense> {
        let of = |tree: &Self| tree.value(oracle, parameters);
        Some(match self {
            Self::Parameter(index) => parameters[*index].clone(),
            Self::Blade(_, blade) => oracle.blade(*blade).clone(),
            Self::Number(n, d) => oracle.scalar(number((*n).into(), (*d).into())),
            Self::Unary(unary, a) => {
                let a = of(a)?;
                match unary {
                    Unary::Negative => oracle.scaled(&a, Residue::ONE.negated()),
                    Unary::Reverse => oracle.reverse(&a),
                    Unary::Dual => oracle.dual(&a)?,
                    Unary::Undual => oracle.undual(&a)?,
                    Unary::Grade(wanted) => oracle.grade(&a, |grade| grade == *wanted),
                    Unary::NormSq => oracle.scalar(oracle.norm_sq(&a)),
                }
            }
            Self::Binary(binary, a, b) => {
                let (a, b) = (of(a)?, of(b)?);
                match binary {
                    Binary::Plus => oracle.sum(&a, &b),
                    Binary::Minus => oracle.sum(&a, &oracle.scaled(&b, Residue::ONE.negated())),
                    Binary::Geometric => oracle.product(Part::All, &a, &b),
                    Binary::Outer => oracle.product(Part::Outer, &a, &b),
                    Binary::Contraction => oracle.product(Part::Contraction, &a, &b),
                    Binary::Meet => oracle.meet(&a, &b)?,
                    Binary::Apply => oracle.sandwich(&a, &b),
                    Binary::Over => {
                        let square = oracle.norm_sq(&b);
                        (square != Residue::ZERO).then(|| oracle.scaled(&a, square.inverse()))?
                    }
                }
            }
        })
    }

    /// Trees with a node less.
    fn smaller(&self) -> Vec<Self> {
        match self {
            Self::Unary(unary, a) => {
                let inner = a.smaller().into_iter().map(|a| Self::Unary(*unary, Box::new(a)));
                [(**a).clone()].into_iter().chain(inner).collect()
            }
            Self::Binary(binary, a, b) => {
                let left = a.smaller().into_iter().map(|a| Self::Binary(*binary, Box::new(a), b.clone()));
                let right = b.smaller().into_iter().map(|b| Self::Binary(*binary, a.clone(), Box::new(b)));
                [(**a).clone(), (**b).clone()].into_iter().chain(left).chain(right).collect()
            }
            _ => vec![],
        }
    }
}

/// What became of a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    Equal,
    /// Refused with this sentence, which is right.
    Refused(String),
    Wrong(String),
}

/// Sentences by which a random formula may be refused; that the first two are true is checked.
const SENTENCES: [&str; 5] = [
    "identically zero",
    "has no value",
    "tied to the origin",
    "depends on where the origin",
    "constants of generated code",
];

struct Case<'a> {
    algebra: &'a Algebra,
    oracle: &'a Oracle,
    types: Vec<usize>,
    option: String,
    seed: u64,
}

impl Case<'_> {
    fn text(&self, tree: &Tree) -> String {
        let name = |ty: &usize| self.algebra.spec.types[*ty].name.to_string();
        let parameters = PARAMETERS.iter().zip(&self.types).map(|(p, ty)| format!("{p}: {}", name(ty)));
        let parameters: Vec<String> = parameters.collect();
        format!("(g{}) fn f({}) -> Multivector {{ {tree} }}", self.option, parameters.join(", "))
    }

    fn outcome(&self, tree: &Tree) -> Outcome {
        catch_unwind(AssertUnwindSafe(|| self.compared(tree)))
            .unwrap_or_else(|panic| Outcome::Wrong(format!("panic: {:?}", panic.downcast_ref::<String>())))
    }

    fn compared(&self, tree: &Tree) -> Outcome {
        let spec = &self.algebra.spec;
        let mut random = Random(self.seed);
        let sampled: Vec<Vec<Residue>> =
            self.types.iter().map(|ty| fields(self.oracle, &spec.types[*ty], &mut random)).collect();
        let parameters: Vec<Dense> =
            self.types.iter().zip(&sampled).map(|(ty, f)| self.oracle.value(&spec.types[*ty], f)).collect();
        let expected = tree.value(self.oracle, &parameters);
        let compiled = read(self.algebra, &self.text(tree)).and_then(|formula| formula::compile(spec, &formula));
        let (compiled, expected) = match (compiled, expected) {
            (Ok(compiled), Some(expected)) => (compiled, expected),
            (Ok(_), None) => return Outcome::Wrong("compiled, but divides by zero".into()),
            (Err(error), expected) => {
                let sentence = error.to_string();
                let Some(known) = SENTENCES.iter().position(|known| sentence.contains(known)) else {
                    return Outcome::Wrong(sentence);
                };
                let nothing = expected.is_none_or(|value| value == self.oracle.zero());
                return if known > 0 || nothing { Outcome::Refused(sentence) } else { Outcome::Wrong(sentence) };
            }
        };
        let named = PARAMETERS.into_iter().zip(self.types.iter().map(|ty| Output::Type(*ty)));
        let numbers = run(&compiled.program, &inputs(spec, named, &sampled)).unwrap();
        let full = spec.find("Multivector").unwrap();
        if self.oracle.value(&spec.types[full], &numbers) == expected {
            Outcome::Equal
        } else {
            Outcome::Wrong("another value".into())
        }
    }

    fn shrunk(&self, mut tree: Tree) -> (Tree, Outcome) {
        let wrong = |tree: &Tree| matches!(self.outcome(tree), Outcome::Wrong(_));
        while let Some(smaller) = tree.smaller().into_iter().find(wrong) {
            tree = smaller;
        }
        let outcome = self.outcome(&tree);
        (tree, outcome)
    }
}

/// Compares random formulas; returns how many were equal and how many refused. Fails with the smallest wrong ones.
pub(crate) fn hunt(algebra: &Algebra, cases: usize, depth: usize, seed: u64) -> (usize, usize) {
    let (oracle, mut random) = (Oracle::new(&algebra.spec), Random(seed));
    let (mut equal, mut refused, mut wrong) = (0, 0, Vec::new());
    let usable = |ty: &usize| !algebra.spec.types[*ty].fields.is_empty() && !algebra.spec.is_full(*ty);
    let usable: Vec<usize> = (0..algebra.spec.types.len()).filter(usable).collect();
    for _ in 0..cases {
        let types: Vec<usize> = (0..=random.below(3)).map(|_| usable[random.below(usable.len())]).collect();
        let point = |ty: &Type| ty.weight().is_some() && ty.coefficients.keys().all(|blade| blade.grade() == 1);
        let local = types.iter().position(|ty| point(&algebra.spec.types[*ty]));
        let option = match (local, random.below(3)) {
            (Some(index), 0) => format!(", local = {}", PARAMETERS[index]),
            _ => String::new(),
        };
        let tree = Tree::random(algebra, types.len(), depth, &mut random);
        let case = Case { algebra, oracle: &oracle, types, option, seed: random.next() };
        match case.outcome(&tree) {
            Outcome::Equal => equal += 1,
            Outcome::Refused(_) => refused += 1,
            Outcome::Wrong(_) => {
                let (tree, outcome) = case.shrunk(tree);
                let line = format!("{}: {} {outcome:?}", algebra.name, case.text(&tree));
                println!("{line}");
                wrong.push(line);
            }
        }
    }
    assert!(wrong.is_empty(), "{} of {cases} are wrong:\n{}", wrong.len(), wrong.join("\n"));
    (equal, refused)
}

//! The metric: named basis vectors with squares +1, -1, 0, and null pairs; products of basis blades.

use crate::blade::{Blade, swaps_are_odd};
use crate::scalar::Rational;
use std::cell::OnceCell;

/// How a basis vector multiplies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// An orthogonal vector with this square (+1, -1 or 0).
    Square(i8),
    /// The first of a null pair; the next vector is its partner, and their inner product is given.
    PairFirst(i8),
    /// The second of a null pair.
    PairSecond,
}

/// Named basis vectors with their metric. At most [`Signature::MAX_DIMENSION`] of them.
#[derive(Clone, Debug, Default)]
pub struct Signature {
    names: Vec<String>,
    kinds: Vec<Kind>,
    /// All products of basis blades, made when the first is asked for: an algebra asks for each some thousand times.
    table: OnceCell<Vec<Terms>>,
    /// The names of all blades, made when the first is asked for.
    blade_names: OnceCell<Vec<String>>,
}

/// A sum of at most two basis blades: a product within one null pair has two terms.
pub type Terms = Vec<(Blade, Rational)>;

impl Signature {
    /// Beyond six dimensions a general multivector has more than 64 coefficients, and unrolled products stop paying.
    pub const MAX_DIMENSION: usize = 6;

    /// Adds an orthogonal vector.
    pub fn push(&mut self, name: String, square: i8) {
        self.names.push(name);
        self.kinds.push(Kind::Square(square));
        self.table.take();
        self.blade_names.take();
    }

    /// Adds a null pair `(o, i)` with `o . i = inner`.
    pub fn push_pair(&mut self, first: String, second: String, inner: i8) {
        self.names.extend([first, second]);
        self.kinds.extend([Kind::PairFirst(inner), Kind::PairSecond]);
        self.table.take();
        self.blade_names.take();
    }

    /// The number of basis vectors.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.names.len()
    }

    /// The names of the basis vectors.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// How each basis vector multiplies.
    #[must_use]
    pub fn kinds(&self) -> &[Kind] {
        &self.kinds
    }

    /// All 2^n basis blades, by grade and then in declared order.
    #[must_use]
    pub fn blades(&self) -> Vec<Blade> {
        let mut blades: Vec<Blade> = (0..1 << self.dimension()).map(Blade).collect();
        blades.sort_by_key(|blade| (blade.grade(), blade.0));
        blades
    }

    /// The name of a blade: `s`, `e23`, `e1_ninf`, `e123_no_ninf`.
    #[must_use]
    pub fn name(&self, blade: Blade) -> String {
        let names = self.blade_names.get_or_init(|| (0..1 << self.dimension()).map(|b| self.spell(Blade(b))).collect());
        names[blade.0 as usize].clone()
    }

    fn spell(&self, blade: Blade) -> String {
        if blade == Blade::SCALAR {
            return "s".into();
        }
        let mut name = String::new();
        for (index, vector) in self.names.iter().enumerate().filter(|(index, _)| blade.contains(*index)) {
            let digits =
                vector.strip_prefix('e').filter(|rest| rest.len() == 1 && rest.bytes().all(|b| b.is_ascii_digit()));
            match digits {
                Some(digit) if name.ends_with(|last: char| last.is_ascii_digit()) => name += digit,
                _ => {
                    let separator = if name.is_empty() || index == 0 { "" } else { "_" };
                    name = name + separator + vector;
                }
            }
        }
        name
    }

    /// Reads a blade name; the flag says that its factors stand in an odd permutation of declared order
    /// (`e31 = -e13`). `None` if a part is no basis vector or comes twice.
    #[must_use]
    pub fn parse(&self, name: &str) -> Option<(Blade, bool)> {
        if name == "s" {
            return Some((Blade::SCALAR, false));
        }
        let (mut blade, mut odd) = (Blade::SCALAR, false);
        for part in name.split('_') {
            let vectors: Vec<String> = match self.names.iter().any(|known| known == part) {
                true => vec![part.to_string()],
                false => part.strip_prefix('e')?.chars().map(|digit| format!("e{digit}")).collect(),
            };
            for vector in vectors {
                let factor = Blade::vector(self.names.iter().position(|known| *known == vector)?);
                if blade.0 & factor.0 != 0 {
                    return None;
                }
                odd ^= swaps_are_odd(blade, factor);
                blade = Blade(blade.0 | factor.0);
            }
        }
        Some((blade, odd))
    }

    /// The geometric product of two basis blades.
    #[must_use]
    pub fn geometric(&self, a: Blade, b: Blade) -> &[(Blade, Rational)] {
        let size = 1 << self.dimension();
        let table = self.table.get_or_init(|| {
            let pairs = (0..size).flat_map(|a| (0..size).map(move |b| (a, b)));
            pairs.map(|(a, b)| self.multiply(Blade(a), Blade(b))).collect()
        });
        &table[(a.0 * size + b.0) as usize]
    }

    /// The basis falls into mutually orthogonal blocks (single vectors and null pairs), so the product is that of the
    /// blocks, with the sign of sorting the factors of `b` past those of `a`.
    fn multiply(&self, a: Blade, b: Blade) -> Terms {
        let mut terms: Terms = vec![(Blade::SCALAR, Rational::ONE)];
        let mut odd = false;
        for (index, kind) in self.kinds.iter().enumerate() {
            let block = match kind {
                Kind::Square(_) => 0b1 << index,
                Kind::PairFirst(_) => 0b11 << index,
                Kind::PairSecond => continue,
            };
            let (part_a, part_b) = ((a.0 & block) >> index, (b.0 & block) >> index);
            // The part of b in this block moves left past the parts of a in all later blocks.
            let later = Blade(a.0 & !(block | (block - 1)));
            odd ^= later.grade() & part_b.count_ones() & 1 == 1;
            let product = match kind {
                Kind::PairFirst(inner) => pair_product(part_a, part_b, *inner),
                Kind::Square(square) => single_product(part_a, part_b, *square),
                Kind::PairSecond => continue,
            };
            terms = terms
                .iter()
                .flat_map(|(blade, c)| product.iter().map(move |(part, d)| (Blade(blade.0 | part << index), *c * *d)))
                .collect();
        }
        if odd {
            terms.iter_mut().for_each(|(_, c)| *c = -*c);
        }
        terms
    }
}

fn single_product(a: u32, b: u32, square: i8) -> Vec<(u32, Rational)> {
    match (a & b, square) {
        (0, _) => vec![(a | b, Rational::ONE)],
        (_, 0) => vec![],
        (_, square) => vec![(0, Rational::from(i32::from(square)))],
    }
}

/// Products within a null pair `o, i` with `o . i = c`; bits: 1 = o, 2 = i, 3 = o ^ i. From `o i = c + o^i`:
/// `i o = c - o^i`, `o (o^i) = -c o`, `(o^i) o = c o`, `i (o^i) = c i`, `(o^i) i = -c i`, `(o^i)^2 = c^2`.
fn pair_product(a: u32, b: u32, inner: i8) -> Vec<(u32, Rational)> {
    let one = Rational::ONE;
    let c = Rational::from(i32::from(inner));
    match (a, b) {
        (0, x) | (x, 0) => vec![(x, one)],
        (1, 2) => vec![(0, c), (3, one)],
        (2, 1) => vec![(0, c), (3, -one)],
        (1, 3) => vec![(1, -c)],
        (3, 1) => vec![(1, c)],
        (2, 3) => vec![(2, c)],
        (3, 2) => vec![(2, -c)],
        (3, 3) => vec![(0, c * c)],
        _ => vec![],
    }
}

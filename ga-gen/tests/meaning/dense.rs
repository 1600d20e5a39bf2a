//! The independent answer: dense multivectors over the prime field, in an orthonormal basis.
//!
//! A null pair `(o, i)` with `o.i = c` stands for `p`, `m` of squares +1 and -1: `o = c (p - m)/2`, `i = p + m`. Products
//! come from swapping neighbouring factors until they are sorted; nothing of the generator's tables is used.

use ga_gen::blade::Blade;
use ga_gen::field::Residue;
use ga_gen::scalar::Rational;
use ga_gen::signature::Kind;
use ga_gen::spec::Spec;
use ga_gen::types::Type;

/// The coefficient of each orthonormal blade, by its set of factors.
pub(crate) type Dense = Vec<Residue>;

/// Which part of the product of an r-blade and an s-blade counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    All,
    Outer,
    Contraction,
}

/// A small number of the field.
pub(crate) fn number(n: i128, d: i128) -> Residue {
    Rational::new(n, d).unwrap().into()
}

/// The metric of an algebra, and its declared basis in the orthonormal one.
pub(crate) struct Oracle {
    squares: Vec<i8>,
    /// Each declared blade.
    blades: Vec<Dense>,
    /// Each orthonormal blade in terms of the declared ones.
    unblades: Vec<Dense>,
    pseudoscalar: Option<Dense>,
}

/// `e_a e_b` as a sign (0 for a null vector squared) and a blade: factors are swapped until they are sorted.
fn sorted(squares: &[i8], a: usize, b: usize) -> (i8, usize) {
    let factors = |blade: usize| (0..squares.len()).filter(move |i| blade >> i & 1 == 1);
    let mut word: Vec<usize> = factors(a).chain(factors(b)).collect();
    let mut sign = 1;
    let mut index = 0;
    while index + 1 < word.len() {
        if word[index] == word[index + 1] {
            sign *= squares[word[index]];
            word.drain(index..index + 2);
            index = 0;
        } else if word[index] > word[index + 1] {
            word.swap(index, index + 1);
            sign = -sign;
            index = 0;
        } else {
            index += 1;
        }
    }
    (sign, word.into_iter().fold(0, |blade, factor| blade | 1 << factor))
}

fn grade(blade: usize) -> u32 {
    blade.count_ones()
}

fn multiply(squares: &[i8], part: Part, a: &Dense, b: &Dense) -> Dense {
    let mut result = vec![Residue::ZERO; a.len()];
    for (i, x) in a.iter().enumerate().filter(|(_, x)| **x != Residue::ZERO) {
        for (j, y) in b.iter().enumerate().filter(|(_, y)| **y != Residue::ZERO) {
            let (sign, blade) = sorted(squares, i, j);
            let counts = match part {
                Part::All => true,
                Part::Outer => grade(blade) == grade(i) + grade(j),
                Part::Contraction => grade(blade) + grade(i) == grade(j),
            };
            if counts && sign != 0 {
                let product = x.times(*y);
                result[blade] = result[blade].plus(if sign < 0 { product.negated() } else { product });
            }
        }
    }
    result
}

/// All blades as outer products of given vectors.
fn blades(squares: &[i8], vectors: &[Dense]) -> Vec<Dense> {
    let size = 1 << vectors.len();
    let mut result: Vec<Dense> = Vec::new();
    for blade in 0..size {
        let mut product = vec![Residue::ZERO; size];
        product[0] = Residue::ONE;
        for (index, vector) in vectors.iter().enumerate() {
            if blade >> index & 1 == 1 {
                product = multiply(squares, Part::Outer, &product, vector);
            }
        }
        result.push(product);
    }
    result
}

impl Oracle {
    pub(crate) fn new(spec: &Spec) -> Self {
        let kinds = spec.signature.kinds();
        let size = 1 << kinds.len();
        let vector = |parts: &[(usize, Residue)]| {
            let mut vector = vec![Residue::ZERO; size];
            parts.iter().for_each(|(index, value)| vector[1 << index] = *value);
            vector
        };
        let (one, half) = (Residue::ONE, number(1, 2));
        let (mut squares, mut there, mut back) = (vec![], vec![], vec![]);
        for (index, kind) in kinds.iter().enumerate() {
            match kind {
                Kind::Square(square) => {
                    squares.push(*square);
                    there.push(vector(&[(index, one)]));
                    back.push(vector(&[(index, one)]));
                }
                Kind::PairFirst(c) => {
                    squares.extend([1, -1]);
                    let (c, inverse) = (number((*c).into(), 1), number(1, (*c).into()));
                    there.push(vector(&[(index, c.times(half)), (index + 1, c.times(half).negated())]));
                    there.push(vector(&[(index, one), (index + 1, one)]));
                    back.push(vector(&[(index, inverse), (index + 1, half)]));
                    back.push(vector(&[(index, inverse.negated()), (index + 1, half)]));
                }
                Kind::PairSecond => {}
            }
        }
        // Outer products know no metric: sorting alone counts.
        let euclidean = vec![1; kinds.len()];
        let (blades, unblades) = (blades(&euclidean, &there), blades(&euclidean, &back));
        let pseudoscalar = spec.pseudoscalar.map(|i| {
            let sign: Residue = i.sign.into();
            blades[size - 1].iter().map(|x| x.times(sign)).collect()
        });
        Self { squares, blades, unblades, pseudoscalar }
    }

    pub(crate) fn zero(&self) -> Dense {
        vec![Residue::ZERO; self.blades.len()]
    }

    pub(crate) fn scalar(&self, value: Residue) -> Dense {
        let mut result = self.zero();
        result[0] = value;
        result
    }

    /// A declared blade.
    pub(crate) fn blade(&self, blade: Blade) -> &Dense {
        &self.blades[blade.0 as usize]
    }

    /// The coefficient of each declared blade.
    pub(crate) fn coefficients(&self, a: &Dense) -> Vec<Residue> {
        let mut result = self.zero();
        for (x, blade) in a.iter().zip(&self.unblades) {
            result.iter_mut().zip(blade).for_each(|(sum, y)| *sum = sum.plus(x.times(*y)));
        }
        result
    }

    /// A value of a type, by the fields.
    pub(crate) fn value(&self, ty: &Type, fields: &[Residue]) -> Dense {
        let mut result = self.zero();
        for (blade, polynomial) in &ty.coefficients {
            let coefficient = polynomial.terms().fold(Residue::ZERO, |sum, (term, factor)| {
                sum.plus(term.iter().fold(factor.into(), |product: Residue, field| product.times(fields[*field])))
            });
            result = self.sum(&result, &self.scaled(self.blade(*blade), coefficient));
        }
        result
    }

    pub(crate) fn product(&self, part: Part, a: &Dense, b: &Dense) -> Dense {
        multiply(&self.squares, part, a, b)
    }

    pub(crate) fn sum(&self, a: &Dense, b: &Dense) -> Dense {
        a.iter().zip(b).map(|(x, y)| x.plus(*y)).collect()
    }

    pub(crate) fn scaled(&self, a: &Dense, factor: Residue) -> Dense {
        a.iter().map(|x| x.times(factor)).collect()
    }

    pub(crate) fn grade(&self, a: &Dense, wanted: impl Fn(u32) -> bool) -> Dense {
        a.iter().enumerate().map(|(blade, x)| if wanted(grade(blade)) { *x } else { Residue::ZERO }).collect()
    }

    pub(crate) fn reverse(&self, a: &Dense) -> Dense {
        // A blade of grade k needs k (k - 1) / 2 swaps: an odd number for the grades 2 and 3, and again after each four.
        let odd = |blade: usize| grade(blade) % 4 > 1;
        a.iter().enumerate().map(|(blade, x)| if odd(blade) { x.negated() } else { *x }).collect()
    }

    /// `I a`; `None` without pseudoscalar.
    pub(crate) fn dual(&self, a: &Dense) -> Option<Dense> {
        Some(self.product(Part::All, self.pseudoscalar.as_ref()?, a))
    }

    /// `I^-1 a`; `None` without pseudoscalar, or where it squares to zero.
    pub(crate) fn undual(&self, a: &Dense) -> Option<Dense> {
        let i = self.pseudoscalar.as_ref()?;
        let square = self.product(Part::All, i, i)[0];
        let inverse = self.scaled(i, square.inverse());
        (square != Residue::ZERO).then(|| self.product(Part::All, &inverse, a))
    }

    /// `undual(dual a ^ dual b)`; where I squares to zero, the same with complements: the right one c of a declared blade
    /// is `b ^ c = I`, the left one `c ^ b = I`.
    pub(crate) fn meet(&self, a: &Dense, b: &Dense) -> Option<Dense> {
        let i = self.pseudoscalar.as_ref()?;
        if self.product(Part::All, i, i)[0] != Residue::ZERO {
            return self.undual(&self.product(Part::Outer, &self.dual(a)?, &self.dual(b)?));
        }
        let [a, b] = [a, b].map(|x| self.complement(x, i, |blade, rest| (blade, rest)));
        Some(self.complement(&self.product(Part::Outer, &a, &b), i, |blade, rest| (rest, blade)))
    }

    fn complement(&self, a: &Dense, i: &Dense, order: impl Fn(usize, usize) -> (usize, usize)) -> Dense {
        let mut result = self.zero();
        for (blade, x) in self.coefficients(a).into_iter().enumerate() {
            let rest = a.len() - 1 - blade;
            let (left, right) = order(blade, rest);
            let whole = self.product(Part::Outer, &self.blades[left], &self.blades[right]);
            // Both are multiples of the highest orthonormal blade.
            let factor = i[a.len() - 1].times(whole[a.len() - 1].inverse());
            result = self.sum(&result, &self.scaled(&self.blades[rest], x.times(factor)));
        }
        result
    }

    /// `v x ~v`, restricted to the declared grades of x.
    pub(crate) fn sandwich(&self, v: &Dense, x: &Dense) -> Dense {
        let image = self.product(Part::All, &self.product(Part::All, v, x), &self.reverse(v));
        let grades: Vec<u32> = (0..x.len()).filter(|blade| x[*blade] != Residue::ZERO).map(grade).collect();
        self.grade(&image, |grade| grades.contains(&grade))
    }

    /// The scalar part of `a ~a`.
    pub(crate) fn norm_sq(&self, a: &Dense) -> Residue {
        self.product(Part::All, a, &self.reverse(a))[0]
    }
}

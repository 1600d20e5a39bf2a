//! Systems of particles with distances between them: what the tests solve and project.

use ga_physics::constraint::{Configuration, Rows};
use nalgebra::{DMatrix, DVector};

/// A distance between two particles: `C = (|x_a - x_b|² - d²) / 2`.
#[derive(Clone, Copy)]
pub(crate) struct Link {
    pub(crate) a: usize,
    pub(crate) b: usize,
    pub(crate) length: f64,
}

#[derive(Clone)]
pub(crate) struct System {
    pub(crate) position: Vec<[f64; 3]>,
    pub(crate) velocity: Vec<[f64; 3]>,
    pub(crate) inv_mass: Vec<f64>,
    pub(crate) links: Vec<Link>,
}

/// Numbers in -1 .. 1 that look random (a linear congruence, Knuth 1981, MMIX).
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    pub(crate) fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn vector(&mut self) -> [f64; 3] {
        std::array::from_fn(|_| self.roll())
    }

    pub(crate) fn below(&mut self, n: usize) -> usize {
        #[expect(clippy::cast_possible_truncation, reason = "the lowest bits of a roll are as random as the others")]
        let roll = (self.roll().abs() * (1_u64 << 52) as f64) as usize;
        roll % n
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

impl System {
    /// Links of the present lengths; velocities at random.
    pub(crate) fn new(position: Vec<[f64; 3]>, fixed: &[usize], pairs: &[(usize, usize)]) -> Self {
        let length = |a: usize, b: usize| dot(minus(position[a], position[b]), minus(position[a], position[b])).sqrt();
        let links = pairs.iter().map(|(a, b)| Link { a: *a, b: *b, length: length(*a, *b) }).collect();
        let mut dice = Dice(7);
        let n = position.len();
        let inv_mass = (0..n).map(|k| if fixed.contains(&k) { 0.0 } else { 1.0 }).collect::<Vec<_>>();
        let velocity = (0..n).map(|k| if inv_mass[k] == 0.0 { [0.0; 3] } else { dice.vector() }).collect();
        Self { position, velocity, inv_mass, links }
    }

    /// A chain that bends, its first particle fixed.
    pub(crate) fn chain(links: usize) -> Self {
        let mut dice = Dice(links as u64);
        let mut position = vec![[0.0; 3]];
        for k in 0..links {
            let step = dice.vector();
            let last = position[k];
            position.push([last[0] + 1.0, last[1] + step[1], last[2] + step[2]]);
        }
        Self::new(position, &[0], &(0..links).map(|k| (k, k + 1)).collect::<Vec<_>>())
    }

    /// A straight chain of equal links in an oblique direction.
    pub(crate) fn straight(links: usize, fixed: &[usize]) -> Self {
        let direction = [0.6, 0.48, 0.64];
        let position = (0..=links).map(|k| direction.map(|x| x * k as f64)).collect();
        Self::new(position, fixed, &(0..links).map(|k| (k, k + 1)).collect::<Vec<_>>())
    }

    /// A square net, every second column raised by the fold, two corners of the first row fixed.
    pub(crate) fn net(side: usize, fold_rad: f64) -> Self {
        let at = |column: usize, row: usize| row * side + column;
        let (mut position, mut pairs) = (Vec::new(), Vec::new());
        for row in 0..side {
            for column in 0..side {
                let up = if column % 2 == 0 { 0.0 } else { fold_rad.sin() };
                position.push([column as f64 * fold_rad.cos(), up, row as f64]);
                if column + 1 < side {
                    pairs.push((at(column, row), at(column + 1, row)));
                }
                if row + 1 < side {
                    pairs.push((at(column, row), at(column, row + 1)));
                }
            }
        }
        Self::new(position, &[0, side - 1], &pairs)
    }

    /// A tree: every particle hangs on one of those before it.
    pub(crate) fn tree(n: usize, dice: &mut Dice) -> Self {
        let position = (0..n).map(|_| dice.vector()).collect();
        let pairs: Vec<_> = (1..n).map(|k| (dice.below(k), k)).collect();
        Self::new(position, &[0], &pairs)
    }

    /// Links between particles at random, not more than twice as many as particles.
    pub(crate) fn graph(n: usize, links: usize, dice: &mut Dice) -> Self {
        let position = (0..n).map(|_| dice.vector()).collect();
        let mut pairs = Vec::new();
        while pairs.len() < links {
            let (a, b) = (dice.below(n), dice.below(n));
            if a != b && !pairs.contains(&(a, b)) && !pairs.contains(&(b, a)) {
                pairs.push((a, b));
            }
        }
        Self::new(position, &[], &pairs)
    }

    pub(crate) fn rows(&self) -> Rows<3> {
        let mut rows = Rows::new(self.position.len(), self.links.iter().map(|link| [link.a, link.b]));
        self.fill(&mut rows);
        rows
    }

    pub(crate) fn fill(&self, rows: &mut Rows<3>) {
        for (index, link) in self.links.iter().enumerate() {
            let d = minus(self.position[link.a], self.position[link.b]);
            let v = minus(self.velocity[link.a], self.velocity[link.b]);
            let row = rows.row_mut(index);
            // The difference of squares by its factors: a small stretch of a long link keeps its digits.
            let length = dot(d, d).sqrt();
            *row.value = 0.5 * (length - link.length) * (length + link.length);
            *row.curvature = dot(v, v);
            row.gradients[0] = d;
            row.gradients[1] = d.map(|x| -x);
        }
    }

    /// `J W J^T`, formed densely from its definition.
    pub(crate) fn dense(&self, rows: &Rows<3>) -> DMatrix<f64> {
        let (j, w) = (self.dense_j(rows), self.dense_w());
        &j * w * j.transpose()
    }

    pub(crate) fn dense_j(&self, rows: &Rows<3>) -> DMatrix<f64> {
        let mut j = DMatrix::zeros(rows.len(), 3 * self.position.len());
        for index in 0..rows.len() {
            let row = rows.row(index);
            for (block, gradient) in row.blocks.iter().zip(row.gradients) {
                for k in 0..3 {
                    j[(index, 3 * *block as usize + k)] += gradient[k];
                }
            }
        }
        j
    }

    pub(crate) fn dense_w(&self) -> DMatrix<f64> {
        DMatrix::from_diagonal(&DVector::from_iterator(
            3 * self.inv_mass.len(),
            self.inv_mass.iter().flat_map(|w| [*w; 3]),
        ))
    }

    /// The largest stretch of a link, m.
    pub(crate) fn stretch(&self) -> f64 {
        let stretch = |link: &Link| {
            let d = minus(self.position[link.a], self.position[link.b]);
            (dot(d, d).sqrt() - link.length).abs()
        };
        self.links.iter().map(stretch).fold(0.0, f64::max)
    }

    /// Moves what can move by up to `size`.
    pub(crate) fn shake(&mut self, size: f64, dice: &mut Dice) {
        for (position, w) in self.position.iter_mut().zip(&self.inv_mass) {
            if *w != 0.0 {
                let by = dice.vector();
                *position = std::array::from_fn(|k| position[k] + size * by[k]);
            }
        }
    }
}

impl Configuration<3> for System {
    fn evaluate(&mut self, rows: &mut Rows<3>) {
        self.fill(rows);
    }

    fn displace(&mut self, displacement: &[[f64; 3]]) {
        for (position, by) in self.position.iter_mut().zip(displacement) {
            *position = std::array::from_fn(|k| position[k] + by[k]);
        }
    }
}

//! The free motion in double-double numbers by Taylor series: no formula in common with what it judges.
//!
//! ```text
//! L' = L x omega     omega_i = L_i / I_i     q' = q omega / 2
//! ```
//!
//! in the principal frame, with all series from the recurrence of products (Cauchy).

use ga_physics::algebra::g3::Rotor;
use ga_physics::algebra::{DoubleDouble, Scalar};

/// Terms of a series. A step is a tenth of the radius of convergence or less: what is left out is 1e-24.
const TERMS: usize = 24;

/// The longest step, in units of `I1 / |L|`.
const STEP: f64 = 0.25;

type Number = DoubleDouble;
type Series = [Number; TERMS];

fn number(x: f64) -> Number {
    Number::from(x)
}

/// The term `order` of a product of series.
fn product(a: &Series, b: &Series, order: usize) -> Number {
    (0..=order).fold(number(0.0), |sum, i| sum + a[i] * b[order - i])
}

/// A body in its principal frame: momentum, and quaternion w, x, y, z to the world.
pub(crate) struct Top {
    moments: [Number; 3],
    momentum: [Number; 3],
    quaternion: [Number; 4],
}

impl Top {
    /// From what the library is given, every number taken as exact; the rotor is brought to unit length.
    pub(crate) fn new(moments: [f64; 3], rotor: Rotor<f64>, momentum_world: [f64; 3]) -> Self {
        let q = [rotor.s, -rotor.e23, -rotor.e31, -rotor.e12].map(number);
        let norm = q.iter().fold(number(0.0), |sum, x| sum + *x * *x).sqrt();
        let q = q.map(|x| x / norm);
        let conjugate = [q[0], -q[1], -q[2], -q[3]];
        let [x, y, z] = momentum_world.map(number);
        let [_, x, y, z] = times(times(conjugate, [number(0.0), x, y, z]), q);
        Self { moments: moments.map(number), momentum: [x, y, z], quaternion: q }
    }

    /// Goes on by a time.
    pub(crate) fn advance(&mut self, t: f64) {
        self.advance_by(t, STEP);
    }

    pub(crate) fn advance_by(&mut self, t: f64, step: f64) {
        let length = self.momentum.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>().sqrt();
        let least = self.moments.iter().fold(f64::INFINITY, |least, x| least.min(f64::from(*x)));
        let count = (t.abs() * length / least / step).ceil().max(1.0);
        let h = number(t) / number(count);
        let mut done = 0.0;
        while done < count {
            self.step(h);
            done += 1.0;
        }
    }

    fn step(&mut self, h: Number) {
        let mut l: [Series; 3] = std::array::from_fn(|_| [number(0.0); TERMS]);
        let mut omega = l;
        let mut q: [Series; 4] = std::array::from_fn(|_| [number(0.0); TERMS]);
        (0..3).for_each(|i| l[i][0] = self.momentum[i]);
        (0..4).for_each(|i| q[i][0] = self.quaternion[i]);
        for order in 0..TERMS - 1 {
            (0..3).for_each(|i| omega[i][order] = l[i][order] / self.moments[i]);
            let next = number((order + 1) as f64);
            for i in 0..3 {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                l[i][order + 1] = (product(&l[j], &omega[k], order) - product(&l[k], &omega[j], order)) / next;
            }
            let p = |i: usize, j: usize| product(&q[i], &omega[j], order);
            let rates = [
                -p(1, 0) - p(2, 1) - p(3, 2),
                p(0, 0) + p(2, 2) - p(3, 1),
                p(0, 1) + p(3, 0) - p(1, 2),
                p(0, 2) + p(1, 1) - p(2, 0),
            ];
            (0..4).for_each(|i| q[i][order + 1] = rates[i] / (next + next));
        }
        let sum = |series: &Series| series.iter().rev().fold(number(0.0), |sum, term| sum * h + *term);
        self.momentum = std::array::from_fn(|i| sum(&l[i]));
        self.quaternion = std::array::from_fn(|i| sum(&q[i]));
    }

    /// The orientation, rounded.
    pub(crate) fn rotor(&self) -> Rotor<f64> {
        let [w, x, y, z] = self.quaternion.map(f64::from);
        Rotor::new(w, -x, -y, -z)
    }

    /// The angle from this orientation to another, rad.
    pub(crate) fn angle_to(&self, rotor: Rotor<f64>) -> f64 {
        let q = [rotor.s, -rotor.e23, -rotor.e31, -rotor.e12].map(number);
        let [w, x, y, z] = self.quaternion;
        let [_, x, y, z] = times([w, -x, -y, -z], q).map(f64::from);
        2.0 * (x * x + y * y + z * z).sqrt()
    }
}

fn times(a: [Number; 4], b: [Number; 4]) -> [Number; 4] {
    [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] + a[2] * b[0] + a[3] * b[1] - a[1] * b[3],
        a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1],
    ]
}

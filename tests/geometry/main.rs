//! Points, flats and rounds against answers that share nothing with the library: plain vector formulas, nalgebra, and
//! exact rationals on the inputs as rounded.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on should stop")]

mod conventions;
mod degenerate;
mod facets;
mod meets;
mod rounds;

use ga_physics::algebra::Real;
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::Vector;
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

/// SplitMix64.
struct Random(u64);

impl Random {
    /// Uniform in -1 .. 1.
    fn signed(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> [f64; 3] {
        [self.signed(), self.signed(), self.signed()]
    }

    fn direction(&mut self) -> [f64; 3] {
        loop {
            let v = self.vector();
            let norm = dot(v, v).sqrt();
            if norm > 0.1 && norm < 1.0 {
                return v.map(|x| x / norm);
            }
        }
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn scale(a: [f64; 3], k: f64) -> [f64; 3] {
    a.map(|x| x * k)
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// The scalars under test, and what is asked of them.
trait Tested: Real {
    /// The error allowed, relative to the size of the figure: 45 epsilons of f64, 84 of f32.
    const BOUND: f64;
}

impl Tested for f64 {
    const BOUND: f64 = 1e-14;
}

impl Tested for f32 {
    const BOUND: f64 = 1e-5;
}

fn point<T: Real>(p: [f64; 3]) -> Point<T> {
    Point::from(p.map(T::from_f64))
}

fn vector<T: Real>(v: [f64; 3]) -> Vector<T> {
    Vector::from(v.map(T::from_f64))
}

fn position<T: Real>(p: Point<T>) -> [f64; 3] {
    [p.x, p.y, p.z].map(Real::to_f64)
}

fn components<T: Real>(v: Vector<T>) -> [f64; 3] {
    [v.e1, v.e2, v.e3].map(Real::to_f64)
}

/// A vector of exact numbers.
#[derive(Clone, Debug)]
struct Exact([BigRational; 3]);

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap()
}

impl Exact {
    fn at<T: Real>(p: Point<T>) -> Self {
        Self(position(p).map(exact))
    }

    fn zip(&self, other: &Self, f: impl Fn(&BigRational, &BigRational) -> BigRational) -> Self {
        Self(std::array::from_fn(|i| f(&self.0[i], &other.0[i])))
    }

    fn minus(&self, other: &Self) -> Self {
        self.zip(other, |a, b| a - b)
    }

    fn plus(&self, other: &Self) -> Self {
        self.zip(other, |a, b| a + b)
    }

    fn times(&self, k: &BigRational) -> Self {
        Self(std::array::from_fn(|i| &self.0[i] * k))
    }

    fn dot(&self, other: &Self) -> BigRational {
        self.zip(other, |a, b| a * b).0.into_iter().fold(BigRational::zero(), |sum, x| sum + x)
    }

    fn cross(&self, other: &Self) -> Self {
        let term = |i: usize, j: usize| &self.0[i] * &other.0[j] - &self.0[j] * &other.0[i];
        Self([term(1, 2), term(2, 0), term(0, 1)])
    }

    fn rounded(&self) -> [f64; 3] {
        [0, 1, 2].map(|i| self.0[i].to_f64().unwrap())
    }

    fn length(&self) -> f64 {
        self.dot(self).to_f64().unwrap().sqrt()
    }
}

/// Distances from the origin, in sizes of the figure.
const DISTANCES: [f64; 4] = [1.0, 10.0, 1e3, 1e5];

/// A regular tetrahedron of edge 1 to 2.2 around the origin with corners shaken by a tenth, times a size, and moved.
fn tetrahedron<T: Real>(random: &mut Random, size: f64, distance: f64) -> [Point<T>; 4] {
    let to = scale(random.direction(), distance * size);
    [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(|corner| {
        let shaken = add(scale(corner, 0.577), scale(random.vector(), 0.1));
        point(add(to, scale(shaken, size)))
    })
}

/// Half a unit in the last place of a world coordinate at this distance, over three coordinates.
fn world_rounding<T: Real>(distance: f64) -> f64 {
    let half_ulp = T::EPSILON.to_f64() * 0.5;
    3f64.sqrt() * half_ulp * distance
}

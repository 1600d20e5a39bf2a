//! The inputs of the kernels: made before any clock starts, the same on every machine, each list from its own seed.
//!
//! Rivals outside of the library, in `benches/`, start from these lists too; all are well-conditioned.

use crate::algebra::cga::{ConformalRotor, Dilator, Even, Motor, Multivector, Plane, Point};
use crate::algebra::g3::{Rotor, Vector};

/// Inputs of each kernel: enough that no branch predictor learns them by heart.
pub const INPUTS: usize = 1024;

/// Two rotors, uniform over the rotations.
#[must_use]
pub fn rotor_pairs() -> Vec<(Rotor, Rotor)> {
    list(1, |random| (random.rotor(), random.rotor()))
}

/// A rotor and a vector of the cube [-1, 1)³.
#[must_use]
pub fn rotors_and_vectors() -> Vec<(Rotor, Vector)> {
    list(2, |random| (random.rotor(), random.vector()))
}

/// A pose, as translation and rotation, and a point.
#[must_use]
pub fn poses_and_points() -> Vec<((Vector, Rotor), Point)> {
    list(3, |random| (random.pose(), random.point()))
}

/// Two poses, each as translation and rotation.
#[must_use]
pub fn pose_pairs() -> Vec<[(Vector, Rotor); 2]> {
    list(4, |random| [random.pose(), random.pose()])
}

/// The corners of a regular tetrahedron, each shaken by up to a quarter of a coordinate: never nearly coplanar.
#[must_use]
pub fn tetrahedra() -> Vec<[Point; 4]> {
    list(5, Random::tetrahedron)
}

/// Three corners of [`tetrahedra`]: never nearly collinear.
#[must_use]
pub fn triangles() -> Vec<[Point; 3]> {
    list(6, |random| {
        let [a, b, c, _] = random.tetrahedron();
        [a, b, c]
    })
}

/// A plane, and two points of a line that meets it at more than 17 degrees.
#[must_use]
pub fn planes_and_lines() -> Vec<(Plane, [Point; 2])> {
    list(7, Random::plane_and_line)
}

/// Two balls, centre and radius; about half of the pairs overlap, and none is so near to touching that rounding to `f32`
/// could decide.
#[must_use]
pub fn ball_pairs() -> Vec<[(Point, f64); 2]> {
    list(8, Random::ball_pair)
}

/// Two general multivectors.
#[must_use]
pub fn multivector_pairs() -> Vec<(Multivector, Multivector)> {
    list(9, |random| (Multivector::from_fn(|_| random.number()), Multivector::from_fn(|_| random.number())))
}

/// Two even multivectors.
#[must_use]
pub fn even_pairs() -> Vec<(Even, Even)> {
    list(10, |random| (Even::from_fn(|_| random.number()), Even::from_fn(|_| random.number())))
}

/// Two conformal rotors: see [`conformals_and_points`].
#[must_use]
pub fn conformal_pairs() -> Vec<(ConformalRotor, ConformalRotor)> {
    list(11, |random| (random.conformal(), random.conformal()))
}

/// A conformal rotor, of a transversion, a motion and a scaling by 1/2 to 2, and a point that it does not take to infinity.
#[must_use]
pub fn conformals_and_points() -> Vec<(ConformalRotor, Point)> {
    list(12, |random| (random.conformal(), random.point()))
}

fn list<I>(seed: u64, mut make: impl FnMut(&mut Random) -> I) -> Vec<I> {
    let mut random = Random(seed);
    (0..INPUTS).map(|_| make(&mut random)).collect()
}

/// SplitMix64 (Steele, Lea and Flood 2014): the same inputs on every machine.
struct Random(u64);

impl Random {
    /// Uniform in [-1, 1).
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let bits = (z ^ (z >> 31)) >> 11;
        bits as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> Vector {
        Vector::from_fn(|_| self.number())
    }

    fn point(&mut self) -> Point {
        Point::from_fn(|_| self.number())
    }

    /// Uniform over the rotations: a direction in four dimensions, by rejection.
    fn rotor(&mut self) -> Rotor {
        loop {
            let [s, x, y, z]: [f64; 4] = std::array::from_fn(|_| self.number());
            let norm_sq = s * s + x * x + y * y + z * z;
            if (0.01..1.0).contains(&norm_sq) {
                let norm = norm_sq.sqrt();
                return Rotor::new(s / norm, x / norm, y / norm, z / norm);
            }
        }
    }

    fn pose(&mut self) -> (Vector, Rotor) {
        (self.vector(), self.rotor())
    }

    /// `K D T R`, with a transversion `K = 1 + b no` so weak that no point of the cube comes near infinity.
    fn conformal(&mut self) -> ConformalRotor {
        let (t, r) = self.pose();
        let root = f64::exp2(0.5 * self.number());
        let mut transversion = ConformalRotor::default();
        [transversion.v1, transversion.v2, transversion.v3] = std::array::from_fn(|_| 0.05 * self.number());
        transversion * (Dilator::new(root, 1.0 / root) * Motor::from_parts(t, r))
    }

    fn tetrahedron(&mut self) -> [Point; 4] {
        let centre: [f64; 3] = std::array::from_fn(|_| self.number());
        [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]]
            .map(|corner: [f64; 3]| Point::from_fn(|i| centre[i] + corner[i] + 0.25 * self.number()))
    }

    fn plane_and_line(&mut self) -> (Plane, [Point; 2]) {
        loop {
            let (n, d, start) = (self.vector(), self.vector(), self.point());
            let (n_length, d_length) = (n.norm_sq().sqrt(), d.norm_sq().sqrt());
            let usable = (0.1..1.0).contains(&n_length) && (0.1..1.0).contains(&d_length);
            if usable && (n | d).abs() > 0.3 * n_length * d_length {
                let end = Point::new(start.x + d.e1, start.y + d.e2, start.z + d.e3);
                let plane = Plane::new(n.e1 / n_length, n.e2 / n_length, n.e3 / n_length, self.number());
                return (plane, [start, end]);
            }
        }
    }

    fn ball_pair(&mut self) -> [(Point, f64); 2] {
        loop {
            let balls = [(self.point(), self.number()), (self.point(), self.number())];
            let [(a, r), (b, s)] = balls.map(|(centre, radius)| (centre, radius.abs()));
            let distance = (a.x - b.x).hypot(a.y - b.y).hypot(a.z - b.z);
            if (distance - (r + s)).abs() > 0.01 {
                return [(a, r), (b, s)];
            }
        }
    }
}

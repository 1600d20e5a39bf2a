//! The exact predicates, against integers: a million cases in which plain arithmetic goes wrong, and every sign is right.
//!
//! Coordinates are integers times a power of two, so that i128 (or BigInt, where digits are many) knows the sign. The same
//! formula in f64 is run beside: where it made no mistake, the cases would not test anything.
#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test may panic")]

use ga_physics::algebra::cga::{Infinity, Point};
use ga_physics::geometry::predicates::{Sign, insphere, orient3d};
use ga_physics::geometry::{Degenerate, plane_through, sphere_through};
use num_bigint::BigInt;
use num_traits::Num;

/// SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }
    /// An integer of up to so many bits, and sign.
    fn integer(&mut self, bits: u32) -> i64 {
        (self.next() >> (64 - bits)) as i64 - (1 << (bits - 1))
    }
    fn vector(&mut self, bits: u32) -> [i64; 3] {
        [0; 3].map(|_| self.integer(bits))
    }
    fn unit(&mut self) -> f64 {
        self.below(1 << 53) as f64 / (1u64 << 53) as f64
    }
}

/// `2^exponent`, subnormal ones included.
fn power(exponent: i32) -> f64 {
    let half = |e: i32| f64::from_bits(((1023 + e) as u64) << 52);
    half(exponent / 2) * half(exponent - exponent / 2)
}

/// `(b - a) x (c - a) . (d - a)`, in any arithmetic.
fn volume<T: Num + Clone>(points: [[T; 3]; 4]) -> T {
    let [a, rest @ ..] = points;
    let [u, v, w] = rest.map(|p| [0, 1, 2].map(|i| p[i].clone() - a[i].clone()));
    let minor = |i: usize, j: usize| u[i].clone() * v[j].clone() - u[j].clone() * v[i].clone();
    minor(1, 2) * w[0].clone() + minor(2, 0) * w[1].clone() + minor(0, 1) * w[2].clone()
}

/// Minus the determinant of `(x, y, z, x² + y² + z²)` of the differences to the first point, by pairs of rows.
fn in_sphere<T: Num + Clone>(points: [[T; 3]; 5]) -> T {
    let [a, rest @ ..] = points;
    let lifted = rest.map(|p| {
        let [x, y, z] = [0, 1, 2].map(|i| p[i].clone() - a[i].clone());
        let w = x.clone() * x.clone() + y.clone() * y.clone() + z.clone() * z.clone();
        [x, y, z, w]
    });
    let [b, c, d, e] = &lifted;
    let minor = |p: &[T; 4], q: &[T; 4], i: usize, j: usize| p[i].clone() * q[j].clone() - p[j].clone() * q[i].clone();
    let both = |i, j, k, l| minor(b, c, i, j) * minor(d, e, k, l);
    let positive = both(0, 1, 2, 3) + both(0, 3, 1, 2) + both(1, 2, 0, 3) + both(2, 3, 0, 1);
    both(0, 2, 1, 3) + both(1, 3, 0, 2) - positive
}

fn sign_of<T: Num + PartialOrd>(value: &T) -> Sign {
    match value.partial_cmp(&T::zero()) {
        Some(std::cmp::Ordering::Less) => Sign::Negative,
        Some(std::cmp::Ordering::Greater) => Sign::Positive,
        _ => Sign::Zero,
    }
}

/// Cases, and how many signs were wrong.
#[derive(Default, Debug)]
struct Tally {
    cases: usize,
    zero: usize,
    naive_wrong: usize,
    naive_opposite: usize,
    wrong: usize,
}

impl Tally {
    fn add(&mut self, found: Sign, naive: Sign, truth: Sign) {
        self.cases += 1;
        self.zero += usize::from(truth == Sign::Zero);
        self.naive_wrong += usize::from(naive != truth);
        self.naive_opposite += usize::from(naive == -truth && naive != truth);
        self.wrong += usize::from(found != truth);
    }

    /// Prints what it found, and fails on a wrong sign, or if the cases were too easy.
    fn report(&self, name: &str) {
        println!("{name}: {self:?}");
        assert_eq!(self.wrong, 0, "{name}: {self:?}");
        assert!(self.naive_wrong * 50 > self.cases, "{name}: cases in which nothing goes wrong test little: {self:?}");
    }
}

fn orient<T: Num + Clone + PartialOrd>(tally: &mut Tally, points: [[f64; 3]; 4], exact: [[T; 3]; 4]) {
    let [a, b, c, d] = points.map(Point::from);
    tally.add(orient3d(a, b, c, d).unwrap(), sign_of(&volume(points)), sign_of(&volume(exact)));
}

fn sphere<T: Num + Clone + PartialOrd>(tally: &mut Tally, points: [[f64; 3]; 5], exact: [[T; 3]; 5]) {
    let [a, b, c, d, e] = points.map(Point::from);
    tally.add(insphere(a, b, c, d, e).unwrap(), sign_of(&in_sphere(points)), sign_of(&in_sphere(exact)));
}

/// Integers times a power of two: exact, as the integers have less than 53 bits.
fn scaled<const N: usize>(points: [[i64; 3]; N], exponent: i32) -> [[f64; 3]; N] {
    let scale = power(exponent);
    points.map(|p| p.map(|x| x as f64 * scale))
}

fn wide<const N: usize>(points: [[i64; 3]; N]) -> [[i128; 3]; N] {
    points.map(|p| p.map(i128::from))
}

/// Multiples of 2^-1074.
fn big<const N: usize>(points: [[f64; 3]; N]) -> [[BigInt; 3]; N] {
    points.map(|p| {
        p.map(|x| {
            let bits = x.to_bits();
            let (exponent, fraction) = (bits >> 52 & 0x7ff, bits & ((1 << 52) - 1));
            let magnitude = if exponent == 0 {
                BigInt::from(fraction)
            } else {
                BigInt::from(fraction + (1 << 52)) << (exponent - 1)
            };
            if x < 0.0 { -magnitude } else { magnitude }
        })
    })
}

/// Points of a plane, rounded to the grid; one in four exactly on it.
fn coplanar(random: &mut Random) -> [[i64; 3]; 4] {
    if random.below(4) == 0 {
        let [a, u, v] = [36, 36, 36].map(|bits| random.vector(bits));
        let [i, j, k, l] = [0; 4].map(|_| random.integer(3));
        let on = |i: i64, j: i64| [0, 1, 2].map(|axis| a[axis] + i * u[axis] + j * v[axis]);
        return [a, on(i, j), on(k, l), on(k - i, l - j)];
    }
    let [a, b, mut c] = [40, 40, 40].map(|bits| random.vector(bits));
    // Fractions of 2^-21, so that products stay within i128, and the point within one of the grid.
    let between = |p: [i64; 3], q: [i64; 3], s: i64| {
        let part = |axis: usize| (i128::from(q[axis] - p[axis]) * i128::from(s)) >> 21;
        [0, 1, 2].map(|axis| p[axis] + part(axis) as i64)
    };
    if random.below(2) == 0 {
        // On one line as well, so that no minor is large.
        c = between(a, b, random.integer(21));
    }
    let e = between(a, b, random.integer(21));
    [a, b, c, between(e, c, random.integer(21))]
}

/// Points on a sphere about a point of the grid: signed permutations of one vector, the last moved by at most one step.
fn cospherical(random: &mut Random) -> [[i64; 3]; 5] {
    let (centre, v) = (random.vector(20), random.vector(20));
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let mut points = [[0; 3]; 5].map(|_| {
        let (order, signs) = (orders[random.below(6) as usize], random.next());
        [0, 1, 2].map(|axis| centre[axis] + if signs >> axis & 1 == 0 { v[order[axis]] } else { -v[order[axis]] })
    });
    if random.below(2) == 0 {
        points[4][random.below(3) as usize] += random.below(3) as i64 - 1;
    }
    points
}

#[test]
fn orient3d_is_right_on_grids_near_a_plane() {
    let (mut tally, mut random) = (Tally::default(), Random(1));
    for case in 0..800_000 {
        let points = coplanar(&mut random);
        orient(&mut tally, scaled(points, [0, -40, 60, -200][case % 4]), wide(points));
    }
    tally.report("orient3d, grids");
}

#[test]
fn insphere_is_right_on_grids_near_a_sphere() {
    let (mut tally, mut random) = (Tally::default(), Random(2));
    for case in 0..100_000 {
        let points = cospherical(&mut random);
        sphere(&mut tally, scaled(points, [0, -22, 100, -60][case % 4]), wide(points));
    }
    tally.report("insphere, grids");
}

/// 1e-160 and 1e160 with their neighbours, subnormal numbers, the largest numbers: products over- and underflow.
#[test]
fn signs_are_right_where_products_leave_the_range() {
    let (mut planes, mut spheres, mut random) = (Tally::default(), Tally::default(), Random(3));
    for case in 0..40_000 {
        let exponent = [-1074, -1030, -700, -571, -360, -300, 280, 330, 491, 700, 983][case % 11];
        let points = coplanar(&mut random);
        orient(&mut planes, scaled(points, exponent), wide(points));
        if case % 2 == 0 {
            let exponent = [-1074, -1000, -553, -300, -158, 171, 180, 220, 509, 800, 1001][case / 2 % 11];
            let points = cospherical(&mut random);
            sphere(&mut spheres, scaled(points, exponent), wide(points));
        }
    }
    planes.report("orient3d, extremes");
    spheres.report("insphere, extremes");
}

/// Kettner et al., *Classroom examples of robustness problems in geometric computations*, 2008: points an ulp apart near
/// a line, here in an oblique plane.
#[test]
fn orient3d_is_right_on_every_ulp_near_a_point_of_the_plane() {
    let mut tally = Tally::default();
    let ulp = f64::EPSILON / 2.0;
    for third in [[-3.1, 7.3, 0.1], [8.8, 8.8, 17.3], [0.5, 0.5, 1e3], [12.0, 12.0, 12.1]] {
        for (i, j) in (0..64).flat_map(|i| (0..64).map(move |j| (i, j))) {
            let d = [0.5 + f64::from(i) * ulp, 0.5 + f64::from(j) * ulp, 0.5];
            let points = [[12.0; 3], [24.0; 3], third, d];
            orient(&mut tally, points, big(points));
        }
    }
    tally.report("orient3d, ulps");
}

/// Directions times a radius, rounded to f64: near the sphere by ulps, with all 53 bits in use.
#[test]
fn insphere_is_right_on_points_rounded_to_a_sphere() {
    let (mut tally, mut random) = (Tally::default(), Random(4));
    for case in 0..30_000 {
        let centre = [0; 3].map(|_| random.unit() * [0.0, 1.0, 1e3][case % 3]);
        // From the whole sphere, or from a cap of it, where the tetrahedron is thin as well.
        let cap = [1.0, 1e-3][case / 3 % 2];
        let points = [(); 5].map(|()| {
            let v = [1.0, cap * (random.unit() - 0.5), cap * (random.unit() - 0.5)];
            let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            [0, 1, 2].map(|axis| centre[axis] + v[axis] / norm)
        });
        sphere(&mut tally, points, big(points));
    }
    tally.report("insphere, ulps");
}

/// Coordinates of any size side by side.
#[test]
fn signs_are_right_for_coordinates_of_any_exponent() {
    let (mut planes, mut spheres, mut random) = (Tally::default(), Tally::default(), Random(5));
    for _ in 0..3_000 {
        let mut any = || loop {
            let x = f64::from_bits(random.next());
            if x.is_finite() {
                return if x.to_bits() & 7 == 0 { 0.0 } else { x };
            }
        };
        // Four in one plane through the z axis, but for one coordinate; four on a circle, but for one, and a fifth.
        let [x, y, dust] = [any(), any(), any()];
        let flat = [[x, x, any()], [y, y, any()], [0.0, dust, any()], [0.0, 0.0, any()]];
        orient(&mut planes, flat, big(flat));
        let round = [[x, y, 0.0], [-y, x, 0.0], [-x, -y, 0.0], [y, -x, dust], [any(), any(), any()]];
        sphere(&mut spheres, round, big(round));
    }
    planes.report("orient3d, exponents");
    spheres.report("insphere, exponents");
}

/// What the predicates replace, and what they stand on, at 1e-160.
#[test]
fn underflow_is_no_zero() {
    for size in [1e-160, 1e160, 1e-307, f64::MIN_POSITIVE, 5e-324, 4e307] {
        let [o, x, y, z] = [[0.0; 3], [size, 0.0, 0.0], [0.0, size, 0.0], [0.0, 0.0, size]].map(Point::from);
        assert_eq!(orient3d(o, x, y, z), Ok(Sign::Positive), "{size:e}");
        assert_eq!(insphere(o, x, y, z, Point::new(size, size, size)), Ok(Sign::Zero), "{size:e}");
        assert_eq!(insphere(o, x, y, z, Point::new(size, size, 2.0 * size)), Ok(Sign::Negative), "{size:e}");
        if size > 5e-324 {
            assert_eq!(insphere(o, x, y, z, Point::new(size, size, 0.5 * size)), Ok(Sign::Positive), "{size:e}");
        }
        let robust = [o, x, y, z].map(|p| robust::Coord3D { x: p.x, y: p.y, z: p.z });
        let bare = robust::orient3d(robust[0], robust[1], robust[2], robust[3]);
        assert!(!(bare < 0.0 && bare.is_finite()), "expansions alone do not decide this: {bare} at {size:e}");
    }
}

#[test]
fn signs_are_those_of_the_algebra() {
    let mut random = Random(6);
    for _ in 0..2_000 {
        let integers = [[(); 3]; 5].map(|p| p.map(|()| random.below(9) as i32 - 4));
        let [a, b, c, d, e] = integers.map(|p| Point::from(p.map(f64::from)));
        // Products of integers this small are exact in f64.
        let found = insphere(a, b, c, d, e).unwrap();
        assert_eq!(found, sign_of(&(e | (a ^ b ^ c ^ d).dual())), "{integers:?}");
        let side = orient3d(a, b, c, d).unwrap();
        assert_eq!(side, sign_of(&(d | (a ^ b ^ c ^ Infinity).dual())), "{integers:?}");
        // Any swap turns the sign.
        assert_eq!(orient3d(b, a, c, d).unwrap(), -side);
        assert_eq!(orient3d(a, b, d, c).unwrap(), -side);
        assert_eq!(insphere(a, b, c, e, d).unwrap(), -found);
        // The constructions agree, where they are sure.
        if let (Ok(plane), false) = (plane_through(a, b, c), side == Sign::Zero) {
            assert_eq!((d | plane) > 0.0, side == Sign::Positive);
        }
        if let Ok(sphere) = sphere_through(a, b, c, d)
            && found != Sign::Zero
        {
            assert_eq!((e | sphere) > 0.0, found == side, "positive inside, for positively oriented points");
        }
    }
}

#[test]
fn what_is_no_number_has_no_side() {
    let good = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1e200]];
    for (index, axis) in (0..5).flat_map(|index| (0..3).map(move |axis| (index, axis))) {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut points = good;
            points[index][axis] = bad;
            let [a, b, c, d, e] = points.map(Point::from);
            assert_eq!(insphere(a, b, c, d, e), Err(Degenerate::NotFinite));
            if index < 4 {
                assert_eq!(orient3d(a, b, c, d), Err(Degenerate::NotFinite));
            }
        }
    }
}

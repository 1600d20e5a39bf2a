//! The sums over facets in f64, two facets at a time, with a bound on the error of what they give.
//!
//! With `e = b - a` and `f = c - a` taken from the given coordinates, `a`, `b`, `c` from a point near the mesh, and
//!
//! ```text
//! n = e x f      d = a . n      p = a + b,  r = b + c,  t = c + a
//! s = a + b + c                 q_ij = p_i p_j + r_i r_j + t_i t_j  ( = a_i a_j + b_i b_j + c_i c_j + s_i s_j )
//! ```
//!
//! the sums are those of the module: d, d s, d q. Differences first: `d` from the coordinates themselves would lose
//! (distance / side)² of it, from the sides it loses nothing but roundings of its own terms.
//!
//! **The bound**, to first order in the unit u = 2^-53. A product of sides has 3 roundings, their difference 1, `a` 1,
//! the product with it 1, the sum of three 2: the error of `d` is at most u (3 P + 5 D), with
//! `P = sum |a_i| (|e_j f_k| + |e_k f_j|)` and `D = sum |a_i n_i|`. Since `q_ii >= a_i² + b_i² + c_i²`, that of `q_ij` is at
//! most 9 u sqrt(q_ii q_jj) (4 from the shift, 2 from the sums p, r, t, 3 from products and sums), that of `s_i` at most
//! 4 u sqrt(q_ii). The product with `d` adds 1, the sum over a block [`BLOCK`]/2 more at most; blocks are summed without loss that
//! counts here. So a facet's terms 1, s, q have errors of at most u mu (1, sqrt q_ii, sqrt(q_ii q_jj)) with
//!
//! ```text
//! mu = 3 P + 5 D + 18 |d|
//! ```
//!
//! and by Cauchy and Schwarz two sums, `M = sum mu` and `T = sum mu (q_xx + q_yy + q_zz)`, bound everything.
//!
//! Source: Higham, *Accuracy and stability of numerical algorithms*, 2002, chapter 3 (running error analysis).

use super::{Integrals, SMALLEST_FINE_MESH};
use crate::algebra::cga::Point;
use crate::geometry::double_double::DoubleDouble;
use crate::geometry::mesh::Mesh;
use wide::f64x2;

/// Facets whose terms are added plainly: 7 roundings in each of two lanes, and room for one more. With 32 the sums take a
/// twentieth less time, and the bound asks for careful ones on more meshes.
const BLOCK: usize = 16;

/// What is promised, short of the last roundings: two units of the result each.
const BOUND: f64 = 1e-14 - f64::EPSILON;

/// u, and one per cent for its squares and for the roundings of the bound itself.
const UNIT: f64 = 1.01 * 0.5 * f64::EPSILON;

/// The largest share of a diagonal entry of the inertia that its error may be: the moment of a long rod about itself is a
/// small part of the largest, and a body spins about it all the same.
const LEAST_MOMENT_BOUND: f64 = 1e-11;

/// How far from its middle a mesh may reach (m), root mean square: far within the range in which no term over- or
/// underflows. What is beyond is left to the careful sums, which know their limits.
const SPREAD_M: core::ops::RangeInclusive<f64> = 1e-40..=1e40;

/// Facets that are asked for a point near the mesh. Any will do, for the bound is not taken on trust.
const SAMPLE: usize = 64;

/// A number for each of two facets, and a vector for each.
type Pair = f64x2;
type Pairs = [Pair; 3];

/// d, d s, d q (xx, yy, zz, yz, zx, xy), mu, mu (q_xx + q_yy + q_zz).
const SUMS: usize = 12;

/// The sums over some facets, if they are sure to be good enough.
pub(super) fn integrals(mesh: &Mesh, triangles: &[[u32; 3]]) -> Option<Integrals> {
    if triangles.len() < SMALLEST_FINE_MESH {
        return None;
    }
    let origin = middle(mesh, triangles);
    let shift = origin.map(Pair::splat);
    let mut totals = [Total::default(); SUMS];
    for block in triangles.chunks(BLOCK) {
        for (total, sum) in totals.iter_mut().zip(block_sums(mesh, block, shift)) {
            total.add(sum);
        }
    }
    let [volume_6, fx, fy, fz, xx, yy, zz, yz, zx, xy, mu, mu_q] = totals.map(|total| total.value());
    let sums = Integrals {
        origin,
        volume_6,
        first_24: [fx, fy, fz],
        second_120: [xx, yy, zz, yz, zx, xy],
        volume_6_error: UNIT * mu.hi,
    };
    is_good(&sums, mu_q.hi).then_some(sums)
}

/// A sum of blocks and, beside it, the sum of what its roundings lost (Knuth, TAOCP 2, 4.2.2).
#[derive(Clone, Copy, Default)]
struct Total {
    sum: Pair,
    lost: Pair,
}

impl Total {
    #[inline(always)]
    fn add(&mut self, block: Pair) {
        let sum = self.sum + block;
        let added = sum - self.sum;
        self.lost += (self.sum - (sum - added)) + (block - added);
        self.sum = sum;
    }

    /// Both lanes together.
    fn value(self) -> DoubleDouble {
        let ([even, odd], [lost_even, lost_odd]) = (self.sum.to_array(), self.lost.to_array());
        DoubleDouble::sum(even, odd) + DoubleDouble::sum(lost_even, lost_odd)
    }
}

/// The sums over a block.
#[inline(always)]
fn block_sums(mesh: &Mesh, block: &[[u32; 3]], shift: Pairs) -> [Pair; SUMS] {
    let mut sums = [Pair::ZERO; SUMS];
    for pair in block.chunks(2) {
        let first = mesh.corners(pair[0]);
        // An odd one stands beside a facet of no size, which adds nothing.
        let second = pair.get(1).map_or([first[0]; 3], |&other| mesh.corners(other));
        add(&mut sums, first, second, shift);
    }
    sums
}

/// Adds the terms of two facets.
#[inline(always)]
fn add(sums: &mut [Pair; SUMS], first: [Point<f64>; 3], second: [Point<f64>; 3], shift: Pairs) {
    let corner = |k: usize| {
        let (p, q) = (first[k], second[k]);
        [Pair::new([p.x, q.x]), Pair::new([p.y, q.y]), Pair::new([p.z, q.z])]
    };
    let [a, b, c] = [corner(0), corner(1), corner(2)];
    let (e, f) = (minus(b, a), minus(c, a));
    let [a, b, c] = [minus(a, shift), minus(b, shift), minus(c, shift)];
    let minors = [(1, 2), (2, 0), (0, 1)].map(|(j, k)| (e[j] * f[k], e[k] * f[j]));
    let terms = [0, 1, 2].map(|i| a[i] * (minors[i].0 - minors[i].1));
    let sizes = [0, 1, 2].map(|i| a[i].abs() * (minors[i].0.abs() + minors[i].1.abs()));
    let d = terms[0] + terms[1] + terms[2];
    let dot = terms[0].abs() + terms[1].abs() + terms[2].abs();
    let cross = sizes[0] + sizes[1] + sizes[2];
    let mu = Pair::splat(3.0) * cross + Pair::splat(5.0) * dot + Pair::splat(18.0) * d.abs();
    let (p, r, t) = (plus(a, b), plus(b, c), plus(c, a));
    let s = plus(p, c);
    let q = |i: usize, j: usize| p[i] * p[j] + r[i] * r[j] + t[i] * t[j];
    let (xx, yy, zz) = (q(0, 0), q(1, 1), q(2, 2));
    sums[0] += d;
    for i in 0..3 {
        sums[1 + i] += d * s[i];
    }
    sums[4] += d * xx;
    sums[5] += d * yy;
    sums[6] += d * zz;
    sums[7] += d * q(1, 2);
    sums[8] += d * q(2, 0);
    sums[9] += d * q(0, 1);
    sums[10] += mu;
    sums[11] += mu * (xx + yy + zz);
}

#[inline(always)]
fn plus(a: Pairs, b: Pairs) -> Pairs {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
fn minus(a: Pairs, b: Pairs) -> Pairs {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Whether volume, centre and inertia are sure to be within [`BOUND`]: of themselves, of the mesh's size, of the largest
/// entry; and the least of the moments on the diagonal within [`LEAST_MOMENT_BOUND`] of itself. With the sums V, F, S as stored, c = F/4V and C = S/120 - F F/96V have errors of at most
///
/// ```text
/// u (sqrt(M T)/4V + |c| M/V)         u (T/120 + 2 |F| sqrt(M T)/96V + |F|² M/96V²)
/// ```
///
/// the latter for the trace of C, and so for each entry of the inertia; the largest of these is a moment, trace less an entry
/// of C.
fn is_good(sums: &Integrals, mu_q: f64) -> bool {
    let volume = sums.volume_6.hi.abs();
    let (v_error, s_error) = (sums.volume_6_error, UNIT * mu_q);
    // Between the two: sqrt of each, for the product may leave the range.
    let f_error = libm::sqrt(v_error) * libm::sqrt(s_error);
    let first_sq: f64 = sums.first_24.iter().map(|f| f.hi * f.hi).sum();
    let first = libm::sqrt(first_sq);
    let central = [0, 1, 2].map(|i| {
        let (second, first) = (sums.second_120[i].hi, sums.first_24[i].hi);
        second / 120.0 - first * (first / (96.0 * volume))
    });
    let trace = central[0] + central[1] + central[2];
    let least_moment = trace - central.into_iter().fold(f64::MIN, f64::max);
    let largest_moment = trace - central.into_iter().fold(f64::MAX, f64::min);
    let trace_error = s_error / 120.0
        + 2.0 * first * f_error / (96.0 * volume)
        + (first / volume) * (first / volume) * v_error / 96.0;
    // q is at most 12 times the square of the largest distance, so this is no more than the size.
    let spread = libm::sqrt(s_error / (12.0 * v_error));
    let centre_error = f_error / (4.0 * volume) + 0.25 * (first / volume) * (v_error / volume);
    // Comparisons with what is no number are false.
    SPREAD_M.contains(&spread)
        && v_error <= BOUND * volume
        && centre_error <= BOUND * spread
        && trace_error <= BOUND * largest_moment
        && trace_error <= LEAST_MOMENT_BOUND * least_moment
}

/// A point amid some of the facets.
fn middle(mesh: &Mesh, triangles: &[[u32; 3]]) -> [f64; 3] {
    let step = triangles.len() / SAMPLE + 1;
    let (mut sum, mut n) = ([0.0; 3], 0.0);
    for &[i, ..] in triangles.iter().step_by(step) {
        let p = mesh.vertices[i as usize];
        sum = [sum[0] + p.x, sum[1] + p.y, sum[2] + p.z];
        n += 1.0;
    }
    sum.map(|x| x / n)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An octagonal spindle of 20 rings, scaled along the axes and moved.
    fn spindle(scale: [f64; 3], by: f64) -> Option<Mesh> {
        let ring = |k: u32| f64::from(k * (20 - k)) / 100.0;
        let turn = |j: u32| libm::sincos(f64::from(j) * core::f64::consts::FRAC_PI_4);
        let vertices = (0..=20).flat_map(|k| (0..8).map(move |j| (k, j))).map(|(k, j)| {
            let (s, c) = turn(j);
            Point::new(ring(k) * c * scale[0] + by, ring(k) * s * scale[1] - by, f64::from(k) / 10.0 * scale[2] + by)
        });
        let at = |k: u32, j: u32| 8 * k + j % 8;
        let quads = (0..20).flat_map(|k| (0..8).map(move |j| (k, j)));
        let triangles = quads.flat_map(|(k, j)| {
            [[at(k, j), at(k, j + 1), at(k + 1, j + 1)], [at(k, j), at(k + 1, j + 1), at(k + 1, j)]]
        });
        Mesh::new(vertices.collect(), triangles.collect()).ok()
    }

    /// The promise rests on this choice: fat solids are sure in f64 wherever they are, thin ones are not.
    #[test]
    fn fat_solids_take_the_fast_way_and_thin_ones_do_not() {
        for (scale, by, fast) in [
            ([1.0, 1.0, 1.0], 0.0, true),
            ([1.0, 0.5, 2.0], 1e4, true),
            ([1e-30, 1e-30, 1e-30], 1e-27, true),
            ([1.0, 1.0, 1e-9], 0.0, true),
            ([1e-6, 1e-6, 1.0], 0.0, false),
            ([1e60, 1e60, 1e60], 0.0, false),
            ([1e-60, 1e-60, 1e-60], 0.0, false),
        ] {
            let found = spindle(scale, by).map(|mesh| integrals(&mesh, &mesh.triangles).is_some());
            assert_eq!(found, Some(fast), "{scale:?} at {by}");
        }
    }
}

//! The smallest sphere that encloses a set of points, with a proof that it is the smallest.
//!
//! Farthest-point pivoting (Gärtner, *Fast and robust smallest enclosing balls*, 1999): keep a support of at most four
//! points and their smallest ball, find the point furthest outside, and replace the support by that of the smallest ball
//! of support and point together. The balls grow, so it ends; some ten passes over the points are usual.
//!
//! The report searches all two-point balls, then all three-point, then all four-point ones, and stops at the first class
//! with a ball that encloses everything. That is not the smallest: the great circle ball of an obtuse triangle may enclose
//! all and be far too large. Here a candidate is taken only if its own lower bound proves it the smallest.
//!
//! All arithmetic is relative to the first point, the three primitives' relative to their own first point, so that the
//! distance from the origin costs nothing but the rounding of the returned centre.

use alloc::vec::Vec;

use super::formulas;
use crate::algebra::cga::{Point, Round};
use nalgebra::Vector3;

/// A ball: all points within `radius` of `centre`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Centre (m).
    pub centre: Point<f64>,
    /// Radius (m), not negative.
    pub radius: f64,
}

/// The smallest enclosing ball and its certificate.
///
/// `ball.radius` is the largest distance of a point from the returned, rounded centre, so the ball encloses all points to
/// within two roundings (a relative 4.4e-16). No enclosing ball is smaller than `radius_bound`: for any weights w >= 0 of
/// sum 1 on points p with mean m = sum w p, the squared radius of a ball that encloses them is at least sum w |p - m|².
#[derive(Clone, Debug, PartialEq)]
pub struct EnclosingSphere {
    /// The ball.
    pub ball: Ball,
    /// Indices of the points that hold the ball, one to four.
    pub support: Vec<usize>,
    /// The weights of the support points in the centre: not negative, of sum 1. The centre lies in their convex hull.
    pub weights: Vec<f64>,
    /// A radius that no enclosing ball is below (m), to within rounding.
    pub radius_bound: f64,
}

/// Why there is no enclosing sphere.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EnclosingSphereError {
    /// There are no points.
    #[error("no points to enclose: give at least one")]
    NoPoints,
    /// A coordinate is infinite or not a number.
    #[error("point {index} (counted from 0) is ({:?}, {:?}, {:?}): coordinates must be finite numbers", point.x, point.y, point.z)]
    NotFinite {
        /// Position in the list.
        index: usize,
        /// The point.
        point: Point<f64>,
    },
    /// The points are too far apart, or too near, for their squared distances to be held in f64.
    #[error("the points are {extent:?} m apart; between 1e-50 m and 1e50 m is supported: change the unit")]
    OutOfRange {
        /// The largest difference of a coordinate from the first point's (m).
        extent: f64,
    },
}

/// Extents (m) whose fifth powers, which circumcentres are made of, neither overflow nor underflow.
const EXTENT_M: core::ops::RangeInclusive<f64> = 1e-50..=1e50;

/// Share of a radius that is rounding in a defect: the two distances that it compares and the offset carry about five
/// roundings of 1.1e-16 each.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Passes without progress after which the best ball so far is taken. Growth of a ball may be second order in the
/// overshoot that causes it, thus invisible for a few passes; a cycle among roundings never shows progress.
const STALLED_PASSES: usize = 24;

/// The smallest enclosing ball of `points`.
///
/// Expected O(n) with about ten passes. Duplicates, collinear, coplanar and cospherical points are no special case.
///
/// # Errors
/// [`EnclosingSphereError`]: no points, a number that is not finite, an extent out of range.
pub fn enclosing_sphere(points: &[Point<f64>]) -> Result<EnclosingSphere, EnclosingSphereError> {
    let cloud = Cloud::new(points)?;
    let (first, _) = cloud.farthest(Vector3::zeros());
    let (second, _) = cloud.farthest(cloud.local(first));
    if cloud.local(first) == cloud.local(second) {
        let ball = Ball { centre: points[first], radius: 0.0 };
        return Ok(EnclosingSphere { ball, support: alloc::vec![first], weights: alloc::vec![1.0], radius_bound: 0.0 });
    }
    let mut candidate = cloud.smallest_ball(&[first], second);
    let (mut best, mut least_defect) = (candidate.clone(), f64::INFINITY);
    let (mut largest_bound, mut stalled) = (0.0, 0);
    while stalled < STALLED_PASSES {
        let (farthest, reach_sq) = cloud.farthest(candidate.centre);
        let defect = candidate.defect(reach_sq);
        stalled += 1;
        if candidate.bound_sq() > largest_bound {
            (largest_bound, stalled) = (candidate.bound_sq(), 0);
        }
        if defect < least_defect {
            (best, least_defect, stalled) = (candidate.clone(), defect, 0);
        }
        if defect <= ROUNDING * libm::sqrt(reach_sq) || candidate.support.contains(&farthest) {
            break;
        }
        candidate = cloud.smallest_ball(&candidate.support, farthest);
    }
    Ok(cloud.returned(best))
}

/// The points, seen from the first of them.
struct Cloud<'a> {
    points: &'a [Point<f64>],
    origin: Point<f64>,
}

/// A ball by its support, in the local frame, with its proof.
#[derive(Clone, Debug, Default)]
struct Candidate {
    support: Vec<usize>,
    weights: Vec<f64>,
    centre: Vector3<f64>,
    /// Weighted mean of the squared distances of the support from the centre.
    rho_sq: f64,
    /// Distance of the centre from the weighted mean of the support: zero where it lies in their hull.
    offset: f64,
}

impl Candidate {
    /// No ball that encloses the support has a smaller squared radius: the weighted mean of the squared distances from
    /// the mean itself.
    fn bound_sq(&self) -> f64 {
        self.rho_sq - self.offset * self.offset
    }

    /// How far this is from the smallest ball of points that reach so far from its centre: zero if it is that ball.
    ///
    /// The difference of the squared bounds would do too, but is of second order in the place of the centre: it vanishes
    /// in roundings where the centre is still 1e-8 off.
    fn defect(&self, reach_sq: f64) -> f64 {
        libm::sqrt(reach_sq) - libm::sqrt(self.rho_sq) + self.offset
    }
}

impl<'a> Cloud<'a> {
    fn new(points: &'a [Point<f64>]) -> Result<Self, EnclosingSphereError> {
        let &origin = points.first().ok_or(EnclosingSphereError::NoPoints)?;
        let finite = |p: &Point<f64>| p.x.is_finite() && p.y.is_finite() && p.z.is_finite();
        if let Some((index, &point)) = points.iter().enumerate().find(|(_, p)| !finite(p)) {
            return Err(EnclosingSphereError::NotFinite { index, point });
        }
        let cloud = Self { points, origin };
        let extent = points.iter().map(|&p| difference(p, origin).amax()).fold(0.0, f64::max);
        if extent > 0.0 && !EXTENT_M.contains(&extent) {
            return Err(EnclosingSphereError::OutOfRange { extent });
        }
        Ok(cloud)
    }

    fn local(&self, index: usize) -> Vector3<f64> {
        difference(self.points[index], self.origin)
    }

    /// The point farthest from `centre`, the first of equals, and its squared distance.
    fn farthest(&self, centre: Vector3<f64>) -> (usize, f64) {
        let mut farthest = (0, f64::NEG_INFINITY);
        for (index, &p) in self.points.iter().enumerate() {
            let distance_sq = (difference(p, self.origin) - centre).norm_squared();
            if distance_sq > farthest.1 {
                farthest = (index, distance_sq);
            }
        }
        farthest
    }

    /// The smallest ball of a support of at most four points and one point outside their ball.
    ///
    /// The new point is on its surface, so the candidates are the balls of it with each subset of up to three others. The
    /// smallest is the one that reaches all these points and has its centre in the hull of its support, so the candidate
    /// with the least defect is taken; an ill-conditioned one has a defect. Of equals the one with fewer points is kept.
    fn smallest_ball(&self, support: &[usize], outside: usize) -> Candidate {
        let (mut best, mut least_defect) = (Candidate::default(), f64::INFINITY);
        for size in 1..=support.len().min(3) {
            for subset in (1u32..1 << support.len()).filter(|s| s.count_ones() as usize == size) {
                let chosen = (0..support.len()).filter(|i| subset >> i & 1 == 1).map(|i| support[i]);
                let chosen: Vec<usize> = core::iter::once(outside).chain(chosen).collect();
                let Some(candidate) = self.candidate(&chosen) else {
                    continue;
                };
                let distance_sq = |&i: &usize| (self.local(i) - candidate.centre).norm_squared();
                let reach_sq = support.iter().chain([&outside]).map(distance_sq).fold(0.0, f64::max);
                let defect = candidate.defect(reach_sq);
                if defect < least_defect - ROUNDING * libm::sqrt(reach_sq) {
                    (best, least_defect) = (candidate, defect);
                }
            }
        }
        best
    }

    /// The smallest ball with these points on its surface, if they are in general position, and what it proves. It is
    /// formed in the frame of each of the points in turn, and the one with the least defect is kept: which frame loses
    /// the fewest digits depends on how the points lie.
    fn candidate(&self, support: &[usize]) -> Option<Candidate> {
        let frames = 0..support.len();
        let formed = frames.filter_map(|first| {
            let candidate = self.candidate_in_first_frame([&support[first..], &support[..first]].concat())?;
            let distances = support.iter().map(|&i| (self.local(i) - candidate.centre).norm_squared());
            let reach_sq = distances.fold(0.0, f64::max);
            Some((candidate.defect(reach_sq), candidate))
        });
        formed.reduce(|best, next| if next.0 < best.0 { next } else { best }).map(|(_, candidate)| candidate)
    }

    fn candidate_in_first_frame(&self, support: Vec<usize>) -> Option<Candidate> {
        let centre = self.circumcentre(&support)?;
        let spokes: Vec<Vector3<f64>> = support.iter().map(|&i| self.local(i) - centre).collect();
        let weights = hull_weights(&spokes);
        let weighted = || spokes.iter().zip(&weights);
        let rho_sq: f64 = weighted().map(|(p, &w)| p.norm_squared() * w).sum();
        let offset = weighted().map(|(p, &w)| p * w).sum::<Vector3<f64>>().norm();
        (rho_sq.is_finite() && offset.is_finite()).then_some(Candidate { support, weights, centre, rho_sq, offset })
    }

    /// The centre of the smallest ball with two to four points on its surface, if they are in general position.
    fn circumcentre(&self, chosen: &[usize]) -> Option<Vector3<f64>> {
        let (&first, others) = chosen.split_first()?;
        let relative = |i: usize| {
            let v = self.local(i) - self.local(first);
            Point { x: v.x, y: v.y, z: v.z }
        };
        let round = match *others {
            [b] => round_of_two(relative(b)),
            [b, c] => round_of_three(relative(b), relative(c)),
            [b, c, d] => round_of_four(relative(b), relative(c), relative(d)),
            _ => return None,
        };
        let centre = self.local(first) + Vector3::new(round.centre.x, round.centre.y, round.centre.z);
        (round.rho_sq.is_finite() && centre.iter().all(|x| x.is_finite())).then_some(centre)
    }

    /// The ball in the frame of the points. Its centre is rounded there, so the radius is measured again.
    fn returned(&self, best: Candidate) -> EnclosingSphere {
        let (o, c) = (self.origin, best.centre);
        let centre = Point { x: o.x + c.x, y: o.y + c.y, z: o.z + c.z };
        let bound_sq = best.bound_sq().max(0.0);
        let reach_sq = self.points.iter().map(|&p| difference(p, centre).norm_squared()).fold(0.0, f64::max);
        let ball = Ball { centre, radius: libm::sqrt(reach_sq) };
        EnclosingSphere { ball, support: best.support, weights: best.weights, radius_bound: libm::sqrt(bound_sq) }
    }
}

fn difference(p: Point<f64>, q: Point<f64>) -> Vector3<f64> {
    Vector3::new(p.x - q.x, p.y - q.y, p.z - q.z)
}

/// Barycentric coordinates of the origin in two to four points, negative ones cut off, of sum 1.
fn hull_weights(points: &[Vector3<f64>]) -> Vec<f64> {
    let Some((first, others)) = points.split_first() else {
        return Vec::new();
    };
    let target = -first;
    let edges: Vec<Vector3<f64>> = others.iter().map(|p| p - first).collect();
    let others = match *edges.as_slice() {
        [u] => alloc::vec![target.dot(&u) / u.norm_squared()],
        [u, v] => {
            let n = u.cross(&v);
            alloc::vec![target.cross(&v).dot(&n) / n.norm_squared(), u.cross(&target).dot(&n) / n.norm_squared()]
        }
        [u, v, w] => {
            let volume = u.dot(&v.cross(&w));
            alloc::vec![
                target.dot(&v.cross(&w)) / volume,
                u.dot(&target.cross(&w)) / volume,
                u.dot(&v.cross(&target)) / volume
            ]
        }
        _ => Vec::new(),
    };
    let mut weights = alloc::vec![1.0 - others.iter().sum::<f64>()];
    weights.extend(others);
    weights.iter_mut().for_each(|w| *w = w.max(0.0));
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|w| w / sum).collect()
}

// The primitives: straight-line, unchecked. A degenerate set divides by zero and gives a centre that is not finite.

/// A sphere by its centre and squared radius, relative to the first of the points it passes through.
struct LocalRound {
    centre: Point<f64>,
    rho_sq: f64,
}

/// The smallest sphere through the local origin and `b`: `(A + B)/2 + (A . B)/2 ninf`.
fn round_of_two(b: Point<f64>) -> LocalRound {
    local_round(formulas::pair_sphere(Point::origin(), b).centre())
}

/// The smallest sphere through the local origin, `b` and `c`: `K ^ (K ^ ninf)*` with their circle K.
fn round_of_three(b: Point<f64>, c: Point<f64>) -> LocalRound {
    over_weight(formulas::circle_sphere_relative(Point::origin(), b, c))
}

/// The sphere through the local origin, `b`, `c` and `d`: the dual of their wedge.
fn round_of_four(b: Point<f64>, c: Point<f64>, d: Point<f64>) -> LocalRound {
    over_weight(formulas::circumsphere_relative(Point::origin(), b, c, d))
}

/// A round through the local origin; one of no weight has a centre that is not finite, which its users look for.
fn over_weight(round: Round<f64>) -> LocalRound {
    local_round(Point::new(round.e1 / round.no, round.e2 / round.no, round.e3 / round.no))
}

/// The sphere through the local origin with the given centre.
fn local_round(centre: Point<f64>) -> LocalRound {
    LocalRound { centre, rho_sq: centre.position().norm_sq() }
}

//! Entire functions of the square of a bivector, and the logarithm's function of a versor's scalar and 4-vector.
//!
//! In G(4,1) the square of a bivector is `N = B² = s + F`, a number and a 4-vector that commutes with B, and `F² = f2` is a
//! number. So numbers `x + y F` multiply like complex, dual or split numbers, by the sign of f2, and
//!
//! ```text
//! exp B = C(N) + S(N) B          C = cosh sqrt N    S = sinh sqrt N / sqrt N
//! log V = L(Z) V2                V = Z + V2, Z scalar and 4-vector, V2 bivector; L = arcosh Z / sqrt(Z² - 1)
//! ```
//!
//! Screws are the dual case, spirals (rotation and dilation) the complex one. Three ways to f(s + F), none of which cancels
//! where it is used, and none of which splits B into its commuting planes, which are undefined where their squares are
//! equal or zero (compare Roelfs and De Keninck, *Graded symmetry groups: plane and simple*, 2021):
//!
//! * near the origin the power series, by Horner's rule on pairs (x, y);
//! * where the squares `l1, l2` of the two planes differ, `l1 + l2 = s`, `4 l1 l2 = f2`, by functions of each and a quotient
//!   by `l1 - l2`;
//! * where they are nearly equal, by the eigenvalues `s +- sqrt f2` of N, which are then far apart; for the logarithm by
//!   the two isoclinic parts of the versor, each of which is like a quaternion.

use super::direction::quotient;
use crate::algebra::Real;

/// The number `scalar + four F` for a 4-vector F that the caller has.
#[derive(Clone, Copy, Debug)]
pub(super) struct Number<T> {
    pub(super) scalar: T,
    pub(super) four: T,
}

/// Terms of the series of cosh and sinh up to eigenvalues of size 1: the next, 1/20!, is 4e-19.
const EXP_TERMS: i32 = 9;
/// Terms of the series of L up to eigenvalues of 1 - Z of size 1/4: each is under 1/8 of the one before, and 8^-19 is 7e-18.
const LOG_TERMS: i32 = 19;

/// `1 + a_1 x (1 + a_2 x (1 + ...))` at `x = s + u F`, `F² = f2`.
fn nested<T: Real>(x: Number<T>, f2: T, terms: i32, ratio: impl Fn(i32) -> T) -> Number<T> {
    let one = Number { scalar: T::one(), four: T::zero() };
    (1..=terms).rev().fold(one, |sum, k| {
        let a = ratio(k);
        Number {
            scalar: T::one() + a * (sum.scalar * x.scalar + sum.four * x.four * f2),
            four: a * (sum.scalar * x.four + sum.four * x.scalar),
        }
    })
}

/// `cosh sqrt l` and `sinh sqrt l / sqrt l`, the cosine and its like where l is negative.
fn cosh_sinhc<T: Real>(l: T) -> (T, T) {
    let root = l.abs().sqrt();
    let (sin, cos) = if l < T::zero() { root.sin_cos() } else { root.sinh_cosh() };
    (cos, quotient(sin, root))
}

/// The two roots of `x² - sum x + product`, the larger first, where they are real.
fn roots<T: Real>(sum: T, product: T) -> (T, T) {
    let (half, root) = (sum.abs() * T::ratio(1, 2), product.abs().sqrt());
    // sqrt(half² -+ root²) without the squares, which leave the range first.
    let distance = if product > T::zero() {
        (half - root).max(T::zero()).sqrt() * (half + root).sqrt()
    } else {
        let (large, small) = (half.max(root), half.min(root));
        large * (T::one() + (small / large) * (small / large)).sqrt()
    };
    let large = if sum < T::zero() { -half - distance } else { half + distance };
    (large, product / large)
}

/// Whether the roots of `x² - sum x + product` are too close for a quotient by their difference: closer than 0.7 of
/// their sum. Then they have one sign, and `4 product / sum²` is over 1/2.
fn are_close<T: Real>(sum: T, product: T) -> bool {
    product / sum / sum > T::ratio(1, 8)
}

/// C and S of `N = s + F`, with `F² = f2`.
pub(super) fn exponential<T: Real>(s: T, f2: T) -> [Number<T>; 2] {
    let (one, half) = (T::one(), T::ratio(1, 2));
    if s.abs() + f2.abs().sqrt() <= one {
        let n = Number { scalar: s, four: one };
        return [
            nested(n, f2, EXP_TERMS, |k| T::ratio(1, 2 * k * (2 * k - 1))),
            nested(n, f2, EXP_TERMS, |k| T::ratio(1, 2 * k * (2 * k + 1))),
        ];
    }
    let product = f2 * T::ratio(1, 4);
    if are_close(s, product) {
        let root = f2.sqrt();
        let ((c_a, s_a), (c_b, s_b)) = (cosh_sinhc(s + root), cosh_sinhc(s - root));
        return [mean_and_slope(c_a, c_b, root), mean_and_slope(s_a, s_b, root)];
    }
    let (l_1, l_2) = roots(s, product);
    let ((c_1, s_1), (c_2, s_2)) = (cosh_sinhc(l_1), cosh_sinhc(l_2));
    let q = (s_1 * c_2 - s_2 * c_1) / (l_1 - l_2);
    [Number { scalar: c_1 * c_2, four: s_1 * s_2 * half }, Number { scalar: c_2 * s_1 + l_2 * q, four: -q * half }]
}

/// f(s + F) from its values at the eigenvalues `s + root` and `s - root`.
fn mean_and_slope<T: Real>(a: T, b: T, root: T) -> Number<T> {
    let half = T::ratio(1, 2);
    Number { scalar: (a + b) * half, four: (a - b) * half / root }
}

/// Whether the squares of the sines of both planes of a versor are nearly equal, and not small, from the square f2 of its
/// 4-vector and the scalar part m of the square of its bivector. Then [`logarithm`] is not for it.
pub(super) fn turns_are_close<T: Real>(c: T, f2: T, m: T) -> bool {
    !is_near_identity(c, f2) && are_close(sine_sum(f2, m), f2)
}

fn is_near_identity<T: Real>(c: T, f2: T) -> bool {
    (T::one() - c).abs() + f2.abs().sqrt() <= T::ratio(1, 4)
}

/// Of `y = sinh²` of half the boost, or `-sin²` of half the angle, of both planes, the sum; the product is f2. The sum is
/// `c² - 1 - f2`, and as `V ~V = 1` gives it, without a difference from 1.
fn sine_sum<T: Real>(f2: T, m: T) -> T {
    m - (f2 + f2)
}

/// L of `Z = c + F`, for `c >= 0`, with `F² = f2` and the scalar part m of `V2² = Z² - 1`.
pub(super) fn logarithm<T: Real>(c: T, f2: T, m: T) -> Number<T> {
    let one = T::one();
    if is_near_identity(c, f2) {
        let w = Number { scalar: one - c, four: -one };
        return nested(w, f2, LOG_TERMS, |k| T::ratio(k, 2 * k + 1));
    }
    let sum = sine_sum(f2, m);
    let (y_1, y_2) = roots(sum, f2);
    // sqrt(1 + y) is good where y is positive, or small; the other cosine follows from the product of both.
    let (cosh_1, cosh_2) = if y_1 > T::zero() {
        let cosh = (one + y_1).sqrt();
        (cosh, c / cosh)
    } else {
        let cosh = (one + y_2).sqrt();
        (c / cosh, cosh)
    };
    let (a_1, a_2) = (inverse_sinhc(y_1, cosh_1), inverse_sinhc(y_2, cosh_2));
    let difference = y_1 - y_2;
    Number {
        scalar: (a_1 * cosh_2 * y_1 - a_2 * cosh_1 * y_2) / difference,
        four: (a_2 * cosh_2 - a_1 * cosh_1) / difference,
    }
}

/// `x / sinh x` from `y = sinh² x` and `cosh x`; `x / sin x` where y is negative.
fn inverse_sinhc<T: Real>(y: T, cosh: T) -> T {
    let sinh = y.abs().sqrt();
    let x = if y < T::zero() { sinh.atan2(cosh) } else { sinh.asinh() };
    quotient(x, sinh)
}

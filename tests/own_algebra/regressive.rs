//! The meet where there is no dual, and where there is one, against the definition by complements.
//!
//! The right complement is found here by trying: the signed blade c with `x ^ c = I`. The generated meet takes complements
//! by counting swaps, the dynamic one goes by the common factor and takes none.

use super::*;
use ga_physics::algebra::dynamic::Metric;

fn blade<M: Metric>(bits: u32, sign: i128) -> Dynamic<M, Rational> {
    Dynamic::from_terms(&[(bits, Rational::new(sign, 1))])
}

fn dimension<M: Metric>() -> u32 {
    u32::try_from(M::SQUARES.len()).unwrap()
}

/// The c with `x ^ c = I`.
fn complement<M: Metric>(x: &Dynamic<M, Rational>) -> Dynamic<M, Rational> {
    let n = dimension::<M>();
    let unit = blade::<M>((1 << n) - 1, M::PSEUDOSCALAR_SIGN.into());
    let candidates = (0..1 << n).flat_map(|bits| [1, -1].map(|sign| blade::<M>(bits, sign)));
    candidates.into_iter().find(|c| (x ^ c) == unit).unwrap()
}

/// The r with `c(r) = c(a) ^ c(b)`, or nothing where that is 0.
fn by_complements<M: Metric>(a: &Dynamic<M, Rational>, b: &Dynamic<M, Rational>) -> Dynamic<M, Rational> {
    let outer = &complement(a) ^ &complement(b);
    let candidates = (0..1 << dimension::<M>()).flat_map(|bits| [1, -1].map(|sign| blade::<M>(bits, sign)));
    candidates.into_iter().find(|r| complement(r) == outer).unwrap_or(blade::<M>(0, 0))
}

/// All pairs of orthonormal blades.
fn pairs<M: Metric>() -> impl Iterator<Item = (Dynamic<M, Rational>, Dynamic<M, Rational>)> {
    let count = 1 << dimension::<M>();
    (0..count).flat_map(move |a| (0..count).map(move |b| (blade(a, 1), blade(b, 1))))
}

fn holds_without_dual<M: Metric + std::fmt::Debug>() {
    for (a, b) in pairs::<M>() {
        assert!(a.dual().is_none());
        assert!(a.meet(&b).unwrap() == by_complements(&a, &b), "{a:?} & {b:?}");
    }
}

/// `undual(dual a ^ dual b) = I² (b & a)`, with the `&` of complements.
fn holds_with_dual<M: Metric + std::fmt::Debug>() {
    let unit = blade::<M>((1 << dimension::<M>()) - 1, 1);
    let square = (&unit * &unit).coefficient(0);
    for (a, b) in pairs::<M>() {
        assert!(a.meet(&b).unwrap() == by_complements(&b, &a).scaled(square), "{a:?} & {b:?}");
    }
}

#[test]
fn complements_define_the_meet_where_i_squares_to_zero() {
    holds_without_dual::<pga2::Algebra>();
    holds_without_dual::<pga3::Algebra>();
    holds_without_dual::<degenerate::Algebra>();
}

#[test]
fn the_dual_gives_the_same_up_to_order_and_the_square_of_i() {
    holds_with_dual::<g2::Algebra>();
    holds_with_dual::<ga_physics::algebra::g3::Algebra>();
    holds_with_dual::<spacetime::Algebra>();
    holds_with_dual::<cga2::Algebra>();
    holds_with_dual::<square_one::Algebra>();
}

/// A null pair and a vector of square 0, with a negative pseudoscalar.
mod degenerate {
    ga_physics::algebra! {
        pub algebra degenerate;
        basis null pair (o, i) = -1, d = 0;
        pseudoscalar -o_i_d;

        type Vector = [o, i, d];
        type Bivector = [o_i, i_d, d_o];
        type Pseudoscalar = [o_i_d];
        type Even = [s, o_i, i_d, d_o];
        type Odd = [o, i, d, o_i_d];
        type Multivector = [s, o, i, d, o_i, i_d, d_o, o_i_d];
    }
}

/// `I² = 1`.
mod square_one {
    ga_physics::algebra! {
        pub algebra square_one;
        basis e1 = 1, e2 = -1;
        pseudoscalar e12;

        type Vector = [e1, e2];
    }
}

mod null_pair_without_dual {
    use super::*;
    use degenerate as algebra;
    type Vector = degenerate::Vector<Rational>;
    type Bivector = degenerate::Bivector<Rational>;
    type Pseudoscalar = degenerate::Pseudoscalar<Rational>;
    type Even = degenerate::Even<Rational>;
    type Odd = degenerate::Odd<Rational>;
    type Multivector = degenerate::Multivector<Rational>;

    integers!(Vector Bivector Pseudoscalar Even Odd Multivector);
    checks!(degenerate::Algebra);
    degenerate::__operations!(check);

    #[test]
    fn every_operation_agrees() {
        let compared = compare_all();
        assert!(compared > 100, "only {compared} operations were compared");
    }

    #[test]
    fn the_pseudoscalar_is_the_unit_and_meets_associate() {
        let mut random = Random(37);
        for _ in 0..20 {
            // I = -o_i_d.
            let unit = Pseudoscalar::new(Rational::new(-1, 1));
            let [a, b, c] = [(); 3].map(|()| Bivector::sample(&mut random));
            assert_eq!((unit & a, a & unit), (a, a));
            let (left, right): (Rational, Rational) = ((a & b) & c, a & (b & c));
            assert_eq!(left, right);
        }
    }
}

//! `examples/algebras/spacetime.rs`: every operation, intervals, fields and forces by their textbook forms.

use super::*;
use spacetime as algebra;
type Vector = spacetime::Vector<Rational>;
type Bivector = spacetime::Bivector<Rational>;
type Rotor = spacetime::Rotor<Rational>;
type Complex = spacetime::Complex<Rational>;
type Even = spacetime::Even<Rational>;
type Trivector = spacetime::Trivector<Rational>;
type Odd = spacetime::Odd<Rational>;
type Pseudoscalar = spacetime::Pseudoscalar<Rational>;
type Multivector = spacetime::Multivector<Rational>;

integers!(Vector Bivector Complex Even Trivector Odd Pseudoscalar Multivector);
impl Sample for Rotor {
    /// A boost along one axis after a turn: `(5 + b e10)² / (25 - b²)`, for e10 squares to 1.
    fn sample(random: &mut Random) -> Self {
        let b = random.integer();
        let axis = random.integer().unsigned_abs() as usize % 3;
        let mut boost = [Rational::new(0, 1); 8];
        boost[0] = Rational::new(25 + b * b, 25 - b * b);
        boost[1 + axis] = Rational::new(10 * b, 25 - b * b);
        let [s, x, y, z] = unit_quaternion(random);
        let mut turn = [Rational::new(0, 1); 8];
        (turn[0], turn[4], turn[5], turn[6]) = (s, x, y, z);
        let product: [Rational; 8] = (Even::from(boost) * Even::from(turn)).into();
        Self::from(product)
    }
}
checks!(spacetime::Algebra);
fn image(versor: &Multi, x: &Multi, _type_name: &str) -> Multi {
    versor.apply(x)
}
spacetime::__operations!(check);

#[test]
fn every_operation_agrees() {
    let compared = compare_all();
    assert!(compared > 200, "only {compared} operations were compared");
}

twins! {
    interval interval_dynamic(a: Vector, b: Vector);
    invariants invariants_dynamic(field: Bivector);
    force force_dynamic(field: Bivector, u: Vector);
}

#[test]
fn a_lorentz_transformation_keeps_intervals_and_the_invariants_of_a_field() {
    let mut random = Random(3);
    for _ in 0..20 {
        let (rotor, field) = (Rotor::sample(&mut random), Bivector::sample(&mut random));
        let [a, b] = [(); 2].map(|()| Vector::sample(&mut random));
        let d = b - a;
        let interval = d.e0 * d.e0 - d.e1 * d.e1 - d.e2 * d.e2 - d.e3 * d.e3;
        let (image_a, image_b): (Vector, Vector) = (rotor.apply(a), rotor.apply(b));
        assert_eq!((spacetime::interval(a, b), spacetime::interval(image_a, image_b)), (interval, interval));
        let image: Bivector = rotor.apply(field);
        assert_eq!(spacetime::invariants(image), spacetime::invariants(field));
    }
}

#[test]
fn the_invariants_are_those_of_electric_and_magnetic_fields() {
    // E = (1, -2, 4), B = (3, 5, 7): E² = 21, B² = 83, E.B = 21.
    let field = spacetime::Bivector::from_fields([1.0, -2.0, 4.0], [3.0, 5.0, 7.0]);
    let invariants = spacetime::invariants(field);
    assert_eq!((invariants.s, invariants.e0123), (21.0 - 83.0, 2.0 * 21.0));
    // The force on a charge of the velocity v = (2, 1, -1), per unit of proper time over gamma: E + v x B, and E.v.
    let force = spacetime::force(field, spacetime::Vector::new(1.0, 2.0, 1.0, -1.0));
    assert_eq!([force.e0, force.e1, force.e2, force.e3], [-4.0, 1.0 + 12.0, -2.0 - 17.0, 4.0 + 7.0]);
}

#[test]
fn a_boost_moves_what_is_at_rest_and_mixes_the_fields() {
    // tanh w = 3/5: gamma = 5/4.
    let boost = spacetime::Rotor::boost_x(0.6_f64.atanh());
    let moving: spacetime::Vector = boost.apply(spacetime::Vector::new(1.0, 0.0, 0.0, 0.0));
    let field: spacetime::Bivector = boost.apply(spacetime::Bivector::from_fields([7.0, 2.0, 0.0], [0.0, 0.0, 1.0]));
    // E_x stays, E_y = gamma (E_y + v B_z), B_z = gamma (B_z + v E_y): the field's source is what moves.
    let expected = spacetime::Bivector::from_fields([7.0, 3.25, 0.0], [0.0, 0.0, 2.75]);
    // Hyperbolic functions good to an ulp, a few products of numbers below 10.
    let tolerance = 16.0 * f64::EPSILON * 10.0;
    let largest = |numbers: &[f64]| numbers.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    assert!(largest(&<[f64; 4]>::from(moving - spacetime::Vector::new(1.25, 0.75, 0.0, 0.0))) <= tolerance, "{moving}");
    assert!(largest(&<[f64; 6]>::from(field - expected)) <= tolerance, "{field}");
}

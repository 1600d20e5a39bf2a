//! `examples/algebras/g2.rs`: every operation, and the complex numbers by their own arithmetic.

use super::*;
use g2 as algebra;
type Vector = g2::Vector<Rational>;
type Bivector = g2::Bivector<Rational>;
type Rotor = g2::Rotor<Rational>;
type Complex = g2::Complex<Rational>;
type Multivector = g2::Multivector<Rational>;

integers!(Vector Bivector Complex Multivector);
impl Sample for Rotor {
    fn sample(random: &mut Random) -> Self {
        unit_complex(random).into()
    }
}
checks!(g2::Algebra);
fn image(versor: &Multi, x: &Multi, _type_name: &str) -> Multi {
    versor.apply(x)
}
g2::__operations!(check);

#[test]
fn every_operation_agrees() {
    let compared = compare_all();
    assert!(compared > 50, "only {compared} operations were compared");
}

twins! {
    complex complex_dynamic(a: Vector, b: Vector);
    twice_the_angle twice_the_angle_dynamic(a: Vector, b: Vector);
    area area_dynamic(a: Vector, b: Vector, c: Vector);
}

#[test]
fn complex_numbers_multiply_and_turn() {
    let [one, zero] = [1, 0].map(|n| Rational::new(n, 1));
    let mut random = Random(5);
    for _ in 0..20 {
        let (z, w) = (Complex::sample(&mut random), Complex::sample(&mut random));
        let product: Complex = z * w;
        assert_eq!((product.s, product.e12), (z.s * w.s - z.e12 * w.e12, z.s * w.e12 + z.e12 * w.s));
        // The number of a vector is that of its components, and a factor from the right turns it as the plane turns.
        let v = Vector::sample(&mut random);
        let number = g2::complex(Vector::new(one, zero), v);
        assert_eq!((number.s, number.e12), (v.e1, v.e2));
        let turned: Vector = v * z;
        assert_eq!((turned.e1, turned.e2), (v.e1 * z.s - v.e2 * z.e12, v.e1 * z.e12 + v.e2 * z.s));
    }
}

#[test]
fn a_rotor_turns_by_its_angle() {
    let quarter: g2::Vector = g2::Rotor::from_angle(std::f64::consts::FRAC_PI_2).apply(g2::Vector::new(3.0, 4.0));
    // Sine and cosine are good to half an ulp, and enter squared: a few eps of |v| = 5.
    let tolerance = 4.0 * f64::EPSILON * 5.0;
    assert!((quarter.e1 + 4.0).abs() <= tolerance && (quarter.e2 - 3.0).abs() <= tolerance, "{quarter}");
}

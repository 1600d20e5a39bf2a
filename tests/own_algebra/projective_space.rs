//! `examples/algebras/pga3.rs`: every operation, those with the shared types of G(3,0) included, and closed forms.

use super::*;
use ga_physics::algebra::g3;
use pga3 as algebra;
type Vector = g3::Vector<Rational>;
type Bivector = g3::Bivector<Rational>;
type Trivector = g3::Trivector<Rational>;
type Rotor = g3::Rotor<Rational>;
type Plane = pga3::Plane<Rational>;
type Line = pga3::Line<Rational>;
type Point = pga3::Point<Rational>;
type AnyPoint = pga3::AnyPoint<Rational>;
type Translator = pga3::Translator<Rational>;
type Motor = pga3::Motor<Rational>;
type Pseudoscalar = pga3::Pseudoscalar<Rational>;
type Even = pga3::Even<Rational>;
type Odd = pga3::Odd<Rational>;
type Multivector = pga3::Multivector<Rational>;

integers!(Vector Bivector Trivector Plane Line Point AnyPoint Translator Pseudoscalar Even Odd Multivector);
impl Sample for Rotor {
    fn sample(random: &mut Random) -> Self {
        unit_quaternion(random).into()
    }
}
impl Sample for Motor {
    fn sample(random: &mut Random) -> Self {
        // The product of a shared type and an own one.
        Translator::sample(random) * Rotor::sample(random)
    }
}
checks!(pga3::Algebra);
fn image(versor: &Multi, x: &Multi, _type_name: &str) -> Multi {
    versor.apply(x)
}
pga3::__operations!(check);

#[test]
fn every_operation_agrees() {
    let compared = compare_all();
    assert!(compared > 400, "only {compared} operations were compared");
}

twins! {
    meet_planes meet_planes_dynamic(a: Plane, b: Plane);
    pierce pierce_dynamic(line: Line, plane: Plane);
    join join_dynamic(a: Point, b: Point);
    plane_through plane_through_dynamic(a: Point, b: Point, c: Point);
    six_volumes six_volumes_dynamic(a: Point, b: Point, c: Point, d: Point);
    motor motor_dynamic(translator: Translator, rotor: Rotor);
}

fn number(n: i128) -> Rational {
    Rational::new(n, 1)
}

fn minus(a: Point, b: Point) -> [Rational; 3] {
    [a.x - b.x, a.y - b.y, a.z - b.z]
}

fn cross(a: [Rational; 3], b: [Rational; 3]) -> [Rational; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [Rational; 3], b: [Rational; 3]) -> Rational {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[test]
fn joins_are_cross_products_and_determinants() {
    let mut random = Random(17);
    for _ in 0..20 {
        let [a, b, c, d] = [(); 4].map(|()| Point::sample(&mut random));
        // A line is its direction, and its moment about the origin.
        let line = pga3::join(a, b);
        let moment = cross([a.x, a.y, a.z], [b.x, b.y, b.z]);
        assert_eq!([line.e23, line.e31, line.e12], minus(b, a));
        assert_eq!([line.e01, line.e02, line.e03], moment);
        let plane = pga3::plane_through(a, b, c);
        let normal = cross(minus(b, a), minus(c, a));
        assert_eq!([plane.e1, plane.e2, plane.e3], normal);
        assert_eq!(dot([plane.e1, plane.e2, plane.e3], [a.x, a.y, a.z]) + plane.e0, number(0));
        assert_eq!(pga3::six_volumes(a, b, c, d), dot(normal, minus(d, a)));
    }
}

#[test]
fn a_line_of_two_planes_pierces_a_third_in_their_common_point() {
    // x = 1, y = 2, z = 5.
    let plane = |normal: [i128; 3], d| Plane::new(number(normal[0]), number(normal[1]), number(normal[2]), number(d));
    let axis = pga3::meet_planes(plane([1, 0, 0], -1), plane([0, 1, 0], -2));
    let point = pga3::pierce(axis, plane([0, 0, 1], -5));
    assert_eq!([point.e123, point.e032, point.e013, point.e021], [1, 1, 2, 5].map(number));
    let parallel = pga3::pierce(axis, plane([3, -1, 0], 7));
    assert_eq!(parallel.e123, number(0));
}

#[test]
fn a_motor_turns_and_then_moves_as_the_rotation_matrix_does() {
    let mut random = Random(23);
    for _ in 0..20 {
        let (translator, rotor, x) =
            (Translator::sample(&mut random), Rotor::sample(&mut random), Point::sample(&mut random));
        let turned: Vector = rotor.apply(Vector::new(x.x, x.y, x.z));
        let image: Point = pga3::motor(translator, rotor).apply(x);
        let expected = [turned.e1 + translator.x, turned.e2 + translator.y, turned.e3 + translator.z];
        assert_eq!([image.x, image.y, image.z], expected);
    }
}

#[test]
fn a_rotor_of_the_base_turns_what_the_extension_declares() {
    // A half turn in the plane e12: x = 1 becomes x = -1, with the normal turned as well.
    let half = g3::Rotor::new(number(0), number(0), number(0), number(-1));
    let image: Plane = half.apply(Plane::new(number(1), number(0), number(0), number(-1)));
    assert_eq!([image.e1, image.e2, image.e3, image.e0], [-1, 0, 0, -1].map(number));
}

//! Formulas as users write them: in another crate, over the library's algebras and their own, in modules and function
//! bodies, with every piece of the grammar. Each is held against an answer made by other means, exactly.
#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test may panic")]

#[path = "support/rational.rs"]
mod rational;

use ga_physics::algebra::dynamic::{Dynamic, ToDynamic};
use ga_physics::algebra::{cga, g3};
use ga_physics::formula;
use rational::Rational;

fn number(numerator: i128) -> Rational {
    Rational::new(numerator, 1)
}

fn vector(components: [i128; 3]) -> g3::Vector<Rational> {
    components.map(number).into()
}

fn point(coordinates: [i128; 3]) -> cga::Point<Rational> {
    coordinates.map(number).into()
}

type Multi<A> = Dynamic<A, Rational>;

fn scalar_of<A: ga_physics::algebra::dynamic::Metric>(value: Rational) -> Multi<A> {
    Dynamic::from_terms(&[(0, value)])
}

/// Formulas over the library's algebras, some of them private to this module.
mod library {
    use ga_physics::algebra::cga as conformal;
    use ga_physics::formula;

    /// The volume of a tetrahedron, times 6.
    #[formula(conformal, local = a, dynamic = volume_dynamic)]
    pub fn volume(a: Point, b: Point, c: Point, d: Point) -> Scalar {
        -(a ^ b ^ c ^ d ^ ninf).dual()
    }

    /// Centre and squared radius of the circle through three points: a type of the base algebra, by its bare name.
    #[formula(conformal, dynamic = circle_parts_dynamic)]
    pub(crate) fn circle_parts(a: Point, b: Point, c: Point) -> (Round, Scalar) {
        let circle = a ^ b ^ c;
        let flat = circle ^ Infinity;
        let centre = (circle * Infinity * circle).grade(1);
        (centre / -(centre | Infinity), circle.norm_sq() / flat.norm_sq())
    }

    /// The library's own formula, called: the sphere through four points, and its power of a fifth.
    #[formula(conformal, dynamic = power_dynamic)]
    pub fn power(a: Point, b: Point, c: Point, d: Point, x: Point) -> (Sphere, Scalar) {
        let sphere: Sphere = ga_physics::geometry::formulas::circumsphere(a, b, c, d);
        (sphere, -2 * (x | sphere))
    }
}

#[test]
fn formulas_over_the_librarys_algebras() {
    let [a, b, c, d] = [[1, 2, 3], [4, 2, 3], [1, 4, 3], [1, 2, 8]].map(point);
    let [da, db, dc, dd] = [a, b, c, d].map(|p| p.to_dynamic());
    // 3, 2 and 5 along the axes.
    assert_eq!(library::volume(a, b, c, d), number(30));
    assert_eq!(library::volume_dynamic(&da, &db, &dc, &dd), scalar_of(number(30)));
    // A right angle at a: the centre is the middle of b and c.
    let (centre, radius_sq) = library::circle_parts(a, b, c);
    assert_eq!([centre.e1, centre.e2, centre.e3, centre.no], [Rational::new(5, 2), number(3), number(3), number(1)]);
    assert_eq!(radius_sq, Rational::new(13, 4));
    assert_eq!(library::circle_parts_dynamic(&da, &db, &dc), (centre.to_dynamic(), scalar_of(radius_sq)));
}

#[test]
fn a_formula_calls_another_one() {
    let [a, b, c, d, x] = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 0, 1], [3, 4, 0]].map(point);
    let (sphere, power) = library::power(a, b, c, d, x);
    assert_eq!((sphere, power), (cga::Sphere::from([0, 0, 0, 1].map(number)), number(24)), "5² - 1");
    let [a, b, c, d, x] = [a, b, c, d, x].map(|p| p.to_dynamic());
    assert_eq!(library::power_dynamic(&a, &b, &c, &d, &x), (sphere.to_dynamic(), scalar_of(power)));
}

/// Everything that a body may hold.
mod grammar {
    use ga_physics::formula;

    #[formula(ga_physics::algebra::g3, dynamic = lerp_dynamic)]
    pub fn lerp(a: Vector, b: Vector, k: Scalar) -> Vector {
        (1 - k) * a + k * b
    }

    /// Numbers, components, blades, shadowing, a typed intermediate.
    #[formula(ga_physics::algebra::g3, dynamic = mixture_dynamic)]
    pub fn mixture(a: Vector, b: Vector) -> Even {
        let plane: Bivector = a ^ b;
        let a = 0.25 * a + 1 / 2 * e1;
        let shared = a * b;
        shared + plane * plane.e31 - (b * e12).e2 * shared.e21 / 3
    }

    /// All methods; the dual of G(3,0).
    #[formula(ga_physics::algebra::g3, dynamic = methods_dynamic)]
    pub fn methods(a: Vector, b: Bivector, r: Rotor) -> Odd {
        let turned = r.apply(a - b.undual());
        (turned * b.rev()).grade(3) + (b & (a ^ turned)) + b.dual() / b.norm_sq()
    }

    /// Calls with several results, of formulas in this module; an argument that is an expression, one that is a number.
    #[formula(ga_physics::algebra::g3, dynamic = calls_dynamic)]
    pub fn calls(a: Vector, b: Vector) -> (Vector, Scalar) {
        let (sum, product): (Vector, Scalar) = both(a, b * 2);
        let middle: Vector = lerp(a, sum, 1 / 2);
        (middle * product, (middle | b))
    }

    #[formula(ga_physics::algebra::g3)]
    pub(super) fn both(a: Vector, b: Vector) -> (Vector, Scalar) {
        (a + b, a | b)
    }

    #[formula(ga_physics::algebra::g3)]
    pub fn length(a: Vector) -> Scalar {
        a.norm_sq().sqrt()
    }

    #[formula(ga_physics::algebra::g3, dynamic = unit_dynamic)]
    pub fn unit(a: Vector) -> Vector {
        a.normalised()
    }
}

#[test]
fn every_piece_of_the_grammar_agrees_with_the_dynamic_multivector() {
    let (a, b) = (vector([1, -2, 3]), vector([4, 5, -1]));
    let (da, db): (Multi<g3::Algebra>, Multi<g3::Algebra>) = (a.to_dynamic(), b.to_dynamic());
    let third = Rational::new(1, 3);
    assert_eq!(grammar::lerp(a, b, third), (a * number(2) + b) / number(3));
    assert_eq!(grammar::lerp_dynamic(&da, &db, &scalar_of(third)), grammar::lerp(a, b, third).to_dynamic());
    assert_eq!(grammar::mixture(a, b).to_dynamic(), grammar::mixture_dynamic(&da, &db));
    let (plane, rotor) = (g3::Bivector::from([2, 1, -3].map(number)), {
        g3::Rotor::new(Rational::new(1, 2), Rational::new(1, 2), Rational::new(-1, 2), Rational::new(1, 2))
    });
    let twin = grammar::methods_dynamic(&da, &plane.to_dynamic(), &rotor.to_dynamic());
    assert_eq!(grammar::methods(a, plane, rotor).to_dynamic(), twin);
    // both = (a + 2 b, 2 a.b), middle = a + b.
    let (scaled, inner) = grammar::calls(a, b);
    assert_eq!((scaled, inner), ((a + b) * number(-18), (a + b) | b), "a . b = -9");
    assert_eq!(grammar::calls_dynamic(&da, &db), (scaled.to_dynamic(), scalar_of(inner)));
    assert_eq!(grammar::unit(vector([2, -3, 6])), vector([2, -3, 6]) / number(7));
    let unit = grammar::unit_dynamic(&ToDynamic::<g3::Algebra, _>::to_dynamic(&vector([2, -3, 6])));
    assert_eq!(unit, grammar::unit(vector([2, -3, 6])).to_dynamic());
    assert_eq!(grammar::length(vector([2, -3, 6])), number(7));
    assert!(grammar::length(g3::Vector::new(0.0_f32, 0.0, 0.0)) == 0.0);
}

#[test]
fn formulas_stand_in_function_bodies() {
    #[formula(g3)]
    fn inner(a: Vector, b: Vector) -> Scalar {
        a | b
    }
    use ga_physics::algebra::g3;
    assert_eq!(inner(vector([1, 2, 3]), vector([4, 5, 6])), number(32));
}

/// An algebra of this crate on the library's, and one that extends that one: three deep.
mod projective {
    ga_physics::algebra! {
        pub algebra projective extends ga_physics::algebra::g3;
        basis e0 = 0;
        pseudoscalar e1230;

        type Plane = [e1, e2, e3, e0];
        type Point = [e123, e230, e310, e120];
        type Origin = e123;
    }
}
mod projective_time {
    ga_physics::algebra! {
        pub algebra projective_time extends super::projective;
        basis e4 = -1;
        pseudoscalar e12304;

        /// An event: a vector with a time.
        type Event = [e1, e2, e3, e0, e4];
        /// A redeclared name hides the base's.
        type Point = [e1234, e2304, e3104, e1204];
    }
}
mod elsewhere {
    use super::{projective, projective_time};
    use ga_physics::formula;

    /// Types of the base's base, of the base, and its own.
    #[formula(projective_time, dynamic = event_dynamic)]
    pub fn event(a: Vector, b: Plane, r: Rotor, time: Scalar) -> Event {
        r.apply(a) + b + time * e4
    }

    #[formula(projective)]
    pub fn raised(a: Point) -> Point {
        a + 2 * Origin
    }

    #[formula(projective_time)]
    pub fn at_time(a: Plane, b: Plane, c: Plane) -> Point {
        a ^ b ^ c ^ e4
    }
}

#[test]
fn formulas_over_a_chain_of_algebras() {
    let (a, b) = (vector([1, 2, 3]), projective::Plane::from([4, 5, 6, 7].map(number)));
    // A half turn about z.
    let rotor = g3::Rotor::new(number(0), number(0), number(0), number(1));
    let event = elsewhere::event(a, b, rotor, number(9));
    assert_eq!(event, projective_time::Event::from([3, 3, 9, 7, 9].map(number)));
    let twin = elsewhere::event_dynamic(&a.to_dynamic(), &b.to_dynamic(), &rotor.to_dynamic(), &scalar_of(number(9)));
    assert_eq!(event.to_dynamic(), twin);
    // The same type by three names.
    let plane: projective_time::Plane<Rational> = b;
    let moved: projective_time::Vector<Rational> = a;
    assert_eq!((plane, moved), (b, a));
    let raised = elsewhere::raised(projective::Point::from([1, 2, 3, 4].map(number)));
    assert_eq!(raised, projective::Point::from([3, 2, 3, 4].map(number)));
    let planes = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]].map(|p| projective::Plane::from(p.map(number)));
    let [x, y, z] = planes;
    assert_eq!(elsewhere::at_time(x, y, z), projective_time::Point::from([1, 0, 0, 0].map(number)));
}

/// In a local frame, a call is made in the world: it may do anything with its arguments.
mod frames {
    use ga_physics::algebra::cga;
    use ga_physics::formula;

    #[formula(cga, local = a)]
    pub fn with_call(a: Point, b: Point) -> Sphere {
        let far: Point = super::twice_as_far(b);
        (a + far) / 2 + ((a | far) * Infinity) / 2
    }

    #[formula(cga, dynamic = with_call_dynamic)]
    pub fn with_call_in_the_world(a: Point, b: Point) -> Sphere {
        let far: Point = super::twice_as_far(b);
        (a + far) / 2 + ((a | far) * Infinity) / 2
    }
}

/// No formula, but callable like one.
fn twice_as_far<T: ga_physics::algebra::Scalar>(a: cga::Point<T>) -> cga::Point<T> {
    cga::Point::new(a.x + a.x, a.y + a.y, a.z + a.z)
}

#[test]
fn a_call_in_a_local_frame_is_made_in_the_world() {
    let (a, b) = (point([1, 2, 3]), point([-2, 5, 1]));
    // The sphere on the diameter from (1, 2, 3) to (-4, 10, 2).
    let expected = cga::Sphere::new(Rational::new(-3, 2), number(6), Rational::new(5, 2), Rational::new(90, 4));
    assert_eq!(frames::with_call(a, b), expected);
    assert_eq!(frames::with_call_in_the_world(a, b), expected);
    assert_eq!(frames::with_call_dynamic(&a.to_dynamic(), &b.to_dynamic()), expected.to_dynamic());
}

/// The frame is what keeps the digits: a sphere of radius 1, 10^8 away, in f64.
#[test]
fn a_local_frame_keeps_the_digits() {
    let far = 1e8;
    let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]];
    let [a, b, c, d] = corners.map(|[x, y, z]: [f64; 3]| cga::Point::new(x + far, y, z));
    assert_eq!(library::volume(a, b, c, d).abs(), 2.0, "exact: the differences are small integers");
}

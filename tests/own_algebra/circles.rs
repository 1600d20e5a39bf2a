//! `examples/algebras/cga2.rs`: every operation, split and factored storage included, and circles by coordinates.

use super::*;
use cga2 as algebra;
use cga2::Infinity;
type Point = cga2::Point<Rational>;
type Circle = cga2::Circle<Rational>;
type Line = cga2::Line<Rational>;
type Round = cga2::Round<Rational>;
type Vector = cga2::Vector<Rational>;
type Rotor = cga2::Rotor<Rational>;
type Translator = cga2::Translator<Rational>;
type Dilator = cga2::Dilator<Rational>;
type FlatPoint = cga2::FlatPoint<Rational>;
type PointPair = cga2::PointPair<Rational>;
type DirectLine = cga2::DirectLine<Rational>;
type DirectCircle = cga2::DirectCircle<Rational>;
type Pseudoscalar = cga2::Pseudoscalar<Rational>;
type Motor = cga2::Motor<Rational>;
type Pose = cga2::Pose<Rational>;
type ConformalRotor = cga2::ConformalRotor<Rational>;
type Even = cga2::Even<Rational>;
type Odd = cga2::Odd<Rational>;
type Multivector = cga2::Multivector<Rational>;

integers!(Point Circle Round Vector Translator FlatPoint PointPair DirectLine DirectCircle Pseudoscalar Even Odd);
integers!(Multivector);
impl Sample for Infinity {
    fn sample(_: &mut Random) -> Self {
        Self
    }
}
impl Sample for Line {
    fn sample(random: &mut Random) -> Self {
        let [x, y] = unit_complex(random);
        Self::new(x, y, random.rational())
    }
}
impl Sample for Rotor {
    fn sample(random: &mut Random) -> Self {
        unit_complex(random).into()
    }
}
impl Sample for Dilator {
    fn sample(random: &mut Random) -> Self {
        let (a, b) = (5 + random.integer(), 5 + random.integer());
        Self::new(Rational::new(a, b), Rational::new(b, a))
    }
}
impl Sample for Motor {
    fn sample(random: &mut Random) -> Self {
        Translator::sample(random) * Rotor::sample(random)
    }
}
impl Sample for Pose {
    fn sample(random: &mut Random) -> Self {
        let (t, r) = (Translator::sample(random), Rotor::sample(random));
        Self::new(t.x, t.y, r.s, r.e12)
    }
}
impl Sample for ConformalRotor {
    fn sample(random: &mut Random) -> Self {
        // A transversion 1 + b no after a similarity.
        let transversion = Self { v1: random.rational(), v2: random.rational(), ..Self::default() };
        transversion * (Motor::sample(random) * Dilator::sample(random))
    }
}
checks!(cga2::Algebra);

/// The weight `-X . ninf` of a vector, unless it is 0; `ninf = e + ebar`.
fn weight(x: &Multi) -> Option<Rational> {
    let weight = x.coefficient(1 << 3) - x.coefficient(1 << 2);
    (weight != number(0)).then_some(weight)
}
/// The sandwich; for a type of weight 1 divided by its weight, which is what `apply` says.
fn image(versor: &Multi, x: &Multi, type_name: &str) -> Multi {
    let image = versor.apply(x);
    let weight = match type_name {
        "Point" | "Circle" => weight(&image),
        "Infinity" if [1, 2].iter().all(|blade| image.coefficient(*blade) == number(0)) => {
            Some(image.coefficient(1 << 3))
        }
        _ => None,
    };
    weight.map_or(image.clone(), |weight| image.scaled(number(1) / weight))
}
cga2::__operations!(check);

#[test]
fn every_operation_agrees() {
    let compared = compare_all();
    assert!(compared > 900, "only {compared} operations were compared");
}

fn collinear(a: Point, b: Point, c: Point) -> bool {
    (b.x - a.x) * (c.y - a.y) == (b.y - a.y) * (c.x - a.x)
}

fn is_centre(circle: Circle, p: Point) -> bool {
    (circle.x, circle.y) == (p.x, p.y)
}

twins! {
    circle_through circle_through_dynamic(a: Point, b: Point, c: Point) unless collinear(a, b, c);
    centre centre_dynamic(circle: Circle);
    invert invert_dynamic(circle: Circle, p: Point) unless is_centre(circle, p) || circle.rho_sq == number(0);
    power power_dynamic(p: Point, circle: Circle);
}

fn number(n: i128) -> Rational {
    Rational::new(n, 1)
}

fn distance_sq(x: Rational, y: Rational, p: Point) -> Rational {
    (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y)
}

#[test]
fn the_circle_through_three_points_passes_through_them() {
    let mut random = Random(29);
    let mut compared = 0;
    while compared < 20 {
        let [a, b, c] = [(); 3].map(|()| Point::sample(&mut random));
        if collinear(a, b, c) {
            continue;
        }
        let circle = cga2::circle_through(a, b, c);
        let centre = cga2::centre(circle);
        assert_eq!((centre.x, centre.y), (circle.x, circle.y));
        for p in [a, b, c] {
            assert_eq!(distance_sq(centre.x, centre.y, p), circle.rho_sq);
        }
        compared += 1;
    }
}

#[test]
fn an_inversion_keeps_the_ray_and_inverts_the_distance() {
    let mut random = Random(31);
    for _ in 0..20 {
        let (circle, p) = (Circle::sample(&mut random), Point::sample(&mut random));
        if is_centre(circle, p) || circle.rho_sq == number(0) {
            continue;
        }
        let image = cga2::invert(circle, p);
        let factor = circle.rho_sq / distance_sq(circle.x, circle.y, p);
        assert_eq!(image.x, circle.x + factor * (p.x - circle.x));
        assert_eq!(image.y, circle.y + factor * (p.y - circle.y));
        assert_eq!(cga2::power(p, circle), distance_sq(circle.x, circle.y, p) - circle.rho_sq);
    }
}

#[test]
fn a_dilator_scales_centres_and_radii() {
    let circle: cga2::Circle = cga2::Dilator::by(4.0).apply(cga2::Circle::new(1.0, -2.0, 9.0));
    // Powers of two: exact.
    assert_eq!((circle.x, circle.y, circle.rho_sq), (4.0, -8.0, 144.0));
}

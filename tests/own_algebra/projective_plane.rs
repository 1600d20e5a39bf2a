//! `examples/algebras/pga2.rs`: every operation, and lines and points by coordinates.

use super::*;
use pga2 as algebra;
type Line = pga2::Line<Rational>;
type Point = pga2::Point<Rational>;
type AnyPoint = pga2::AnyPoint<Rational>;
type Direction = pga2::Direction<Rational>;
type Motor = pga2::Motor<Rational>;
type Translator = pga2::Translator<Rational>;
type Even = pga2::Even<Rational>;
type Odd = pga2::Odd<Rational>;
type Pseudoscalar = pga2::Pseudoscalar<Rational>;
type Multivector = pga2::Multivector<Rational>;

integers!(Line Point AnyPoint Direction Translator Even Odd Pseudoscalar Multivector);
impl Sample for Motor {
    fn sample(random: &mut Random) -> Self {
        // e0 squares to 0: the ideal part is free.
        let [s, e12] = unit_complex(random);
        Self::new(s, e12, random.rational(), random.rational())
    }
}
checks!(pga2::Algebra);
fn image(versor: &Multi, x: &Multi, _type_name: &str) -> Multi {
    versor.apply(x)
}
pga2::__operations!(check);

#[test]
fn every_operation_agrees() {
    let compared = compare_all();
    assert!(compared > 200, "only {compared} operations were compared");
}

twins! {
    intersection intersection_dynamic(a: Line, b: Line);
    join join_dynamic(a: Point, b: Point);
    twice_area twice_area_dynamic(a: Point, b: Point, c: Point);
    foot foot_dynamic(p: Point, line: Line) unless line.norm_sq() == number(0);
    mirror mirror_dynamic(line: Line, p: Point) unless line.norm_sq() == number(0);
}

fn number(n: i128) -> Rational {
    Rational::new(n, 1)
}

fn point(x: i128, y: i128) -> Point {
    Point::new(number(x), number(y))
}

#[test]
fn two_lines_meet_where_they_should() {
    // x = 2 and y = 3, as x - 2 = 0 and y - 3 = 0.
    let (a, b) = (Line::new(number(1), number(0), number(-2)), Line::new(number(0), number(1), number(-3)));
    let meet = pga2::intersection(a, b);
    assert_eq!([meet.e12, meet.e20, meet.e01], [1, 2, 3].map(number));
}

#[test]
fn a_join_passes_through_both_points_and_is_positive_on_its_left() {
    let mut random = Random(11);
    for _ in 0..20 {
        let [p, q, r] = [(); 3].map(|()| Point::sample(&mut random));
        let line = pga2::join(p, q);
        // The normal is the direction, turned a quarter to the left.
        assert_eq!([line.e1, line.e2], [p.y - q.y, q.x - p.x]);
        let at = |x: Point| line.e1 * x.x + line.e2 * x.y + line.e0;
        assert_eq!((at(p), at(q)), (number(0), number(0)));
        let twice_area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
        assert_eq!((at(r), pga2::twice_area(p, q, r)), (twice_area, twice_area));
    }
    assert_eq!(p_and_q_swapped(), number(0), "a line and its reverse add up to nothing");
}

fn p_and_q_swapped() -> Rational {
    let (p, q) = (point(1, 2), point(-2, 5));
    let sum = pga2::join(p, q) + pga2::join(q, p);
    sum.e1 * sum.e1 + sum.e2 * sum.e2 + sum.e0 * sum.e0
}

#[test]
fn feet_and_mirror_images_in_a_slanting_line() {
    // y = x + 1, not normalised.
    let line = Line::new(number(3), number(-3), number(3));
    let (foot, image) = (pga2::foot(point(4, 1), line), pga2::mirror(line, point(4, 1)));
    assert_eq!(([foot.x, foot.y], [image.x, image.y]), ([2, 3].map(number), [0, 5].map(number)));
}

#[test]
fn a_motor_turns_about_its_centre() {
    let (centre, x) = (pga2::Point::new(2.0, 3.0), pga2::Point::new(4.0, 3.0));
    let motor = pga2::Motor::about(centre, std::f64::consts::FRAC_PI_2);
    let (kept, image): (pga2::Point, pga2::Point) = (motor.apply(centre), motor.apply(x));
    // A few roundings of numbers below 10.
    let near = |p: pga2::Point, x: f64, y: f64| (p.x - x).abs().max((p.y - y).abs()) <= 8.0 * f64::EPSILON * 10.0;
    assert!(near(kept, 2.0, 3.0) && near(image, 2.0, 5.0), "{kept}, {image}");
}

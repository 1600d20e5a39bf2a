//! Every generated operation of every type against the dynamic multivector, in exact arithmetic.
//!
//! The generated code works in the null basis, from programs that a compiler rewrote; the dynamic multivector works in
//! an orthonormal basis, from a table of signs. Types without facts are sampled with small integers, unit types with
//! exactly unit elements made as q²/|q|². Equality is exact.
#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test may panic")]

#[macro_use]
#[path = "support/operations.rs"]
mod operations;
#[path = "support/rational.rs"]
mod rational;

use ga_physics::algebra::dynamic::{Dynamic, ToDynamic};
use ga_physics::algebra::{cga, g3, split};
use ga_physics::geometry::formulas;
use operations::{Random, Sample};
use rational::Rational;

/// q²/|q|² of an integer quaternion: an exactly unit rotor.
fn unit_rotor(random: &mut Random) -> g3::Rotor<Rational> {
    let [w, x, y, z] = [4 + random.integer(), random.integer(), random.integer(), random.integer()];
    let norm = w * w + x * x + y * y + z * z;
    let part = |n| Rational::new(n, norm);
    g3::Rotor::new(part(w * w - x * x - y * y - z * z), part(2 * w * x), part(2 * w * y), part(2 * w * z))
}

fn unit_translator(random: &mut Random) -> cga::Translator<Rational> {
    cga::Translator::from_fn(|_| random.rational())
}

macro_rules! constants {
    ($($name:ident)*) => {$(
        impl Sample for $name { fn sample(_: &mut Random) -> Self { Self } }
    )*};
}

mod euclidean {
    use super::*;
    use g3 as algebra;
    type Vector = g3::Vector<Rational>;
    type Bivector = g3::Bivector<Rational>;
    type Trivector = g3::Trivector<Rational>;
    type Rotor = g3::Rotor<Rational>;
    type Even = g3::Even<Rational>;
    type Odd = g3::Odd<Rational>;
    type Multivector = g3::Multivector<Rational>;

    integers!(Vector Bivector Trivector Even Odd Multivector);
    impl Sample for Rotor {
        fn sample(random: &mut Random) -> Self {
            unit_rotor(random)
        }
    }
    checks!(g3::Algebra);
    fn image(versor: &Multi, x: &Multi, _type_name: &str) -> Multi {
        versor.apply(x)
    }
    g3::__operations!(check);

    #[test]
    fn every_operation_of_g3_agrees_with_the_dynamic_multivector() {
        let compared = compare_all();
        println!("{compared} operations");
        assert!(compared > 100, "only {compared} operations were compared");
    }
}

mod conformal {
    use super::*;
    use cga as algebra;
    use cga::{Infinity, Origin};
    type Vector = g3::Vector<Rational>;
    type Bivector = g3::Bivector<Rational>;
    type Trivector = g3::Trivector<Rational>;
    type Rotor = g3::Rotor<Rational>;
    type Point = cga::Point<Rational>;
    type Sphere = cga::Sphere<Rational>;
    type Plane = cga::Plane<Rational>;
    type FinitePoint = cga::FinitePoint<Rational>;
    type FlatPoint = cga::FlatPoint<Rational>;
    type Round = cga::Round<Rational>;
    type Translator = cga::Translator<Rational>;
    type Dilator = cga::Dilator<Rational>;
    type DualLine = cga::DualLine<Rational>;
    type Line = cga::Line<Rational>;
    type Twist = cga::Twist<Rational>;
    type PointPair = cga::PointPair<Rational>;
    type Circle = cga::Circle<Rational>;
    type DirectPlane = cga::DirectPlane<Rational>;
    type DirectSphere = cga::DirectSphere<Rational>;
    type Pseudoscalar = cga::Pseudoscalar<Rational>;
    type Motor = cga::Motor<Rational>;
    type Pose = cga::Pose<Rational>;
    type ConformalRotor = cga::ConformalRotor<Rational>;
    type Even = cga::Even<Rational>;
    type Odd = cga::Odd<Rational>;
    type Multivector = cga::Multivector<Rational>;

    integers!(Point Sphere FinitePoint FlatPoint Round DualLine Line Twist PointPair Circle DirectPlane DirectSphere);
    integers!(Pseudoscalar Even Odd Multivector);
    constants!(Infinity Origin);
    impl Sample for Translator {
        fn sample(random: &mut Random) -> Self {
            unit_translator(random)
        }
    }
    impl Sample for Motor {
        fn sample(random: &mut Random) -> Self {
            unit_translator(random) * unit_rotor(random)
        }
    }
    impl Sample for Pose {
        fn sample(random: &mut Random) -> Self {
            let (t, r) = (unit_translator(random), unit_rotor(random));
            Self { x: t.x, y: t.y, z: t.z, s: r.s, e23: r.e23, e31: r.e31, e12: r.e12 }
        }
    }
    impl Sample for ConformalRotor {
        fn sample(random: &mut Random) -> Self {
            // A transversion 1 + b no after a similarity.
            let mut transversion = Self::default();
            [transversion.v1, transversion.v2, transversion.v3] = [(); 3].map(|()| random.rational());
            let motion = unit_translator(random) * unit_rotor(random);
            transversion * (motion * Dilator::sample(random))
        }
    }
    impl Sample for Dilator {
        fn sample(random: &mut Random) -> Self {
            let (a, b) = (5 + random.integer(), 5 + random.integer());
            Self::new(Rational::new(a, b), Rational::new(b, a))
        }
    }
    impl Sample for Plane {
        fn sample(random: &mut Random) -> Self {
            // Stereographic projection of an integer point: a rational unit normal.
            let (p, q) = (random.integer(), random.integer());
            let part = |n| Rational::new(n, p * p + q * q + 1);
            Self::new(part(2 * p), part(2 * q), part(p * p + q * q - 1), random.rational())
        }
    }
    checks!(cga::Algebra);

    /// The weight `-X . ninf` of a vector, unless it is 0; `ninf = e + ebar`.
    fn weight(x: &Multi) -> Option<Rational> {
        let weight = x.coefficient(1 << 4) - x.coefficient(1 << 3);
        (weight != Rational::new(0, 1)).then_some(weight)
    }
    /// The weight of a flat point, unless it is 0 or none: X ^ ninf is moved off itself by an inversion.
    fn finite_weight(x: &Multi) -> Option<Rational> {
        let weight = -x.coefficient(0b11000);
        let zero = Rational::new(0, 1);
        let flat = [1, 2, 4].iter().all(|blade| x.coefficient(blade | 8) == x.coefficient(blade | 16));
        (flat && x.grade(2) == *x && weight != zero).then_some(weight)
    }
    /// The sandwich; for a type of weight 1 divided by its weight, which is what `apply` says.
    fn image(versor: &Multi, x: &Multi, type_name: &str) -> Multi {
        let image = versor.apply(x);
        let weight = match type_name {
            "Point" | "Sphere" | "Origin" => weight(&image),
            // The coefficient of no_ninf = -(e ebar): of a flat point of weight 1.
            "FinitePoint" => finite_weight(&image),
            "Infinity" if [1, 2, 4].iter().all(|blade| image.coefficient(*blade) == Rational::new(0, 1)) => {
                Some(image.coefficient(1 << 4))
            }
            _ => None,
        };
        weight.map_or(image.clone(), |weight| image.scaled(Rational::new(1, 1) / weight))
    }
    cga::__operations!(check);

    #[test]
    fn every_operation_of_cga_agrees_with_the_dynamic_multivector() {
        let compared = compare_all();
        println!("{compared} operations");
        assert!(compared > 1500, "only {compared} operations were compared");
    }

    #[test]
    fn products_in_the_split_basis_are_those_of_the_table() {
        let mut random = Random(7);
        for _ in 0..20 {
            let [a, b] = [(); 2].map(|()| Even::sample(&mut random));
            assert_eq!(split::even_product(a, b), a * b);
            let [a, b] = [(); 2].map(|()| Multivector::sample(&mut random));
            assert_eq!(split::multivector_product(a, b), a * b);
        }
    }

    #[test]
    fn poses_and_motors_are_the_same_motions() {
        let mut random = Random(8);
        for _ in 0..20 {
            let [a, b] = [(); 2].map(|()| Pose::sample(&mut random));
            let x = Point::sample(&mut random);
            assert_eq!(Pose::from(Motor::from(a)), a);
            assert_eq!(Motor::from(a * b), Motor::from(a) * Motor::from(b));
            assert_eq!(a.apply(x), Motor::from(a).apply(x));
            assert_eq!(Pose::from_parts(a.translation(), a.rotor()), a);
            assert_eq!(a.position(), a.apply(Origin));
        }
    }

    #[test]
    fn balls_reach_as_far_as_their_radii() {
        let number = |n| Rational::new(n, 1);
        let [a, b] = [[1, 2, 3], [4, 6, 15]].map(|x| Point::from(x.map(number)));
        let found = formulas::ball_reach_and_distance_sq(a, number(6), b, number(8));
        assert_eq!(found, (number(196), number(169)));
        let [x, y] = [a, b].map(|point| point.to_dynamic());
        let scalar = |n| Multi::from_terms(&[(0, number(n))]);
        let twin = formulas::ball_reach_and_distance_sq_dynamic(&x, &scalar(6), &y, &scalar(8));
        assert!(twin == (scalar(196), scalar(169)));
    }

    /// Each formula against its twin over the dynamic multivector: the same source, product by product and in the world.
    /// A relative result is compared with the twin's seen from the first operand; operands for which the twin has no
    /// value, because it divides by zero, are passed over.
    macro_rules! formulas {
        ($($frame:ident $name:ident $twin:ident($($operand:ident: $ty:ident),*) $(unless $undefined:ident)?;)*) => {$(
            #[test]
            fn $name() {
                let mut random = Random(stringify!($name).bytes().map(u64::from).sum());
                let mut compared = 0;
                for _ in 0..60 {
                    $(let $operand = $ty::sample(&mut random);)*
                    let operands = ($($operand,)*);
                    $(if $undefined(operands) { continue; })?
                    let expected = formulas::$twin($(&$operand.to_dynamic()),*);
                    let actual = formulas::$name($($operand),*).to_dynamic();
                    let expected = $frame(&expected, operands.0);
                    assert!(actual == expected, "{:?} give {actual:?}, expected {expected:?}", operands);
                    compared += 1;
                }
                assert!(compared > 30, "only {compared} samples were compared");
            }
        )*};
    }

    /// `~T x T` with the translator of a point: x seen from there.
    fn relative(x: &Multi, origin: Point) -> Multi {
        let displacement = g3::Vector::new(origin.x, origin.y, origin.z);
        let back: Multi = cga::Translator::by(displacement).rev().to_dynamic();
        &(&back * x) * &back.rev()
    }

    fn world<X>(x: &Multi, _first: X) -> Multi {
        x.clone()
    }

    /// Four points in a plane have no sphere.
    fn coplanar((a, b, c, d): (Point, Point, Point, Point)) -> bool {
        let [a, b, c, d] = [a, b, c, d].map(|point| point.to_dynamic());
        weight(&formulas::circumsphere_relative_dynamic(&a, &b, &c, &d)).is_none()
    }

    /// Three points on a line have no circle.
    fn collinear((a, b, c): (Point, Point, Point)) -> bool {
        let [a, b, c] = [a, b, c].map(|point| point.to_dynamic());
        weight(&formulas::circle_sphere_relative_dynamic(&a, &b, &c)).is_none()
    }

    /// A line parallel to the plane does not meet it.
    fn parallel((_, u, plane): (Point, Vector, Plane)) -> bool {
        u.e1 * plane.e1 + u.e2 * plane.e2 + u.e3 * plane.e3 == Rational::new(0, 1)
    }

    fn blade_parallel((line, plane): (Line, Plane)) -> bool {
        (plane | line).no_ninf == Rational::new(0, 1)
    }

    /// The inverse of the centre is at infinity.
    fn is_centre((x, sphere): (Point, Sphere)) -> bool {
        [x.x, x.y, x.z] == [sphere.x, sphere.y, sphere.z]
    }

    formulas! {
        world circumsphere circumsphere_dynamic(a: Point, b: Point, c: Point, d: Point) unless coplanar;
        relative circumsphere_relative circumsphere_relative_dynamic(a: Point, b: Point, c: Point, d: Point);
        world circle_sphere circle_sphere_dynamic(a: Point, b: Point, c: Point) unless collinear;
        world ray_meets_plane ray_meets_plane_dynamic(p: Point, u: Vector, plane: Plane) unless parallel;
        world line_blade_meets_plane line_blade_meets_plane_dynamic(line: Line, plane: Plane) unless blade_parallel;
        relative circle_sphere_relative circle_sphere_relative_dynamic(a: Point, b: Point, c: Point);
        world pair_sphere pair_sphere_dynamic(a: Point, b: Point);
        relative plane_relative plane_relative_dynamic(a: Point, b: Point, c: Point);
        relative line_relative line_relative_dynamic(a: Point, b: Point);
        relative line_meets_plane_relative line_meets_plane_relative_dynamic(a: Point, b: Point, plane: Plane);
        relative reciprocal_relative reciprocal_relative_dynamic(a: Point, b: Point, c: Point);
        world reflect_in_plane reflect_in_plane_dynamic(x: Point, plane: Plane);
        relative reflect_in_line_relative reflect_in_line_relative_dynamic(x: Point, line: Line);
        relative reflect_in_circle_relative reflect_in_circle_relative_dynamic(x: Point, circle: Circle);
        world circle_centre circle_centre_dynamic(circle: Circle);
        world reflect_in_sphere reflect_in_sphere_dynamic(x: Point, sphere: Sphere) unless is_centre;
    }
}

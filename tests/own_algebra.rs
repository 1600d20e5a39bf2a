//! Algebras that a user declares, outside of the library: they compile, and all their operations agree with the dynamic
//! multivector, exactly. A degenerate metric (2D projective geometry), an indefinite one (spacetime), the smallest
//! useful one, one whose names are awkward, and one that extends the library's G(3,0) from outside.
#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test may panic")]

#[macro_use]
#[path = "support/operations.rs"]
mod operations;
#[path = "support/rational.rs"]
mod rational;

use ga_physics::algebra::dynamic::{Dynamic, ToDynamic};
use operations::{Random, Sample};
use rational::Rational;

/// The projective plane: lines are vectors, points bivectors.
mod pga2 {
    ga_physics::algebra! {
        pub algebra pga2;
        basis e0 = 0, e1 = 1, e2 = 1;
        pseudoscalar e012;

        /// `a x + b y + c = 0` as `a e1 + b e2 + c e0`.
        type Line = [e0, e1, e2];
        /// A point of any weight.
        type Point = [e12, e20, e01];
        /// A rigid motion of the plane.
        type Motor: unit + versor = [s, e12, e20, e01];
        /// A translation.
        type Translator: unit + versor = [s = 1, e20, e01];
        /// An even multivector.
        type Even = [s, e12, e20, e01];
        /// An odd multivector.
        type Odd = [e0, e1, e2, e012];
        /// A multiple of the pseudoscalar, which squares to 0.
        type Pseudoscalar = [e012];
        /// A general multivector.
        type Multivector = [s, e0, e1, e2, e12, e20, e01, e012];
    }

    /// Where two lines meet.
    #[ga_physics::formula(self)]
    pub fn meet_lines(a: Line, b: Line) -> Point {
        a ^ b
    }
}

/// Spacetime, signature (+, -, -, -).
mod spacetime {
    ga_physics::algebra! {
        pub algebra spacetime;
        basis e0 = 1, e1 = -1, e2 = -1, e3 = -1;
        pseudoscalar e0123;

        /// An event.
        type Vector = [e0, e1, e2, e3];
        /// The electromagnetic field.
        type Bivector = [e10, e20, e30, e23, e31, e12];
        /// A Lorentz transformation.
        type Rotor: unit + versor = [s, e10, e20, e30, e23, e31, e12, e0123];
        /// An even multivector.
        type Even = [s, e10, e20, e30, e23, e31, e12, e0123];
        /// A trivector.
        type Trivector = [e123, e023, e031, e012];
        /// An odd multivector.
        type Odd = [e0, e1, e2, e3, e123, e023, e031, e012];
        /// A multiple of the pseudoscalar.
        type Pseudoscalar = [e0123];
        /// A general multivector.
        type Multivector = [
            s, e0, e1, e2, e3, e10, e20, e30, e23, e31, e12, e123, e023, e031, e012, e0123,
        ];
    }
}

/// The plane, with names that Rust and the generator use themselves, and no general multivector.
mod plane {
    ga_physics::algebra! {
        pub algebra plane;
        basis x = 1, y = 1;
        pseudoscalar x_y;

        type Vector = [x, y];
        type Bivector = [x_y];
        type Rotor: unit + versor = [s, x_y];
        /// Twice the first number along x, and the square of the second along y.
        type Derived = 2 * r#type * x + T * T / 3 * y;
        type Complex = [s, x_y];
    }

    /// A step is called `norm` as well.
    #[ga_physics::formula(self)]
    pub fn direction(norm: Vector) -> Vector {
        norm.normalised()
    }
}

/// The conformal line, with a null pair whose inner product is +1: there the point is `o + x e1 - x²/2 i`.
mod line {
    ga_physics::algebra! {
        pub algebra line;
        basis e1 = 1, null pair (o, i) = 1;
        pseudoscalar -e1_o_i;

        type Point = x * e1 + o - x * x / 2 * i;
        type Vector = [e1, o, i];
        type Bivector = [e1_o, e1_i, o_i];
        type Translator: unit + versor = [s = 1, e1_i];
        type Even = [s, e1_o, e1_i, o_i];
        type Odd = [e1, o, i, e1_o_i];
    }

    #[ga_physics::formula(self)]
    pub fn middle(a: Point, b: Point) -> Vector {
        (a + b) / 2
    }
}

/// Space with a plane at infinity: G(3,0,1) on the library's vectors and rotors.
mod pga3 {
    ga_physics::algebra! {
        pub algebra pga3 extends ga_physics::algebra::g3;
        basis e0 = 0;
        pseudoscalar e1230;

        type Plane = [e1, e2, e3, e0];
        type Line = [e23, e31, e12, e10, e20, e30];
        type Point = [e123, e230, e310, e120];
        type Translator: unit + versor = [s = 1, e10, e20, e30];
        type Motor: unit + versor = [s, e23, e31, e12, e10, e20, e30, e1230];
        type Even = [s, e23, e31, e12, e10, e20, e30, e1230];
        type Odd = [e1, e2, e3, e0, e123, e230, e310, e120];
        type Multivector = [
            s, e1, e2, e3, e0, e23, e31, e12, e10, e20, e30, e123, e230, e310, e120, e1230,
        ];
    }
}

/// q²/|q|² of an integer complex number: an exactly unit one.
fn unit_complex(random: &mut Random) -> [Rational; 2] {
    let (a, b) = (4 + random.integer(), random.integer());
    let norm = a * a + b * b;
    [Rational::new(a * a - b * b, norm), Rational::new(2 * a * b, norm)]
}

/// The same for a quaternion.
fn unit_quaternion(random: &mut Random) -> [Rational; 4] {
    let [w, x, y, z] = [4 + random.integer(), random.integer(), random.integer(), random.integer()];
    let norm = w * w + x * x + y * y + z * z;
    [w * w - x * x - y * y - z * z, 2 * w * x, 2 * w * y, 2 * w * z].map(|n| Rational::new(n, norm))
}

mod projective_plane {
    use super::*;
    type Line = pga2::Line<Rational>;
    type Point = pga2::Point<Rational>;
    type Motor = pga2::Motor<Rational>;
    type Translator = pga2::Translator<Rational>;
    type Even = pga2::Even<Rational>;
    type Odd = pga2::Odd<Rational>;
    type Pseudoscalar = pga2::Pseudoscalar<Rational>;
    type Multivector = pga2::Multivector<Rational>;

    integers!(Line Point Translator Even Odd Pseudoscalar Multivector);
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
        assert!(compare_all() > 100);
    }

    #[test]
    fn two_lines_meet_where_they_should() {
        // x = 2 and y = 3, as x - 2 = 0 and y - 3 = 0; a point is w e12 + x e20 + y e01.
        let number = |n| Rational::new(n, 1);
        let (a, b) = (Line::new(number(-2), number(1), number(0)), Line::new(number(-3), number(0), number(1)));
        let meet = pga2::meet_lines(a, b);
        assert_eq!([meet.e12, meet.e20, meet.e01], [1, 2, 3].map(number));
        assert_eq!(meet.to_dynamic(), &a.to_dynamic() ^ &b.to_dynamic());
    }
}

mod space_and_time {
    use super::*;
    use spacetime as algebra;
    type Vector = spacetime::Vector<Rational>;
    type Bivector = spacetime::Bivector<Rational>;
    type Rotor = spacetime::Rotor<Rational>;
    type Even = spacetime::Even<Rational>;
    type Trivector = spacetime::Trivector<Rational>;
    type Odd = spacetime::Odd<Rational>;
    type Pseudoscalar = spacetime::Pseudoscalar<Rational>;
    type Multivector = spacetime::Multivector<Rational>;

    integers!(Vector Bivector Even Trivector Odd Pseudoscalar Multivector);
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
        assert!(compare_all() > 150);
    }

    #[test]
    fn a_boost_keeps_the_interval() {
        let mut random = Random(3);
        for _ in 0..20 {
            let (rotor, event) = (Rotor::sample(&mut random), Vector::sample(&mut random));
            let image: Vector = rotor.apply(event);
            let interval = |v: Vector| v.e0 * v.e0 - v.e1 * v.e1 - v.e2 * v.e2 - v.e3 * v.e3;
            assert_eq!(interval(image), interval(event));
        }
    }
}

mod smallest {
    use super::*;
    use plane as algebra;
    type Vector = plane::Vector<Rational>;
    type Bivector = plane::Bivector<Rational>;
    type Rotor = plane::Rotor<Rational>;
    type Derived = plane::Derived<Rational>;
    type Complex = plane::Complex<Rational>;

    integers!(Vector Bivector Derived Complex);
    impl Sample for Rotor {
        fn sample(random: &mut Random) -> Self {
            unit_complex(random).into()
        }
    }
    checks!(plane::Algebra);
    fn image(versor: &Multi, x: &Multi, _type_name: &str) -> Multi {
        versor.apply(x)
    }
    plane::__operations!(check);

    #[test]
    fn every_operation_agrees() {
        assert!(compare_all() > 40);
    }

    #[test]
    fn a_parameter_may_be_called_like_a_step() {
        let number = |n, d| Rational::new(n, d);
        let unit = plane::direction(Vector::new(number(3, 1), number(-4, 1)));
        assert_eq!((unit.x, unit.y), (number(3, 5), number(-4, 5)));
    }
}

mod conformal_line {
    use super::*;
    use line as algebra;
    type Point = line::Point<Rational>;
    type Vector = line::Vector<Rational>;
    type Bivector = line::Bivector<Rational>;
    type Translator = line::Translator<Rational>;
    type Even = line::Even<Rational>;
    type Odd = line::Odd<Rational>;

    integers!(Point Vector Bivector Translator Even Odd);
    checks!(line::Algebra);
    fn image(versor: &Multi, x: &Multi, _type_name: &str) -> Multi {
        versor.apply(x)
    }
    line::__operations!(check);

    #[test]
    fn every_operation_agrees() {
        assert!(compare_all() > 80);
    }

    #[test]
    fn points_are_null_and_their_product_is_a_distance() {
        let (a, b) = (Point::new(Rational::new(7, 2)), Point::new(Rational::new(-3, 1)));
        // -(7/2 + 3)²/2
        assert_eq!(a | b, Rational::new(-169, 8));
        assert_eq!(&a.to_dynamic() * &a.to_dynamic(), Dynamic::from_terms(&[]));
        let [e1, o, i]: [Rational; 3] = line::middle(a, b).into();
        assert_eq!([e1, o, i], [Rational::new(1, 4), Rational::new(1, 1), Rational::new(-85, 16)]);
    }
}

mod extended {
    use super::*;
    use ga_physics::algebra::g3;
    type Vector = g3::Vector<Rational>;
    type Bivector = g3::Bivector<Rational>;
    type Trivector = g3::Trivector<Rational>;
    type Rotor = g3::Rotor<Rational>;
    type Plane = pga3::Plane<Rational>;
    type Line = pga3::Line<Rational>;
    type Point = pga3::Point<Rational>;
    type Translator = pga3::Translator<Rational>;
    type Motor = pga3::Motor<Rational>;
    type Even = pga3::Even<Rational>;
    type Odd = pga3::Odd<Rational>;
    type Multivector = pga3::Multivector<Rational>;

    integers!(Vector Bivector Trivector Plane Line Point Translator Even Odd Multivector);
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
        assert!(compare_all() > 300);
    }

    #[test]
    fn a_rotor_of_the_base_turns_what_the_extension_declares() {
        let number = |n| Rational::new(n, 1);
        // A half turn in the plane e12: x = 1 becomes x = -1, with the normal turned as well.
        let half = g3::Rotor::new(number(0), number(0), number(0), number(-1));
        let plane = Plane::new(number(1), number(0), number(0), number(-1));
        let image: Plane = half.apply(plane);
        assert_eq!([image.e1, image.e2, image.e3, image.e0], [-1, 0, 0, -1].map(number));
    }
}

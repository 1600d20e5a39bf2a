//! Algebras that a user declares, outside of the library: they compile, and all their operations agree with the dynamic
//! multivector, exactly. Those of `examples/algebras`, each in a module of its own here: degenerate metrics, of which one
//! extends the library's G(3,0), an indefinite one, the smallest useful one, a conformal one. And two that show no user
//! anything: one whose names are awkward, and a null pair with the product +1.
#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test may panic")]

#[macro_use]
#[path = "support/operations.rs"]
mod operations;
#[path = "support/rational.rs"]
mod rational;

#[path = "../examples/algebras/cga2.rs"]
mod cga2;
#[path = "../examples/algebras/g2.rs"]
mod g2;
#[path = "../examples/algebras/pga2.rs"]
mod pga2;
#[path = "../examples/algebras/pga3.rs"]
mod pga3;
#[path = "../examples/algebras/spacetime.rs"]
mod spacetime;

use ga_physics::algebra::dynamic::{Dynamic, ToDynamic};
use operations::{Random, Sample};
use rational::Rational;

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

/// Each formula against its twin over the dynamic multivector, on twenty samples; those for which the twin divides by
/// zero are passed over by `unless`.
macro_rules! twins {
    ($($name:ident $twin:ident($($operand:ident: $ty:ident),*) $(unless $undefined:expr)?;)*) => {$(
        #[test]
        fn $name() {
            let mut random = Random(stringify!($name).bytes().map(u64::from).sum());
            let mut compared = 0;
            while compared < 20 {
                $(let $operand = $ty::sample(&mut random);)*
                $(if $undefined { continue; })?
                let expected = algebra::$twin($(&$operand.to_dynamic()),*);
                let actual = algebra::$name($($operand),*).to_dynamic();
                assert!(actual == expected, "{:?} give {actual:?}, expected {expected:?}", ($($operand,)*));
                compared += 1;
            }
        }
    )*};
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

#[path = "own_algebra/circles.rs"]
mod circles;
#[path = "own_algebra/complex_numbers.rs"]
mod complex_numbers;
#[path = "own_algebra/projective_plane.rs"]
mod projective_plane;
#[path = "own_algebra/projective_space.rs"]
mod projective_space;
#[path = "own_algebra/regressive.rs"]
mod regressive;
#[path = "own_algebra/space_and_time.rs"]
mod space_and_time;

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

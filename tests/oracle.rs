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
use ga_physics::algebra::{cga, g3};
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

    integers!(Point Sphere FlatPoint Round DualLine Line Twist PointPair Circle DirectPlane DirectSphere);
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
    /// The sandwich; for a type of weight 1 divided by its weight, which is what `apply` says.
    fn image(versor: &Multi, x: &Multi, type_name: &str) -> Multi {
        let image = versor.apply(x);
        let weight = match type_name {
            "Point" | "Sphere" | "Origin" => weight(&image),
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

    /// `~T x T` with the translator of a point: x seen from there.
    fn seen_from(origin: Point, x: &Multi) -> Multi {
        let displacement = g3::Vector::new(origin.x, origin.y, origin.z);
        let back: Multi = cga::Translator::by(displacement).rev().to_dynamic();
        &(&back * x) * &back.rev()
    }

    /// Kernels are whole formulas, in the local frame of their first point: each against the same formula, product by
    /// product, in the world, and then moved there.
    #[test]
    fn every_relative_kernel_agrees_with_its_formula() {
        let mut random = Random(11);
        let ninf: Multi = Infinity.to_dynamic();
        for _ in 0..50 {
            let points: [Point; 4] = std::array::from_fn(|_| Point::sample(&mut random));
            let [p, q, r, t] = points;
            let [a, b, c, d] = points.map(|point| point.to_dynamic());
            let (plane, line, circle) =
                (Plane::sample(&mut random), Line::sample(&mut random), Circle::sample(&mut random));
            let check = |name: &str, kernel: Multi, formula: &Multi| {
                assert!(kernel == seen_from(p, formula), "{name} of {points:?}: {kernel:?}");
            };
            let dual = |x: &Multi| x.dual().unwrap();
            let (wedge3, flat) = (&(&a ^ &b) ^ &c, &(&(&a ^ &b) ^ &c) ^ &ninf);
            check(
                "circumsphere_relative",
                formulas::circumsphere_relative(p, q, r, t).to_dynamic(),
                &dual(&(&wedge3 ^ &d)),
            );
            let sphere = dual(&(&wedge3 ^ &dual(&(&wedge3 ^ &ninf))));
            check("circle_sphere_relative", formulas::circle_sphere_relative(p, q, r).to_dynamic(), &sphere);
            check("plane_relative", formulas::plane_relative(p, q, r).to_dynamic(), &dual(&flat));
            check("line_relative", formulas::line_relative(p, q).to_dynamic(), &(&(&a ^ &b) ^ &ninf));
            let meet = &plane.to_dynamic() | &(&(&a ^ &b) ^ &ninf);
            check("line_meets_plane_relative", formulas::line_meets_plane_relative(p, q, plane).to_dynamic(), &meet);
            let reciprocal = -&(&(&ninf ^ &(&b ^ &c)) | &flat);
            check("reciprocal_relative", formulas::reciprocal_relative(p, q, r).to_dynamic(), &reciprocal);
            let image = |m: &Multi| (&(m * &a) * m).grade(1);
            check(
                "reflect_in_line_relative",
                formulas::reflect_in_line_relative(p, line).to_dynamic(),
                &image(&line.to_dynamic()),
            );
            let in_circle = formulas::reflect_in_circle_relative(p, circle).to_dynamic();
            check("reflect_in_circle_relative", in_circle, &image(&circle.to_dynamic()));
        }
    }

    #[test]
    fn every_other_kernel_agrees_with_its_formula() {
        let mut random = Random(12);
        let (ninf, half): (Multi, Rational) = (Infinity.to_dynamic(), Rational::new(1, 2));
        for _ in 0..50 {
            let points: [Point; 2] = std::array::from_fn(|_| Point::sample(&mut random));
            let [a, b] = points.map(|point| point.to_dynamic());
            let pair = &(&a + &b).scaled(half) + &(&(&a | &b) * &ninf).scaled(half);
            assert!(formulas::pair_sphere(points[0], points[1]).to_dynamic() == pair);
            let (plane, sphere, circle) =
                (Plane::sample(&mut random), Sphere::sample(&mut random), Circle::sample(&mut random));
            let image = |m: Multi| &(&m * &a) * &m;
            let normalised = |x: &Multi| weight(x).map(|w| x.scaled(Rational::new(1, 1) / w));
            let mirrored = normalised(&image(plane.to_dynamic())).unwrap();
            assert!(formulas::reflect_in_plane(points[0], plane).to_dynamic() == mirrored);
            if let Some(inverse) = normalised(&image(sphere.to_dynamic())) {
                assert!(formulas::reflect_in_sphere(points[0], sphere).to_dynamic() == inverse);
            }
            let k = circle.to_dynamic();
            assert!(formulas::circle_centre(circle).to_dynamic() == (&(&k * &ninf) * &k).grade(1));
        }
    }

    #[test]
    fn the_sphere_kernel_agrees_with_the_wedge() {
        let mut random = Random(7);
        let mut spheres = 0;
        for _ in 0..200 {
            let points: [Point; 4] = std::array::from_fn(|_| Point::sample(&mut random));
            let [a, b, c, d] = points.map(|point| point.to_dynamic());
            let wedge = (&(&(&a ^ &b) ^ &c) ^ &d).dual().unwrap();
            if let Some(weight) = weight(&wedge) {
                let expected = wedge.scaled(Rational::new(1, 1) / weight);
                let [a, b, c, d] = points;
                assert!(formulas::circumsphere(a, b, c, d).to_dynamic() == expected);
                spheres += 1;
            }
        }
        assert!(spheres > 100, "only {spheres} of the samples span space");
    }
}

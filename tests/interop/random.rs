//! rand: values are valid, and spread as the documentation says.

use crate::pga;
use ga_physics::algebra::cga::{Motor, Plane, Point, Pose, Sphere, Translator};
use ga_physics::algebra::g3::{Rotor, Vector};
use rand::distr::{Distribution, StandardUniform};
use rand_pcg::Pcg64;

const DRAWS: usize = 40_000;

/// Five standard deviations of the mean of `DRAWS` numbers of variance at most 1: a fixed seed cannot fail by chance, and a
/// wrong distribution is off by far more.
const NEAR: f64 = 5.0 / 200.0;

fn draw<V>() -> impl Iterator<Item = V>
where
    StandardUniform: Distribution<V>,
{
    StandardUniform.sample_iter(Pcg64::new(7, 11)).take(DRAWS)
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    values.sum::<f64>() / DRAWS as f64
}

#[test]
fn rotors_are_unit_and_uniform() {
    assert!(draw::<Rotor>().all(|rotor| rotor.is_unit(4.0 * f64::EPSILON)));
    assert!(draw::<Rotor<f32>>().all(|rotor| rotor.is_unit(4.0 * f32::EPSILON)));
    // On the sphere in four dimensions x² has the mean 1/4 and x⁴ the mean 1/8; products of two numbers have none.
    for i in 0..4 {
        let number = |rotor: Rotor| <[f64; 4]>::from(rotor)[i];
        assert!(mean(draw().map(number)).abs() < NEAR);
        assert!((mean(draw().map(|r| number(r).powi(2))) - 0.25).abs() < NEAR / 4.0);
        assert!((mean(draw().map(|r| number(r).powi(4))) - 0.125).abs() < NEAR / 4.0);
        for j in 0..i {
            assert!(mean(draw().map(|r: Rotor| number(r) * <[f64; 4]>::from(r)[j])).abs() < NEAR / 2.0);
        }
    }
    // The law of the angle, (phi - sin phi)/pi: half of all rotations turn by more than 2.3099 rad, where that is 1/2.
    let small = mean(draw().map(|r: Rotor| f64::from(r.s.abs() > (2.309_881_46f64 / 2.0).cos())));
    assert!((small - 0.5).abs() < NEAR, "{small}");
}

#[test]
fn normals_are_unit_and_uniform() {
    // Archimedes: each part of a uniform direction in space is uniform between -1 and 1.
    for bound in [-0.8, -0.3, 0.0, 0.5, 0.9] {
        let below = mean(draw().map(|plane: Plane| f64::from(plane.e3 < bound)));
        assert!((below - (1.0 + bound) / 2.0).abs() < NEAR, "{below} below {bound}");
    }
    assert!(draw().all(|plane: Plane| plane.is_unit(4.0 * f64::EPSILON) && (0.0..1.0).contains(&plane.ninf)));
}

#[test]
fn translations_and_motors_move_by_numbers_from_0_to_1() {
    let in_cube = |v: Vector| <[f64; 3]>::from(v).iter().all(|x| (-1e-15..1.0 + 1e-15).contains(x));
    assert!(draw().all(|translator: Translator| in_cube(translator.displacement())));
    assert!(draw().all(|motor: Motor| in_cube(motor.translation()) && motor.is_unit(8.0 * f64::EPSILON)));
    assert!(draw().all(|p: Pose| in_cube(Vector::new(p.x, p.y, p.z)) && p.is_unit(8.0 * f64::EPSILON)));
    assert!((mean(draw().map(|motor: Motor| motor.translation().e2)) - 0.5).abs() < NEAR);
}

#[test]
fn other_numbers_are_from_0_to_1() {
    assert!(draw().all(|p: Point| <[f64; 3]>::from(p).iter().all(|x| (0.0..1.0).contains(x))));
    assert!(draw().all(|sphere: Sphere| sphere.radius().is_ok()));
}

#[test]
fn types_of_a_users_algebra_are_drawn_as_well() {
    assert!(draw().all(|turn: pga::Turn| turn.is_unit(4.0 * f64::EPSILON)));
    assert!(draw().all(|line: pga::Unit<f32>| line.is_unit(4.0 * f32::EPSILON) && (0.0..1.0).contains(&line.e0)));
    let quadrant = mean(draw().map(|turn: pga::Turn| f64::from(turn.s > 0.0 && turn.e12 > 0.0)));
    assert!((quadrant - 0.25).abs() < NEAR);
    assert!(draw().all(|point: pga::Point<f32>| (0.0..1.0).contains(&point.x)));
    // Motor, Translator and Boost have no implementation: that is a property of the types, see `emit::interop`.
}

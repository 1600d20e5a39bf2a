//! Versors: dilations by split storage against wedge storage, versors that are not quite unit, rotors applied many times.

use crate::exact::{Big, Exact, big, distance, ratio};
use crate::{Random, Table};
use ga_physics::algebra::Real;
use ga_physics::algebra::cga::{ConformalRotor, Dilator, Even, Odd, Point, Round, Translator};
use ga_physics::algebra::g3::{Rotor, Vector};
use num_traits::ToPrimitive;

/// Integer quaternions with integer norms: rotors that are exactly unit as rationals.
const ROTORS: [([i64; 4], i64); 4] = [([1, 2, 2, 4], 5), ([2, -4, 5, 6], 9), ([4, 4, -1, 4], 7), ([6, -2, 0, 3], 7)];

const POINTS: usize = 40;

/// A rotation and a translation, exactly and as rounded.
struct Sample<T: Real> {
    rotor: Rotor<T>,
    translator: Translator<T>,
    point: Point<T>,
    exact_rotor: Exact,
    exact_translator: Exact,
    exact_point: [Big; 3],
}

fn rounded<T: Real>(x: &Big) -> T {
    T::from_f64(x.to_f64().unwrap())
}

fn sample<T: Real>(index: usize, random: &mut Random) -> Sample<T> {
    let ([w, x, y, z], norm) = ROTORS[index % ROTORS.len()];
    let parts = [w, x, y, z].map(|n| ratio(n, norm));
    let [s, a, b, c] = parts.clone();
    let t = random.vector().map(T::from_f64);
    let p = random.vector().map(T::from_f64);
    let [t1, t2, t3] = t.map(|x| big(x.to_f64()) * ratio(-1, 2));
    Sample {
        rotor: Rotor::from(parts.map(|x| rounded(&x))),
        translator: Translator::from(t),
        point: Point::from(p),
        exact_rotor: Exact::sum([("s", s), ("e23", a), ("e31", b), ("e12", c)]),
        exact_translator: Exact::sum([("s", ratio(1, 1)), ("e1_ninf", t1), ("e2_ninf", t2), ("e3_ninf", t3)]),
        exact_point: p.map(|x| big(x.to_f64())),
    }
}

/// The largest error of a place, as a part of its largest coordinate.
fn error<T: Real>(found: [T; 3], exact: &[Big; 3]) -> f64 {
    let size = exact.iter().map(|x| x.to_f64().unwrap().abs()).fold(0.0, f64::max);
    let errors = found.iter().zip(exact).map(|(x, e)| {
        let x = x.to_f64();
        if x.is_finite() { distance(x, e) / size } else { f64::INFINITY }
    });
    errors.fold(0.0, f64::max)
}

fn place<T: Real>(odd: Odd<T>) -> [T; 3] {
    [odd.e1 / odd.no, odd.e2 / odd.no, odd.e3 / odd.no]
}

/// `(v x) ~v` on blades.
fn plain<T: Real>(v: Even<T>, x: Round<T>) -> Odd<T> {
    (v * x) * v.rev()
}

/// `x + (v x - x v) ~v` on blades: for unit versors the same.
fn commutator<T: Real>(v: Even<T>, x: Round<T>) -> Odd<T> {
    let image = (v * x - x * v) * v.rev();
    Odd::from(x) + image
}

/// Worst errors of a point that is turned, moved and scaled by the square of an integer: as generated, plain on
/// blades, commutator on blades.
fn scaled<T: Real>(root: i64) -> [f64; 3] {
    let (mut random, mut worst) = (Random(1), [0.0_f64; 3]);
    let (p, q) = (ratio(root, 1), ratio(1, root));
    let half = ratio(1, 2);
    let exact_dilator = Exact::sum([("s", (&p + &q) * &half), ("no_ninf", (&p - &q) * &half)]);
    let dilator = Dilator::new(rounded::<T>(&p), rounded::<T>(&q));
    for index in 0..POINTS {
        let sample = sample::<T>(index, &mut random);
        let versor: ConformalRotor<T> = sample.translator * sample.rotor * dilator;
        let exact = sample.exact_translator.times(&sample.exact_rotor).times(&exact_dilator);
        let image = exact.times(&Exact::point(&sample.exact_point)).times(&exact.reversed()).place();
        let found = versor.apply(sample.point);
        let (even, round) = (Even::from(versor), Round::from(sample.point));
        let forms = [[found.x, found.y, found.z], place(plain(even, round)), place(commutator(even, round))];
        for (worst, form) in worst.iter_mut().zip(forms) {
            *worst = worst.max(error(form, &image));
        }
    }
    worst
}

#[test]
fn dilations() {
    let mut table = Table::default();
    let floors = [(100, [1e-13, 1e-9]), (10_000, [1e-9, 3e-2]), (1_000_000, [1e-5, 1.0])];
    for (root, [plain_floor, commutator_floor]) in floors {
        let [generated, plain, commutator] = scaled::<f64>(root);
        let scale = root as f64 * root as f64;
        table.good(format!("a point scaled by {scale:.0e}, as stored and generated"), generated, 4e-15);
        table.bad(format!("a point scaled by {scale:.0e}, plain on blades"), plain, plain_floor);
        table.bad(format!("a point scaled by {scale:.0e}, commutator on blades"), commutator, commutator_floor);
    }
    let [generated, plain, _] = scaled::<f32>(100);
    table.good("a point scaled by 1e4 in f32, as stored and generated", generated, 2.6e-6);
    table.bad("a point scaled by 1e4 in f32, plain on blades", plain, 7e-5);
    table.check();
}

/// How far from unit the versors are that are not quite.
const DEFECT: f64 = 1e-8;

#[test]
fn versors_that_are_not_quite_unit() {
    let mut random = Random(2);
    let mut worst = [0.0_f64; 5];
    for index in 0..POINTS {
        let sample = sample::<f64>(index, &mut random);
        let dilator = Dilator::new(1.5, 1.0 / 1.5);
        let exact_dilator = Exact::sum([("s", ratio(13, 12)), ("no_ninf", ratio(5, 12))]);
        let turned = sample.exact_rotor.times(&Exact::point(&sample.exact_point)).times(&sample.exact_rotor.reversed());
        let [x, y, z] = <[f64; 3]>::from(sample.point);
        let apply = |rotor: Rotor<f64>| <[f64; 3]>::from(rotor.apply(Vector::new(x, y, z)));
        let long = |numbers: [f64; 4]| Rotor::from(numbers.map(|x| x * (1.0 + DEFECT)));
        let whole = sample.exact_translator.times(&sample.exact_rotor).times(&exact_dilator);
        let image = whole.times(&Exact::point(&sample.exact_point)).times(&whole.reversed()).place();
        let unit: ConformalRotor<f64> = sample.translator * sample.rotor * dilator;
        let longer = unit.map(|x| x * (1.0 + DEFECT));
        let found = longer.apply(sample.point);
        let even = Even::from(longer);
        let forms = [
            error(apply(sample.rotor), &turned.place()),
            error(apply(long(sample.rotor.into())), &turned.place()),
            error([found.x, found.y, found.z], &image),
            error(place(plain(even, Round::from(sample.point))), &image),
            error(place(commutator(even, Round::from(sample.point))), &image),
        ];
        worst.iter_mut().zip(forms).for_each(|(worst, form)| *worst = worst.max(form));
    }
    let mut table = Table::default();
    let [unit, rotor, conformal, plain, commutator] = worst;
    table.good("a unit rotor on a vector", unit, 5e-15);
    table.good("a rotor too long by 1e-8 on a vector", rotor, 5e-7);
    table.good("a conformal rotor too long by 1e-8 on a point", conformal, 5e-15);
    table.good("a conformal rotor too long by 1e-8 on a point, plain on blades", plain, 5e-15);
    table.bad("a conformal rotor too long by 1e-8 on a point, commutator on blades", commutator, 7e-9);
    table.check();
}

/// By how much the length of a vector across the axis has changed after many turns by a rotor that is too long; and that
/// of one along the axis.
fn drift(angle_rad: f64, turns: usize) -> [f64; 2] {
    let half = angle_rad / 2.0;
    let rotor = Rotor::new(half.cos(), 0.0, 0.0, -half.sin()).map(|x| x * (1.0 + DEFECT));
    [Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 0.0, 1.0)].map(|start| {
        let end = (0..turns).fold(start, |x, _| rotor.apply(x));
        end.norm_sq().sqrt() - 1.0
    })
}

/// The commutator form multiplies by `1 + 2 d (1 - cos)` across the axis, where the plain one multiplies by `1 + 2 d`
/// everywhere: 2e-4 after ten thousand turns.
#[test]
fn the_same_rotor_ten_thousand_times() {
    const TURNS: usize = 10_000;
    let mut table = Table::default();
    for (angle, expected) in [(0.1, 1e-6), (1.5, 1.9e-4), (3.0, 4.0e-4)] {
        let [across, along] = drift(angle, TURNS);
        let predicted = TURNS as f64 * 2.0 * DEFECT * (1.0 - f64::cos(angle));
        table.good(format!("turned {TURNS} times by {angle}, too long by 1e-8: across"), across.abs(), 10.0 * expected);
        // What the linear prediction leaves out is half its square.
        let left = (across - predicted).abs();
        table.good(format!("... and its distance from the prediction {predicted:.1e}"), left, predicted * predicted);
        table.good(format!("turned {TURNS} times by {angle}, too long by 1e-8: along"), along.abs(), 1e-12);
    }
    table.check();
}

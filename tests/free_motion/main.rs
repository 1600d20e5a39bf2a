//! The exact free motion: against double-double Taylor series, closed forms, and the laws that any flow obeys.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod cases;
mod extremes;
mod reference;
mod splitting;

use ga_physics::algebra::Real;
use ga_physics::algebra::g3::{Bivector, Rotor};
use ga_physics::rigid::Inertia;
use ga_physics::rigid::axis_splitting;
use ga_physics::rigid::free::{self, Case, FreeMotion};
use reference::Top;

pub(crate) const EPS: f64 = f64::EPSILON;

pub(crate) fn inertia<T: Real>(moments: [f64; 3]) -> Inertia<T> {
    let diagonal = std::array::from_fn(|r| std::array::from_fn(|c| if r == c { moments[r] } else { 0.0 }));
    Inertia::new(1.0, diagonal).unwrap()
}

pub(crate) fn angle<T: Real>(a: Rotor<T>, b: Rotor<T>) -> f64 {
    let d = a.map(Real::to_f64).rev() * b.map(Real::to_f64);
    2.0 * (d.e23 * d.e23 + d.e31 * d.e31 + d.e12 * d.e12).sqrt()
}

/// `2E` of an orientation.
pub(crate) fn energy(body: &Inertia<f64>, rotor: Rotor<f64>, momentum: Bivector<f64>) -> f64 {
    let in_body = rotor.rev().apply(momentum);
    let omega = body.velocity_of(in_body);
    (in_body.e23 * omega.e23 + in_body.e31 * omega.e31 + in_body.e12 * omega.e12) / rotor.norm_sq().powi(2)
}

/// A body, its orientation, and its momentum in the world.
pub(crate) struct Spun {
    pub(crate) moments: [f64; 3],
    pub(crate) body: Inertia<f64>,
    pub(crate) rotor: Rotor<f64>,
    pub(crate) momentum: Bivector<f64>,
}

impl Spun {
    pub(crate) fn new(moments: [f64; 3], omega_body: [f64; 3], rotor: Rotor<f64>) -> Self {
        let body = inertia(moments);
        let momentum = rotor.apply(body.momentum_of(Bivector::from(omega_body)));
        Self { moments, body, rotor, momentum }
    }

    pub(crate) fn motion(&self) -> FreeMotion {
        FreeMotion::new(&self.body, self.rotor, self.momentum)
    }

    pub(crate) fn turn(&self, rotor: Rotor<f64>, h_s: f64) -> Rotor<f64> {
        free::turn(&self.body, rotor, self.momentum, h_s)
    }

    pub(crate) fn turns(&self, count: u32, h_s: f64) -> Rotor<f64> {
        (0..count).fold(self.rotor, |rotor, _| self.turn(rotor, h_s))
    }

    pub(crate) fn reference(&self) -> Top {
        Top::new(self.moments, self.rotor, self.momentum.into())
    }

    /// `|L| / I1`: what a phase may go at.
    pub(crate) fn rate(&self) -> f64 {
        let least = self.moments.iter().fold(f64::INFINITY, |least, x| least.min(*x));
        self.momentum.norm_sq().sqrt() / least
    }
}

/// SplitMix64, in -1 .. 1.
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn rotor(&mut self) -> Rotor<f64> {
        Rotor::exp(Bivector::new(self.next(), self.next(), self.next()) * 2.0)
    }

    /// Moments of some body, from its second moments, in any order.
    pub(crate) fn moments(&mut self) -> [f64; 3] {
        let [x, y, z] = [self.next().abs(), self.next().abs(), self.next().abs()];
        [y + z, z + x, x + y]
    }

    pub(crate) fn spun(&mut self) -> Spun {
        let moments = self.moments();
        let omega = [self.next(), self.next(), self.next()];
        Spun::new(moments, omega, self.rotor())
    }
}

/// The reference is good to what a tenth of its step changes, and an independent method agrees.
#[test]
fn the_reference_is_converged() {
    let spun = Spun::new([1.0, 2.0, 2.9], [0.3, 0.2, 0.4], Rotor::default());
    let (mut coarse, mut fine) = (spun.reference(), spun.reference());
    coarse.advance(10.0);
    fine.advance_by(10.0, 0.05);
    assert_eq!(coarse.rotor(), fine.rotor());
    let error = |steps: u32| {
        let split = |rotor, _| axis_splitting::turn(&spun.body, rotor, spun.momentum, 10.0 / f64::from(steps));
        coarse.angle_to((0..steps).fold(spun.rotor, split))
    };
    let (coarser, finer) = (error(500), error(1000));
    assert!(finer < 1e-5 && (coarser / finer - 4.0).abs() < 0.01, "{coarser:e} {finer:e}");
}

/// Moments 1, 2, 3, spun about the middle axis: two flips and a half in 100 s. One ulp of the start moves the end by
/// `condition`, which no method can be better than.
#[test]
fn the_tennis_racket_to_rounding() {
    let spun = Spun::new([1.0, 2.0, 3.0], [0.01, 1.0, 0.01], Rotor::default());
    let mut exact = spun.reference();
    exact.advance(100.0);
    let condition = [[0.01 * (1.0 + EPS), 1.0, 0.01], [0.01, 1.0 + EPS, 0.01], [0.01, 1.0, 0.01 * (1.0 + EPS)]]
        .map(|omega| {
            let mut moved = Spun::new([1.0, 2.0, 3.0], omega, Rotor::default()).reference();
            moved.advance(100.0);
            exact.angle_to(moved.rotor())
        })
        .into_iter()
        .fold(0.0, f64::max);
    let at = exact.angle_to(spun.motion().at(100.0));
    let seconds = exact.angle_to(spun.turns(100, 1.0));
    let hundredths = exact.angle_to(spun.turns(10_000, 0.01));
    println!("condition {condition:.1e}: at {at:.1e}, by 1 s {seconds:.1e}, by 0.01 s {hundredths:.1e}");
    assert!(condition > EPS && condition < 1e-13, "{condition:e}");
    assert!(at < 16.0 * condition, "{at:e}");
    // A step rounds the rotor to 1e-16, 64 times the ulp of 0.01, and the error is carried on; a short one rounds less.
    assert!(seconds < 1e-11, "{seconds:e}");
    assert!(hundredths < 1e-11, "{hundredths:e}");
    let split = |rotor, _| axis_splitting::turn(&spun.body, rotor, spun.momentum, 0.01);
    let error = exact.angle_to((0..10_000).fold(spun.rotor, split));
    assert!(error > 1e-5, "a method of order 2 should be seen to err: {error:e}");
}

/// Bodies of all shapes, all spins: whatever the case, rounding only.
#[test]
fn any_body_follows_the_reference() {
    let mut numbers = Numbers(1);
    let mut worst = [0.0_f64; 2];
    for _ in 0..60 {
        let spun = numbers.spun();
        let t = 8.0 * numbers.next() / spun.rate();
        let mut exact = spun.reference();
        exact.advance(t);
        let errors = [exact.angle_to(spun.motion().at(t)), exact.angle_to(spun.turns(64, t / 64.0))];
        for (worst, error) in worst.iter_mut().zip(errors) {
            *worst = worst.max(error);
        }
    }
    println!("at {:.1e}, 64 turns {:.1e}", worst[0], worst[1]);
    // Rounding of a dozen operations, and of a phase of up to 8 rad; 64 steps sum theirs.
    assert!(worst[0] < 32.0 * EPS && worst[1] < 64.0 * EPS, "{worst:?}");
}

/// Both ways to make a step agree where one hands over to the other, and twice as far: no term of a series is missing.
#[test]
fn short_and_long_steps_agree() {
    let mut numbers = Numbers(2);
    let mut worst = 0.0_f64;
    for index in 0..400 {
        let mut spun = numbers.spun();
        let [x, y, z] = spun.moments.map(f64::recip);
        let spread = (x.max(y).max(z) - x.min(y).min(z)) * spun.momentum.norm_sq().sqrt();
        // Half of them spin fast beside their wobble.
        let h = if index % 2 == 0 { 0.199 } else { -0.199 } / spread;
        spun.rotor = numbers.rotor();
        let phase = 1.0 + h.abs() * spun.rate();
        let error = angle(spun.motion().at(h), spun.turn(spun.rotor, h)) / phase;
        worst = worst.max(error);
    }
    println!("{worst:.1e}");
    assert!(worst < 16.0 * EPS, "{worst:e}");
}

#[test]
fn motions_compose_and_reverse() {
    let mut numbers = Numbers(3);
    for _ in 0..100 {
        let spun = numbers.spun();
        let [t1, t2] = [3.0 * numbers.next(), 3.0 * numbers.next()].map(|t| t / spun.rate());
        let motion = spun.motion();
        let middle = motion.at(t1);
        let again = FreeMotion::new(&spun.body, middle, spun.momentum).at::<f64>(t2);
        let error = angle(motion.at(t1 + t2), again);
        assert!(error < 64.0 * EPS, "composed {error:e}");
        let error = angle(spun.rotor, spun.turn(spun.turn(spun.rotor, 0.01 * t1), -0.01 * t1));
        assert!(error < 8.0 * EPS, "short and back {error:e}");
        let error = angle(spun.rotor, spun.turn(spun.turn(spun.rotor, t1), -t1));
        assert!(error < 64.0 * EPS, "there and back {error:e}");
        let error = angle(spun.rotor, motion.at(0.0));
        assert!(error < 16.0 * EPS, "no time {error:e}");
    }
}

/// A step keeps the energy to rounding, and many sum their roundings like a walk, not like a road.
#[test]
fn energy_and_norm_stay() {
    let spun = Spun::new([1.0, 2.0, 3.0], [0.5, 0.7, 0.3], Rotor::exp(Bivector::new(0.1, 0.2, -0.3)));
    let start = energy(&spun.body, spun.rotor, spun.momentum);
    let (mut rotor, mut worst) = (spun.rotor, [0.0_f64; 2]);
    for _ in 0..10_000 {
        rotor = spun.turn(rotor, 0.01);
        worst[0] = worst[0].max((energy(&spun.body, rotor, spun.momentum) / start - 1.0).abs());
        worst[1] = worst[1].max((rotor.norm_sq() - 1.0).abs());
    }
    // Long steps, each of which rounds all of the rotor: left alone they would be off by 1e-17 a step, all in one direction.
    let long = (energy(&spun.body, spun.turns(10_000, 1.0), spun.momentum) / start - 1.0).abs();
    assert!(long < 4e-14, "{long:e}");
    let motion = spun.motion();
    let at = |step: u32| (energy(&spun.body, motion.at(f64::from(step) * 10.0), spun.momentum) / start - 1.0).abs();
    let prepared = (0..10_000).map(at).fold(0.0, f64::max);
    println!("energy {:.1e}, norm {:.1e}; prepared {prepared:.1e}", worst[0], worst[1]);
    // sqrt(10,000) steps of eps/4, and the rounding of the energy itself.
    assert!(worst[0] < 1e-14 && worst[1] < 8.0 * EPS, "{worst:?}");
    assert!(prepared < 16.0 * EPS, "{prepared:e}");
}

/// Rounded to f32 at the border only.
#[test]
fn f32_bodies_move_to_their_own_rounding() {
    let body = inertia::<f32>([1.0, 2.0, 3.0]);
    let momentum = body.momentum_of(Bivector::new(0.01, 1.0, 0.01));
    let wide = inertia::<f64>([1.0, 2.0, 3.0]);
    let exact = FreeMotion::new(&wide, Rotor::default(), momentum.map(Real::to_f64));
    let motion = FreeMotion::new(&body, Rotor::<f32>::default(), momentum);
    assert_eq!(motion.case(), Case::AboutLargest);
    for t in [0.01, 1.0, 20.0, 100.0, 1e4] {
        let (found, expected): (Rotor<f32>, Rotor<f64>) = (motion.at(t), exact.at(t));
        let error = angle(found.map(Real::to_f64), expected);
        assert!(error < 2.0 * f64::from(f32::EPSILON), "at {t}: {error:e}");
    }
}

//! Cases of substepped XPBD: surfaces, constraints of one's own, degenerate and extreme input, f32, and that neither the
//! order of the constraints nor the number of threads is seen in the result.
#![cfg(feature = "physics")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use ga_physics::algebra::Real;
use ga_physics::algebra::cga::{Point, Round};
use ga_physics::algebra::g3::Vector;
use ga_physics::particle::xpbd::{Substeps, Xpbd, XpbdError};
use ga_physics::particle::{Constraint, ConstraintFunction, Differentiable, OwnConstraint, Particles};

const G: f64 = 9.81;

fn down() -> Vector<f64> {
    Vector::new(0.0, 0.0, -G)
}

fn distance(a: usize, b: usize, length: f64) -> Constraint {
    Constraint::Distance { a, b, length }
}

fn substeps(dt_s: f64, count: usize) -> Substeps {
    Substeps { dt_s, count, violation: 1e-2 }
}

/// A flat net of columns and rows, hung by its first row.
fn net(columns: usize, rows: usize, d: f64) -> (Particles<f64>, Vec<f64>, Vec<Constraint>) {
    let (mut particles, mut constraints) = (Particles::default(), Vec::new());
    for index in 0..columns * rows {
        let (column, row) = ((index % columns) as f64, (index / columns) as f64);
        particles.push(Point::new(column * d, -row * d, 0.0), Vector::default());
        if index % columns > 0 {
            constraints.push(distance(index - 1, index, d));
        }
        if index >= columns {
            constraints.push(distance(index - columns, index, d));
        }
    }
    let inv_mass = (0..columns * rows).map(|index| if index < columns { 0.0 } else { 100.0 }).collect();
    (particles, inv_mass, constraints)
}

fn hash(particles: &Particles<f64>) -> u64 {
    let numbers = particles.position.iter().flat_map(|x| <[f64; 3]>::from(*x));
    let numbers = numbers.chain(particles.velocity.iter().flat_map(|v| <[f64; 3]>::from(*v)));
    numbers.fold(0xcbf2_9ce4_8422_2325, |hash, x| (hash ^ x.to_bits()).wrapping_mul(0x0100_0000_01b3))
}

/// A net of five blocks of particles, so that all kinds of windows are there, and two links between far blocks.
fn large() -> (Particles<f64>, Vec<f64>, Vec<Constraint>) {
    let (particles, inv_mass, mut constraints) = net(140, 130, 0.1);
    constraints.push(distance(200, 18_000, 12.7));
    constraints.push(distance(300, 17_900, 12.5));
    (particles, inv_mass, constraints)
}

fn swing((mut particles, inv_mass, constraints): (Particles<f64>, Vec<f64>, Vec<Constraint>)) -> u64 {
    let mut xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
    for _ in 0..2 {
        xpbd.step(&mut particles, &inv_mass, &substeps(0.02, 3), Vector::new(1.0, 0.0, -G));
    }
    hash(&particles)
}

/// Of the state after [`swing`], in every build: only sums, products, quotients and square roots go into it.
const SWUNG: u64 = 0xffce_7f4a_15bf_887a;

#[test]
fn order_and_threads_leave_no_trace() {
    let (particles, inv_mass, mut constraints) = large();
    constraints.reverse();
    for constraint in constraints.iter_mut().step_by(3) {
        if let Constraint::Distance { a, b, .. } = constraint {
            std::mem::swap(a, b);
        }
    }
    assert_eq!(format!("{:x}", swing(large())), format!("{SWUNG:x}"));
    assert_eq!(swing((particles, inv_mass, constraints)), SWUNG);
    #[cfg(feature = "parallel")]
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| swing(large())), SWUNG, "{threads} threads");
    }
}

#[test]
fn fixed_particles_do_not_move_by_a_bit() {
    let mut particles = Particles::default();
    particles.push(Point::new(-0.0, 0.1, -0.0), Vector::new(3.0, 2.0, 1.0));
    particles.push(Point::new(0.5, -0.3, 0.7), Vector::new(1.0, 2.0, 3.0));
    particles.push(Point::new(-1e-300, 1.0 / 3.0, 1e3), Vector::default());
    let bits = |x: Point<f64>| <[f64; 3]>::from(x).map(f64::to_bits);
    let (before, inv_mass) = (particles.position.clone(), [0.0, 1.0, 0.0]);
    let held = [distance(0, 1, 0.5), distance(2, 1, 900.0), distance(0, 2, 7.0)];
    let mut xpbd = Xpbd::new(&particles, &inv_mass, &held).unwrap();
    xpbd.step(&mut particles, &inv_mass, &substeps(0.1, 10), down());
    assert_eq!(bits(particles.position[0]), bits(before[0]));
    assert_eq!(bits(particles.position[2]), bits(before[2]));
    assert_ne!(bits(particles.position[1]), bits(before[1]));
    assert_eq!(particles.velocity[0], Vector::default());
}

/// A bead far from the origin, on a sphere and a plane: a vertical circle of radius 0.5.
#[test]
fn a_bead_stays_on_plane_sphere_and_circle() {
    let centre = Point::new(1e5, -2e5, 3e5);
    let plane = Round { e2: -3.0, ..Round::default() };
    let sphere = Round { no: -2.0, ninf: 0.25, ..Round::default() };
    let on = |surface| Constraint::On { particle: 0, anchor: centre, surface };
    for held in [vec![on(plane)], vec![on(sphere)], vec![on(sphere), on(plane)]] {
        let mut bead = Particles::default();
        bead.push(centre.moved(Vector::new(0.3, 0.0, 0.4)), Vector::new(0.4, 0.0, -0.3));
        let mut xpbd = Xpbd::new(&bead, &[1.0], &held).unwrap();
        xpbd.step(&mut bead, &[1.0], &substeps(1.0, 1000), down());
        let from = centre.displacement_to(bead.position[0]);
        let (off, radius) = (from.e2.abs(), from.norm_sq().sqrt());
        // Positions of 3e5 m have an ulp of 6e-11 m.
        assert!(off < 2e-10, "off the plane by {off:e}");
        assert_eq!(
            (radius - 0.5).abs() < 2e-10,
            held.len() == 2 || matches!(&held[0], Constraint::On { surface, .. } if surface.no != 0.0),
            "{radius}"
        );
        let violation = xpbd.max_violation(&bead);
        assert!(violation.absolute_m < 2e-10 && violation.relative < 1e-9, "{violation:?}");
    }
}

#[test]
fn a_bead_that_leaves_its_surface_is_brought_back_and_one_at_the_centre_is_not_moved() {
    let sphere = Round { no: 1.0, ninf: -2.0, ..Round::default() };
    let held = [Constraint::On { particle: 0, anchor: Point::origin(), surface: sphere }];
    for (start, end) in [(1e-9, 2.0), (100.0, 2.0), (0.0, 0.0)] {
        let mut bead = Particles::<f64>::default();
        bead.push(Point::new(0.0, start, 0.0), Vector::default());
        let mut xpbd = Xpbd::new(&bead, &[1.0], &held).unwrap();
        xpbd.step(&mut bead, &[1.0], &substeps(1e-3, 1), Vector::default());
        assert!((bead.position[0].y - end).abs() < 1e-14, "{start}: {:?}", bead.position[0]);
    }
}

struct Bowl;

impl ConstraintFunction for Bowl {
    fn value<S: Differentiable>(&self, at: &[Point<S>]) -> S {
        let Point { x, y, z } = at[0];
        (x * x + y * y) * S::ratio(1, 2) - z
    }
}

#[test]
fn a_constraint_of_ones_own_is_held() {
    let mut bead = Particles::default();
    bead.push(Point::new(1.0, 0.0, 0.5), Vector::new(0.0, 1.0, 0.0));
    let mut xpbd = Xpbd::new(&bead, &[3.0], &[Constraint::Own(OwnConstraint::new([0], Bowl))]).unwrap();
    let worst = |count: usize| {
        let (mut bead, mut worst) = (bead.clone(), 0.0_f64);
        for _ in 0..20 {
            xpbd.step(&mut bead, &[3.0], &substeps(0.05, count), down());
            worst = worst.max(xpbd.max_violation(&bead).absolute_m);
        }
        worst
    };
    let [coarse, fine] = [20, 40].map(worst);
    // A Newton step from a distance of h² leaves its square.
    let order = (coarse / fine).log2();
    assert!((order - 4.0).abs() < 0.3, "observed order {order}: {coarse:e}, {fine:e}");
}

#[test]
fn particles_in_one_place_are_set_apart() {
    let mut particles = Particles::default();
    for _ in 0..3 {
        particles.push(Point::new(1.0, 2.0, 3.0), Vector::default());
    }
    let (held, inv_mass) = ([distance(0, 1, 0.2), distance(1, 2, 0.2)], [1.0, 3.0, 0.0]);
    let mut xpbd = Xpbd::new(&particles, &inv_mass, &held).unwrap();
    assert_eq!(xpbd.max_violation(&particles).relative, 1.0);
    xpbd.step(&mut particles, &inv_mass, &substeps(1e-3, 10), Vector::default());
    let violation = xpbd.max_violation(&particles);
    assert!(violation.relative < 1e-2, "{violation:?} {particles:?}");
}

#[test]
fn all_scales_behave_alike() {
    let ratios = [1e-9, 1.0, 1e9].map(|scale| {
        let (mut particles, mut inv_mass, constraints) = net(6, 6, 0.1 * scale);
        inv_mass.iter_mut().for_each(|w| *w *= scale);
        let mut xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
        let gravity = Vector::new(1.0, 0.0, -G) * scale;
        // Five particles hang from each link at the top: usual / AGAIN gives h² = 0.4 e d / (2 2 5 g).
        assert_eq!(xpbd.substeps(1.0 / 60.0, G * scale, 1e-2), 11);
        (0..30).for_each(|_| xpbd.step(&mut particles, &inv_mass, &substeps(1.0 / 60.0, 20), gravity));
        xpbd.max_violation(&particles).relative
    });
    // Chaos of 600 substeps times rounding: far from 1, but small.
    assert!(ratios.iter().all(|ratio| (ratio / ratios[1] - 1.0).abs() < 1e-6), "{ratios:?}");
}

#[test]
fn single_precision_holds_as_well() {
    let (double, inv_mass, constraints) = net(10, 10, 0.1);
    let inv_mass: Vec<f32> = inv_mass.iter().map(|w| f32::from_f64(*w)).collect();
    let mut particles = Particles::<f32>::default();
    double.position.iter().for_each(|x| particles.push(*x, Vector::default()));
    let mut xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
    for _ in 0..30 {
        xpbd.step(&mut particles, &inv_mass, &substeps(1.0 / 60.0, 20), Vector::new(1.0, 0.0, -G));
    }
    assert!(xpbd.max_violation(&particles).relative < 1e-2);
    let speed = particles.velocity.iter().map(|v| v.norm_sq()).fold(0.0, f32::max).sqrt();
    assert!(speed > 0.1 && speed < 10.0, "{speed}");
}

#[test]
fn a_lost_state_is_no_small_violation() {
    let (mut particles, inv_mass, constraints) = net(3, 3, 0.1);
    let mut xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
    particles.position[4].x = f64::NAN;
    assert_eq!(xpbd.max_violation(&particles).relative, f64::INFINITY);
}

#[test]
fn errors_say_what_is_wrong() {
    let (particles, inv_mass, _) = net(2, 1, 0.1);
    let error = |held: Constraint| Xpbd::new(&particles, &inv_mass, &[held]).unwrap_err();
    assert_eq!(Xpbd::new(&particles, &[1.0], &[]).unwrap_err(), XpbdError::Sizes { particles: 2, inv_masses: 1 });
    let infinite = Xpbd::new(&particles, &[1.0, f64::INFINITY], &[]).unwrap_err();
    assert_eq!(infinite, XpbdError::InverseMass { particle: 1, inv_mass: f64::INFINITY });
    let none = XpbdError::NoSuchParticle { constraint: 0, particle: 2, particles: 2 };
    assert_eq!(error(distance(0, 2, 1.0)), none);
    assert_eq!(error(Constraint::Own(OwnConstraint::new([2], Bowl))), none);
    assert_eq!(error(distance(1, 1, 1.0)), XpbdError::SameParticle { constraint: 0, particle: 1 });
    let imaginary = Round { no: 1.0, ninf: 0.5, ..Round::default() };
    let on = Constraint::On { particle: 0, anchor: Point::origin(), surface: imaginary };
    assert_eq!(error(on), XpbdError::Surface { constraint: 0 });
    let (particles, free) = (&particles, [1.0, 1.0]);
    for length_m in [0.0, -1.0, 1e-70, 1e70] {
        let held = [distance(0, 1, length_m)];
        assert_eq!(Xpbd::new(particles, &free, &held).unwrap_err(), XpbdError::Length { constraint: 0, length_m });
    }
}

#[test]
fn the_error_of_a_force_ends_the_step() {
    let (mut particles, inv_mass, constraints) = net(3, 3, 0.1);
    let mut xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
    let outcome = xpbd.step_with(&mut particles, &inv_mass, &substeps(0.1, 10), |t_s, _, acceleration| {
        acceleration.fill(down());
        if t_s > 0.045 { Err(t_s) } else { Ok(()) }
    });
    assert!((outcome.unwrap_err() - 0.05).abs() < 1e-15);
    assert!(particles.velocity[8].norm_sq() > 0.0, "velocities are those after five substeps");
}

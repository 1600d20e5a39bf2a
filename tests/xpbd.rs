//! Laws of substepped XPBD: what is conserved, how errors fall with the substep, exact positions at rest.
#![cfg(feature = "physics")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use ga_physics::algebra::Real;
use ga_physics::algebra::cga::{Point, Round};
use ga_physics::algebra::g3::Vector;
use ga_physics::particle::xpbd::{Substeps, Xpbd};
use ga_physics::particle::{Constraint, Particles};
use std::convert::Infallible;

const G: f64 = 9.81;

fn down() -> Vector<f64> {
    Vector::new(0.0, 0.0, -G)
}

fn distance(a: usize, b: usize, length: f64) -> Constraint {
    Constraint::Distance { a, b, length }
}

/// One sweep a substep.
fn plain(dt_s: f64, count: usize) -> Substeps {
    Substeps { dt_s, count, violation: f64::INFINITY }
}

/// SplitMix64, -1 .. 1.
fn number(seed: u64) -> f64 {
    let mut z = seed.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// A net of columns and rows in the plane y = 0; folded, if the angle is not 0.
fn net<T: Real>(columns: usize, rows: usize, d: f64, fold: f64) -> (Particles<T>, Vec<Constraint>) {
    let (mut particles, mut constraints) = (Particles::default(), Vec::new());
    for index in 0..columns * rows {
        let (column, row) = (index % columns, index / columns);
        let depth = if column % 2 == 1 { d * fold.sin() } else { 0.0 };
        particles.push(Point::new(column as f64 * d * fold.cos(), depth, -(row as f64) * d), Vector::default());
        if column > 0 {
            constraints.push(distance(index - 1, index, d));
        }
        if row > 0 {
            constraints.push(distance(index - columns, index, d));
        }
    }
    (particles, constraints)
}

/// A chain along e1 or, for `down`, against e3.
fn chain<T: Real>(particles: usize, d: f64, down: bool) -> (Particles<T>, Vec<Constraint>) {
    if down { net(1, particles, d, 0.0) } else { net(particles, 1, d, 0.0) }
}

#[test]
fn a_free_net_keeps_its_momentum() {
    let (mut particles, constraints) = net::<f64>(9, 7, 0.1, 0.5);
    let mass: Vec<f64> = (0..63).map(|i| 0.01 * (2.0 + number(i))).collect();
    for (i, v) in particles.velocity.iter_mut().enumerate() {
        *v = Vector::from([0, 1, 2].map(|axis| number(1000 + 3 * i as u64 + axis)));
    }
    let momentum = |particles: &Particles<f64>| {
        particles.velocity.iter().zip(&mass).fold(Vector::default(), |sum: Vector<f64>, (v, m)| sum + *v * *m)
    };
    let inv_mass: Vec<f64> = mass.iter().map(|m| 1.0 / m).collect();
    let before = momentum(&particles);
    let mut xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
    for _ in 0..20 {
        xpbd.step(&mut particles, &inv_mass, &Substeps { dt_s: 0.01, count: 10, violation: 1e-2 }, Vector::default());
    }
    let drift = (momentum(&particles) - before).norm_sq().sqrt();
    // Each of 200 substeps rounds positions of 1 m to eps, velocities to eps / h, with m = 0.02 kg, 63 of them, at random.
    let tolerance = 0.02 * (63.0_f64 * 200.0).sqrt() * f64::EPSILON / 1e-3;
    assert!(drift < tolerance, "{drift:e} against {tolerance:e}");
    assert!(xpbd.max_violation(&particles).relative < 1e-2);
}

/// A double pendulum of lengths 1 that starts horizontally: its state after one second.
fn double_pendulum(count: usize) -> (f64, Particles<f64>) {
    let (mut particles, constraints) = chain::<f64>(3, 1.0, false);
    let inv_mass = [0.0, 1.0, 1.0];
    let mut xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
    let mut worst: f64 = 0.0;
    for _ in 0..20 {
        xpbd.step(&mut particles, &inv_mass, &plain(0.05, count), down());
        worst = worst.max(xpbd.max_violation(&particles).relative);
    }
    (worst, particles)
}

#[test]
fn violation_falls_as_the_square_of_the_substep() {
    let violations = [50, 100, 200].map(|count| double_pendulum(count).0);
    for pair in violations.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.2, "observed order {order} from {violations:?}");
    }
}

#[test]
fn positions_converge_in_first_order() {
    let [a, b, c] = [50, 100, 200].map(|count| double_pendulum(count).1.position[2]);
    let order = (a.distance_sq_to(b) / b.distance_sq_to(c)).log2() / 2.0;
    assert!((order - 1.0).abs() < 0.2, "observed order {order}");
}

/// The state of a chain hung by its first particle in which every sweep undoes every prediction.
fn at_rest(n: usize, d: f64, h: f64) -> Vec<f64> {
    let fall = G * h * h;
    let mut z = vec![0.0];
    for link in 0..n {
        // Even links are swept first. The later ones pull at both their ends: at the first only at the lower.
        let carried = (n - link) as f64;
        let left = match link {
            _ if link % 2 == 1 => 0.0,
            0 => (carried - 1.0) * fall,
            _ if link + 1 == n => (carried + 1.0) * fall,
            _ => 2.0 * carried * fall,
        };
        z.push(z[link] - d - left);
    }
    z
}

#[test]
fn static_stretch_is_that_of_the_formula() {
    let (n, d, h) = (20, 0.1, 1e-4);
    let (mut particles, constraints) = chain::<f64>(n + 1, d, true);
    let mut inv_mass = vec![100.0; n + 1];
    inv_mass[0] = 0.0;
    for (x, z) in particles.position.iter_mut().zip(at_rest(n, d, h)) {
        x.z = z;
    }
    let start = particles.clone();
    let mut xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
    let before = xpbd.max_violation(&particles);
    let expected = 2.0 * (n - 2) as f64 * G * h * h;
    assert!((before.absolute_m / expected - 1.0).abs() < 1e-9, "{before:?} against {expected:e}");
    xpbd.step(&mut particles, &inv_mass, &plain(100.0 * h, 100), down());
    for (x, start) in particles.position.iter().zip(&start.position) {
        // The formula is linear in the stretch e = 4e-5, and 100 substeps may add up what is left of e².
        let moved = x.distance_sq_to(*start).sqrt();
        assert!(moved < 1e-3 * expected, "{moved:e} of {expected:e}");
    }
}

#[test]
fn the_estimate_of_the_substeps_keeps_the_violation() {
    let (particles, constraints) = chain::<f64>(51, 0.1, true);
    let mut inv_mass = vec![100.0; 51];
    inv_mass[0] = 0.0;
    let xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
    let [coarse, fine] = [1e-2, 1e-4].map(|violation| xpbd.substeps(1.0, G, violation));
    assert!((fine as f64 / coarse as f64 - 10.0).abs() < 0.1, "{coarse} {fine}: h² is as the violation");
    assert_eq!(xpbd.substeps(1.0, 0.0, 1e-2), 1);

    for (columns, rows, fold, fixed) in
        [(1, 51, 0.0, vec![0]), (8, 20, 0.0, (0..8).collect()), (10, 10, 1.0, vec![0, 9])]
    {
        let (mut particles, constraints) = net::<f64>(columns, rows, 0.1, fold);
        let mut inv_mass = vec![100.0; particles.len()];
        fixed.iter().for_each(|particle: &usize| inv_mass[*particle] = 0.0);
        let mut xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
        let (dt_s, violation) = (1.0 / 60.0, 1e-2);
        let count = xpbd.substeps(dt_s, G, violation);
        let mut worst: f64 = 0.0;
        for _ in 0..60 {
            xpbd.step(&mut particles, &inv_mass, &Substeps { dt_s, count, violation }, down());
            worst = worst.max(xpbd.max_violation(&particles).relative);
        }
        assert!(worst < violation, "{columns} x {rows}: {worst:e} with {count} substeps");
        assert!(worst > 0.01 * violation, "{columns} x {rows}: {worst:e} is far better than asked, {count} substeps");
    }
}

#[test]
fn a_shock_needs_the_sweeps_that_follow() {
    let worst = |violation: f64| {
        let (mut particles, constraints) = net::<f64>(12, 12, 0.1, 1.0);
        let mut inv_mass = vec![100.0; 144];
        (inv_mass[0], inv_mass[11]) = (0.0, 0.0);
        let mut xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
        (0..240).fold(0.0_f64, |worst, _| {
            xpbd.step(&mut particles, &inv_mass, &Substeps { dt_s: 1.0 / 240.0, count: 8, violation }, down());
            worst.max(xpbd.max_violation(&particles).relative)
        })
    };
    let (with, without) = (worst(1e-2), worst(f64::INFINITY));
    assert!(with < 1e-2 && without > 1.5e-2, "{with:e} with, {without:e} without");
}

#[test]
fn a_chain_between_two_points_hangs_where_it_must() {
    // Link k of 2 m carries the horizontal force H and half the difference of what hangs on both sides of it:
    // tan = (k + 1/2 - m) w / H. H by bisection from the span.
    let (n, d, span) = (10, 0.1, 0.6);
    let angle = |k: usize, w_over_h: f64| ((k as f64 + 0.5 - n as f64 / 2.0) * w_over_h).atan();
    let width = |w_over_h: f64| (0..n).map(|k| d * angle(k, w_over_h).cos()).sum::<f64>();
    let (mut low, mut high) = (0.0, 100.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if width(middle) > span { low = middle } else { high = middle }
    }
    let (mut particles, constraints) = chain::<f64>(n + 1, d, false);
    let mut inv_mass = vec![10.0; n + 1];
    (inv_mass[0], inv_mass[n]) = (0.0, 0.0);
    for (k, x) in particles.position.iter_mut().enumerate() {
        // A zigzag of the span.
        *x = Point::new(span * k as f64 / n as f64, 0.0, if k % 2 == 1 { -0.08 } else { 0.0 });
    }
    let mut xpbd = Xpbd::new(&particles, &inv_mass, &constraints).unwrap();
    for _ in 0..300 {
        let drag = |_, particles: &Particles<f64>, acceleration: &mut [Vector<f64>]| {
            for (a, v) in acceleration.iter_mut().zip(&particles.velocity) {
                *a = down() - *v * 4.0;
            }
            Ok::<(), Infallible>(())
        };
        xpbd.step_with(&mut particles, &inv_mass, &plain(0.02, 10), drag).unwrap();
    }
    let (mut x, mut z) = (0.0, 0.0);
    for k in 0..n {
        let off = (particles.position[k].x - x).hypot(particles.position[k].z - z);
        // Each link is longer by up to 2 k g h² = 4e-4, k = 5 on either side; the sag takes up a few of them.
        assert!(off < 2e-3, "particle {k} is off by {off:e}");
        let angle = angle(k, low);
        (x, z) = (x + d * angle.cos(), z + d * angle.sin());
    }
}

/// The angle of a pendulum of length 1 that starts at `angle` at rest, by RK4 in small steps.
fn pendulum_reference(mut angle: f64, t_s: f64) -> f64 {
    let (steps, mut omega) = (4000, 0.0);
    let h = t_s / f64::from(steps);
    let rate = |angle: f64, omega: f64| (omega, -G * angle.sin());
    for _ in 0..steps {
        let k1 = rate(angle, omega);
        let k2 = rate(angle + h / 2.0 * k1.0, omega + h / 2.0 * k1.1);
        let k3 = rate(angle + h / 2.0 * k2.0, omega + h / 2.0 * k2.1);
        let k4 = rate(angle + h * k3.0, omega + h * k3.1);
        angle += h / 6.0 * (k1.0 + 2.0 * k2.0 + 2.0 * k3.0 + k4.0);
        omega += h / 6.0 * (k1.1 + 2.0 * k2.1 + 2.0 * k3.1 + k4.1);
    }
    angle
}

/// Swings for 2 s from 1 rad; the error of the angle.
fn pendulum_error(inv_mass: &[f64], held: Constraint, start: &Particles<f64>, count: usize) -> f64 {
    let (mut particles, bob) = (start.clone(), start.len() - 1);
    let mut xpbd = Xpbd::new(&particles, inv_mass, &[held]).unwrap();
    xpbd.step(&mut particles, inv_mass, &plain(2.0, count), down());
    let Point { x, z, .. } = particles.position[bob];
    (x.atan2(-z) - pendulum_reference(1.0, 2.0)).abs()
}

#[test]
fn a_pendulum_tends_to_the_reference() {
    let mut start = Particles::default();
    start.push(Point::origin(), Vector::default());
    start.push(Point::new(1.0_f64.sin(), 0.0, -1.0_f64.cos()), Vector::default());
    let sphere = Round { no: 1.0, ninf: -0.5, ..Round::default() };
    for (inv_mass, held) in [
        ([0.0, 2.0], distance(0, 1, 1.0)),
        ([0.0, 2.0], Constraint::ToPoint { particle: 1, point: Point::origin(), length: 1.0 }),
        ([1.0, 2.0], Constraint::On { particle: 1, anchor: Point::origin(), surface: sphere }),
    ] {
        let errors = [500, 1000, 2000].map(|count| pendulum_error(&inv_mass, held.clone(), &start, count));
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((order - 1.0).abs() < 0.3, "observed order {order} from {errors:?} with {held:?}");
        }
        // What is left when the first order is taken out.
        assert!((2.0 * errors[2] - errors[1]).abs() < 1e-3, "{errors:?}");
    }
}

//! Pendulums and tops: the period against the elliptic integral, motions against equations in minimal coordinates.

use crate::cases::{Case, GRAVITY, inertia_tensor, rattle_step, run, turned, vector};
use ga_physics::algebra::g3::{Rotor, Vector};
use ga_physics::ode::{Composition, Dop853, Fixed, Run, RungeKutta, Stepper, System};
use ga_physics::rigid::{Bodies, Formulation, Inertia};

/// An inertia whose axes are skew to everything, and its moment about y.
fn skew(mass: f64, moments: [f64; 3], angle_rad: f64) -> (Inertia<f64>, f64) {
    let tensor = inertia_tensor(moments, turned([1.0, 0.4, -0.7], angle_rad));
    (Inertia::new(mass, tensor).unwrap(), tensor[1][1])
}

/// A body that hangs from a hinge along y through the origin; and its moment about the hinge.
fn pendulum(amplitude_rad: f64) -> (Case, f64, f64) {
    let (inertia, moment) = skew(1.7, [0.02, 0.05, 0.06], 0.9);
    let distance = 0.4;
    let mut case = Case::default();
    // Beside the plane of the swing, so that the hinge has torques to bear.
    let at = turned([0.0, 1.0, 0.0], -amplitude_rad).apply(vector([0.0, 0.3, -distance]));
    let body = case.body(at.into(), turned([0.0, 1.0, 0.0], -amplitude_rad), inertia);
    case.hinge(body, None, [0.0; 3], [0.0, 1.0, 0.0]);
    (case, moment + 1.7 * distance * distance, 1.7 * distance)
}

/// `T = 4 K(sin(amplitude/2)) sqrt(I / (m g d))`, and `K(k) = pi / (2 agm(1, k'))` (Gauss 1799).
fn period(amplitude_rad: f64, moment: f64, mass_times_distance: f64) -> f64 {
    let (mut a, mut b) = (1.0_f64, (0.5 * amplitude_rad).cos());
    while (a - b).abs() > 1e-15 * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    2.0 * std::f64::consts::PI / a * (moment / (mass_times_distance * GRAVITY)).sqrt()
}

/// When the body first passes below the hinge: the last step is cut until it ends there.
fn quarter(case: &Case, h_s: f64, mut step: impl FnMut(&mut Bodies<f64>, f64)) -> f64 {
    let (mut now, mut steps) = (case.bodies.clone(), 0.0);
    loop {
        let mut next = now.clone();
        step(&mut next, h_s);
        if next.position[0].x.signum() != now.position[0].x.signum() {
            break;
        }
        (now, steps) = (next, steps + 1.0);
    }
    let mut part = |part_s: f64| {
        let mut next = now.clone();
        step(&mut next, part_s);
        next.position[0].x
    };
    let (mut before, mut after) = ((0.5 * h_s, part(0.5 * h_s)), (h_s, part(h_s)));
    for _ in 0..8 {
        if after.1 == before.1 {
            break;
        }
        let next_s = after.0 - after.1 * (after.0 - before.0) / (after.1 - before.1);
        (before, after) = (after, (next_s, part(next_s)));
    }
    steps * h_s + after.0
}

#[test]
fn a_compound_pendulum_has_the_period_of_the_elliptic_integral() {
    for amplitude_rad in [0.01, 1.0, 2.5, 3.0] {
        let (case, moment, mass_times_distance) = pendulum(amplitude_rad);
        let expected_s = period(amplitude_rad, moment, mass_times_distance);
        let mut world = case.world();
        let composed = quarter(&case, expected_s / 801.0, |bodies, h_s| {
            rattle_step(&mut world, bodies, Composition::Yoshida6, h_s);
        });
        let mut method = RungeKutta::<Dop853, _, f64>::new(case.bodies.clone(), case.bodies.zero_rates());
        let stepped = quarter(&case, expected_s / 201.0, |bodies, h_s| {
            method.step(bodies, 0.0, h_s, &mut world).unwrap();
            System::settle(&mut world, 0.0, bodies).unwrap();
        });
        let errors = [composed, stepped].map(|quarter_s| (4.0 * quarter_s / expected_s - 1.0).abs());
        println!("{amplitude_rad} rad: Yoshida6 {:e}, Dop853 {:e}", errors[0], errors[1]);
        assert!(errors[0] < 1e-9 && errors[1] < 1e-9, "{amplitude_rad} rad: {errors:?}");
    }
}

/// Two bodies in a plane, hinged at the origin and to each other, by Lagrange's equations in their angles from below.
#[test]
fn a_double_pendulum_moves_by_lagranges_equations() {
    let (mass, arm, length) = ([1.7, 0.6], [0.3, 0.25], 0.5);
    let ((first, i_1), (second, i_2)) =
        (skew(mass[0], [0.02, 0.05, 0.06], 0.9), skew(mass[1], [0.01, 0.02, 0.025], -1.3));
    let start = [2.0_f64, 2.6];
    let along = |angle: f64, r: f64| turned([0.0, 1.0, 0.0], -angle).apply(vector([0.0, 0.0, -r]));
    let mut case = Case::default();
    let knee = along(start[0], length);
    let a = case.body(along(start[0], arm[0]).into(), turned([0.0, 1.0, 0.0], -start[0]), first);
    let b = case.body((knee + along(start[1], arm[1])).into(), turned([0.0, 1.0, 0.0], -start[1]), second);
    case.hinge(a, None, [0.0; 3], [0.0, 1.0, 0.0]);
    case.hinge(b, Some(a), knee.into(), [0.0, 1.0, 0.0]);

    let alpha = i_1 + mass[0] * arm[0] * arm[0] + mass[1] * length * length;
    let beta = i_2 + mass[1] * arm[1] * arm[1];
    let gamma = mass[1] * length * arm[1];
    let pull = [(mass[0] * arm[0] + mass[1] * length) * GRAVITY, mass[1] * arm[1] * GRAVITY];
    let mut equations = |_: f64, y: &[f64; 4], rate: &mut [f64; 4]| {
        let [q_1, q_2, v_1, v_2] = *y;
        let (sin, cos) = (q_1 - q_2).sin_cos();
        let b = [-gamma * sin * v_2 * v_2 - pull[0] * q_1.sin(), gamma * sin * v_1 * v_1 - pull[1] * q_2.sin()];
        let off = gamma * cos;
        let determinant = alpha * beta - off * off;
        *rate = [v_1, v_2, (beta * b[0] - off * b[1]) / determinant, (alpha * b[1] - off * b[0]) / determinant];
    };
    let mut reference = Fixed::<Dop853, _, f64>::new(0.0, [start[0], start[1], 0.0, 0.0], [0.0; 4], 1e-3).unwrap();
    for _ in 0..1000 {
        reference.step(&mut equations).unwrap();
    }
    let y = *reference.state();
    let expected = along(y[0], length) + along(y[1], arm[1]);
    let error = |end: &Bodies<f64>| (end.position[b].position() - expected).norm_sq().sqrt();
    let stepped = error(&run::<Dop853>(&case, (5e-3, 200), true));
    let composed = error(&crate::cases::after(&case, Composition::Yoshida6, 2.5e-3, 400));
    println!("Dop853 {stepped:e} m, Yoshida6 {composed:e} m");
    assert!(stepped < 1e-9 && composed < 1e-8, "Dop853 {stepped:e} m, Yoshida6 {composed:e} m");
}

const TOP_MASS: f64 = 0.5;
const TOP_ARM: f64 = 0.1;
/// About the centre of mass, across and along the axis.
const TOP_MOMENTS: [f64; 2] = [8e-4, 5e-4];

/// A top on a ball joint at the origin, inclined in the plane of x and z, with the angular velocity as given along its
/// axis and about the vertical.
fn top(inclination_rad: f64, spin: f64, precession: f64) -> Case {
    let [across, along] = TOP_MOMENTS;
    let tilt = turned([0.0, 1.0, 0.0], inclination_rad);
    let axis = tilt.apply(vector([0.0, 0.0, 1.0]));
    let mut case = Case::default();
    let body = case.body(
        (axis * TOP_ARM).into(),
        tilt,
        Inertia::new(TOP_MASS, inertia_tensor([across, across, along], Rotor::default())).unwrap(),
    );
    case.ball(body, None, [0.0; 3]);
    let omega = axis * spin + vector([0.0, 0.0, precession]);
    let velocity = Vector::new(omega.e2 * axis.e3 - omega.e3 * axis.e2, omega.e3 * axis.e1 - omega.e1 * axis.e3, 0.0);
    case.moving(body, (velocity * TOP_ARM).into(), omega.into());
    case.settled()
}

/// `A W² cos - C w W + m g l = 0` for the precession W, with A about the fixed point and w the whole spin about the axis.
#[test]
fn a_top_on_a_ball_joint_precesses_steadily() {
    let inclination_rad = 0.8_f64;
    let (a, c) = (TOP_MOMENTS[0] + TOP_MASS * TOP_ARM * TOP_ARM, TOP_MOMENTS[1]);
    let spin = 300.0;
    let (half, weight) = (0.5 * c * spin, TOP_MASS * GRAVITY * TOP_ARM);
    let slow = weight / (half + (half * half - a * weight * inclination_rad.cos()).sqrt());
    let case = top(inclination_rad, spin - slow * inclination_rad.cos(), slow);
    let (steps, h_s) = (600, 1e-3);
    let end = crate::cases::after(&case, Composition::Yoshida6, h_s, steps);
    let position = end.position[0];
    let angle = (position.y.atan2(position.x) - slow * h_s * f64::from(steps)).rem_euclid(std::f64::consts::TAU);
    let error = angle.min(std::f64::consts::TAU - angle) / (slow * h_s * f64::from(steps));
    let inclined = ((position.z / TOP_ARM).acos() - inclination_rad).abs();
    println!("precession {slow} rad/s: off by {error:e}, inclination by {inclined:e} rad");
    assert!(error < 1e-9 && inclined < 1e-9, "{error:e} {inclined:e}");
}

/// The same top let go without precession nods. `A theta'' = -dV/dtheta` of the effective potential with
/// `phi' = (p_phi - p_psi cos) / (A sin²)`.
#[test]
fn a_top_that_nods_moves_by_its_equations_in_eulers_angles() {
    let (inclination_rad, spin) = (0.8_f64, 150.0);
    let case = top(inclination_rad, spin, 0.0);
    let (a, c) = (TOP_MOMENTS[0] + TOP_MASS * TOP_ARM * TOP_ARM, TOP_MOMENTS[1]);
    let (p_psi, p_phi) = (c * spin, c * spin * inclination_rad.cos());
    let mut equations = |_: f64, y: &[f64; 3], rate: &mut [f64; 3]| {
        let (sin, cos) = y[1].sin_cos();
        let precession = (p_phi - p_psi * cos) / (a * sin * sin);
        let torque =
            TOP_MASS * GRAVITY * TOP_ARM * sin + a * precession * precession * sin * cos - p_psi * precession * sin;
        *rate = [precession, y[2], torque / a];
    };
    let mut reference = Fixed::<Dop853, _, f64>::new(0.0, [0.0, inclination_rad, 0.0], [0.0; 3], 1e-3).unwrap();
    for _ in 0..600 {
        reference.step(&mut equations).unwrap();
    }
    let [phi, theta, _] = *reference.state();
    let expected = vector([theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()]) * TOP_ARM;
    let error = |end: &Bodies<f64>| (end.position[0].position() - expected).norm_sq().sqrt() / TOP_ARM;
    let stepped = error(&run::<Dop853>(&case, (2e-3, 300), true));
    let composed = error(&crate::cases::after(&case, Composition::Yoshida6, 1e-3, 600));
    println!("after {phi} rad of precession: Dop853 {stepped:e} rad, Yoshida6 {composed:e} rad");
    assert!(stepped < 1e-9 && composed < 1e-9, "{stepped:e} {composed:e}");
}

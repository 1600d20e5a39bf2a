//! A body that nothing turns, of moments 1, 2, 3, spun about its middle axis: 10,000 steps of 0.01 s.
//!
//! Errors are angles to the attitude that a Taylor series gives in 40 digits (the study of formulations says how).

use crate::measure::{Rounds, time_call};
use crate::report::spread;
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::{Bivector, Rotor, Vector};
use ga_physics::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use ga_physics::rigid::{Bodies, Form, Inertia, Method, Motion, Setup, Solver};
use rapier3d_f64::prelude::{MassProperties, PhysicsWorld, RigidBodyBuilder, Vector as RapierVector};
use std::io::{Result, Write};

const MOMENTS: [f64; 3] = [1.0, 2.0, 3.0];
const OMEGA_BODY: [f64; 3] = [0.01, 1.0, 0.01];
const DT_S: f64 = 0.01;
const STEPS: u32 = 10_000;

/// The attitude after 100 s.
#[expect(clippy::excessive_precision, reason = "as it was computed")]
fn reference() -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::new(
        -0.01564624151485416038135,
        0.9654395742742694767098,
        -0.00007971609403975472696471,
        -0.2601569088010551290163,
    ))
}

/// From the arc tangent: the cosine is blind below 1e-8.
fn error_rad(end: UnitQuaternion<f64>) -> f64 {
    let between = end.inverse() * reference();
    2.0 * between.imag().norm().atan2(between.w.abs())
}

type Run = Box<dyn Fn() -> std::result::Result<UnitQuaternion<f64>, String>>;

/// Every way beside rapier, which is the first.
pub fn free_body(out: &mut impl Write, rounds: usize) -> Result<()> {
    let mut ways: Vec<(String, u32, Run)> = vec![
        ("rapier".into(), STEPS, Box::new(|| Ok(rapier()))),
        ("rk4 on nalgebra's quaternion".into(), STEPS, Box::new(|| Ok(by_hand()))),
    ];
    for form in [Form::Quaternion, Form::Rotor, Form::Motor] {
        ways.push((format!("ga-physics {} rk4", form.name()), STEPS, ours(form, Method::Rk4, STEPS)));
    }
    for (method, steps) in [
        (Method::Rkmk4, STEPS),
        (Method::CommutatorFree, STEPS),
        (Method::Splitting6, STEPS),
        (Method::Verlet, STEPS),
        (Method::Verlet, 100),
    ] {
        ways.push((
            format!("ga-physics rotor {}, {steps} steps", method.name()),
            steps,
            ours(Form::Rotor, method, steps),
        ));
    }
    let times = Rounds::take(ways.len(), rounds, |way| time_call(|| drop((ways[way].2)())));
    writeln!(out, "\nA free body of moments 1, 2, 3, spun about its middle axis, 100 s:")?;
    writeln!(
        out,
        "\n| way | attitude error at 100 s (rad) | CPU ns per step | over rapier | over the hand-written RK4 |"
    )?;
    writeln!(out, "|---|---:|---:|---:|---:|")?;
    for (i, (name, steps, run)) in ways.iter().enumerate() {
        let error = run().map_or_else(|error| error, |end| format!("{:.1e}", error_rad(end)));
        let step = spread(times.time(i), 1e9 / f64::from(*steps), 0);
        let (over_rapier, over_hand) = (spread(times.ratio(i, 0), 1.0, 4), spread(times.ratio(i, 1), 1.0, 3));
        writeln!(out, "| {name} | {error} | {step} | {over_rapier} | {over_hand} |")?;
    }
    Ok(())
}

/// Its defaults: gyroscopic forces, four substeps.
fn rapier() -> UnitQuaternion<f64> {
    let mut world = PhysicsWorld::new();
    world.gravity = RapierVector::new(0.0, 0.0, 0.0);
    world.integration_parameters.dt = DT_S;
    let vector = |v: [f64; 3]| RapierVector::new(v[0], v[1], v[2]);
    let mass = MassProperties::new(vector([0.0; 3]), 1.0, vector(MOMENTS));
    let builder = RigidBodyBuilder::dynamic().additional_mass_properties(mass).can_sleep(false);
    let handle = world.insert_body(builder.angvel(vector(OMEGA_BODY)));
    for _ in 0..STEPS {
        world.step();
    }
    let q = world.bodies[handle].rotation();
    UnitQuaternion::new_normalize(Quaternion::new(q.w, q.x, q.y, q.z))
}

fn by_hand() -> UnitQuaternion<f64> {
    let inverse = Vector3::from(MOMENTS.map(f64::recip));
    let momentum = Vector3::from(MOMENTS).component_mul(&Vector3::from(OMEGA_BODY));
    let rate = |q: Quaternion<f64>| {
        let omega = UnitQuaternion::new_unchecked(q).inverse_transform_vector(&momentum).component_mul(&inverse);
        q * Quaternion::from_imag(omega) * 0.5
    };
    let mut q = UnitQuaternion::identity();
    for _ in 0..STEPS {
        let start = q.into_inner();
        let k1 = rate(start);
        let k2 = rate(start + k1 * (0.5 * DT_S));
        let k3 = rate(start + k2 * (0.5 * DT_S));
        let k4 = rate(start + k3 * DT_S);
        q = UnitQuaternion::new_normalize(start + (k1 + (k2 + k3) * 2.0 + k4) * (DT_S / 6.0));
    }
    q
}

fn ours(form: Form, method: Method, steps: u32) -> Run {
    Box::new(move || {
        let diagonal = std::array::from_fn(|r| std::array::from_fn(|c| if r == c { MOMENTS[r] } else { 0.0 }));
        let inertia = Inertia::new(1.0, diagonal).map_err(|error| error.to_string())?;
        let mut bodies = Bodies::default();
        let spin = inertia.momentum_of(Bivector::from(OMEGA_BODY));
        bodies.push(Point::origin(), Rotor::default(), Vector::default(), spin);
        let setup = Setup { inertias: vec![inertia], ..Setup::default() };
        let end_s = DT_S * f64::from(STEPS);
        let solver = Solver::fixed(method, end_s / f64::from(steps)).in_form(form);
        let mut motion = Motion::new(setup, &bodies, &solver).map_err(|error| error.to_string())?;
        motion.advance(&mut bodies, 0.0, end_s).map_err(|error| error.to_string())?;
        Ok(bodies.rotor[0].into())
    })
}

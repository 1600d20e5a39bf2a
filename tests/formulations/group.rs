//! The steppers on groups: what they keep without being brought back, what they do exactly, dense output, steps by tolerance.

use super::reference::{quaternion, split};
use super::ways::{Case, Pace, spinning, ways};
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::Vector;
use ga_physics::ode::lie::{CommutatorFree4, LieMethod, LieRungeKutta, LieState, LieStepper, Rkmk4};
use ga_physics::ode::{OdeError, Rk4, Run, RungeKutta, Stepper, Tolerance, ToleranceError};
use ga_physics::rigid::{Bodies, Formulation, motor};
use nalgebra::UnitQuaternion;

const MOMENTS: [f64; 3] = [1.0, 2.0, 2.5];
const OMEGA: [f64; 3] = [0.6, 0.4, 0.8];

/// Steps without anything after them.
fn bare<M: LieMethod, F: Formulation<f64> + LieState<f64>>(case: &Case<f64>, h: f64, steps: u32) -> F
where
    F::Rate: Clone,
{
    let mut state = F::from_bodies(&case.bodies);
    let mut method = LieRungeKutta::<M, F, f64>::new(state.clone(), state.zero_rates());
    let mut system = case.system();
    for step in 0..steps {
        method.step(&mut state, h * f64::from(step), h, &mut system).unwrap();
    }
    state
}

#[test]
fn versors_stay_on_the_group_by_themselves() {
    // Each product rounds by a few eps; classical RK4 leaves by 6e-4 in the same steps.
    const ROUNDED: f64 = 1000.0 * 4.0 * f64::EPSILON;
    let case = spinning(1.0, MOMENTS, [2.0, 3.0, 1.0]);
    assert!(bare::<Rkmk4, Bodies<f64>>(&case, 0.1, 1000).rotor[0].is_unit(ROUNDED));
    assert!(bare::<CommutatorFree4, Bodies<f64>>(&case, 0.1, 1000).rotor[0].is_unit(ROUNDED));
    assert!(bare::<Rkmk4, motor::State<f64>>(&case, 0.1, 1000).motor[0].is_unit(ROUNDED));
    assert!(bare::<CommutatorFree4, motor::State<f64>>(&case, 0.1, 1000).motor[0].is_unit(ROUNDED));
    let mut state = case.bodies.clone();
    let mut rk4 = RungeKutta::<Rk4, _, f64>::new(state.clone(), state.zero_rates());
    let mut system = case.system();
    for _ in 0..1000 {
        rk4.step(&mut state, 0.0, 0.1, &mut system).unwrap();
    }
    assert!(!state.rotor[0].is_unit(1e-4));
}

#[test]
fn a_screw_is_one_step_of_the_motor_form() {
    // A sphere spins about the way that it flies: a constant twist, whose exponential is the motion.
    let mut case: Case<f64> = spinning(1.0, [1.0; 3], [0.0, 0.0, 3.0]);
    case.bodies.momentum[0] = Vector::new(0.0, 0.0, 5.0);
    for way in ways().into_iter().filter(|way| way.form == "motor") {
        let end = way.run(&case, Pace::Fixed(1.0), 1.0);
        let angle = quaternion(end.rotor[0]).angle_to(&UnitQuaternion::from_scaled_axis([0.0, 0.0, 3.0].into()));
        let place = end.position[0].distance_sq_to(Point::new(0.0, 0.0, 5.0)).sqrt();
        let exact = angle < 1e-14 && place < 1e-14;
        let on_group = ["rkmk4", "commutator_free"].contains(&way.method);
        assert_eq!(exact, on_group, "{}: {angle:e} rad, {place:e} m", way.name());
    }
}

/// Times that are no ends of steps, and the attitudes then.
type References = Vec<(f64, UnitQuaternion<f64>)>;

const DURATION_S: f64 = 2.0;

/// The largest error between the ends of steps, rad.
fn worst_between<M: LieMethod, F: Formulation<f64> + LieState<f64>>(steps: u32, references: &References) -> f64
where
    F::Rate: Clone,
{
    let case = spinning(1.0, MOMENTS, OMEGA);
    let start = F::from_bodies(&case.bodies);
    let (rates, mut out) = (start.zero_rates(), start.clone());
    let mut system = case.system();
    let h = DURATION_S / f64::from(steps);
    let mut stepper = LieStepper::<M, F, f64>::fixed(0.0, start, rates, h).unwrap();
    let mut bodies = case.bodies.clone();
    let mut worst = 0.0_f64;
    for (t, reference) in references {
        stepper.advance_to(&mut system, *t, &mut out).unwrap();
        out.write_to(&mut bodies);
        assert!(bodies.rotor[0].is_unit(8.0 * f64::EPSILON));
        worst = worst.max(quaternion(bodies.rotor[0]).angle_to(reference));
    }
    worst
}

#[test]
fn dense_output_is_of_order_four_and_on_the_group() {
    let times = (0..16).map(|index| DURATION_S * (f64::from(index) + 0.37) / 16.0);
    let at = |t| (t, split(MOMENTS, OMEGA, UnitQuaternion::identity(), t, 100));
    let references: &References = &times.map(at).collect();
    for (name, errors) in [
        ("rotor rkmk4", [32, 64].map(|steps| worst_between::<Rkmk4, Bodies<f64>>(steps, references))),
        ("rotor commutator_free", [32, 64].map(|n| worst_between::<CommutatorFree4, Bodies<f64>>(n, references))),
        ("motor rkmk4", [32, 64].map(|steps| worst_between::<Rkmk4, motor::State<f64>>(steps, references))),
        ("motor commutator_free", [32, 64].map(|n| worst_between::<CommutatorFree4, motor::State<f64>>(n, references))),
    ] {
        let order = (errors[0] / errors[1]).log2();
        println!("{name}: {errors:?}, order {order:.2}");
        // The times do not fall at the same parts of the steps.
        assert!(order > 3.5, "{name}: order {order}, errors {errors:?}");
    }
}

#[test]
fn the_estimate_falls_like_the_fourth_power_of_the_step() {
    let case = spinning(1.0, MOMENTS, OMEGA);
    for way in ways::<f64>().into_iter().filter(|way| ["rkmk4", "commutator_free"].contains(&way.method)) {
        let [few, many] = [1e-6, 1e-10].map(|size| (way.solve)(&case, Pace::Tolerance(size), 8.0).unwrap().1);
        let ratio = many.accepted as f64 / few.accepted as f64;
        println!("{}: {few:?}, {many:?}", way.name());
        assert!((ratio - 10.0).abs() < 1.5, "{}: {ratio} times the steps for 1e-4 of the error", way.name());
        // Four evaluations a try, one more where the rotor was brought back to unit norm after the step.
        assert!(many.rhs_evals <= 5 * (many.accepted + many.rejected) + 3, "{}: {many:?}", way.name());
        assert!(many.rejected * 10 <= many.accepted, "{}: {many:?}", way.name());
    }
}

#[test]
fn the_stepper_stops_restarts_and_refuses_like_the_others() {
    let case = spinning(1.0, MOMENTS, OMEGA);
    let mut system = case.system();
    let (start, rates) = (case.bodies.clone(), case.bodies.zero_rates());
    let size = Tolerance { rtol: 1e-9, atol: 1e-9 };
    let new = || LieStepper::<CommutatorFree4, _, f64>::adaptive(0.0, start.clone(), rates.clone(), size).unwrap();
    let mut stepper = new();
    stepper.stop_at(1.0);
    stepper.pass(&mut system, 1.0).unwrap();
    assert_eq!(stepper.time_s(), 1.0);
    assert!(matches!(stepper.step(&mut system), Err(OdeError::Stopped { .. })));
    let at_stop = stepper.state().clone();
    let mut out = at_stop.clone();
    let early = stepper.start_s() * 0.5;
    assert!(matches!(stepper.interpolate(&mut system, early, &mut out), Err(OdeError::Past { .. })));
    // The way on is the same from another stepper that starts there.
    stepper.stop_at(f64::INFINITY);
    stepper.restart(1.0, &at_stop);
    stepper.advance_to(&mut system, 2.0, &mut out).unwrap();
    let mut again = new();
    again.restart(1.0, &at_stop);
    let mut other = at_stop.clone();
    again.advance_to(&mut system, 2.0, &mut other).unwrap();
    assert_eq!(out, other);
    // A spin whose square overflows has no velocity.
    let mut broken = case.bodies.clone();
    broken.angular_momentum[0] = broken.angular_momentum[0] * 1e300;
    stepper.restart(0.0, &broken);
    assert!(stepper.pass(&mut system, 1.0).is_err());
    let mut fixed = LieStepper::<Rkmk4, _, f64>::fixed(0.0, broken.clone(), rates.clone(), 0.1).unwrap();
    assert!(fixed.pass(&mut system, 1.0).is_err());
    assert_eq!(fixed.state(), &broken);
    // Nonsense is refused by name.
    let size = Tolerance { rtol: 0.0, atol: 1e-9 };
    let refused = LieStepper::<Rkmk4, _, f64>::adaptive(0.0, start.clone(), rates.clone(), size);
    assert!(matches!(refused, Err(ToleranceError::Relative { .. })));
    assert!(LieStepper::<Rkmk4, _, f64>::fixed(0.0, start.clone(), rates.clone(), -1.0).is_err());
}

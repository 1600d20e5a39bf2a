//! The study of formulations: its reference, its figures, its verdict, what it writes.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use ga_physics::rigid::{Form, Method};
use ga_physics::study::formulations::{
    END_S, Figures, Outcome, Scope, lines_of_code, reference, run_fixed, run_scope, traits,
};
use nalgebra::{UnitQuaternion, Vector3};

/// The free body split into rotations about its axes (Reich 1994), composed to order 6 (Yoshida 1990).
fn split(steps: u32) -> UnitQuaternion<f64> {
    let moments = [1.0, 2.0, 3.0];
    let (mut momentum, mut attitude) = (Vector3::new(0.01, 2.0, 0.03), UnitQuaternion::identity());
    const OUTER: [f64; 3] = [0.784_513_610_477_560, 0.235_573_213_359_357, -1.177_679_984_178_87];
    let middle = 1.0 - 2.0 * OUTER.iter().sum::<f64>();
    let h = END_S / f64::from(steps);
    for _ in 0..steps {
        for weight in [OUTER[0], OUTER[1], OUTER[2], middle, OUTER[2], OUTER[1], OUTER[0]] {
            for (axis, share) in [(0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5)] {
                let mut turn = Vector3::zeros();
                turn[axis] = momentum[axis] / moments[axis] * h * weight * share;
                let turn = UnitQuaternion::from_scaled_axis(turn);
                attitude *= turn;
                momentum = turn.inverse() * momentum;
            }
        }
    }
    attitude
}

#[test]
fn the_reference_agrees_with_a_splitting() {
    let [coarse, fine] = [1000, 2000].map(|steps| (split(steps).coords - reference().coords).norm());
    println!("{coarse:e}, {fine:e}");
    // Of order 6, until the rounding of the weights of 15 digits is met.
    assert!(fine < 1e-9 && coarse > 30.0 * fine, "{coarse:e}, {fine:e}");
}

/// The figures of so many steps.
fn figures(form: Form, method: Method, steps: u32) -> Figures {
    run_fixed(form, method, steps).unwrap().figures().unwrap().clone()
}

#[test]
fn errors_fall_as_the_orders_say_and_forms_agree() {
    for (form, method, order) in [
        (Form::Matrix, Method::Rk4, 4.0),
        (Form::Quaternion, Method::Rk4, 4.0),
        (Form::Rotor, Method::Rk4, 4.0),
        (Form::Motor, Method::Rk4, 4.0),
        (Form::Rotor, Method::Rkmk4, 4.0),
        (Form::Motor, Method::CommutatorFree, 4.0),
        (Form::Rotor, Method::Splitting2, 2.0),
        (Form::Rotor, Method::Splitting4, 4.0),
    ] {
        let [coarse, fine] = [2000, 4000].map(|steps| figures(form, method, steps).error_rad);
        let observed = (coarse / fine).log2();
        // The body turns over, which magnifies errors, those of higher order more than others.
        assert!(observed > order - 0.5 && observed < order + 1.5, "{form:?} {method:?}: {observed}");
    }
    let [matrix, quaternion, rotor, motor] = Form::ALL.map(|form| figures(form, Method::Rk4, 2000));
    // The same arithmetic in another order.
    assert!((rotor.error_rad / quaternion.error_rad - 1.0).abs() < 1e-2, "{rotor:?}, {quaternion:?}");
    assert!((motor.error_rad / quaternion.error_rad - 1.0).abs() < 1e-2, "{motor:?}, {quaternion:?}");
    assert!(matrix.norm_drift > 1e3 * rotor.norm_drift, "the matrix drifts, and is seen to");
    assert!(figures(Form::Rotor, Method::Verlet, 100).error_rad < 1e-10, "the exact free motion is exact");
    // Steps of 1 s turn too far for Runge and Kutta's method, and are refused in a sentence.
    let refused = run_fixed(Form::Rotor, Method::Rk4, 100).unwrap();
    assert!(matches!(refused.outcome, Outcome::Failed { .. }), "{refused:?}");
}

#[test]
fn what_holds_of_a_formulation_is_counted() {
    assert_eq!(lines_of_code("//! doc\n\nfn a() {\n    // why\n    b() // what\n}\n"), 3);
    let traits = traits().unwrap();
    let of = |form: &str| traits.iter().find(|it| it.form == form).unwrap();
    assert_eq!(["matrix", "quaternion", "rotor", "motor"].map(|form| of(form).bytes_per_body), [144, 104, 104, 136]);
    for it in &traits {
        assert!(it.lines_of_rhs > 5 && it.lines_of_rhs < it.lines_of_code, "{it:?}");
        // The motor errs where it flies, the others do not.
        assert_eq!(it.flight_error_m > 1e-9, it.form == "motor", "{it:?}");
    }
}

#[test]
fn what_is_written_can_be_read_and_says_what_to_pick() {
    let out = tempfile::tempdir().unwrap();
    let scope = Scope {
        step_factor: 2,
        step_count: 2,
        standard_steps: 1600,
        tolerance_stride: 6,
        budget: std::time::Duration::ZERO,
    };
    let report = run_scope(&scope, "a test", out.path(), &mut |_| ()).unwrap();
    let text = |name: &str| std::fs::read_to_string(out.path().join(name)).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text("formulations.json")).unwrap();
    assert_eq!(json["rows"].as_array().unwrap().len(), report.rows.len());
    assert!(json["rows"].as_array().unwrap().iter().any(|row| row["done"]["time"]["ratio"]["value"].is_f64()));
    let page = text("formulations.md");
    assert!(page.contains(&report.verdict) && page.contains("`a test`"), "{page}");
    for word in ["Pick the", "free_flight", "within 1e-3 rad"] {
        assert!(report.verdict.contains(word), "{}", report.verdict);
    }
    assert!(text("formulations.svg").contains("</svg>"));
    assert!(report.between.screw_m < 1e-15 && report.between.separate_m > 0.1);
    // The cheapest within an error is within it, and was timed.
    let row = report.cheapest(1e-6, |row| row.setting.form == "rotor").unwrap();
    assert!(row.figures().unwrap().error_rad <= 1e-6 && row.ratio().is_some());
    // The formula for unit quaternions, on stages that are not unit, is what the plain one errs by.
    let rotor = report.standard("rk4", "rotor").unwrap().figures().unwrap().error_rad;
    assert!(report.plain_error_rad > 5.0 * rotor, "{} {rotor}", report.plain_error_rad);
}

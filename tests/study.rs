//! The study of solvers: errors fall as the orders say, what arrives has figures, what is written can be read.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use ga_physics::study::Provenance;
use ga_physics::study::solvers::{CaseReport, Ladder, Outcome, Row, Scope, SolverReport, examine, kepler, pendulum};
use std::time::Duration;

/// Two numbers of steps, the second four times the first; two tolerances, a thousand to one.
fn scope(first: u32) -> Scope {
    let steps = Ladder { first, stride: 2, count: 2 };
    Scope { steps, tolerances: Ladder { first: 6, stride: 3, count: 2 }, budget: Duration::ZERO }
}

fn rows<'a>(report: &'a CaseReport, method: &str, constraints: Option<&str>) -> Vec<&'a Row> {
    let wanted = |row: &&Row| row.setting.method == method && row.setting.constraints == constraints;
    report.rows.iter().filter(wanted).collect()
}

/// How many powers of four the error falls from the first row to the second.
fn observed_order(rows: &[&Row]) -> f64 {
    let [coarse, fine] = rows else { panic!("{} rows", rows.len()) };
    (coarse.figures().unwrap().error_m / fine.figures().unwrap().error_m).log(4.0)
}

#[test]
fn errors_on_an_orbit_fall_with_the_order_of_the_method() {
    let report = examine(&kepler(), &scope(10)).unwrap();
    // The orbit is long for these steps: what is observed is within a third of the order, from 1024 steps on.
    for (method, order) in [("euler", 1.0), ("rk4", 4.0), ("verlet", 2.0), ("yoshida4", 4.0), ("yoshida6", 6.0)] {
        let observed = observed_order(&rows(&report, method, None));
        assert!((observed / order - 1.0).abs() < 1.0 / 3.0, "{method}: {observed}");
    }
    for method in ["rk4_doubling", "cash_karp", "tsit5", "dop853"] {
        let [loose, tight] = rows(&report, method, None)[..] else { panic!("{method}") };
        let (loose, tight) = (loose.figures().unwrap(), tight.figures().unwrap());
        // An error in proportion to the tolerance falls by 1000; one of it to the power of 4/5, by 250.
        assert!(loose.error_m > 250.0 * tight.error_m, "{method}: {} {}", loose.error_m, tight.error_m);
        assert!(tight.rhs_evals > loose.rhs_evals, "{method}");
    }
    assert!(report.cheapest("euler", 1e-3).is_none(), "the bad method is bad");
    let [verlet, rk4] =
        ["verlet", "rk4"].map(|method| report.cheapest(method, 1e-2).unwrap().figures().unwrap().rhs_evals);
    assert_eq!((verlet, rk4), (4097, 4097), "steps of their own length: one evaluation a step, and four");
    assert!(rows(&report, "xpbd", None).is_empty(), "nothing is held");
}

#[test]
fn errors_on_a_pendulum_fall_and_its_length_is_held() {
    let report = examine(&pendulum(), &scope(10)).unwrap();
    for (method, order) in [("verlet", 2.0), ("yoshida4", 4.0), ("rk4", 4.0)] {
        let observed = observed_order(&rows(&report, method, Some("direct")));
        assert!(observed > order - 0.5, "{method}: {observed}");
    }
    // By sweeps and by Newton's method: of order 1, where the first error is small enough.
    for constraints in ["sweeps", "direct"] {
        let observed = observed_order(&rows(&report, "xpbd", Some(constraints)));
        assert!(observed > 0.7, "{constraints}: {observed}");
    }
    for figures in report.rows.iter().filter_map(Row::figures) {
        assert!(figures.violation_m.unwrap() < 1e-11, "{figures:?}");
    }
}

#[test]
fn every_row_is_finite_and_what_is_written_can_be_read() {
    let cases: Vec<CaseReport> = [pendulum(), kepler()].iter().map(|case| examine(case, &scope(8)).unwrap()).collect();
    for row in cases.iter().flat_map(|case| &case.rows) {
        let Outcome::Done(figures) = &row.outcome else { panic!("{row:?}") };
        assert!(figures.error_m.is_finite() && figures.energy_drift_rel.is_finite(), "{row:?}");
        assert!(figures.rhs_evals > 0 && figures.accepted > 0 && figures.time.is_none(), "{row:?}");
    }
    let report = SolverReport { provenance: Provenance::gather("a test"), cases };
    let out = tempfile::tempdir().unwrap();
    let files = report.write(out.path()).unwrap();
    let text = |index: usize| std::fs::read_to_string(&files[index]).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text(0)).unwrap();
    let rows = json["cases"][0]["rows"].as_array().unwrap();
    assert_eq!(rows.len(), report.cases[0].rows.len());
    assert!(rows.iter().all(|row| row["done"]["error_m"].is_f64()), "{}", rows[0]);
    assert!(text(1).contains("within 1e-6 m") && text(1).contains("`a test`"));
    assert!(text(2).starts_with("<svg") && ["dop853", "yoshida6"].iter().all(|name| text(2).contains(name)));
}

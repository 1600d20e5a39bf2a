//! Lagrange's heavy top: nutation and precession against theory, by compositions of the exact free motion with kicks.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod body;
mod theory;

use body::Spinning;
use ga_physics::rigid::Method;
use theory::Top;

/// Fast with cusps, slow with loops, thrown against its precession, hanging below the fixed point, and flat.
const TOPS: [Top; 5] = [
    Top { across: 1.0, along: 0.6, weight: 2.0, tilt_rad: 0.5, spin_rad_s: 15.0, precession_rad_s: 0.0 },
    Top { across: 1.0, along: 0.6, weight: 2.0, tilt_rad: 1.0, spin_rad_s: 5.0, precession_rad_s: 0.3 },
    Top { across: 1.0, along: 1.5, weight: 3.0, tilt_rad: 0.8, spin_rad_s: 6.0, precession_rad_s: -0.9 },
    Top { across: 1.0, along: 0.1, weight: 2.0, tilt_rad: 2.5, spin_rad_s: 8.0, precession_rad_s: 0.5 },
    Top { across: 1.0, along: 2.0, weight: 1.0, tilt_rad: 1.2, spin_rad_s: 4.0, precession_rad_s: 0.2 },
];

const NUTATIONS: u32 = 10;

fn errors(top: Top, method: Method, steps: u32) -> [f64; 2] {
    let mut spinning = Spinning::new(top, method, steps);
    (0..NUTATIONS).for_each(|index| spinning.nutate(index, 1.0));
    spinning.frequency_errors(NUTATIONS)
}

/// For small nutations of a fast top: `a/A`, and `w/a` from cusp to cusp.
#[test]
fn theory_meets_the_textbook() {
    let top = Top { spin_rad_s: 1e4, ..TOPS[0] };
    let theory = top.theory();
    let a = top.along * top.spin_rad_s;
    let nutation = std::f64::consts::TAU / theory.period_s;
    assert!((nutation * top.across / a - 1.0).abs() < 1e-6);
    assert!((theory.advance_rad / theory.period_s * a / top.weight - 1.0).abs() < 1e-6);
    let [u1, u2, _] = theory.turning;
    // 2 A w sin² / a²
    let fall = 2.0 * top.across * top.weight * top.tilt_rad.sin().powi(2) / (a * a);
    assert!(((u1 - u2) / fall - 1.0).abs() < 1e-6);
}

#[test]
fn frequencies_are_those_of_theory() {
    for top in TOPS {
        let [nutation, precession] = errors(top, Method::Yoshida6, 60);
        println!("{:?} {nutation:.1e} {precession:.1e}", top.theory());
        assert!(nutation.abs() < 1e-9 && precession.abs() < 1e-9, "{top:?}: {nutation:e} {precession:e}");
        let [nutation, precession] = errors(top, Method::Verlet, 60);
        assert!(nutation.abs().max(precession.abs()) > 1e-6, "order 2 should be seen: {nutation:e} {precession:e}");
    }
}

#[test]
fn they_converge_at_the_order_of_the_composition() {
    for (method, order, steps) in [(Method::Verlet, 2.0, 40), (Method::Yoshida4, 4.0, 30), (Method::Yoshida6, 6.0, 16)]
    {
        let [coarse, fine] = [steps, 2 * steps].map(|steps| errors(TOPS[1], method, steps)[0].abs());
        let observed = (coarse / fine).log2();
        assert!((observed - order).abs() < 0.4, "{method:?}: {observed}, {coarse:e} {fine:e}");
    }
}

/// The energy swings; the vertical momentum and the energy do not leave.
#[test]
fn nothing_drifts() {
    let mut spinning = Spinning::new(TOPS[0], Method::Yoshida4, 20);
    let (energy, vertical) = (spinning.energy(), spinning.vertical());
    let mut worst = |parts: u32| {
        let mut worst = 0.0_f64;
        for index in 0..parts {
            // At whole nutations the error is back where it began.
            spinning.nutate(index, 0.37);
            worst = worst.max((spinning.energy() / energy - 1.0).abs());
        }
        worst
    };
    let (early, late) = (worst(100), worst(1500));
    assert!(early > 1e-12 && late < 2.0 * early, "{early:e} {late:e}");
    assert!((spinning.vertical() / vertical - 1.0).abs() < 1e-13);
}

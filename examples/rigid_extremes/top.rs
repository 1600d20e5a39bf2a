//! Lagrange's heavy top: frequencies against theory, and the energy of a long run.

use super::body::Spinning;
use super::theory::Top;
use ga_physics::rigid::Method;

const METHODS: [Method; 7] = [
    Method::Verlet,
    Method::Yoshida4,
    Method::Yoshida6,
    Method::Splitting2,
    Method::Splitting4,
    Method::Splitting6,
    Method::Rk4,
];

const FAST: Top = Top { across: 1.0, along: 0.6, weight: 2.0, tilt_rad: 0.5, spin_rad_s: 15.0, precession_rad_s: 0.0 };
const SLOW: Top = Top { spin_rad_s: 5.0, tilt_rad: 1.0, precession_rad_s: 0.3, ..FAST };

pub(crate) fn frequencies() {
    println!("\n## Heavy top: errors of the frequencies over 20 nutations\n");
    println!("Moments 1, 1, 0.6 about the fixed point, m g l = 2.\n");
    println!("| top | method | steps a nutation | nutation | precession |\n|---|---|---|---|---|");
    for (name, top) in [("15 rad/s, from rest", FAST), ("5 rad/s, with loops", SLOW)] {
        for method in METHODS {
            for steps in [30, 60, 120, 240] {
                let mut spinning = Spinning::new(top, method, steps);
                (0..20).for_each(|index| spinning.nutate(index, 1.0));
                let [nutation, precession] = spinning.frequency_errors(20);
                println!(
                    "| {name} | {} | {steps} | {:.1e} | {:.1e} |",
                    method.name(),
                    nutation.abs(),
                    precession.abs()
                );
            }
        }
    }
}

/// Spins of the fast top in a nutation of its.
const SPINS_A_NUTATION: f64 = 15.0 * 0.730_139_828_220_968_7 / std::f64::consts::TAU;

pub(crate) fn energy() {
    println!("\n## Heavy top: error of the energy over 10⁵ revolutions, 30 steps a nutation\n");
    println!("| method | first 10² | 10³ | 10⁴ | 10⁵ | vertical momentum |\n|---|---|---|---|---|---|");
    for method in METHODS {
        let mut spinning = Spinning::new(FAST, method, 30);
        let (start, vertical) = (spinning.energy(), spinning.vertical());
        let (mut worst, mut kept) = (0.0_f64, Vec::new());
        // Not whole nutations, after which the error would be back where it began.
        let part = 0.37;
        let mut index = 0;
        for revolutions in [1e2, 1e3, 1e4, 1e5] {
            while f64::from(index) * part * SPINS_A_NUTATION < revolutions {
                spinning.nutate(index, part);
                worst = worst.max((spinning.energy() / start - 1.0).abs());
                index += 1;
            }
            kept.push(format!("{worst:.1e}"));
        }
        let lost = (spinning.vertical() / vertical - 1.0).abs();
        println!("| {} | {} | {lost:.0e} |", method.name(), kept.join(" | "));
    }
}

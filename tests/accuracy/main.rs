//! What the rewrites of the generator cost in digits, against exact rationals on the inputs as they are: and that the forms
//! that it does not use cost more.
//!
//! Each line of the table has a ceiling of about ten times what was measured; a line of a *bad* form has a floor, so that the
//! comparison is known to see the loss.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod exact;
mod products;
mod rounds;
mod versors;

use std::ops::RangeInclusive;

/// SplitMix64.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Uniform in -1 .. 1.
    pub(crate) fn signed(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn vector(&mut self) -> [f64; 3] {
        [self.signed(), self.signed(), self.signed()]
    }
}

/// One line of the table: what was measured, and where it has to lie.
pub(crate) struct Line {
    what: String,
    worst: f64,
    allowed: RangeInclusive<f64>,
}

/// The table; checked when it is whole, so that all of it is seen.
#[derive(Default)]
pub(crate) struct Table(Vec<Line>);

impl Table {
    /// A form that is used: at most this.
    pub(crate) fn good(&mut self, what: impl Into<String>, worst: f64, ceiling: f64) {
        self.0.push(Line { what: what.into(), worst, allowed: 0.0..=ceiling });
    }

    /// A form that is not: at least this, so that the loss is seen; infinity is a loss as well.
    pub(crate) fn bad(&mut self, what: impl Into<String>, worst: f64, floor: f64) {
        self.0.push(Line { what: format!("(bad) {}", what.into()), worst, allowed: floor..=f64::INFINITY });
    }

    pub(crate) fn check(self) {
        println!("\n{:<72} {:>9}   allowed", "", "worst");
        let mut failed = Vec::new();
        for Line { what, worst, allowed } in self.0 {
            let text = format!("{what:<72} {worst:>9.1e}   {:.0e} to {:.0e}", allowed.start(), allowed.end());
            println!("{text}");
            if !allowed.contains(&worst) {
                failed.push(text);
            }
        }
        assert!(failed.is_empty(), "out of range:\n{}", failed.join("\n"));
    }
}

//! One law suite for all scalars: generated code runs on each by the type alone, and its results are right to the
//! precision of that type. The files of the single types add what only they promise.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod double_double;
mod dual;
mod exact;
mod interval;
mod kernels;
mod lanes;
mod laws;

/// SplitMix64.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in `-bound ..= bound`.
    fn integer(&mut self, bound: u32) -> i32 {
        let count = u64::from(2 * bound + 1);
        i32::try_from(self.bits() % count).unwrap() - i32::try_from(bound).unwrap()
    }

    /// Uniform in -1 .. 1.
    fn signed(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

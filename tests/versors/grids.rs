//! The inputs: logarithmic grids of angles and lengths, and directions.

use ga_physics::algebra::Real;
use std::f64::consts::{FRAC_PI_2, PI};

/// Half angles: zero, every decade from the bottom of f64 to 1, and the neighbourhoods of pi/4, pi/2 and pi, up to `most`.
pub(crate) fn half_angles(most: f64) -> Vec<f64> {
    let mut grid = vec![0.0, 5e-324, 1e-310];
    for decade in -307..=0 {
        // Sines and roots of tiny angles round alike in every decade.
        let mantissas: &[f64] = if decade < -16 { &[3.7] } else { &[1.0, 2.7, 6.3] };
        grid.extend(mantissas.iter().map(|m| m * 10.0f64.powi(decade)));
    }
    for centre in [FRAC_PI_2 / 2.0, FRAC_PI_2, PI] {
        grid.push(centre);
        for k in 1..=16 {
            grid.extend([centre - 10.0f64.powi(-k), centre + 10.0f64.powi(-k)]);
        }
    }
    grid.retain(|p| *p <= most);
    grid
}

/// Directions: the axes, general ones, and ones with a component that hardly shows.
pub(crate) const DIRECTIONS: [[f64; 3]; 6] = [
    [1.0, 0.0, 0.0],
    [0.0, 0.0, -1.0],
    [0.6, 0.0, -0.8],
    [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0],
    [1.0, 1e-9, -1e-17],
    [1e-160, 1.0, 1e-8],
];

pub(crate) fn times<T: Real>(direction: [f64; 3], length: f64) -> [T; 3] {
    direction.map(|x| T::from_f64(x * length))
}

/// SplitMix64.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Between -1 and 1.
    pub(crate) fn signed(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Below a bound.
    pub(crate) fn index(&mut self, bound: usize) -> usize {
        usize::try_from(self.next() % bound as u64).unwrap()
    }
}

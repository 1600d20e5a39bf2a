//! Problems with known solutions.

use ga_physics::ode::{Mechanics, System};
use std::convert::Infallible;

/// Relative motion of two bodies in a plane, `r'' = -r / |r|³`: `[x, y, vx, vy]`.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Kepler {
    pub(crate) evals: u64,
}

fn gravity([x, y]: [f64; 2]) -> [f64; 2] {
    let r_sq = x * x + y * y;
    let factor = -1.0 / (r_sq * r_sq.sqrt());
    [factor * x, factor * y]
}

impl Kepler {
    /// At the nearest point of an orbit with semi-major axis 1 and period 2 pi.
    pub(crate) fn start(eccentricity: f64) -> [f64; 4] {
        [1.0 - eccentricity, 0.0, 0.0, ((1.0 + eccentricity) / (1.0 - eccentricity)).sqrt()]
    }

    /// The state at a time after that, from Kepler's equation `E - e sin E = t`.
    pub(crate) fn solution(eccentricity: f64, t: f64) -> [f64; 4] {
        let mean = t % std::f64::consts::TAU;
        let mut anomaly = mean + eccentricity * mean.sin();
        for _ in 0..50 {
            anomaly -= (anomaly - eccentricity * anomaly.sin() - mean) / (1.0 - eccentricity * anomaly.cos());
        }
        let (sin, cos) = anomaly.sin_cos();
        let minor = (1.0 - eccentricity * eccentricity).sqrt();
        let rate = 1.0 / (1.0 - eccentricity * cos);
        [cos - eccentricity, minor * sin, -sin * rate, minor * cos * rate]
    }

    pub(crate) fn energy([x, y, vx, vy]: [f64; 4]) -> f64 {
        0.5 * (vx * vx + vy * vy) - 1.0 / (x * x + y * y).sqrt()
    }
}

impl System<[f64; 4], f64> for Kepler {
    type Error = Infallible;

    fn rate(&mut self, _: f64, [x, y, vx, vy]: &[f64; 4], rate: &mut [f64; 4]) -> Result<(), Infallible> {
        self.evals += 1;
        let [ax, ay] = gravity([*x, *y]);
        *rate = [*vx, *vy, ax, ay];
        Ok(())
    }
}

impl Mechanics<[f64; 4], f64> for Kepler {
    type Error = Infallible;
    type Acceleration = [f64; 2];

    fn acceleration(&mut self, _: f64, [x, y, ..]: &[f64; 4], out: &mut [f64; 2]) -> Result<(), Infallible> {
        self.evals += 1;
        *out = gravity([*x, *y]);
        Ok(())
    }

    fn kick(&mut self, state: &mut [f64; 4], h_s: f64, acceleration: &[f64; 2]) {
        state[2] += h_s * acceleration[0];
        state[3] += h_s * acceleration[1];
    }

    fn drift(&mut self, _: f64, state: &mut [f64; 4], h_s: f64) -> Result<(), Infallible> {
        state[0] += h_s * state[2];
        state[1] += h_s * state[3];
        Ok(())
    }
}

/// The largest difference of two states.
pub(crate) fn distance<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// `y' = -2 t y²`, nonlinear and nonautonomous: `y = 1 / (1 + t²)`.
pub(crate) fn bell(t: f64, [y]: &[f64; 1], rate: &mut [f64; 1]) {
    *rate = [-2.0 * t * y * y];
}

pub(crate) fn bell_solution(t: f64) -> [f64; 1] {
    [1.0 / (1.0 + t * t)]
}

//! The double pendulum of the cases in angles from the vertical: an answer that knows no constraint.
//!
//! Equal masses on massless links of length l = 1 m, D = theta_1 - theta_2, from the Lagrangian:
//!
//! ```text
//! 2 theta_1'' + cos D theta_2'' = -sin D theta_2'^2 - 2 g sin theta_1
//! cos D theta_1'' + theta_2''   =  sin D theta_1'^2 -   g sin theta_2
//! ```

use crate::cases::{Case, PENDULUM_RAD, Vector};

/// Steps of the classical Runge-Kutta method in one of the case's: 0.13 ms each, so that halving them moves the end by
/// less than 1e-11 m (checked at each use).
const STEPS_PER_STEP: usize = 128;

/// What halving the step may move: four digits below the smallest error that is looked at.
const HALVING_M: f64 = 1e-11;

/// Where the lower particle is at the end of the case.
pub fn end_m(case: &Case) -> Result<Vector, String> {
    let (coarse, fine) = (integrate(case, STEPS_PER_STEP), integrate(case, 2 * STEPS_PER_STEP));
    let moved = crate::cases::distance(coarse, fine);
    if moved > HALVING_M {
        return Err(format!("the reference of the double pendulum moves by {moved:.1e} m when its step is halved"));
    }
    Ok(fine)
}

type Angles = [f64; 4];

fn integrate(case: &Case, steps_per_step: usize) -> Vector {
    let h = case.dt_s / steps_per_step as f64;
    let g = -case.gravity_m_s2[2];
    let mut y = [PENDULUM_RAD, PENDULUM_RAD, 0.0, 0.0];
    for _ in 0..case.steps * steps_per_step {
        let k1 = rate(&y, g);
        let k2 = rate(&moved(&y, h / 2.0, &k1), g);
        let k3 = rate(&moved(&y, h / 2.0, &k2), g);
        let k4 = rate(&moved(&y, h, &k3), g);
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    [y[0].sin() + y[1].sin(), 0.0, -y[0].cos() - y[1].cos()]
}

fn moved(y: &Angles, h: f64, k: &Angles) -> Angles {
    std::array::from_fn(|i| y[i] + h * k[i])
}

fn rate(&[a, b, a_dot, b_dot]: &Angles, g: f64) -> Angles {
    let (sin, cos) = (a - b).sin_cos();
    let first = -sin * b_dot * b_dot - 2.0 * g * a.sin();
    let second = sin * a_dot * a_dot - g * b.sin();
    let determinant = 2.0 - cos * cos;
    [a_dot, b_dot, (first - cos * second) / determinant, (2.0 * second - cos * first) / determinant]
}

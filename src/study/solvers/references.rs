//! Closed forms to hold solvers against.
//!
//! The pendulum of length l that starts at rest at the amplitude a (Lawden, *Elliptic Functions and Applications*, 1989,
//! 5.1, with the time counted from the amplitude):
//!
//! ```text
//! sin(theta/2) = k cd(w t, k)     k = sin(a/2)     w² = g/l
//! ```
//!
//! sn, cn and dn by the arithmetic-geometric mean: Abramowitz and Stegun, *Handbook of Mathematical Functions*, 16.4.
//!
//! The ellipse of the two-body problem with semi-major axis 1 and n = 1, from the pericentre (Kepler's equation):
//!
//! ```text
//! t = E - e sin E     x = cos E - e     y = sqrt(1 - e²) sin E
//! ```

/// The mean converges quadratically: 16 steps are enough for every modulus whose complement is a number at all.
const MOST_MEANS: usize = 16;

/// sn, cn and dn of an argument and a modulus, which is given by its sine-like and cosine-like parts k and k'.
#[must_use]
pub fn jacobi(u: f64, k: f64, k_complement: f64) -> [f64; 3] {
    let (mut a, mut b, mut c) = (1.0, k_complement, k);
    let mut quotients = Vec::new();
    while c > f64::EPSILON * a && quotients.len() < MOST_MEANS {
        (a, b, c) = (f64::midpoint(a, b), (a * b).sqrt(), 0.5 * (a - b));
        quotients.push(c / a);
    }
    // phi_N = 2^N a_N u, and downwards sin(2 phi_(n-1) - phi_n) = c_n / a_n sin phi_n.
    let mut phi = quotients.iter().fold(a * u, |phi, _| 2.0 * phi);
    for quotient in quotients.iter().rev() {
        phi = 0.5 * (phi + (quotient * phi.sin()).asin());
    }
    let (sn, cn) = phi.sin_cos();
    // k'² + k² cn², not 1 - k² sn²: a sum of what is positive.
    [sn, cn, k_complement.hypot(k * cn)]
}

/// The angle of a pendulum from its lowest point, rad.
#[must_use]
pub fn pendulum(amplitude_rad: f64, frequency: f64, time_s: f64) -> f64 {
    let (k, k_complement) = (0.5 * amplitude_rad).sin_cos();
    let [_, cn, dn] = jacobi(frequency * time_s, k, k_complement);
    2.0 * (k * cn / dn).asin()
}

/// Where on its ellipse a body is, m: in the plane, the pericentre on the x axis.
#[must_use]
pub fn kepler(eccentricity: f64, time_s: f64) -> [f64; 2] {
    /// Newton's method from M + e sin M takes 5 steps at e = 0.6.
    const MOST_STEPS: usize = 32;
    let mean = time_s.rem_euclid(std::f64::consts::TAU);
    let mut anomaly = mean + eccentricity * mean.sin();
    for _ in 0..MOST_STEPS {
        let (sin, cos) = anomaly.sin_cos();
        let step = (anomaly - eccentricity * sin - mean) / (1.0 - eccentricity * cos);
        anomaly -= step;
        if step.abs() <= f64::EPSILON * std::f64::consts::TAU {
            break;
        }
    }
    let (sin, cos) = anomaly.sin_cos();
    [cos - eccentricity, ((1.0 - eccentricity) * (1.0 + eccentricity)).sqrt() * sin]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// sn(K/2) = 1/sqrt(1 + k'), cn(K/2) = sqrt(k'/(1 + k')), dn(K/2) = sqrt(k') (16.5.2), with K = pi / (2 agm(1, k')).
    #[test]
    fn elliptic_functions_at_half_a_quarter_period() {
        for k in [0.0_f64, 1e-9, 0.3, 0.84, 0.999_999] {
            let k_complement = ((1.0 - k) * (1.0 + k)).sqrt();
            let mut mean = (1.0, k_complement);
            for _ in 0..MOST_MEANS {
                mean = (f64::midpoint(mean.0, mean.1), (mean.0 * mean.1).sqrt());
            }
            let quarter = std::f64::consts::FRAC_PI_2 / mean.0;
            let expected = [1.0, k_complement.sqrt(), (k_complement * (1.0 + k_complement)).sqrt()]
                .map(|x| x / (1.0 + k_complement).sqrt());
            for (actual, expected) in jacobi(0.5 * quarter, k, k_complement).iter().zip(expected) {
                assert!((actual - expected).abs() < 1e-14, "{k}: {actual} {expected}");
            }
        }
    }

    /// theta'' = -w² sin theta, by a difference of fourth order.
    #[test]
    fn the_pendulum_obeys_its_equation() {
        let (amplitude, frequency, h) = (2.0, 3.1, 1e-3);
        assert_eq!(pendulum(amplitude, frequency, 0.0), amplitude);
        for step in 1..40 {
            let at = |i: f64| pendulum(amplitude, frequency, 0.1 * f64::from(step) + i * h);
            let second = (-at(2.0) + 16.0 * at(1.0) - 30.0 * at(0.0) + 16.0 * at(-1.0) - at(-2.0)) / (12.0 * h * h);
            let expected = -frequency * frequency * at(0.0).sin();
            // The formula errs by h⁴ d⁶theta/dt⁶ / 90, 1e-9, and by 64 eps theta / (12 h²) for each eps of an angle, 1e-9
            // again, of which a handful is lost in the means.
            assert!((second - expected).abs() < 3e-8, "{step}: {second} {expected}");
        }
    }

    /// x'' = -x / r³ and y'' = -y / r³, likewise.
    #[test]
    fn the_ellipse_obeys_its_equation() {
        let h = 1e-3;
        for step in 0..80 {
            let at = |i: f64| kepler(0.6, 0.1 * f64::from(step) + i * h);
            let [x, y] = at(0.0);
            let distance = x.hypot(y);
            for (index, coordinate) in [x, y].into_iter().enumerate() {
                let f = |i: f64| at(i)[index];
                let second = (-f(2.0) + 16.0 * f(1.0) - 30.0 * f(0.0) + 16.0 * f(-1.0) - f(-2.0)) / (12.0 * h * h);
                let expected = -coordinate / distance.powi(3);
                // At the pericentre the sixth derivative is some 1e5.
                assert!((second - expected).abs() < 1e-8, "{step}: {second} {expected}");
            }
        }
    }
}

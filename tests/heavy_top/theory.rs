//! Lagrange's top: a symmetric body about a fixed point on its axis, under gravity (Goldstein, *Classical Mechanics*, 5.7).
//!
//! With `u = cos theta`, the momenta about the vertical, b, and about the axis, a, and `w = m g l`
//!
//! ```text
//! A² u'² = f(u) = (2 A (E - a²/2C) - 2 A w u)(1 - u²) - (b - a u)²     phi' = (b - a u) / (A (1 - u²))
//! ```
//!
//! From the turning point `u1`, where the axis rests but for a precession `phi'`, it goes to `u2`. Between them
//! `f = 2 A w (u - u1)(u - u2)(u - u3)`; with `u = (u1 + u2)/2 + (u1 - u2)/2 cos s` the integrals over half a nutation are of
//! smooth periodic functions of s, for which equal weights converge faster than any power (no elliptic integral is used).

/// A top at rest in nutation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Top {
    /// Moment across the axis, about the fixed point, kg m².
    pub(crate) across: f64,
    /// Moment about the axis.
    pub(crate) along: f64,
    /// `m g l`, N m.
    pub(crate) weight: f64,
    /// Of the axis to the vertical at the start, rad.
    pub(crate) tilt_rad: f64,
    /// Spin about the axis, rad/s.
    pub(crate) spin_rad_s: f64,
    /// Precession at the start, rad/s.
    pub(crate) precession_rad_s: f64,
}

/// What theory says.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Theory {
    pub(crate) turning: [f64; 3],
    /// The period of the nutation, s.
    pub(crate) period_s: f64,
    /// The turn about the vertical in that time, rad.
    pub(crate) advance_rad: f64,
}

/// Points of the rule: at twice as many nothing changes.
const POINTS: u32 = 256;

impl Top {
    /// Angular momenta about the vertical and about the axis.
    pub(crate) fn momenta(&self) -> [f64; 2] {
        let (sin, cos) = self.tilt_rad.sin_cos();
        let a = self.along * self.spin_rad_s;
        [a * cos + self.across * self.precession_rad_s * sin * sin, a]
    }

    pub(crate) fn theory(&self) -> Theory {
        let [b, a] = self.momenta();
        let (u1, w) = (self.tilt_rad.cos(), 2.0 * self.across * self.weight);
        // f without its root u1: f(u) = w u³ - (e + a²) u² + (2ab - w) u + e - b², and e from f(u1) = 0.
        let e = w * u1 + (b - a * u1).powi(2) / (1.0 - u1 * u1);
        let half_sum = 0.5 * ((e + a * a) / w - u1);
        let product = (2.0 * a * b - w) / w - 2.0 * half_sum * u1;
        let root = (half_sum * half_sum - product).sqrt();
        let (u3, u2) = (half_sum + root, product / (half_sum + root));
        let (mut time, mut turn) = (0.0, 0.0);
        for index in 0..POINTS {
            let s = std::f64::consts::PI * (f64::from(index) + 0.5) / f64::from(POINTS);
            let u = 0.5 * (u1 + u2) + 0.5 * (u1 - u2) * s.cos();
            let dt = self.across / (w * (u3 - u)).sqrt();
            time += dt;
            turn += dt * (b - a * u) / (self.across * (1.0 - u * u));
        }
        let both_ways = 2.0 * std::f64::consts::PI / f64::from(POINTS);
        Theory { turning: [u1, u2, u3], period_s: both_ways * time, advance_rad: both_ways * turn }
    }
}

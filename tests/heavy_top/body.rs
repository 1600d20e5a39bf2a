//! Lagrange's top as a body that moves: the inertia about the fixed point, the weight on its axis, and as much upwards at the
//! fixed point, which takes its place.

use crate::theory::{Theory, Top};
use ga_physics::algebra::cga::Point;
use ga_physics::algebra::g3::{Bivector, Rotor, Vector};
use ga_physics::rigid::{Bodies, Force, Forces, Inertia, Method, Motion, Setup, Solver};

/// The fixed point to the centre of mass, m.
const ARM_M: f64 = 0.5;

/// A top, and what moves it.
pub(crate) struct Spinning {
    top: Top,
    theory: Theory,
    pub(crate) bodies: Bodies<f64>,
    motion: Motion<f64>,
}

impl Spinning {
    /// As many equal steps a nutation.
    pub(crate) fn new(top: Top, method: Method, steps: u32) -> Self {
        let Top { across, along, weight, .. } = top;
        let inertia = Inertia::new(1.0, [[across, 0.0, 0.0], [0.0, across, 0.0], [0.0, 0.0, along]]).unwrap();
        let tilt = Rotor::from_axis_angle(Vector::new(0.0, 1.0, 0.0), top.tilt_rad).unwrap();
        let omega_body = Bivector::new(-top.precession_rad_s * top.tilt_rad.sin(), 0.0, top.spin_rad_s);
        let mut bodies = Bodies::default();
        bodies.push(Point::origin(), tilt, Vector::default(), tilt.apply(inertia.momentum_of(omega_body)));
        let push = |at_m: f64, newton: f64| Force::AtPoint {
            body_idx: 0,
            at_body: Vector::new(0.0, 0.0, at_m),
            force_world: Vector::new(0.0, 0.0, newton),
            start_s: f64::NEG_INFINITY,
            end_s: f64::INFINITY,
        };
        let forces = vec![push(ARM_M, -weight / ARM_M), push(0.0, weight / ARM_M)];
        let setup =
            Setup { inertias: vec![inertia], forces: Forces { gravity: Vector::default(), forces }, joints: vec![] };
        let theory = top.theory();
        let solver = Solver::fixed(method, theory.period_s / f64::from(steps));
        let motion = Motion::new(setup, &bodies, &solver).unwrap();
        Self { top, theory, bodies, motion }
    }

    /// Goes on by a nutation, or a part of one; `index` such have gone before.
    pub(crate) fn nutate(&mut self, index: u32, part: f64) {
        let span_s = part * self.theory.period_s;
        self.motion.advance(&mut self.bodies, f64::from(index) * span_s, span_s).unwrap();
    }

    fn axis(&self) -> [f64; 3] {
        self.bodies.rotor[0].apply(Vector::new(0.0, 0.0, 1.0)).into()
    }

    /// Kinetic and potential.
    pub(crate) fn energy(&self) -> f64 {
        self.motion.totals(&self.bodies).kinetic + self.top.weight * self.axis()[2]
    }

    /// Momentum about the vertical, which no force changes.
    pub(crate) fn vertical(&self) -> f64 {
        self.bodies.angular_momentum[0].e12
    }

    /// The phases of nutation and precession after whole nutations, rad, less those of theory: per radian, the errors of the
    /// two frequencies.
    pub(crate) fn frequency_errors(&self, nutations: u32) -> [f64; 2] {
        let [u1, u2, u3] = self.theory.turning;
        let [x, y, u] = self.axis();
        let omega = self.bodies.omega_world(0, &self.motion.inertias()[0]);
        let du = omega.e23 * y - omega.e31 * x;
        let (half, w) = (0.5 * (u1 - u2), 2.0 * self.top.across * self.top.weight);
        let sin = -du * self.top.across / (w * (u3 - u)).sqrt();
        let nutation = (sin * half.signum()).atan2((u - 0.5 * (u1 + u2)) * half.signum());
        let turns = std::f64::consts::TAU;
        let advance = f64::from(nutations) * self.theory.advance_rad;
        let precession = y.atan2(x) - advance;
        let precession = precession - (precession / turns).round() * turns;
        [nutation / (turns * f64::from(nutations)), precession / advance]
    }
}

//! How the motion of bodies is solved: what a scene says, and what the plan picks.

use crate::ode::{Composition, Tolerance};
pub use crate::particle::Steps;

/// A formulation of rigid motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Form {
    /// A rotation matrix (report, 33), not brought back to a rotation: to see how it drifts. Feature `study`.
    Matrix,
    /// A unit quaternion and vectors.
    Quaternion,
    /// A rotor of G(3,0) and bivectors (35).
    #[default]
    Rotor,
    /// A conformal motor.
    Motor,
}

impl Form {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Matrix, Self::Quaternion, Self::Rotor, Self::Motor];

    /// The name in scenes.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Matrix => "matrix",
            Self::Quaternion => "quaternion",
            Self::Rotor => "rotor",
            Self::Motor => "motor",
        }
    }
}

/// An integration method for bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The exact motion under uniform gravity alone: no steps.
    FreeFlight,
    /// Runge and Kutta's of order 4, orientations brought back to unit norm (the report's).
    Rk4,
    /// The same with step doubling.
    Rk4Doubling,
    /// Cash and Karp 5(4).
    CashKarp,
    /// Tsitouras 5(4).
    Tsit5,
    /// Dormand and Prince 8(5,3).
    Dop853,
    /// Runge, Kutta and Munthe-Kaas', order 4: orientations by exponentials. Rotor and motor.
    Rkmk4,
    /// Commutator-free of order 4, likewise, with an estimate of its error.
    CommutatorFree,
    /// The exact free motion between kicks of the forces, order 2; with joints RATTLE. Rotor.
    Verlet,
    /// Yoshida's composition of it, order 4.
    Yoshida4,
    /// Yoshida's composition of it, order 6.
    Yoshida6,
    /// As `Verlet`, with the free motion split into rotations about the principal axes.
    Splitting2,
    /// As `Yoshida4`, likewise.
    Splitting4,
    /// As `Yoshida6`, likewise.
    Splitting6,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 14] = [
        Self::FreeFlight,
        Self::Rk4,
        Self::Rk4Doubling,
        Self::CashKarp,
        Self::Tsit5,
        Self::Dop853,
        Self::Rkmk4,
        Self::CommutatorFree,
        Self::Verlet,
        Self::Yoshida4,
        Self::Yoshida6,
        Self::Splitting2,
        Self::Splitting4,
        Self::Splitting6,
    ];

    /// The name in scenes.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::FreeFlight => "free_flight",
            Self::Rk4 => "rk4",
            Self::Rk4Doubling => "rk4_doubling",
            Self::CashKarp => "cash_karp",
            Self::Tsit5 => "tsit5",
            Self::Dop853 => "dop853",
            Self::Rkmk4 => "rkmk4",
            Self::CommutatorFree => "commutator_free",
            Self::Verlet => "verlet",
            Self::Yoshida4 => "yoshida4",
            Self::Yoshida6 => "yoshida6",
            Self::Splitting2 => "splitting2",
            Self::Splitting4 => "splitting4",
            Self::Splitting6 => "splitting6",
        }
    }

    /// Does it estimate its error, and so choose its own step?
    #[must_use]
    pub const fn is_adaptive(self) -> bool {
        matches!(self, Self::Rk4Doubling | Self::CashKarp | Self::Tsit5 | Self::Dop853 | Self::CommutatorFree)
    }

    /// The composition that it is, if it is one of kicks and free motions: it keeps its order only where no force depends on
    /// velocities.
    #[must_use]
    pub const fn composition(self) -> Option<Composition> {
        match self {
            Self::Verlet | Self::Splitting2 => Some(Composition::Verlet),
            Self::Yoshida4 | Self::Splitting4 => Some(Composition::Yoshida4),
            Self::Yoshida6 | Self::Splitting6 => Some(Composition::Yoshida6),
            _ => None,
        }
    }

    /// Does it split the free motion into rotations about axes?
    #[must_use]
    pub const fn splits(self) -> bool {
        matches!(self, Self::Splitting2 | Self::Splitting4 | Self::Splitting6)
    }

    /// Can it integrate this formulation?
    #[must_use]
    pub const fn fits(self, form: Form) -> bool {
        match self {
            Self::Rk4 | Self::Rk4Doubling | Self::CashKarp | Self::Tsit5 | Self::Dop853 => true,
            Self::Rkmk4 | Self::CommutatorFree => matches!(form, Form::Rotor | Form::Motor),
            Self::FreeFlight
            | Self::Verlet
            | Self::Yoshida4
            | Self::Yoshida6
            | Self::Splitting2
            | Self::Splitting4
            | Self::Splitting6 => matches!(form, Form::Rotor),
        }
    }
}

/// All that is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solver {
    /// The formulation.
    pub form: Form,
    /// The integrator.
    pub method: Method,
    /// Its steps; free flight makes none.
    pub steps: Steps,
    /// The largest violation of a joint that is left, relative to the smallest joint: see [`Held`](super::Held).
    pub violation: f64,
}

/// What projection is asked for unless one says otherwise: what it reaches in f64 with digits to spare.
const VIOLATION: f64 = 1e-13;

impl Solver {
    /// Fixed steps, s, in the rotor form.
    #[must_use]
    pub fn fixed(method: Method, dt_s: f64) -> Self {
        Self { form: Form::Rotor, method, steps: Steps::Fixed { dt_s }, violation: VIOLATION }
    }

    /// Steps by a tolerance, in the rotor form.
    #[must_use]
    pub fn adaptive(method: Method, tolerance: Tolerance<f64>) -> Self {
        Self { steps: Steps::Adaptive { tolerance }, ..Self::fixed(method, 1.0) }
    }

    /// The same in another formulation.
    #[must_use]
    pub fn in_form(self, form: Form) -> Self {
        Self { form, ..self }
    }
}

//! How the motion of particles is solved: what a scene's `[solver]` says, and what the plan picks.

use crate::ode::Tolerance;

/// An integration method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Euler, order 1 (report, 55): to see how bad it is.
    Euler,
    /// Runge and Kutta's of order 4 (56).
    Rk4,
    /// The same with step doubling (B.3.1).
    Rk4Doubling,
    /// Cash and Karp 5(4) (57).
    CashKarp,
    /// Tsitouras 5(4).
    Tsit5,
    /// Dormand and Prince 8(5,3).
    Dop853,
    /// Velocity Verlet, order 2; with constraints RATTLE.
    Verlet,
    /// Yoshida's composition of order 4.
    Yoshida4,
    /// Yoshida's composition of order 6.
    Yoshida6,
    /// Substepped position-based dynamics: the fast mode.
    Xpbd,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Euler,
        Self::Rk4,
        Self::Rk4Doubling,
        Self::CashKarp,
        Self::Tsit5,
        Self::Dop853,
        Self::Verlet,
        Self::Yoshida4,
        Self::Yoshida6,
        Self::Xpbd,
    ];

    /// The name in scenes.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Euler => "euler",
            Self::Rk4 => "rk4",
            Self::Rk4Doubling => "rk4_doubling",
            Self::CashKarp => "cash_karp",
            Self::Tsit5 => "tsit5",
            Self::Dop853 => "dop853",
            Self::Verlet => "verlet",
            Self::Yoshida4 => "yoshida4",
            Self::Yoshida6 => "yoshida6",
            Self::Xpbd => "xpbd",
        }
    }

    /// Does it estimate its error, and so choose its own step?
    #[must_use]
    pub const fn is_adaptive(self) -> bool {
        matches!(self, Self::Rk4Doubling | Self::CashKarp | Self::Tsit5 | Self::Dop853)
    }

    /// Does it keep its order only where no force depends on the velocity?
    #[must_use]
    pub const fn splits(self) -> bool {
        matches!(self, Self::Verlet | Self::Yoshida4 | Self::Yoshida6)
    }
}

/// Which steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Steps {
    /// All of the same length, s: for recordings, and for methods without an error estimate.
    Fixed {
        /// s.
        dt_s: f64,
    },
    /// As long as the tolerance allows.
    Adaptive {
        /// Error of a step.
        tolerance: Tolerance<f64>,
    },
}

/// How the multipliers are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinearSolver {
    /// Not at all: sweeps over the constraints, one by one. For XPBD only.
    Sweeps,
    /// Sparse factorisation.
    Direct,
    /// Preconditioned, from the last multipliers on.
    ConjugateGradients,
}

/// What keeps `C = 0` in spite of rounding and of errors of the integrator (errata of the report's 24).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stabilisation {
    /// Nothing: `d²C/dt² = 0` alone, the report's. It drifts.
    None,
    /// `d²C/dt² = -2 a dC/dt - a² C` (Baumgarte 1972).
    Baumgarte {
        /// a, 1/s.
        rate: f64,
    },
    /// Positions onto `C = 0` and velocities onto `dC/dt = 0` after each step.
    Projection,
}

/// All that is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solver {
    /// The integrator.
    pub method: Method,
    /// Its steps. XPBD has a fixed step as well, in substeps.
    pub steps: Steps,
    /// The multipliers' solver.
    pub linear: LinearSolver,
    /// Stabilisation, of methods that need one: Verlet and its compositions project by themselves.
    pub stabilisation: Stabilisation,
    /// The largest violation that is left, relative to the shortest length that is held (to 1 m where none is).
    pub violation: f64,
    /// XPBD only: substeps a step. None: as many as hold the violation at rest.
    pub substeps: Option<usize>,
}

/// What projection is asked for unless one says otherwise: what it reaches in f64 from anywhere near, with digits to spare.
const VIOLATION: f64 = 1e-12;

impl Solver {
    /// Fixed steps, s, and else what suits most: a sparse factorisation, projection.
    #[must_use]
    pub fn fixed(method: Method, dt_s: f64) -> Self {
        let (linear, stabilisation) = (LinearSolver::Direct, Stabilisation::Projection);
        Self { method, steps: Steps::Fixed { dt_s }, linear, stabilisation, violation: VIOLATION, substeps: None }
    }

    /// Steps by a tolerance, and else the same.
    #[must_use]
    pub fn adaptive(method: Method, tolerance: Tolerance<f64>) -> Self {
        Self { steps: Steps::Adaptive { tolerance }, ..Self::fixed(method, 1.0) }
    }
}

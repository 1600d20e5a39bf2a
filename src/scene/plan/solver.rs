//! Which solver the particles of a scene get, where the scene leaves it open.

use super::particles::Census;
use crate::scene::description::{ConstraintSolver, Method, Scalar, Scene, Stabilisation};
use serde::Serialize;

/// Tolerances where the scene gives none: three digits above the least of the scalar that error control can work with.
const RTOL_F64: f64 = 1e-9;
const RTOL_F32: f64 = 1e-5;
/// Below this relative tolerance DOP853 takes fewer evaluations than Tsit5: on a Kepler orbit of eccentricity 0.6, 1478
/// against 1773 for a final error of 1e-6, 2514 against 9670 for 1e-9.
const HIGH_ORDER_BELOW: f64 = 1e-6;
/// From so many constraints on a step that solves for all forces at once takes longer than a frame of a display, and
/// the plan takes XPBD.
const XPBD_FROM: usize = 20_000;
/// Up to so many constraints a sparse factorisation takes less than a second and less than a hundred megabytes.
const DIRECT_UP_TO: usize = 50_000;
/// Substeps a step of XPBD: links then stretch by less than 1e-4 in nets that hang.
const SUBSTEPS: u32 = 20;

/// How the motion of the particles is solved: what the scene says, and for the rest what the plan chooses.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SolverPlan {
    /// The integrator.
    pub method: Method,
    /// Why it.
    pub why: String,
    /// Relative tolerance, for methods that choose their steps.
    pub rtol: f64,
    /// Absolute tolerance, m and m/s, for methods that choose their steps.
    pub atol: f64,
    /// How the constraint forces are solved for.
    pub constraints: ConstraintSolver,
    /// What keeps particles on their constraints.
    pub stabilisation: Stabilisation,
    /// Substeps a step of `xpbd`.
    pub substeps: u32,
}

impl SolverPlan {
    /// The solver of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        choose(scene, &Census::of(scene))
    }

    /// Evaluations of the forces a step; none if it depends on the motion.
    pub(super) fn evals_per_step(&self) -> Option<u64> {
        match self.method {
            Method::Euler | Method::Verlet => Some(1),
            Method::Rk4 => Some(4),
            Method::Yoshida4 => Some(3),
            Method::Yoshida6 => Some(7),
            Method::Xpbd => Some(u64::from(self.substeps)),
            Method::Rk4Doubling | Method::CashKarp | Method::Tsit5 | Method::Dop853 => None,
        }
    }
}

pub(super) fn choose(scene: &Scene, census: &Census) -> SolverPlan {
    let given = |value: &Option<toml::Spanned<f64>>| value.as_ref().map(|value| *value.get_ref());
    let rtol = given(&scene.solver.rtol).unwrap_or(match scene.solver.scalar {
        Scalar::F64 => RTOL_F64,
        Scalar::F32 => RTOL_F32,
    });
    let (method, why) = match &scene.solver.method {
        Some(method) => (*method.get_ref(), "the scene names it".to_owned()),
        None => method(scene, census, rtol),
    };
    let few = census.constraints <= DIRECT_UP_TO;
    SolverPlan {
        method,
        why,
        rtol,
        atol: given(&scene.solver.atol).unwrap_or(rtol),
        constraints: scene.solver.constraints.unwrap_or(match few {
            true => ConstraintSolver::Direct,
            false => ConstraintSolver::ConjugateGradients,
        }),
        stabilisation: scene.solver.stabilisation,
        substeps: scene.solver.substeps.as_ref().map_or(SUBSTEPS, |substeps| *substeps.get_ref()),
    }
}

fn method(scene: &Scene, census: &Census, rtol: f64) -> (Method, String) {
    if scene.dt_s.is_none() {
        return match rtol < HIGH_ORDER_BELOW {
            true => (Method::Dop853, "no `dt_s`, and a tolerance at which a high order pays".to_owned()),
            false => (Method::Tsit5, "no `dt_s`, and a tolerance at which a low order pays".to_owned()),
        };
    }
    if census.constraints >= XPBD_FROM {
        return (Method::Xpbd, format!("{} constraints: fast rather than accurate", census.constraints));
    }
    if census.drags > 0 {
        return (Method::Rk4, "`dt_s` is given, and a force depends on the velocity".to_owned());
    }
    (Method::Verlet, "`dt_s` is given, and the forces keep energy: so does it".to_owned())
}

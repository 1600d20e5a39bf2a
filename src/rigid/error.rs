//! Why bodies cannot be set in motion, or cannot go on.

use super::{Form, JointError, Method, OrientationLost};
use crate::constraint::{ProjectionError, SolveError};
use crate::ode::{StepError, ToleranceError};
use thiserror::Error;

/// Why a step cannot be made.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MotionError {
    /// The orientation of a body is none any more.
    #[error("at {time_s} s: {source}")]
    Orientation {
        /// When.
        time_s: f64,
        /// Which.
        source: OrientationLost,
    },
    /// The forces of the joints cannot be found. Rows are indices of joints.
    #[error("at {time_s} s: {source}")]
    Multipliers {
        /// When.
        time_s: f64,
        /// Why.
        source: SolveError,
    },
    /// The bodies cannot be brought back onto their joints. Rows are indices of joints.
    #[error("at {time_s} s: {source}")]
    Projection {
        /// When.
        time_s: f64,
        /// Why.
        source: ProjectionError,
    },
    /// Too fast a spin for the step.
    #[error(
        "at {time_s} s body {body_idx} turns by {turn_rad:e} rad in a step of {dt_s} s, too far for the \
         method: take a smaller `dt_s`, or in the rotor form a method on the exact free motion (`verlet`, `yoshida4`, \
         `yoshida6`)"
    )]
    Spin {
        /// The body.
        body_idx: usize,
        /// When.
        time_s: f64,
        /// How far.
        turn_rad: f64,
        /// The step.
        dt_s: f64,
    },
}

impl MotionError {
    /// The joint that it is about.
    fn joint_mut(&mut self) -> Option<&mut usize> {
        match self {
            Self::Multipliers { source, .. } | Self::Projection { source: ProjectionError::Solve(source), .. } => {
                match source {
                    SolveError::NotFinite { row } | SolveError::Contradiction { row, .. } => Some(row),
                }
            }
            Self::Projection {
                source: ProjectionError::NotConverged { row, .. } | ProjectionError::NoGradient { row },
                ..
            } => Some(row),
            Self::Orientation { .. } | Self::Spin { .. } => None,
        }
    }

    /// The same of a joint that has another index.
    pub(super) fn renumbered(mut self, index_of: impl FnOnce(usize) -> usize) -> Self {
        if let Some(joint) = self.joint_mut() {
            *joint = index_of(*joint);
        }
        self
    }
}

/// Why a solver cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum SolverError {
    /// A joint.
    #[error(transparent)]
    Joint(#[from] JointError),
    /// The method is none for the formulation.
    #[error("`{}` does not integrate the {} form: choose `rk4`, `tsit5` or `dop853`, or the rotor form", .method.name(), .form.name())]
    DoesNotFit {
        /// The method.
        method: Method,
        /// The formulation.
        form: Form,
    },
    /// The matrix form in a build without it.
    #[error("the matrix form is there for studies: build with feature `study`")]
    ForStudies,
    /// Free flight with something in its way.
    #[error(
        "`free_flight` is for bodies under uniform gravity alone, without other forces and joints: choose `yoshida4`"
    )]
    NotFree,
    /// A force that is no number.
    #[error("force {force}: a number of it is not finite")]
    ForceNotFinite {
        /// Which.
        force: usize,
    },
    /// A body that does not exist.
    #[error("a force acts on body {body_idx}, or a list of bodies names it, but there are {bodies}")]
    NoSuchBody {
        /// The body.
        body_idx: usize,
        /// Their number.
        bodies: usize,
    },
    /// Bodies that are solved in different ways, and linked.
    #[error("bodies {a} and {b} are linked by a force or joint and must be solved alike: give them one formulation")]
    Linked {
        /// The first body.
        a: usize,
        /// The second body.
        b: usize,
    },
    /// Error control without an error estimate.
    #[error("`{}` does not estimate its error and needs a fixed step", .0.name())]
    NotAdaptive(Method),
    /// The step.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The tolerance.
    #[error(transparent)]
    Tolerance(#[from] ToleranceError),
}

//! Why nothing was faired.

use crate::hull::HullError;
use crate::numeric::SingularMatrix;
use crate::qp::ProblemError;
use crate::resistance::NoWaveTerm;

/// Why nothing was faired.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FairError {
    /// Readings and energy leave a control value open.
    #[error("the offsets do not determine the surface: {0}")]
    Undetermined(#[from] SingularMatrix),
    /// Numbers that make no program.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// Rules that name what the surface does not have: index of the rule, and why.
    #[error("{}", .0.iter().map(|(_, why)| why.as_str()).collect::<Vec<_>>().join("; "))]
    Rules(Vec<(usize, String)>),
    /// A net makes no hull.
    #[error(transparent)]
    Hull(#[from] HullError),
    /// The wave resistance is no quadratic form of the net.
    #[error(transparent)]
    Waves(#[from] NoWaveTerm),
    /// No weight of the wave resistance has an answer.
    #[error("no weight of the wave resistance has an answer within the tolerances")]
    NoWaves,
}

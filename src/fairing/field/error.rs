//! Why there is no field.

use crate::spline::SplineError;

/// Why there is no field.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FieldError {
    /// Too few offsets.
    #[error("the offsets do not determine a surface")]
    Undetermined,
    /// Knots.
    #[error(transparent)]
    Spline(#[from] SplineError),
}

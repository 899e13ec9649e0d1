//! The methods by which a table becomes a surface.

/// How a table becomes a surface.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum FitMethod {
    /// Interpolation on graded charts with minimum energy, the default.
    #[default]
    Graded,
}

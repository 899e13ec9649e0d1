//! What stands for pictures in a library that was built without them.

use super::error::PlotError;

/// What is missing.
const MISSING: PlotError = PlotError::Feature("pictures");

/// A drawing as it was read: none can be.
pub(in crate::plot) enum Drawing {}

/// A document as it would be drawn.
pub(in crate::plot) fn tree(_: &str) -> Result<Drawing, PlotError> {
    Err(MISSING)
}

/// A picture of a document.
pub(in crate::plot) fn render(drawing: &Drawing, _: f64) -> Result<Vec<u8>, PlotError> {
    match *drawing {}
}

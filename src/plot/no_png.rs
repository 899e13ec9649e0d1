//! What stands for pictures in a library that was built without them.

use super::PlotError;

/// What is missing.
const MISSING: PlotError = PlotError::Feature("pictures");

/// A drawing as it was read: none can be.
pub(super) enum Drawing {}

/// A document as it would be drawn.
pub(super) fn tree(_: &str) -> Result<Drawing, PlotError> {
    Err(MISSING)
}

/// A picture of a document.
pub(super) fn render(drawing: &Drawing, _: f64) -> Result<Vec<u8>, PlotError> {
    match *drawing {}
}

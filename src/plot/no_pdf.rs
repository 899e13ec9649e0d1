//! What stands for PDF in a library that was built without it.

use super::pages::{Heading, Page};
use super::paper::error::PlotError;
use super::paper::sheet::Sheet;

/// The figures at true size, each with frame, title block and check bar.
///
/// # Errors
/// Always: this library was built without the feature `pdf`.
pub fn write_pdf<'a>(_: &Heading<'a>, _: &[Page<'a>], _: Sheet) -> Result<Vec<u8>, PlotError> {
    Err(PlotError::Feature("pdf"))
}

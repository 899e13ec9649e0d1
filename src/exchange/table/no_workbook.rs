//! What stands for workbooks in a library that was built without them.

use super::problem::{FilePosition, Problems};
use super::xlsx::Sheet;
use crate::hull::TableForm;

/// What is missing.
const MISSING: &str = "workbooks need the feature `workbooks` of the library";

/// The sheets of a workbook: a problem here.
pub(super) fn sheets(_: &[u8], problems: &mut Problems) -> Option<Vec<Sheet>> {
    problems.error("E300", FilePosition::FILE, MISSING.to_owned(), "Give the table as CSV");
    None
}

/// The text of a table as a workbook.
///
/// # Errors
/// Always: this library was built without the feature `workbooks`.
pub fn workbook(_: &str, _: &TableForm) -> Result<Vec<u8>, String> {
    Err(MISSING.to_owned())
}

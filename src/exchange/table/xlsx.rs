//! What an XLSX workbook has in common with a CSV file: the rows of its sheets.

use super::grid::Grid;
use super::problem::Problems;

/// A sheet with cells.
#[derive(Debug)]
pub(super) struct Sheet {
    pub(super) name: String,
    pub(super) hidden: bool,
    pub(super) grid: Grid,
    /// What is wrong with its cells.
    pub(super) problems: Problems,
}

/// The most bytes of all parts of a workbook.
pub const MOST_UNPACKED: u64 = 256 << 20;

/// Whether the bytes begin as a packed archive does.
pub(super) fn is_xlsx(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04")
}

/// The rows as lines of CSV, comments among them.
pub(super) fn lines(grid: &Grid) -> String {
    let mut text = String::new();
    let mut comments = grid.comments.iter().peekable();
    for (index, row) in grid.rows.iter().enumerate() {
        if let Some((_, comment)) = comments.next_if(|(line, _)| *line == index + 1) {
            text += &format!("# {comment}");
        }
        for (place, field) in row.iter().enumerate() {
            if place > 0 {
                text.push(',');
            }
            if field.text.contains([',', '"', '\n', '\r']) {
                text += &format!("\"{}\"", field.text.replace('"', "\"\"").replace(['\n', '\r'], " "));
            } else {
                text += &field.text;
            }
        }
        text.push('\n');
    }
    text
}

//! Tables of offsets in the layouts of many programs, read into one [`OffsetTable`].

mod problem;

pub use problem::{Severity, TableProblem};

use crate::hull::OffsetTable;

/// A table with what should be known about it.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadTable {
    /// The table, in metres and in our frame.
    pub table: OffsetTable,
    /// Warnings and notes: what was detected and assumed (order reversed, decimal commas, units).
    pub notes: Vec<TableProblem>,
}

/// Reads a table of offsets; the layout is found by the name's extension and the content.
///
/// # Errors
/// Every problem of the table at once, in the order of rows and columns.
pub fn read_table(name: &str, bytes: &[u8]) -> Result<ReadTable, Vec<TableProblem>> {
    let _ = bytes;
    Err(vec![TableProblem {
        severity: Severity::Error,
        code: "E300",
        file: name.to_owned(),
        row: None,
        column: None,
        found: String::new(),
        message: "no layout of a table of offsets is recognised".to_owned(),
        remedy: String::new(),
    }])
}

//! Tables of offsets in the layouts of many programs, read into one [`OffsetTable`].

mod britfair;
mod delftship;
mod fields;
mod formats;
mod freeship;
mod ghs;
mod outline;
mod pdstrip;
mod pias;
mod points;
mod problem;
mod ratio;
mod seaway;
mod sections;

pub use britfair::write as write_britfair;
pub use freeship::write as write_freeship;
pub use ghs::write as write_ghs;
pub use pdstrip::write as write_pdstrip;
pub use pias::write as write_pias;
pub use problem::{Severity, TableProblem};
pub use ratio::{read_particulars, read_with as read_fractions};

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
    if let Some(read) = formats::read(name, bytes) {
        return read;
    }
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

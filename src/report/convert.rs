//! Tables of offsets read and written back, in their own notation or in another.

use std::path::Path;

use super::failure::Failure;
use super::source::read_table_file;
use crate::exchange::{Severity, TableWriting, WrittenTable, write_table};

/// A converted table, and what should be known about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Converted {
    /// The file with what rounding did.
    pub written: WrittenTable,
    /// Messages for the user: warnings and notes of the reading, effect of rounding.
    pub messages: Vec<String>,
}

/// Reads the table of a file and writes it in the notation and layout that are asked for, its own where none is.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with every problem of the table.
pub fn convert_table(path: &Path, writing: TableWriting) -> Result<Converted, Failure> {
    let (table, notes) = read_table_file(path)?;
    let written = write_table(&table, writing);
    // A missing profile does not matter to a table that stays a table.
    let mut messages: Vec<String> =
        notes.iter().filter(|n| n.severity != Severity::Warning || n.code == "W320").map(ToString::to_string).collect();
    let r = written.rounding;
    messages.push(format!(
        "rounding: {} offsets, {} as they were written; largest change {:.3} mm, RMS {:.3} mm; of positions {:.3} mm",
        r.cells,
        r.kept,
        1e3 * r.largest,
        1e3 * r.root_mean_square,
        1e3 * r.largest_of_positions
    ));
    if !table.lines.is_empty() && written.text.matches(",KN,").count() + written.text.matches(",TL,").count() == 0 {
        messages.push(format!("{} lines are not written; a tidy table holds them (--layout tidy)", table.lines.len()));
    }
    if table.stations.iter().any(|s| !s.outlines.is_empty())
        && writing.layout.is_none_or(|l| l != crate::hull::TableLayout::Tidy)
    {
        messages.push("sections given as points are not written; a tidy table holds them (--layout tidy)".to_owned());
    }
    Ok(Converted { written, messages })
}

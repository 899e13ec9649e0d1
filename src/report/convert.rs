//! Tables of offsets read and written back, in their own notation or in another.

use std::path::Path;

use super::failure::Failure;
use super::source::read_table_file;
use crate::exchange::{Severity, TableWriting, WrittenTable, only_sections, write_table};
use crate::hull::{TableForm, TableLayout};

/// A converted table, and what should be known about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Converted {
    /// The file with what rounding did.
    pub written: WrittenTable,
    /// How the table was written.
    pub form: TableForm,
    /// Messages for the user: warnings and notes of the reading, effect of rounding.
    pub messages: Vec<String>,
}

/// Reads the table of a file and writes it in the notation and layout that are asked for, its own where none is.
///
/// # Errors
/// [`Failure::FileSystem`]; [`Failure::Input`] with every problem of the table; [`Failure::Usage`] when the layout that is asked
/// for cannot hold the table.
pub fn convert_table(path: &Path, writing: TableWriting) -> Result<Converted, Failure> {
    let (table, notes) = read_table_file(path)?;
    let sections = only_sections(&table);
    if sections && writing.layout.is_some_and(|layout| layout != TableLayout::Tidy) {
        return Err(Failure::Usage(
            "the table gives sections as points, which a matrix cannot hold; write a tidy table (--layout tidy)"
                .to_owned(),
        ));
    }
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
    let points = table.stations.iter().flat_map(|s| &s.outlines).map(Vec::len).sum::<usize>();
    let tidy = sections || writing.layout.unwrap_or(table.form.layout) == TableLayout::Tidy;
    // Every tidy table has this column; none of the other programs' formats has it.
    let own = sections && !written.text.contains("curve");
    if sections && !own && writing.layout.is_none() && table.form.layout != TableLayout::Tidy {
        messages.push(format!("sections as points: {points} points are written as a tidy table"));
    } else if points > 0 && !tidy && !own {
        messages.push("sections given as points are not written; a tidy table holds them (--layout tidy)".to_owned());
    }
    Ok(Converted { written, form: table.form, messages })
}

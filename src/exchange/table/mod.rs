//! Tables of offsets in the layouts of many programs, read into one [`OffsetTable`].

mod assemble;
mod checks;
mod grid;
mod header;
mod matrix;
mod problem;
mod scale;
mod settings;

pub use grid::{LARGEST_TABLE, LONGEST_FIELD, MOST_CELLS, MOST_COLUMNS, MOST_ROWS};
pub use problem::{Severity, TableProblem};

use self::problem::{Field, Problems};
use self::settings::Settings;
use crate::hull::{OffsetTable, Rows, TableForm};
use crate::units::{CellRules, CellWriting, Notation, parse_cell};

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
    let mut problems = Problems::new(name);
    let settings = Settings::default();
    let table = delimited(bytes, &settings, &mut problems);
    if let Some(table) = &table {
        checks::whole(table, settings.full, &mut problems);
    } else if !problems.any_errors() {
        problems.error("E300", "no table of offsets is recognised".to_owned(), "");
    }
    let notes = problems.finish()?;
    Ok(ReadTable { table: table.unwrap_or_default(), notes })
}

/// A matrix as CSV, TSV, or with semicolons or bars.
fn delimited(bytes: &[u8], settings: &Settings, problems: &mut Problems) -> Option<OffsetTable> {
    let text = grid::decode(bytes, problems)?;
    let grid = grid::split(&text, settings.separator, problems)?;
    if grid.rows.iter().all(Vec::is_empty) {
        problems.error("E300", "the file is empty".to_owned(), "Give the table as CSV, TSV or XLSX.");
        return None;
    }
    let decimal_comma = settings.decimal_comma.unwrap_or_else(|| commas(&grid.rows, grid.separator));
    let (blocks, titles) = matrix::blocks(&grid.rows, settings, problems);
    let first = blocks.first()?;
    let (rows, columns) = match first.rows {
        Rows::Stations => ("stations", "waterlines"),
        Rows::Waterlines => ("waterlines", "stations"),
    };
    let columns = if first.across == header::Axis::Buttock { "buttocks" } else { columns };
    problems.note(format!(
        "{} stations and {} lines across; rows are {rows}, columns are {columns} ({}); fields are separated by {}{}",
        first.stations.len(),
        first.heads.len(),
        first.reason,
        match grid.separator {
            '\t' => "tabs".to_owned(),
            c => format!("'{c}'"),
        },
        if decimal_comma { "; decimal commas" } else { "" }
    ));
    let header_row = first.corner.row.min(first.heads.first().map_or(usize::MAX, |f| f.row));
    let form = TableForm {
        separator: grid.separator,
        decimal_comma,
        carriage_returns: grid.carriage_returns,
        open_end: grid.open_end,
        preamble: text.lines().take(header_row.saturating_sub(1)).map(str::to_owned).collect(),
        ..TableForm::default()
    };
    let mut table = assemble::assemble(blocks, form, settings, problems)?;
    let title = titles.first().map(|field| field.trimmed().to_owned()).unwrap_or_default();
    table.name = settings.name.clone().unwrap_or(title);
    table.stated = settings.stated;
    Some(table)
}

/// Whether `6,41` is 6.41: some cells are numbers with a comma, and none has a point.
fn commas(rows: &[Vec<Field>], separator: char) -> bool {
    let point = CellRules { unit: Notation::Metres, decimal_comma: false };
    let comma = CellRules { unit: Notation::Metres, decimal_comma: true };
    let (mut commas, mut points) = (0usize, 0usize);
    for field in rows.iter().flatten().filter(|f| f.text.contains([',', '.'])) {
        let plain =
            |rules| parse_cell(&field.text, rules).is_ok_and(|r| matches!(r.writing, CellWriting::Plain { .. }));
        if field.text.contains('.') {
            points += usize::from(plain(point));
        } else if separator != ',' || field.text.matches(',').count() == 1 {
            commas += usize::from(plain(comma));
        }
    }
    commas > 0 && points == 0
}

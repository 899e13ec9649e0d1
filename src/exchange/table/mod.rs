//! Tables of offsets in the layouts of many programs, and bodies as sections, read into one [`OffsetTable`], and
//! written back.
//!
//! Fields (CSV, XLSX) become a layout (matrix, tidy, pairs); positions, units and cells make the table; checks
//! look at the whole. Everything that is wrong is returned at once, each with its row and column; everything that was
//! assumed is a note. Cost: linear in the file, and in the square of the number of lines, of which there are
//! at most [`MOST_LINES`].

mod abreast;
mod around;
mod assemble;
mod blanks;
mod boat;
mod boat_rows;
mod body;
mod bottom;
mod britfair;
mod checks;
mod chines;
mod columns;
mod delftship;
mod edges;
mod ends;
mod fields;
mod formats;
mod freeship;
mod ghs;
mod grid;
mod header;
mod heights;
mod joined;
mod lines;
mod long;
mod matrix;
mod michlet;
mod numbering;
mod obeyed;
mod outline;
mod pairs;
mod pdstrip;
mod pias;
mod pieces;
mod points;
mod problem;
mod ratio;
mod scale;
mod seaway;
mod sections;
mod settings;
mod several;
mod sheets;
#[cfg(feature = "workbooks")]
mod shown;
mod sidecar;
mod sides;
mod thousands;
mod tidy;
mod titles;
mod triples;
mod unsupported;
#[cfg(feature = "workbooks")]
mod workbook;
#[cfg(not(feature = "workbooks"))]
#[path = "no_workbook.rs"]
mod workbook;
mod write;
mod xlsx;

pub use super::table::blanks::MOST_COLUMNS;
pub(super) use body::body_faults;
pub use body::{ReadBody, read_body};
pub use britfair::write as write_britfair;
pub use delftship::write as write_delftship;
pub use freeship::write as write_freeship;
pub use ghs::write as write_ghs;
pub use grid::{LARGEST_TABLE, LONGEST_FIELD, MOST_CELLS, MOST_LINES, MOST_ROWS};
pub use michlet::write as write_michlet;
pub use outline::section_of;
pub use pdstrip::write as write_pdstrip;
pub use pias::write as write_pias;
pub use problem::{Severity, TableProblem};
pub use ratio::read_with as read_fractions;
pub use sidecar::read_particulars;
pub use workbook::workbook;
pub use write::{Rounding, TableWriting, WrittenTable, only_sections, write_table};
pub use xlsx::MOST_UNPACKED;

use self::grid::Grid;
use self::problem::{Field, FilePosition, Problems};
use self::settings::Settings;
use crate::hull::{OffsetTable, Order, Rows, TableForm, TableLayout};
use crate::units::{CellRules, CellWriting, NAME_REMEDY, Notation, counted, name_fault, parse_cell, unguarded};

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
    read_table_with(name, bytes, None)
}

/// Reads a table of offsets with the conventions of the TOML file beside it, given by its name and its text, and of
/// others, each over those before it.
///
/// # Errors
/// Every problem of all files at once, in the order of rows and columns.
pub fn read_table_with<'a>(
    name: &str,
    bytes: &[u8],
    sidecar: impl IntoIterator<Item = (&'a str, &'a str)>,
) -> Result<ReadTable, Vec<TableProblem>> {
    let sidecar: Vec<(&str, &str)> = sidecar.into_iter().collect();
    let read = read_any(name, bytes, sidecar)?;
    let faults = name_faults(name, &read.table);
    if faults.is_empty() { Ok(read) } else { Err(faults) }
}

/// Names of the ship, of stations and of lines that no drawing can show.
fn name_faults(file: &str, table: &OffsetTable) -> Vec<TableProblem> {
    let mut problems = Problems::new(file);
    let stations = table.stations.iter().map(|station| ("station", station.station.name.as_str()));
    let lines = table.lines.iter().map(|line| ("line", line.name.as_str()));
    for (of, name) in [("table", table.name.as_str())].into_iter().chain(stations).chain(lines) {
        if let Some(fault) = name_fault(name) {
            problems.error("E316", (FilePosition::FILE, name), format!("{of}: {fault}"), NAME_REMEDY);
        }
    }
    problems.finish().err().unwrap_or_default()
}

/// The same without a look at the names.
fn read_any(name: &str, bytes: &[u8], sidecar: Vec<(&str, &str)>) -> Result<ReadTable, Vec<TableProblem>> {
    if let Some(body) = read_body(name, bytes, sidecar.iter().copied()) {
        return body.and_then(ReadBody::table).map(|mut read| {
            let mut problems = Problems::new(name);
            chines::mark(&mut read.table, &mut problems);
            read.notes.extend(problems.finish().unwrap_or_default());
            read
        });
    }
    if let Some(read) = lines::read(name, bytes, &sidecar) {
        return read;
    }
    let mut problems = Problems::new(name);
    if let Some(format) = unsupported::format(name, bytes) {
        let message = format!("{format} is not read");
        problems.error("E300", FilePosition::FILE, message, unsupported::remedy(format));
        return Err(problems.finish().err().unwrap_or_default());
    }
    let mut settings = Settings::default();
    for (name, text) in &sidecar {
        sidecar::read(name, text, &mut settings, &mut problems);
    }
    if let Some(read) = formats::read(name, bytes, sidecar.first().copied(), &settings) {
        let mut read = match (read, problems.any_errors()) {
            // What is wrong with the file beside it comes first.
            (_, true) => return Err(problems.finish().err().unwrap_or_default()),
            (Err(faults), false) => return Err(faults),
            (Ok(read), false) => read,
        };
        read.notes.extend(problems.finish()?);
        return Ok(read);
    }
    let mut table = match problems.any_errors() {
        // Without its conventions the table would give misleading problems.
        true => None,
        false => fields(bytes, &mut settings, &mut problems),
    };
    if let Some(table) = table.as_mut().filter(|_| !problems.any_errors()) {
        checks::missing(table, &mut problems);
        checks::whole(table, settings.full, &mut problems);
        checks::profiles(table, &mut problems);
        edges::far(table, &mut problems);
        edges::deck(table, &mut problems);
    } else if !problems.any_errors() {
        let message = "no table of offsets is recognised".to_owned();
        problems.error(
            "E300",
            FilePosition::FILE,
            message,
            "Give a matrix with a row of headers, or columns station,x,curve,z,y,flag",
        );
    }
    let notes = problems.finish()?;
    Ok(ReadTable { table: table.unwrap_or_default(), notes })
}

/// The table of a file of fields: CSV, TSV or XLSX.
fn fields(bytes: &[u8], settings: &mut Settings, problems: &mut Problems) -> Option<OffsetTable> {
    if xlsx::is_xlsx(bytes) {
        return sheets::read(workbook::sheets(bytes, problems)?, settings, problems);
    }
    let text = grid::decode(bytes, problems)?;
    // The separator may be said in a comment, which is found with any separator.
    let mut grid = grid::split(&text, settings.separator, problems)?;
    settings.comments(&grid.comments, problems);
    if let Some(separator) = settings.separator.filter(|&c| c != grid.separator) {
        grid = grid::split(&text, Some(separator), problems)?;
    }
    of_grid(grid, &text, None, settings, problems)
}

/// The table of rows of fields, which are those of a text or of a sheet.
fn of_grid(
    mut grid: Grid,
    text: &str,
    sheet: Option<String>,
    settings: &mut Settings,
    problems: &mut Problems,
) -> Option<OffsetTable> {
    if problems.any_errors() {
        return None;
    }
    if grid.rows.iter().all(Vec::is_empty) {
        problems.error(
            "E300",
            FilePosition::FILE,
            "the file is empty".to_owned(),
            "Give the table as CSV, TSV or XLSX",
        );
        return None;
    }
    for field in grid.rows.iter_mut().flatten().filter(|field| field.text.starts_with('\'')) {
        field.text = unguarded(&field.text).to_owned();
    }
    if sheet.is_none() {
        titles::settle(&mut grid.rows, grid.separator);
    }
    abreast::settle(&mut grid.rows, problems);
    triples::settle(&mut grid.rows, problems);
    thousands::settle(&mut grid.rows, grid.separator, settings, problems);
    let layout = settings.layout.unwrap_or_else(|| {
        if tidy::is_tidy(&grid.rows) || long::is_long(&grid.rows) {
            TableLayout::Tidy
        } else if boat::is_boat(&grid.rows) {
            TableLayout::Other
        } else if pairs::is_pairs(&grid.rows, grid.separator) {
            TableLayout::Pairs
        } else {
            TableLayout::Matrix
        }
    });
    if let Some(header) = long::unknown_words(&grid.rows).filter(|_| layout == TableLayout::Matrix) {
        long::refuse_words(header, problems);
        return None;
    }
    settings.from_waterline = heights::from_waterline(&grid.rows, &grid.comments);
    if layout == TableLayout::Tidy {
        titles::units_below(&mut grid.rows, long::from_header);
    }
    if layout != TableLayout::Matrix {
        around::titles(&grid.rows, settings, problems);
    }
    // The comma of a pair stands between its two numbers.
    let decimal_comma =
        layout != TableLayout::Pairs && settings.decimal_comma.unwrap_or_else(|| commas(&grid.rows, grid.separator));
    let form = TableForm {
        // A blank cell has no place between blanks.
        separator: if grid.separator == ' ' { ',' } else { grid.separator },
        decimal_comma,
        carriage_returns: grid.carriage_returns,
        open_end: grid.open_end,
        sheet,
        ..TableForm::default()
    };
    let mut table = match layout {
        TableLayout::Other => {
            problems.note("rows of heights and half-breadths of lines, columns are stations".to_owned());
            boat::read(&grid.rows, &grid.comments, form, settings, problems)?
        }
        TableLayout::Tidy if long::is_long(&grid.rows) => {
            problems.note("one point a row".to_owned());
            let mut table = long::read(&grid.rows, form, settings, problems)?;
            chines::mark(&mut table, problems);
            table
        }
        TableLayout::Tidy => {
            problems.note("one offset a row".to_owned());
            tidy::read(&grid.rows, form, settings, problems)?
        }
        TableLayout::Pairs => {
            problems.note("columns are stations, cells are pairs of half-breadth and height".to_owned());
            pairs::read(&grid.rows, form, settings, problems)?
        }
        TableLayout::Matrix => matrix(&grid, text, form, settings, problems)?,
    };
    if let Some(name) = &settings.name {
        table.name.clone_from(name);
    }
    table.stated = settings.stated;
    heights::settle(&mut table, settings.from_waterline.as_deref(), settings.stated.draught, problems);
    table.lines.extend(settings.lines.iter().cloned());
    table.transom = settings.transom;
    if !table.waterlines.is_empty() || !problems.any_errors() {
        checks::endings(&mut table, settings, problems);
    }
    if table.form.station_order == Order::Falling {
        problems.note("stations are written from forward aft; their order is turned".to_owned());
    }
    if table.form.waterline_order == Order::Falling {
        problems.note("waterlines are written from the deck down; their order is turned".to_owned());
    }
    Some(table)
}

/// The table of a matrix.
fn matrix(
    grid: &Grid,
    text: &str,
    form: TableForm,
    settings: &mut Settings,
    problems: &mut Problems,
) -> Option<OffsetTable> {
    let mut pieces = pieces::pieces(&grid.rows);
    pieces::without_others(&mut pieces, problems);
    around::settle(&pieces, settings, problems);
    let mut blocks = matrix::blocks(&pieces.tables, settings, problems);
    several::expand(&mut blocks, form.decimal_comma, problems);
    let blocks = joined::join_all(blocks, form.decimal_comma, problems);
    let first = blocks.first()?;
    let across = if first.across == header::Axis::Buttock { "buttock" } else { "waterline" };
    let (rows, columns) = match first.rows {
        Rows::Stations => ("station", across),
        Rows::Waterlines => (across, "station"),
    };
    problems.note(format!(
        "{} and {}; rows are {rows}s, columns are {columns}s ({}); fields are separated by {}{}",
        counted(first.stations.len(), "station"),
        counted(first.heads.len(), across),
        first.reason,
        match grid.separator {
            '\t' => "tabs".to_owned(),
            ' ' => "blanks".to_owned(),
            c => format!("'{c}'"),
        },
        if form.decimal_comma { ", decimal commas" } else { "" }
    ));
    let places = first.heads.iter().map(|f| f.row).chain(first.stations.iter().map(|line| line.head.row));
    let header_row = places.chain([first.first.row]).filter(|&row| row > 0).min().unwrap_or(1);
    let above = text.lines().take(header_row - 1).map(str::to_owned);
    let preamble = above.chain(around::unit_lines(&pieces, settings)).collect();
    let mut table = assemble::assemble(blocks, TableForm { preamble, ..form }, settings, problems)?;
    table.name = around::name(&pieces, header_row).unwrap_or_default();
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

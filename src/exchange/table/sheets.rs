//! Which sheet of a workbook holds the table: the one that the conventions name, or the visible one that can be read.

use super::problem::{FilePosition, Problems};
use super::settings::{Settings, nearest};
use super::xlsx::{Sheet, lines};
use super::{OffsetTable, of_grid};

/// A sheet as it was read.
struct Reading {
    name: String,
    table: Option<OffsetTable>,
    settings: Settings,
    problems: Problems,
    cells: usize,
}

fn read_one(sheet: Sheet, settings: &Settings) -> Reading {
    let Sheet { name, grid, mut problems, .. } = sheet;
    let mut settings = settings.clone();
    problems.note(format!("sheet '{name}' of the workbook"));
    settings.comments(&grid.comments, &mut problems);
    let (cells, text) = (grid.rows.iter().map(Vec::len).sum(), lines(&grid));
    let table = of_grid(grid, &text, Some(name.clone()), &mut settings, &mut problems);
    Reading { name, table: table.filter(|_| !problems.any_errors()), settings, problems, cells }
}

/// The sheet of a name; a problem where there is none.
fn named(sheets: Vec<Sheet>, name: &str, problems: &mut Problems) -> Option<Vec<Sheet>> {
    let names: Vec<String> = sheets.iter().map(|sheet| sheet.name.clone()).collect();
    let found: Vec<Sheet> = sheets.into_iter().filter(|sheet| sheet.name.eq_ignore_ascii_case(name)).collect();
    if found.is_empty() {
        let near = nearest(name, names.iter().map(String::as_str));
        let remedy =
            near.map_or_else(|| format!("Known are {}", names.join(", ")), |near| format!("Did you mean {near}?"));
        problems.error("E311", FilePosition::FILE, format!("the workbook has no sheet '{name}' with cells"), &remedy);
        return None;
    }
    Some(found)
}

/// The visible sheets; a problem where there is none.
fn visible(sheets: Vec<Sheet>, problems: &mut Problems) -> Option<Vec<Sheet>> {
    let (hidden, visible): (Vec<Sheet>, Vec<Sheet>) = sheets.into_iter().partition(|sheet| sheet.hidden);
    let names: Vec<&str> = hidden.iter().map(|sheet| sheet.name.as_str()).collect();
    if visible.is_empty() {
        let message = format!("all sheets with cells are hidden: {}", names.join(", "));
        problems.error(
            "E300",
            FilePosition::FILE,
            message,
            "Show the sheet, or name it: sheet = \"...\" in the conventions",
        );
        return None;
    }
    if !names.is_empty() {
        problems.note(format!("hidden sheets are not read: {}", names.join(", ")));
    }
    Some(visible)
}

/// The table of a workbook.
pub(super) fn read(sheets: Vec<Sheet>, settings: &mut Settings, problems: &mut Problems) -> Option<OffsetTable> {
    let chosen = match &settings.sheet {
        Some(name) => named(sheets, name, problems)?,
        None => visible(sheets, problems)?,
    };
    let mut readings: Vec<Reading> = chosen.into_iter().map(|sheet| read_one(sheet, settings)).collect();
    let good: Vec<usize> = (0..readings.len()).filter(|&k| readings[k].table.is_some()).collect();
    if good.len() > 1 {
        let others: Vec<String> = good[1..].iter().map(|&k| format!("'{}'", readings[k].name)).collect();
        let message =
            format!("sheet '{}' is read; {} can be read as tables too", readings[good[0]].name, others.join(", "));
        problems.warning("W320", FilePosition::FILE, message, "Name the sheet: sheet = \"...\" in the conventions");
    }
    // Where none can be read, the largest is what was meant.
    let largest = (0..readings.len()).max_by_key(|&k| (readings[k].cells, std::cmp::Reverse(k)))?;
    let reading = readings.swap_remove(good.first().copied().unwrap_or(largest));
    *settings = reading.settings;
    problems.absorb(reading.problems);
    reading.table
}

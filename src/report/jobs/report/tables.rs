//! The tables of a report as files: offsets in three notations, heights, diagonals, areas of sections, hydrostatics.

use super::cells::Table;
use crate::exchange::{
    conventions_json, diagonals_csv, heights_csv, hydrostatics_csv, micrometres, offsets_csv, row_json,
    section_areas_csv,
};
use crate::fairing::inspect::Planes;
use crate::hull::{Entry, Hull, OffsetTable, default_buttocks, default_stations, default_waterlines};
use crate::hydrostatics::{CurvesOfForm, assumed_mark};
use crate::plot::BonjeanTable;
use crate::report::failure::Failure;
use crate::report::input::result::JobResult;
use crate::report::output::files::OutputFile;
use crate::report::output::manifest::json_file;
use crate::report::words::page::{conventions_line, fixed};
use crate::units::{Notation, decimal};

/// Offsets of `hull`, that of the result or that before fairing, at the lines of the table where there is one, else at
/// default lines; buttocks are those of the hull of the result.
fn offsets(result: &JobResult, hull: &Hull) -> OffsetTable {
    let (stations, waterlines) = match &result.fairing {
        Some((record, _)) => (record.lines.stations.clone(), record.lines.waterlines.clone()),
        None => (
            default_stations(&result.hull, result.conventions.stations),
            default_waterlines(&result.hull).into_iter().map(decimal).collect(),
        ),
    };
    let buttocks: Vec<f64> = default_buttocks(&result.hull).into_iter().map(decimal).collect();
    let mut table = OffsetTable::from_hull(hull, &stations, &waterlines, &buttocks);
    for station in &mut table.stations {
        for cell in station.half_breadths.iter_mut().chain(&mut station.heights) {
            cell.entry = cell.value().map_or(cell.entry, |y| Entry::Given(micrometres(y)));
        }
        let more = [
            &mut station.keel_height,
            &mut station.flat_of_bottom,
            &mut station.deck_height,
            &mut station.deck_half_breadth,
        ];
        more.into_iter().for_each(|value| *value = value.map(micrometres));
    }
    table.endings.iter_mut().flatten().for_each(|end| *end = end.map(micrometres));
    table
}

/// What the numbers refer to, a line each.
fn conventions(result: &JobResult) -> Vec<(String, String)> {
    let p = result.hull.particulars();
    let assumed = result.conventions.assumed;
    let line = |what: &str, how: String| (what.to_owned(), how);
    let mut list = vec![
        line("ship", result.hull.name().to_owned()),
        line(
            &format!("Lpp [m]{}", assumed_mark(assumed.length)),
            micrometres(p.length_between_perpendiculars).to_string(),
        ),
        line(&format!("B [m]{}", assumed_mark(assumed.breadth)), micrometres(p.breadth).to_string()),
        line("T [m]", p.draught.map_or("not stated".to_owned(), |draught| micrometres(draught).to_string())),
        line(&format!("D [m]{}", assumed_mark(assumed.depth)), micrometres(p.depth).to_string()),
        line("frame", "x forward from AP, y to port, z up from the moulded base line; moulded".to_owned()),
        line("in short", conventions_line(&result.conventions)),
    ];
    if let Some(object) = conventions_json(&result.conventions).as_object() {
        let word = |value: &serde_json::Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let given = object.iter().filter(|(_, value)| !value.is_null());
        list.extend(given.map(|(key, value)| (key.clone(), word(value))));
    }
    list.push(line("program", format!("loftsman {}", env!("CARGO_PKG_VERSION"))));
    list
}

/// Names of the tables of offsets, of heights at buttocks, and of distances along diagonals.
const OFFSETS: [&str; 3] = ["offsets", "heights", "diagonals"];

/// The three tables of [`OFFSETS`] of a hull, its `table` of offsets given, as CSV.
fn texts(result: &JobResult, (hull, table): (&Hull, &OffsetTable), notation: Notation) -> [String; 3] {
    let planes = Planes::with_defaults(&result.hull);
    let stations: Vec<_> = table.stations.iter().map(|station| station.station.clone()).collect();
    [
        offsets_csv(table, notation, true),
        heights_csv(table, notation),
        diagonals_csv(hull, &stations, &planes.diagonals, planes.diagonal_angle, notation),
    ]
}

/// The tables of offsets, heights and diagonals of the page, before and after where there is a fairing: key, heading,
/// table. `files` are those of [`report_tables`].
pub(in crate::report) fn page_tables(
    result: &JobResult,
    files: &[OutputFile],
) -> Vec<(&'static str, &'static str, Table)> {
    let before = result
        .fairing
        .as_ref()
        .map(|(record, _)| texts(result, (&record.before, &offsets(result, &record.before)), Notation::Metres));
    let headings = ["Half-breadths", "Heights at the buttocks", "Distances along the diagonals"];
    let table = |k: usize| {
        let name = format!("{}-{METRES}.csv", OFFSETS[k]);
        let after = files.iter().find(|file| file.name == name)?;
        let after = std::str::from_utf8(&after.contents).ok()?;
        let hulls = match &before {
            Some(before) => vec![("before", before[k].as_str()), ("after", after)],
            None => vec![("", after)],
        };
        Some((OFFSETS[k], headings[k], matrix(&hulls)))
    };
    (0..3).filter_map(table).collect()
}

/// Tables of several hulls with the same rows as one table: a row of each hull in turn, with the word for it.
fn matrix(hulls: &[(&str, &str)]) -> Table {
    let rows = |text: &str| -> Vec<Vec<String>> {
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    let all: Vec<(&str, Vec<Vec<String>>)> = hulls.iter().map(|(word, text)| (*word, rows(text))).collect();
    let several = all.len() > 1;
    let with = |cells: &[String], word: &str| -> Vec<String> {
        let word = several.then(|| word.to_owned());
        cells.iter().take(1).cloned().chain(word).chain(cells.iter().skip(1).cloned()).collect()
    };
    let rounded = |cell: String| cell.parse::<f64>().map_or(cell, |value| fixed(value, 4));
    let first = all.first().map_or(&[][..], |(_, rows)| rows.as_slice());
    let row = |k: usize, (word, rows): &(&str, Vec<Vec<String>>)| {
        let cells = with(rows.get(k)?, word).into_iter().enumerate();
        Some((false, cells.map(|(column, cell)| if column == 0 { cell } else { rounded(cell) }).collect()))
    };
    Table {
        heads: first.first().map_or(Vec::new(), |heads| with(heads, "hull")),
        words: 0,
        rows: (1..first.len()).flat_map(|k| all.iter().filter_map(move |hull| row(k, hull))).collect(),
    }
}

/// End of the names of the files in metres.
const METRES: &str = "m";

/// The files.
pub(in crate::report) fn report_tables(result: &JobResult, curves: &CurvesOfForm) -> Result<Vec<OutputFile>, Failure> {
    let table = offsets(result, &result.hull);
    let mut files = Vec::new();
    for (suffix, notation) in [
        (METRES, Notation::Metres),
        ("mm", Notation::Millimetres),
        ("feet-inches-eighths", Notation::FeetInchesEighths),
    ] {
        for (name, text) in OFFSETS.into_iter().zip(texts(result, (&result.hull, &table), notation)) {
            files.push(OutputFile::text(&format!("{name}-{suffix}.csv"), text));
        }
    }
    let areas = BonjeanTable::with_defaults(&result.hull, result.conventions.stations);
    let text = section_areas_csv(&areas.stations, &areas.heights, &areas.areas);
    files.push(OutputFile::text("bonjean.csv", text));
    files.push(OutputFile::text("hydrostatics.csv", hydrostatics_csv(curves)));
    let rows: Vec<serde_json::Value> = curves.rows.iter().map(row_json).collect();
    let json = serde_json::json!({ "conventions": conventions_json(&curves.conventions), "rows": rows });
    files.push(json_file("hydrostatics.json", &json)?);
    #[cfg(feature = "workbooks")]
    {
        let contents = crate::exchange::hydrostatics_workbook(curves, &conventions(result))
            .map_err(|error| Failure::Internal(format!("hydrostatics.xlsx: {error}")))?;
        files.push(OutputFile { name: "hydrostatics.xlsx".to_owned(), contents });
    }
    if let Some(text) = &result.changes {
        files.push(OutputFile::text("changes.csv", text.clone()));
    }
    Ok(files)
}

//! The tables of a report as files: offsets in three notations, heights, diagonals, areas of sections, hydrostatics.

use super::failure::Failure;
use super::files::OutputFile;
use super::generate::json_file;
use super::page::conventions_line;
use super::result::JobResult;
use crate::exchange::{
    conventions_json, diagonals_csv, heights_csv, hydrostatics_csv, hydrostatics_workbook, micrometres, offsets_csv,
    row_json, section_areas_csv,
};
use crate::fairing::inspect::Planes;
use crate::hull::{Entry, OffsetTable, default_buttocks, default_stations, default_waterlines};
use crate::hydrostatics::{CurvesOfForm, assumed_mark};
use crate::plot::BonjeanTable;
use crate::units::{Notation, decimal};

/// Offsets of the hull at the lines of its table where it has one, else at default lines.
fn offsets(result: &JobResult) -> OffsetTable {
    let hull = &result.hull;
    let (stations, waterlines) = match &result.fairing {
        Some((record, _)) => (record.lines.stations.clone(), record.lines.waterlines.clone()),
        None => (
            default_stations(hull, result.conventions.stations),
            default_waterlines(hull).into_iter().map(decimal).collect(),
        ),
    };
    let buttocks: Vec<f64> = default_buttocks(hull).into_iter().map(decimal).collect();
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
        line(&format!("T [m]{}", assumed_mark(assumed.draught)), micrometres(p.draught).to_string()),
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

/// The files.
pub(super) fn report_tables(result: &JobResult, curves: &CurvesOfForm) -> Result<Vec<OutputFile>, Failure> {
    let table = offsets(result);
    let planes = Planes::with_defaults(&result.hull);
    let stations: Vec<_> = table.stations.iter().map(|station| station.station.clone()).collect();
    let mut files = Vec::new();
    for (suffix, notation) in
        [("m", Notation::Metres), ("mm", Notation::Millimetres), ("feet-inches-eighths", Notation::FeetInchesEighths)]
    {
        let mut add = |name: &str, text: String| files.push(OutputFile::text(&format!("{name}-{suffix}.csv"), text));
        add("offsets", offsets_csv(&table, notation, true));
        add("heights", heights_csv(&table, notation));
        let diagonals = diagonals_csv(&result.hull, &stations, &planes.diagonals, planes.diagonal_angle, notation);
        add("diagonals", diagonals);
    }
    let areas = BonjeanTable::with_defaults(&result.hull, result.conventions.stations);
    let text = section_areas_csv(&areas.stations, &areas.heights, &areas.areas);
    files.push(OutputFile::text("bonjean.csv", text));
    files.push(OutputFile::text("hydrostatics.csv", hydrostatics_csv(curves)));
    let rows: Vec<serde_json::Value> = curves.rows.iter().map(row_json).collect();
    let json = serde_json::json!({ "conventions": conventions_json(&curves.conventions), "rows": rows });
    files.push(json_file("hydrostatics.json", &json)?);
    let contents = hydrostatics_workbook(curves, &conventions(result))
        .map_err(|error| Failure::Internal(format!("hydrostatics.xlsx: {error}")))?;
    files.push(OutputFile { name: "hydrostatics.xlsx".to_owned(), contents });
    if let Some(text) = &result.changes {
        files.push(OutputFile::text("changes.csv", text.clone()));
    }
    Ok(files)
}

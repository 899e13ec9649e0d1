//! Sections as columns of pairs: one column a station, every cell `y,z` with or without brackets.
//!
//! When all stations have the same heights the pairs are a matrix of half-breadths in disguise and become one; otherwise
//! they are outlines.

use super::assemble::TableReader;
use super::header::{Corner, Position, position};
use super::long::from_header;
use super::numbering::{Breadths, origin};
use super::problem::{Field, Problems};
use super::scale::{Size, ends_from_midship, units};
use super::settings::Settings;
use crate::hull::{
    Cell, Kept, Marks, OffsetTable, Order, OutlinePoint, StationOffsets, TableForm, TableLayout, Written,
};

/// The two texts of a cell `(0.11, 0.5846)`; stray brackets are left out.
fn pair(text: &str) -> Option<(&str, &str)> {
    let bare = text.trim().trim_start_matches(['(', '[']).trim_end_matches([')', ']']);
    let (y, z) = bare.split_once([',', ';'])?;
    let number =
        |t: &str| t.trim().parse::<f64>().is_ok_and(f64::is_finite) && !t.trim().ends_with(char::is_alphabetic);
    (number(y) && number(z)).then_some((y.trim(), z.trim()))
}

/// Whether most cells below the first row are pairs that can be nothing else.
pub(super) fn is_pairs(rows: &[Vec<Field>], separator: char) -> bool {
    let cells = || rows.iter().filter(|row| !row.is_empty()).skip(1).flatten().filter(|f| !f.is_blank());
    let all = cells().count();
    let pairs = cells().filter(|f| pair(&f.text).is_some());
    let certain = pairs.clone().any(|f| f.text.contains(['(', '.']));
    separator == ',' && all > 0 && certain && 2 * pairs.count() > all
}

/// The table of a file of pairs.
pub(super) fn read(
    rows: &[Vec<Field>],
    form: TableForm,
    settings: &Settings,
    problems: &mut Problems,
) -> Option<OffsetTable> {
    let mut rows = from_header(rows).iter().filter(|row| !row.is_empty());
    let header = rows.next()?;
    let mut heads: Vec<(Field, Position)> = Vec::new();
    let mut unread: Vec<usize> = Vec::new();
    for field in header.iter().filter(|f| !f.is_blank()) {
        match position(field.trimmed(), false) {
            Ok(position) => heads.push((field.clone(), position)),
            Err(error) => {
                let message = format!("the header of a station names no position: {error}");
                problems.error("E310", field, message, "Write STN and its number, or its distance");
                unread.push(field.column);
            }
        }
    }
    if heads.is_empty() {
        return None;
    }
    // Points of each station as fields.
    let mut points: Vec<Vec<(Field, Field)>> = heads.iter().map(|_| Vec::new()).collect();
    for field in rows.flatten().filter(|f| !f.is_blank()) {
        let Some(station) = heads.binary_search_by_key(&field.column, |(head, _)| head.column).ok() else {
            if !unread.contains(&field.column) {
                problems.error("E307", field, "a pair without a station above it".to_owned(), "");
            }
            continue;
        };
        let Some((y, z)) = pair(&field.text) else {
            problems.error("E301", field, "not a pair of half-breadth and height".to_owned(), "Write 3.14,0.5");
            continue;
        };
        let part = |text: &str| Field { text: text.to_owned(), ..field.clone() };
        points[station].push((part(y), part(z)));
    }
    let y = Size::of(points.iter().flatten().map(|(y, _)| y), false);
    let z = Size::of(points.iter().flatten().map(|(_, z)| z), false);
    let positions: Vec<Position> = heads.iter().map(|(_, p)| *p).collect();
    let corner = Corner { rows: Some(super::header::Axis::Station), ..Corner::default() };
    let breadths = Breadths { largest: y.largest, ..Breadths::default() };
    let origin = origin(settings, corner, &positions, breadths, problems);
    let units = units(settings, corner, [Size::of_positions(positions.iter()), y, z], origin.numbers, problems);
    let datum = ends_from_midship(origin.datum, settings, &positions, units.x, problems);
    let form = TableForm { origin: datum, layout: TableLayout::Pairs, ..form };
    let mut reader = TableReader::new(settings, form, units, problems);
    reader.length = reader.length.or(origin.length);
    let xs: Vec<f64> = positions.into_iter().map(|p| reader.along(p)).collect();
    let fields: Vec<Field> = heads.iter().map(|(field, _)| field.clone()).collect();
    let mut table = OffsetTable::default();
    for ((field, x), points) in fields.iter().zip(&xs).zip(&points) {
        let mut station = StationOffsets::new(field.trimmed(), *x);
        let mut outline = Vec::with_capacity(points.len());
        for (y, z) in points {
            let (cell, z) = (reader.cell(y, true), reader.length(z, units.z));
            if let (Some(y), Some(z)) = (cell.value(), z) {
                outline.push(OutlinePoint { y, z, marks: Marks::default() });
                station.half_breadths.push(Cell { written: cell.written.clone(), ..cell });
            }
        }
        station.outlines.push(outline);
        table.stations.push(station);
    }
    let order = super::assemble::order(&xs, &fields, "station", reader.problems)?;
    let kept: Vec<Kept> =
        fields.iter().zip(&xs).map(|(f, &value)| Kept { text: f.trimmed().to_owned(), value }).collect();
    reader.form.station_heads = kept;
    reader.form.station_order = order;
    if order == Order::Falling {
        table.stations.reverse();
        reader.form.station_heads.reverse();
    }
    grid(&mut table, reader.problems);
    table.form = reader.finish();
    Some(table)
}

/// Sections with the same heights become half-breadths at waterlines; others keep their outlines.
fn grid(table: &mut OffsetTable, problems: &mut Problems) {
    let heights = |station: &StationOffsets| -> Vec<f64> { station.outlines[0].iter().map(|p| p.z).collect() };
    let first = table.stations.first().map(heights).unwrap_or_default();
    let same = |other: &StationOffsets| {
        let other = heights(other);
        other.len() == first.len() && other.iter().zip(&first).all(|(a, b)| (a - b).abs() < 1e-9)
    };
    let level = first.windows(2).all(|w| w[1] > w[0]) && table.stations.iter().all(same);
    for station in &mut table.stations {
        if level {
            station.outlines.clear();
            // A pair has one place; its text is that of the half-breadth.
            for cell in &mut station.half_breadths {
                cell.written = cell.written.take().map(|w| Written { text: w.text.trim().to_owned(), ..w });
            }
        } else {
            station.half_breadths.clear();
        }
    }
    if level {
        problems.note(format!("all sections have the same {} heights; they are read as waterlines", first.len()));
        table.waterlines = first;
    } else {
        problems.note("the sections have different heights; they are read as outlines".to_owned());
    }
}

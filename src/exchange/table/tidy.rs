//! Tidy tables: one offset a row, `station,x,curve,z,y,flag`.
//!
//! | curve | a row is |
//! |---|---|
//! | `WL` | the half-breadth y at the height z |
//! | `BT` | the height z at the buttock y |
//! | `SEC` | a point (y, z) of the section of the station, from keel to deck |
//! | `KN`, `TL` | a point (x, y, z) of the knuckle or tangent line that `station` names |
//! | `KEEL`, `FOS`, `DECKC` | the height z of the keel, of the lower edge of the flat of side, of the deck on the centreline |
//! | `FOB` | the half-breadth y of the flat of bottom |
//! | `DECK` | the height z of the deck at side and the half-breadth y there, either |
//! | `STERN`, `STEM` | x of the profile at the height z |
//!
//! `flag` holds marks: `K`, `T`, `!`, `?`, `()`; they may stand in the cell of y as well. The flag `B` begins a further
//! branch of a section. Distances along diagonals (`DG`) have no place in the table and are announced. The order of
//! rows is free.

use super::assemble::{SAME, TableReader};
use super::columns::{Column, column};
use super::grid::{MOST_CELLS, MOST_LINES};
use super::header::{Axis, Corner, Position, axis_of, plain_number, position, unit_of};
use super::heights::counted_points;
use super::long::from_header;
use super::numbering::{Breadths, origin};
use super::problem::{Field, FilePosition, Problems};
use super::scale::{Size, ends_from_midship, units};
use super::settings::{Settings, nearest};
use super::write::Writer;
use crate::hull::{
    Cell, Entry, FeatureLine, Kept, LineKind, OffsetTable, OutlinePoint, SideKind, StationOffsets, TableForm,
    TableLayout,
};

/// The columns in the order in which a row gives them.
const COLUMNS: [Column; 6] = [Column::Station, Column::X, Column::Curve, Column::Z, Column::Y, Column::Flag];

/// Kinds of curves.
const CURVES: [&str; 13] =
    ["WL", "BT", "SEC", "KN", "TL", "DG", "KEEL", "FOB", "FOS", "DECK", "DECKC", "STERN", "STEM"];

/// Index of each column in the file.
type Columns = [Option<usize>; 6];

fn columns(header: &[Field]) -> Columns {
    let named: Vec<Option<Column>> = header.iter().map(|field| column(&field.text).map(|n| n.column)).collect();
    COLUMNS.map(|wanted| named.iter().position(|column| *column == Some(wanted)))
}

/// Whether the first row has the columns of a tidy table.
pub(super) fn is_tidy(rows: &[Vec<Field>]) -> bool {
    from_header(rows).iter().find(|row| !row.is_empty()).is_some_and(|header| is_header(header))
}

/// Whether a row names the kinds of curves with their heights and half-breadths.
pub(super) fn is_header(row: &[Field]) -> bool {
    let columns = columns(row);
    columns[2].is_some() && columns[3].is_some() && columns[4].is_some()
}

/// What the numbers of a column of stations count.
fn numbered_by(header: &[Field]) -> Axis {
    let is_frame = |field: &Field| axis_of(field.trimmed()) == Some(Axis::Frame);
    if header.iter().any(is_frame) { Axis::Frame } else { Axis::Station }
}

/// One row.
struct Record<'g> {
    station: &'g Field,
    x: &'g Field,
    curve: &'static str,
    z: &'g Field,
    y: &'g Field,
    flag: String,
}

/// The rows with known curves.
fn rows_of<'g>(rows: &'g [Vec<Field>], blank: &'g Field, problems: &mut Problems) -> Vec<Record<'g>> {
    let mut rows = rows.iter().filter(|row| !row.is_empty());
    let Some(header) = rows.next() else { return Vec::new() };
    let columns = columns(header);
    let mut records = Vec::new();
    for row in rows {
        if row.len() != header.len() {
            let message = format!("the row has {} fields, the header has {}", row.len(), header.len());
            problems.error("E307", FilePosition::row(row[0].row), message, "");
            continue;
        }
        let field = |k: usize| columns[k].map_or(blank, |at| &row[at]);
        let word = field(2).trimmed();
        let Some(curve) = CURVES.into_iter().find(|curve| curve.eq_ignore_ascii_case(word)) else {
            let near = nearest(word, CURVES.into_iter());
            let remedy =
                near.map_or_else(|| format!("Known are {}", CURVES.join(", ")), |near| format!("Did you mean {near}?"));
            problems.error("E310", field(2), "not a kind of curve".to_owned(), &remedy);
            continue;
        };
        let flag = field(5);
        if !flag.trimmed().chars().all(|c| matches!(c, 'K' | 'T' | '!' | '?' | '(' | ')' | 'B' | ' ')) {
            problems.error("E301", flag, "not a flag".to_owned(), "Flags are K, T, !, ?, () and B");
        }
        let flag = flag.trimmed().to_owned();
        records.push(Record { station: field(0), x: field(1), curve, z: field(3), y: field(4), flag });
    }
    records
}

/// Values that are one when they are nearer than [`SAME`], in rising order.
fn distinct(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    values.dedup_by(|a, b| (*a - *b).abs() < SAME);
    values
}

fn index(values: &[f64], value: f64) -> Option<usize> {
    values.iter().position(|v| (v - value).abs() < SAME)
}

/// The table of tidy rows.
pub(super) fn read(
    rows: &[Vec<Field>],
    form: TableForm,
    settings: &Settings,
    problems: &mut Problems,
) -> Option<OffsetTable> {
    let blank = Field::default();
    let rows = from_header(rows);
    let records = rows_of(rows, &blank, problems);
    let comma = form.decimal_comma;
    let header = rows.iter().find(|row| !row.is_empty())?;
    let along = |r: &Record<'_>| -> Option<(Position, bool)> {
        // Without x the number of the station is its position.
        let field = if r.x.is_blank() { r.station } else { r.x };
        position(field.trimmed(), comma).ok().map(|p| (p, !r.x.is_blank()))
    };
    let breadths = || records.iter().filter(|r| matches!(r.curve, "WL" | "SEC" | "KN" | "TL" | "FOB"));
    let y = Size::of(breadths().map(|r| r.y), comma);
    let z = Size::of(records.iter().map(|r| r.z), comma);
    let placed: Vec<(Position, bool)> = records.iter().filter_map(along).collect();
    let positions: Vec<Position> = placed.iter().map(|(p, _)| *p).collect();
    let by_x = placed.iter().any(|(_, by_x)| *by_x);
    let corner = Corner {
        rows: Some(if by_x { Axis::X } else { numbered_by(header) }),
        columns: Some(Axis::Waterline),
        unit: header.iter().find_map(|f| unit_of(f.trimmed())),
        ..Corner::default()
    };
    let mean = |curve: &str| {
        let all: Vec<f64> =
            records.iter().filter(|r| r.curve == curve).filter_map(|r| plain_number(r.x.trimmed())).collect();
        (!all.is_empty()).then(|| all.iter().sum::<f64>() / all.len() as f64)
    };
    let stem_is_beyond = mean("STEM").zip(mean("STERN")).map(|(stem, stern)| stem > stern);
    let breadths = Breadths { largest: y.largest, stem_is_beyond, ..Breadths::default() };
    let origin = origin(settings, corner, &positions, breadths, problems);
    let units = units(settings, corner, [Size::of_positions(positions.iter()), y, z], origin.numbers, problems);
    let datum = ends_from_midship(origin.datum, settings, &positions, units.x, problems);
    let form = TableForm { origin: datum, layout: TableLayout::Tidy, ..form };
    let mut reader = TableReader::new(settings, form, units, problems);
    reader.length = reader.length.or(origin.length);
    let numbers: Vec<&Field> = records.iter().filter(|r| matches!(r.curve, "WL" | "SEC")).map(|r| r.z).collect();
    let own_unit = columns(header)[3].and_then(|at| unit_of(header[at].trimmed()));
    let spacing = counted_points(&numbers, false, own_unit.or(settings.z_units), settings, reader.problems);
    let mut table = OffsetTable::default();
    let mut read: Vec<(&Record<'_>, f64, Option<f64>, Cell)> = Vec::with_capacity(records.len());
    for record in &records {
        let line = matches!(record.curve, "KN" | "TL" | "STERN" | "STEM");
        let field = if record.x.is_blank() && !line { record.station } else { record.x };
        let x = match position(field.trimmed(), comma) {
            Ok(position) => reader.along(position),
            Err(error) => {
                reader.problems.error("E310", field, format!("no position of a station: {error}"), "");
                reader.cell(if record.curve == "BT" { record.z } else { record.y }, record.curve != "BT");
                continue;
            }
        };
        let buttock = record.curve == "BT";
        // At a buttock the height is the offset, with its marks, and y the position.
        let mut cell = reader.cell(if buttock { record.z } else { record.y }, !buttock);
        let counted = spacing.zip(plain_number(&record.z.text)).filter(|_| matches!(record.curve, "WL" | "SEC"));
        let other = match counted {
            Some((spacing, number)) => Some(spacing * number),
            None if buttock => reader.length(record.y, units.y),
            None => reader.length(record.z, units.z),
        };
        flags(&mut cell, &record.flag);
        let needs = !matches!(record.curve, "FOB" | "DECK");
        if needs && other.is_none() {
            let message = format!("a {} without its {}", record.curve, if buttock { "y" } else { "z" });
            reader.problems.error("E301", if buttock { record.y } else { record.z }, message, "");
            continue;
        }
        read.push((record, x, other, cell));
    }
    let of = |curve: &'static str| read.iter().filter(move |(r, ..)| r.curve == curve);
    table.waterlines =
        distinct(of("WL").chain(of("STERN")).chain(of("STEM")).filter_map(|(_, _, other, _)| *other).collect());
    table.buttocks = distinct(of("BT").filter_map(|(_, _, other, _)| *other).collect());
    let lines = ["KN", "TL", "STERN", "STEM"];
    let xs = distinct(read.iter().filter(|(r, ..)| !lines.contains(&r.curve)).map(|(_, x, ..)| *x).collect());
    let most = xs.len().max(table.waterlines.len()).max(table.buttocks.len());
    if most > MOST_LINES || xs.len() * (table.waterlines.len() + table.buttocks.len()) > MOST_CELLS {
        let message = format!(
            "{} stations, {} waterlines and {} buttocks; a table has at most {MOST_LINES} of each and {MOST_CELLS} cells",
            xs.len(),
            table.waterlines.len(),
            table.buttocks.len()
        );
        reader.problems.error("E312", FilePosition::FILE, message, "");
        return None;
    }
    for &x in &xs {
        let mut station = StationOffsets::new("", x);
        station.half_breadths = vec![Cell::default(); table.waterlines.len()];
        station.heights = vec![Cell::default(); table.buttocks.len()];
        table.stations.push(station);
    }
    for (record, x, other, cell) in read {
        put(&mut table, &mut reader, (record, x, other, cell), &xs);
    }
    let mut kept: Vec<Kept> = Vec::new();
    for record in &records {
        let Some((position, true)) = along(record) else { continue };
        let value = reader.along(position);
        if index(&xs, value).is_some() && !kept.iter().any(|k| k.text_of(value).is_some()) && kept.len() < xs.len() {
            kept.push(Kept { text: record.x.trimmed().to_owned(), value });
        }
    }
    reader.form.station_heads = kept;
    super::checks::signs(&mut table, &mut reader);
    for line in &mut table.lines {
        line.points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    }
    table.form = reader.finish();
    Some(table)
}

fn flags(cell: &mut Cell, flag: &str) {
    cell.marks.knuckle |= flag.contains('K');
    cell.marks.tangent |= flag.contains('T');
    cell.marks.locked |= flag.contains('!');
    cell.marks.doubtful |= flag.contains('(');
    if flag.contains('?') && cell.value().is_none() {
        cell.entry = Entry::Unknown;
    }
}

/// Puts one row where it belongs.
fn put(
    table: &mut OffsetTable,
    reader: &mut TableReader<'_>,
    (record, x, other, cell): (&Record<'_>, f64, Option<f64>, Cell),
    xs: &[f64],
) {
    let given = cell.value();
    let other_or_zero = other.unwrap_or(0.0);
    if matches!(record.curve, "KN" | "TL") {
        let kind = if record.curve == "KN" { LineKind::Knuckle } else { LineKind::Tangent };
        let name = record.station.trimmed();
        let point = [x, given.unwrap_or(0.0), other_or_zero];
        let full = table.lines.len() >= MOST_LINES;
        match table.lines.iter_mut().find(|line| line.kind == kind && line.name == name) {
            Some(line) => line.points.push(point),
            None if full => {
                let message = format!("more than {MOST_LINES} lines of points");
                reader.problems.error("E312", record.station, message, "");
            }
            None => table.lines.push(FeatureLine { name: name.to_owned(), kind, points: vec![point] }),
        }
        return;
    }
    if matches!(record.curve, "STERN" | "STEM") {
        if table.endings.is_empty() {
            table.endings = vec![[None; 2]; table.waterlines.len()];
        }
        if let Some(at) = index(&table.waterlines, other_or_zero) {
            table.endings[at][usize::from(record.curve == "STEM")] = Some(x);
        }
        return;
    }
    let Some(at) = index(xs, x) else { return };
    let station = &mut table.stations[at];
    if station.station.name.is_empty() {
        let name = if record.station.is_blank() { record.x } else { record.station };
        name.trimmed().clone_into(&mut station.station.name);
    }
    let slot = match record.curve {
        "WL" => index(&table.waterlines, other_or_zero).map(|j| &mut station.half_breadths[j]),
        "BT" => index(&table.buttocks, other_or_zero).map(|j| &mut station.heights[j]),
        _ => None,
    };
    if let Some(slot) = slot {
        if let Some(first) = &slot.written {
            let message = format!("this offset stands in row {} already", first.row);
            reader.problems.error("E306", record.y, message, "Take one of them away");
        }
        *slot = cell;
        return;
    }
    match record.curve {
        "SEC" => {
            if station.outlines.is_empty() || record.flag.contains('B') && !station.outlines[0].is_empty() {
                station.outlines.push(Vec::new());
            }
            if let (Some(y), Some(z), Some(outline)) = (given, other, station.outlines.last_mut()) {
                outline.push(OutlinePoint { y, z, marks: cell.marks });
            }
        }
        "KEEL" => station.keel_height = other,
        "FOS" => station.flat_of_side = other,
        "DECKC" => station.deck_centre_height = other,
        "FOB" => station.flat_of_bottom = given,
        "DECK" => (station.deck_height, station.deck_half_breadth) = (other, given),
        _ => reader.problems.note(format!("row {}: diagonals have no place in a table of offsets", record.y.row)),
    }
}

/// The rows of a table, header first.
pub(super) fn records(table: &OffsetTable, writer: &mut Writer) -> Vec<Vec<String>> {
    let unit = writer.form.notation;
    let z_unit = writer.form.z_notation;
    let suffix = |n: crate::units::Notation| format!(" [{}]", n.as_str());
    let mut records: Vec<Vec<String>> = vec![
        ["station".to_owned(), "x".to_owned() + &suffix(unit), "curve".into(), "z".into(), "y".into(), "flag".into()]
            .into(),
    ];
    let row = |name: &str, x: &str, curve: &str, z: String, y: String| -> Vec<String> {
        [name.to_owned(), x.to_owned(), curve.to_owned(), z, y, String::new()].into()
    };
    // Station numbers stand in the column of stations; x is a length.
    writer.form.origin = crate::hull::StationDatum::Lengths;
    if table.form.layout != TableLayout::Tidy {
        writer.form.station_heads.clear();
    }
    writer.form.x_notation = unit;
    for station in &table.stations {
        let (name, x) = (&station.station.name, writer.station(station.station.x));
        for (cell, &z) in station.half_breadths.iter().zip(&table.waterlines) {
            if cell.entry != Entry::Absent || cell.written.is_some() {
                let (z, y) = (writer.height(z), writer.cell(cell, true));
                records.push(row(name, &x, "WL", z, y));
            }
        }
        for (cell, &y) in station.heights.iter().zip(&table.buttocks) {
            if cell.entry != Entry::Absent || cell.written.is_some() {
                let (y, z) = (writer.length(y, unit), writer.cell(cell, false));
                records.push(row(name, &x, "BT", z, y));
            }
        }
        for (branch, outline) in station.outlines.iter().enumerate() {
            for (index, point) in outline.iter().enumerate() {
                let cell = Cell { entry: Entry::Given(point.y), marks: point.marks, written: None };
                let (z, y) = (writer.length(point.z, z_unit), writer.cell(&cell, true));
                let mut record = row(name, &x, "SEC", z, y);
                if let Some(flag) = record.last_mut().filter(|_| branch > 0 && index == 0) {
                    "B".clone_into(flag);
                }
                records.push(record);
            }
        }
        let none = String::new;
        for (kind, curve) in
            [(SideKind::Keel, "KEEL"), (SideKind::FlatOfSide, "FOS"), (SideKind::DeckCentreHeight, "DECKC")]
        {
            if let Some(z) = super::write::side_value(station, kind) {
                records.push(row(name, &x, curve, writer.length(z, z_unit), none()));
            }
        }
        if let Some(y) = station.flat_of_bottom {
            records.push(row(name, &x, "FOB", none(), writer.length(y, unit)));
        }
        if station.deck_height.is_some() || station.deck_half_breadth.is_some() {
            let z = station.deck_height.map(|z| writer.length(z, z_unit)).unwrap_or_default();
            let y = station.deck_half_breadth.map(|y| writer.length(y, unit)).unwrap_or_default();
            records.push(row(name, &x, "DECK", z, y));
        }
    }
    for (end, curve) in ["STERN", "STEM"].into_iter().enumerate() {
        for (ends, &z) in table.endings.iter().zip(&table.waterlines) {
            if let Some(x) = ends[end] {
                let (x, z) = (writer.length(x, unit), writer.height(z));
                records.push(row("", &x, curve, z, String::new()));
            }
        }
    }
    for line in &table.lines {
        let curve = if line.kind == LineKind::Knuckle { "KN" } else { "TL" };
        for &[x, y, z] in &line.points {
            let (x, z, y) = (writer.length(x, unit), writer.length(z, z_unit), writer.length(y, unit));
            records.push(row(&line.name, &x, curve, z, y));
        }
    }
    records
}

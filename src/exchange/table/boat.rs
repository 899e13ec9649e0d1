//! Tables of lines, as plans of boats have them: a column a station, and rows of heights and of half-breadths of the sheer,
//! the chines, the keel, the rabbet.
//!
//! ```text
//! , , transom, 1, 2, stem
//! , station, 0-0-0, 3-0-0, 6-0-0, 9-0-0
//! heights, sheer, 1-10-0, 1-8-4, 1-8-0, 2-3-0
//! , chine, 0-6-0, 0-4-4, 0-4-0, 1-2-0
//! half-breadths, sheer, 1-6-0, ...
//! ```
//!
//! The group may stand in a column of its own, in a row of its own, or in the name (`height of sheer`). Rows of half-breadths
//! at waterlines and of heights at buttocks belong to the sections as well, and those of diagonals that words define. Chines and knuckles are knuckles; without
//! waterlines and buttocks all lines between the lowest and the highest are, with straight panels between them.

mod cuts;
mod diagonals;
mod groups;

use self::groups::{Group, Lines, Row, group_of, lines, settled, words};
use super::around::{HALF_OR_FULL, UPWARD, half_taken, says_full};
use super::assemble::{TableReader, order};
use super::header::{Axis, Corner, Position, counts_down, position};

use super::numbering::{Breadths, origin};
use super::problem::{Field, FilePosition, Problems};
use super::scale::{Size, ends_from_midship, units};
use super::settings::Settings;

use crate::hull::{
    Entry, Kept, Marks, OffsetTable, Order, OutlinePoint, StationDatum, StationOffsets, TableForm, TableLayout,
    Written, WrittenLine, WrittenPoint,
};
use crate::units::{CellEntry, CellRules, Notation, parse_cell};

/// Points of a section nearer than this are one \[m\].
pub(super) const SAME_POINT: f64 = 1e-6;

/// Whether rows are lines with heights and half-breadths.
pub(super) fn is_boat(rows: &[Vec<Field>]) -> bool {
    !settled(&diagonals::without_definitions(rows).0).is_empty()
}

/// Which end the name of a station is: -1 aft, 1 forward.
pub(super) fn end_of(name: &str) -> i32 {
    match words(name).first().map(String::as_str) {
        Some("stem" | "bow" | "fp" | "f.p." | "forward" | "fwd") => 1,
        Some("transom" | "stern" | "sternpost" | "ap" | "a.p." | "aft") => -1,
        _ => 0,
    }
}

/// A point of a section with the name of its line.
struct LinePoint {
    station: usize,
    name: String,
    /// Whether the line is a waterline, a buttock or a diagonal.
    is_cut: bool,
    y: f64,
    z: f64,
    /// Where its half-breadth and its height are written.
    cells: [Option<Written>; 2],
}

/// Refuses heights that count downward.
fn refuse_downward(lines: &Lines<'_>, problems: &mut Problems) {
    if let Some(label) = lines.labels.iter().find(|label| counts_down(label.trimmed())) {
        problems.error("E311", *label, "heights count downward, and are not read so".to_owned(), UPWARD);
    }
}

/// The table of a file of lines.
pub(super) fn read(
    rows: &[Vec<Field>],
    comments: &[(usize, String)],
    form: TableForm,
    settings: &Settings,
    problems: &mut Problems,
) -> Option<OffsetTable> {
    let (kept, mut definitions) = diagonals::without_definitions(rows);
    definitions.extend(comments.iter().map(|(_, text)| text.clone()));
    let rows = settled(&kept);
    let lines = Lines { definitions, ..lines(&rows)? };
    refuse_downward(&lines, problems);
    let full = breadths(&lines, settings, problems);
    let mut settings = Settings { full: Some(full), ..settings.clone() };
    lines.units(&mut settings, problems);
    let settings = &settings;
    let positions_row = lines.rows.iter().find(|row| row.group == Some(Group::Positions));
    let fields: &[Field] = positions_row.map_or(lines.heads, |row| row.cells);
    let heads = positions(lines.heads, fields, form.decimal_comma, problems)?;
    let of = |group: Group| lines.rows.iter().filter(move |row| row.group == Some(group)).flat_map(|row| row.cells);
    let (y, z) =
        (Size::of(of(Group::HalfBreadths), form.decimal_comma), Size::of(of(Group::Heights), form.decimal_comma));
    let places: Vec<Position> = heads.iter().map(|(_, position)| *position).collect();
    let corner = corner(&lines, positions_row, settings);
    let width = |at: usize| {
        let cells = of_breadths(&lines).filter_map(|row| row.cells.get(at));
        cells.filter_map(|field| length(field, form.decimal_comma)).fold(0.0, f64::max)
    };
    let largest = heads.iter().map(|(at, _)| width(*at)).fold(0.0, f64::max);
    let ends = [heads.first(), heads.last()].map(|head| head.map_or(0.0, |(at, _)| width(*at) / largest));
    let largest = settings.units.unwrap_or(Notation::Metres).metres(largest);
    let breadths = Breadths { largest, ends, ..Breadths::default() };
    let origin = origin(settings, corner, &places, breadths, problems);
    let units = units(settings, corner, [Size::of_positions(places.iter()), y, z], origin.numbers, problems);
    let datum = ends_from_midship(origin.datum, settings, &places, units.x, problems);
    let form = TableForm { origin: datum, layout: TableLayout::Other, ..form };
    let mut reader = TableReader::new(settings, form, units, problems);
    reader.length = reader.length.or(origin.length);
    let xs: Vec<f64> = places.iter().map(|place| reader.along(*place)).collect();
    let fields: Vec<Field> = heads.iter().map(|(at, _)| fields[*at].clone()).collect();
    let points = points(&lines, &heads, &xs, &mut reader);
    let names: Vec<&str> = heads.iter().map(|(at, _)| lines.heads[*at].trimmed()).collect();
    crossings(&points, &names, reader.problems);
    let direction = order(&xs, &fields, "station", reader.problems)?;
    let has_cuts = points.iter().any(|point| point.is_cut);
    let mut table = OffsetTable::default();
    let mut kept: Vec<usize> = Vec::new();
    for (k, ((at, _), x)) in heads.iter().zip(&xs).enumerate() {
        let name = lines.heads[*at].trimmed();
        let outline = outline(points.iter().filter(|point| point.station == k), has_cuts);
        if outline.len() < 2 {
            let message = format!("station '{name}' is left out: it has not two points");
            reader.problems.warning("W332", lines.heads[*at].place(), message, "");
            continue;
        }
        table.stations.push(StationOffsets { outlines: vec![outline], ..StationOffsets::new(name, *x) });
        kept.push(k);
    }
    if direction == Order::Falling {
        table.stations.reverse();
        kept.reverse();
    }
    // `forward of transom` counts from the transom.
    // `Distance forward of AP` and `Distance from AP, positive forward` both count from AP: the end counts, not the way.
    let counts_from = |row: &Row<'_>| {
        let ends = words(&row.name).into_iter().filter(|word| !matches!(word.as_str(), "forward" | "fwd" | "aft"));
        ends.map(|word| end_of(&word)).find(|end| *end != 0).unwrap_or_else(|| end_of(&row.name))
    };
    let from = positions_row.map(counts_from);
    let is_placed = matches!(datum, StationDatum::Shifted { .. });
    if !is_placed && turn(&mut table, settings, from, reader.problems) {
        kept.reverse();
    }
    reader.form.boat_lines = written_lines(&points, &kept);
    reader.form.station_order = direction;
    reader.form.station_heads =
        table.stations.iter().map(|s| Kept { text: s.station.name.clone(), value: s.station.x }).collect();
    table.form = reader.finish();
    Some(table)
}

/// A length in the unit of the table, or in feet where it is written in feet, inches and eighths.
fn length(field: &Field, decimal_comma: bool) -> Option<f64> {
    match parse_cell(&field.text, CellRules { unit: Notation::Feet, decimal_comma }).ok()?.entry {
        CellEntry::Length(length) => Some(length / Notation::Feet.metres(1.0)),
        CellEntry::Absent | CellEntry::Unknown => None,
    }
}

/// The rows of half-breadths.
fn of_breadths<'l, 'g>(lines: &'l Lines<'g>) -> impl Iterator<Item = &'l Row<'g>> {
    lines.rows.iter().filter(|row| row.group == Some(Group::HalfBreadths))
}

/// What the label of the positions of stations says: their unit, and from where they count.
fn corner(lines: &Lines<'_>, positions_row: Option<&Row<'_>>, settings: &Settings) -> Corner {
    let label = positions_row.map(|row| row.label).or(lines.positions);
    let said = label.map(|label| Corner::of(label.trimmed())).unwrap_or_default();
    let Corner { rows, unit, x_unit, from, aftward, .. } = said;
    // A unit that the conventions state for x is that of distances, unless they space numbers.
    let stated = settings.x_units.filter(|_| settings.station_spacing.is_none());
    let x_unit = x_unit.or(unit).or(stated);
    let are_distances = positions_row.is_some() || x_unit.is_some() || rows == Some(Axis::X);
    let rows = Some(if are_distances { Axis::X } else { Axis::Station });
    // A row of distances says itself which end is the stem.
    let from = from.filter(|_| positions_row.is_none());
    Corner { rows, x_unit, from, aftward, ..Corner::default() }
}

/// The stations that have a position, with the column of each.
fn positions(
    names: &[Field],
    fields: &[Field],
    comma: bool,
    problems: &mut Problems,
) -> Option<Vec<(usize, Position)>> {
    let mut list = Vec::new();
    for (at, (name, field)) in names.iter().zip(fields).enumerate() {
        if name.is_blank() && field.is_blank() {
            continue;
        }
        match position(field.trimmed(), comma) {
            Ok(position) => list.push((at, position)),
            Err(error) => {
                let message = format!("no position of station '{}': {error}", name.trimmed());
                problems.error("E310", field, message, "Give a row 'station' with the distances of all stations");
            }
        }
    }
    (list.len() > 1 && !problems.any_errors()).then_some(list)
}

/// Whether breadths are full, by the conventions or by the labels; says so where these leave it open.
fn breadths(lines: &Lines<'_>, settings: &Settings, problems: &mut Problems) -> bool {
    if let Some(full) = settings.full {
        return full;
    }
    if let Some(label) = lines.labels.iter().find(|label| says_full(&label.text)) {
        let message = format!("full breadths, by '{}'", label.trimmed());
        problems.warning("W320", label.place(), message, HALF_OR_FULL);
        return true;
    }
    let of_breadths = |label: &&&Field| group_of(&label.text).0 == Some(Group::HalfBreadths);
    let says_half = |label: &&Field| {
        let lower = label.text.to_lowercase();
        let says = |word: &str| matches!(word, "hb" | "y" | "halves") || word.starts_with("semi");
        lower.contains("half") || words(&lower).iter().any(|word| says(word))
    };
    if let Some(label) = lines.labels.iter().find(of_breadths).filter(|_| !lines.labels.iter().any(says_half)) {
        problems.warning("W320", label.place(), half_taken(label.trimmed()), HALF_OR_FULL);
    }
    false
}

/// Values of a line at the stations: those that its row lacks between two that it has are taken from the cubic through the
/// nearest four, with a warning.
fn filled(
    row: &Row<'_>,
    values: Vec<Option<f64>>,
    xs: &[f64],
    names: &[&str],
    reader: &mut TableReader<'_>,
) -> Vec<Option<f64>> {
    let known: Vec<(f64, f64)> = xs.iter().zip(&values).filter_map(|(x, value)| Some((*x, (*value)?))).collect();
    let given = |k: usize| values[k].is_some();
    let mut found = values.clone();
    for k in (0..values.len()).filter(|k| !given(*k)) {
        if !(0..k).any(given) || !(k + 1..values.len()).any(given) {
            continue;
        }
        let mut near = known.clone();
        near.sort_by(|a, b| (a.0 - xs[k]).abs().total_cmp(&(b.0 - xs[k]).abs()));
        near.truncate(4);
        let factor = |i: usize| -> f64 {
            let others = near.iter().enumerate().filter(|(j, _)| *j != i);
            others.map(|(_, (x, _))| (xs[k] - x) / (near[i].0 - x)).product()
        };
        let value: f64 = (0..near.len()).map(|i| near[i].1 * factor(i)).sum();
        let message = format!(
            "'{}' gives nothing at station '{}': {value:.4} m is taken, by its neighbours",
            row.label.trimmed(),
            names[k]
        );
        reader.problems.warning("W320", row.label.place(), message, "Give the value");
        found[k] = Some(value);
    }
    found
}

/// Says where lines stand in another order than at most stations: sheer above chine above keel.
fn crossings(points: &[LinePoint], names: &[&str], problems: &mut Problems) {
    let height = |name: &str, station: usize| {
        points.iter().find(|point| point.station == station && point.name == name).map(|point| point.z)
    };
    let mut lines: Vec<&str> = Vec::new();
    for point in points.iter().filter(|point| !point.is_cut) {
        if !lines.contains(&point.name.as_str()) {
            lines.push(&point.name);
        }
    }
    for (k, first) in lines.iter().enumerate() {
        for second in &lines[k + 1..] {
            let apart = |station: usize| Some(height(first, station)? - height(second, station)?);
            let (above, below): (Vec<usize>, Vec<usize>) = (0..names.len())
                .filter(|station| apart(*station).is_some_and(|by| by.abs() > SAME_POINT))
                .partition(|station| apart(*station).is_some_and(|by| by > 0.0));
            let odd = if above.len() < below.len() { above } else { below };
            let all = (0..names.len()).filter(|station| apart(*station).is_some()).count();
            for station in odd.iter().filter(|_| 4 * odd.len() < all) {
                let message =
                    format!("'{first}' and '{second}' cross at station '{}': a height may be wrong", names[*station]);
                problems.warning(
                    "W336",
                    FilePosition::FILE,
                    message,
                    "Correct the height, or exchange the lines there",
                );
            }
        }
    }
}

/// The points of all lines at all stations.
fn points(lines: &Lines<'_>, heads: &[(usize, Position)], xs: &[f64], reader: &mut TableReader<'_>) -> Vec<LinePoint> {
    let mut points = Vec::new();
    let stations: Vec<&str> = heads.iter().map(|(at, _)| lines.heads[*at].trimmed()).collect();
    for name in lines.names() {
        let row = |group| lines.rows.iter().find(|row| row.group == Some(group) && row.name == name);
        let (heights, breadths) = (row(Group::Heights), row(Group::HalfBreadths));
        let on_centreplane = breadths.is_none() && ["keel", "rabbet"].iter().any(|word| name.contains(word));
        let Some(heights) = heights.filter(|_| breadths.is_some() || on_centreplane) else {
            let place = row(Group::Heights).or(breadths).map_or(FilePosition::FILE, |row| row.label.place());
            let message = format!("left out: '{name}' has not both heights and half-breadths");
            reader.problems.warning("W332", place, message, "");
            continue;
        };
        if on_centreplane {
            let message = format!("'{name}' has no half-breadths: it is taken on the centreplane");
            reader.problems.warning(
                "W320",
                heights.label.place(),
                message,
                "Give a row of its half-breadths (half siding)",
            );
        }
        let of =
            |row: &Row<'_>, half: bool, reader: &mut TableReader<'_>| -> (Vec<Option<f64>>, Vec<Option<Written>>) {
                let read = |(at, _): &(usize, Position)| {
                    let cell = row.cells.get(*at).map(|field| reader.cell(field, half)).unwrap_or_default();
                    (cell.value(), cell.written.filter(|_| cell.entry != Entry::Absent))
                };
                heads.iter().map(read).unzip()
            };
        let (zs, z_cells) = of(heights, false, reader);
        let (ys, y_cells) = breadths.map(|row| of(row, true, reader)).unzip();
        // A line may end where both of its rows do; where one alone has nothing it is not known.
        let is_half = |k: usize| ys.as_ref().is_some_and(|ys| ys[k].is_some() != zs[k].is_some());
        let any = (0..heads.len()).any(is_half);
        let (zs, ys) = match (breadths, ys) {
            (Some(row), Some(ys)) if any => {
                (filled(heights, zs, xs, &stations, reader), filled(row, ys, xs, &stations, reader))
            }
            (_, ys) => (zs, ys.unwrap_or_else(|| vec![Some(0.0); heads.len()])),
        };
        for (station, (y, z)) in ys.into_iter().zip(zs).enumerate() {
            if let (Some(y), Some(z)) = (y, z) {
                let y_cell = y_cells.as_ref().and_then(|cells| cells[station].clone());
                let cells = [y_cell, z_cells[station].clone()];
                points.push(LinePoint { station, name: name.to_owned(), is_cut: false, y, z, cells });
            }
        }
    }
    cuts::points(lines, heads, reader, &mut points);
    for row in &lines.rows {
        match row.group {
            Some(Group::Diagonals) => diagonals::points(row, &lines.definitions, heads, reader, &mut points),
            None => {
                let message = format!("left out: the row '{}'", row.label.trimmed());
                reader.problems.warning("W332", row.label.place(), message, "");
            }
            Some(_) => {}
        }
    }
    points
}

/// Points of a section from below, those in one place once; `at` is half-breadth and height \[m\].
pub(super) fn from_below<P>(mut points: Vec<P>, at: impl Fn(&P) -> [f64; 2]) -> Vec<P> {
    points.sort_by(|a, b| at(a)[1].total_cmp(&at(b)[1]).then(at(a)[0].total_cmp(&at(b)[0])));
    points.dedup_by(|a, b| (0..2).all(|k| (at(a)[k] - at(b)[k]).abs() < SAME_POINT));
    points
}

/// A section from the keel to the sheer.
fn outline<'p>(points: impl Iterator<Item = &'p LinePoint>, has_cuts: bool) -> Vec<OutlinePoint> {
    let sorted = from_below(points.collect(), |point: &&LinePoint| [point.y, point.z]);
    let last = sorted.len().saturating_sub(1);
    let is_knuckle = |(k, point): (usize, &&LinePoint)| {
        let named = ["chine", "knuckle", "rabbet"].iter().any(|word| point.name.contains(word));
        let knuckle = k > 0 && k < last && (named || !has_cuts);
        OutlinePoint { y: point.y, z: point.z, marks: Marks { knuckle, ..Marks::default() } }
    };
    sorted.iter().enumerate().map(is_knuckle).collect()
}

/// The named lines with their cells; `kept` are the columns of the stations from aft forward.
fn written_lines(points: &[LinePoint], kept: &[usize]) -> Vec<WrittenLine> {
    let mut lines: Vec<WrittenLine> = Vec::new();
    for (station, column) in kept.iter().enumerate() {
        for point in points.iter().filter(|point| point.station == *column) {
            let written = WrittenPoint { station, given: [point.y, point.z], cells: point.cells.clone() };
            match lines.iter_mut().find(|line| line.name == point.name) {
                Some(line) => line.points.push(written),
                None => lines.push(WrittenLine { name: point.name.clone(), points: vec![written] }),
            }
        }
    }
    lines
}

/// What settles which end of a boat is the stem.
const STEM: &str = "Name a station 'transom' or 'stem', or give stations = \"from FP\" in the conventions";

/// Whether the first station is at the fuller end, where one end is full and the other fine.
fn begins_full(table: &OffsetTable) -> Option<bool> {
    let widths: Vec<f64> = table
        .stations
        .iter()
        .map(|station| station.outlines.iter().flatten().map(|point| point.y).fold(0.0, f64::max))
        .collect();
    let largest = widths.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let ends = [*widths.first()? / largest, *widths.last()? / largest];
    Breadths { largest, ends, ..Breadths::default() }.begins_full()
}

/// Turns a hull about whose stations count from its stem, by the words before their distances (`from`), by their names, or
/// by its fuller end; says so where no word tells. Numbers of stations have their own warning. Whether it was turned.
fn turn(table: &mut OffsetTable, settings: &Settings, from: Option<i32>, problems: &mut Problems) -> bool {
    if settings.stations.is_some() {
        return false;
    }
    let end = |station: Option<&StationOffsets>| station.map_or(0, |station| end_of(&station.station.name));
    let (aft, fore) = match from {
        Some(1) => (1, -1),
        Some(-1) => (-1, 1),
        _ => (end(table.stations.first()), end(table.stations.last())),
    };
    let is_named = aft != 0 || fore != 0 || settings.sentences.names_end();
    let by_breadths = begins_full(table).filter(|_| !is_named && from.is_some());
    let is_turned = aft == 1 || fore == -1 || by_breadths == Some(false);
    if is_turned {
        let length = table.stations.last().map_or(0.0, |station| station.station.x);
        table.stations.iter_mut().for_each(|station| station.station.x = length - station.station.x);
        table.stations.reverse();
        problems.note("stations count from the stem; the aftmost one is at x = 0".to_owned());
    }
    if let Some(full) = by_breadths {
        let end = if full { "aft" } else { "the stem" };
        let message = format!(
            "no name says which end is the stem: x counts from {end}, because the fuller end is the stern. From the other end \
             the hull is turned about, and LCB changes its sign"
        );
        problems.warning("W320", FilePosition::FILE, message, STEM);
    } else if aft == 0 && fore == 0 && from.is_some() && !settings.sentences.names_end() {
        let message = "no name says which end is the stem: x counts from aft. From the stem the hull is turned about, and LCB changes its sign";
        problems.warning("W320", FilePosition::FILE, message.to_owned(), STEM);
    }
    is_turned
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str) -> Vec<Vec<Field>> {
        let field = |row: usize, (k, text): (usize, &str)| Field { text: text.to_owned(), row, column: k + 1 };
        text.lines()
            .enumerate()
            .map(|(row, line)| line.split(',').enumerate().map(|part| field(row + 1, part)).collect())
            .collect()
    }

    #[test]
    fn groups_in_a_column_in_a_row_and_in_the_name() {
        for text in [
            ",,a,b\nheights,sheer,1,2\n,keel,0,0\nwidths,sheer,1,2\n,keel,0,0",
            "line,a,b\nHeights above base,,\nsheer,1,2\nkeel,0,0\nHalf-breadths,,\nsheer,1,2\nkeel,0,0",
            "line,a,b\nSheer height,1,2\nKeel height,0,0\nHalf-breadth of sheer,1,2\nHalf-breadth of keel,0,0",
        ] {
            assert!(is_boat(&rows(text)), "{text}");
        }
        for text in [
            "z\\x,0,10\n0,1,2\n1,1,2\nkeel height,0,0\ndeck height,1,2\ndeck half breadth,1,2",
            "x,0.5,1\n0,1,2\n10,1,2",
        ] {
            assert!(!is_boat(&rows(text)), "{text}");
        }
    }

    #[test]
    fn sections_go_from_the_keel_to_the_sheer() {
        let point = |name: &str, y, z| LinePoint {
            station: 0,
            name: name.to_owned(),
            is_cut: false,
            y,
            z,
            cells: [None, None],
        };
        let all = [point("sheer", 2.0, 3.0), point("chine", 1.5, 1.0), point("keel", 0.0, 0.5)];
        let found: Vec<(f64, bool)> = outline(all.iter(), false).iter().map(|p| (p.y, p.marks.knuckle)).collect();
        assert_eq!(found, [(0.0, false), (1.5, true), (2.0, false)]);
    }
}

//! Tables of lines of boats, written as they are read ([`super::boat`]): rows of heights and half-breadths along the stations.
//! Points of sections are those of the lines in the order of their heights.

use super::boat::{SAME_POINT, from_below};
use super::write::Writer;
use crate::hull::{Cell, Entry, Marks, OffsetTable, OutlinePoint, StationDatum, WrittenLine, WrittenPoint};
use crate::units::Notation;

/// What the coordinates of a row are, and what a row at the other coordinate is called.
const GROUPS: [(usize, &str, &str); 2] = [(1, "heights", "Butt"), (0, "half-breadths", "WL")];

/// Where the points of the lines stand in the sections: station, point as written, point of the section.
struct Places {
    /// By station, the points as they were written, from below.
    written: Vec<Vec<[f64; 2]>>,
}

impl Places {
    /// None where the sections have other points than the lines.
    fn new(table: &OffsetTable) -> Option<Self> {
        let mut written: Vec<Vec<[f64; 2]>> = vec![Vec::new(); table.stations.len()];
        for point in table.form.boat_lines.iter().flat_map(|line| &line.points) {
            written.get_mut(point.station)?.push(point.given);
        }
        for (points, station) in written.iter_mut().zip(&table.stations) {
            *points = from_below(std::mem::take(points), |point| *point);
            if points.len() != station.outlines.first()?.len() || station.outlines.len() != 1 {
                return None;
            }
        }
        Some(Self { written })
    }

    /// The point of the section that a written one is.
    fn now<'t>(&self, table: &'t OffsetTable, point: &WrittenPoint) -> Option<&'t OutlinePoint> {
        let apart = |given: &[f64; 2]| (given[0] - point.given[0]).hypot(given[1] - point.given[1]);
        let at = self.written.get(point.station)?.iter().position(|given| apart(given) < 2.0 * SAME_POINT)?;
        table.stations[point.station].outlines[0].get(at)
    }
}

/// Whether the file of a line gives a coordinate.
fn gives(line: &WrittenLine, coordinate: usize) -> bool {
    line.points.iter().any(|point| point.cells[coordinate].is_some())
}

/// The rows of a table of lines; none where the points are not those of its lines, or where lines have neither heights nor
/// half-breadths, as diagonals.
pub(super) fn records(table: &OffsetTable, writer: &mut Writer) -> Option<Vec<Vec<String>>> {
    let lines = &table.form.boat_lines;
    if lines.is_empty() || lines.iter().any(|line| !gives(line, 0) && !gives(line, 1)) {
        return None;
    }
    let places = Places::new(table)?;
    if writer.form.notation == Notation::FeetInchesEighths {
        // Such a table says so by its cells, and all of them are.
        (writer.form.x_notation, writer.form.z_notation) = (writer.form.notation, writer.form.notation);
    }
    writer.form.origin = StationDatum::Lengths;
    writer.form.station_heads.clear();
    let names = table.stations.iter().map(|station| station.station.name.clone());
    let mut records = vec![["lines".to_owned(), "name".to_owned()].into_iter().chain(names).collect()];
    let along: Vec<String> = table.stations.iter().map(|station| writer.station(station.station.x)).collect();
    records.push(["distance".to_owned(), "from AP".to_owned()].into_iter().chain(along).collect());
    for (coordinate, group, across) in GROUPS {
        for line in lines.iter().filter(|line| gives(line, coordinate)) {
            let name = match line.points.first() {
                Some(first) if !gives(line, 1 - coordinate) => {
                    let unit = if coordinate == 0 { writer.form.z_notation } else { writer.form.notation };
                    format!("{across} {}", writer.length(first.given[1 - coordinate], unit))
                }
                _ => line.name.clone(),
            };
            let mut row = vec![group.to_owned(), name];
            row.resize(2 + table.stations.len(), String::new());
            for point in &line.points {
                let now = places.now(table, point)?;
                let cell = Cell {
                    entry: Entry::Given([now.y, now.z][coordinate]),
                    written: point.cells[coordinate].clone(),
                    marks: Marks::default(),
                };
                row[2 + point.station] = writer.cell(&cell, coordinate == 0);
            }
            records.push(row);
        }
    }
    Some(records)
}

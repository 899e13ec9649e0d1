//! Tables of offsets as CSV: half-breadths over stations and waterlines, heights over stations and buttocks.
//!
//! One row a station, its first cell the distance from AP; the header carries the heights of the waterlines, or the
//! distances of the buttocks from the centreplane. The first cell of the header names both and the unit. A cell is empty
//! where there is no hull.

use super::number::{line, to_decimals};
use crate::hull::{OffsetTable, PrincipalParticulars};
use crate::units::Notation;

fn write(notation: Notation, value: Option<f64>) -> String {
    value.filter(|v| v.is_finite()).map_or_else(String::new, |v| notation.write(v))
}

/// A place of a line, to a nanometre.
fn place(notation: Notation, value: f64) -> String {
    write(notation, Some(to_decimals(value, 9)))
}

/// Half-breadths. With `endings`, two more rows give x of the stern and of the stem at each waterline.
#[must_use]
pub fn offsets_csv(table: &OffsetTable, notation: Notation, endings: bool) -> String {
    let one = |value: f64| place(notation, value);
    let mut head = vec![format!("x\\z [{}]", notation.as_str())];
    head.extend(table.waterlines.iter().map(|&z| one(z)));
    let mut text = line(&head);
    for station in &table.stations {
        let mut row = vec![one(station.station.x)];
        row.extend(station.half_breadths.iter().map(|y| write(notation, y.value())));
        text.push_str(&line(&row));
    }
    if endings {
        for (name, end) in [("stern", 0), ("stem", 1)] {
            let mut row = vec![name.to_owned()];
            row.extend(table.endings.iter().map(|ends| write(notation, ends[end])));
            text.push_str(&line(&row));
        }
    }
    text
}

/// Bevels \[deg\] at the waterlines of the table, a row for each of its stations.
#[must_use]
pub fn bevels_csv(table: &OffsetTable, bevels: &[Vec<Option<f64>>], notation: Notation) -> String {
    let one = |value: f64| place(notation, value);
    let mut head = vec![format!("x\\z [{}], bevels in degrees", notation.as_str())];
    head.extend(table.waterlines.iter().map(|&z| one(z)));
    let mut text = line(&head);
    for (station, bevels) in table.stations.iter().zip(bevels) {
        let mut row = vec![one(station.station.x)];
        row.extend(bevels.iter().map(|angle| angle.map_or_else(String::new, |angle| format!("{angle:.2}"))));
        text.push_str(&line(&row));
    }
    text
}

/// Heights at the buttocks; then keel (lowest point on the centreplane), half-breadth of the flat of bottom, height of
/// the deck at side and half-breadth there.
#[must_use]
pub fn heights_csv(table: &OffsetTable, notation: Notation) -> String {
    let one = |value: f64| place(notation, value);
    let mut head = vec![format!("x\\y [{}]", notation.as_str())];
    head.extend(table.buttocks.iter().map(|&y| one(y)));
    head.extend(["keel", "flat of bottom", "deck at side", "half-breadth at deck"].map(str::to_owned));
    let mut text = line(&head);
    for station in &table.stations {
        let mut row = vec![one(station.station.x)];
        row.extend(station.heights.iter().map(|z| write(notation, z.value())));
        let last = [station.keel_height, station.flat_of_bottom, station.deck_height, station.deck_half_breadth];
        row.extend(last.map(|value| write(notation, value)));
        text.push_str(&line(&row));
    }
    text
}

/// The conventions of a table of offsets of a hull, for the TOML file beside it: its dimensions \[m\], which the offsets do not
/// say.
#[must_use]
pub fn conventions_toml(particulars: &PrincipalParticulars) -> String {
    let dimensions = [
        ("Lpp", Some(particulars.length_between_perpendiculars)),
        ("B", Some(particulars.breadth)),
        ("T", particulars.draught),
        ("D", Some(particulars.depth)),
    ];
    let lines = dimensions.into_iter().filter_map(|(key, value)| Some(format!("{key} = {:?}\n", value?)));
    format!("# Dimensions of the hull of offsets.csv [m].\n[table]\n{}", lines.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::{Cell, StationOffsets};

    fn table() -> OffsetTable {
        let cells = |values: Vec<Option<f64>>| values.into_iter().map(Cell::from).collect();
        let station = |x: f64, half_breadths, heights| StationOffsets {
            half_breadths: cells(half_breadths),
            heights: cells(heights),
            keel_height: Some(0.0),
            deck_height: Some(3.5),
            deck_half_breadth: Some(2.0),
            ..StationOffsets::new("1", x)
        };
        OffsetTable {
            waterlines: vec![0.5, 1.0],
            buttocks: vec![1.0],
            stations: vec![
                station(0.0, vec![None, Some(1.25)], vec![Some(0.9)]),
                station(5.0, vec![Some(1.5), Some(2.0)], vec![None]),
            ],
            endings: vec![[Some(0.2), Some(9.0)], [None, Some(9.5)]],
            ..OffsetTable::default()
        }
    }

    #[test]
    fn a_matrix_with_endings() {
        assert_eq!(
            offsets_csv(&table(), Notation::Metres, true),
            "x\\z [m],0.5,1\n0,,1.25\n5,1.5,2\nstern,0.2,\nstem,9,9.5\n"
        );
        assert_eq!(
            offsets_csv(&table(), Notation::FeetInchesEighths, false),
            "x\\z [feet-inches-eighths],1-7-5+,3-3-3\n0-0-0,,4-1-1+\n16-4-7,4-11-0+,6-6-6\n"
        );
    }

    #[test]
    fn heights_with_keel_and_deck() {
        assert_eq!(
            heights_csv(&table(), Notation::Millimetres),
            "x\\y [mm],1000,keel,flat of bottom,deck at side,half-breadth at deck\n0,900,0,,3500,2000\n5000,,0,,3500,2000\n"
        );
    }
}

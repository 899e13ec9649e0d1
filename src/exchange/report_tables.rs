//! Tables of a report as CSV: offsets on diagonals and areas of sections.

use super::number::{cell, line, to_decimals};
use crate::hull::{Hull, OffsetStation, diagonal_offset};
use crate::units::Notation;

/// Distances along diagonals of `angle` \[rad\] below the horizontal that start at `heights` \[m\] on the centreplane:
/// one row a station, empty where a diagonal does not meet the side.
#[must_use]
pub fn diagonals_csv(
    hull: &Hull,
    stations: &[OffsetStation],
    heights: &[f64],
    angle: f64,
    notation: Notation,
) -> String {
    let mut head = vec![format!("x\\height on CL {:.3} deg down [{}]", angle.to_degrees(), notation.as_str())];
    head.extend(heights.iter().map(|&height| notation.write(micrometres(height))));
    let mut text = line(&head);
    for station in stations {
        let mut row = vec![notation.write(micrometres(station.x))];
        let offset = |&height: &f64| diagonal_offset(hull, station.x, height, angle);
        row.extend(
            heights.iter().map(|height| offset(height).map_or(String::new(), |s| notation.write(micrometres(s)))),
        );
        text.push_str(&line(&row));
    }
    text
}

/// A length \[m\] to the micrometre, for tables that people read.
#[must_use]
pub fn micrometres(length: f64) -> f64 {
    to_decimals(length, 6)
}

/// Areas of sections, both sides [m^2]: one row a height \[m\], one column a station \[m from AP\]; empty above the deck.
#[must_use]
pub fn section_areas_csv(stations: &[f64], heights: &[f64], areas: &[Vec<Option<f64>>]) -> String {
    let mut head = vec!["z [m]\\x [m], areas [m2]".to_owned()];
    head.extend(stations.iter().map(|x| cell(Some(micrometres(*x)))));
    let mut text = line(&head);
    for (height, row) in heights.iter().zip(areas) {
        let mut fields = vec![cell(Some(micrometres(*height)))];
        fields.extend(row.iter().map(|area| cell(area.map(micrometres))));
        text.push_str(&line(&fields));
    }
    text
}

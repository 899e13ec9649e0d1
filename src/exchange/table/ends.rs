//! Ends of a hull that its stations do not reach.

use super::problem::{FilePosition, Problems};
use super::settings::metres;
use crate::hull::{OffsetTable, StationOffsets};
use crate::numeric::trapezoids;

/// Part of the volume that an unknown end may have before it is a warning.
const SHARE: f64 = 0.01;

/// Sections of a bow that is cut off, over the greatest; a box has larger ones.
const BLUNT: [f64; 2] = [0.1, 0.9];

const REMEDY: &str = "Give the stations to the ends, or the profiles of stern and stem";

/// Says where the outermost stations still have sections, no transom or profile ends the hull there, and a perpendicular that
/// is known stands beyond them: the hull is cut off.
pub(super) fn cut_off(table: &OffsetTable, problems: &mut Problems) {
    let stations: Vec<[f64; 2]> = table.stations.iter().map(|s| [s.station.x, area(table, s)]).collect();
    let (Some(&[aft, first]), Some(&[fore, last])) = (stations.first(), stations.last()) else { return };
    let volume = trapezoids(&stations);
    let greatest = stations.iter().map(|[_, area]| *area).fold(0.0, f64::max);
    let has = |end: usize| table.endings.iter().any(|ends| ends[end].is_some());
    let Some(length) = table.stated.length_between_perpendiculars else {
        // Sterns end in transoms, bows hardly ever do.
        if !has(1) && last > BLUNT[0] * greatest && last < BLUNT[1] * greatest {
            let message = format!(
                "the stations end at x = {} m with {:.0} % of the greatest section: the hull is cut off upright there",
                metres(fore),
                100.0 * last / greatest
            );
            problems.warning("W317", FilePosition::FILE, message, REMEDY);
        }
        return;
    };
    // Of a cone from the last section to the perpendicular.
    let ends = [
        ("aft of", aft, 0.5 * first * aft, has(0) || table.transom.is_some()),
        ("forward of", fore, 0.5 * last * (length - fore), has(1)),
    ];
    for (word, x, beyond, _) in ends.into_iter().filter(|(_, _, beyond, ended)| !ended && *beyond > SHARE * volume) {
        let message = format!(
            "the stations end at x = {} m, and the hull {word} it is not known: cut off upright there, without about {:.1} % of the volume",
            metres(x),
            100.0 * beyond / (volume + beyond)
        );
        problems.warning("W317", FilePosition::FILE, message, REMEDY);
    }
}

/// Area of a section by its offsets [m^2], one side.
fn area(table: &OffsetTable, station: &StationOffsets) -> f64 {
    let cells = station.half_breadths.iter().zip(&table.waterlines).map(|(cell, z)| [*z, cell.value().unwrap_or(0.0)]);
    let cells: Vec<[f64; 2]> = cells.collect();
    let points: Vec<[f64; 2]> = station.outlines.iter().flatten().map(|p| [p.z, p.y]).collect();
    trapezoids(&cells).max(trapezoids(&points))
}

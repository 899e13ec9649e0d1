//! What a table does not show of the bottom of its hull: below the lowest waterline, or below the first points of sections.

use super::assemble::SAME;
use super::problem::{FilePosition, Problems};
use crate::hull::{OffsetTable, OutlinePoint, StationOffsets};
use crate::numeric::trapezoids;
use crate::units::counted;

/// Part of the volume that an unknown bottom may have before it is a warning.
const SHARE: f64 = 0.01;

/// Least waterplane of a hull that goes on below it, over the greatest.
const WATERPLANE: f64 = 0.01;

/// A waterplane of less than this part of the greatest is that of a hull that closes.
const CLOSED: f64 = 0.2;

/// Part of the greatest half-breadth up to which a first point is the siding of a keel.
const SIDING: f64 = 0.15;
/// Least half-breadth of the first point of a section that does not close, over that of the hull.
const OPEN: f64 = 0.05;

/// No section is taken to go on below its first point with a greater slope dz/dy.
const STEEPEST: f64 = 2.0;

/// Slopes dz/dy up to this are those of a bottom that is level.
const LEVEL: f64 = 0.1;

/// Says what is not known of the bottom, where it may be more than [`SHARE`] of the volume.
pub(super) fn unknown(table: &OffsetTable, problems: &mut Problems) {
    if table.point_count() > 0 {
        return below_points(table, problems);
    }
    let remedy = "Give a row or a column 'keel' with its heights and one 'flat of bottom', or the lowest waterlines";
    // A waterline without any value shows nothing.
    let is_given = |j: usize| table.stations.iter().any(|station| station.half_breadth(j).is_some());
    let Some(first) = (0..table.waterlines.len()).find(|j| is_given(*j)) else { return };
    let lowest = table.waterlines[first];
    let areas = &areas(table)[first..];
    let greatest = areas.iter().map(|[_, area]| *area).fold(0.0, f64::max);
    if areas[0][1] <= WATERPLANE * greatest {
        return;
    }
    if lowest < -SAME && !table.stations.iter().any(has_keel) {
        let message = format!(
            "the lowest waterline is at {lowest} m and has {:.0} % of the greatest waterplane: what is below it does not count",
            100.0 * areas[0][1] / greatest
        );
        return problems.warning("W315", FilePosition::FILE, message, remedy);
    }
    let draught = table.stated.draught.filter(|draught| *draught > lowest);
    let above = volume(areas, draught.unwrap_or(f64::INFINITY));
    let of = draught.map_or_else(|| "the volume".to_owned(), |draught| format!("the volume up to T {draught} m"));
    // A flat of bottom without a height lies nowhere.
    if table.stations.iter().any(|station| station.keel_height.is_some()) {
        let below = 0.5 * to_keel(table, first);
        if below > SHARE * (below + above) {
            let message = format!(
                "between the keel and the lowest waterline, {lowest} m, the sections are not known: straight to the flat of bottom, where \
                 one is given. Full ones would have up to {:.1} % of {of} more",
                100.0 * below / (below + above)
            );
            problems.warning("W315", FilePosition::FILE, message, remedy);
        }
        return;
    }
    let below = lowest * areas[0][1];
    if lowest > SAME && below > SHARE * (below + above) {
        let message = format!(
            "the lowest waterline is {lowest} m above the base line, and no keel is given: what is below it does not count, and is \
             up to {:.1} % of {of}",
            100.0 * below / (below + above)
        );
        problems.warning("W315", FilePosition::FILE, message, remedy);
    }
}

/// Whether a table is broadest at its lowest waterline and closes at its highest, as one whose heights count downward.
pub(super) fn upside_down(table: &OffsetTable, problems: &mut Problems) {
    let given = |j: usize| table.stations.iter().filter(|station| station.half_breadth(j).is_some()).count();
    let lines: Vec<usize> = (0..table.waterlines.len()).filter(|j| given(*j) > 0).collect();
    let [first, .., last] = lines[..] else { return };
    let areas = areas(table);
    let greatest = areas.iter().map(|[_, area]| *area).fold(0.0, f64::max);
    let narrows = lines.windows(2).all(|pair| areas[pair[1]][1] <= areas[pair[0]][1] * (1.0 + 1e-3));
    let closes = areas[last][1] <= CLOSED * greatest && 4 * given(last) > 3 * given(first);
    if lines.len() > 3 && narrows && closes {
        let message = format!(
            "the hull is broadest at its lowest waterline, {} m, and closes at its highest, {} m: heights may count downward",
            table.waterlines[first], table.waterlines[last]
        );
        problems.warning("W320", FilePosition::FILE, message, super::around::UPWARD);
    }
}

fn has_keel(station: &StationOffsets) -> bool {
    station.keel_height.is_some() || station.flat_of_bottom.is_some()
}

/// Heights with half of the waterplanes there.
fn areas(table: &OffsetTable) -> Vec<[f64; 2]> {
    let area = |(j, &z): (usize, &f64)| -> [f64; 2] {
        let breadths = table.stations.iter().map(|s| [s.station.x, s.half_breadth(j).unwrap_or(0.0)]);
        [z, trapezoids(&breadths.collect::<Vec<_>>())]
    };
    table.waterlines.iter().enumerate().map(area).collect()
}

/// Half of the volume between the lowest waterline and a height.
fn volume(areas: &[[f64; 2]], top: f64) -> f64 {
    let part = |pair: &[[f64; 2]]| {
        let ([low, first], [high, second]) = (pair[0], pair[1]);
        let until = high.min(top).max(low);
        let share = (until - low) / (high - low);
        0.5 * (until - low) * (first + first + share * (second - first))
    };
    areas.windows(2).map(part).sum()
}

/// Half of what plumb sides have between the keel and the lowest waterline, beyond the flats of bottom.
fn to_keel(table: &OffsetTable, first: usize) -> f64 {
    let lowest = table.waterlines[first];
    let below = |station: &StationOffsets| {
        let depth = station.keel_height.map_or(0.0, |keel| (lowest - keel).max(0.0));
        let flat = station.flat_of_bottom.unwrap_or(0.0);
        [station.station.x, depth * (station.half_breadth(first).unwrap_or(0.0) - flat).max(0.0)]
    };
    trapezoids(&table.stations.iter().map(below).collect::<Vec<_>>())
}

/// Sections as points that begin beside the centreplane and rise from there: what is below their first points is open,
/// where it may be more than [`SHARE`] of the volume. A keel has a bottom as broad as its siding.
fn below_points(table: &OffsetTable, problems: &mut Problems) {
    let is_keel = |name: &str| ["keel", "rabbet", "siding"].iter().any(|word| name.contains(word));
    if table.form.boat_lines.iter().any(|line| is_keel(&line.name) && !line.name.contains("bilge")) {
        return;
    }
    let points = || table.stations.iter().flat_map(|station| &station.outlines).flatten();
    let greatest = points().map(|point| point.y).fold(0.0, f64::max);
    let parts: Vec<[f64; 3]> = table
        .stations
        .iter()
        .map(|station| [station.station.x, open_area(station, greatest), outline_area(station)])
        .collect();
    let open = parts.iter().filter(|[_, open, _]| *open > 0.0).count();
    let volume = |part: usize| trapezoids(&parts.iter().map(|of| [of[0], of[part]]).collect::<Vec<_>>());
    let (below, above) = (volume(1), volume(2));
    let first = parts.iter().position(|[_, open, _]| *open > 0.0);
    if let Some(first) = first.map(|k| &table.stations[k])
        && 4 * open > table.stations.len()
        && below > SHARE * (below + above)
    {
        let point = first.outlines[0][0];
        let message = format!(
            "{} begin beside the centreplane and rise from there, as that at x = {:.3} m, whose first point is ({:.3}, {:.3}): what \
             is below does not count, but for a level line to the centreplane. Continued to the centreplane the hull has up to {:.1} % more",
            counted(open, "section"),
            first.station.x,
            point.y,
            point.z,
            100.0 * below / above.max(f64::MIN_POSITIVE)
        );
        problems.warning("W315", FilePosition::FILE, message, "Begin each section on the centreplane");
    }
}

/// What the first slope of a section encloses below its first point, half \[m²\]; 0 where its bottom is known. Above a
/// keel the slope is that of the bottom beside it.
fn open_area(station: &StationOffsets, greatest: f64) -> f64 {
    let Some([first, second, others @ ..]) = station.outlines.first().map(Vec::as_slice) else { return 0.0 };
    let slope = |a: &OutlinePoint, b: &OutlinePoint| (b.z - a.z) / (b.y - a.y).abs().max(f64::MIN_POSITIVE);
    let rises = slope(first, second);
    let closed = station.flat_of_bottom.is_some() || station.half_breadths.iter().any(|cell| cell.value().is_some());
    // On the base line the level line to the centreplane is the bottom.
    if closed || first.z.abs() <= SAME || first.y <= OPEN * greatest || rises <= LEVEL {
        return 0.0;
    }
    // A siding is narrow; beside a broad first point the slope is that of the bottom itself.
    let siding = first.y <= SIDING * greatest;
    let above = others.first().filter(|_| siding).map_or(rises, |third| slope(second, third)).max(0.0);
    0.5 * first.y * first.y * rises.min(above).min(STEEPEST)
}

/// Half of the area of a section between its first and its last point \[m²\].
fn outline_area(station: &StationOffsets) -> f64 {
    let part = |pair: &[OutlinePoint]| 0.5 * (pair[0].y + pair[1].y) * (pair[1].z - pair[0].z);
    station.outlines.iter().map(|line| line.windows(2).map(part).sum::<f64>()).sum()
}

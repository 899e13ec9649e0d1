//! Profiles and edges of the deck beside half-breadths: what contradicts them, and what they leave out.

use super::assemble::SAME;
use super::problem::{FilePosition, Problems};
use super::settings::metres;
use crate::hull::{Entry, OffsetTable, StationOffsets};
use crate::numeric::trapezoids;
use crate::units::counted;

/// Profiles may lie so many lengths of the stations beyond them, and edges so many heights of the waterlines; farther ones are
/// warned of, and those beyond [`REFUSED`] refused.
const BEYOND: [f64; 2] = [1.0, 4.0];
const REFUSED: f64 = 30.0;

/// Part of the volume above the highest waterline that is a warning.
const SHARE: f64 = 0.01;

/// Least and greatest of values.
fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.fold(None, |found, value| match found {
        Some([low, high]) => Some([value.min(low), value.max(high)]),
        None => Some([value, value]),
    })
}

/// Refuses profiles far beyond the stations, and edges far beyond the waterlines, which have another unit; nearer ones are warned
/// of.
pub(super) fn far(table: &OffsetTable, problems: &mut Problems) {
    let stations = range(table.stations.iter().map(|s| s.station.x));
    let waterlines = range(table.waterlines.iter().copied());
    let ends = |end: usize| -> Vec<f64> { table.endings.iter().filter_map(move |ends| ends[end]).collect() };
    let edge = |of: fn(&StationOffsets) -> Option<f64>| -> Vec<f64> { table.stations.iter().filter_map(of).collect() };
    let lines = [
        ("stern", "stations", stations, BEYOND[0], ends(0)),
        ("stem", "stations", stations, BEYOND[0], ends(1)),
        ("keel", "waterlines", waterlines, BEYOND[1], edge(|s| s.keel_height)),
        ("flat of side", "waterlines", waterlines, BEYOND[1], edge(|s| s.flat_of_side)),
        ("deck at side", "waterlines", waterlines, BEYOND[1], edge(|s| s.deck_height)),
        ("deck centre", "waterlines", waterlines, BEYOND[1], edge(|s| s.deck_centre_height)),
    ];
    for (name, beside, given, most, values) in lines {
        let Some([low, high]) = given.filter(|[low, high]| high > low) else { continue };
        let beyond = |value: f64| (low - value).max(value - high);
        let Some(farthest) = values.into_iter().max_by(|a, b| beyond(*a).total_cmp(&beyond(*b))) else { continue };
        if beyond(farthest) > most * (high - low) {
            let message = format!(
                "'{name}' is at {} m, and the {beside} lie from {} to {} m",
                metres(farthest),
                metres(low),
                metres(high)
            );
            let remedy = format!("Correct it, or give its unit, as '{name} [mm]'");
            if beyond(farthest) > REFUSED * (high - low) {
                problems.error("E305", FilePosition::FILE, message, &remedy);
            } else {
                problems.warning("W320", FilePosition::FILE, message, &remedy);
            }
        }
    }
}

/// Says what of a hull lies between the highest waterline and the deck, and where the deck has no heights.
pub(super) fn deck(table: &OffsetTable, problems: &mut Problems) {
    let Some(top) = table.waterlines.last().copied() else { return };
    let highest = table.waterlines.len() - 1;
    let has_all = |s: &StationOffsets| s.half_breadths.iter().all(|cell| cell.entry != Entry::Absent);
    let edges = || table.stations.iter().filter(|s| s.deck_half_breadth.is_some());
    if table.stations.iter().all(|s| s.deck_height.is_none()) && edges().next().is_some() && edges().all(has_all) {
        let message = "the deck at side has half-breadths and no heights: they are not used".to_owned();
        problems.warning("W320", FilePosition::FILE, message, "Give its heights too, as 'z deck'");
    }
    let above = |s: &&StationOffsets| s.outlines.is_empty() && s.deck_height.is_some_and(|deck| deck > top + SAME);
    let count = table.stations.iter().filter(above).count();
    let strip = |s: &StationOffsets| {
        let side = s.half_breadth(highest).unwrap_or(0.0);
        let deck = s.deck_height.filter(|_| above(&s)).unwrap_or(top);
        0.5 * (side + s.deck_half_breadth.unwrap_or(side)) * (deck - top)
    };
    let area = |s: &StationOffsets| {
        let cells = s.half_breadths.iter().zip(&table.waterlines);
        trapezoids(&cells.map(|(cell, z)| [*z, cell.value().unwrap_or(0.0)]).collect::<Vec<[f64; 2]>>())
    };
    let volume = |of: &dyn Fn(&StationOffsets) -> f64| {
        trapezoids(&table.stations.iter().map(|s| [s.station.x, of(s)]).collect::<Vec<[f64; 2]>>())
    };
    let (below, beyond) = (volume(&area), volume(&strip));
    if beyond > SHARE * (below + beyond) {
        let most = table.stations.iter().filter_map(|s| s.deck_height).fold(top, f64::max) - top;
        let message = format!(
            "the deck at side lies up to {most:.3} m above the highest waterline, {} m, at {}: hydrostatics end at that waterline, \
             without about {:.1} % of the volume below the deck",
            metres(top),
            counted(count, "station"),
            100.0 * beyond / (below + beyond)
        );
        problems.warning("W320", FilePosition::FILE, message, "Give a waterline at the highest point of the deck");
    }
}
